//! Rooms that are triangles, as any polygon falls into: ways through them are as short as over a visibility graph.

use std::collections::BTreeMap;

use adit_planners::geometry::{Convex, Point, Segment};
use adit_planners::routes::{Berth, Crossing, RoomIndex, RouteDoor, RouteGraph, RouteRoom, Walking};
use proptest::prelude::*;
use spade::{DelaunayTriangulation, Point2, Triangulation};

use super::floors::{SIDE, check_legs, holding, point, shortest, way};

/// A room by its corners, counterclockwise, by number.
type Room = Vec<usize>;

/// A hall in triangles of which some are solid; triangles that make a convex room together are put together here and there.
#[derive(Debug)]
struct Hall {
    points: Vec<Point>,
    rooms: Vec<Room>,
}

impl Hall {
    fn new(inner: &[Point], solid: &[bool], merged: &[bool]) -> Self {
        let corners = [(0.0, 0.0), (SIDE, 0.0), (SIDE, SIDE), (0.0, SIDE)].map(|(x, y)| Point::new(x, y));
        let all = inner.iter().chain(&corners).map(|p| Point2::new(p.x, p.y)).collect();
        let cut = DelaunayTriangulation::<Point2<f64>>::bulk_load_stable(all).unwrap();
        let points = cut.vertices().map(|v| Point::new(v.position().x, v.position().y)).collect();
        let free = cut.inner_faces().zip(solid.iter().cycle()).filter(|(_, solid)| !**solid);
        let rooms = free.map(|(face, _)| face.vertices().map(|v| v.index()).to_vec()).collect();
        let mut hall = Self { points, rooms };
        for (number, _) in merged.iter().enumerate().filter(|(_, merged)| **merged) {
            hall.merge(number);
        }
        hall
    }

    /// Puts a room together with a neighbour where that is convex.
    fn merge(&mut self, room: usize) {
        let Some(one) = self.rooms.get(room).cloned() else { return };
        for (other, two) in self.rooms.iter().enumerate().filter(|(other, _)| *other != room) {
            let Some([a, b]) = shared(&one, two) else { continue };
            let past = |of: &Room, first: usize| {
                let begin = of.iter().position(|&p| p == first).unwrap();
                of.iter().cycle().skip(begin).take(of.len()).copied().collect::<Room>()
            };
            // one leads from b round to a, two from a round to b
            let mut both = past(&one, b);
            both.extend(&past(two, a)[1..two.len() - 1]);
            if self.is_convex(&both) {
                self.rooms[room] = both;
                self.rooms.remove(other);
                return;
            }
        }
    }

    fn is_convex(&self, room: &Room) -> bool {
        let count = room.len();
        let at = |number: usize| self.points[room[number % count]];
        (0..count).all(|i| (at(i + 1) - at(i)).cross(at(i + 2) - at(i + 1)) > 1e-6)
    }

    fn graph(&self) -> RouteGraph {
        let room = |room: &Room| RouteRoom {
            outline: Convex::new(room.iter().map(|&corner| self.points[corner]).collect()),
            radius: None,
            berth: Berth::default(),
            walking: Walking::PerMetre(1.0),
        };
        let mut doors = Vec::new();
        for (number, one) in self.rooms.iter().enumerate() {
            for (other, two) in self.rooms.iter().enumerate().skip(number + 1) {
                let Some([a, b]) = shared(one, two) else { continue };
                let segment = Segment::new(self.points[a], self.points[b]);
                doors.push(RouteDoor {
                    door: doors.len() as u32 + 1,
                    room1: RoomIndex::new(number),
                    room2: RoomIndex::new(other),
                    crossing: Crossing::Through(segment),
                    at: segment.middle(),
                    hardness: Some(0.0),
                    passable: true,
                    one_way: false,
                });
            }
        }
        RouteGraph::new(self.rooms.iter().map(room).collect(), doors)
    }

    /// Whether rooms meet in a corner with solid ground between them on both sides: nobody passes there, which the graph of
    /// what sees what does not know.
    fn has_pinch(&self) -> bool {
        (0..self.points.len()).any(|corner| {
            let around: Vec<&Room> = self.rooms.iter().filter(|room| room.contains(&corner)).collect();
            let mut sides: BTreeMap<[usize; 2], usize> = BTreeMap::new();
            for room in &around {
                for (a, b) in room.iter().zip(room.iter().cycle().skip(1)) {
                    if *a == corner || *b == corner {
                        *sides.entry([*a.min(b), *a.max(b)]).or_default() += 1;
                    }
                }
            }
            // each fan of rooms has two sides of its own
            sides.values().filter(|count| **count == 1).count() > 2
        })
    }
}

/// The side that two rooms share, as the first one has it.
fn shared(one: &Room, two: &Room) -> Option<[usize; 2]> {
    let sides = |of: &Room| -> Vec<[usize; 2]> {
        of.iter().zip(of.iter().cycle().skip(1)).map(|(&a, &b)| [a, b]).collect()
    };
    let others = sides(two);
    sides(one).into_iter().find(|&[a, b]| others.contains(&[b, a]))
}

proptest! {
    #![proptest_config(ProptestConfig {
        cases: std::env::var("CASES").map_or(96, |cases| cases.parse().unwrap()),
        max_global_rejects: 100_000,
        ..ProptestConfig::default()
    })]

    #[test]
    fn a_way_through_triangles_and_other_polygons_is_as_short_as_over_a_visibility_graph(
        inner in prop::collection::vec(point(), 3..22),
        solid in prop::collection::vec(prop::bool::weighted(0.3), 1..40),
        merged in prop::collection::vec(any::<bool>(), 0..30), from in point(), to in point()
    ) {
        let hall = Hall::new(&inner, &solid, &merged);
        let graph = hall.graph();
        prop_assume!(!holding(&graph, from).is_empty() && !holding(&graph, to).is_empty() && !hall.has_pinch());
        let (least, way) = (shortest(&graph, &hall.points, from, to), way(&graph, from, to));
        prop_assert_eq!(least.is_some(), way.is_some());
        if let (Some(least), Some(way)) = (least, way) {
            check_legs(&graph, &way, from, to)?;
            prop_assert!((way.cost - least).abs() < 1e-6 * least.max(1.0), "{} for {least}", way.cost);
        }
    }
}
