//! Scenarios as JSON: one, or a file with several under `scenarios`.

use std::ops::Range;
use std::path::Path;

use adit_planners::adapt::{Object, Settings};
use adit_planners::read::{Code, Located, Problem, Text, in_words};
use serde::Deserialize;
use serde::de::IgnoredAny;
use serde_saphyr::{Location, Spanned};

use super::cell::{Cell, Change, Goal, Target, name_of};
use super::draft::{ArmDraft, Draft};
use crate::error::{self, Error, Result};

/// The version of the format that is read; a file that names none has it.
const VERSION: f64 = 1.0;

type Corners = Spanned<Vec<Spanned<[f64; 2]>>>;

/// What tells files apart, whatever else is in them.
#[derive(Deserialize)]
struct Head {
    version: Option<Spanned<f64>>,
    scenarios: Option<IgnoredAny>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Several {
    #[serde(rename = "version")]
    _version: Option<IgnoredAny>,
    #[serde(rename = "what")]
    _what: Option<IgnoredAny>,
    #[serde(rename = "figure5")]
    _figure5: Option<IgnoredAny>,
    scenarios: Vec<Written>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Written {
    #[serde(rename = "version")]
    _version: Option<IgnoredAny>,
    #[serde(rename = "what")]
    _what: Option<IgnoredAny>,
    #[serde(rename = "check")]
    _check: Option<IgnoredAny>,
    #[serde(rename = "cost")]
    _cost: Option<IgnoredAny>,
    #[serde(rename = "reference")]
    _reference: Option<IgnoredAny>,
    #[serde(rename = "check_step")]
    _check_step: Option<IgnoredAny>,
    name: Option<Spanned<String>>,
    links: Spanned<Vec<f64>>,
    link_radius: Spanned<f64>,
    base: Option<Spanned<[f64; 2]>>,
    joint_limits: Spanned<Vec<[f64; 2]>>,
    wrap: Option<Spanned<bool>>,
    obstacles: Vec<Corners>,
    added_obstacle: Option<Corners>,
    #[serde(default)]
    added_obstacles: Vec<Corners>,
    change_after_task: Option<Spanned<f64>>,
    tasks: Spanned<f64>,
    home: Spanned<Vec<f64>>,
    goals: Spanned<Vec<Spanned<Vec<f64>>>>,
    added_goal: Option<Spanned<Vec<f64>>>,
    #[serde(default)]
    added_goals: Vec<Spanned<Vec<f64>>>,
}

/// Reads the scenarios of a file; there is one at least.
pub fn read(path: &Path) -> Result<Vec<Cell>> {
    let name = path.display().to_string();
    if path.exists() && !path.is_file() {
        return Err(Error::all([Problem::of_file(Code::Unreadable, format!("`{name}` is no file"))]));
    }
    let text = std::fs::read_to_string(path).map_err(|error| Error::io("read", path, &error))?;
    parse(&name, &text, &name_of(path))
}

/// Reads the scenario of this name, or the only one.
pub fn one(path: &Path, name: Option<&str>) -> Result<Cell> {
    let mut cells = read(path)?;
    let at = match name {
        None if cells.len() == 1 => Some(0),
        None => None,
        Some(name) => cells.iter().position(|cell| cell.name == name),
    };
    at.map(|at| cells.swap_remove(at)).ok_or_else(|| {
        let names: Vec<&str> = cells.iter().map(|cell| cell.name.as_str()).collect();
        let message = match name {
            None => format!("{} has {} scenarios; name one with --scenario", path.display(), names.len()),
            Some(name) => format!("{} has no scenario {name}", path.display()),
        };
        Error::said(error::Code::PlanScenario, message, Some(format!("scenarios: {}", names.join(", "))))
    })
}

/// Reads a text; `file` is how messages call it, `name` what a scenario is called that has no name.
fn parse(file: &str, text: &str, name: &str) -> Result<Vec<Cell>> {
    let source = Text::new(file, text);
    let wrong = |error: serde_saphyr::Error| Error::all([explain(&source, &error)]);
    let head: Head = serde_saphyr::from_str(text).map_err(wrong)?;
    if let Some(version) = head.version.filter(|version| version.value != VERSION) {
        let message = format!(
            "the scenario is of version {} of the format; this program reads version {VERSION}",
            version.value
        );
        let problem = source.problem(Code::Impossible, &span_of(version.referenced), message);
        return Err(Error::all([problem.with_help("convert it, or use the program that wrote it")]));
    }
    let written = if head.scenarios.is_some() {
        serde_saphyr::from_str::<Several>(text).map_err(wrong)?.scenarios
    } else {
        vec![serde_saphyr::from_str::<Written>(text).map_err(wrong)?]
    };
    if written.is_empty() {
        return Err(Error::said(
            error::Code::Map(Code::Impossible),
            format!("{file} has no scenario in `scenarios`"),
            None,
        ));
    }
    let mut draft = Draft { text: &source, problems: Vec::new() };
    let names: Vec<(String, Range<usize>)> = written
        .iter()
        .map(|scenario| match &scenario.name {
            Some(name) => (name.value.clone(), span_of(name.referenced)),
            None => (name.to_owned(), span_of(scenario.links.referenced)),
        })
        .collect();
    draft.names("scenario", names.iter().map(|(name, span)| (name.as_str(), span.clone())));
    let cells: Vec<Cell> = written
        .into_iter()
        .zip(names)
        .filter_map(|(scenario, (name, _))| scenario.cell(name, &mut draft))
        .collect();
    if draft.problems.is_empty() { Ok(cells) } else { Err(Error::all(draft.problems)) }
}

impl Written {
    fn cell(self, name: String, draft: &mut Draft<'_>) -> Option<Cell> {
        if let Some(wrap) = self.wrap.filter(|wrap| wrap.value) {
            let span = span_of(wrap.referenced);
            draft.refuse(
                Code::Impossible,
                &span,
                "`wrap` is true, and joints that turn on for ever are not planned for",
            );
        }
        let tasks = count(draft, "tasks", &self.tasks, 1);
        let after =
            self.change_after_task.as_ref().and_then(|after| count(draft, "change_after_task", after, 0));
        let base = self.base.map_or(Located { value: [0.0; 2], span: 0..0 }, located);
        let arm = ArmDraft {
            lengths: located(self.links),
            radius: located(self.link_radius),
            base,
            limits: located(self.joint_limits),
        };
        let robot = draft.arm(&arm);
        let mut objects = |corners: Vec<Corners>, first: usize| -> Vec<Object> {
            let object = |(index, corners): (usize, Corners)| {
                let name = format!("obstacle {}", first + index);
                let span = span_of(corners.referenced);
                let corners = Located { value: corners.value.into_iter().map(located).collect(), span };
                draft.shape(&name, &corners).map(|shape| Object::fixed(name, shape))
            };
            corners.into_iter().enumerate().filter_map(object).collect()
        };
        let before = self.obstacles.len();
        let there = objects(self.obstacles, 1);
        let added =
            objects(self.added_obstacle.into_iter().chain(self.added_obstacles).collect(), before + 1);
        let home = draft.configuration("`home`", robot.as_ref(), &located(self.home));
        let mut goals = |goals: Vec<Spanned<Vec<f64>>>, first: usize| -> Vec<Goal> {
            let goal = |(index, at): (usize, Spanned<Vec<f64>>)| {
                let name = (first + index).to_string();
                let at = draft.configuration(&format!("goal {name}"), robot.as_ref(), &located(at))?;
                Some(Goal { name, target: Target::Configuration(at) })
            };
            goals.into_iter().enumerate().filter_map(goal).collect()
        };
        let known = self.goals.value.len();
        let span = span_of(self.goals.referenced);
        let goals_there = goals(self.goals.value, 1);
        let goals_added = goals(self.added_goal.into_iter().chain(self.added_goals).collect(), known + 1);
        if known < 2 {
            let message = format!(
                "`goals` has {known}; a task needs another goal than where the robot is, so two at least"
            );
            draft.refuse(Code::Impossible, &span, message);
        }
        let change = after.map(|after_task| Change { after_task, objects: added, goals: goals_added });
        Some(Cell {
            name,
            robot: robot?,
            objects: there,
            home: home?,
            goals: goals_there,
            settings: Settings::default(),
            change,
            tasks: tasks?,
        })
    }
}

fn count(draft: &mut Draft<'_>, key: &str, found: &Spanned<f64>, least: usize) -> Option<usize> {
    const MOST: f64 = 1e6;
    let value = found.value;
    if value.fract() == 0.0 && value >= least as f64 && value <= MOST {
        return Some(value as usize);
    }
    let message = format!("`{key}` is {value}; expected a whole number from {least} to {MOST}");
    draft.refuse(Code::WrongType, &span_of(found.referenced), message);
    None
}

fn explain(source: &Text, error: &serde_saphyr::Error) -> Problem {
    let error = error.without_snippet();
    let span = error.location().map_or(0..0, span_of);
    match error {
        serde_saphyr::Error::SerdeMissingField { field, .. } => {
            source.problem(Code::MissingKey, &span, format!("a scenario needs `{field}` here"))
        }
        serde_saphyr::Error::SerdeUnknownField { field, .. } => {
            source.problem(Code::UnknownKey, &span, format!("`{field}` is not a key of a scenario"))
        }
        other => source
            .problem(Code::Syntax, &span, format!("not a scenario: {}", in_words(other)))
            .with_help("a polygon is [[x, y], ...] in metres, a configuration one number a joint in radians"),
    }
}

pub(super) fn located<T>(spanned: Spanned<T>) -> Located<T> {
    Located { span: span_of(spanned.referenced), value: spanned.value }
}

pub(super) fn span_of(location: Location) -> Range<usize> {
    let span = location.span();
    let start = span.byte_offset().unwrap_or(0) as usize;
    start..start + span.byte_len().unwrap_or(0) as usize
}
