//! A route as people tell it: stretches of one action.

use adit_planners::geometry::Point;

use super::scene::{Route, StepKind};

/// Consecutive steps of one action.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Run {
    pub action: Option<String>,
    pub state: Option<String>,
    /// Whether it begins with a change of shape.
    pub changed: bool,
    pub metres: f64,
    /// What it adds to the cost, the change of shape included.
    pub hardness: f64,
    pub places: Vec<String>,
    /// Its way; the first point is where the last run ended.
    pub points: Vec<Point>,
}

/// The runs of a route. A change of shape begins a run; a step without an action continues the last one.
pub(super) fn runs(route: &Route) -> Vec<Run> {
    let mut runs: Vec<Run> = Vec::new();
    let mut at = route.start.at;
    let mut changing = false;
    for step in &route.steps {
        let change = step.kind == StepKind::Change;
        let same = |run: &Run| step.action.is_none() || run.action == step.action;
        let continues = runs.last().is_some_and(|run| if change { changing } else { changing || same(run) });
        if !continues {
            runs.push(Run {
                action: None,
                state: None,
                changed: change,
                metres: 0.0,
                hardness: 0.0,
                places: Vec::new(),
                points: vec![at],
            });
        }
        if let Some(run) = runs.last_mut() {
            run.action = step.action.clone().or(run.action.take());
            run.state = step.state.clone().or(run.state.take());
            run.metres += at.distance(step.to);
            run.hardness += step.hardness;
            match step.kind {
                StepKind::Room => run.places.push(format!("room {}", step.place)),
                StepKind::Door => run.places.push(format!("door {}", step.place)),
                StepKind::Change => {}
            }
            run.points.push(step.to);
        }
        at = step.to;
        changing = change;
    }
    runs
}
