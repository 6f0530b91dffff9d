//! The world of a planner, read from a TOML file.

use std::fs;
use std::path::{Path, PathBuf};

use adit_planners::read::{Document, Fields, Problem};

use super::assembly::Assembly;
use super::corridor::Corridor;
use crate::error::{Error, Result};

/// What is to be planned, and by which rules.
#[derive(Debug)]
pub struct World {
    /// Its name: that of the file, without the extension.
    pub name: String,
    /// The folder that it lies in.
    pub folder: PathBuf,
    /// The rule base: the name of a shipped one, or a folder beside the file.
    pub rules: String,
    /// What is to be planned.
    pub task: Task,
}

/// What is to be planned.
#[derive(Debug)]
pub enum Task {
    /// A part is to be taken out of another, in two dimensions.
    Assembly(Assembly<2>),
    /// The same in three.
    SolidAssembly(Assembly<3>),
    /// A robot is to drive through corridors.
    Corridor(Corridor),
}

impl World {
    /// Reads a file.
    pub fn read(path: &Path) -> Result<Self> {
        let text = fs::read_to_string(path).map_err(|error| Error::io("read", path, &error))?;
        let name = path.file_stem().map_or_else(String::new, |stem| stem.to_string_lossy().into_owned());
        let folder = path.parent().unwrap_or(Path::new("")).to_owned();
        let (rules, task) = parse(&path.display().to_string(), &text)?;
        Ok(Self { name, folder, rules, task })
    }
}

const KINDS: [&str; 2] = ["assembly", "corridor"];

/// Reads a text; `name` is how messages call the file.
fn parse(name: &str, text: &str) -> Result<(String, Task)> {
    let document = Document::parse(name, text).map_err(|error| Error::all(error.problems))?;
    let fields = document.fields("the world");
    let mut problems: Vec<Problem> = Vec::new();
    fields.refuse_unknown(&["rules", "assembly", "corridor"], &mut problems);
    let rules = match fields.get("rules") {
        None => super::rules::SHIPPED[0].to_owned(),
        Some(_) => fields.string("rules", &mut problems).map(|rules| rules.value).unwrap_or_default(),
    };
    let kinds: Vec<&str> = KINDS.into_iter().filter(|kind| fields.get(kind).is_some()).collect();
    let task = match kinds.as_slice() {
        ["assembly"] => fields
            .table("assembly", "[assembly]", &mut problems)
            .and_then(|fields| super::assembly::read(&fields, &mut problems)),
        ["corridor"] => fields
            .table("corridor", "[corridor]", &mut problems)
            .and_then(|fields| super::corridor::read(&fields, &mut problems))
            .map(Task::Corridor),
        [] => {
            let message = format!("{name} is no world of a planner");
            let help = format!("it needs a table [{}]", KINDS.join("] or ["));
            return Err(Error::said("plan/no-task", message, Some(help)));
        }
        several => {
            let message = format!("{name} has [{}]; one world has one of them", several.join("] and ["));
            return Err(Error::said("plan/two-tasks", message, None));
        }
    };
    match task {
        Some(task) if problems.is_empty() => Ok((rules, task)),
        _ => Err(Error::all(problems)),
    }
}

/// True or false under a key; false where it is missing.
pub(super) fn flag(fields: &Fields<'_, '_>, key: &str, problems: &mut Vec<Problem>) -> bool {
    fields.get(key).is_some() && fields.truth(key, problems).unwrap_or(false)
}
