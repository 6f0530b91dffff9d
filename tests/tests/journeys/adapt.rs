//! Robots that learn in cells as their users meet them: tasks, restarts, changes, rules, SQL, experiments.

mod documented;
mod experiments;
mod journeys;
mod killed;
mod refused;
mod rules_decide;
mod support;
