//! Bodies that are longer than wide: layers by facing, against exact geometry.

use adit_planners::geometry::{Point, Rect};
use adit_planners::layers::{Crossing, Kind, KnownLayers, Layers, Room, State, cut_layers, cut_layers_anew};
use adit_planners::world::{Area, Bridge, Obstacle, Occupancy, Shape, World};
use geo::{Coord, Distance, Euclidean, LineString, Polygon, Translate};
use proptest::prelude::*;

const BOUNDS: Rect = Rect::new(0.0, 0.0, 6.0, 4.0);

fn state(state: &str, width: f64, length: Option<f64>) -> State {
    State { robot: None, state: state.into(), height: 1.7, width, length }
}

fn world(obstacles: impl IntoIterator<Item = Shape>) -> World {
    let obstacles = obstacles.into_iter().map(|shape| Obstacle { shape }).collect();
    World { obstacles, grid: Some(0.02), ..World::empty(BOUNDS) }
}

/// A wall from below to above at x = 3 with a gap of `wide` metres.
fn gap(wide: f64) -> World {
    let rect = |y0, y1| Shape::Rect(Rect::new(2.9, y0, 3.1, y1));
    world([rect(0.0, 2.0), rect(2.0 + wide, 4.0)])
}

fn outline(shape: &Shape) -> Polygon<f64> {
    shape.to_geo()
}

/// The body about a point, facing so many degrees.
fn body(state: &State, at: Point, degrees: f64) -> Polygon<f64> {
    let (along, across) = (state.length.unwrap() / 2.0, state.width / 2.0);
    let (sin, cos) = degrees.to_radians().sin_cos();
    let corner = |(u, v): (f64, f64)| Coord { x: cos * u - sin * v, y: sin * u + cos * v };
    let corners = [(along, across), (-along, across), (-along, -across), (along, -across)];
    let ring: Vec<Coord<f64>> = corners.map(corner).into();
    Polygon::new(LineString::new(ring), Vec::new()).translate(at.x, at.y)
}

/// By how much the body overlaps nothing: whether it may be there, but for a thousandth of a millimetre.
fn is_free(world: &World, state: &State, at: Point, degrees: f64) -> bool {
    let slimmer =
        State { width: state.width - 2e-6, length: state.length.map(|l| l - 2e-6), ..state.clone() };
    let body = body(&slimmer, at, degrees);
    let b = world.bounds;
    let inside = body.exterior().coords().all(|c| b.x0 <= c.x && c.x <= b.x1 && b.y0 <= c.y && c.y <= b.y1);
    inside && world.obstacles.iter().all(|o| Euclidean.distance(&body, &outline(&o.shape)) > 0.0)
}

fn points_of(rect: Rect) -> impl Iterator<Item = Point> {
    (0..25).map(move |step| {
        let (u, v) = (f64::from(step % 5) / 4.0, f64::from(step / 5) / 4.0);
        Point::new(rect.x0 + u * rect.dx(), rect.y0 + v * rect.dy())
    })
}

/// For each room the number of its connected part.
fn parts(layers: &Layers) -> Vec<usize> {
    let mut part: Vec<usize> = (0..layers.rooms.len()).collect();
    loop {
        let before = part.clone();
        for Crossing { room1, room2, .. } in &layers.crossings {
            let least = part[*room1].min(part[*room2]);
            (part[*room1], part[*room2]) = (least, least);
        }
        if before == part {
            return part;
        }
    }
}

fn is_way(layers: &Layers, from: Point, to: Point) -> bool {
    let parts = parts(layers);
    let at = |p: Point| {
        let rooms = layers.rooms.iter().zip(&parts).filter(move |(room, _)| room.outline.contains(p));
        rooms.map(|(_, part)| *part).collect::<Vec<_>>()
    };
    at(from).iter().any(|part| at(to).contains(part))
}

const LEFT: Point = Point { x: 1.0, y: 1.0 };
const RIGHT: Point = Point { x: 5.0, y: 3.0 };

#[test]
fn a_body_side_steps_through_a_gap_that_stops_its_disc() {
    let long = state("SIDE-STEP", 0.3, Some(0.6));
    assert!(is_way(&cut_layers(&gap(0.4), &[long]).unwrap(), LEFT, RIGHT));
    let broad = state("SIDE-STEP", 0.6, Some(0.3));
    assert!(
        is_way(&cut_layers(&gap(0.4), &[broad]).unwrap(), LEFT, RIGHT),
        "whichever side is called length"
    );
    let disc = state("WALK", 0.6, None);
    assert!(!is_way(&cut_layers(&gap(0.4), std::slice::from_ref(&disc)).unwrap(), LEFT, RIGHT));
    assert!(is_way(&cut_layers(&gap(0.7), &[disc]).unwrap(), LEFT, RIGHT));
}

