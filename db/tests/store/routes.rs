//! Routes beyond the paper's example: several doors between two rooms, layers, places with nodes of their own.

use adit_db::door::{Door, DoorKind};
use adit_db::schema::Row;
use adit_db::tree::{End, EndKind, Start, TreeRow};
use adit_db::weight::Weight;
use adit_db::{Derived, Error, Store};

use crate::made::{Folder, Led};
use crate::paper::{self, START, door, step};

fn end(name: &str, node: i64) -> End {
    End { name: name.into(), node, kind: if node > 0 { EndKind::Room } else { EndKind::Place }, kept: true }
}

fn start(name: &str, robot: &str, tree: i64) -> Start {
    Start { name: name.into(), robot: robot.into(), tree }
}

/// Rooms d and f with a second, cheaper door between them that leads from f to d only.
#[test]
fn of_two_doors_between_the_same_rooms_the_route_names_its_own() {
    let (_folder, mut store) = paper::site();
    store
        .led()
        .transaction(|tx| {
            let mut doors = paper::doors();
            let mut chute = door(9, 6, 4, 5.0, "SLIDE", [1.0, 16.5]);
            chute.one_way = true;
            doors.push(chute);
            tx.replace_doors(&doors)?;
            tx.put_tree(6, [step(4, 6, 9, 1, 0.0, 135.0), START])?;
            tx.put_tree(4, [TreeRow { node: 4, ..START }, step(6, 4, 7, 1, 0.0, -90.0)])?;
            tx.replace_starts(&[start("f", "robot", 6), start("d", "robot", 4)])
        })
        .unwrap();
    let doors = |store: &mut Store, from: &str, to: &str| {
        let steps = store.snapshot(|tx| tx.action_sequence("robot", from, to)).unwrap();
        (steps[1].place.clone(), steps[2].cost)
    };
    assert_eq!(doors(&mut store, "f", "d"), ("9".to_owned(), 5.0));
    assert_eq!(doors(&mut store, "d", "f"), ("7".to_owned(), 27.001_901));
    assert!(store.snapshot(|tx| tx.doors()).unwrap()[8].one_way);
}

/// Two layers: the robot stands in room 1, kneels down (a change), and passes a door on its knees.
fn layered() -> (Folder, Store) {
    let (folder, mut store) = paper::site();
    let fill = |tx: &mut adit_db::Tx<'_>| {
        let mut rooms = paper::rooms();
        rooms.truncate(3);
        for (room, state) in rooms.iter_mut().zip(["STAND", "SQUAT", "SQUAT"]) {
            room.layer = Some(("robot".to_owned(), state.to_owned()));
        }
        let mut change = door(1, 2, 1, 0.5, "KNEEL", [3.0, 4.0]);
        change.kind = DoorKind::Change;
        tx.replace_rooms(&rooms)?;
        tx.replace_doors(&[change, door(2, 2, 3, 1.0, "WALK-ON-KNEE", [6.0, 4.0])])?;
        tx.clear_trees()?;
        // the start is the place `dock` in room 1, the goal the place `ward` in room 3; -3 is a second crossing of
        // door 2, entered from room 2 elsewhere than room 3's own least-cost entry
        let dock = TreeRow { node: -1, from_room: Some(1), at: Some([0.0, 0.0]), ..START };
        let from = |node, prev, door, hops, reach, leg| TreeRow {
            node,
            prev: Some(prev),
            door,
            hops,
            reach,
            leg,
            heading: Some(0.0),
            ..START
        };
        tx.put_tree(
            1,
            [
                TreeRow { from_room: Some(1), at: None, ..from(2, -1, Some(1), 1, 5.0, 5.0) },
                TreeRow { from_room: Some(2), at: Some([6.0, 4.5]), ..from(-3, 2, Some(2), 2, 17.5, 12.0) },
                TreeRow { from_room: Some(3), at: Some([8.0, 4.5]), ..from(-2, -3, None, 2, 26.5, 8.0) },
                TreeRow { from_room: Some(1), at: Some([1.0, 1.0]), ..from(1, -1, None, 0, 0.0, 0.0) },
                dock,
            ],
        )?;
        tx.replace_starts(&[start("dock", "robot", 1)])?;
        tx.replace_ends(&[end("dock", -1), end("ward", -2), end("a", 1), end("b", 2)])?;
        tx.mark_fresh()?;
        Ok::<_, Error>(())
    };
    store.led().transaction(fill).unwrap();
    (folder, store)
}

