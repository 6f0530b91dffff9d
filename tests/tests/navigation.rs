//! Navigation on floor plans as its users meet it: paths, missions of a simulated robot, and rules that decide both.

#[path = "navigation/bad_input.rs"]
mod bad_input;
#[path = "navigation/broken_rules.rs"]
mod broken_rules;
#[path = "navigation/flat.rs"]
mod flat;
#[path = "navigation/journeys.rs"]
mod journeys;
#[path = "navigation/kept.rs"]
mod kept;
#[path = "navigation/learning.rs"]
mod learning;
#[path = "navigation/maps.rs"]
mod maps;
#[path = "navigation/position.rs"]
mod position;
#[path = "navigation/same_as_table.rs"]
mod same_as_table;
#[path = "navigation/told.rs"]
mod told;
#[path = "navigation/why.rs"]
mod why;

// What the planners' tests judge by.
#[path = "../../planners/tests/navigation/table.rs"]
mod table;
