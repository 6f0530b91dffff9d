//! Layers on random maps, against exact distances and against a search of configuration space on a grid four times
//! finer, which shares no code with them.

mod oracle;

use std::collections::BTreeSet;

use adit_planners::geometry::{Convex, Point, Rect, Segment};
use adit_planners::layers::{Kind, Layers, State, cut_layers};
use adit_planners::world::{Area, Bridge, NamedDoor, Obstacle, Shape, World};
use oracle::Oracle;
use proptest::prelude::*;

const GRID: f64 = 0.1;
/// Far above what triangulating loses, far below what anybody draws, metres.
const ROUNDING_M: f64 = 2e-6;
/// What surely is free lies so near to a room at least, metres: about a corner the tangents meet at 1.41 times the distance
/// that a disc keeps.
const BESIDE_M: f64 = 0.05;
const BOUNDS: Rect = Rect::new(0.0, 0.0, 7.0, 5.0);

fn states() -> Vec<State> {
    let state =
        |state: &str, height, width| State { robot: None, state: state.into(), height, width, length: None };
    vec![state("STAND", 1.7, 0.6), state("SIDE-STAND", 1.7, 0.35), state("SQUAT", 1.1, 0.8)]
}

/// A coordinate, often on the grid so that walls align.
fn coordinate(limit: f64) -> impl Strategy<Value = f64> {
    prop_oneof![(0..(limit * 2.0) as i32).prop_map(|v| f64::from(v) / 2.0), 0.0..limit]
}

fn rect() -> impl Strategy<Value = Rect> {
    let size = || prop_oneof![Just(0.3), 0.2..2.5];
    (coordinate(BOUNDS.x1), coordinate(BOUNDS.y1), size(), size())
        .prop_map(|(x, y, dx, dy)| Rect::new(x, y, x + dx, y + dy))
}

fn turned(rect: Rect, about: Point, degrees: f64) -> Vec<Point> {
    let (sin, cos) = degrees.to_radians().sin_cos();
    let corners = [(rect.x0, rect.y0), (rect.x1, rect.y0), (rect.x1, rect.y1), (rect.x0, rect.y1)];
    corners.map(|(x, y)| turned_point(Point::new(x, y), about, (sin, cos))).into()
}

fn turned_point(p: Point, about: Point, (sin, cos): (f64, f64)) -> Point {
    let (dx, dy) = (p.x - about.x, p.y - about.y);
    Point::new(about.x + cos * dx - sin * dy, about.y + sin * dx + cos * dy)
}

fn obstacle() -> impl Strategy<Value = Obstacle> {
    let askew =
        (rect(), 5.0..85.0).prop_map(|(rect, degrees)| Shape::Polygon(turned(rect, rect.centre(), degrees)));
    prop_oneof![2 => rect().prop_map(Shape::Rect), 1 => askew].prop_map(|shape| Obstacle { shape })
}

fn area(shape: Shape) -> Area {
    let centre = shape.enclosing_rect().centre();
    Area { name: "area".to_owned(), kind: None, shape, centre, further: Vec::new() }
}

fn named_door(from: Point, to: Point) -> NamedDoor {
    NamedDoor { name: "door".to_owned(), kind: None, from, to, further: Vec::new() }
}

/// Areas and named doors, often along lines of the grid. They change no wall, so all that holds of layers holds with
/// them as without.
fn overlays() -> impl Strategy<Value = (Vec<Area>, Vec<NamedDoor>)> {
    let point = || (coordinate(BOUNDS.x1), coordinate(BOUNDS.y1)).prop_map(|(x, y)| Point::new(x, y));
    let door = (point(), point()).prop_map(|(from, to)| named_door(from, Point::new(to.x + 0.07, to.y)));
    let areas = prop::collection::vec(obstacle().prop_map(|obstacle| area(obstacle.shape)), 0..4);
    (areas, prop::collection::vec(door, 0..3))
}

fn worlds() -> impl Strategy<Value = World> {
    (bare_worlds(), overlays()).prop_map(|(world, (areas, named_doors))| World {
        areas,
        named_doors,
        ..world
    })
}

fn bare_worlds() -> impl Strategy<Value = World> {
    let bridge = (rect(), prop_oneof![Just(1.1), Just(1.5), Just(2.0)]);
    let bridge = bridge.prop_map(|(rect, height)| Bridge { rect, height });
    let obstacles = prop::collection::vec(obstacle(), 1..9);
    (obstacles, prop::collection::vec(bridge, 0..3), prop_oneof![Just(0.0), Just(0.07)]).prop_map(
        |(obstacles, bridges, clearance)| {
            let grid = Some(GRID);
            World { obstacles, bridges, clearance, grid, ..World::empty(BOUNDS) }
        },
    )
}

