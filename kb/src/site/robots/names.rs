//! The names of robots, states and loads, as the file has them.

use adit_planners::read::{Code, Fields, Located, Problem};

/// The robot's name where a file names none.
pub const ONLY_ROBOT: &str = "robot";

/// What the entries of states call robots and states, whatever else is wrong with them: an empty name of a robot and a missing
/// one of a state are those that cannot be read.
#[derive(Default)]
pub(super) struct Named(Vec<(String, Option<String>)>);

impl Named {
    pub fn add(&mut self, robot: &str, state: Option<&str>) {
        self.0.push((robot.to_owned(), state.map(str::to_owned)));
    }

    /// Whether a robot has states here, as far as can be told.
    pub fn has_robot(&self, robot: &str) -> bool {
        self.of(robot).next().is_some()
    }

    /// Whether a robot has a state, as far as can be told.
    pub fn has_state(&self, robot: &str, state: &str) -> bool {
        robot.is_empty() || self.of(robot).any(|known| known.is_none_or(|known| known == state))
    }

    /// The states of a robot, and those that may be.
    pub fn of(&self, robot: &str) -> impl Iterator<Item = Option<&str>> {
        let is_of = move |of: &str| of == robot || of.is_empty() || robot.is_empty();
        self.0.iter().filter(move |(of, _)| is_of(of)).map(|(_, state)| state.as_deref())
    }
}

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
