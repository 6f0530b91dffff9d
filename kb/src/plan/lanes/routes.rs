//! Routes over a lane graph as it is: for each vehicle type, Dijkstra's over the lanes that rules let it drive on.

use std::collections::{BTreeMap, BTreeSet};
use std::sync::{Arc, Mutex, PoisonError};

use adit_db::course::Course as Row;
use adit_db::place::Place;
use adit_db::route::{Step, Waypoint};
use adit_planners::geometry::Point;
use adit_planners::lanes::{Lane, Node, Station, Use, VehicleType};
use petgraph::algo::astar;
use petgraph::graph::{DiGraph, NodeIndex};
use petgraph::visit::{Dfs, IntoNeighbors, Reversed, Visitable};

use super::judge::{Judge, Weighed};
use super::tables::Now;
use super::travel::{Carrying, Travel, length_m};
use crate::draw::render_lanes;
use crate::error::Result;
use crate::plan::Said;
use crate::plan::course::{Found, NoEnd, Pathfinder, no_through};
use crate::words::number::{counted, number};
use crate::words::point::point;
use crate::words::suggest::did_you_mean;

/// Metres; points beyond it are slips, as they are in files.
const FARTHEST: f64 = 1e9;

/// The lanes that a vehicle type may drive on: nodes by place, lanes by place, with what each weighs.
struct Net {
    graph: DiGraph<(), (usize, f64)>,
    weighed: Vec<Weighed>,
}

pub struct Routes {
    now: Now,
    carrying: Carrying,
    places: Vec<Place>,
    by_id: BTreeMap<String, usize>,
    /// What the file allows whom on a lane, by the lane.
    uses: BTreeMap<String, Vec<usize>>,
    nets: Vec<Net>,
    judge: Mutex<Judge>,
    /// How long the longest lane is, metres.
    reach: f64,
    said: Mutex<BTreeMap<(usize, usize), Arc<Said>>>,
}

/// An end: a node, or one of those from which a station is reached; and what is worth a remark of it.
struct End {
    nodes: Vec<usize>,
    remark: Option<String>,
}

/// What a text stands for.
enum Called {
    Nodes(Vec<usize>),
    /// All nodes from which it is reached, of which any will do.
    Station(Vec<usize>),
}

/// The best way from one of some nodes to one of others.
struct Way {
    cost: f64,
    from: usize,
    lanes: Vec<usize>,
}

impl Routes {
    pub fn new(now: Now, carrying: Carrying, places: Vec<Place>, judge: Judge) -> Self {
        let by_id = now.graph.nodes.iter().enumerate().map(|(at, node)| (node.node.clone(), at)).collect();
        let mut uses: BTreeMap<String, Vec<usize>> = BTreeMap::new();
        for (at, of) in now.graph.uses.iter().enumerate() {
            uses.entry(of.lane.clone()).or_default().push(at);
        }
        let (judge, said) = (Mutex::new(judge), Mutex::default());
        let nets = Vec::new();
        let mut routes = Self { now, carrying, places, by_id, uses, nets, judge, reach: 0.0, said };
        let lanes = routes.now.graph.lanes.iter().enumerate();
        let length = |(at, lane): (usize, &Lane)| {
            let ends = routes.nodes_of(at);
            length_m(&routes.now, lane, ends).max(ends[0].at.distance(ends[1].at))
        };
        let lengths = lanes.map(length);
        routes.reach = lengths.fold(0.0, f64::max);
        routes.nets = (0..routes.now.graph.vehicle_types.len()).map(|vehicle| routes.net(vehicle)).collect();
        routes
    }

    fn net(&self, vehicle: usize) -> Net {
        let mut graph = DiGraph::new();
        for _ in &self.now.graph.nodes {
            graph.add_node(());
        }
        let mut judge = self.judge.lock().unwrap_or_else(PoisonError::into_inner);
        let mut weighed = Vec::new();
        for (at, lane) in self.now.graph.lanes.iter().enumerate() {
            let weight = judge.weigh(&self.travel(vehicle, at), &lane.lane);
            if let Ok(weight) = weight {
                let [from, to] = self.ends_of(at).map(NodeIndex::new);
                graph.add_edge(from, to, (at, weight));
            }
            weighed.push(weight);
        }
        Net { graph, weighed }
    }

