//! Lee's two planners as their users meet them: a part that is taken out of another (Table 1), and a robot in corridors
//! (Table 2). The numbers in `channels/` were verified apart from this program.

mod corridors;
mod documented;
mod kept;
mod parts;
mod refused;
mod rules_steer;
mod same_as_tables;
mod support;

// What the planners' property tests steer by.
#[path = "../../../planners/tests/specification/assembly/chains.rs"]
#[allow(dead_code, clippy::unwrap_used)] // the planners' tests use more of it, and stop at a surprise
mod chains;
#[path = "../../../planners/tests/specification/assembly/table1.rs"]
mod table1;
#[path = "../../../planners/tests/specification/corridor/table2.rs"]
#[allow(dead_code)] // the planners' tests use more of it
mod table2;
