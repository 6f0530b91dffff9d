//! A building of square rooms.

use adit_planners::geometry::Rect;
use adit_planners::routes::{Berth, RoomIndex, RouteDoor, RouteGraph, RouteRoom, Walking};

/// Rooms of 4 m in a square of `side` by `side`, each joined to its right and its upper neighbour.
pub fn building(side: usize, walking: Walking) -> RouteGraph {
    let corner = |i: usize| 4.0 * i as f64;
    let square = |x: usize, y: usize| Rect::new(corner(x), corner(y), corner(x + 1), corner(y + 1));
    let rooms = (0..side * side)
        .map(|i| RouteRoom {
            outline: square(i % side, i / side).into(),
            radius: None,
            berth: Berth::default(),
            walking,
        })
        .collect();
    let mut doors = Vec::new();
    for room in 0..side * side {
        let (x, y) = (room % side, room / side);
        let right = (x + 1 < side)
            .then(|| (room + 1, Rect::new(corner(x + 1), corner(y), corner(x + 1), corner(y + 1))));
        let upper = (y + 1 < side)
            .then(|| (room + side, Rect::new(corner(x), corner(y + 1), corner(x + 1), corner(y + 1))));
        for (room2, crossing) in [right, upper].into_iter().flatten() {
            let door = doors.len() as u32 + 1;
            // a spread of weights that no cache or tie helps with (Knuth's multiplicative hash)
            let hardness = Some(1.0 + f64::from(door.wrapping_mul(2_654_435_761) >> 24));
            let at = crossing.centre();
            doors.push(RouteDoor {
                door,
                room1: RoomIndex::new(room),
                room2: RoomIndex::new(room2),
                crossing: crossing.into(),
                at,
                hardness,
                passable: true,
                one_way: false,
            });
        }
    }
    RouteGraph::new(rooms, doors)
}
