//! Navigation on floor plans as its users meet it: paths, missions of a simulated robot, and rules that decide both.

mod bad_input;
mod broken_rules;
mod flat;
mod hidden_speeds;
mod journeys;
mod kept;
mod learning;
mod maps;
mod on_rooms;
mod position;
mod same_as_table;
mod sensors;
mod together;
mod told;
mod why;

// What the planners' tests judge by.
#[path = "../../../planners/tests/specification/navigation/table.rs"]
mod table;
