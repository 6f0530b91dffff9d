//! What a question for a route says behind its question mark.

use std::collections::BTreeSet;

use crate::answer::Answer;
use crate::edit::Errand;
use crate::error::{Code, Result};
use crate::live::View;
use crate::serve::fault::{Answered, Fault};
use crate::state::State;

/// Goals that one question may name.
const GOALS: usize = 100;

/// What one errand may keep away from.
const AVOIDED: usize = 100;

/// From where, where to, whose, and how far an end may be moved.
pub struct Question {
    pub start: String,
    pub goals: Vec<String>,
    pub robot: Option<String>,
    pub within: Option<f64>,
    /// What people call the robot that follows the route.
    pub name: Option<String>,
    pub errand: Errand,
}

/// The longest word about a robot.
const SHORT: usize = 200;

/// What people can read at a glance: not empty, on one line, not without end. `what` is how it is called.
pub fn short(what: &str, text: &str) -> Answered<String> {
    let text = text.trim();
    if text.is_empty() || text.chars().any(char::is_control) || text.chars().count() > SHORT {
        let message = format!("`{what}` of a robot has 1 to {SHORT} characters, and stands on one line");
        return Err(Fault::new(Code::ServiceQuestion, message));
    }
    Ok(text.to_owned())
}

impl Question {
    pub fn read(query: &str) -> Answered<Self> {
        let (mut start, mut goals, mut robot, mut within, mut called) = (None, Vec::new(), None, None, None);
        let mut errand = Errand::default();
        let mut said = BTreeSet::new();
        for (name, value) in form_urlencoded::parse(query.as_bytes()) {
            let name = match &*name {
                "from" => "start",
                "to" => "goal",
                name => name,
            };
            if !["goal", "avoid"].contains(&name) && !said.insert(name.to_owned()) {
                let message = format!("a route has one `{name}`, and this question says it twice");
                return Err(Fault::new(Code::ServiceQuestion, message));
            }
            match name {
                "start" => start = Some(value.into_owned()),
                "goal" => goals.push(value.into_owned()),
                "robot" => robot = Some(value.into_owned()),
                "within" => {
                    let metres = value.parse().map_err(|_| {
                        Fault::new(
                            Code::RouteWithin,
                            format!("`within` is `{value}`, and is a number of metres"),
                        )
                    })?;
                    within = Some(metres);
                }
                "name" => called = Some(short("name", &value)?),
                "avoid" => errand.avoid.push(value.into_owned()),
                "load" => errand.load = Some(value.into_owned()),
                // a + that nobody wrote as %2B has become a blank, and in an instant there is no other
                "at" if value.contains('T') => errand.at = Some(value.replace(' ', "+")),
                "at" => errand.at = Some(value.into_owned()),
                "start_state" => errand.start_state = Some(value.into_owned()),
                "goal_state" => errand.goal_state = Some(value.into_owned()),
                other => {
                    let message = format!(
                        "a route has `start`, `goal`, `robot`, `within`, `avoid`, `load`, `at`, `start_state` and \
                         `goal_state`, and not `{other}`"
                    );
                    return Err(Fault::new(Code::ServiceQuestion, message));
                }
            }
        }
        if errand.avoid.len() > AVOIDED {
            let message = format!("a route has `avoid` up to {AVOIDED} times");
            return Err(Fault::new(Code::ServiceQuestion, message));
        }
        match start {
            Some(start) if (1..=GOALS).contains(&goals.len()) => {
                Ok(Self { start, goals, robot, within, name: called, errand })
            }
            _ => {
                let message = format!("a route needs `start`, and `goal` once, or up to {GOALS} times");
                Err(Fault::new(Code::ServiceQuestion, message).helped("/api/route?start=dock&goal=ward%206"))
            }
        }
    }

    /// The route where the errand is as any other; where an end is nothing, what is wrong with the question.
    pub fn answer(&self, view: &View) -> Answered<Answer> {
        let view = view.clone().within(self.within)?;
        checked(view.route(&self.start, &self.goals, self.robot.as_deref())?)
    }

    /// The route on an errand of its own, on a copy of what is known.
    pub fn answer_on_errand(&self, fork: State) -> Result<Answer> {
        fork.site.site().needs_rooms()?;
        let ends = (self.start.as_str(), self.goals.as_slice());
        fork.within(self.within)?.route_on_errand(&self.errand, ends, self.robot.as_deref())
    }
}

/// An answer; where an end is nothing, what is wrong with the question.
pub fn checked(answer: Answer) -> Answered<Answer> {
    match answer.status.code() {
        Some(code) => Err(Fault::new(code, answer.reason.unwrap_or_default())),
        None => Ok(answer),
    }
}
