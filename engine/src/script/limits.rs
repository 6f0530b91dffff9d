//! How much rules may take: time, steps, room.

use std::time::{Duration, Instant};

/// Steps that one run of an interpreted part may take, its closures included.
pub(super) const MAX_STEPS: u64 = 1_000_000;
/// Function calls inside each other.
pub(crate) const MAX_CALL_LEVELS: usize = 32;
/// Nesting of expressions, outside and inside functions.
pub(crate) const MAX_DEPTHS: (usize, usize) = (64, 32);
/// Bytes of a text.
pub(crate) const MAX_TEXT: usize = 64 * 1024;
pub(crate) const MAX_ARRAY: usize = 10_000;
pub(crate) const MAX_MAP: usize = 1_000;
/// Variables alive at once.
pub(crate) const MAX_VARIABLES: usize = 256;
pub(crate) const MAX_FUNCTIONS: usize = 128;
/// Stack of the threads that read rules and run them, in bytes: the deepest script allowed needs more than
/// 2 MiB in a debug build, and a stack overflow cannot be caught.
pub(crate) const STACK_BYTES: usize = 16 * 1024 * 1024;

#[derive(Clone, Copy, Debug)]
pub struct Limits {
    /// One rule in one inference.
    pub rule: Duration,
    /// All rules of one inference.
    pub inference: Duration,
    /// One run of reactions, with the inferences between them.
    pub reactions: Duration,
    /// Firings of one run of reactions.
    pub firings: usize,
    /// Matches of all rules that react, kept at once; some 200 bytes each.
    pub matches: usize,
    /// The moment at which all of it ends, inferences and questions after one another, whatever is left of the others.
    pub until: Option<Instant>,
}

impl Limits {
    /// When something has to end that begins now and may take so long.
    pub(crate) fn end(&self, time: Duration) -> Instant {
        let end = Instant::now() + time;
        self.until.map_or(end, |until| until.min(end))
    }
}

impl Default for Limits {
    fn default() -> Self {
        Self {
            rule: Duration::from_secs(10),
            inference: Duration::from_mins(1),
            reactions: Duration::from_mins(1),
            firings: 10_000,
            matches: 1_000_000,
            until: None,
        }
    }
}
