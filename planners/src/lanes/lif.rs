//! VDMA's Layout Interchange Format, 1.0 and 2.0.

use std::collections::BTreeSet;

use super::{Lane, LaneGraph, Level, Load, Node, Properties, Station, Use, VehicleType};
use crate::geometry::Point;
use crate::read::{At, Code, Read};

pub(super) fn read(top: &At<'_>) -> Read<LaneGraph> {
    let meta = top.need("metaInformation")?;
    let version = meta.need("lifVersion")?.text()?;
    if !["0", "1", "2"].contains(&version.split('.').next().unwrap_or_default()) {
        return Err(meta.need("lifVersion")?.wrong("a version of LIF up to 2"));
    }
    let name = meta.name("projectIdentification")?.unwrap_or_default();
    let mut graph = LaneGraph { name, properties: top.rest(&["layouts"]), ..LaneGraph::default() };
    let layouts = top.need("layouts")?;
    for layout in layouts.items()? {
        one_layout(&mut graph, &layout)?;
    }
    if graph.levels.is_empty() {
        return Err(layouts.wrong("one layout or more"));
    }
    let types: BTreeSet<String> =
        graph.uses.iter().map(|of| of.vehicle_type.clone()).chain(at_nodes(&graph)).collect();
    graph.vehicle_types = types
        .into_iter()
        .map(|vehicle_type| VehicleType { vehicle_type, ..VehicleType::default() })
        .collect();
    let sets = graph.uses.iter().flat_map(|of| {
        let sets = of.load_sets.as_deref().unwrap_or_default().split(',');
        let named = sets.map(str::trim).filter(|set| !set.is_empty());
        named.map(|set| Load { vehicle_type: of.vehicle_type.clone(), load: set.to_owned() })
    });
    let sets: BTreeSet<Load> = sets.collect();
    graph.loads = sets.into_iter().collect();
    Ok(graph)
}

/// The vehicle types that nodes name.
fn at_nodes(graph: &LaneGraph) -> Vec<String> {
    let lists =
        graph.nodes.iter().filter_map(|node| node.properties.get("vehicleTypeNodeProperties")?.as_array());
    let ids = lists.flatten().filter_map(|of| of.get("vehicleTypeId")?.as_str());
    ids.map(str::to_owned).collect()
}

fn one_layout(graph: &mut LaneGraph, layout: &At<'_>) -> Read<()> {
    let level = layout.need("layoutId")?.id()?;
    let properties = layout.rest(&["layoutId", "nodes", "edges", "stations"]);
    graph.levels.push(Level { level: level.clone(), elevation: 0.0, properties });
    for node in layout.list("nodes")? {
        let position = node.need("nodePosition")?;
        let at = Point::new(position.need("x")?.number()?, position.need("y")?.number()?);
        let mut read = Node::new(node.need("nodeId")?.id()?, &level, at);
        read.name = node.name("nodeName")?;
        for of in node.need("vehicleTypeNodeProperties")?.items()? {
            of.need("vehicleTypeId")?.id()?;
        }
        read.properties = node.rest(&["nodeId", "nodeName", "nodePosition"]);
        graph.nodes.push(read);
    }
    for edge in layout.list("edges")? {
        let lane = edge.need("edgeId")?.id()?;
        let mut length: Option<f64> = None;
        let types = edge.need("vehicleTypeEdgeProperties")?;
        let of_types = types.items()?;
        if of_types.is_empty() {
            return Err(types.wrong("what one vehicle type or more may do there"));
        }
        for of in of_types {
            match of.get("trajectory").map(|curve| read_curve(&curve)).transpose()? {
                Some(Curve::Of(metres)) => length = Some(length.map_or(metres, |most| metres.max(most))),
                Some(Curve::Broken(why)) => {
                    graph
                        .notes
                        .push(format!("the curve of edge {lane} has {why}, so that it counts as straight"));
                }
                Some(Curve::Straight) | None => {}
            }
            graph.uses.push(one_use(&lane, &of)?);
        }
        graph.lanes.push(Lane {
            lane,
            name: edge.name("edgeName")?,
            from: edge.need("startNodeId")?.id()?,
            to: edge.need("endNodeId")?.id()?,
            length,
            properties: edge.rest(&[
                "edgeId",
                "edgeName",
                "startNodeId",
                "endNodeId",
                "vehicleTypeEdgeProperties",
            ]),
            ..Lane::default()
        });
    }
    for station in layout.list("stations")? {
        let list = station.need("interactionNodeIds")?;
        let of = list.items()?;
        if of.is_empty() {
            return Err(list.wrong("one node or more from which the station is reached"));
        }
        let nodes = of.iter().map(At::id).collect::<Read<Vec<String>>>()?;
        graph.stations.push(Station {
            station: station.need("stationId")?.id()?,
            name: station.name("stationName")?,
            level: level.clone(),
            nodes: nodes.join(", "),
            properties: station.rest(&["stationId", "stationName", "interactionNodeIds"]),
        });
    }
    Ok(())
}