fn points() -> impl Strategy<Value = Vec<Point>> {
    let point = (0.2..BOUNDS.x1 - 0.2, 0.2..BOUNDS.y1 - 0.2).prop_map(|(x, y)| Point::new(x, y));
    prop::collection::vec(point, 8)
}

/// For each room the smallest room that is connected with it, through doors and changes.
fn components(layers: &Layers) -> Vec<usize> {
    let mut component: Vec<usize> = (0..layers.rooms.len()).collect();
    loop {
        let mut is_settled = true;
        for crossing in &layers.crossings {
            let (a, b) = (component[crossing.room1], component[crossing.room2]);
            if a != b {
                component[crossing.room1] = a.min(b);
                component[crossing.room2] = a.min(b);
                is_settled = false;
            }
        }
        if is_settled {
            return component;
        }
    }
}

/// Whether rooms not further than `reach` from the two points, in the given states, are connected.
fn is_way(layers: &Layers, component: &[usize], ends: [(usize, Point); 2], reach: f64) -> bool {
    let near = |(state, p): (usize, Point)| {
        let rooms = layers.rooms.iter().zip(component);
        rooms
            .filter(move |(room, _)| room.state == state && room.outline.distance(p) <= reach)
            .map(|(_, component)| *component)
    };
    near(ends[0]).any(|a| near(ends[1]).any(|b| a == b))
}

/// Every pair of points in every pair of states: what surely has a way has one, what surely has none has none.
fn check_ways(
    truth: &Oracle,
    layers: &Layers,
    points: &[Point],
    place: impl Fn(Point) -> Point,
) -> Result<(), TestCaseError> {
    let component = components(layers);
    let stateful = || (0..states().len()).flat_map(|state| points.iter().map(move |&p| (state, p)));
    for from in stateful() {
        for to in stateful() {
            let ends = [from, to].map(|(state, p)| (state, place(p)));
            if truth.is_surely_way(from, to) {
                prop_assert!(is_way(layers, &component, ends, BESIDE_M), "{from:?} to {to:?}");
            }
            if is_way(layers, &component, ends, 0.0) {
                prop_assert!(truth.is_perhaps_way(from, to), "{from:?} to {to:?}");
            }
        }
    }
    Ok(())
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 24, ..ProptestConfig::default() })]

    #[test]
    fn rooms_are_disjoint_and_free_throughout(world in worlds()) {
        let layers = cut_layers(&world, &states()).unwrap();
        for (i, room) in layers.rooms.iter().enumerate() {
            let state = &states()[room.state];
            let keep = state.width / 2.0 + world.clearance;
            for other in layers.rooms[..i].iter().filter(|other| other.state == room.state) {
                let common = room.outline.common(&other.outline);
                prop_assert!(common.is_none_or(|common| common.breadth() < ROUNDING_M), "{room:?} {other:?}");
            }
            for step in 0..81 {
                let (u, v) = (f64::from(step % 9) / 8.0, f64::from(step / 9) / 8.0);
                let about = room.outline.bounds();
                let p = room.outline.nearest_to(Point::new(about.x0 + u * about.dx(), about.y0 + v * about.dy()));
                let free = oracle::clearance(&world, state, p);
                prop_assert!(free >= keep - 1e-6, "{free} of {keep} at {p:?} in {room:?}");
            }
            let above = world.bridges.iter().filter(|bridge| room.outline.common(&bridge.rect.into()).is_some());
            prop_assert_eq!(room.height, above.map(|bridge| bridge.height).min_by(f64::total_cmp));
        }
    }

    #[test]
    fn every_two_rooms_with_a_common_boundary_or_overlap_have_their_crossing_or_one_beside_it(world in worlds()) {
        let layers = cut_layers(&world, &states()).unwrap();
        let mut expected = BTreeSet::new();
        for (i, a) in layers.rooms.iter().enumerate() {
            for (j, b) in layers.rooms.iter().enumerate().filter(|(j, _)| *j != i) {
                let overlap = a.outline.common(&b.outline).is_some_and(|common| common.breadth() > ROUNDING_M);
                if a.state != b.state && overlap {
                    expected.insert((i, j, Kind::Change));
                } else if a.state == b.state && i < j && have_a_side_in_common(&a.outline, &b.outline) {
                    expected.insert((i, j, Kind::Door));
                }
            }
        }
        let found: BTreeSet<_> = layers.crossings.iter().map(|c| (c.room1, c.room2, c.kind)).collect();
        prop_assert_eq!(layers.crossings.len(), found.len());
        for &(i, j, kind) in found.difference(&expected) {
            // what is broader than a rounding by little may be one or none
            let common = layers.rooms[i].outline.common(&layers.rooms[j].outline);
            prop_assert!(kind == Kind::Change && common.is_some_and(|common| common.breadth() > 0.5 * ROUNDING_M));
        }
        let is_door = |a: usize, b: usize| found.contains(&(a.min(b), a.max(b), Kind::Door));
        for &(i, j, kind) in expected.difference(&found) {
            let instead = if kind == Kind::Door {
                // what parts them is a room, as thin as a rounding
                let is_thin = |room: usize| layers.rooms[room].outline.breadth() < ROUNDING_M;
                (0..layers.rooms.len()).any(|room| is_thin(room) && is_door(i, room) && is_door(room, j))
            } else {
                // A thin overlap may be left out beside a thicker one of the same room.
                let overlap = layers.rooms[i].outline.common(&layers.rooms[j].outline).unwrap();
                prop_assert!(overlap.breadth() < 0.1 + ROUNDING_M, "{:?}", overlap);
                let mut changes = found.iter().filter(|(_, _, kind)| *kind == Kind::Change);
                changes.any(|&(a, b, _)| a == i && is_door(b, j) || b == j && is_door(a, i))
            };
            prop_assert!(instead, "{:?} {:?}", layers.rooms[i], layers.rooms[j]);
        }
    }

    #[test]
    fn points_are_joined_exactly_as_a_finer_search_says(world in worlds(), points in points()) {
        let layers = cut_layers(&world, &states()).unwrap();
        check_ways(&Oracle::new(&world, &states(), GRID), &layers, &points, |p| p)?;
    }
}