    /// The nodes between which a lane leads; both are there, or the tables were refused.
    fn ends_of(&self, lane: usize) -> [usize; 2] {
        let lane = &self.now.graph.lanes[lane];
        [&lane.from, &lane.to].map(|id| self.by_id.get(id).copied().unwrap_or_default())
    }

    fn nodes_of(&self, lane: usize) -> [&Node; 2] {
        self.ends_of(lane).map(|node| &self.now.graph.nodes[node])
    }

    fn travel(&self, vehicle: usize, lane: usize) -> Travel<'_> {
        self.travel_in(&self.now, vehicle, lane)
    }

    /// # Arguments
    /// `now` has the nodes, lanes and vehicle types of these routes in their order, whatever is closed in it.
    fn travel_in<'n>(&'n self, now: &'n Now, vehicle: usize, lane: usize) -> Travel<'n> {
        let of = &now.graph.lanes[lane];
        let uses = self.uses.get(&of.lane).into_iter().flatten();
        let uses: Vec<&Use> = uses.map(|at| &now.graph.uses[*at]).collect();
        let ends = self.ends_of(lane).map(|node| &now.graph.nodes[node]);
        Travel::of(now, (of, ends), &now.graph.vehicle_types[vehicle], &uses, &self.carrying)
    }

    pub const fn now(&self) -> &Now {
        &self.now
    }

    /// What lanes weigh for a vehicle type where nothing is closed: with what it carries now, where rules let it drive there so, else
    /// without a load, else with one that is allowed there.
    pub fn weighed_open(&self, vehicle: &str) -> std::result::Result<Vec<Weighed>, NoEnd> {
        let (vehicle, open) = (self.vehicle(vehicle)?, self.now.opened());
        let mut judge = self.judge.lock().unwrap_or_else(PoisonError::into_inner);
        let mut weigh = |(at, lane): (usize, &Lane)| {
            let travel = || self.travel_in(&open, vehicle, at);
            let load = travel().allowed_load();
            judge.weigh(&travel(), &lane.lane).or_else(|refusal| {
                let others = [None, Some(&load)].into_iter();
                let mut others = others.map(|carried| judge.weigh(&travel().carrying(carried), &lane.lane));
                others.find(std::result::Result::is_ok).unwrap_or(Err(refusal))
            })
        };
        Ok(open.graph.lanes.iter().enumerate().map(&mut weigh).collect())
    }

    fn vehicle(&self, robot: &str) -> std::result::Result<usize, NoEnd> {
        let at = self.now.graph.vehicle_types.iter().position(|of| of.vehicle_type == robot);
        at.ok_or_else(|| NoEnd { is_start: true, reason: format!("there is no vehicle type `{robot}`") })
    }

    /// The node of a place, by its id, by its name, or the nearest one to a point; those of a station.
    fn end(&self, text: &str, is_start: bool) -> std::result::Result<End, NoEnd> {
        let text = text.trim();
        let called = match self.called(text) {
            Called::Nodes(nodes) if nodes.len() != 1 => nodes,
            Called::Nodes(nodes) | Called::Station(nodes) => return Ok(End { nodes, remark: None }),
        };
        let place = self.places.iter().find(|place| place.place == text);
        let at = place.map(|place| Point::new(place.x, place.y)).or_else(|| point(text));
        let no_end = |reason| NoEnd { is_start, reason };
        if place.is_none() && !called.is_empty() {
            let ids: Vec<String> =
                called.iter().map(|node| format!("node {}", self.now.graph.nodes[*node].node)).collect();
            return Err(no_end(format!("`{text}` may be {}", ids.join(" or "))));
        }
        let Some(at) = at else {
            let known = self
                .places
                .iter()
                .map(|place| place.place.as_str())
                .chain(self.by_id.keys().map(String::as_str));
            let meant = did_you_mean(text, known).map_or(String::new(), |help| format!("; {help}"));
            return Err(no_end(format!("`{text}` is no place, no node and no point `x,y`{meant}")));
        };
        if at.x.abs().max(at.y.abs()) > FARTHEST {
            return Err(no_end(format!("`{text}` is too far away, expected at most {FARTHEST:e} m")));
        }
        let far = |node: &Node| node.at.distance(at);
        let nodes = self.now.graph.nodes.iter().enumerate();
        let near = nodes.min_by(|(_, one), (_, other)| far(one).total_cmp(&far(other)));
        let (node, metres) = near
            .map(|(place, node)| (place, far(node)))
            .ok_or_else(|| no_end("there are no nodes".to_owned()))?;
        let id = &self.now.graph.nodes[node].node;
        // whoever is on a lane is nearer to a node than the longest lane is long
        if place.is_none() && self.reach > 0.0 && metres > self.reach {
            let reach = number(self.reach);
            return Err(no_end(format!(
                "`{text}` is {metres:.2} m from the nearest node, {id}, and no lane is longer than {reach} m"
            )));
        }
        let way = if is_start { "starts" } else { "ends" };
        let remark =
            (metres > 0.01).then(|| format!("the route {way} at node {id}, {metres:.2} m from {text}"));
        Ok(End { nodes: vec![node], remark })
    }

    /// What a text stands for: by id one node, by name perhaps several, or a station.
    fn called(&self, text: &str) -> Called {
        let id = text.strip_prefix("node ").or_else(|| text.strip_prefix("waypoint ")).unwrap_or(text);
        if let Some(node) = self.by_id.get(id) {
            return Called::Nodes(vec![*node]);
        }
        let nodes = self.now.graph.nodes.iter().enumerate();
        let named = nodes.filter(|(_, node)| node.name.as_deref() == Some(text));
        let named: Vec<usize> = named.map(|(node, _)| node).collect();
        let is_it = |of: &&Station| of.station == text || of.name.as_deref() == Some(text);
        let station = self.now.graph.stations.iter().find(is_it).filter(|_| named.is_empty());
        let of = station.map_or("", |station| &station.nodes).split(',');
        let nodes: Vec<usize> = of.filter_map(|node| self.by_id.get(node.trim()).copied()).collect();
        if nodes.is_empty() { Called::Nodes(named) } else { Called::Station(nodes) }
    }

    /// The best way, of one cost the one between the nodes that are named first.
    fn way(&self, vehicle: usize, from: &[usize], to: &[usize]) -> Option<Way> {
        let graph = &self.nets[vehicle].graph;
        let from_one = |&from: &usize| {
            let start = NodeIndex::new(from);
            let is_goal = |node: NodeIndex| to.contains(&node.index());
            let (cost, nodes) = astar(graph, start, is_goal, |edge| edge.weight().1, |_| 0.0)?;
            let lane = |pair: &[NodeIndex]| {
                let between = graph.edges_connecting(pair[0], pair[1]).map(|edge| *edge.weight());
                let best = between.min_by(|one, other| one.1.total_cmp(&other.1).then(one.0.cmp(&other.0)));
                best.map(|(lane, _)| lane)
            };
            Some(Way { cost, from, lanes: nodes.windows(2).filter_map(lane).collect() })
        };
        from.iter().filter_map(from_one).min_by(|one, other| one.cost.total_cmp(&other.cost))
    }

    /// Why nothing leads from some nodes to others: each thing that alone keeps a vehicle from it, or else all that does on the way
    /// on which the fewest lanes are refused.
    fn because(&self, vehicle: usize, from: &[usize], to: &[usize]) -> String {
        let net = &self.nets[vehicle];
        let (there, back) = (reached(&net.graph, from), reached(Reversed(&net.graph), to));
        let joins = |lane: &usize| {
            let [a, b] = self.ends_of(*lane);
            there.contains(&a) && back.contains(&b)
        };
        let alone = refusals(net, (0..net.weighed.len()).filter(joins));
        if !alone.is_empty() {
            return some(&alone, "; ");
        }
        let mut all: DiGraph<(), usize> =
            DiGraph::with_capacity(self.now.graph.nodes.len(), net.weighed.len());
        for _ in &self.now.graph.nodes {
            all.add_node(());
        }
        for lane in 0..net.weighed.len() {
            let [from, to] = self.ends_of(lane).map(NodeIndex::new);
            all.add_edge(from, to, lane);
        }
        let refused = |lane: usize| usize::from(net.weighed[lane].is_err());
        let from_one = |&from: &usize| {
            let is_goal = |node: NodeIndex| to.contains(&node.index());
            astar(&all, NodeIndex::new(from), is_goal, |edge| refused(*edge.weight()), |_| 0)
        };
        let Some((_, nodes)) = from.iter().filter_map(from_one).min_by_key(|(count, _)| *count) else {
            return match there.len() {
                1 => "no lane leads on from there".to_owned(),
                count => format!("no lane leads on from the {count} nodes that can be reached"),
            };
        };
        let lane = |pair: &[NodeIndex]| {
            let between = all.edges_connecting(pair[0], pair[1]).map(|edge| *edge.weight());
            between.min_by_key(|lane| refused(*lane))
        };
        some(&refusals(net, nodes.windows(2).filter_map(lane)), ", and ")
    }

    fn said(&self, vehicle: usize, lane: usize) -> Arc<Said> {
        let mut kept = self.said.lock().unwrap_or_else(PoisonError::into_inner);
        let said = kept.entry((vehicle, lane)).or_insert_with(|| {
            let mut judge = self.judge.lock().unwrap_or_else(PoisonError::into_inner);
            Arc::new(judge.said(&self.travel(vehicle, lane), &self.now.graph.lanes[lane].lane))
        });
        Arc::clone(said)
    }

    fn found(&self, vehicle: usize, [robot, start, goal]: [&str; 3], ends: [&End; 2], way: &Way) -> Found {
        let mut row = Row::blank(robot, start, goal);
        row.remarks = ends.into_iter().filter_map(|end| end.remark.clone()).collect();
        let (mut cost, mut distance, mut said) = (0.0, 0.0, Vec::new());
        let first = &self.now.graph.nodes[way.from];
        let is_level = self.now.graph.levels.len() < 2;
        let height = |node: &Node| {
            let level = self.now.graph.levels.iter().find(|level| level.level == node.level);
            level.filter(|_| !is_level).map(|level| level.elevation)
        };
        row.waypoints.push(Waypoint {
            waypoint: 1,
            x: first.at.x,
            y: first.at.y,
            z: height(first),
            distance: Some(0.0),
            ..Waypoint::default()
        });
        for (number, &lane) in (1..).zip(&way.lanes) {
            let [from, to] = self.nodes_of(lane);
            let of = self.said(vehicle, lane);
            let hardness = self.nets[vehicle].weighed[lane].clone().unwrap_or_default();
            cost += hardness;
            distance += length_m(&self.now, &self.now.graph.lanes[lane], [from, to]);
            let moves = from.at.distance(to.at) > 0.0;
            let heading = moves.then(|| (to.at.y - from.at.y).atan2(to.at.x - from.at.x).to_degrees());
            let action = of.action.as_ref().map(ToString::to_string);
            row.steps.push(Step {
                step: number,
                kind: "lane".to_owned(),
                place: of.place.clone(),
                action: action.clone(),
                hardness: Some(hardness),
                cost,
                x: Some(to.at.x),
                y: Some(to.at.y),
                z: height(to),
                heading,
                rule: of.rule_of("weight"),
                ..Step::default()
            });
            row.waypoints.push(Waypoint {
                waypoint: number + 1,
                x: to.at.x,
                y: to.at.y,
                z: height(to),
                heading,
                action,
                distance: Some(distance),
                cost,
                ..Waypoint::default()
            });
            said.push(of);
        }
        (row.cost, row.distance) = (Some(cost), Some(distance));
        Found { row, said }
    }

    /// The lanes that a name stands for.
    fn through(&self, name: &str) -> Vec<usize> {
        let graph = &self.now.graph;
        let name = name.trim();
        let of = |kind: &str| name.strip_prefix(kind).map_or(name, str::trim);
        let lane = graph
            .lanes
            .iter()
            .position(|lane| lane.lane == of("lane ") || lane.name.as_deref() == Some(name));
        if let Some(lane) = lane.filter(|_| !self.by_id.contains_key(name)) {
            return vec![lane];
        }
        let all = |is_it: &dyn Fn(usize) -> bool| {
            (0..graph.lanes.len()).filter(|lane| is_it(*lane)).collect::<Vec<_>>()
        };
        let door = all(&|lane| graph.lanes[lane].doors().any(|door| door == of("door ")));
        if !door.is_empty() {
            return door;
        }
        let lift = all(&|lane| graph.lanes[lane].lift.as_deref() == Some(of("lift ")));
        if !lift.is_empty() {
            return lift;
        }
        let (Called::Nodes(nodes) | Called::Station(nodes)) = self.called(name);
        all(&|lane| nodes.contains(&self.ends_of(lane)[1]))
    }
}

