//! The present way at other weights, driven as is best there: the ways that hold where it is asked how firm a route is.
//!
//! What *the same way* is:
//! - where all hardness lies on the doors (the paper's modes), the same doors in the same order;
//! - where rooms weigh their metres, the same actions in the same order, each in the rooms in which the route does it now, or
//!   in rooms beside these: where hardness changes, a way bends a little elsewhere with every value, and that is no other way.

use std::collections::{BTreeMap, BTreeSet};

use adit_planners::routes::RoomIndex;

use super::{Contrast, Look, Path, Routes};
use crate::graph::SiteGraph;
use crate::state::tunable::Weights;
use crate::why::probe::Prober;

/// The present way, driven as is best at any weights, beside all ways.
pub struct SameWay<'r> {
    pub path: Path,
    all: &'r Routes,
    /// Where rooms weigh their metres: run by run the rooms of the way and those beside them.
    runs: Option<Vec<BTreeSet<RoomIndex>>>,
}

impl<'r> SameWay<'r> {
    /// Of the best way at present.
    pub fn new(prober: &Prober, all: &'r Routes, path: Path) -> Self {
        let runs = (!all.is_on_doors()).then(|| runs(prober.fork.graph(), &path));
        Self { path, all, runs }
    }

    /// What it costs as it is driven, off walls, at weights at which it is one of the best.
    pub fn driven_cost(&self, weights: &Weights) -> Option<f64> {
        self.all.driven_cost(weights)
    }

    /// Whether a way is this one, driven a little otherwise at most: through its runs, one after the other.
    fn is_this(&self, path: &Path) -> bool {
        let Some(runs) = &self.runs else { return self.path.doors == path.doors };
        let mut run = 0;
        let is_in = |run: usize, room: RoomIndex| runs.get(run).is_some_and(|run| run.contains(&room));
        let begins_so = path.metres.first().is_none_or(|&(room, _)| is_in(0, room));
        begins_so
            && path.metres.iter().all(|&(room, _)| {
                run += usize::from(!is_in(run, room));
                is_in(run, room)
            })
            && run + 1 == runs.len()
    }
}

impl Contrast for SameWay<'_> {
    fn look(&self, weights: &Weights) -> Option<Look> {
        let as_now = self.path.cost(weights);
        // what costs more than this way is not the best
        let within = self.rival(weights, as_now).filter(|(_, cost)| !self.is_turned(*cost, as_now));
        let best = within.or_else(|| self.rival(weights, f64::INFINITY));
        let Some((best, least)) = best else {
            return Some(Look { own: None, rival: None, least: f64::INFINITY, is_turned: true });
        };
        if self.is_this(&best) {
            let best = Some((best, least));
            return Some(Look { own: best.clone(), rival: best, least, is_turned: false });
        }
        let own = as_now.is_finite().then(|| (self.path.clone(), as_now));
        // what is found is driven, though this way may cost less: it is turned unless both cost the same
        let is_turned = !(as_now - least).abs().le(&(self.all.rounding() * least.abs().max(1e-9)));
        Some(Look { own, rival: Some((best, least)), least, is_turned })
    }

    fn rival(&self, weights: &Weights, limit: f64) -> Option<(Path, f64)> {
        let path = self.all.best(weights, limit)?;
        let cost = path.cost(weights);
        Some((path, cost))
    }

    fn is_turned(&self, own: f64, rival: f64) -> bool {
        own > rival + self.all.rounding() * rival.abs().max(1e-9)
    }

    fn hair(&self) -> f64 {
        self.all.hair()
    }
}

/// What tells runs apart: the layer, its facing and the action.
type Kind<'g> = (Option<&'g (String, String)>, Option<f64>, Option<&'g str>);

fn kind(graph: &SiteGraph, room: RoomIndex) -> Kind<'_> {
    let room = &graph[room];
    (room.layer.as_ref(), room.facing, room.action.value.as_deref())
}

/// The rooms of a way and those beside them, run by run.
fn runs(graph: &SiteGraph, path: &Path) -> Vec<BTreeSet<RoomIndex>> {
    let beside = beside(graph, path);
    let mut runs: Vec<BTreeSet<RoomIndex>> = Vec::new();
    let mut last = None;
    for &(room, _) in &path.metres {
        if last.is_none_or(|last| kind(graph, last) != kind(graph, room)) {
            runs.push(BTreeSet::new());
        }
        last = Some(room);
        if let Some(run) = runs.last_mut() {
            run.insert(room);
            run.extend(beside.get(&room).into_iter().flatten());
        }
    }
    runs
}

/// For each room of a way the ones of its kind behind a door of it.
fn beside(graph: &SiteGraph, path: &Path) -> BTreeMap<RoomIndex, Vec<RoomIndex>> {
    let own: BTreeSet<RoomIndex> = path.metres.iter().map(|(room, _)| *room).collect();
    let mut beside: BTreeMap<RoomIndex, Vec<RoomIndex>> = BTreeMap::new();
    for door in graph.graph().doors().iter().filter(|door| !door.is_change()) {
        for (room, other) in [(door.room1, door.room2), (door.room2, door.room1)] {
            if own.contains(&room) && kind(graph, room) == kind(graph, other) {
                beside.entry(room).or_default().push(other);
            }
        }
    }
    beside
}
