//! The paper's example (Abou-Ali et al., Tables 2, 3 and 7), its coordinates as reconstructed.

use adit_planners::geometry::{Point, Rect};
use adit_planners::world::{Bridge, Place, Shape};

use crate::draw::{Door, PrimeArea, Room, Route, Scene, Step, StepKind};
use adit_db::door::DoorKind;

/// Name, outline, height, action.
type RoomRow = (&'static str, [f64; 4], Option<f64>, &'static str);

const ROOMS: [RoomRow; 7] = [
    ("a", [19.1, 0.0, 29.5, 6.0], Some(4.0), "NO-ACTION"),
    ("b", [29.5, 9.6, 44.7, 16.5], Some(15.0), "WALK-ON-KNEE"),
    ("c", [62.7, 0.0, 93.7, 41.1], None, "WALK"),
    ("d", [0.0, 16.5, 44.7, 41.1], None, "WALK"),
    ("e", [29.5, 0.0, 62.7, 9.6], None, "WALK"),
    ("f", [0.0, 0.0, 19.1, 16.5], None, "WALK"),
    ("g", [44.7, 34.0, 62.7, 41.1], None, "WALK"),
];

/// Rooms, crossing point, hardness, action.
const DOORS: [(usize, usize, [f64; 2], f64, &str); 8] = [
    (0, 4, [29.5, 3.0], 10000.0, "NO-ACTION"),
    (0, 5, [19.1, 3.0], 10000.0, "NO-ACTION"),
    (1, 3, [37.1, 16.5], 37.005_533, "WALK-ON-KNEE"),
    (1, 4, [37.1, 9.6], 28.0, "WALK-ON-KNEE"),
    (2, 4, [62.7, 4.8], 39.697_794, "WALK"),
    (2, 6, [62.7, 37.55], 33.005_434, "WALK"),
    (3, 5, [9.55, 16.5], 27.001_901, "WALK"),
    (3, 6, [44.7, 37.55], 34.001_771, "WALK"),
];

const PRIME_AREAS: [(&str, [f64; 4]); 7] = [
    ("A", [0.0, 0.0, 93.7, 6.0]),
    ("B", [0.0, 34.0, 93.7, 41.1]),
    ("C", [29.5, 0.0, 93.7, 9.6]),
    ("D", [0.0, 16.5, 44.7, 41.1]),
    ("E", [0.0, 0.0, 19.1, 41.1]),
    ("F", [29.5, 0.0, 44.7, 41.1]),
    ("G", [62.7, 0.0, 93.7, 41.1]),
];

fn rect([x0, y0, x1, y1]: [f64; 4]) -> Rect {
    Rect::new(x0, y0, x1, y1)
}

/// The whole example, with the route from f to e.
pub fn scene() -> Scene {
    Scene {
        obstacles: [[19.1, 6.0, 29.5, 16.5], [44.7, 9.6, 62.7, 34.0]].map(|r| Shape::Rect(rect(r))).to_vec(),
        bridges: vec![
            Bridge { rect: rect([19.1, 0.0, 29.5, 6.0]), height: 4.0 },
            Bridge { rect: rect([29.5, 9.6, 44.7, 16.5]), height: 15.0 },
        ],
        rooms: ROOMS.map(room).to_vec(),
        doors: DOORS.iter().enumerate().map(door).collect(),
        places: vec![Place { name: "home".to_owned(), at: Point::new(9.55, 8.25) }],
        strips_x: vec![0.0, 19.1, 29.5, 44.7, 62.7, 93.7],
        strips_y: vec![0.0, 6.0, 9.6, 16.5, 34.0, 41.1],
        prime_areas: PRIME_AREAS
            .map(|(label, r)| PrimeArea { label: label.to_owned(), rect: rect(r), open: Some(true) })
            .to_vec(),
        route: Some(route()),
        actions: ["WALK", "SIDE-WALK", "WALK-ON-KNEE", "CREEP", "NO-ACTION"].map(str::to_owned).to_vec(),
        ..Scene::new("Abou-Ali et al., the example", Rect::new(0.0, 0.0, 93.7, 41.1))
    }
}

fn room((name, r, height, action): RoomRow) -> Room {
    Room {
        name: name.to_owned(),
        outline: rect(r).into(),
        state: None,
        height,
        hardness: None,
        action: Some(action.to_owned()),
    }
}

fn door(
    (i, &(room1, room2, [x, y], hardness, action)): (usize, &(usize, usize, [f64; 2], f64, &str)),
) -> Door {
    Door {
        number: i as i64 + 1,
        kind: DoorKind::Door,
        room1,
        room2,
        crossing: None,
        at: Point::new(x, y),
        hardness: Some(hardness),
        action: Some(action.to_owned()),
        passable: hardness < 10000.0,
        one_way: false,
    }
}

fn route() -> Route {
    let rows = [
        (StepKind::Room, "f", "WALK", 0.0, [9.55, 8.25]),
        (StepKind::Door, "7", "WALK", 27.001_901, [9.55, 16.5]),
        (StepKind::Room, "d", "WALK", 0.0, [22.35, 28.8]),
        (StepKind::Door, "3", "WALK-ON-KNEE", 37.005_533, [37.1, 16.5]),
        (StepKind::Room, "b", "WALK-ON-KNEE", 0.0, [37.1, 13.05]),
        (StepKind::Door, "4", "WALK-ON-KNEE", 28.0, [37.1, 9.6]),
        (StepKind::Room, "e", "WALK", 0.0, [46.1, 4.8]),
    ];
    let step = |(kind, place, action, hardness, [x, y]): (StepKind, &str, &str, f64, [f64; 2])| Step {
        kind,
        place: place.to_owned(),
        state: None,
        action: Some(action.to_owned()),
        hardness,
        to: Point::new(x, y),
        heading: None,
    };
    Route {
        start: Place { name: "f".to_owned(), at: Point::new(9.55, 8.25) },
        goal: Place { name: "e".to_owned(), at: Point::new(46.1, 4.8) },
        steps: rows.map(step).to_vec(),
        cost: 92.007_434,
    }
}
