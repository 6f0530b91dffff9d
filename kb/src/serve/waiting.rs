//! Whether what a request asks for is begun, or given up: nobody is told no of what is done all the same.

use std::sync::{Arc, OnceLock};

/// What becomes of a request that edits. Whoever comes first decides: the desk that begins, or the request that is late.
#[derive(Clone, Debug, Default)]
pub struct Waiting(Arc<OnceLock<bool>>);

impl Waiting {
    /// Begins what is asked for; `false` where it was given up.
    pub fn begin(&self) -> bool {
        *self.0.get_or_init(|| true)
    }

    /// Gives up what is asked for; `false` where it has begun.
    pub fn give_up(&self) -> bool {
        !*self.0.get_or_init(|| false)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_has_begun_is_not_given_up_and_what_was_given_up_does_not_begin() {
        let (begun, late) = (Waiting::default(), Waiting::default());
        assert!(begun.begin() && !begun.give_up() && begun.begin());
        assert!(late.give_up() && !late.begin() && late.give_up());
    }
}
