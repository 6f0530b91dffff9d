//! Robots that learn in cells as their users meet them: tasks, restarts, changes, rules, SQL, experiments.

#[path = "adapt/documented.rs"]
mod documented;
#[path = "adapt/experiments.rs"]
mod experiments;
#[path = "adapt/journeys.rs"]
mod journeys;
#[path = "adapt/killed.rs"]
mod killed;
#[path = "adapt/refused.rs"]
mod refused;
#[path = "adapt/rules_decide.rs"]
mod rules_decide;
#[path = "adapt/support.rs"]
mod support;
