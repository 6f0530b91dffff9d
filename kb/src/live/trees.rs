//! Which routes are kept, and their trees as rows: for each start the last step into each room and place.

mod ends;
mod measured;
mod on_doors;

use adit_db::Tx;
use adit_db::tree::{Start as StartRow, TreeChange, TreeRow};
use adit_planners::routes::Start;
use ends::{ALL_STARTS_UP_TO, ends, keeps_rooms};
use rayon::prelude::*;

use super::report::Routes;
use crate::error::{Code, Error, Result};
use crate::graph::gauge::Gauge;
use crate::graph::pairs::PlaceCosts;
use crate::graph::{End, SiteGraph};
use crate::site::Starts;
use crate::state::before::Before;
use crate::state::{State, Step};
use crate::words::progress::Progress;
use crate::words::suggest::did_you_mean;

/// The trees to be kept.
#[derive(Clone, Debug, Default)]
pub struct Plan {
    /// The names of starts, with their robot and tree.
    pub starts: Vec<StartRow>,
    /// For each tree, by number from 1: its robot and where it begins.
    pub roots: Vec<(String, Start)>,
}

impl Plan {
    /// The first start of a tree.
    pub fn start(&self, tree: i64) -> Option<&StartRow> {
        self.starts.iter().find(|start| start.tree == tree)
    }

    /// What the routes of a tree between places cost.
    pub fn place_costs(&self, graph: &SiteGraph, tree: i64, rows: &[TreeRow]) -> PlaceCosts {
        let of_places = rows.iter().filter_map(|row| Some((graph.place_of(row.node)?, row.reach)));
        // rooms are called otherwise where they are cut anew
        let is_place = |start: &&StartRow| graph.places.iter().any(|place| place.place == start.name);
        let Some(start) = self.start(tree).filter(is_place) else { return PlaceCosts::new() };
        of_places
            .map(|(goal, cost)| ((start.robot.clone(), start.name.clone(), goal.to_owned()), cost))
            .collect()
    }
}

/// Decides which routes are kept.
///
/// # Arguments
/// `robots` are the robots of the site; `wanted` is what `site.toml` says.
pub fn plan(
    (graph, gauge): (&SiteGraph, &Gauge),
    robots: &[String],
    wanted: Option<&Starts>,
) -> Result<Plan> {
    let by_state = !graph.robots().is_empty();
    let names: Vec<&str> = match wanted {
        Some(Starts::Named(names)) => known(graph, names)?,
        Some(Starts::All) => graph.names().collect(),
        None if !by_state && graph.rooms.len() <= ALL_STARTS_UP_TO => graph.names().collect(),
        None => graph.places.iter().map(|place| place.place.as_str()).collect(),
    };
    let mut plan = Plan::default();
    for robot in robots {
        for name in &names {
            let Some(end) = graph.end(name) else { continue };
            if let End::Room(index) = end
                && graph[index].layer.as_ref().is_some_and(|(of, _)| of != robot)
            {
                continue;
            }
            let mut start = graph.start(Some(gauge), &end, Some(robot));
            if !by_state {
                // all hardness lies on the doors, so every point of a room starts the same tree
                start.at = start.rooms.first().map_or(start.at, |entry| graph.point(&End::Room(entry.room)));
            }
            let root = (robot.clone(), start);
            let shared = if by_state { None } else { plan.roots.iter().position(|known| *known == root) };
            let tree = shared.unwrap_or_else(|| {
                plan.roots.push(root);
                plan.roots.len() - 1
            });
            plan.starts.push(StartRow {
                name: (*name).to_owned(),
                robot: robot.clone(),
                tree: tree as i64 + 1,
            });
        }
    }
    Ok(plan)
}

fn known<'a>(graph: &SiteGraph, names: &'a [String]) -> Result<Vec<&'a str>> {
    for (index, name) in names.iter().enumerate() {
        if names[..index].contains(name) {
            return Err(Error::said(Code::SiteStarts, format!("`starts` names `{name}` twice"), None));
        }
        if !matches!(graph.end(name), Some(End::Place(_) | End::Room(_))) {
            let help = did_you_mean(name, graph.names());
            return Err(Error::said(
                Code::SiteUnknownStart,
                format!("`starts` names `{name}`, which is no place or room"),
                help,
            ));
        }
    }
    Ok(names.iter().map(String::as_str).collect())
}

/// The rows of some trees, computed side by side, each in the order of its nodes.
pub fn rows(graph: &SiteGraph, roots: &[(String, Start)], gauge: &Gauge) -> Vec<Vec<TreeRow>> {
    if graph.graph().is_on_doors() {
        return roots.par_iter().map(|root| on_doors::rows(graph, root)).collect();
    }
    roots.par_iter().map(|root| measured::rows(graph, root, gauge)).collect()
}

