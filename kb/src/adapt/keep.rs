//! What a task changed in the experience, as the store keeps it.

use std::collections::BTreeMap;

use adit_db::experience as rows;
use adit_engine::Considered;
use adit_planners::adapt::{
    Adapt, Clearance, Edge, Noted, ObjectChange, Outcome, Removal, Report, Vertex, VertexId,
};

use super::cell::Cell;
use super::judge::{strategy_word, told};
use crate::plan::decided;

/// All that happened since this was last asked, as a step.
pub(crate) fn step(
    cell: &Cell,
    seed: u64,
    copied_from: Option<&str>,
    adapt: &mut Adapt,
    considered: &[Considered],
) -> rows::Step {
    let noted = adapt.take_noted();
    let task = i64::from(adapt.progress().tasks);
    let mut step = rows::Step::default();
    let mut moved = BTreeMap::new();
    let mut changed = BTreeMap::new();
    let mut refused = BTreeMap::new();
    let mut tightened = BTreeMap::new();
    let mut objects_changed = false;
    for note in noted {
        match note {
            Noted::VertexAdded(vertex) => step.subgoals.push(subgoal(&vertex)),
            Noted::VertexMoved { id, at } => {
                moved.insert(i64::from(id.0), at);
            }
            Noted::VertexRemoved { id, why, task } => step.subgoals_removed.push(rows::Removed {
                number: i64::from(id.0),
                task: i64::from(task),
                because: removal(why),
                revision: None,
                object: None,
            }),
            Noted::EdgeAdded(edge) => {
                refused.remove(&pair(edge.ends));
                step.edges.push(edge_row(&edge));
            }
            Noted::EdgeVerified(edge) | Noted::EdgeLoosened(edge) => {
                changed.insert(edge.id, edge_row(&edge));
            }
            Noted::EdgeRemoved { id, why, task, revision, object, .. } => {
                step.edges_removed.push(rows::Removed {
                    number: i64::from(id.0),
                    task: i64::from(task),
                    because: removal(why),
                    revision: Some(i64::from(revision)),
                    object,
                });
            }
            Noted::CutRefused { ends, revision } => {
                refused.insert(pair(ends), i64::from(revision));
            }
            Noted::Tightened { ends, revision } => {
                tightened.insert(pair(ends), i64::from(revision));
            }
            Noted::Learned { object, clearance } => step.clearances.push(clearance_row(object, clearance)),
            Noted::ClearancesForgotten { object } => {
                step.clearances.retain(|known| known.object != object);
                step.clearances_forgotten.push(object);
            }
            Noted::ObjectChanged { object, how, revision } => {
                objects_changed = true;
                step.object_changes.push(rows::ObjectChange {
                    revision: i64::from(revision),
                    object,
                    task,
                    how: change(how),
                });
            }
            Noted::StrategyChosen { facts, strategy } => step.strategies.push(rows::Strategy {
                revision: i64::from(adapt.cell().revision()),
                task,
                strategy: strategy_word(strategy),
                facts: told(&facts).to_string(),
                rule: considered.iter().find(|rule| rule.miss.is_none()).map(decided),
            }),
            Noted::Forgotten => {
                step = rows::Step {
                    forgotten: Some(task),
                    object_changes: step.object_changes,
                    strategies: step.strategies,
                    ..rows::Step::default()
                };
                moved.clear();
                changed.clear();
                refused.clear();
                tightened.clear();
            }
            // Where the robot stands is in the row of the cell; what else may be noted some day is not kept.
            _ => {}
        }
    }
    step.cell = state(cell, seed, copied_from, adapt);
    step.objects = objects_changed.then(|| objects(adapt));
    step.moved = moved.into_iter().collect();
    step.edges_changed = changed.into_values().collect();
    let all = [(false, refused), (true, tightened)];
    step.subgoal_pairs = all
        .into_iter()
        .flat_map(|(tightened, pairs)| {
            pairs.into_iter().map(move |(ends, revision)| rows::Pair { ends, tightened, revision })
        })
        .collect();
    step
}

fn pair(ends: (VertexId, VertexId)) -> [i64; 2] {
    [i64::from(ends.0.0), i64::from(ends.1.0)]
}