#[test]
fn by_state_the_sequence_tells_each_walk_and_each_change_of_shape() {
    let (_folder, mut store) = layered();
    let steps = store.snapshot(|tx| tx.action_sequence("robot", "dock", "ward")).unwrap();
    let read: Vec<_> = steps
        .iter()
        .map(|s| {
            (&*s.kind, &*s.place, s.state.as_deref().unwrap(), s.hardness.unwrap(), s.cost, s.x.unwrap())
        })
        .collect();
    assert_eq!(
        read,
        [
            ("room", "a", "STAND", 5.0, 5.0, 3.0),
            ("change", "1", "SQUAT", 0.5, 5.5, 3.0),
            ("room", "b", "SQUAT", 12.0, 17.5, 6.0),
            ("door", "2", "SQUAT", 1.0, 18.5, 6.0),
            ("room", "c", "SQUAT", 8.0, 26.5, 8.0),
        ]
    );
}

#[test]
fn a_goal_in_the_start_s_own_room_is_one_step() {
    let (_folder, mut store) = layered();
    store
        .snapshot(|tx| {
            for goal in ["dock", "a"] {
                let steps = tx.action_sequence("robot", "dock", goal)?;
                assert_eq!(steps.len(), 1, "{goal}");
                assert_eq!((&*steps[0].kind, &*steps[0].place, steps[0].cost), ("room", "a", 0.0));
                assert_eq!(tx.route("robot", "dock", goal)?.unwrap().status, "same_room");
            }
            assert_eq!(tx.route("robot", "dock", "ward")?.unwrap().cost, Some(26.5));
            Ok::<_, Error>(())
        })
        .unwrap();
}

#[test]
fn the_second_robot_has_routes_of_its_own() {
    let (_folder, mut store) = paper::site();
    store
        .led()
        .transaction(|tx| {
            let mut states = tx.states()?;
            let mut second = states[0].clone();
            second.robot = "cart".into();
            states.push(second);
            tx.seed(&states, &[])?;
            tx.put_tree(60, [START, TreeRow { hops: 1, ..step(4, 6, 7, 1, 0.0, 90.0) }])?;
            tx.replace_starts(&[start("f", "robot", 6), start("f", "cart", 60)])?;
            tx.mark_fresh()?;
            let status =
                |tx: &mut adit_db::Tx<'_>, robot| Ok::<_, Error>(tx.route(robot, "f", "e")?.unwrap().status);
            assert_eq!(status(tx, "robot")?, "ok");
            assert_eq!(status(tx, "cart")?, "no_route");
            assert_eq!(tx.action_sequence("cart", "f", "d")?.len(), 3);
            Ok::<_, Error>(())
        })
        .unwrap();
}

#[test]
fn a_new_weight_is_written_to_its_door_and_to_no_other() {
    let (_folder, mut store) = paper::site();
    store
        .led()
        .transaction(|tx| {
            let before = tx.doors()?;
            let weight = Weight { hardness: Derived::by(paper::WEIGH, None, 40.0), ..before[6].weight() };
            assert_eq!(tx.put_weights::<Door>([(before[6].door, &weight)])?, 1);
            let mut expected = before;
            expected[6].weigh(weight);
            assert_eq!(tx.doors()?, expected);
            Ok::<_, Error>(())
        })
        .unwrap();
}
