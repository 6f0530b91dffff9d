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

/// What the values of a cell make of all weights.
pub struct Course {
    pub lever: Lever,
    /// Below and above the present value; `None` where weights are not linear all the way.
    pub lines: [Option<Line>; 2],
    /// Whether any value weighs something otherwise.
    pub weighs: bool,
}

/// The cells that weigh something, by class, as far as anybody asked.
#[derive(Default)]
pub struct Courses(Mutex<BTreeMap<String, Vec<Arc<Course>>>>);

impl Courses {
    /// The cells of a class that weigh something, if they are known.
    pub fn of(&self, class: &str) -> Option<Vec<Arc<Course>>> {
        self.0.lock().unwrap_or_else(PoisonError::into_inner).get(class).cloned()
    }

    pub fn keep(&self, class: &str, found: Vec<Arc<Course>>) {
        self.0.lock().unwrap_or_else(PoisonError::into_inner).insert(class.to_owned(), found);
    }
}
