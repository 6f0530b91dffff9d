//! The engine's behaviour, as its users may rely on it.

// clippy knows test functions, but not their helpers.
#![allow(clippy::unwrap_used)]

mod conflicts;
mod doors;
mod explanation;
mod hypotheses;
mod incremental;
mod interpreter;
mod joins;
mod limits;
mod manners;
mod order;
mod priority;
mod quantifiers;
mod reaction_limits;
mod reactions;
mod revisions;
mod support;
mod unknown;
mod waltz;
mod wrong_files;