#[test]
fn a_body_that_must_turn_and_has_no_room_to_does_not_pass() {
    let long = [state("LONG", 0.3, Some(1.4))];
    // A corridor 0.5 m wide with a right angle: the body fits along both legs, and does not turn between them.
    let corner = |wide: f64| world([Shape::Rect(Rect::new(0.0, wide, 6.0 - wide, 4.0))]);
    let (start, goal) = (Point::new(1.0, 0.25), Point::new(5.75, 3.0));
    assert!(!is_way(&cut_layers(&corner(0.5), &long).unwrap(), start, goal));
    let wide = cut_layers(&corner(1.6), &long).unwrap();
    assert!(is_way(&wide, Point::new(1.0, 0.8), Point::new(5.2, 3.0)), "where there is room it turns");
}

#[test]
fn rooms_are_numbered_by_facing_and_turns_lead_to_the_next_one() {
    let layers = cut_layers(&world([]), &[state("LONG", 0.3, Some(0.6)), state("WALK", 0.4, None)]).unwrap();
    let facings: Vec<_> = layers.rooms.iter().map(|room| room.facing).collect();
    let expected = (0..8).map(|k| Some(f64::from(k) * 22.5)).chain([None]).collect::<Vec<_>>();
    let mut distinct = facings.clone();
    distinct.dedup();
    assert_eq!(distinct, expected);
    for Crossing { kind, room1, room2, .. } in &layers.crossings {
        let (a, b): (&Room, &Room) = (&layers.rooms[*room1], &layers.rooms[*room2]);
        if let (Kind::Change, Some(a), Some(b)) = (kind, a.facing, b.facing) {
            let apart = (a - b).abs().min(180.0 - (a - b).abs());
            assert!((apart - 22.5).abs() < 1e-9, "{a} to {b}");
        }
    }
}

#[test]
fn a_pixel_map_is_kept_clear_of_as_a_drawn_one() {
    let drawn = gap(0.4);
    let (columns, rows, resolution) = (120, 80, 0.05);
    let mut blocked = vec![false; columns * rows];
    for (cell, blocked) in blocked.iter_mut().enumerate() {
        let p = Point::new((cell % columns) as f64 * 0.05 + 0.025, (cell / columns) as f64 * 0.05 + 0.025);
        *blocked = drawn.obstacles.iter().any(|obstacle| obstacle.shape.contains(p));
    }
    let occupancy = Some(Occupancy { origin: Point::default(), resolution, columns, rows, blocked });
    let pictured = World { occupancy, ..World::empty(BOUNDS) };
    assert!(is_way(&cut_layers(&pictured, &[state("SIDE-STEP", 0.3, Some(0.6))]).unwrap(), LEFT, RIGHT));
    assert!(!is_way(&cut_layers(&pictured, &[state("SIDE-STEP", 0.45, Some(0.6))]).unwrap(), LEFT, RIGHT));
}

#[test]
fn only_what_changed_in_size_is_cut_again() {
    let mut world = world([]);
    world.bridges.push(Bridge { rect: Rect::new(2.0, 0.0, 2.5, 4.0), height: 1.5 });
    let mut fleet: Vec<State> = [("cart", 0.6), ("cart", 0.8), ("dog", 0.6)]
        .map(|(robot, width)| State { robot: Some(robot.into()), ..state("ROLL", width, None) })
        .into();
    let known = KnownLayers::default();
    let first = cut_layers_anew(&world, &fleet, &[], &known).unwrap();
    assert_eq!(known.cut(), 2, "cart and dog share the layer of 0.6 m");
    let robots: Vec<_> = first.rooms.iter().map(|room| room.state).collect();
    assert!((0..3).all(|state| robots.contains(&state)), "and each has rooms of its own");
    fleet[1].width = 0.9;
    let second = cut_layers_anew(&world, &fleet, &[], &known).unwrap();
    assert_eq!(known.cut(), 3);
    assert_eq!(second, cut_layers(&world, &fleet).unwrap());
    fleet[1].height = 1.6;
    cut_layers_anew(&world, &fleet, &[], &known).unwrap();
    assert_eq!(known.cut(), 3, "what no bridge tells apart is of the same size");
    world.obstacles.push(Obstacle { shape: Shape::Rect(Rect::new(1.0, 1.0, 1.5, 1.5)) });
    cut_layers_anew(&world, &fleet, &[], &known).unwrap();
    assert_eq!(known.cut(), 5, "another map, other layers");
}

