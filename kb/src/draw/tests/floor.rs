//! Floors of any size: a grid of rooms with doors between neighbours, and a route along a diagonal.

use adit_planners::geometry::{Point, Rect};
use adit_planners::world::{Bridge, Place, Shape};

use super::{ALL, picture};
use crate::draw::png::parse;
use crate::draw::{Door, Room, Route, Scene, Step, StepKind};
use adit_db::door::DoorKind;

/// A floor of `side` x `side` rooms of 5 m x 4 m, of two states, walls between them.
pub fn floor(side: usize) -> Scene {
    let cell = |i: usize, j: usize| {
        let (x, y) = (i as f64 * 5.0, j as f64 * 4.0);
        Rect::new(x + 0.15, y + 0.15, x + 4.85, y + 3.85)
    };
    let mut scene = Scene::new(
        &format!("{} rooms", side * side),
        Rect::new(0.0, 0.0, side as f64 * 5.0, side as f64 * 4.0),
    );
    for j in 0..side {
        for i in 0..side {
            let r = cell(i, j);
            scene.rooms.push(Room {
                name: crate::draw::text::letters(j * side + i),
                outline: r.into(),
                state: Some("STAND".to_owned()),
                height: None,
                hardness: Some(1.0),
                action: Some("WALK".to_owned()),
            });
            scene.obstacles.push(Shape::Rect(Rect::new(r.x0, r.y1, r.x1 - 1.0, r.y1 + 0.3)));
            scene.obstacles.push(Shape::Rect(Rect::new(r.x1, r.y0, r.x1 + 0.3, r.y1 - 1.0)));
            for (di, dj, at) in [(1, 0, [r.x1 + 0.15, r.y1 - 0.5]), (0, 1, [r.x1 - 0.5, r.y1 + 0.15])] {
                if i + di < side && j + dj < side {
                    let [x, y] = at;
                    let (h, v) = (0.5 * dj as f64, 0.5 * di as f64);
                    scene.doors.push(Door {
                        number: scene.doors.len() as i64 + 1,
                        kind: DoorKind::Door,
                        room1: j * side + i,
                        room2: (j + dj) * side + i + di,
                        crossing: Some(Rect::new(x - h, y - v, x + h, y + v).into()),
                        at: Point::new(x, y),
                        hardness: Some(((i * 7 + j * 3) % 11) as f64),
                        action: Some("WALK".to_owned()),
                        passable: (i + 2 * j) % 17 != 0,
                        one_way: (i + j) % 13 == 5,
                    });
                }
            }
        }
    }
    let low = cell(side / 2, side / 2);
    scene.bridges.push(Bridge { rect: Rect::new(low.x0, low.y0 + 1.0, low.x1, low.y0 + 2.0), height: 1.3 });
    scene.places = vec![Place { name: "store".to_owned(), at: cell(0, side - 1).centre() }];
    scene.route = Some(diagonal(side, cell));
    scene
}

fn diagonal(side: usize, cell: impl Fn(usize, usize) -> Rect) -> Route {
    let mut steps = Vec::new();
    for k in 0..side {
        let low = k == side / 2;
        let (state, action) = if low { ("SQUAT", "WALK-ON-KNEE") } else { ("STAND", "WALK") };
        let mut step = |kind, place: String, to: Point| {
            steps.push(Step {
                kind,
                place,
                state: Some(state.to_owned()),
                action: Some(action.to_owned()),
                hardness: 3.0,
                to,
                heading: Some(90.0),
            });
        };
        if low || k == side / 2 + 1 {
            let before = cell(k - 1, k).centre();
            step(StepKind::Change, String::new(), before);
        }
        step(StepKind::Room, crate::draw::text::letters(k * side + k), cell(k, k).centre());
        if k + 1 < side {
            step(StepKind::Door, "1".to_owned(), cell(k, k + 1).centre());
        }
    }
    Route {
        start: Place { name: "dock".to_owned(), at: cell(0, 0).centre() },
        goal: Place { name: "ward 6".to_owned(), at: cell(side - 1, side - 1).centre() },
        steps,
        cost: 123.4,
    }
}

#[test]
fn hundreds_of_rooms_keep_their_names() {
    let svg = picture("rooms-700", &floor(27), ALL);
    let named = floor(27).rooms.iter().filter(|room| svg.contains(&format!(">{}</text>", room.name))).count();
    assert!(named > 600, "{named} of 729 rooms have their names");
}

#[test]
fn thousands_of_rooms_make_a_picture_of_sane_size() {
    let svg = picture("rooms-5000", &floor(71), ALL);
    assert!(svg.len() < 4_000_000, "{} bytes", svg.len());
    parse(&svg).unwrap();
}

#[test]
fn twelve_thousand_obstacles_are_one_path() {
    let mut scene = Scene::new("cells", Rect::new(0.0, 0.0, 120.0, 100.0));
    let cell = |k: usize| {
        let (x, y) = ((k % 120) as f64, (k / 120) as f64);
        Shape::Rect(Rect::new(x, y, x + 0.7, y + 0.5))
    };
    scene.obstacles = (0..12_000).map(cell).collect();
    let svg = picture("obstacles-12000", &scene, "map");
    assert!(svg.matches("<path").count() == 1 && svg.len() < 600_000, "{} bytes", svg.len());
}

#[test]
fn a_graph_of_hundreds_of_rooms_is_drawn() {
    parse(&picture("graph-700", &floor(27), "graph")).unwrap();
    parse(&picture("weighted-100", &floor(10), "weighted,legend")).unwrap();
}