/// How the routes that are kept so far are known.
#[derive(Clone, Copy)]
pub enum KeptSoFar<'a> {
    /// Rooms and doors are cut anew: they are those of another floor.
    OfAnotherCut,
    /// As the database has them.
    Stored,
    /// As they follow from this graph and plan; over doors they are found in less time than read.
    Of(&'a SiteGraph, &'a Plan),
}

/// The routes that are to be kept once a step is accepted, and what is kept so far, looked at before anything is written.
pub struct ToKeep<'a> {
    plan: Plan,
    before: Before<'a>,
    so_far: KeptSoFar<'a>,
    /// What routes between places cost so far; `None` where the starts are those of before, and rows can be compared.
    old: Option<PlaceCosts>,
}

impl<'a> ToKeep<'a> {
    pub fn look(
        tx: &mut Tx<'_>,
        (state, step): (&State, &Step),
        (before, so_far): (Before<'a>, KeptSoFar<'a>),
    ) -> Result<Self> {
        let site = &state.site;
        let graph: &SiteGraph = state.graph_after(step);
        let floor = (graph, state.gauge_after(step));
        let plan = plan(floor, &site.robots(tx)?, site.site().starts_in_rooms())?;
        let comparable = !matches!(so_far, KeptSoFar::OfAnotherCut) && before.same_starts(&plan.starts);
        let old = (!comparable).then(|| place_costs(tx, before, graph)).transpose()?;
        Ok(Self { plan, before, so_far, old })
    }
}

/// Keeps the routes of a state once a step is accepted. Where the starts are those of before, only rows that differ are
/// written.
pub fn keep(
    tx: &mut Tx<'_>,
    (state, step): (&State, &Step),
    ToKeep { plan, before, so_far, old }: ToKeep<'_>,
    progress: &dyn Progress,
) -> Result<(Plan, Routes)> {
    let graph: &SiteGraph = state.graph_after(step);
    let gauge = state.gauge_after(step);
    let comparable = old.is_none();
    let mut routes = Routes::new(plan.starts.len(), comparable);
    let mut new = PlaceCosts::new();
    let has_same_ends =
        matches!(so_far, KeptSoFar::Of(old, _) if comparable && keeps_rooms(old) == keeps_rooms(graph));
    let ends = (!has_same_ends).then(|| ends(graph)).transpose()?;
    if !comparable {
        tx.clear_trees()?;
        tx.replace_starts(&plan.starts)?;
    }
    if let Some(ends) = ends {
        tx.replace_ends(&ends)?;
    }
    for (batch, roots) in plan.roots.chunks(64).enumerate() {
        progress.stage(&format!("routes from {} of {} starts", batch * 64, plan.roots.len()));
        let trees = batch as i64 * 64 + 1..;
        let numbered = trees.clone().zip(rows(graph, roots, gauge));
        if comparable {
            let old = match so_far {
                KeptSoFar::Of(old, plan) if old.graph().is_on_doors() => {
                    rows(old, &plan.roots[batch * 64..][..roots.len()], gauge)
                }
                _ => {
                    let stored = trees.take(roots.len()).map(|tree| tx.tree_rows(tree));
                    stored.collect::<std::result::Result<_, _>>()?
                }
            };
            for ((tree, rows), old) in numbered.zip(old) {
                let Some(start) = plan.start(tree) else { continue };
                routes.count(before, (start, &old), &rows, graph);
                let change = TreeChange::between(&old, &rows);
                if !change.is_empty() {
                    tx.change_tree(tree, &change)?;
                }
                routes.rows += change.len() as u64;
            }
        } else {
            let numbered: Vec<_> = numbered.collect();
            for (tree, rows) in &numbered {
                new.extend(plan.place_costs(graph, *tree, rows));
            }
            let rows =
                numbered.into_iter().flat_map(|(tree, rows)| rows.into_iter().map(move |row| (tree, row)));
            routes.rows += tx.put_trees(rows)?;
        }
    }
    if !before.starts.is_empty() {
        routes.compare(before, &old.unwrap_or_default(), &new);
    }
    routes.sort();
    Ok((plan, routes))
}

/// What the kept routes between places cost so far; few enough to be asked one by one, or none.
fn place_costs(tx: &mut Tx<'_>, before: Before<'_>, graph: &SiteGraph) -> Result<PlaceCosts> {
    const ASKED: usize = 5_000;
    let is_place = |name: &str| graph.places.iter().any(|place| place.place == name);
    let starts: Vec<_> = before.starts.iter().filter(|start| is_place(&start.name)).collect();
    let mut costs = PlaceCosts::new();
    if starts.len() * graph.places.len() > ASKED {
        return Ok(costs);
    }
    for start in starts {
        for goal in &graph.places {
            if let Some(cost) = tx.route(&start.robot, &start.name, &goal.place)?.and_then(|route| route.cost)
            {
                costs.insert((start.robot.clone(), start.name.clone(), goal.place.clone()), cost);
            }
        }
    }
    Ok(costs)
}
