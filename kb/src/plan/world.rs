//! Maps that are not cut into rooms, read from TOML files.

use std::fs;
use std::path::Path;

use adit_planners::lanes::is_lane_graph;
use adit_planners::read::{Document, Problem};

use super::assembly::Assembly;
use super::corridor::Corridor;
use super::course::Course;
use super::drives::CorridorsOf;
use super::lanes::course::LanesOf;
use super::parts::PartsOf;
use crate::adapt::{self, Cell, CellOf};
use crate::error::{Code, Error, Result};
use crate::navigation::course::FloorOf;
use crate::navigation::floor::Floor;
use crate::navigation::reading;

/// What is on the map.
#[derive(Debug)]
pub enum World {
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

impl World {
    pub fn read(map: &Path) -> Result<Self> {
        let text = fs::read_to_string(map).map_err(|error| Error::io("read", map, &error))?;
        let name = map.file_stem().map_or_else(String::new, |stem| stem.to_string_lossy().into_owned());
        let folder = map.parent().unwrap_or(Path::new(""));
        parse(&map.display().to_string(), &text, &name, folder)
    }
}

/// The planner of a map that is not cut into rooms.
pub fn course(map: &Path) -> Result<Box<dyn Course>> {
    if is_lane_graph(map) {
        return Ok(Box::new(LanesOf::read(map)?));
    }
    let file = map.to_owned();
    Ok(match World::read(map)? {
        World::Corridor(corridor) => Box::new(CorridorsOf { file, corridor }),
        World::Assembly(assembly) => Box::new(PartsOf { file, assembly }),
        World::SolidAssembly(assembly) => Box::new(PartsOf { file, assembly }),
        World::FloorPlan(floor) => Box::new(FloorOf { file, floor: *floor }),
        World::Cell(cell) => Box::new(CellOf { file, cell: *cell }),
    })
}

const KINDS: [&str; 4] = ["assembly", "corridor", "floor_plan", "cell"];

/// Reads a text; `name` is how messages call the file, `called` what the map is called, `folder` where it lies.
fn parse(name: &str, text: &str, called: &str, folder: &Path) -> Result<World> {
    let document = Document::parse(name, text).map_err(|error| Error::all(error.problems))?;
    let fields = document.fields("the map");
    let mut problems: Vec<Problem> = Vec::new();
    let mut keys = vec!["rules", "assembly", "corridor", "floor_plan", "cell"];
    if fields.get("floor_plan").is_some() {
        keys.extend(reading::keys());
    }
    fields.refuse_unknown(&keys, &mut problems);
    if fields.get("rules").is_some() {
        fields.string("rules", &mut problems);
    }
    let kinds: Vec<&str> = KINDS.into_iter().filter(|kind| fields.get(kind).is_some()).collect();
    let world = match kinds.as_slice() {
        ["assembly"] => fields.table("assembly", "[assembly]", &mut problems).and_then(|fields| {
            if super::assembly::is_solid(&fields) {
                super::assembly::read(&fields, &mut problems).map(World::SolidAssembly)
            } else {
                super::assembly::read(&fields, &mut problems).map(World::Assembly)
            }
        }),
        ["corridor"] => fields
            .table("corridor", "[corridor]", &mut problems)
            .and_then(|fields| super::corridor::read(&fields, &mut problems))
            .map(World::Corridor),
        ["floor_plan"] => match fields.table("floor_plan", "[floor_plan]", &mut problems) {
            Some(floor) => reading::read(&fields, &floor, folder, &mut problems)?
                .map(|floor| World::FloorPlan(Box::new(floor))),
            None => None,
        },
        ["cell"] => fields
            .table("cell", "[cell]", &mut problems)
            .and_then(|fields| adapt::world::read(called, &fields, &mut problems))
            .map(|cell| World::Cell(Box::new(cell))),
        [] => {
            let message = format!("{name} is no map of corridors, parts, walls or a cell");
            let help = format!("it needs a table [{}]", KINDS.join("] or ["));
            return Err(Error::said(Code::PlanNoTask, message, Some(help)));
        }
        several => {
            let message = format!("{name} has [{}]; one map has one of them", several.join("] and ["));
            return Err(Error::said(Code::PlanTwoTasks, message, None));
        }
    };
    match world {
        Some(world) if problems.is_empty() => Ok(world),
        _ => Err(Error::all(problems)),
    }
}
