//! Spaces and doorways of drawn floors: what a person would call the rooms and the openings between them.

use adit_planners::geometry::{Point, Rect, Segment};
use adit_planners::spaces::Spaces;
use adit_planners::world::{NamedDoor, Obstacle, Shape, World};
use proptest::prelude::*;

fn wall(x0: f64, y0: f64, x1: f64, y1: f64) -> Obstacle {
    Obstacle { shape: Shape::Rect(Rect::new(x0, y0, x1, y1)) }
}

/// Four rooms of 5 x 4 m on both sides of a corridor 2 m wide and 10 m long, each with a door of so many metres.
fn wards(door: f64) -> World {
    let mut world = World::empty(Rect::new(0.0, 0.0, 10.0, 10.4));
    for y in [4.0, 6.2] {
        let mut from = 0.0;
        for middle in [2.5, 7.5] {
            world.obstacles.push(wall(from, y, middle - door / 2.0, y + 0.2));
            from = middle + door / 2.0;
        }
        world.obstacles.push(wall(from, y, 10.0, y + 0.2));
    }
    world.obstacles.push(wall(4.9, 0.0, 5.1, 4.0));
    world.obstacles.push(wall(4.9, 6.4, 5.1, 10.4));
    world
}

fn named(name: &str, from: Point, to: Point) -> NamedDoor {
    NamedDoor { name: name.to_owned(), kind: None, from, to, further: Vec::new() }
}

#[test]
fn rooms_at_a_corridor_are_spaces_with_a_doorway_each() {
    let found = Spaces::of(&wards(1.0)).unwrap();
    assert_eq!(found.spaces.len(), 5);
    assert_eq!(found.doorways.len(), 4);
    let at = |x, y| found.at(Point::new(x, y)).unwrap();
    let corridor = at(5.0, 5.2);
    for (x, y) in [(2.5, 2.0), (7.5, 2.0), (2.5, 8.4), (7.5, 8.4)] {
        let room = at(x, y);
        assert!((found.spaces[room].area - 19.6).abs() < 1.0, "{}", found.spaces[room].area);
        let between = [room.min(corridor), room.max(corridor)];
        let doorway = found.doorways.iter().find(|doorway| doorway.spaces == between).unwrap();
        let Segment { a, b } = doorway.segment;
        assert!((a.distance(b) - 1.0).abs() < 0.15, "{doorway:?}");
        assert!((doorway.segment.middle().x - x).abs() < 0.1, "{doorway:?}");
    }
}

#[test]
fn a_table_in_a_room_parts_nothing() {
    let mut world = wards(1.0);
    world.obstacles.push(wall(2.2, 1.8, 2.9, 2.4));
    assert_eq!(Spaces::of(&world).unwrap().spaces.len(), 5);
}

/// A hall of 6 x 6 m from which a corridor of 1.2 x 8 m leads to the right, along its lower wall.
fn hall_and_corridor() -> World {
    let mut world = World::empty(Rect::new(0.0, 0.0, 14.0, 6.0));
    world.obstacles.push(wall(6.0, 1.2, 14.0, 6.0));
    world
}

#[test]
fn a_corridor_ends_where_it_comes_into_a_hall() {
    let found = Spaces::of(&hall_and_corridor()).unwrap();
    assert_eq!(found.spaces.len(), 2);
    let [doorway] = found.doorways.as_slice() else { panic!("{:?}", found.doorways) };
    assert!(doorway.segment.middle().distance(Point::new(6.0, 0.6)) < 0.15, "{doorway:?}");
}

#[test]
fn a_way_around_something_is_of_the_hall_that_it_comes_back_to() {
    let mut world = World::empty(Rect::new(0.0, 0.0, 10.0, 10.0));
    // the aisle beneath is half as broad as the floor above
    world.obstacles.push(wall(3.0, 1.5, 7.0, 6.0));
    let found = Spaces::of(&world).unwrap();
    assert_eq!((found.spaces.len(), found.doorways.len()), (1, 0));
}

