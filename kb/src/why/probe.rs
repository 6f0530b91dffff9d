//! What rooms and doors weigh when one cell has another value.
//!
//! A probe is the middle of `State::step`: it tells one cell to a fork's knowledge, concludes what depends on it, and looks
//! at the rooms and doors of which rules say something else, by the same [`Look`] and the same [`needs_changed`]. The rest
//! of a step would be work for nothing here: it compares all tables that are told, attaches facts anew, words the grounds,
//! writes a second graph, and has planners cut rooms anew where a probe only says that they would. A cell is tried some
//! hundred times for one answer, so the probe leaves that out; what it shares with the step stands once.

mod effect;
mod levers;

use std::sync::Arc;

use adit_db::weight::Weight;
use adit_engine::{Severity, Value};
use adit_planners::facts::Facts;
use adit_planners::routes::Walking;
use rayon::prelude::*;

use crate::error::{Code, Error, Result};
use crate::graph::walking;
use crate::knowledge::classes;
use crate::state::tunable::{Lever, Weights};
use crate::state::{Look, State, Which, needs_changed};

/// What a value of a cell leads to.
#[derive(Clone, Debug, PartialEq)]
pub enum Probe {
    Weighs(Weights),
    /// Rooms and doors would be cut anew.
    CutAnew,
    /// Rules give a hardness that no sum can take, or fail.
    Refused,
}

/// Gives cells other values, one at a time, in a fork.
pub struct Prober {
    /// The fork; its graph stays as it was.
    pub fork: State,
    /// What everything weighs as it is.
    pub present: Arc<Weights>,
    now: Weights,
    /// What planners worked from.
    needs: Facts,
    is_cut_anew: bool,
}

impl Prober {
    /// On a fork, which it changes and gives back no more.
    pub fn new(fork: State) -> Self {
        let present = Weights::of(fork.graph().graph());
        let needs = needs(&fork);
        Self { now: present.clone(), present: Arc::new(present), fork, needs, is_cut_anew: false }
    }

    /// What the value leads to; an error where nobody waits for it any more. The cell keeps it until [`restore`](Self::restore).
    pub fn at(&mut self, lever: &Lever, value: f64) -> Result<Probe> {
        self.fork.go_on()?;
        let fork = &mut self.fork;
        let told =
            fork.knowledge.tell_row(&lever.class, lever.row, &lever.column, Some(Value::Number(value)));
        told.map_err(Error::of(Code::FirmRefused))?;
        let changes = fork.knowledge.update(&fork.inputs.rules);
        let (knowledge, graph) = (&fork.knowledge, fork.graph());
        let (rules, which) = (&fork.inputs.rules, Which::Touched(&changes));
        let mut look = Look { knowledge, rules, which, reasons: None };
        let rooms = look.rooms().map(|(room, Weight { hardness, passable, .. })| {
            (room, walking(hardness.value, passable.value, graph[room].layer.is_some()))
        });
        for (room, walking) in rooms.collect::<Vec<_>>() {
            self.now.rooms[room.index()] = walking;
        }
        let doors = look.doors().map(|(door, Weight { hardness, passable, .. })| {
            let hardness = hardness.value.filter(|_| passable.value == Some(true));
            (door, hardness.unwrap_or(f64::INFINITY))
        });
        for (door, hardness) in doors.collect::<Vec<_>>() {
            self.now.doors[door.index()] = hardness;
        }
        let failed = knowledge.problems(&fork.inputs.rules);
        let is_bad = |number: f64| number < 0.0 || number.is_nan();
        let is_bad_room = |room: &Walking| matches!(room, Walking::PerMetre(number) if is_bad(*number) || number.is_infinite());
        if failed.iter().any(|problem| problem.severity == Severity::Error)
            || self.now.rooms.iter().any(is_bad_room)
            || self.now.doors.iter().any(|door| is_bad(*door))
        {
            return Ok(Probe::Refused);
        }
        let planners = fork.site.planners();
        let is_touched = planners.iter().any(|planner| needs_changed(&planner.signature().needs, &changes));
        // what one value changed may still be so at the next one
        if (is_touched || self.is_cut_anew) && needs(&self.fork) != self.needs {
            self.is_cut_anew = true;
            return Ok(Probe::CutAnew);
        }
        self.is_cut_anew = false;
        Ok(Probe::Weighs(self.now.clone()))
    }

    /// Gives the cell its own value again.
    pub fn restore(&mut self, lever: &Lever) -> Result<()> {
        self.at(lever, lever.value).map(|_| ())
    }
}

fn needs(fork: &State) -> Facts {
    let needs: Vec<String> =
        fork.site.planners().iter().flat_map(|planner| planner.signature().needs).collect();
    classes::known(&fork.knowledge, &needs)
}