/// Points of a lattice, as far as a room holds them.
fn points_in(room: &Convex) -> impl Iterator<Item = Point> + '_ {
    let about = room.bounds();
    let count = |length: f64| (length / GRID).ceil() as u32;
    let at = move |column: u32, row: u32| {
        Point::new(about.x0 + (f64::from(column) + 0.5) * GRID, about.y0 + (f64::from(row) + 0.5) * GRID)
    };
    let (columns, rows) = (count(about.dx()), count(about.dy()));
    let all = (0..columns).flat_map(move |column| (0..rows).map(move |row| at(column, row)));
    all.filter(|&p| room.contains(p))
}

/// Whether two outlines share a part of a side, which lies opposite in the other.
fn have_a_side_in_common(a: &Convex, b: &Convex) -> bool {
    a.sides().any(|one| {
        b.sides().any(|other| {
            let along = |p: Point| one.direction().dot(p - one.a);
            let aside = [other.a, other.b].map(|p| one.direction().cross(p - one.a).abs());
            let (from, to) = (along(other.b).max(0.0), along(other.a).min(one.length()));
            aside[0].max(aside[1]) < ROUNDING_M && to - from > ROUNDING_M
        })
    })
}

/// Whether the outline passes within a micrometre, where nobody can say on which side a point lies.
fn is_on_outline(shape: &Shape, p: Point) -> bool {
    let moved = [(1.0, 0.0), (-1.0, 0.0), (0.0, 1.0), (0.0, -1.0)]
        .map(|(x, y)| Point::new(p.x + 1e-6 * x, p.y + 1e-6 * y));
    moved.iter().any(|&q| shape.contains(q) != shape.contains(p))
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 48, ..ProptestConfig::default() })]

    #[test]
    fn a_room_lies_in_an_area_whole_or_not_at_all(world in worlds()) {
        let layers = cut_layers(&world, &states()).unwrap();
        for (of, area) in world.areas.iter().enumerate() {
            for (index, room) in layers.rooms.iter().enumerate() {
                let is_in = layers.area_rooms.contains(&(index, of));
                for p in points_in(&room.outline).filter(|&p| !is_on_outline(&area.shape, p)) {
                    prop_assert_eq!(area.shape.contains(p), is_in, "{:?} of {:?}", p, room);
                }
            }
        }
    }

    /// A door from edge to edge, whatever its slope: without its rooms nothing joins what lies on either side, in any
    /// state and over any change of shape.
    #[test]
    fn nobody_gets_past_a_named_door_without_entering_it(
        world in worlds(), left in coordinate(BOUNDS.y1), right in coordinate(BOUNDS.y1)
    ) {
        let (from, to) = (Point::new(BOUNDS.x0, left), Point::new(BOUNDS.x1, right));
        let mut world = world;
        let door = world.named_doors.len();
        world.named_doors.push(named_door(from, to));
        let layers = cut_layers(&world, &states()).unwrap();
        let shut = |room: usize| layers.door_rooms.contains(&(room, door));
        let mut open = layers.clone();
        open.crossings.retain(|crossing| !shut(crossing.room1) && !shut(crossing.room2));
        let component = components(&open);
        let side = |room: usize| {
            let p = layers.rooms[room].outline.centre();
            (to.x - from.x) * (p.y - from.y) - (to.y - from.y) * (p.x - from.x) > 0.0
        };
        for room in (0..layers.rooms.len()).filter(|&room| !shut(room)) {
            prop_assert_eq!(side(room), side(component[room]), "{:?}", layers.rooms[room]);
        }
    }

    /// An area or a door that free space of a layer lies in has rooms there, however small it is.
    #[test]
    fn no_area_and_no_door_loses_its_last_room(world in worlds()) {
        let states = states();
        let with = cut_layers(&world, &states).unwrap();
        let bare = cut_layers(&World { areas: Vec::new(), named_doors: Vec::new(), ..world.clone() }, &states).unwrap();
        for (index, room) in bare.rooms.iter().enumerate() {
            for (of, area) in world.areas.iter().enumerate() {
                if points_in(&room.outline).any(|p| area.shape.contains(p) && !is_on_outline(&area.shape, p)) {
                    let kept = |&(room, area): &(usize, usize)| area == of && with.rooms[room].state == bare.rooms[index].state;
                    prop_assert!(with.area_rooms.iter().any(kept), "{:?} in {:?}", area, room);
                }
            }
            for (of, door) in world.named_doors.iter().enumerate() {
                let inside = room.outline.clip(Segment::new(door.from, door.to));
                if inside.is_some_and(|part| part.length() > ROUNDING_M && room.outline.breadth() > ROUNDING_M) {
                    let kept = |&(room, door): &(usize, usize)| door == of && with.rooms[room].state == bare.rooms[index].state;
                    prop_assert!(with.door_rooms.iter().any(kept), "{:?} in {:?}", door, room);
                }
            }
        }
    }
}

