//! Navigation on floor plans as its users meet it: paths, missions of a simulated robot, and rules that decide both.

#[path = "navigation/journeys.rs"]
mod journeys;
#[path = "navigation/learning.rs"]
mod learning;
#[path = "navigation/same_as_table.rs"]
mod same_as_table;

// What the planners' tests judge by.
#[path = "../../planners/tests/navigation/table.rs"]
mod table;
