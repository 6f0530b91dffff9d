//! The tables that the file of a lane graph fills.

use std::path::Path;

use adit_db::Cell;
use adit_planners::lanes::{LaneGraph, Properties};

use crate::site::tables::TableFile;

type Columns = &'static [(&'static str, &'static str)];

pub const LEVELS: Columns = &[("level", "TEXT"), ("elevation", "REAL"), ("properties", "TEXT")];
pub const NODES: Columns = &[
    ("node", "TEXT"),
    ("name", "TEXT"),
    ("level", "TEXT"),
    ("x", "REAL"),
    ("y", "REAL"),
    ("lift", "TEXT"),
    ("is_parking_spot", "BOOLEAN"),
    ("is_charger", "BOOLEAN"),
    ("is_holding_point", "BOOLEAN"),
    ("closed", "BOOLEAN"),
    ("number", "INTEGER"),
    ("properties", "TEXT"),
];
pub const LANES: Columns = &[
    ("lane", "TEXT"),
    ("name", "TEXT"),
    ("from_node", "TEXT"),
    ("to_node", "TEXT"),
    ("graph", "TEXT"),
    ("length", "REAL"),
    ("speed_limit", "REAL"),
    ("speed_share", "REAL"),
    ("penalty", "REAL"),
    ("cost", "REAL"),
    ("is_cost_fixed", "BOOLEAN"),
    ("orientation", "TEXT"),
    ("door", "TEXT"),
    ("lift", "TEXT"),
    ("action", "TEXT"),
    ("closed", "BOOLEAN"),
    ("number", "INTEGER"),
    ("properties", "TEXT"),
];
pub const DOORS: Columns = &[
    ("door", "TEXT"),
    ("level", "TEXT"),
    ("x0", "REAL"),
    ("y0", "REAL"),
    ("x1", "REAL"),
    ("y1", "REAL"),
    ("kind", "TEXT"),
    ("closed", "BOOLEAN"),
];
pub const LIFTS: Columns = &[
    ("lift", "TEXT"),
    ("x", "REAL"),
    ("y", "REAL"),
    ("yaw", "REAL"),
    ("width", "REAL"),
    ("depth", "REAL"),
    ("closed", "BOOLEAN"),
];
pub const WALLS: Columns =
    &[("wall", "INTEGER"), ("level", "TEXT"), ("x0", "REAL"), ("y0", "REAL"), ("x1", "REAL"), ("y1", "REAL")];
pub const VEHICLE_TYPES: Columns =
    &[("vehicle_type", "TEXT"), ("graph", "TEXT"), ("height", "REAL"), ("speed", "REAL")];
pub const LANE_VEHICLES: Columns = &[
    ("lane", "TEXT"),
    ("vehicle_type", "TEXT"),
    ("max_speed", "REAL"),
    ("min_height", "REAL"),
    ("max_height", "REAL"),
    ("rotation_allowed", "BOOLEAN"),
    ("unloaded", "BOOLEAN"),
    ("loaded", "BOOLEAN"),
    ("load_sets", "TEXT"),
    ("properties", "TEXT"),
];
pub const STATIONS: Columns =
    &[("station", "TEXT"), ("name", "TEXT"), ("level", "TEXT"), ("nodes", "TEXT"), ("properties", "TEXT")];

fn text(text: &str) -> Cell {
    Cell::from(text)
}

fn perhaps(of: Option<&String>) -> Cell {
    of.map_or(Cell::Null, |of| Cell::from(of.as_str()))
}

fn real(number: Option<f64>) -> Cell {
    number.map_or(Cell::Null, Cell::Real)
}

fn truth(is_so: bool) -> Cell {
    Cell::Integer(is_so.into())
}

fn unsure(is_so: Option<bool>) -> Cell {
    is_so.map_or(Cell::Null, truth)
}

fn number(number: Option<u32>) -> Cell {
    number.map_or(Cell::Null, |number| Cell::Integer(number.into()))
}

