//! Robots of many states: where others stand in for some, ways cost what they cost where everybody changes into everything, and
//! no more than a search over points and states finds.
#![allow(clippy::unwrap_used, reason = "in a test a failed unwrap is a failed test")]
#![allow(clippy::float_cmp, reason = "two infinities are the same")]

use std::cmp::Reverse;
use std::collections::BinaryHeap;

use adit_planners::geometry::{Point, Rect};
use adit_planners::layers::{Kind, KnownLayers, StandIns, State, cut_layers, cut_layers_anew};
use adit_planners::routes::{
    Berth, Crossing, Goal, RoomIndex, RouteDoor, RouteGraph, RouteRoom, Start, Walking,
};
use adit_planners::world::{Bridge, Obstacle, Shape, World};
use proptest::prelude::*;

const SIDE: f64 = 6.0;

/// Nodes of the search over points lie so far apart, metres.
const STEP: f64 = 0.1;

/// Of two searches over other changes, the one may find a way of another kind that is as good before it is pulled tight.
const TOLERANCE: f64 = 0.03;

/// A robot: its states, what a metre weighs in each, and what each change of shape does.
#[derive(Clone, Debug)]
struct Robot {
    states: Vec<State>,
    per_m: Vec<f64>,
    changes: Vec<Vec<f64>>,
}

impl Robot {
    /// Pairs of a state and one that can stand in for it, by their definition.
    fn stand_ins(&self, world: &World) -> Vec<(usize, usize)> {
        let all = 0..self.states.len();
        let may = |state: usize, other: usize| {
            let (of, by) = (&self.states[state], &self.states[other]);
            let mut thirds = all.clone().filter(|third| ![state, other].contains(third));
            state != other
                && by.width <= of.width
                && world.bridges.iter().all(|bridge| by.height < bridge.height || of.height >= bridge.height)
                && self.per_m[other] <= self.per_m[state]
                && thirds.all(|third| {
                    self.changes[third][other] <= self.changes[third][state]
                        && self.changes[other][third] <= self.changes[state][third]
                })
        };
        let pairs = all.clone().flat_map(|state| all.clone().map(move |other| (state, other)));
        pairs.filter(|&(state, other)| may(state, other)).collect()
    }

    fn graph(&self, world: &World, stand_ins: &StandIns) -> RouteGraph {
        let layers = cut_layers_anew(world, &self.states, &[], stand_ins, &KnownLayers::default()).unwrap();
        let rooms = layers.rooms.iter().map(|room| RouteRoom {
            outline: room.outline.clone(),
            radius: room.radius,
            berth: Berth::default(),
            walking: Walking::PerMetre(self.per_m[room.state]),
        });
        let state = |room: usize| layers.rooms[room].state;
        let doors = (1..).zip(&layers.crossings).map(|(door, crossing)| {
            let is_change = crossing.kind == Kind::Change;
            let price = self.changes[state(crossing.room1)][state(crossing.room2)];
            RouteDoor {
                door,
                room1: RoomIndex::new(crossing.room1),
                room2: RoomIndex::new(crossing.room2),
                crossing: match crossing.kind {
                    Kind::Door => Crossing::Through(crossing.across),
                    Kind::Change => Crossing::Within(layers.area(crossing)),
                },
                at: crossing.across.middle(),
                hardness: Some(if is_change { price } else { 0.0 }),
                passable: true,
                one_way: is_change,
            }
        });
        RouteGraph::new(rooms.collect(), doors.collect())
    }