/// The nodes that are reached from some nodes, with these.
fn reached<G>(graph: G, from: &[usize]) -> BTreeSet<usize>
where
    G: IntoNeighbors<NodeId = NodeIndex> + Visitable<NodeId = NodeIndex> + Copy,
{
    let mut search = Dfs::empty(graph);
    search.reset(graph);
    let mut reached = BTreeSet::new();
    for &from in from {
        search.move_to(NodeIndex::new(from));
        while let Some(node) = search.next(graph) {
            reached.insert(node.index());
        }
    }
    reached
}

/// Why a vehicle is kept off some lanes, each reason once.
fn refusals(net: &Net, lanes: impl Iterator<Item = usize>) -> Vec<&str> {
    let mut refusals: Vec<&str> = Vec::new();
    for refusal in lanes.filter_map(|lane| net.weighed[lane].as_ref().err()) {
        if !refusals.contains(&refusal.as_str()) {
            refusals.push(refusal);
        }
    }
    refusals
}

/// Some reasons, and how many more there are.
fn some(reasons: &[&str], between: &str) -> String {
    match reasons {
        [one, two, three, _, ..] => {
            format!("{one}{between}{two}{between}{three}{between}{} more", reasons.len() - 3)
        }
        few => few.join(between),
    }
}

impl Pathfinder for Routes {
    fn robots(&self) -> Vec<String> {
        self.now.graph.vehicle_types.iter().map(|of| of.vehicle_type.clone()).collect()
    }

