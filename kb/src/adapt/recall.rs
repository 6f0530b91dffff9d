//! A planner that goes on from what the store kept.

use std::collections::BTreeSet;

use adit_db::experience as rows;
use adit_planners::adapt::{
    Adapt, Clearance, Edge, EdgeId, Experience, Object, Placed, Plugins, Progress, Settings, Shape, TagPoint,
    Vertex, VertexId, Workcell,
};
use adit_planners::geometry::{Point, Segment};
use adit_planners::pose::Pose;

use super::cell::{Cell, RobotKind};
use super::figures::Figures;
use crate::error::{Code, Error, Result};

/// The planner as it was after the last task that was kept.
pub(super) fn planner(
    cell: &Cell,
    kept: &rows::Experience,
    touching_m: f64,
    plugins: Plugins,
    mut settings: Settings,
) -> Result<Adapt> {
    of_robot(cell, kept)?;
    settings.seed = kept.cell.seed.parse().map_err(|_| damaged(kept, "its seed is no number"))?;
    let mut objects = Vec::new();
    for object in &kept.objects {
        let corners = object.polygon.iter().map(|&[x, y]| Point::new(x, y)).collect();
        let shape =
            Shape::new(corners).map_err(|error| damaged(kept, &format!("{}: {error}", object.object)))?;
        let [x, y, heading] = object.pose;
        let (since, times_moved) = (small(kept, object.revision)?, small(kept, object.times_moved)?);
        let object = Object {
            name: object.object.clone(),
            shape,
            pose: Pose::new(x, y, heading),
            is_movable: object.movable,
        };
        objects.push(Placed::with(object, since, times_moved));
    }
    let revision = small(kept, kept.cell.revision)?;
    let mut workcell = Workcell::resume(cell.robot.robot(), objects, revision, touching_m)
        .map_err(|error| damaged(kept, &error.to_string()))?;
    for known in &kept.clearances {
        if !workcell.recall(&known.object, &clearance(known)) {
            return Err(damaged(
                kept,
                &format!("something is known of object {}, which is not there", known.object),
            ));
        }
    }
    let experience = experience(kept)?;
    let Figures { tasks_before_change, stands_since_revision, tally } =
        serde_json::from_str(&kept.cell.figures).map_err(|_| damaged(kept, "its `figures` are none"))?;
    let vertex = match kept.cell.stands {
        Some(number) => Some((VertexId(small(kept, number)?), stands_since_revision.unwrap_or(revision))),
        None => None,
    };
    let (mut refused, mut tightened) = (BTreeSet::new(), BTreeSet::new());
    for pair in kept.subgoal_pairs.iter().filter(|pair| pair.revision == kept.cell.revision) {
        let ends = (VertexId(small(kept, pair.ends[0])?), VertexId(small(kept, pair.ends[1])?));
        let pairs = if pair.tightened { &mut tightened } else { &mut refused };
        pairs.insert(ends);
    }
    let progress = Progress {
        tasks: small(kept, kept.cell.tasks)?,
        tasks_before_change,
        here: kept.cell.configuration.clone(),
        vertex,
        tally,
        refused,
        tightened,
    };
    let limits = cell.robot.robot().limits().len();
    if progress.here.len() != limits || experience.vertices().any(|vertex| vertex.at.len() != limits) {
        return Err(damaged(kept, "its `configuration` is none of the robot"));
    }
    Ok(Adapt::resume(workcell, experience, plugins, settings, progress))
}

/// Refuses the experience of another robot than that of the cell. One that goes farther, or less far, is the same.
pub(super) fn of_robot(cell: &Cell, kept: &rows::Experience) -> Result<()> {
    let robot = cell.robot.text();
    if RobotKind::without_limits(&kept.cell.robot) == RobotKind::without_limits(&robot) {
        return Ok(());
    }
    let message = format!(
        "the experience of {} is of another robot: {}, and here it is: {robot}",
        kept.cell.cell, kept.cell.robot
    );
    let help = format!(
        "keep this one in another database, under another name of the file, or forget what the other one learned: \
         `DELETE FROM cells WHERE cell = '{}'`",
        kept.cell.cell.replace('\'', "''")
    );
    Err(Error::said(Code::PlanOtherRobot, message, Some(help)))
}

fn experience(kept: &rows::Experience) -> Result<Experience> {
    let mut vertices = Vec::new();
    for subgoal in &kept.subgoals {
        let tag = match &subgoal.tag {
            None => None,
            Some(tag) => {
                let [x, y, heading] = tag.tool;
                let branch =
                    u8::try_from(tag.branch).map_err(|_| damaged(kept, "a branch is out of range"))?;
                Some(TagPoint { object: tag.object.clone(), tool: Pose::new(x, y, heading), branch })
            }
        };
        vertices.push(Vertex {
            id: VertexId(small(kept, subgoal.subgoal)?),
            at: subgoal.configuration.clone(),
            tag,
            made_task: small(kept, subgoal.made_task)?,
        });
    }
    let mut edges = Vec::new();
    for edge in &kept.edges {
        edges.push(Edge {
            id: EdgeId(small(kept, edge.edge)?),
            ends: (VertexId(small(kept, edge.ends[0])?), VertexId(small(kept, edge.ends[1])?)),
            via: edge.via.clone(),
            is_loose: edge.loose,
            length: edge.length,
            made_task: small(kept, edge.made_task)?,
            verified_task: small(kept, edge.verified_task)?,
            verified_revision: small(kept, edge.verified_revision)?,
            times_verified: small(kept, edge.times_verified)?,
        });
    }
    let next = (small(kept, kept.cell.next_subgoal)?, small(kept, kept.cell.next_edge)?);
    Experience::from_rows(vertices, edges, next).map_err(|error| damaged(kept, &error.to_string()))
}

fn clearance(known: &rows::Clearance) -> Clearance {
    let a = Point::new(known.a[0], known.a[1]);
    match known.b {
        Some([x, y]) => Clearance::Free { axis: Segment::new(a, Point::new(x, y)), within_m: known.within },
        None => Clearance::Taken { at: a, within_m: known.within },
    }
}

fn small(kept: &rows::Experience, number: i64) -> Result<u32> {
    u32::try_from(number).map_err(|_| damaged(kept, &format!("{number} is no number of a row")))
}

fn damaged(kept: &rows::Experience, what: &str) -> Error {
    let message = format!("the experience of {} cannot be read: {what}", kept.cell.cell);
    let help = format!("`DELETE FROM cells WHERE cell = '{}'` forgets it", kept.cell.cell);
    Error::said(Code::PlanDamagedExperience, message, Some(help))
}