fn obstacles() -> impl Strategy<Value = Vec<Shape>> {
    let rect =
        (0.0..6.0, 0.0..4.0, 0.2..1.8, 0.2..1.8).prop_map(|(x, y, dx, dy)| Rect::new(x, y, x + dx, y + dy));
    let shape = (rect, prop_oneof![Just(0.0), 5.0..85.0]).prop_map(|(rect, degrees): (Rect, f64)| {
        if degrees == 0.0 {
            return Shape::Rect(rect);
        }
        let (c, (sin, cos)) = (rect.centre(), degrees.to_radians().sin_cos());
        let corners = [(rect.x0, rect.y0), (rect.x1, rect.y0), (rect.x1, rect.y1), (rect.x0, rect.y1)];
        let turned = |(x, y): (f64, f64)| {
            Point::new(c.x + cos * (x - c.x) - sin * (y - c.y), c.y + sin * (x - c.x) + cos * (y - c.y))
        };
        Shape::Polygon(corners.map(turned).into())
    });
    prop::collection::vec(shape, 1..6)
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 12, ..ProptestConfig::default() })]

    /// Where sizes, areas and walls come and go, what is taken from before is what would be cut.
    #[test]
    fn layers_that_are_known_are_those_that_would_be_cut(
        shapes in obstacles(),
        steps in prop::collection::vec((0..4_usize, 0.3..0.8f64, (0.5..4.0f64, 0.5..3.0f64)), 1..6),
    ) {
        let mut world = world(shapes);
        let mut states = vec![state("WALK", 0.5, None), state("LIE", 0.3, Some(0.7)), state("SPREAD", 0.8, None)];
        let known = KnownLayers::default();
        for (kind, metres, (x, y)) in steps {
            let rect = Rect::new(x, y, x + metres, y + 1.0);
            match kind {
                0 => states[0].width = metres,
                1 => states[1].length = Some(metres),
                2 => world.areas.push(Area {
                    name: format!("area {}", world.areas.len()),
                    kind: None,
                    shape: Shape::Rect(rect),
                    centre: rect.centre(),
                    further: Vec::new(),
                }),
                _ => world.obstacles.push(Obstacle { shape: Shape::Rect(rect) }),
            }
            let whole: Vec<usize> = (0..world.areas.len()).step_by(2).collect();
            let taken = cut_layers_anew(&world, &states, &whole, &known);
            prop_assert_eq!(taken, cut_layers_anew(&world, &states, &whole, &KnownLayers::default()));
        }
    }

    /// The body is free at every point of a room at its facing, and at every point of a turn at every heading between.
    #[test]
    fn rooms_and_turns_are_free_throughout(shapes in obstacles(), length in 0.5..1.2f64) {
        let world = World { grid: Some(0.05), ..world(shapes) };
        let long = state("LONG", 0.3, Some(length));
        let layers = cut_layers(&world, std::slice::from_ref(&long)).unwrap();
        for room in &layers.rooms {
            for p in points_of(room.outline.bounds()).filter(|&p| room.outline.contains(p)) {
                prop_assert!(is_free(&world, &long, p, room.facing.unwrap()), "{p:?} in {room:?}");
            }
        }
        for Crossing { kind, room1, room2, across, .. } in &layers.crossings {
            if *kind == Kind::Change && room1 < room2 {
                let [from, to] = [room1, room2].map(|room| layers.rooms[*room].facing.unwrap());
                let by = if to - from > 90.0 { to - from - 180.0 } else { to - from };
                prop_assert!((by.abs() - 22.5).abs() < 1e-9);
                for p in points_of(across.bounds()).step_by(4) {
                    for tenth in 0..=10 {
                        let degrees = from + by * f64::from(tenth) / 10.0;
                        prop_assert!(is_free(&world, &long, p, degrees), "{p:?} at {degrees}");
                    }
                }
            }
        }
    }

    /// A quarter turn of the map turns the rooms' reachability with it.
    #[test]
    fn a_quarter_turn_of_the_map_changes_no_answer(shapes in obstacles()) {
        let on_grid = |shape: &Shape| {
            let r = shape.enclosing_rect();
            let round = |v: f64| (v * 10.0).round() / 10.0;
            Rect::new(round(r.x0), round(r.y0), round(r.x1) + 0.1, round(r.y1) + 0.1)
        };
        let rects: Vec<Rect> = shapes.iter().map(on_grid).collect();
        let straight = World { grid: Some(0.05), ..world(rects.iter().copied().map(Shape::Rect)) };
        let turned = |p: Point| Point::new(4.0 - p.y, p.x);
        let turn = |r: &Rect| Shape::Rect(Rect::new(4.0 - r.y1, r.x0, 4.0 - r.y0, r.x1));
        let obstacles = rects.iter().map(|r| Obstacle { shape: turn(r) }).collect();
        let bounds = Rect::new(0.0, 0.0, 4.0, 6.0);
        let across = World { obstacles, grid: Some(0.05), ..World::empty(bounds) };
        let long = [state("LONG", 0.3, Some(0.7))];
        let (a, b) = (cut_layers(&straight, &long).unwrap(), cut_layers(&across, &long).unwrap());
        let inner: Vec<Point> = (0..12).map(|i| Point::new(0.525 + f64::from(i % 4) * 1.6, 0.525 + f64::from(i / 4) * 1.4)).collect();
        for &from in &inner {
            for &to in &inner {
                let keep = |p: Point| straight.obstacles.iter().all(|o| o.shape.enclosing_rect().nearest_to(p).distance(p) > 0.7);
                if keep(from) && keep(to) {
                    prop_assert_eq!(is_way(&a, from, to), is_way(&b, turned(from), turned(to)), "{:?} to {:?}", from, to);
                }
            }
        }
    }
}
