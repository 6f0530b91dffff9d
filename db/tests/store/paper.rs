//! The example of the paper (Abou-Ali et al., Tables 2, 3, 6 and 7), with the exact values of the reconstruction.

use adit_db::area::Area;
use adit_db::conclusion::{Rule, Witness};
use adit_db::door::{Door, DoorKind, Side};
use adit_db::place::Place;
use adit_db::robot::State;
use adit_db::room::Room;
use adit_db::tree::{End, EndKind, Start, TreeRow};
use adit_db::{Derived, Result, Store, Tx};

use crate::made::{self, Folder, Led};

pub const ROBOT: &str = "robot";
pub const WEIGH: i64 = 1;
pub const WALK_IN: i64 = 2;

/// A site's folder and its database, holding the example.
pub fn site() -> (Folder, Store) {
    let (folder, mut store) = made::site();
    store.led().transaction(fill).unwrap();
    (folder, store)
}

pub fn fill(tx: &mut Tx<'_>) -> Result<()> {
    tx.seed(&states(), &[])?;
    let rule = |rule, name: &str, line| Rule {
        rule,
        name: name.into(),
        version: "1".into(),
        file: Some("doors.rhai".into()),
        line: Some(line),
    };
    tx.replace_rules(
        &[rule(WEIGH, "weigh a door", 3), rule(WALK_IN, "walk in a room", 20)],
        &[Witness { witness: 1, facts: r#"{"through":"STAND"}"#.into() }],
    )?;
    tx.replace_places(&[Place { place: "home".into(), x: 9.55, y: 8.25 }])?;
    tx.replace_areas(&X_EDGES, &Y_EDGES, &areas())?;
    tx.replace_rooms(&rooms())?;
    tx.replace_doors(&doors())?;
    trees(tx)?;
    tx.mark_fresh()
}

fn states() -> Vec<State> {
    let state = |position, state: &str, action: &str, height, width, hardness| State {
        robot: ROBOT.into(),
        state: state.into(),
        action: action.into(),
        height,
        width,
        length: None,
        hardness,
        position,
        speed: None,
        power: None,
    };
    vec![
        state(0, "STAND", "WALK", 20.0, 3.0, 1.0),
        state(1, "SIDE-STAND", "SIDE-WALK", 20.0, 1.0, 2.0),
        state(2, "SQUAT", "WALK-ON-KNEE", 10.0, 5.0, 4.0),
        state(3, "LIE-FACE-DOWN", "CREEP", 5.0, 5.0, 8.0),
        state(4, "IMPOSSIBLE", "NO-ACTION", 0.0, 0.0, 10000.0),
    ]
}

const X_EDGES: [f64; 6] = [0.0, 19.1, 29.5, 44.7, 62.7, 93.7];
const Y_EDGES: [f64; 6] = [0.0, 6.0, 9.6, 16.5, 34.0, 41.1];

/// Table 2, as strips.
fn areas() -> Vec<Area> {
    let strips = [
        ((4, 4), (0, 4)),
        ((2, 2), (0, 4)),
        ((2, 4), (0, 1)),
        ((0, 0), (0, 4)),
        ((0, 2), (3, 4)),
        ((0, 4), (4, 4)),
        ((0, 4), (0, 0)),
    ];
    let area = |(area, (x, y))| Area { area, x, y, open: Derived::default() };
    (1..).zip(strips).map(area).collect()
}

/// Table 3.
pub fn rooms() -> Vec<Room> {
    let room = |room, name: &str, rect, height, width, action: &str| Room {
        room,
        name: name.into(),
        layer: None,
        facing: None,
        rect,
        outline: None,
        radius: None,
        berth: None,
        berth_cost: None,
        height,
        width,
        space: None,
        hardness: Derived::default(),
        action: Derived::by(WALK_IN, None, action.to_owned()),
        passable: Derived { value: Some(true), rule: None, witness: None },
        measures: None,
    };
    vec![
        room(1, "a", [19.1, 0.0, 29.5, 6.0], Some(4.0), 6.0, "NO-ACTION"),
        room(2, "b", [29.5, 9.6, 44.7, 16.5], Some(15.0), 6.9, "WALK-ON-KNEE"),
        room(3, "c", [62.7, 0.0, 93.7, 41.1], None, 31.0, "WALK"),
        room(4, "d", [0.0, 16.5, 44.7, 41.1], None, 24.6, "WALK"),
        room(5, "e", [29.5, 0.0, 62.7, 9.6], None, 9.6, "WALK"),
        room(6, "f", [0.0, 0.0, 19.1, 16.5], None, 16.5, "WALK"),
        room(7, "g", [44.7, 34.0, 62.7, 41.1], None, 7.1, "WALK"),
    ]
}

/// The eight doors, weighed as in Table 6.
pub fn doors() -> Vec<Door> {
    vec![
        door(1, 1, 5, 10000.0, "NO-ACTION", [29.5, 3.0]),
        door(2, 1, 6, 10000.0, "NO-ACTION", [19.1, 3.0]),
        door(3, 2, 4, 37.005_533, "WALK-ON-KNEE", [37.1, 16.5]),
        door(4, 2, 5, 28.0, "WALK-ON-KNEE", [37.1, 9.6]),
        door(5, 3, 5, 39.697_794, "WALK", [62.7, 4.8]),
        door(6, 3, 7, 33.005_434, "WALK", [62.7, 37.55]),
        door(7, 4, 6, 27.001_901, "WALK", [9.55, 16.5]),
        door(8, 4, 7, 34.001_771, "WALK", [44.7, 37.55]),
    ]
}

pub fn door(door: i64, room1: i64, room2: i64, hardness: f64, action: &str, at: [f64; 2]) -> Door {
    let side = |room| Side { room, height: None, width: Some(6.0), distance: Some(5.2) };
    Door {
        door,
        kind: DoorKind::Door,
        side1: side(room1),
        side2: side(room2),
        at,
        width: 6.0,
        segment: [at[0], at[1], at[0], at[1]],
        hardness: Derived::by(WEIGH, Some(1), hardness),
        action: Derived::by(WEIGH, Some(1), action.to_owned()),
        passable: Derived::by(WEIGH, None, hardness < 10000.0),
        measures: None,
        one_way: false,
    }
}

pub const START: TreeRow = TreeRow {
    node: 6,
    prev: None,
    from_room: None,
    door: None,
    hops: 0,
    reach: 0.0,
    leg: 0.0,
    walked: None,
    at: Some([9.55, 8.25]),
    heading: None,
    distance: None,
    clearance: None,
    bend: true,
};

/// A step of the paper's modes: doors bear the cost, rooms are the nodes.
pub fn step(node: i64, prev: i64, door: i64, hops: i64, reach: f64, heading: f64) -> TreeRow {
    TreeRow {
        node,
        prev: Some(prev),
        door: Some(door),
        hops,
        reach,
        at: None,
        heading: Some(heading),
        ..START
    }
}

/// What Dijkstra finds from room f; the place `home` lies in it.
fn trees(tx: &mut Tx<'_>) -> Result<()> {
    let to_d = 27.001_901;
    let to_b = to_d + 37.005_533;
    let to_g = to_d + 34.001_771;
    let tree = [
        step(2, 4, 3, 2, to_d, 0.0),
        step(3, 7, 6, 3, to_g, 0.0),
        step(4, 6, 7, 1, 0.0, 90.0),
        step(5, 2, 4, 3, to_b, -90.0),
        START,
        step(7, 4, 8, 2, to_d, 30.92),
    ];
    tx.put_tree(6, tree)?;
    let start = |name: &str| Start { name: name.into(), robot: ROBOT.into(), tree: 6 };
    tx.replace_starts(&[start("f"), start("home")])?;
    let room = |room: Room| End { name: room.name, node: room.room, kind: EndKind::Room, kept: true };
    let mut ends: Vec<End> = rooms().into_iter().map(room).collect();
    ends.push(End { name: "home".into(), node: 6, kind: EndKind::Place, kept: true });
    tx.replace_ends(&ends)
}
