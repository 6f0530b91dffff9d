//! Room to drive: where it costs little, a way keeps farther off walls than it must.
//!
//! A way that was pulled tight touches walls at each of its bends, and wherever it runs along one. It is pulled tight once more
//! about the same corners, each of which it now passes at a distance: as far as rooms ask for, but at most in the middle of
//! what is free. Corners about which it turns least come first, since keeping off a corner costs its distance times that turn,
//! until the share of the cost that rooms allow is spent. Where a way so found would leave the rooms, it stays as it was.

mod run;
mod stops;
mod walk;

use super::cone::Segment;
use super::graph::RouteGraph;
use super::parts::{DoorIndex, RoomIndex};
use super::way::{Leg, Way};
use crate::geometry::tolerance::{ROUNDING, SNAP_M};
use crate::geometry::{Point, path_length};
use run::Run;

/// So often corners are looked for that a way comes near to only since it keeps off others.
const ROUNDS: usize = 4;

/// So often it is tried anew with less room, overall or about corners at which a way would leave its rooms.
const HALVINGS: usize = 4;

impl RouteGraph {
    /// The way that keeps off walls as rooms ask for, instead of a tight one.
    pub(super) fn with_berth(&self, tight: Way) -> Way {
        let wide = |stops: bool| Wide::new(self, &tight, stops)?.way(&tight);
        wide(true).or_else(|| wide(false)).unwrap_or(tight)
    }
}

struct Wide<'g> {
    graph: &'g RouteGraph,
    runs: Vec<Run>,
    /// What the way may cost more.
    allowance: f64,
}

impl<'g> Wide<'g> {
    /// `None` where no room asks for anything.
    ///
    /// # Arguments
    /// `stops` says whether stops are moved off walls, too.
    fn new(graph: &'g RouteGraph, tight: &Way, stops: bool) -> Option<Self> {
        // what doors and changes of shape cost allows for nothing: otherwise their prices would bend the way
        let shares = tight.legs.iter().map(|leg| leg.hardness * graph[leg.room].berth.share);
        let allowance = shares.sum::<f64>() * (1.0 - ROUNDING);
        if !(allowance > 0.0 && tight.legs.iter().any(|leg| graph[leg.room].berth.metres > 0.0)) {
            return None;
        }
        let legs = &tight.legs;
        // straight legs from and to points outside of rooms stay as they are
        let is_outside = |leg: &Leg, p: Point| graph[leg.room].outline.distance(p) > SNAP_M;
        let (mut first, mut end) = (0, legs.len());
        first += usize::from(legs[0].door.is_none() && end > 1 && is_outside(&legs[0], legs[0].from));
        end -= usize::from(end > first + 1 && is_outside(&legs[end - 1], legs[end - 1].to));
        let mut runs = Vec::new();
        let mut from = legs[first].from;
        let length = |legs: &[Leg]| legs.iter().map(Leg::length).sum::<f64>();
        while first < end {
            let is_stop = |leg: &Leg| leg.door.is_some_and(|door| !graph.costs_nothing(door));
            let last = (first..end).find(|&leg| is_stop(&legs[leg])).unwrap_or(end - 1);
            // of several changes at one point each is made there
            let is_next = last + 1 < end && legs[last + 1].length() > SNAP_M;
            let is_between = stops && is_next && length(&legs[first..=last]) > SNAP_M;
            let to =
                if is_between { graph.roomier_stop(&legs[last], &legs[last + 1]) } else { legs[last].to };
            let run = Run::new(graph, legs, first..last + 1, [from, to]);
            // what bends where no wall is, since ground has another price there, stays where it bends
            let (run, last, to) = match run.bend_off_walls(legs) {
                Some(bend) => {
                    let to = legs[bend].to;
                    (Run::new(graph, legs, first..bend + 1, [from, to]), bend, to)
                }
                None => (run, last, to),
            };
            runs.push(run);
            (first, from) = (last + 1, to);
        }
        Some(Self { graph, runs, allowance })
    }

    fn way(&mut self, tight: &Way) -> Option<Way> {
        self.activate();
        if self.runs.iter().all(Run::is_as_tight) {
            return None;
        }
        self.afford(tight);
        let mut passed: Vec<Option<Vec<Passed>>> = Vec::new();
        for run in &mut self.runs {
            let walked = run.walked(self.graph, &tight.legs);
            if walked.is_none() && run.is_moved {
                return None;
            }
            passed.push(walked);
        }
        self.joined(tight, &passed)
    }

