//! Where ways start and end: in rooms that hold a point, and in rooms that a straight leg joins with a point outside of
//! them at which a state fits.

use adit_planners::geometry::{Convex, Point, Rect, Segment, cross};
use adit_planners::routes::{Entry, Goal, Leg, RoomIndex, Start, Walking, Way};

use super::gauge::Gauge;
use super::layers::Layer;
use super::{End, SiteGraph, is_weighed};

/// A leg is at most so long, metres.
const LEG_M: f64 = 5.0;

/// A leg is at most so many times as long as the shortest one, whichever room it leads to.
const LONGER: f64 = 2.0;

/// So many rooms of a layer, the nearest ones, are tried to be joined by a leg.
const TRIED: usize = 64;

/// Up to so many metres away the nearest point at which a state fits is looked for exactly; beyond it is that of a room.
const NEAR_M: f64 = 1.0;

/// A leg that comes so near to a closed boundary, or goes so deep into a room, meets it, metres.
const TOUCHES_M: f64 = 1e-9;

/// In so many parts a leg is looked at outside of rooms, and by how much nearer a room is to be to be the nearest, metres.
const LOOKS: u32 = 16;
const NEARER_M: f64 = 1e-5;

impl SiteGraph {
    /// The rooms in which ways of a robot start or end: a room itself; for a point one room of each state and facing that
    /// holds it, and, where none does and it fits there, those that a straight leg joins with it.
    ///
    /// # Arguments
    /// `gauge` judges what fits; without one no room is joined by a leg.
    pub fn entries(&self, gauge: Option<&Gauge>, end: &End, robot: Option<&str>) -> Vec<Entry> {
        if let End::Room(index) = end {
            return if is_weighed(&self[*index]) { vec![Entry::from(*index)] } else { Vec::new() };
        }
        let at = self.point(end);
        self.layers(robot).flat_map(|layer| self.entries_of(layer, gauge, at)).collect()
    }

    /// Where a search for this end leads: for a room, to anywhere in it.
    pub fn goal(&self, gauge: Option<&Gauge>, end: &End, robot: Option<&str>) -> Goal {
        let at = (!matches!(end, End::Room(_))).then(|| self.point(end));
        Goal { rooms: self.entries(gauge, end, robot), at }
    }

    /// Where a search from this end begins.
    pub fn start(&self, gauge: Option<&Gauge>, end: &End, robot: Option<&str>) -> Start {
        Start { rooms: self.entries(gauge, end, robot), at: self.point(end) }
    }

    /// The point nearest to another one from which ways lead on: in a room, or where a state fits that a leg joins with its
    /// rooms. With the state.
    pub fn nearest(
        &self,
        gauge: Option<&Gauge>,
        at: Point,
        robot: Option<&str>,
    ) -> Option<(Point, Option<&str>)> {
        let mut best: Option<(Point, &Layer)> = None;
        for layer in self.layers(robot) {
            let room = layer.nearest(&self.graph, at).find(|(room, _)| is_weighed(&self[*room]));
            let Some(in_room) = room.map(|(room, _)| self.outline(room).nearest_to(at)) else {
                continue;
            };
            let so_far = best.map_or(f64::INFINITY, |(best, _)| best.distance(at));
            let within = so_far.min(in_room.distance(at)).min(NEAR_M);
            let leads_on = |p: Point| !self.entries_of(layer, gauge, p).is_empty();
            let beside = gauge.and_then(|gauge| gauge.nearest_fit(layer.shape(), at, within, leads_on));
            let found = beside.unwrap_or(in_room);
            if found.distance(at) < so_far {
                best = Some((found, layer));
            }
        }
        best.map(|(point, layer)| (point, layer.state()))
    }

