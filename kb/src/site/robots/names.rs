//! The names of robots, states and loads, as the file has them.

use adit_planners::read::{Code, Fields, Located, Problem};

/// The robot's name where a file names none.
pub const ONLY_ROBOT: &str = "robot";

pub(super) fn robot(entry: &Fields<'_, '_>, problems: &mut Vec<Problem>) -> String {
    if entry.get("robot").is_none() {
        return ONLY_ROBOT.to_owned();
    }
    let Some(robot) = name(entry, "robot", problems) else { return String::new() };
    if robot.value.contains('/') {
        let message = format!("`robot` is `{}`; a `/` parts robot and state in a row's key", robot.value);
        problems.push(entry.text.problem(Code::WrongType, &robot.span, message));
    }
    robot.value
}

pub(super) fn name(
    entry: &Fields<'_, '_>,
    key: &str,
    problems: &mut Vec<Problem>,
) -> Option<Located<String>> {
    let text = entry.string(key, problems)?;
    if text.value.trim().is_empty() {
        let message = format!("`{key}` is empty");
        problems.push(entry.text.problem(Code::EmptyName, &text.span, message));
        return None;
    }
    if text.value.contains(char::is_control) {
        let message = format!("`{key}` is {:?} and holds a control character", text.value);
        problems.push(entry.text.problem(Code::EmptyName, &text.span, message));
        return None;
    }
    Some(text)
}
