//! A graph of rooms and doors, its least-cost trees, and a database filled with both.

use std::cmp::Reverse;
use std::collections::BinaryHeap;

use adit_db::conclusion::Rule;
use adit_db::door::{Door, DoorKind, Side};
use adit_db::robot::State;
use adit_db::room::Room;
use adit_db::tree::{End, EndKind, Start, TreeRow};
use adit_db::{Derived, Result, Store};

const ROBOT: &str = "robot";

/// A door between rooms `a` and `b`, numbered from 0.
#[derive(Clone, Copy)]
pub struct Edge {
    pub a: usize,
    pub b: usize,
    pub hardness: f64,
    pub one_way: bool,
}

/// Rooms 0 to `rooms` - 1 and the doors between them.
pub struct Graph {
    pub rooms: usize,
    pub edges: Vec<Edge>,
}

impl Graph {
    /// For each room the rooms next to it, with the door.
    pub fn neighbours(&self) -> Vec<Vec<(usize, usize)>> {
        let mut neighbours = vec![Vec::new(); self.rooms];
        for (door, edge) in self.edges.iter().enumerate() {
            neighbours[edge.a].push((edge.b, door));
            if !edge.one_way {
                neighbours[edge.b].push((edge.a, door));
            }
        }
        neighbours
    }

    /// The tree of least-cost routes from `start`, in the order of rooms.
    pub fn tree(&self, neighbours: &[Vec<(usize, usize)>], start: usize) -> Vec<TreeRow> {
        let mut rows: Vec<Option<TreeRow>> = vec![None; self.rooms];
        let mut costs = vec![u64::MAX; self.rooms];
        let mut queue = BinaryHeap::from([Reverse((0, start))]);
        costs[start] = 0;
        rows[start] = Some(root(start));
        while let Some(Reverse((cost, room))) = queue.pop() {
            if cost > costs[room] {
                continue;
            }
            let hops = rows[room].map_or(0, |row| row.hops) + 1;
            for &(next, door) in &neighbours[room] {
                let arrival = cost + self.edges[door].hardness as u64;
                if arrival < costs[next] {
                    costs[next] = arrival;
                    rows[next] = Some(TreeRow {
                        node: key(next),
                        prev: Some(key(room)),
                        door: Some(key(door)),
                        hops,
                        reach: cost as f64,
                        heading: Some((room * 37 % 360) as f64 - 180.0),
                        ..root(next)
                    });
                    queue.push(Reverse((arrival, next)));
                }
            }
        }
        rows.into_iter().flatten().collect()
    }

    /// Fills a new database with the graph and the trees of `starts`; rooms are named r0, r1, ...
    pub fn fill(&self, store: &mut Store, starts: &[usize]) -> Result<()> {
        let neighbours = self.neighbours();
        store.transaction(|tx| {
            tx.seed(&[walker()], &[])?;
            let rule = |rule, name: &str| Rule {
                rule,
                name: name.into(),
                version: "1".into(),
                file: None,
                line: None,
            };
            tx.replace_rules(&[rule(1, "weigh a door"), rule(2, "walk in a room")], &[])?;
            tx.replace_rooms(&(0..self.rooms).map(room).collect::<Vec<_>>())?;
            tx.replace_doors(&self.edges.iter().enumerate().map(door).collect::<Vec<_>>())?;
            let end = |room| End { name: name(room), node: key(room), kind: EndKind::Room, kept: true };
            tx.replace_ends(&(0..self.rooms).map(end).collect::<Vec<_>>())?;
            let start = |&room: &usize| Start { name: name(room), robot: ROBOT.into(), tree: key(room) };
            tx.replace_starts(&starts.iter().map(start).collect::<Vec<_>>())?;
            for &start in starts {
                tx.put_tree(key(start), self.tree(&neighbours, start))?;
            }
            tx.mark_fresh()
        })
    }
}

/// The name of a room.
pub fn name(room: usize) -> String {
    format!("r{room}")
}

/// The first row of the tree from `start`.
pub fn root(start: usize) -> TreeRow {
    TreeRow {
        node: key(start),
        prev: None,
        from_room: None,
        door: None,
        hops: 0,
        reach: 0.0,
        leg: 0.0,
        walked: None,
        at: None,
        heading: None,
        distance: None,
        clearance: None,
        bend: true,
    }
}

fn key(index: usize) -> i64 {
    index as i64 + 1
}

fn walker() -> State {
    State {
        robot: ROBOT.into(),
        state: "STAND".into(),
        action: "WALK".into(),
        height: 2.0,
        width: 0.5,
        length: None,
        hardness: 1.0,
        position: 0,
        speed: None,
        power: None,
    }
}

fn corner(room: usize) -> [f64; 2] {
    [(room % 100) as f64 * 3.0, (room / 100) as f64 * 3.0]
}

fn room(index: usize) -> Room {
    let [x, y] = corner(index);
    Room {
        room: key(index),
        name: name(index),
        layer: None,
        facing: None,
        rect: [x, y, x + 3.0, y + 3.0],
        outline: None,
        radius: None,
        berth: None,
        berth_cost: None,
        height: None,
        width: 3.0,
        space: None,
        hardness: Derived::default(),
        action: Derived::by(2, None, "WALK".to_owned()),
        passable: Derived { value: Some(true), rule: None, witness: None },
        measures: None,
    }
}

fn door((index, edge): (usize, &Edge)) -> Door {
    let [x, y] = corner(edge.a);
    let side = |room| Side { room: key(room), height: None, width: Some(3.0), distance: Some(4.3) };
    Door {
        door: key(index),
        kind: DoorKind::Door,
        side1: side(edge.a),
        side2: side(edge.b),
        at: [x + 0.7, y + 0.7],
        width: 1.1,
        segment: [x + 0.2, y + 0.7, x + 1.3, y + 0.7],
        hardness: Derived::by(1, None, edge.hardness),
        action: Derived::by(1, None, "WALK".to_owned()),
        passable: Derived::by(1, None, true),
        measures: None,
        one_way: edge.one_way,
    }
}