    /// Finds which corners keep the way in its place when it keeps off all of them.
    fn activate(&mut self) {
        for run in &mut self.runs {
            let mut line = run.points.clone();
            for _ in 0..ROUNDS {
                let mut is_more = false;
                for corner in &mut run.corners {
                    let is_near = || {
                        let mut legs = line.windows(2).map(|ends| Segment::new(ends[0], ends[1]));
                        let (at, radius) = (corner.centre, corner.radius() - SNAP_M);
                        legs.any(|leg| leg.bounds().grown(radius).contains(at) && leg.distance(at) < radius)
                    };
                    if !corner.is_active && is_near() {
                        corner.is_active = true;
                        is_more = true;
                    }
                }
                if !is_more {
                    break;
                }
                line = run.line(&run.pulled());
            }
        }
    }

    /// Keeps off as many corners as the allowance is enough for, those about which the way turns least first.
    fn afford(&mut self, tight: &Way) {
        let costs =
            |runs: &[Run]| runs.iter().map(|run| run.per_m * path_length(&run.line(&run.pulled()))).sum();
        let legs = self.runs.iter().flat_map(|run| &tight.legs[run.legs.clone()]);
        let tight: f64 = legs.map(|leg| leg.hardness).sum();
        let most = tight + self.allowance;
        let cost: f64 = costs(&self.runs);
        if cost <= most {
            return;
        }
        let mut prices: Vec<(f64, usize, usize)> = Vec::new();
        for (number, run) in self.runs.iter().enumerate() {
            let mut turns = vec![0.0; run.corners.len()];
            let bends = run.pulled();
            let line = run.line(&bends);
            for ((_, corner), ends) in bends.iter().zip(line.windows(3)) {
                let (come, go) = (ends[1] - ends[0], ends[2] - ends[1]);
                turns[*corner] += come.cross(go).atan2(come.dot(go)).abs();
            }
            let price = |(corner, turn): (usize, &f64)| {
                (turn * run.corners[corner].berth * run.per_m, number, corner)
            };
            prices.extend(turns.iter().enumerate().map(price));
        }
        prices.sort_by(|one, two| one.0.total_cmp(&two.0).then((one.1, one.2).cmp(&(two.1, two.2))));
        // what corners cost by themselves is nearly what they cost together, unless they stand close to each other
        let all: f64 = prices.iter().map(|(price, ..)| price).sum();
        let mut enough = all * self.allowance / (cost - tight);
        for _ in 0..HALVINGS {
            let mut left = enough;
            for &(price, run, corner) in &prices {
                let share = if price > 0.0 { left / price } else { 1.0 };
                self.runs[run].corners[corner].share = share.clamp(0.0, 1.0);
                left -= price;
            }
            let cost: f64 = costs(&self.runs);
            if cost <= most {
                return;
            }
            enough *= 0.95 * (self.allowance / (cost - tight)).min(1.0);
        }
        let mut share = self.allowance / (cost - tight);
        for _ in 0..HALVINGS {
            self.runs.iter_mut().flat_map(|run| &mut run.corners).for_each(|corner| corner.share = share);
            if costs(&self.runs) <= most {
                return;
            }
            share *= 0.9;
        }
        self.runs.iter_mut().flat_map(|run| &mut run.corners).for_each(|corner| corner.share = 0.0);
    }

    /// The tight way with what is passed instead of some of its runs; `None` where that costs more than is allowed.
    fn joined(&self, tight: &Way, passed: &[Option<Vec<Passed>>]) -> Option<Way> {
        let legs = &tight.legs;
        let (first, last) = (legs.first()?, legs.last()?);
        let as_is = |legs: &[Leg]| -> Vec<Passed> {
            legs.iter().map(|leg| (leg.door, leg.to, self.after(leg))).collect()
        };
        let begun = self.runs.first()?.legs.start;
        let mut all = as_is(&legs[..begun]);
        for (run, passed) in self.runs.iter().zip(passed) {
            let stop = &legs[run.legs.end - 1];
            match passed {
                Some(passed) => {
                    all.extend(passed);
                    all.push((stop.door, run.points[run.points.len() - 1], self.after(stop)));
                }
                None => all.extend(as_is(&legs[run.legs.clone()])),
            }
        }
        let end = self.runs.last()?.legs.end;
        all.extend(as_is(&legs[end..]));
        // the last leg ends at the goal, by itself
        all.pop();
        let way = Way::through(self.graph, (first.room, first.from), all, last.to);
        (way.cost <= tight.cost + self.allowance).then_some(way)
    }

    /// The room behind a leg.
    fn after(&self, leg: &Leg) -> RoomIndex {
        leg.door.map_or(leg.room, |door| {
            let of = &self.graph[door];
            if of.room1 == leg.room { of.room2 } else { of.room1 }
        })
    }
}

/// A door, or a bend without one; where; and the room behind it.
type Passed = (Option<DoorIndex>, Point, RoomIndex);