fn state(cell: &Cell, seed: u64, copied_from: Option<&str>, adapt: &Adapt) -> rows::Cell {
    let progress = adapt.progress();
    let (next_subgoal, next_edge) = adapt.experience().next_numbers();
    rows::Cell {
        cell: cell.name.clone(),
        robot: cell.robot.text(),
        seed: seed.to_string(),
        tasks: i64::from(progress.tasks),
        revision: i64::from(adapt.cell().revision()),
        next_subgoal: i64::from(next_subgoal),
        next_edge: i64::from(next_edge),
        configuration: progress.here.clone(),
        stands: progress.vertex.map(|(vertex, _)| i64::from(vertex.0)),
        figures: super::figures::text(progress),
        copied_from: copied_from.map(str::to_owned),
    }
}

/// The objects as the planner has them.
pub(crate) fn objects(adapt: &Adapt) -> Vec<rows::Object> {
    let object = |placed: &adit_planners::adapt::Placed| rows::Object {
        object: placed.object.name.clone(),
        revision: i64::from(placed.since),
        times_moved: i64::from(placed.times_moved),
        movable: placed.object.is_movable,
        pose: [placed.object.pose.at.x, placed.object.pose.at.y, placed.object.pose.heading],
        polygon: placed.object.shape.corners().iter().map(|corner| [corner.x, corner.y]).collect(),
    };
    adapt.cell().placed().iter().map(object).collect()
}

/// A task with what came of it; `goal` is its name.
pub(crate) fn task(goal: &str, at: Option<&[f64]>, report: &Report, reason: Option<String>) -> rows::Task {
    let is_found = report.outcome == Outcome::Found;
    rows::Task {
        task: i64::from(report.task),
        goal: goal.to_owned(),
        configuration: at.map(<[f64]>::to_vec),
        reason,
        evaluations: report.evaluations as i64,
        solve_calls: report.tally.solves as i64,
        reach_calls: report.tally.reaches as i64,
        path: is_found.then(|| report.path.clone()),
        length: is_found.then_some(report.length),
    }
}

fn subgoal(vertex: &Vertex) -> rows::Subgoal {
    rows::Subgoal {
        subgoal: i64::from(vertex.id.0),
        configuration: vertex.at.clone(),
        tag: vertex.tag.as_ref().map(|tag| rows::Tag {
            object: tag.object.clone(),
            tool: [tag.tool.at.x, tag.tool.at.y, tag.tool.heading],
            branch: i64::from(tag.branch),
        }),
        made_task: i64::from(vertex.made_task),
    }
}

fn edge_row(edge: &Edge) -> rows::Edge {
    rows::Edge {
        edge: i64::from(edge.id.0),
        ends: [i64::from(edge.ends.0.0), i64::from(edge.ends.1.0)],
        via: edge.via.clone(),
        loose: edge.is_loose,
        length: edge.length,
        made_task: i64::from(edge.made_task),
        verified_task: i64::from(edge.verified_task),
        verified_revision: i64::from(edge.verified_revision),
        times_verified: i64::from(edge.times_verified),
    }
}

fn clearance_row(object: String, clearance: Clearance) -> rows::Clearance {
    match clearance {
        Clearance::Free { axis, within_m } => rows::Clearance {
            object,
            a: [axis.a.x, axis.a.y],
            b: Some([axis.b.x, axis.b.y]),
            within: within_m,
        },
        Clearance::Taken { at, within_m } => {
            rows::Clearance { object, a: [at.x, at.y], b: None, within: within_m }
        }
    }
}

const fn change(how: ObjectChange) -> &'static str {
    match how {
        ObjectChange::Appeared => "appeared",
        ObjectChange::Gone => "gone",
        ObjectChange::Moved => "moved",
        ObjectChange::Reshaped => "reshaped",
    }
}

const fn removal(why: Removal) -> &'static str {
    match why {
        Removal::Broken => "broken",
        Removal::GivenUp => "given up",
        Removal::Refused => "refused before execution",
        Removal::CutOff => "cut off",
        Removal::LandmarkGone => "its object is gone",
        Removal::OutOfReach => "out of reach",
        Removal::VertexRemoved => "its subgoal is gone",
        Removal::BeyondLimits => "beyond the robot's limits",
        _ => "removed",
    }
}