fn rest(properties: &Properties) -> Cell {
    if properties.is_empty() {
        return Cell::Null;
    }
    serde_json::to_string(properties).map_or(Cell::Null, |json| Cell::from(json.as_str()))
}

pub fn tables(file: &Path, graph: &LaneGraph) -> Vec<TableFile> {
    let levels =
        graph.levels.iter().map(|of| vec![text(&of.level), Cell::Real(of.elevation), rest(&of.properties)]);
    let nodes = graph.nodes.iter().map(|of| {
        vec![
            text(&of.node),
            perhaps(of.name.as_ref()),
            text(&of.level),
            Cell::Real(of.at.x),
            Cell::Real(of.at.y),
            perhaps(of.lift.as_ref()),
            truth(of.is_parking_spot),
            truth(of.is_charger),
            truth(of.is_holding_point),
            truth(of.closed),
            number(of.number),
            rest(&of.properties),
        ]
    });
    let lanes = graph.lanes.iter().map(|of| {
        vec![
            text(&of.lane),
            perhaps(of.name.as_ref()),
            text(&of.from),
            text(&of.to),
            perhaps(of.graph.as_ref()),
            real(of.length),
            real(of.speed_limit),
            real(of.speed_share),
            real(of.penalty),
            real(of.cost),
            truth(of.is_cost_fixed),
            perhaps(of.orientation.as_ref()),
            perhaps(of.door.as_ref()),
            perhaps(of.lift.as_ref()),
            perhaps(of.action.as_ref()),
            truth(of.closed),
            number(of.number),
            rest(&of.properties),
        ]
    });
    let doors = graph.doors.iter().map(|of| {
        let [from, to] = of.ends;
        let ends = [from.x, from.y, to.x, to.y].map(Cell::Real);
        let named = [text(&of.door), text(&of.level)];
        named.into_iter().chain(ends).chain([perhaps(of.kind.as_ref()), truth(false)]).collect()
    });
    let lifts = graph.lifts.iter().map(|of| {
        let placed = [of.at.x, of.at.y, of.yaw_degrees].map(Cell::Real);
        let sizes = [real(of.width), real(of.depth), truth(false)];
        [text(&of.lift)].into_iter().chain(placed).chain(sizes).collect()
    });
    let walls = (1..).zip(&graph.walls).map(|(number, of)| {
        let [from, to] = of.ends;
        let ends = [from.x, from.y, to.x, to.y].map(Cell::Real);
        [Cell::Integer(number), text(&of.level)].into_iter().chain(ends).collect()
    });
    let types = graph
        .vehicle_types
        .iter()
        .map(|of| vec![text(&of.vehicle_type), perhaps(of.graph.as_ref()), real(of.height), real(of.speed)]);
    let uses = graph.uses.iter().map(|of| {
        vec![
            text(&of.lane),
            text(&of.vehicle_type),
            real(of.max_speed),
            real(of.min_height),
            real(of.max_height),
            unsure(of.rotation_allowed),
            unsure(of.unloaded),
            unsure(of.loaded),
            perhaps(of.load_sets.as_ref()),
            rest(&of.properties),
        ]
    });
    let stations = graph.stations.iter().map(|of| {
        vec![
            text(&of.station),
            perhaps(of.name.as_ref()),
            text(&of.level),
            text(&of.nodes),
            rest(&of.properties),
        ]
    });
    let table = |name, columns: Columns, key, rows: Vec<Vec<Cell>>| {
        TableFile::of_map(file, name, (columns, key), rows)
    };
    vec![
        table("levels", LEVELS, 1, levels.collect()),
        table("nodes", NODES, 1, nodes.collect()),
        table("lanes", LANES, 1, lanes.collect()),
        table("lane_doors", DOORS, 1, doors.collect()),
        table("lifts", LIFTS, 1, lifts.collect()),
        table("walls", WALLS, 1, walls.collect()),
        table("vehicle_types", VEHICLE_TYPES, 1, types.collect()),
        table("lane_vehicles", LANE_VEHICLES, 2, uses.collect()),
        table("stations", STATIONS, 1, stations.collect()),
    ]
}
