//! Prime areas are exactly the maximal rectangles of free cells.

use adit_planners::geometry::{Point, Rect};
use adit_planners::prime_areas::{maximal_rects, prime_areas};
use adit_planners::world::{Bridge, Obstacle, Shape, World};
use proptest::prelude::*;

use crate::rooms::maps::{BOUNDS, Map, any_map};
use crate::rooms::oracle;

proptest! {
    #![proptest_config(ProptestConfig::with_cases(1_000))]

    #[test]
    fn they_are_the_maximal_rectangles_of_free_cells(map in any_map()) {
        let map = Map { low: Vec::new(), ..map };
        prop_assert_eq!(maximal_rects(BOUNDS, &map.obstacles), oracle::maximal(&map));
    }
}

#[test]
fn a_map_that_is_all_obstacle_has_none() {
    assert_eq!(maximal_rects(BOUNDS, &[Rect::new(-1.0, -1.0, 20.0, 20.0)]), []);
}

#[test]
fn an_empty_map_is_one() {
    assert_eq!(maximal_rects(BOUNDS, &[]), [BOUNDS]);
}

#[test]
fn bounds_without_area_have_none() {
    for bounds in [Rect::new(1.0, 1.0, 1.0, 5.0), Rect::new(0.0, 0.0, f64::INFINITY, 1.0)] {
        assert_eq!(maximal_rects(bounds, &[Rect::new(0.0, 0.0, 1.0, 1.0)]), []);
    }
}

#[test]
fn a_polygon_counts_by_its_enclosing_rectangle_and_a_bridge_as_free() {
    let corners = vec![Point::new(4.0, 0.0), Point::new(6.0, 4.0), Point::new(5.0, 9.0)];
    let world = World {
        obstacles: vec![Obstacle { shape: Shape::Polygon(corners) }],
        bridges: vec![Bridge { rect: Rect::new(1.0, 1.0, 2.0, 2.0), height: 1.0 }],
        ..World::empty(BOUNDS)
    };
    let (strips, areas) = prime_areas(&world);
    let rects: Vec<_> = areas.into_iter().map(|area| strips.rect(area)).collect();
    assert_eq!(rects, [Rect::new(0.0, 0.0, 4.0, 9.0), Rect::new(6.0, 0.0, 12.0, 9.0)]);
    assert_eq!(strips.x, [0.0, 1.0, 2.0, 4.0, 6.0, 12.0]);
}