/// The same walls, the edge's among them, turned about the middle inside of larger bounds.
fn turn(world: &World, degrees: f64) -> World {
    let (about, Rect { x0, y0, x1, y1 }) = (world.bounds.centre(), world.bounds);
    let edge = [
        Rect::new(x0 - 0.5, y0 - 0.5, x0, y1 + 0.5),
        Rect::new(x1, y0 - 0.5, x1 + 0.5, y1 + 0.5),
        Rect::new(x0, y0 - 0.5, x1, y0),
        Rect::new(x0, y1, x1, y1 + 0.5),
    ];
    let angle = degrees.to_radians().sin_cos();
    let corners = |shape: &Shape| match shape {
        Shape::Rect(rect) => turned(*rect, about, degrees),
        Shape::Polygon(corners) => corners.iter().map(|&p| turned_point(p, about, angle)).collect(),
    };
    let walls = edge.into_iter().map(Shape::Rect);
    let walls = walls.chain(world.obstacles.iter().map(|obstacle| obstacle.shape.clone()));
    let obstacles = walls.map(|shape| Obstacle { shape: Shape::Polygon(corners(&shape)) }).collect();
    let bounds = Rect::new(x0 - 2.0, y0 - 3.0, x1 + 2.0, y1 + 3.0);
    World { obstacles, grid: world.grid, clearance: world.clearance, ..World::empty(bounds) }
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 10, ..ProptestConfig::default() })]

    #[test]
    fn turning_the_map_changes_no_answer(world in bare_worlds(), points in points()) {
        let mut world = world;
        world.bridges.clear();
        let truth = Oracle::new(&world, &states(), GRID);
        for degrees in [10.0, 45.0, 90.0] {
            let layers = cut_layers(&turn(&world, degrees), &states()).unwrap();
            let angle = f64::to_radians(degrees).sin_cos();
            check_ways(&truth, &layers, &points, |p| turned_point(p, BOUNDS.centre(), angle))?;
        }
    }
}
