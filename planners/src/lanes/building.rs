//! A building of Open-RMF's traffic editor: `building.yaml`.

use std::collections::BTreeMap;
use std::rc::Rc;

use serde_json::Value;

use super::earth::Earth;
use super::{Door, Lane, LaneGraph, Level, Lift, Node, Properties, Wall, doors};
use crate::geometry::Point;
use crate::read::{At, Code, Read, nearest};

/// From the coordinates of a file to metres.
enum Place {
    Plane(Plane),
    /// All levels lie in one frame.
    Earth(Rc<Earth>),
}

impl Place {
    fn at(&self, of: &At<'_>) -> Read<Point> {
        self.place(of, of.point()?)
    }

    /// # Arguments
    /// `of` is what the point belongs to.
    fn place(&self, of: &At<'_>, point: Point) -> Read<Point> {
        match self {
            Self::Plane(plane) => Ok(plane.at(point)),
            Self::Earth(earth) => earth.metres(point).ok_or_else(|| {
                of.wrong("degrees east and degrees north, as `coordinate_system: wgs84` says")
            }),
        }
    }
}

/// `turned` and scaled (as a complex number), then moved.
#[derive(Clone, Copy)]
struct Plane {
    turned: [f64; 2],
    moved: [f64; 2],
    is_flipped: bool,
}

impl Plane {
    const fn scaled(scale: f64, is_flipped: bool) -> Self {
        Self { turned: [scale, 0.0], moved: [0.0, 0.0], is_flipped }
    }

    fn at(&self, p: Point) -> Point {
        let [a, b] = self.turned;
        let [u, v] = [a * p.x - b * p.y + self.moved[0], b * p.x + a * p.y + self.moved[1]];
        Point::new(u, if self.is_flipped { -v } else { v })
    }

    fn scale(&self) -> f64 {
        self.turned[0].hypot(self.turned[1])
    }
}

/// A parameter, which traffic editor writes with its type: `[4, true]`.
fn parameter<'v>(of: &At<'v>, key: &str) -> Read<Option<At<'v>>> {
    let Some(value) = of.get(key) else { return Ok(None) };
    match value.items()?.as_slice() {
        [_, value] => Ok(Some(value.clone())),
        _ => Err(value.wrong("a type and a value, as [4, true]")),
    }
}

fn truth(of: &At<'_>, key: &str) -> Read<bool> {
    Ok(parameter(of, key)?.map(|value| value.truth()).transpose()?.unwrap_or(false))
}

fn text(of: &At<'_>, key: &str) -> Read<Option<String>> {
    let text = parameter(of, key)?.map(|value| value.text()).transpose()?;
    Ok(text.filter(|text| !text.is_empty()))
}

/// All parameters as plain values, but for those.
fn rest(of: &At<'_>, without: &[&str]) -> Properties {
    let plain = |value: &Value| value.get(1).cloned().unwrap_or_default();
    let entries = of.rest(without).into_iter().map(|(key, value)| (key, plain(&value)));
    entries.filter(|(_, value)| value.as_str() != Some("")).collect()
}

pub(super) fn read(top: &At<'_>) -> Read<LaneGraph> {
    let mut graph = LaneGraph { name: top.name("name")?.unwrap_or_default(), ..LaneGraph::default() };
    let levels = top.need("levels")?.entries()?;
    let places = places(top, &levels, &mut graph.notes)?;
    let is_alone = levels.len() < 2;
    let mut lanes: Vec<(Lane, bool)> = Vec::new();
    for (name, level) in &levels {
        let elevation = level.maybe_number("elevation")?.unwrap_or(0.0);
        graph.levels.push(Level { level: (*name).to_owned(), elevation, properties: Properties::new() });
        misspelt(name, level, &mut graph.notes)?;
        let place = &places[*name];
        let vertices = level.list("vertices")?;
        let at = |number: &At<'_>| place.at(&vertices[number.index(vertices.len(), "vertices")?]);
        walls_and_doors(&mut graph, name, level, at)?;
        // nodes are numbered as lanes first lead to them, as in the navigation graphs that Open-RMF makes
        let mut order: Vec<usize> = Vec::new();
        for lane in level.list("lanes")? {
            let items = lane.items()?;
            let [from, to, rest @ ..] = items.as_slice() else { return Err(lane.wrong("[from, to, {…}]")) };
            let ends = [from.index(vertices.len(), "vertices")?, to.index(vertices.len(), "vertices")?];
            let numbers = ends.map(|end| {
                order.iter().position(|known| *known == end).unwrap_or_else(|| {
                    order.push(end);
                    order.len() - 1
                })
            });
            let [from, to] = numbers.map(|number| node_id(name, number, is_alone));
            let (read, is_both_ways) = rest.first().map_or(Ok((Lane::default(), false)), one_lane)?;
            lanes.push((Lane { from, to, ..read }, is_both_ways));
        }
        let named = vertices.iter().enumerate().filter(|(_, vertex)| is_named(vertex));
        let unused: Vec<usize> = named.map(|(number, _)| number).filter(|at| !order.contains(at)).collect();
        for (number, vertex) in order.into_iter().chain(unused).enumerate() {
            let id = node_id(name, number, is_alone);
            graph.nodes.push(node(&vertices[vertex], id, name, place)?);
        }
    }
    let graphs = directed(&mut graph, lanes);
    for (name, lift) in top.object("lifts")? {
        graph.lifts.push(one_lift(name, &lift, &places)?);
    }
    note_lifts(&mut graph);
    doors::cross(&mut graph);
    doors::rides(&mut graph, &graphs);
    graph.types_by_graph(&graphs);
    Ok(graph)
}

