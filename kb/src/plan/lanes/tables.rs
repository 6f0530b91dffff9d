//! A lane graph as its tables have it now.

use std::collections::BTreeSet;

use adit_planners::geometry::Point;
use adit_planners::lanes::{
    Door, Lane, LaneGraph, Level, Lift, Node, Properties, Station, Use, VehicleType, Wall, refuse_wrong,
};

use crate::error::{Error, Result};
use crate::plan::course::{Asked, ObjectsOf, no_map};

/// A graph, and what of it is closed that has no column in it.
#[derive(Debug, Default)]
pub struct Now {
    pub graph: LaneGraph,
    pub closed_doors: BTreeSet<String>,
    pub closed_lifts: BTreeSet<String>,
    /// The nodes and lanes that its file says are closed, whatever tables say now.
    pub closed_in_file: [BTreeSet<String>; 2],
}

impl Now {
    /// The same with nothing closed.
    #[must_use]
    pub fn opened(&self) -> Self {
        let mut graph = self.graph.clone();
        graph.nodes.iter_mut().for_each(|node| node.closed = false);
        graph.lanes.iter_mut().for_each(|lane| lane.closed = false);
        Self { graph, ..Self::default() }
    }

    /// The graph whatever somebody closed or opened since it was read, which holds for now.
    pub fn lasting(&self) -> LaneGraph {
        let mut graph = self.graph.clone();
        let [nodes, lanes] = &self.closed_in_file;
        graph.nodes.iter_mut().for_each(|node| node.closed = nodes.contains(&node.node));
        graph.lanes.iter_mut().for_each(|lane| lane.closed = lanes.contains(&lane.lane));
        graph
    }
}

/// # Arguments
/// `file` gives what no table holds: the name, and what the file says as a whole.
pub fn now(asked: &Asked<'_>, file: &LaneGraph) -> Result<Now> {
    let mut graph = LaneGraph {
        name: file.name.clone(),
        properties: file.properties.clone(),
        notes: file.notes.clone(),
        ..LaneGraph::default()
    };
    let of = asked.objects("LEVELS");
    for row in of.rows() {
        let elevation = of.number(row, "elevation").unwrap_or(0.0);
        graph.levels.push(Level { level: id(of, row, "level")?, elevation, properties: rest(of, row)? });
    }
    // in the order of the file, where the table still has its levels
    let place =
        |level: &Level| file.levels.iter().position(|known| known.level == level.level).unwrap_or(usize::MAX);
    graph.levels.sort_by_key(place);
    nodes_and_lanes(asked, &mut graph)?;
    let nodes = file.nodes.iter().filter(|node| node.closed).map(|node| node.node.clone());
    let lanes = file.lanes.iter().filter(|lane| lane.closed).map(|lane| lane.lane.clone());
    let mut now = Now { closed_in_file: [nodes.collect(), lanes.collect()], ..Now::default() };
    let of = asked.objects("LANE_DOORS");
    for row in of.rows() {
        let door = id(of, row, "door")?;
        if of.truth(row, "closed") {
            now.closed_doors.insert(door.clone());
        }
        let (level, ends) = (id(of, row, "level")?, ends(of, row)?);
        graph.doors.push(Door { door, level, ends, kind: of.text(row, "kind") });
    }
    let of = asked.objects("LIFTS");
    for row in of.rows() {
        let lift = id(of, row, "lift")?;
        if of.truth(row, "closed") {
            now.closed_lifts.insert(lift.clone());
        }
        graph.lifts.push(Lift {
            lift,
            at: Point::new(of.needed(row, "x")?, of.needed(row, "y")?),
            yaw_degrees: of.number(row, "yaw").unwrap_or(0.0),
            width: of.number(row, "width"),
            depth: of.number(row, "depth"),
        });
    }
    let of = asked.objects("WALLS");
    for row in of.rows() {
        graph.walls.push(Wall { level: id(of, row, "level")?, ends: ends(of, row)? });
    }
    vehicles(asked, &mut graph)?;
    let of = asked.objects("STATIONS");
    for row in of.rows() {
        graph.stations.push(Station {
            station: id(of, row, "station")?,
            name: of.text(row, "name"),
            level: id(of, row, "level")?,
            nodes: of.text(row, "nodes").unwrap_or_default(),
            properties: rest(of, row)?,
        });
    }
    refuse_wrong(&graph).map_err(|wrong| no_map(wrong.message))?;
    Ok(Now { graph, ..now })
}

