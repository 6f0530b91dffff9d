//! Paths that the operator taught, as JSON: `[[a, b], ...]`, one configuration after the other.

use std::path::Path;

use adit_planners::adapt::Configuration;
use adit_planners::read::{Code, Located, Text};
use serde_saphyr::Spanned;

use super::cell::RobotKind;
use super::draft::Draft;
use super::scenario::located;
use crate::error::{Error, Result};

pub fn read(path: &Path, robot: &RobotKind) -> Result<Vec<Configuration>> {
    let text = std::fs::read_to_string(path).map_err(|error| Error::io("read", path, &error))?;
    let source = Text::new(&path.display().to_string(), &text);
    let written: Spanned<Vec<Spanned<Vec<f64>>>> = serde_saphyr::from_str(&text).map_err(|error| {
        let error = error.without_snippet();
        let span = error.location().map_or(0..0, super::scenario::span_of);
        let problem = source.problem(Code::Syntax, &span, format!("not a taught path: {error}"));
        Error::all([problem.with_help("expected [[a, b], ...]: one configuration after the other")])
    })?;
    let mut draft = Draft { text: &source, problems: Vec::new() };
    let Located { value: corners, span } = located(written);
    if corners.len() < 2 {
        let message =
            format!("a taught path has two configurations at least, and this one {}", corners.len());
        draft.refuse(Code::Impossible, &span, message);
    }
    let configuration = |(number, at): (usize, Spanned<Vec<f64>>)| {
        draft.configuration(&format!("configuration {number} of the path"), Some(robot), &located(at))
    };
    let taught: Vec<Configuration> = (1..).zip(corners).filter_map(configuration).collect();
    if draft.problems.is_empty() { Ok(taught) } else { Err(Error::all(draft.problems)) }
}
