//! What is drawn of a cell.

use adit_planners::adapt::{Adapt, Configuration, between, collision, distance};
use adit_planners::geometry::{Point, Rect};

use super::cell::{Cell, Target};
use super::session::{Done, Session};
use crate::draw::{CellPicture, SpacePicture};

/// Finer than that the tool's way is not drawn, by the distance of configurations.
const STEP: f64 = 0.03;
/// Boxes along each side of a configuration space.
const BOXES: usize = 160;

/// The cell as it is, the paths of the tasks, and the experience.
pub fn drawn(session: &Session, tasks: &[Done]) -> CellPicture {
    drawn_of(session.cell(), session.adapt(), tasks)
}

/// A cell, the paths of the tasks, and the experience of a planner.
pub fn drawn_of(cell: &Cell, adapt: &Adapt, tasks: &[Done]) -> CellPicture {
    let robot = cell.robot.robot();
    let experience = adapt.experience();
    let tool = |at: &Configuration| robot.tool(at).at;
    let way = |path: &Vec<Configuration>| finely(path).iter().map(tool).collect::<Vec<Point>>();
    let paths: Vec<&Vec<Configuration>> =
        tasks.iter().filter_map(|done| Some(&done.report.as_ref()?.path)).collect();
    let edges: Vec<Vec<Configuration>> =
        experience.edges().filter_map(|edge| experience.path(edge.ends.0, edge.ends.1)).collect();
    let subgoals: Vec<&Configuration> = experience.vertices().map(|vertex| &vertex.at).collect();
    let start = paths.iter().find_map(|path| path.first());
    let mut goals: Vec<(String, Configuration)> = Vec::new();
    for goal in &cell.goals {
        if let Target::Configuration(at) = &goal.target {
            goals.push((goal.name.clone(), at.clone()));
        }
    }
    for done in tasks {
        if let Some(at) = done.at.as_ref().filter(|at| goals.iter().all(|(_, known)| known != *at)) {
            goals.push((done.goal.name.clone(), at.clone()));
        }
    }
    let reached: Vec<&Configuration> = tasks.iter().filter_map(|done| done.at.as_ref()).take(6).collect();
    let robots = start.into_iter().chain(reached);
    let space = (robot.limits().len() == 2).then(|| {
        let limits = robot.limits();
        let point = |at: &Configuration| Point::new(at[0], at[1]);
        let line = |path: &Vec<Configuration>| path.iter().map(point).collect();
        let limits = Rect::new(limits[0].low, limits[1].low, limits[0].high, limits[1].high);
        SpacePicture {
            limits,
            taken: taken(cell, &limits),
            goals: goals.iter().map(|(name, at)| (name.clone(), point(at))).collect(),
            paths: paths.iter().map(|path| line(path)).collect(),
            subgoals: subgoals.iter().map(|at| point(at)).collect(),
            edges: edges.iter().map(line).collect(),
        }
    });
    CellPicture {
        title: format!(
            "{}: {} tasks, {} subgoals, {} edges",
            cell.name,
            adapt.progress().tasks,
            subgoals.len(),
            edges.len()
        ),
        objects: cell.objects.iter().map(|object| (object.name.clone(), object.corners())).collect(),
        robots: robots.map(|at| cell.robot.joints(at)).collect(),
        radius_m: robot.links(&cell.home).iter().map(|link| link.radius).fold(0.0, f64::max),
        goals: goals.iter().map(|(name, at)| (name.clone(), tool(at))).collect(),
        paths: paths.iter().map(|path| way(path)).collect(),
        subgoals: subgoals.iter().map(|at| tool(at)).collect(),
        edges: edges.iter().map(way).collect(),
        space,
    }
}

/// A path with configurations in between, so that the tool's way is seen to bend.
fn finely(path: &[Configuration]) -> Vec<Configuration> {
    let mut fine: Vec<Configuration> = path.first().cloned().into_iter().collect();
    for pair in path.windows(2) {
        let steps = (distance(&pair[0], &pair[1]) / STEP).ceil().max(1.0) as usize;
        fine.extend((1..=steps).map(|step| between(&pair[0], &pair[1], step as f64 / steps as f64)));
    }
    fine
}

/// Where in a configuration space of two dimensions the robot touches something; boxes of a row are joined. It is looked at
/// for the picture alone, and counts for nothing.
fn taken(cell: &Cell, limits: &Rect) -> Vec<Rect> {
    let robot = cell.robot.robot();
    let (wide, high) = (limits.dx() / BOXES as f64, limits.dy() / BOXES as f64);
    let mut taken: Vec<Rect> = Vec::new();
    for row in 0..BOXES {
        let y0 = limits.y0 + row as f64 * high;
        let mut open: Option<Rect> = None;
        for column in 0..BOXES {
            let x0 = limits.x0 + column as f64 * wide;
            let middle = vec![x0 + wide / 2.0, y0 + high / 2.0];
            let is_taken = collision(robot.as_ref(), &cell.objects, &[middle]).is_some();
            match (&mut open, is_taken) {
                (Some(rect), true) => rect.x1 = x0 + wide,
                (None, true) => open = Some(Rect::new(x0, y0, x0 + wide, y0 + high)),
                (_, false) => taken.extend(open.take()),
            }
        }
        taken.extend(open);
    }
    taken
}
