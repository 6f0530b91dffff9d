//! What the values of each cell of the tables make of all weights. It hangs on what is told and on rules, not on what is asked, so
//! it is found once for a state, by whoever asks first for reasons, and kept with it.

mod lever;
mod linear;
mod weighing;

use std::collections::BTreeMap;
use std::sync::{Arc, Mutex, PoisonError};

pub use lever::{LARGEST, LAST, Lever, Side, least, lowest};
pub use linear::Line;
pub use weighing::Weights;

/// So many weights of rooms and doors are kept for a class at most, some 70 MB; what is more is found anew each time.
const MOST_KEPT: usize = 4_000_000;

/// What the values of a cell make of all weights.
pub struct Effect {
    pub lever: Lever,
    /// Below and above the present value; `None` where weights are not linear all the way.
    pub lines: [Option<Line>; 2],
    /// Whether any value weighs something otherwise.
    pub weighs: bool,
}

/// The cells that weigh something, by class, as far as anybody asked.
#[derive(Default)]
pub struct Effects(Mutex<BTreeMap<String, Vec<Arc<Effect>>>>);

impl Effects {
    /// The cells of a class that weigh something, if they are known.
    pub fn of(&self, class: &str) -> Option<Vec<Arc<Effect>>> {
        self.0.lock().unwrap_or_else(PoisonError::into_inner).get(class).cloned()
    }

    /// Keeps what was found, unless it is very much.
    pub fn keep(&self, class: &str, found: &[Arc<Effect>]) {
        let size: usize = found.iter().flat_map(|effect| &effect.lines).flatten().map(Line::size).sum();
        if size <= MOST_KEPT {
            self.0.lock().unwrap_or_else(PoisonError::into_inner).insert(class.to_owned(), found.to_vec());
        }
    }
}
