//! Routes over maps that are not cut into rooms, as they are kept.

use adit_db::Tx;

use super::report::{RouteChange, Routes};
use crate::error::Result;
use crate::state::Courses;

/// Writes the routes of a step, where they are others than before; what changed between places. Where none are known from
/// before all are written.
pub fn keep(tx: &mut Tx<'_>, before: Option<&Courses>, now: &Courses) -> Result<Routes> {
    let rows = now.rows();
    let mut routes = Routes { starts: now.starts(), rows: rows.len() as u64, ..Routes::default() };
    if let Some(before) = before {
        let old = before.rows();
        if old == rows {
            return Ok(Routes { rows: 0, changed: Some(0), rerouted: Some(0), ..routes });
        }
        let way = |row: &adit_db::course::Course| {
            row.steps.iter().map(|step| step.place.clone()).collect::<Vec<_>>()
        };
        let pair = |row: &adit_db::course::Course| {
            let is_it = |other: &&adit_db::course::Course| {
                (&other.robot, &other.start, &other.goal) == (&row.robot, &row.start, &row.goal)
            };
            old.iter().find(is_it).cloned()
        };
        let (mut changed, mut rerouted) = (0, 0);
        for row in &rows {
            let was = pair(row);
            let other_way = was.as_ref().map(way) != Some(way(row));
            let is_changed = was.as_ref() != Some(row);
            let costs = [was.as_ref().and_then(|was| was.cost), row.cost].map(|cost| cost.map(f64::to_bits));
            changed += usize::from(costs[0] != costs[1]);
            let are_both = costs.iter().all(Option::is_some);
            rerouted += usize::from(is_changed && other_way && are_both);
            if is_changed && (costs[0].is_some() || costs[1].is_some()) {
                routes.changes.push(RouteChange {
                    robot: row.robot.clone(),
                    start: row.start.clone(),
                    goal: row.goal.clone(),
                    old: was.and_then(|was| was.cost),
                    new: row.cost,
                    other_way: Some(other_way),
                });
            }
        }
        for gone in old.iter().filter(|old| old.cost.is_some()) {
            let is_it = |row: &adit_db::course::Course| {
                (&gone.robot, &gone.start, &gone.goal) == (&row.robot, &row.start, &row.goal)
            };
            if !rows.iter().any(is_it) {
                changed += 1;
                let (robot, start, goal) = (gone.robot.clone(), gone.start.clone(), gone.goal.clone());
                routes.changes.push(RouteChange {
                    robot,
                    start,
                    goal,
                    old: gone.cost,
                    new: None,
                    other_way: Some(true),
                });
            }
        }
        (routes.changed, routes.rerouted) = (Some(changed), Some(rerouted));
        routes.sort();
    }
    tx.replace_courses(&rows)?;
    Ok(routes)
}
