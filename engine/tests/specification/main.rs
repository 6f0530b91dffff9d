//! The engine's behaviour, as its users may rely on it.

// clippy knows test functions, but not their helpers.
#![allow(clippy::unwrap_used)]

mod asking;
mod conflicts;
mod consultation;
mod declarations;
mod dominated;
mod doors;
mod explanation;
mod hypotheses;
mod incremental;
mod incremental_cost;
mod interpreter;
mod joins;
mod limits;
mod manners;
mod misspelt;
mod order;
mod order_of_edits;
mod over;
mod priority;
mod quantifiers;
mod reaction_limits;
mod reactions;
mod readme;
mod revisions;
mod rule_tests;
mod support;
mod tables;
mod unknown;
mod waltz;
mod why_not;
mod wrong_files;
