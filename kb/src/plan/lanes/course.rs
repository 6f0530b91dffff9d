//! A lane graph as a site.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use adit_db::load::Load;
use adit_db::place::Place;
use adit_planners::lanes::{LaneGraph, Node, read_lane_graph};
use adit_planners::planner::Planner;

use super::judge::{Judge, class};
use super::routes::Routes;
use super::travel::{Carried, Carrying};
use super::{seed, tables};
use crate::error::{Error, Result};
use crate::plan::consult::Class;
use crate::plan::course::{Asked, Course, Pathfinder};
use crate::site::tables::TableFile;

/// Where nothing has a name, all nodes are places up to so many: routes are kept between any two of them.
const UNNAMED: usize = 60;

/// A lane graph as its file has it.
#[derive(Debug)]
pub struct LanesOf {
    pub file: PathBuf,
    pub graph: LaneGraph,
}

impl LanesOf {
    pub fn read(file: &Path) -> Result<Self> {
        let graph = read_lane_graph(file).map_err(|problem| Error::all([problem]))?;
        Ok(Self { file: file.to_owned(), graph })
    }

    /// Routes over the graph as its tables, facts and rules have it now.
    pub fn routes(&self, asked: &Asked<'_>) -> Result<Routes> {
        let now = tables::now(asked, &self.graph)?;
        let places = asked.objects("PLACES");
        let place = |row: usize| -> Result<Place> {
            let (x, y) = (places.needed(row, "x")?, places.needed(row, "y")?);
            Ok(Place { place: places.text(row, "place").unwrap_or_default(), x, y })
        };
        let places = places.rows().map(place).collect::<Result<Vec<_>>>()?;
        let judge = Judge::new(asked.consultation(&class())?);
        Ok(Routes::new(now, carrying(asked), places, judge))
    }
}

/// What is carried, as the table `loads` has it.
fn carrying(asked: &Asked<'_>) -> Carrying {
    let loads = asked.objects("LOADS");
    let carried = loads.rows().filter(|row| loads.truth(*row, "carried"));
    let of = |row: usize| {
        let load = loads.text(row, "load").unwrap_or_default();
        let height = loads.number(row, "height").unwrap_or(0.0);
        (loads.text(row, "robot").unwrap_or_default(), Carried { load, height })
    };
    carried.map(of).collect()
}

impl Course for LanesOf {
    fn name(&self) -> &'static str {
        "lane graph"
    }

    fn tables(&self) -> Vec<TableFile> {
        seed::tables(&self.file, &self.graph)
    }

    fn places(&self) -> Vec<Place> {
        let place = |name: &str, node: &Node| Place { place: name.to_owned(), x: node.at.x, y: node.at.y };
        let mut counts: BTreeMap<&String, usize> = BTreeMap::new();
        for name in self.graph.nodes.iter().filter_map(|node| node.name.as_ref()) {
            *counts.entry(name).or_default() += 1;
        }
        let mut places: BTreeMap<String, Place> = BTreeMap::new();
        for node in &self.graph.nodes {
            let Some(name) = &node.name else { continue };
            // one name on several levels is told apart by the node
            let name = if counts[name] == 1 { name } else { &node.node };
            places.insert(name.clone(), place(name, node));
        }
        for station in &self.graph.stations {
            let first = station.nodes.split(',').next().map(str::trim).unwrap_or_default();
            let Some(node) = self.graph.node(first) else { continue };
            let name = station.name.as_ref().unwrap_or(&station.station);
            places.entry(name.clone()).or_insert_with(|| place(name, node));
        }
        if places.is_empty() && self.graph.nodes.len() <= UNNAMED {
            return self.graph.nodes.iter().map(|node| place(&node.node, node)).collect();
        }
        places.into_values().collect()
    }

    fn loads(&self) -> Vec<Load> {
        let load = |of: &adit_planners::lanes::Load| Load {
            robot: of.vehicle_type.clone(),
            load: of.load.clone(),
            height: 0.0,
            width: 0.0,
            carried: false,
        };
        self.graph.loads.iter().map(load).collect()
    }

    fn notes(&self) -> Vec<String> {
        let mut notes = self.graph.notes.clone();
        if self.places().is_empty() && !self.graph.nodes.is_empty() {
            notes.push(format!(
                "none of {} nodes has a name, so that no routes are kept; `[[place]]` in site.toml names some, and a route may \
                 be asked for between any nodes",
                self.graph.nodes.len()
            ));
        }
        notes
    }

    fn planner(&self) -> Option<Arc<dyn Planner>> {
        None
    }

    fn asks(&self) -> Vec<Class> {
        vec![class()]
    }

    fn pathfinder(&self, asked: &Asked<'_>) -> Result<Box<dyn Pathfinder>> {
        Ok(Box::new(self.routes(asked)?))
    }
}
