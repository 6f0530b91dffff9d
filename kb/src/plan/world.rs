//! The world of a planner, read from a TOML file.

use std::fs;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use adit_engine::RuleBase;
use adit_planners::read::{Document, Problem};

use super::assembly::Assembly;
use super::corridor::Corridor;
use super::course::Course;
use super::drives::CorridorsOf;
use super::parts::PartsOf;
use super::rules::{self, Kind};
use crate::adapt::{self, Cell, CellOf};
use crate::error::{Code, Error, Result};
use crate::navigation::course::FloorOf;
use crate::navigation::floor::Floor;
use crate::navigation::reading;

/// What is to be planned, and by which rules.
#[derive(Debug)]
pub struct World {
    /// Its name: that of the file, without the extension.
    pub name: String,
    pub folder: PathBuf,
    /// The rule base: the name of a shipped one, or a folder beside the file.
    pub rules: String,
    pub task: Task,
}

#[derive(Debug)]
pub enum Task {
    /// A part is to be taken out of another, in two dimensions.
    Assembly(Assembly<2>),
    SolidAssembly(Assembly<3>),
    /// A robot is to drive through corridors.
    Corridor(Corridor),
    /// A robot is to find its way on a floor plan.
    FloorPlan(Box<Floor>),
    /// A robot is to learn in a cell.
    Cell(Box<Cell>),
}

impl Task {
    /// What kind of rules decide.
    pub const fn kind(&self) -> Kind {
        match self {
            Self::FloorPlan(_) => Kind::Navigation,
            Self::Cell(_) => Kind::Adapt,
            _ => Kind::Channels,
        }
    }
}

impl World {
    /// Reads its rules, or those that stand instead of them: a shipped rule base by its name, else a folder, beside the
    /// world's file where the world names it. What the world tells, rules may speak of.
    ///
    /// # Returns
    /// The rules, by what name or in which folder they are found again, and what is worth a look, as text.
    pub fn rules(&self, instead: Option<&str>) -> Result<(Arc<RuleBase>, String, Vec<String>)> {
        let (name, beside) = match instead {
            Some(rules) => (rules, Path::new("")),
            None => (self.rules.as_str(), self.folder.as_path()),
        };
        let kind = self.task.kind();
        let mut schema = kind.schema();
        if let Task::FloorPlan(floor) = &self.task {
            for (name, of) in floor.told.further() {
                schema.add("WAYS", name, of);
            }
        }
        let (rules, remarks) = rules::load_by(kind, name, beside, &schema)?;
        let is_shipped = kind.shipped().contains(&name);
        let found = if is_shipped { name.to_owned() } else { beside.join(name).display().to_string() };
        Ok((rules, found, remarks))
    }

    /// Reads a file of a world, or of scenarios (.json); of several scenarios the one of this name is taken.
    pub fn read_one(path: &Path, scenario: Option<&str>) -> Result<Self> {
        if !adapt::is_scenario(path) {
            if scenario.is_none() {
                return Self::read(path);
            }
            let message = format!("{} has no scenarios to choose from: it is no .json", path.display());
            return Err(Error::said(Code::PlanScenario, message, None));
        }
        let cell = adapt::scenario::one(path, scenario)?;
        let folder = path.parent().unwrap_or(Path::new("")).to_owned();
        let rules = Kind::Adapt.shipped()[0].to_owned();
        Ok(Self { name: cell.name.clone(), folder, rules, task: Task::Cell(Box::new(cell)) })
    }

    pub fn read(path: &Path) -> Result<Self> {
        let text = fs::read_to_string(path).map_err(|error| Error::io("read", path, &error))?;
        let name = path.file_stem().map_or_else(String::new, |stem| stem.to_string_lossy().into_owned());
        let folder = path.parent().unwrap_or(Path::new("")).to_owned();
        let (rules, task) = parse(&path.display().to_string(), &text, &name, &folder)?;
        let rules = rules.unwrap_or_else(|| task.kind().shipped()[0].to_owned());
        Ok(Self { name, folder, rules, task })
    }
}

/// The planner of a map that is not cut into rooms.
pub fn course(map: &Path) -> Result<Box<dyn Course>> {
    let world = World::read(map)?;
    let file = map.to_owned();
    Ok(match world.task {
        Task::Corridor(corridor) => Box::new(CorridorsOf { file, corridor }),
        Task::Assembly(assembly) => Box::new(PartsOf { file, assembly }),
        Task::SolidAssembly(assembly) => Box::new(PartsOf { file, assembly }),
        Task::FloorPlan(floor) => Box::new(FloorOf { file, floor: *floor }),
        Task::Cell(cell) => Box::new(CellOf { file, cell: *cell }),
    })
}

const KINDS: [&str; 4] = ["assembly", "corridor", "floor_plan", "cell"];

/// Reads a text; `name` is how messages call the file, `world` what it is called, `folder` where it lies.
fn parse(name: &str, text: &str, world: &str, folder: &Path) -> Result<(Option<String>, Task)> {
    let document = Document::parse(name, text).map_err(|error| Error::all(error.problems))?;
    let fields = document.fields("the world");
    let mut problems: Vec<Problem> = Vec::new();
    let mut keys = vec!["rules", "assembly", "corridor", "floor_plan", "cell"];
    if fields.get("floor_plan").is_some() {
        keys.extend(reading::keys());
    }
    fields.refuse_unknown(&keys, &mut problems);
    let rules = match fields.get("rules") {
        None => None,
        Some(_) => fields.string("rules", &mut problems).map(|rules| rules.value),
    };
    let kinds: Vec<&str> = KINDS.into_iter().filter(|kind| fields.get(kind).is_some()).collect();
    let task = match kinds.as_slice() {
        ["assembly"] => fields.table("assembly", "[assembly]", &mut problems).and_then(|fields| {
            if super::assembly::is_solid(&fields) {
                super::assembly::read(&fields, &mut problems).map(Task::SolidAssembly)
            } else {
                super::assembly::read(&fields, &mut problems).map(Task::Assembly)
            }
        }),
        ["corridor"] => fields
            .table("corridor", "[corridor]", &mut problems)
            .and_then(|fields| super::corridor::read(&fields, &mut problems))
            .map(Task::Corridor),
        ["floor_plan"] => match fields.table("floor_plan", "[floor_plan]", &mut problems) {
            Some(floor) => reading::read(&fields, &floor, folder, &mut problems)?
                .map(|floor| Task::FloorPlan(Box::new(floor))),
            None => None,
        },
        ["cell"] => fields
            .table("cell", "[cell]", &mut problems)
            .and_then(|fields| adapt::world::read(world, &fields, &mut problems))
            .map(|cell| Task::Cell(Box::new(cell))),
        [] => {
            let message = format!("{name} is no world of a planner");
            let help = format!("it needs a table [{}]", KINDS.join("] or ["));
            return Err(Error::said(Code::PlanNoTask, message, Some(help)));
        }
        several => {
            let message = format!("{name} has [{}]; one world has one of them", several.join("] and ["));
            return Err(Error::said(Code::PlanTwoTasks, message, None));
        }
    };
    match task {
        Some(task) if problems.is_empty() => Ok((rules, task)),
        _ => Err(Error::all(problems)),
    }
}