fn one_use(lane: &str, of: &At<'_>) -> Read<Use> {
    let restriction = of.get("loadRestriction");
    let allowed = |key: &str| restriction.as_ref().map_or(Ok(None), |of| of.maybe_truth(key));
    let (unloaded, loaded) = (allowed("unloaded")?, allowed("loaded")?);
    let mut rest = of.rest(&[
        "vehicleTypeId",
        "maxSpeed",
        "minHeight",
        "maxHeight",
        "rotationAllowed",
        "loadRestriction",
    ]);
    let mut load_sets = None;
    if let Some(restriction) = restriction {
        let names = restriction.list("loadSetNames")?;
        let names = names.iter().map(At::text).collect::<Read<Vec<String>>>()?;
        load_sets = (!names.is_empty()).then(|| names.join(", "));
        let more: Properties = restriction.rest(&["unloaded", "loaded", "loadSetNames"]);
        if !more.is_empty() {
            rest.insert("loadRestriction".to_owned(), more.into());
        }
    }
    Ok(Use {
        lane: lane.to_owned(),
        vehicle_type: of.need("vehicleTypeId")?.id()?,
        max_speed: of.get("maxSpeed").map(|speed| speed.positive()).transpose()?,
        min_height: of.not_negative("minHeight")?,
        max_height: of.not_negative("maxHeight")?,
        rotation_allowed: of.maybe_truth("rotationAllowed")?,
        unloaded,
        loaded,
        load_sets,
        properties: rest,
    })
}

/// What the NURBS of an edge comes to.
enum Curve {
    Straight,
    /// Metres along it.
    Of(f64),
    /// What knots and control points have that those of no NURBS do.
    Broken(String),
}

fn read_curve(curve: &At<'_>) -> Read<Curve> {
    let degree = curve.maybe_number("degree")?.unwrap_or(1.0);
    if !(1.0..=9.0).contains(&degree) {
        return Err(curve.problem(Code::Impossible, &format!("has the degree {degree}, expected 1 to 9")));
    }
    let degree = degree as usize;
    let knots = curve.list("knotVector")?.iter().map(At::number).collect::<Read<Vec<f64>>>()?;
    let mut points = Vec::new();
    for point in curve.list("controlPoints")? {
        let weight = point.get("weight").map_or(Ok(1.0), |weight| weight.positive())?;
        points.push([point.need("x")?.number()? * weight, point.need("y")?.number()? * weight, weight]);
    }
    // which some files leave empty, for a straight line
    if points.is_empty() && knots.is_empty() {
        return Ok(Curve::Straight);
    }
    let expected = points.len() + degree + 1;
    if points.len() <= degree {
        return Ok(Curve::Broken(format!("{} control points for the degree {degree}", points.len())));
    }
    if knots.len() != expected {
        return Ok(Curve::Broken(format!(
            "{} knots where {} control points of the degree {degree} have {expected}",
            knots.len(),
            points.len()
        )));
    }
    if knots.windows(2).any(|pair| pair[1] < pair[0]) {
        return Ok(Curve::Broken("knots that fall".to_owned()));
    }
    let (first, last) = (knots[degree], knots[points.len()]);
    let at = |step: u32| {
        let [x, y, weight] =
            de_boor(degree, &knots, &points, first + (last - first) * f64::from(step) / 64.0);
        Point::new(x / weight, y / weight)
    };
    let length = (0..64).map(|step| at(step).distance(at(step + 1))).sum::<f64>();
    Ok(Curve::Of(length))
}

fn de_boor(degree: usize, knots: &[f64], points: &[[f64; 3]], at: f64) -> [f64; 3] {
    let span = (degree..points.len()).rev().find(|&k| knots[k] <= at).unwrap_or(degree);
    let mut of: Vec<[f64; 3]> = points[span - degree..=span].to_vec();
    for round in 1..=degree {
        for k in (round..=degree).rev() {
            let low = knots[span - degree + k];
            let width = knots[span + 1 + k - round] - low;
            let part = if width > 0.0 { (at - low) / width } else { 0.0 };
            of[k] = [0, 1, 2].map(|axis| (1.0 - part) * of[k - 1][axis] + part * of[k][axis]);
        }
    }
    of[degree]
}
