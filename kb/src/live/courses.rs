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
        if before.rows() == rows {
            return Ok(Routes { rows: 0, changed: Some(0), rerouted: Some(0), ..routes });
        }
        let changed = now.changed(before);
        for route in &changed {
            routes.weigh(route.old, route.new);
        }
        routes.changed = Some(routes.shorter + routes.longer + routes.lost + routes.found);
        routes.rerouted = Some(changed.iter().filter(|route| route.is_rerouted()).count());
        routes.changes = changed
            .into_iter()
            .map(|route| RouteChange {
                robot: route.robot,
                start: route.start,
                goal: route.goal,
                old: route.old,
                new: route.new,
                other_way: Some(route.other_way),
            })
            .collect();
        routes.sort();
    }
    tx.replace_courses(&rows)?;
    Ok(routes)
}