/// Lists of a level that nothing reads, and whose name is close to one that is read.
fn misspelt(name: &str, level: &At<'_>, notes: &mut Vec<String>) -> Read<()> {
    const READ: [&str; 4] = ["vertices", "lanes", "walls", "doors"];
    const KNOWN: [&str; 6] = ["floors", "models", "layers", "fiducials", "features", "measurements"];
    for (key, _) in
        level.entries()?.into_iter().filter(|(key, _)| !READ.contains(key) && !KNOWN.contains(key))
    {
        if let Some(meant) = nearest(key, &READ) {
            notes.push(format!("`{key}` of level {name} is not read; did you mean `{meant}`?"));
        }
    }
    Ok(())
}

/// Says which nodes lie in the cabin of a lift that is not there.
fn note_lifts(graph: &mut LaneGraph) {
    let LaneGraph { nodes, lifts, notes, .. } = graph;
    for node in nodes.iter() {
        let Some(lift) = &node.lift else { continue };
        if lifts.iter().all(|known| known.lift != *lift) {
            let id = &node.node;
            notes.push(format!(
                "node {id} is in the cabin of lift `{lift}`, and there is no lift of this name"
            ));
        }
    }
}

fn node_id(level: &str, number: usize, is_alone: bool) -> String {
    if is_alone { number.to_string() } else { format!("{level}:{number}") }
}

fn is_named(vertex: &At<'_>) -> bool {
    let name = vertex.value.get(3);
    name.is_some_and(|name| !name.is_null() && name != "")
}

fn node(vertex: &At<'_>, id: String, level: &str, place: &Place) -> Read<Node> {
    let items = vertex.items()?;
    let mut node = Node::new(id, level, place.at(vertex)?);
    node.name = items.get(3).map(|name| name.text()).transpose()?.filter(|name| !name.is_empty());
    if let Some(given) = items.get(4) {
        node.lift = text(given, "lift_cabin")?;
        node.is_parking_spot = truth(given, "is_parking_spot")?;
        node.is_charger = truth(given, "is_charger")?;
        node.is_holding_point = truth(given, "is_holding_point")?;
        node.properties = rest(given, &["lift_cabin", "is_parking_spot", "is_charger", "is_holding_point"]);
    }
    Ok(node)
}

/// A lane but for its ends, and whether it leads both ways.
fn one_lane(given: &At<'_>) -> Read<(Lane, bool)> {
    const READ: [&str; 4] = ["bidirectional", "graph_idx", "orientation", "speed_limit"];
    let graph = parameter(given, "graph_idx")?.map(|graph| graph_number(&graph)).transpose()?;
    // traffic editor writes 0 where there is none
    let limit = parameter(given, "speed_limit")?.map(|limit| limit.zero_or_more()).transpose()?;
    let lane = Lane {
        graph: Some(graph.unwrap_or_else(|| "0".to_owned())),
        orientation: text(given, "orientation")?,
        speed_limit: limit.filter(|limit| *limit > 0.0),
        lift: text(given, "demo_mock_lift_name")?,
        properties: rest(given, &READ),
        ..Lane::default()
    };
    Ok((lane, truth(given, "bidirectional")?))
}

fn graph_number(graph: &At<'_>) -> Read<String> {
    if graph.value.as_f64().is_some_and(|number| number < 0.0) {
        return Err(graph.wrong("the number of a graph, 0 or more"));
    }
    graph.id()
}