fn nodes_and_lanes(asked: &Asked<'_>, graph: &mut LaneGraph) -> Result<()> {
    let of = asked.objects("NODES");
    for row in of.rows() {
        let at = Point::new(of.needed(row, "x")?, of.needed(row, "y")?);
        graph.nodes.push(Node {
            name: of.text(row, "name"),
            lift: of.text(row, "lift"),
            is_parking_spot: of.truth(row, "is_parking_spot"),
            is_charger: of.truth(row, "is_charger"),
            is_holding_point: of.truth(row, "is_holding_point"),
            closed: of.truth(row, "closed"),
            number: number(of, row)?,
            properties: rest(of, row)?,
            ..Node::new(id(of, row, "node")?, &id(of, row, "level")?, at)
        });
    }
    graph.nodes.sort_by_key(|node| node.number.map_or(u64::MAX, u64::from));
    let of = asked.objects("LANES");
    for row in of.rows() {
        graph.lanes.push(Lane {
            lane: id(of, row, "lane")?,
            name: of.text(row, "name"),
            from: id(of, row, "from_node")?,
            to: id(of, row, "to_node")?,
            graph: of.text(row, "graph"),
            length: of.number(row, "length"),
            speed_limit: of.number(row, "speed_limit"),
            speed_share: of.number(row, "speed_share"),
            penalty: of.number(row, "penalty"),
            cost: of.number(row, "cost"),
            is_cost_fixed: of.truth(row, "is_cost_fixed"),
            orientation: of.text(row, "orientation"),
            door: of.text(row, "door"),
            lift: of.text(row, "lift"),
            action: of.text(row, "action"),
            closed: of.truth(row, "closed"),
            number: number(of, row)?,
            properties: rest(of, row)?,
        });
    }
    graph.lanes.sort_by_key(|lane| lane.number.map_or(u64::MAX, u64::from));
    Ok(())
}

fn vehicles(asked: &Asked<'_>, graph: &mut LaneGraph) -> Result<()> {
    let of = asked.objects("VEHICLE_TYPES");
    for row in of.rows() {
        graph.vehicle_types.push(VehicleType {
            vehicle_type: id(of, row, "vehicle_type")?,
            graph: of.text(row, "graph"),
            height: of.number(row, "height"),
            speed: of.number(row, "speed"),
        });
    }
    let of = asked.objects("LANE_VEHICLES");
    let sure = |row: usize, property: &str| of.known_truth(row, property);
    for row in of.rows() {
        graph.uses.push(Use {
            lane: id(of, row, "lane")?,
            vehicle_type: id(of, row, "vehicle_type")?,
            max_speed: of.number(row, "max_speed"),
            min_height: of.number(row, "min_height"),
            max_height: of.number(row, "max_height"),
            rotation_allowed: sure(row, "rotation_allowed"),
            unloaded: sure(row, "unloaded"),
            loaded: sure(row, "loaded"),
            load_sets: of.text(row, "load_sets"),
            properties: rest(of, row)?,
        });
    }
    Ok(())
}

fn id(of: ObjectsOf<'_>, row: usize, property: &str) -> Result<String> {
    of.text(row, property).ok_or_else(|| of.wrong(row, property, "a text", None))
}

/// A number of a node or lane, in the file's order.
fn number(of: ObjectsOf<'_>, row: usize) -> Result<Option<u32>> {
    let Some(number) = of.number(row, "number") else { return Ok(None) };
    if number >= 0.0 && number <= f64::from(u32::MAX) && number.fract() == 0.0 {
        return Ok(Some(number as u32));
    }
    Err(of.wrong(row, "number", "a whole number, 0 or more", Some(&number.to_string())))
}

fn ends(of: ObjectsOf<'_>, row: usize) -> Result<[Point; 2]> {
    let at = |x, y| Ok::<_, Error>(Point::new(of.needed(row, x)?, of.needed(row, y)?));
    Ok([at("x0", "y0")?, at("x1", "y1")?])
}

fn rest(of: ObjectsOf<'_>, row: usize) -> Result<Properties> {
    let Some(text) = of.text(row, "properties") else { return Ok(Properties::new()) };
    serde_json::from_str(&text).map_err(|_| of.wrong(row, "properties", "an object of JSON", Some(&text)))
}
