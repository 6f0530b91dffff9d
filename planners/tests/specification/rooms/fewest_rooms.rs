//! The fewest rooms part the free space, and no fewer would do.

use std::collections::HashMap;

use adit_planners::geometry::Rect;
use adit_planners::minimum::{fewest_rects, fewest_rooms};
use adit_planners::prime_areas::maximal_rects;
use adit_planners::rooms::paper_rooms;
use proptest::prelude::*;

use crate::rooms::maps::{BOUNDS, any_map, crowded_map};
use crate::rooms::oracle;
use crate::rooms::paper_rooms::check_partition;

proptest! {
    #![proptest_config(ProptestConfig::with_cases(1_000))]

    #[test]
    fn they_part_the_free_space(map in any_map()) {
        check_partition(&map, &fewest_rooms(BOUNDS, &map.obstacles, &map.low))?;
    }

    #[test]
    fn crowded_maps_are_parted(map in crowded_map()) {
        check_partition(&map, &fewest_rooms(BOUNDS, &map.obstacles, &map.low))?;
    }

    #[test]
    fn they_are_never_more_than_the_papers(map in any_map()) {
        let areas = maximal_rects(BOUNDS, &map.obstacles);
        let papers = paper_rooms(BOUNDS, &map.obstacles, &map.low, &areas, &[]);
        prop_assert!(fewest_rooms(BOUNDS, &map.obstacles, &map.low).len() <= papers.len());
    }

    #[test]
    fn no_fewer_part_a_small_grid(blocked in 0_u32..1 << 20) {
        const COLUMNS: u32 = 5;
        let cell = |bit: u32| {
            let (x, y) = (f64::from(bit % COLUMNS), f64::from(bit / COLUMNS));
            Rect::new(x, y, x + 1.0, y + 1.0)
        };
        let obstacles: Vec<_> = (0..20).filter(|bit| blocked >> bit & 1 == 1).map(cell).collect();
        let found = fewest_rects(Rect::new(0.0, 0.0, 5.0, 4.0), &obstacles).len();
        prop_assert_eq!(found, oracle::fewest(!blocked & 0xF_FFFF, COLUMNS, &mut HashMap::new()));
    }
}

#[test]
fn aligned_walls_are_cut_along_chords() {
    let pillars = [Rect::new(2.0, 2.0, 3.0, 3.0), Rect::new(6.0, 2.0, 7.0, 3.0)];
    assert_eq!(fewest_rects(Rect::new(0.0, 0.0, 9.0, 5.0), &pillars).len(), 5);
}

#[test]
fn the_largest_comes_first() {
    let found = fewest_rects(BOUNDS, &[Rect::new(3.0, 0.0, 4.0, 9.0), Rect::new(7.0, 0.0, 8.0, 9.0)]);
    let starts: Vec<_> = found.iter().map(|rect| rect.x0).collect();
    assert_eq!(starts, [8.0, 0.0, 4.0]);
}