    /// The least cost between two points on a lattice, over all states: what it finds can be driven.
    fn least_on_a_lattice(
        &self,
        world: &World,
        [(from, start_in), (to, end_in)]: [(Point, &[usize]); 2],
    ) -> f64 {
        let count = (SIDE / STEP).round() as usize + 1;
        let at = |node: usize| Point::new((node % count) as f64 * STEP, (node / count) as f64 * STEP);
        let gap = |rect: &Rect, p: Point| {
            (rect.x0 - p.x).max(p.x - rect.x1).max(0.0).hypot((rect.y0 - p.y).max(p.y - rect.y1).max(0.0))
        };
        let to_wall = |p: Point| {
            let walls = world.obstacles.iter().map(|wall| gap(&wall.shape.enclosing_rect(), p));
            walls.fold(p.x.min(p.y).min(SIDE - p.x).min(SIDE - p.y), f64::min)
        };
        let nodes = count * count;
        // half a diagonal to spare, so that what joins two neighbours is free
        let fits: Vec<bool> = (0..self.states.len() * nodes)
            .map(|place| {
                let (state, p) = (&self.states[place / nodes], at(place % nodes));
                let low = world.bridges.iter().filter(|bridge| state.height >= bridge.height);
                let room = low.map(|bridge| gap(&bridge.rect, p)).fold(to_wall(p), f64::min);
                room > state.width / 2.0 + STEP * std::f64::consts::FRAC_1_SQRT_2 + 0.01
            })
            .collect();
        let nearest = |p: Point| (p.y / STEP).round() as usize * count + (p.x / STEP).round() as usize;
        let (start, goal) = (nearest(from), nearest(to));
        let mut least = vec![f64::INFINITY; fits.len()];
        let mut queue = BinaryHeap::new();
        for &state in start_in {
            let place = state * nodes + start;
            if fits[place] {
                least[place] = at(start).distance(from) * self.per_m[state];
                queue.push((Reverse(least[place].to_bits()), place));
            }
        }
        while let Some((Reverse(cost), place)) = queue.pop() {
            let (cost, state, node) = (f64::from_bits(cost), place / nodes, place % nodes);
            if cost > least[place] {
                continue;
            }
            if node == goal && end_in.contains(&state) {
                return cost + at(goal).distance(to) * self.per_m[state];
            }
            let (column, row) = ((node % count) as i64, (node / count) as i64);
            let steps = (-1..=1).flat_map(|dy| (-1..=1).map(move |dx| (dx, dy)));
            let beside = steps.filter(|&(dx, dy)| {
                (0..count as i64).contains(&(column + dx)) && (0..count as i64).contains(&(row + dy))
            });
            let walked = beside.map(|(dx, dy)| {
                let next = ((row + dy) * count as i64 + column + dx) as usize;
                (state * nodes + next, at(node).distance(at(next)) * self.per_m[state])
            });
            let changed = (0..self.states.len()).map(|to| (to * nodes + node, self.changes[state][to]));
            for (next, price) in walked.chain(changed) {
                if fits[next] && cost + price < least[next] {
                    least[next] = cost + price;
                    queue.push((Reverse(least[next].to_bits()), next));
                }
            }
        }
        f64::INFINITY
    }
}

fn cost(graph: &RouteGraph, from: Point, to: Point) -> f64 {
    let holding = |p: Point| -> Vec<RoomIndex> {
        graph.room_indices().filter(|&room| graph[room].outline.contains(p)).collect()
    };
    let goal = Goal::within(holding(to), Some(to));
    graph.way(&Start::within(holding(from), from), &[goal]).map_or(f64::INFINITY, |(_, way)| way.cost)
}

fn worlds() -> impl Strategy<Value = World> {
    let rect = || {
        (0.0..5.0_f64, 0.0..5.0_f64, 0.3..2.0_f64, 0.3..2.0_f64)
            .prop_map(|(x, y, dx, dy)| Rect::new(x, y, x + dx, y + dy))
    };
    let wall = rect().prop_map(|rect| Obstacle { shape: Shape::Rect(rect) });
    let bridge =
        (rect(), prop_oneof![Just(0.9), Just(1.3)]).prop_map(|(rect, height)| Bridge { rect, height });
    (prop::collection::vec(wall, 1..6), prop::collection::vec(bridge, 0..3)).prop_map(
        |(obstacles, bridges)| World { obstacles, bridges, ..World::empty(Rect::new(0.0, 0.0, SIDE, SIDE)) },
    )
}