/// Gives lanes their numbers, graph by graph, one for each direction as in navigation graphs; which graphs there are.
fn directed(graph: &mut LaneGraph, lanes: Vec<(Lane, bool)>) -> Vec<String> {
    let mut counts: BTreeMap<String, u32> = BTreeMap::new();
    for (lane, _) in &lanes {
        counts.insert(lane.graph.clone().unwrap_or_default(), 0);
    }
    let is_one = counts.len() < 2;
    let mut add = |lane: Lane| {
        let of = lane.graph.clone().unwrap_or_default();
        let next = counts.entry(of.clone()).or_default();
        let id = if is_one { next.to_string() } else { format!("{of}:{next}") };
        graph.lanes.push(Lane { lane: id, number: is_one.then_some(*next), ..lane });
        *next += 1;
    };
    for (lane, is_both_ways) in lanes {
        let back = is_both_ways.then(|| Lane {
            from: lane.to.clone(),
            to: lane.from.clone(),
            orientation: lane.orientation.as_deref().map(turned_back),
            ..lane.clone()
        });
        add(lane);
        back.into_iter().for_each(&mut add);
    }
    counts.into_keys().collect()
}

/// How a vehicle looks on the way back where it does not turn about.
fn turned_back(orientation: &str) -> String {
    match orientation {
        "forward" => "backward",
        "backward" => "forward",
        other => other,
    }
    .to_owned()
}

fn walls_and_doors(
    graph: &mut LaneGraph,
    level: &str,
    given: &At<'_>,
    at: impl Fn(&At<'_>) -> Read<Point>,
) -> Read<()> {
    for wall in given.list("walls")? {
        let items = wall.items()?;
        let [from, to, ..] = items.as_slice() else { return Err(wall.wrong("[from, to, {…}]")) };
        graph.walls.push(Wall { level: level.to_owned(), ends: [at(from)?, at(to)?] });
    }
    for door in given.list("doors")? {
        let items = door.items()?;
        let [from, to, given] = items.as_slice() else { return Err(door.wrong("[from, to, {…}]")) };
        let name = text(given, "name")?.ok_or_else(|| given.problem(Code::MissingKey, "has no `name`"))?;
        let (level, ends) = (level.to_owned(), [at(from)?, at(to)?]);
        graph.doors.push(Door { door: name, level, ends, kind: text(given, "type")? });
    }
    Ok(())
}

fn one_lift(name: &str, lift: &At<'_>, places: &BTreeMap<&str, Place>) -> Read<Lift> {
    let floor = lift.name("reference_floor_name")?;
    let place = match &floor {
        Some(floor) => places.get(floor.as_str()).ok_or_else(|| {
            lift.problem(Code::Impossible, &format!("is drawn on level `{floor}`, which is not there"))
        })?,
        None => places.values().next().ok_or_else(|| lift.problem(Code::Impossible, "has no level"))?,
    };
    Ok(Lift {
        lift: name.to_owned(),
        at: place.place(lift, Point::new(lift.need("x")?.number()?, lift.need("y")?.number()?))?,
        yaw_degrees: degrees(lift.maybe_number("yaw")?.unwrap_or(0.0)),
        width: lift.maybe_number("width")?,
        depth: lift.maybe_number("depth")?,
    })
}

/// An angle as a table holds it: rounded, so that it is the same after it was written in radians and read again.
pub(super) fn degrees(radians: f64) -> f64 {
    (radians.to_degrees() * 1e9).round() / 1e9
}

/// How each level lies: by what was measured on it, the others on the first one by their fiducials.
fn places<'v>(
    top: &At<'v>,
    levels: &[(&'v str, At<'v>)],
    notes: &mut Vec<String>,
) -> Read<BTreeMap<&'v str, Place>> {
    let system = top.name("coordinate_system")?.unwrap_or_else(|| "reference_image".to_owned());
    match system.as_str() {
        "reference_image" => {}
        "cartesian_meters" => {
            return Ok(levels
                .iter()
                .map(|(name, _)| (*name, Place::Plane(Plane::scaled(1.0, false))))
                .collect());
        }
        "wgs84" => return on_the_earth(top, levels, notes),
        _ => {
            let of = top.need("coordinate_system")?;
            return Err(of.wrong("`reference_image`, `cartesian_meters` or `wgs84`"));
        }
    }
    let named = top.name("reference_level_name")?;
    let reference = named.as_deref().or_else(|| levels.first().map(|(name, _)| *name)).unwrap_or_default();
    let Some((_, first)) = levels.iter().find(|(name, _)| *name == reference) else {
        return Err(
            top.problem(Code::Impossible, &format!("has no level `{reference}`, which others lie on"))
        );
    };
    let scale = measured(first)?;
    if scale.is_none() {
        notes
            .push(format!("nothing was measured on level {reference}, so that a pixel is taken for a metre"));
    }
    let base = Plane::scaled(scale.unwrap_or(1.0), true);
    let known = fiducials(first)?;
    let mut places = BTreeMap::new();
    for (name, level) in levels {
        let place = if *name == reference {
            base
        } else {
            match aligned(&fiducials(level)?, &known) {
                Some(on) => Plane {
                    turned: on.turned.map(|part| part * base.scale()),
                    moved: on.moved.map(|part| part * base.scale()),
                    ..base
                },
                None => Plane::scaled(measured(level)?.unwrap_or_else(|| base.scale()), true),
            }
        };
        places.insert(*name, Place::Plane(place));
    }
    Ok(places)
}