    /// The straight way between two ends outside of all rooms that legs join with the same one.
    pub fn straight(&self, gauge: &Gauge, start: &Start, goal: &Goal) -> Option<Way> {
        let leg = Segment::new(start.at, goal.at?);
        let (from, to) = (start.rooms.iter(), |room: RoomIndex| {
            goal.rooms.iter().any(|entry| entry.room == room && entry.joint.is_some())
        });
        let both = from.filter(|entry| entry.joint.is_some() && to(entry.room)).map(|entry| entry.room);
        let ways = both.filter_map(|room| {
            let layer = self.index.layers.iter().find(|layer| layer.holds(room))?;
            let Walking::PerMetre(hardness) = self.graph[room].walking else { return None };
            let fits = gauge.fits(layer.shape(), leg.a, leg.b) && self.is_open(layer, gauge, leg, room);
            let cost = hardness * leg.length();
            let leg = Leg { room, from: leg.a, to: leg.b, hardness: cost, door: None, cost };
            fits.then(|| Way { legs: vec![leg], cost })
        });
        ways.min_by(|one, two| one.cost.total_cmp(&two.cost))
    }

    /// The states of a robot that fit at a point, whether a way leads on from there or not.
    pub fn states_at(&self, gauge: &Gauge, at: Point, robot: Option<&str>) -> Vec<&str> {
        let mut states: Vec<&str> =
            self.stances_at(gauge, at, robot).into_iter().map(|(state, _)| state).collect();
        states.dedup();
        states
    }

    /// The same, each with the facings, in degrees, in which it fits.
    pub fn stances_at(&self, gauge: &Gauge, at: Point, robot: Option<&str>) -> Vec<(&str, Option<f64>)> {
        let fitting = self.layers(robot).filter(|layer| gauge.fits(layer.shape(), at, at));
        fitting.filter_map(|layer| Some((layer.state()?, layer.shape().1))).collect()
    }

    /// The facings in which a state has rooms.
    pub fn facings(&self, of: &(String, String)) -> Vec<Option<f64>> {
        self.layers_of(of).map(|layer| layer.shape().1).collect()
    }

    /// The rooms of a state that hold a point.
    pub fn rooms_at(&self, of: &(String, String), at: Point) -> impl Iterator<Item = RoomIndex> {
        self.layers_of(of).flat_map(move |layer| layer.at(&self.graph, at))
    }

    fn layers_of(&self, of: &(String, String)) -> impl Iterator<Item = &Layer> {
        self.index.layers.iter().filter(move |layer| layer.shape().0 == Some(of))
    }

    /// The layers of a robot.
    fn layers(&self, robot: Option<&str>) -> impl Iterator<Item = &Layer> {
        self.index.layers.iter().filter(move |layer| robot.is_none_or(|robot| layer.is_of(robot)))
    }

    fn entries_of(&self, layer: &Layer, gauge: Option<&Gauge>, at: Point) -> Vec<Entry> {
        let mut held = layer.at(&self.graph, at).peekable();
        if held.peek().is_some() {
            return held.find(|&room| is_weighed(&self[room])).map(Entry::from).into_iter().collect();
        }
        gauge.map_or_else(Vec::new, |gauge| self.joined(layer, gauge, at))
    }

    /// The rooms that straight legs join with a point outside of all of them, the nearest first.
    fn joined(&self, layer: &Layer, gauge: &Gauge, at: Point) -> Vec<Entry> {
        let mut found: Vec<Entry> = Vec::new();
        if !gauge.fits(layer.shape(), at, at) {
            return found;
        }
        let mut longest = LEG_M;
        for (room, metres) in layer.nearest(&self.graph, at).take(TRIED) {
            if metres > longest {
                break;
            }
            if !is_weighed(&self[room]) {
                continue;
            }
            let joint = joints(self.outline(room), at).into_iter().find(|&joint| {
                joint.distance(at) <= longest
                    && gauge.fits(layer.shape(), at, joint)
                    && self.is_open(layer, gauge, Segment::new(at, joint), room)
            });
            if let Some(joint) = joint {
                if found.is_empty() {
                    longest = (joint.distance(at) * LONGER).min(LEG_M);
                }
                found.push(Entry { room, joint: Some(joint) });
            }
        }
        found
    }

