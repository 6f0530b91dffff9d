//! Missions that are kept one by one, as they end.

use std::path::Path;

use adit_db::Store;
use adit_db::history::Author;
use adit_planners::navigation::Pace;

use super::missions::last_mission;
use crate::error::Result;
use crate::fit::Row as Traversal;
use crate::live::Live;
use crate::navigation::journal::record;
use crate::navigation::missions::{Journal, Row};

/// Of whom missions are.
#[derive(Clone, Copy)]
pub(super) struct Of<'o> {
    pub world: &'o str,
    /// The rule bases, one a line, the lowest first.
    pub bases: &'o str,
    /// The names of the robot's shapes, by number; none of one that has one shape.
    pub states: &'o [String],
    pub robot: &'o str,
}

/// Where missions are kept.
pub(super) struct Kept<'o> {
    of: Of<'o>,
    store: Option<Store>,
    /// The number of the last one that is kept already.
    pub before: usize,
    /// Whether what the robot measured in each state is added to the site's traversals.
    has_traversals: bool,
}

impl<'o> Kept<'o> {
    pub fn open(of: Of<'o>, db: Option<&Path>, has_traversals: bool) -> Result<Self> {
        let mut store = db.map(Store::open_for_worlds).transpose()?;
        let before = match &mut store {
            Some(store) => store.snapshot(|tx| last_mission(tx, of.world))?,
            None => 0,
        };
        Ok(Self { of, store, before, has_traversals })
    }

    /// Keeps a mission, which is one of what the words say.
    pub fn keep(&mut self, live: &Live, words: &str, (row, entries, decided): Journal) -> Result<Row> {
        let Of { world, bases, states, robot } = self.of;
        if let Some(store) = &mut self.store {
            let record = record((world, bases, robot), &row, states, &entries, decided);
            store.transaction(|tx| tx.keep_mission(&record))?;
        }
        // who is not kept has no number of its own, by which what was measured is told apart
        if self.has_traversals && !row.paces.is_empty() {
            let author = Author { who: robot.to_owned(), why: String::new() };
            let mission = format!("{words} {} of {world}", row.mission);
            live.site().add_traversals(&traversals(&mission, robot, &row), Some("seconds"), &author)?;
        }
        Ok(row)
    }
}

/// How fast the robot was in each state, as `adit fit` reads it.
fn traversals(mission: &str, robot: &str, row: &Row) -> Vec<Traversal> {
    let of_state = |(state, pace): (&String, &Pace)| Traversal {
        // each is measured by itself
        mission: Some(format!("{mission}, in {state}")),
        robot: Some(robot.to_owned()),
        state: Some(state.clone()),
        distance: pace.metres,
        measured: pace.seconds,
        ..Traversal::default()
    };
    row.paces.iter().map(of_state).collect()
}