/// Metres a pixel, the mean of what was measured; `None` where nothing was.
fn measured(level: &At<'_>) -> Read<Option<f64>> {
    let vertices = level.list("vertices")?;
    let mut scales = Vec::new();
    for measurement in level.list("measurements")? {
        let items = measurement.items()?;
        let [from, to, given] = items.as_slice() else {
            return Err(measurement.wrong("[from, to, {distance: …}]"));
        };
        let at = |of: &At<'_>| vertices[of.index(vertices.len(), "vertices")?].point();
        let (from, to) = (at(from)?, at(to)?);
        let distance = parameter(given, "distance")?
            .ok_or_else(|| given.problem(Code::MissingKey, "has no `distance`"))?
            .positive()?;
        let pixels = from.distance(to);
        if pixels <= 0.0 {
            return Err(
                measurement.problem(Code::Degenerate, "is measured between two vertices at one point")
            );
        }
        scales.push(distance / pixels);
    }
    let count = scales.len() as f64;
    Ok((!scales.is_empty()).then(|| scales.iter().sum::<f64>() / count))
}

fn fiducials(level: &At<'_>) -> Read<BTreeMap<String, Point>> {
    let mut points = BTreeMap::new();
    for fiducial in level.list("fiducials")? {
        let items = fiducial.items()?;
        let [_, _, name] = items.as_slice() else { return Err(fiducial.wrong("[x, y, name]")) };
        points.insert(name.text()?, fiducial.point()?);
    }
    Ok(points)
}

/// The turn, scale and move that bring points onto those of the same name with least squares; `None` of fewer than two.
fn aligned(points: &BTreeMap<String, Point>, onto: &BTreeMap<String, Point>) -> Option<Plane> {
    let pairs: Vec<(Point, Point)> =
        points.iter().filter_map(|(name, at)| Some((*at, *onto.get(name)?))).collect();
    if pairs.len() < 2 {
        return None;
    }
    let count = pairs.len() as f64;
    let mean = |of: &dyn Fn(&(Point, Point)) -> Point| {
        let sum = pairs.iter().map(of).fold((0.0, 0.0), |sum, p| (sum.0 + p.x, sum.1 + p.y));
        Point::new(sum.0 / count, sum.1 / count)
    };
    let (from, to) = (mean(&|pair| pair.0), mean(&|pair| pair.1));
    let (mut re, mut im, mut size) = (0.0, 0.0, 0.0);
    for (p, q) in &pairs {
        let [px, py, qx, qy] = [p.x - from.x, p.y - from.y, q.x - to.x, q.y - to.y];
        re += px * qx + py * qy;
        im += px * qy - py * qx;
        size += px * px + py * py;
    }
    if size <= 0.0 {
        return None;
    }
    let [a, b] = [re / size, im / size];
    let moved = [to.x - (a * from.x - b * from.y), to.y - (b * from.x + a * from.y)];
    Some(Plane { turned: [a, b], moved, is_flipped: true })
}

/// Degrees east and north as metres, in the coordinate system that the file names or else about the first vertex.
fn on_the_earth<'v>(
    top: &At<'v>,
    levels: &[(&'v str, At<'v>)],
    notes: &mut Vec<String>,
) -> Read<BTreeMap<&'v str, Place>> {
    let parameters = top.get("parameters");
    let given = |key: &str| parameters.as_ref().map_or(Ok(None), |of| parameter(of, key));
    let metres = |key: &str| given(key)?.map_or(Ok(0.0), |value| value.number());
    let earth = if let Some(system) = given("generate_crs")? {
        let offset = Point::new(metres("suggested_offset_x")?, metres("suggested_offset_y")?);
        Earth::named(&system, offset)?
    } else {
        let mut origin = Point::new(0.0, 0.0);
        for (_, level) in levels {
            if let Some(vertex) = level.list("vertices")?.first() {
                origin = vertex.point()?;
                break;
            }
        }
        notes.push("no `generate_crs` is said, so that metres are counted from the first vertex".to_owned());
        Earth::about(origin).ok_or_else(|| {
            top.problem(
                Code::Impossible,
                &format!("has its first vertex at {}, {} degrees", origin.x, origin.y),
            )
        })?
    };
    let earth = Rc::new(earth);
    Ok(levels.iter().map(|(name, _)| (*name, Place::Earth(Rc::clone(&earth)))).collect())
}