/// Some 6 to 12 states; what changes of shape cost is told for some pairs, as in the table, or alike for all.
fn robots() -> impl Strategy<Value = Robot> {
    let size = (prop_oneof![Just(0.6), Just(1.1), Just(1.7)], 0.3..1.0_f64, 1.0..6.0_f64);
    prop::collection::vec(size, 6..13).prop_flat_map(|sizes| {
        let count = sizes.len();
        let alike = (0.0..2.0_f64).prop_map(move |price| vec![price; count * count]);
        let price = prop_oneof![2 => Just(0.0), 1 => 0.2..3.0_f64];
        let told = prop::collection::vec(price, count * count);
        let by_state = prop::collection::vec(0.0..2.0_f64, count).prop_map(move |prices| {
            (0..count * count).map(|pair| prices[pair / count] + prices[pair % count]).collect::<Vec<f64>>()
        });
        prop_oneof![alike, told, by_state].prop_map(move |prices: Vec<f64>| {
            let state = |(number, &(height, width, _)): (usize, &(f64, f64, f64))| State {
                robot: None,
                state: format!("SHAPE-{number}"),
                height,
                width,
                length: None,
            };
            let price = |from: usize, to: usize| if from == to { 0.0 } else { prices[from * count + to] };
            Robot {
                states: sizes.iter().enumerate().map(state).collect(),
                per_m: sizes.iter().map(|(.., per_m)| *per_m).collect(),
                changes: (0..count).map(|from| (0..count).map(|to| price(from, to)).collect()).collect(),
            }
        })
    })
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 8, ..ProptestConfig::default() })]

    #[test]
    fn where_states_stand_in_for_others_ways_cost_as_much(
        world in worlds(), robot in robots(), ends in [0.3..5.7_f64, 0.3..5.7, 0.3..5.7, 0.3..5.7]
    ) {
        let (from, to) = (Point::new(ends[0], ends[1]), Point::new(ends[2], ends[3]));
        let all = cost(&robot.graph(&world, &StandIns::default()), from, to);
        let pairs = robot.stand_ins(&world);
        let few = cost(&robot.graph(&world, &StandIns::new(robot.states.len(), &pairs)), from, to);
        prop_assert!(few == all || (few / all - 1.0).abs() <= TOLERANCE, "{} beside {}", few, all);
        let layers = cut_layers(&world, &robot.states).unwrap();
        let fitting = |p: Point| -> Vec<usize> {
            let rooms = layers.rooms.iter().filter(|room| room.outline.contains(p));
            rooms.map(|room| room.state).collect()
        };
        let (starts, goals) = (fitting(from), fitting(to));
        let ends = [(from, &starts[..]), (to, &goals[..])];
        let driven = robot.least_on_a_lattice(&world, ends);
        prop_assert!(few <= driven * (1.0 + TOLERANCE), "{} beside {} on a lattice", few, driven);
    }
}

#[test]
fn doors_of_change_grow_with_states_and_not_with_pairs_where_one_stands_in_for_all() {
    let world = World {
        obstacles: vec![Obstacle { shape: Shape::Rect(Rect::new(2.0, 0.0, 2.2, 4.0)) }],
        ..World::empty(Rect::new(0.0, 0.0, SIDE, SIDE))
    };
    let changes = |count: usize| {
        let state = |number: usize| State {
            robot: None,
            state: format!("SHAPE-{number}"),
            height: 1.0,
            width: 0.3 + 0.01 * number as f64,
            length: None,
        };
        let states: Vec<State> = (0..count).map(state).collect();
        let pairs: Vec<(usize, usize)> = (1..count).map(|state| (state, 0)).collect();
        let stand_ins = StandIns::new(count, &pairs);
        let layers = cut_layers_anew(&world, &states, &[], &stand_ins, &KnownLayers::default()).unwrap();
        layers.crossings.iter().filter(|crossing| crossing.kind == Kind::Change).count()
    };
    let (few, many) = (changes(11), changes(41));
    assert!(many <= 5 * few, "{few} for 10 states beside one, {many} for 40");
}

#[test]
fn of_states_that_could_stand_in_for_each_other_the_later_one_is_stood_in_for() {
    let in_a_ring = StandIns::new(3, &[(0, 1), (1, 2), (2, 0)]);
    let one_for_all = StandIns::new(3, &[(1, 0), (2, 0), (2, 1)]);
    let for_each_other = StandIns::new(2, &[(0, 1), (1, 0)]);
    assert_eq!(in_a_ring, StandIns::new(3, &[(1, 2), (2, 0)]));
    assert_eq!(one_for_all, StandIns::new(3, &[(1, 0), (2, 0)]));
    assert_eq!(for_each_other, StandIns::new(2, &[(1, 0)]));
}