    fn ends(&self) -> Vec<Place> {
        self.places.clone()
    }

    fn outermost(&self) -> Vec<Point> {
        self.now.graph.nodes.iter().map(|node| node.at).collect()
    }

    fn find(&self, robot: &str, start: &str, goal: &str) -> std::result::Result<Found, NoEnd> {
        let vehicle = self.vehicle(robot)?;
        let (from, to) = (self.end(start, true)?, self.end(goal, false)?);
        let names = [robot, start, goal];
        Ok(match self.way(vehicle, &from.nodes, &to.nodes) {
            Some(way) => self.found(vehicle, names, [&from, &to], &way),
            None => none(names, self.because(vehicle, &from.nodes, &to.nodes)),
        })
    }

    fn find_through(&self, robot: &str, ends: [&str; 2], through: &str) -> Result<Found> {
        let vehicle = self.vehicle(robot)?;
        let (from, to) = (self.end(ends[0], true)?, self.end(ends[1], false)?);
        let meant = self.through(through);
        if meant.is_empty() {
            return Err(no_through(through, "a lane (`lane 12`), a node, a door or a lift"));
        }
        let names = [robot, ends[0], ends[1]];
        let by_lane = |&lane: &usize| {
            let weight = self.nets[vehicle].weighed[lane].as_ref().ok()?;
            let [a, b] = self.ends_of(lane);
            let (before, after) =
                (self.way(vehicle, &from.nodes, &[a])?, self.way(vehicle, &[b], &to.nodes)?);
            let lanes = before.lanes.into_iter().chain([lane]).chain(after.lanes).collect();
            Some(Way { cost: before.cost + weight + after.cost, from: before.from, lanes })
        };
        let best = meant.iter().filter_map(by_lane).min_by(|one, other| one.cost.total_cmp(&other.cost));
        if let Some(way) = best {
            return Ok(self.found(vehicle, names, [&from, &to], &way));
        }
        let refused = meant.iter().find_map(|&lane| self.nets[vehicle].weighed[lane].as_ref().err());
        let unreached = || format!("no way leads to {through} and on from it");
        Ok(none(names, refused.cloned().unwrap_or_else(unreached)))
    }

