//! `[[loads]]` of `robots.toml`: what the robots can carry.

use adit_db::load::Load;
use adit_planners::read::{Code, Fields, Problem};

use super::names::{Named, name, robot};
use crate::site::not_negative;

/// The loads of the file. One is carried from the start where the file says so.
pub(super) fn loads(fields: &Fields<'_, '_>, named: &Named, problems: &mut Vec<Problem>) -> Vec<Load> {
    let mut rows: Vec<Load> = Vec::new();
    for entry in fields.tables("loads", "[[loads]]", problems) {
        entry.refuse_unknown(&["robot", "load", "height", "width", "carried"], problems);
        let robot = robot(&entry, problems);
        let load = name(&entry, "load", problems);
        let sizes = ["height", "width"].map(|key| not_negative(&entry, key, problems));
        let carried =
            if entry.get("carried").is_some() { entry.truth("carried", problems) } else { Some(false) };
        let (Some(load), [Some(height), Some(width)], Some(carried)) = (load, sizes, carried) else {
            continue;
        };
        if !named.has_robot(&robot) {
            let message = format!("`{}` is a load of robot `{robot}`, which has no state here", load.value);
            problems.push(entry.text.problem(Code::WrongType, &entry.span, message));
        }
        if rows.iter().any(|row| row.robot == robot && row.load == load.value) {
            let message = format!("load `{}` of robot `{robot}` stands here twice", load.value);
            problems.push(entry.text.problem(Code::DuplicatePlace, &load.span, message));
            continue;
        }
        rows.push(Load { robot, load: load.value, height, width, carried });
    }
    rows
}
