//! Lee's two planners as their users meet them: a part that is taken out of another (Table 1), and a robot in corridors
//! (Table 2). The numbers in `channels/` were verified apart from this program.

#[path = "channels/corridors.rs"]
mod corridors;
#[path = "channels/documented.rs"]
mod documented;
#[path = "channels/kept.rs"]
mod kept;
#[path = "channels/parts.rs"]
mod parts;
#[path = "channels/refused.rs"]
mod refused;
#[path = "channels/rules_steer.rs"]
mod rules_steer;
#[path = "channels/same_as_tables.rs"]
mod same_as_tables;
#[path = "channels/support.rs"]
mod support;

// What the planners' property tests steer by.
#[path = "../../planners/tests/assembly/chains.rs"]
#[allow(dead_code, clippy::unwrap_used)] // the planners' tests use more of it, and stop at a surprise
mod chains;
#[path = "../../planners/tests/assembly/table1.rs"]
mod table1;
#[path = "../../planners/tests/corridor/table2.rs"]
#[allow(dead_code)] // the planners' tests use more of it
mod table2;