    fn picture(&self, title: &str, route: Option<[&str; 3]>) -> std::result::Result<String, NoEnd> {
        let mut lanes = Vec::new();
        if let Some([robot, start, goal]) = route {
            let vehicle = self.vehicle(robot)?;
            let (from, to) = (self.end(start, true)?, self.end(goal, false)?);
            lanes = self.way(vehicle, &from.nodes, &to.nodes).map(|way| way.lanes).unwrap_or_default();
        }
        // the legend says that nobody drives on the others
        let is_open =
            |lane: usize| self.nets.iter().any(|net| net.weighed.get(lane).is_some_and(|of| of.is_ok()));
        Ok(render_lanes(title, &self.now.graph, is_open, |door| self.now.closed_doors.contains(door), &lanes))
    }

    fn trouble(&self) -> Option<String> {
        self.judge.lock().unwrap_or_else(PoisonError::into_inner).trouble().map(str::to_owned)
    }

    fn summary(&self) -> String {
        let graph = &self.now.graph;
        let always = [(graph.nodes.len(), "node"), (graph.lanes.len(), "lane")];
        let perhaps = [(graph.doors.len(), "door"), (graph.lifts.len(), "lift")];
        let some = perhaps.into_iter().filter(|(count, _)| *count > 0);
        always
            .into_iter()
            .chain(some)
            .map(|(count, what)| counted(count, what))
            .collect::<Vec<_>>()
            .join(", ")
    }

    fn notes(&self) -> Vec<String> {
        let graph = &self.now.graph;
        let is_limited = |vehicle: &VehicleType| {
            let of_graph =
                |lane: &&Lane| lane.graph.is_none() || vehicle.graph.is_none() || lane.graph == vehicle.graph;
            graph.lanes.iter().filter(of_graph).any(|lane| lane.speed_limit.is_some())
                || graph
                    .uses
                    .iter()
                    .any(|of| of.vehicle_type == vehicle.vehicle_type && of.max_speed.is_some())
        };
        let unknown = graph.vehicle_types.iter().filter(|of| of.speed.is_none() && is_limited(of));
        let unknown: Vec<&str> = unknown.map(|of| of.vehicle_type.as_str()).collect();
        let Some(first) = unknown.first() else { return Vec::new() };
        let all = unknown.join(", ");
        vec![format!(
            "limits of speed count for nothing while a vehicle's own is unknown, as of {all}: \
             it stands in the table `vehicle_types`, row `{first}`, column `speed`, in m/s"
        )]
    }
}

/// That there is no route.
fn none([robot, start, goal]: [&str; 3], reason: String) -> Found {
    Found { row: Row { reason: Some(reason), ..Row::blank(robot, start, goal) }, said: Vec::new() }
}