    /// Whether no rule, fact or named door is passed by on a leg to a room.
    fn is_open(&self, layer: &Layer, gauge: &Gauge, leg: Segment, room: RoomIndex) -> bool {
        let closed = |segment: &Segment| segment.gap(&leg) <= TOUCHES_M;
        if self.graph.closed().iter().any(|closed_at| closed_at.holds_for(room) && closed(&closed_at.segment))
        {
            return false;
        }
        let is_shut = |other: RoomIndex| !is_weighed(&self[other]) && goes_into(leg, self.outline(other));
        if layer.meeting(leg.bounds()).any(is_shut) || self.leads_beside_shut(layer, leg) {
            return false;
        }
        let to = self.outline(room).centre();
        gauge.doors().iter().all(|door| !door.crosses(&leg))
            && gauge.areas().iter().all(|area| {
                let is_met = area.contains(leg.a)
                    || area.contains(leg.b)
                    || area.sides().iter().any(|side| side.crosses(&leg));
                !is_met
                    || area.contains(to)
                    || self.is_entered(layer, |p| area.contains(p), area.enclosing_rect())
            })
    }

    /// Whether a leg leads outside of all rooms past one that is not entered, and nearer to it than to any other: what keeps one
    /// out of that room keeps one out of what lies between it and the wall.
    fn leads_beside_shut(&self, layer: &Layer, leg: Segment) -> bool {
        let is_nearest = |p: Point| {
            let mut shut = f64::INFINITY;
            for (room, metres) in layer.nearest(&self.graph, p) {
                if is_weighed(&self[room]) {
                    return metres > shut + NEARER_M;
                }
                shut = shut.min(metres);
            }
            shut.is_finite()
        };
        (0..=LOOKS).any(|look| is_nearest(leg.at(f64::from(look) / f64::from(LOOKS))))
    }

    /// Whether a room in an area is entered: one of the layer, or of any where the layer has none there.
    fn is_entered(&self, layer: &Layer, is_in: impl Fn(Point) -> bool, about: Rect) -> bool {
        let within = |layer: &Layer| -> Vec<bool> {
            let rooms = layer.meeting(about).filter(|&room| is_in(self.outline(room).centre()));
            rooms.map(|room| is_weighed(&self[room])).collect()
        };
        let own = within(layer);
        if own.is_empty() {
            self.index.layers.iter().flat_map(within).any(|is| is)
        } else {
            own.contains(&true)
        }
    }
}

/// Whether a leg goes deeper into a room than it may touch it.
fn goes_into(leg: Segment, room: &Convex) -> bool {
    if let Some(rect) = room.rect() {
        return rect.grown(-TOUCHES_M).clip(leg.a, leg.b).is_some();
    }
    let (mut enters, mut leaves) = (0.0_f64, 1.0_f64);
    for side in room.sides() {
        let [from, to] = [leg.a, leg.b].map(|end| cross(side.a, side.b, end) - TOUCHES_M * side.length());
        if from <= 0.0 && to <= 0.0 {
            return false;
        }
        let share = from / (from - to);
        if from < 0.0 {
            enters = enters.max(share);
        } else if to < 0.0 {
            leaves = leaves.min(share);
        }
    }
    enters < leaves
}

/// Where a leg from a point may join a room, the nearest first: where the room is nearest, its corners, the middles of its
/// sides, its centre.
fn joints(room: &Convex, at: Point) -> Vec<Point> {
    let middles = room.sides().map(|side| side.middle());
    let all = [room.nearest_to(at), room.centre()].into_iter().chain(room.corners()).chain(middles);
    let mut all: Vec<Point> = all.collect();
    all.sort_by(|one, two| one.distance(at).total_cmp(&two.distance(at)));
    all
}
