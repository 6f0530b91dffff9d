//! Why there is no way, in figures that a person can check with a ruler.

use adit_planners::geometry::{Point, Rect};
use adit_planners::layers::{Headroom, headroom, narrowest};
use adit_planners::world::{Bridge, Obstacle, Occupancy, Shape, World};

const FROM: Point = Point::new(1.0, 2.0);
const TO: Point = Point::new(9.0, 2.0);

/// Two rooms, 4 m deep, and a wall between them with these gaps (from, to) along y.
fn rooms(thickness: f64, gaps: &[(f64, f64)]) -> World {
    let mut world = World::empty(Rect::new(0.0, 0.0, 10.0, 4.0));
    let mut y = 0.0;
    for &(low, high) in gaps.iter().chain([&(4.0, 4.0)]) {
        let shape = Shape::Rect(Rect::new(5.0, y, 5.0 + thickness, low));
        world.obstacles.push(Obstacle { shape });
        y = high;
    }
    world
}

#[test]
fn of_two_gaps_the_wider_counts_wherever_it_lies_on_the_lattice() {
    for shift in [0.0, 0.013, 0.02, 0.031, 0.05] {
        let world = rooms(0.15, &[(1.0 + shift, 1.45 + shift), (3.0, 3.3)]);
        let found = narrowest(&world, FROM, TO, 0.1).unwrap();
        assert!((found.width - 0.45).abs() < 1e-6, "{shift}: {found:?}");
        assert!(found.at.distance(Point::new(5.075, 1.225 + shift)) < 0.2, "{shift}: {found:?}");
    }
}

#[test]
fn a_wall_thinner_than_a_step_is_a_wall() {
    assert_eq!(narrowest(&rooms(0.02, &[]), FROM, TO, 0.1), None);
    assert_eq!(narrowest(&rooms(0.3, &[]), FROM, TO, 0.1), None);
}

#[test]
fn in_the_open_the_ends_are_the_narrowest() {
    let world = World::empty(Rect::new(0.0, 0.0, 10.0, 4.0));
    let found = narrowest(&world, Point::new(0.3, 2.0), TO, 0.1).unwrap();
    assert!((found.width - 0.6).abs() < 1e-9 && found.at == Point::new(0.3, 2.0), "{found:?}");
    assert_eq!(narrowest(&world, Point::new(-1.0, 2.0), TO, 0.1), None, "outside there is no way");
}

#[test]
fn walls_of_an_image_count_alike() {
    let mut blocked = vec![false; 100 * 40];
    for row in (0..40).filter(|row| !(20..26).contains(row)) {
        blocked[row * 100 + 50] = true;
    }
    let cells = Occupancy { origin: Point::default(), resolution: 0.1, columns: 100, rows: 40, blocked };
    let world = World { occupancy: Some(cells), ..World::empty(Rect::new(0.0, 0.0, 10.0, 4.0)) };
    let found = narrowest(&world, FROM, TO, 0.1).unwrap();
    assert!((found.width - 0.6).abs() < 1e-6, "{found:?}");
}

#[test]
fn the_highest_bridge_that_cannot_be_avoided_is_the_headroom() {
    let mut world = rooms(0.15, &[(0.5, 1.5), (2.5, 3.5)]);
    let at = |width| headroom(&world, FROM, TO, width, 0.05).unwrap();
    assert_eq!(at(0.8), Headroom::Unlimited);
    assert_eq!(at(1.2), Headroom::NoWay);
    for (y, height) in [(0.5, 1.3), (2.5, 0.9)] {
        world.bridges.push(Bridge { rect: Rect::new(4.0, y, 6.0, y + 1.0), height });
    }
    let Headroom::Limited { height, at } = headroom(&world, FROM, TO, 0.8, 0.05).unwrap() else {
        panic!("both gaps have a bridge")
    };
    assert_eq!(height.to_string(), "1.3");
    assert!(world.bridges[0].rect.nearest_to(at).distance(at) < 0.4, "{at:?}");
}
