//! Cells as TOML: the table `[cell]` of a world.

use std::ops::Range;

use adit_planners::adapt::{Object, Settings};
use adit_planners::read::{Code, Fields, Located, Problem};

use super::cell::{Cell, Goal, RobotKind, Target};
use super::draft::{ArmDraft, Draft, pose};
use crate::site::figures::figures;

const ARM: [&str; 8] = ["links", "link_radius", "base", "joint_limits", "home", "object", "goal", "learning"];
const DISC: [&str; 6] = ["bounds", "radius", "home", "object", "goal", "learning"];

/// Reads `[cell]`; `name` is what its experience is kept under.
pub fn read(name: &str, fields: &Fields<'_, '_>, problems: &mut Vec<Problem>) -> Option<Cell> {
    let is_disc = fields.get("bounds").is_some();
    fields.refuse_unknown(if is_disc { &DISC } else { &ARM }, problems);
    let mut draft = Draft { text: fields.text, problems: Vec::new() };
    let robot = if is_disc { disc(fields, &mut draft, problems) } else { arm(fields, &mut draft, problems) };
    let objects = objects(fields, &mut draft, problems);
    let home = list(fields, "home", problems);
    let home = home.and_then(|home| draft.configuration("`home`", robot.as_ref(), &home));
    let goals = goals(fields, robot.as_ref(), &mut draft, problems);
    let mut settings = Settings::default();
    if let Some(table) = fields.table("learning", "[cell.learning]", problems) {
        figures(&table, Settings::FIGURES, &mut settings, problems);
    }
    draft.names("object", objects.iter().map(|(object, span)| (object.name.as_str(), span.clone())));
    draft.names("goal", goals.iter().map(|(goal, span)| (goal.name.as_str(), span.clone())));
    let objects: Vec<Object> = objects.into_iter().map(|(object, _)| object).collect();
    // An object that could not be read is not missing.
    if draft.problems.is_empty() && problems.is_empty() {
        draft.goals(&goals, &objects);
    }
    let is_well = draft.problems.is_empty() && problems.is_empty();
    problems.append(&mut draft.problems);
    let goals = goals.into_iter().map(|(goal, _)| goal).collect();
    let cell = Cell {
        name: name.to_owned(),
        robot: robot?,
        objects,
        home: home?,
        goals,
        settings,
        change: None,
        tasks: 0,
    };
    is_well.then_some(cell)
}

fn arm(fields: &Fields<'_, '_>, draft: &mut Draft<'_>, problems: &mut Vec<Problem>) -> Option<RobotKind> {
    let lengths = list(fields, "links", problems);
    let radius = or(fields, "link_radius", 0.0, problems);
    let base = match fields.get("base") {
        None => Some(Located { value: [0.0; 2], span: fields.span.clone() }),
        Some(_) => fields.numbers("base", problems),
    };
    let limits = fields.points("joint_limits", problems).map(|limits| Located {
        value: limits.value.iter().map(|limit| limit.value).collect(),
        span: limits.span,
    });
    draft.arm(&ArmDraft { lengths: lengths?, radius: radius?, base: base?, limits: limits? })
}

fn disc(fields: &Fields<'_, '_>, draft: &mut Draft<'_>, problems: &mut Vec<Problem>) -> Option<RobotKind> {
    let bounds = fields.numbers("bounds", problems);
    let radius = or(fields, "radius", 0.0, problems);
    draft.disc(&bounds?, &radius?)
}

fn objects(
    fields: &Fields<'_, '_>,
    draft: &mut Draft<'_>,
    problems: &mut Vec<Problem>,
) -> Vec<(Object, Range<usize>)> {
    let mut objects = Vec::new();
    for object in fields.tables("object", "[[cell.object]]", problems) {
        object.refuse_unknown(&["name", "polygon", "at", "heading", "movable"], problems);
        let name = object.string("name", problems);
        let corners = object.points("polygon", problems);
        let at = match object.get("at") {
            None => Some([0.0; 2]),
            Some(_) => object.numbers("at", problems).map(|at| at.value),
        };
        let degrees = or(&object, "heading", 0.0, problems);
        let is_movable =
            object.get("movable").is_some() && object.truth("movable", problems).unwrap_or(false);
        let (Some(name), Some(corners), Some(at), Some(degrees)) = (name, corners, at, degrees) else {
            continue;
        };
        if let Some(shape) = draft.shape(&name.value, &corners) {
            let pose = pose(at, degrees.value);
            objects.push((Object { name: name.value, shape, pose, is_movable }, name.span));
        }
    }
    objects
}

fn goals(
    fields: &Fields<'_, '_>,
    robot: Option<&RobotKind>,
    draft: &mut Draft<'_>,
    problems: &mut Vec<Problem>,
) -> Vec<(Goal, Range<usize>)> {
    let mut goals = Vec::new();
    for goal in fields.tables("goal", "[[cell.goal]]", problems) {
        goal.refuse_unknown(&["name", "configuration", "object", "tool", "heading"], problems);
        let name = goal.string("name", problems);
        let is_tool = goal.get("tool").is_some() || goal.get("object").is_some();
        if is_tool && goal.get("configuration").is_some() {
            let message = "a goal has either a `configuration`, or a `tool` at an `object`";
            draft.refuse(Code::Impossible, &goal.span, message);
            continue;
        }
        let target = if is_tool {
            let object = goal.string("object", problems);
            let tool = goal.numbers("tool", problems);
            let degrees = or(&goal, "heading", 0.0, problems);
            match (object, tool, degrees) {
                (Some(object), Some(tool), Some(degrees)) => {
                    Some(Target::Tool { object: object.value, pose: pose(tool.value, degrees.value) })
                }
                _ => None,
            }
        } else {
            let what = name.as_ref().map_or("a goal".to_owned(), |name| format!("goal {}", name.value));
            list(&goal, "configuration", problems)
                .and_then(|at| draft.configuration(&what, robot, &at))
                .map(Target::Configuration)
        };
        if let (Some(name), Some(target)) = (name, target) {
            goals.push((Goal { name: name.value, target }, name.span));
        }
    }
    goals
}

/// Finite numbers under a key that must be there.
fn list(fields: &Fields<'_, '_>, key: &str, problems: &mut Vec<Problem>) -> Option<Located<Vec<f64>>> {
    let Some(value) = fields.get(key) else {
        let message = format!("{} needs a `{key}`", fields.what);
        problems.push(fields.text.problem(Code::MissingKey, &fields.span, message));
        return None;
    };
    fields.list(key, value, problems).map(|numbers| Located { value: numbers, span: value.span() })
}

/// A number, or this one where the key is missing.
fn or(fields: &Fields<'_, '_>, key: &str, missing: f64, problems: &mut Vec<Problem>) -> Option<Located<f64>> {
    match fields.get(key) {
        None => Some(Located { value: missing, span: fields.span.clone() }),
        Some(_) => fields.number(key, problems),
    }
}