#[test]
fn a_doorway_lies_in_the_middle_of_a_thick_wall_whatever_leads_out_beside_it() {
    let mut world = World::empty(Rect::new(0.0, 0.0, 10.0, 9.0));
    for (y, doors) in [(3.0, [2.0, 6.0]), (5.0, [3.0, 7.0])] {
        let mut from = 0.0;
        for door in doors {
            world.obstacles.push(wall(from, y, door, y + 0.4));
            from = door + 1.0;
        }
        world.obstacles.push(wall(from, y, 10.0, y + 0.4));
    }
    for (x, y0, y1) in [(4.8, 0.0, 3.0), (4.8, 5.4, 9.0)] {
        world.obstacles.push(wall(x, y0, x + 0.4, y1));
    }
    let found = Spaces::of(&world).unwrap();
    assert_eq!(found.spaces.len(), 5);
    let mut middles: Vec<(f64, f64)> =
        found.doorways.iter().map(|doorway| doorway.segment.middle()).map(|p| (p.x, p.y)).collect();
    middles.sort_by(|a, b| a.0.total_cmp(&b.0));
    let expected = [(2.5, 3.2), (3.5, 5.2), (6.5, 3.2), (7.5, 5.2)];
    assert_eq!(middles.len(), expected.len(), "{middles:?}");
    for ((x, y), (expected_x, expected_y)) in middles.into_iter().zip(expected) {
        assert!((x - expected_x).abs() < 0.1 && (y - expected_y).abs() < 0.1, "{x}, {y}");
    }
}

#[test]
fn a_leg_of_a_table_at_a_wall_makes_no_doorway() {
    let mut world = wards(1.0);
    world.obstacles.push(wall(0.0, 2.4, 0.2, 2.55));
    let found = Spaces::of(&world).unwrap();
    assert_eq!((found.spaces.len(), found.doorways.len()), (5, 4));
}

#[test]
fn a_named_door_is_a_doorway_where_it_is_drawn() {
    let mut world = wards(1.0);
    let (a, b) = (Point::new(2.0, 4.1), Point::new(3.0, 4.1));
    world.named_doors.push(named("ward 1", a, b));
    // across the corridor, where no wall is
    world.named_doors.push(named("fire door", Point::new(5.0, 4.2), Point::new(5.0, 6.2)));
    let found = Spaces::of(&world).unwrap();
    let door = |number| found.doorways.iter().find(|doorway| doorway.named == Some(number)).unwrap();
    assert_eq!(door(0).segment, Segment::new(a, b));
    assert_eq!(found.spaces.len(), 6, "the fire door parts the corridor");
    let [one, other] = door(1).spaces;
    assert_ne!(one, other);
    assert_eq!(found.doorways.iter().filter(|doorway| doorway.named.is_some()).count(), 2);
}

proptest! {
    #[test]
    fn every_place_off_walls_is_in_one_space_and_doorways_lie_between_two(
        door in 0.7..1.4_f64, places in prop::collection::vec((0.3..9.7_f64, 0.3..10.1_f64), 20)
    ) {
        let world = wards(door);
        let found = Spaces::of(&world).unwrap();
        for (x, y) in places {
            let p = Point::new(x, y);
            let is_near = world.obstacles.iter().any(|of| of.shape.enclosing_rect().grown(0.1).contains(p));
            prop_assert!(is_near || found.at(p).is_some(), "{p:?}");
        }
        for doorway in &found.doorways {
            prop_assert!(doorway.spaces[0] < doorway.spaces[1] && doorway.spaces[1] < found.spaces.len());
            prop_assert!(doorway.segment.length() > 0.2);
        }
        let area: f64 = found.spaces.iter().map(|space| space.area).sum();
        let solid: f64 = world.obstacles.iter().map(|of| of.shape.enclosing_rect().area()).sum();
        prop_assert!((area + solid - 104.0).abs() < 1.0, "{area} and {solid}");
    }
}
