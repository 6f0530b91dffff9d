//! A route as a vehicle drives it: stops, with what is between them.

use geo::{Coord, Intersects, Line as Leg, LineString, Polygon};

use crate::site::{Area, Route};

/// How near two points are one, metres.
pub const SAME: f64 = 0.02;

/// A way of so many metres is none, whatever is beside it.
const NO_WAY: f64 = 1e-3;

/// Metres that a body of this width keeps from a doorway before it is let through, beside half its width.
pub struct Margins {
    /// Beyond the robot's rim.
    pub before: f64,
    /// How long before it would have to stop it is let on.
    pub ahead: f64,
}

/// A robot in one of its states.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Body {
    /// Half its width, metres.
    pub half: f64,
    /// Metres per second, where that is known.
    pub speed: Option<f64>,
}

/// What the floor asks of whoever drives there.
#[derive(Clone, Copy, Debug)]
pub struct Floor<'a> {
    pub bridges: &'a [Bridge],
    pub areas: &'a [Area],
}

/// Something low over the floor.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bridge {
    /// x0, y0, x1, y1
    pub rect: [f64; 4],
    pub height: f64,
}

/// A point at which the way bends, changes shape, meets a doorway, starts or ends.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Stop {
    pub id: String,
    pub words: String,
    pub at: [f64; 2],
    /// In which it lies.
    pub space: String,
    /// In which the robot comes there; at the start, in which it leaves.
    pub state: Option<String>,
    /// How the body lies on the way there, degrees.
    pub facing: Option<f64>,
    /// Metres between the rim and what is solid, on the way there.
    pub clearance: Option<f64>,
    /// Metres by which it may be passed beside; `None`: as exactly as it can be.
    pub deviation: Option<f64>,
    /// The lowest that is over the way there, metres.
    pub height: Option<f64>,
    /// How fast one drives there at most, metres per second: as the state does, and the areas on the way there let it.
    pub speed: Option<f64>,
    /// The doorway in which it lies.
    pub doorway: Option<String>,
    /// Whether it is where to wait before a doorway.
    pub is_wait: bool,
    /// The state into which the robot changes there.
    pub becomes: Option<String>,
}

/// A point of the way, by metres from its start.
struct Mark {
    s: f64,
    stop: Stop,
}

/// The stops of a route, from its start to its goal, of a robot with these bodies by state.
pub fn stops(route: &Route, body: impl Fn(&str) -> Body, margins: &Margins, floor: Floor<'_>) -> Vec<Stop> {
    let Some(line) = Line::of(route) else { return Vec::new() };
    let mut marks = line.bends(route);
    let passages = line.passages(route);
    let mut passed = 0.0;
    for (s, doorway) in &passages {
        let (at, leg) = line.at(*s);
        let state = route.waypoints[leg].state.as_deref().unwrap_or_default();
        let keep = body(state).half;
        let wait = s - keep - margins.before;
        let space = Line::space(&passages, route, wait);
        if wait > passed {
            line.add_wait(&mut marks, wait, passed, format!("before {doorway}, {space}"), route);
            if wait - margins.ahead > passed {
                let stop = Stop { words: format!("towards {doorway}, {space}"), ..Stop::default() };
                line.add(&mut marks, wait - margins.ahead, stop, route);
            }
        }
        let stop = Stop { words: doorway.clone(), doorway: Some(doorway.clone()), at, ..Stop::default() };
        line.add(&mut marks, *s, stop, route);
        passed = s + keep;
    }
    marks.sort_by(|one, other| one.s.total_cmp(&other.s));
    let total = line.total();
    let mut stops: Vec<Stop> = Vec::new();
    for mark in marks {
        let mut stop = mark.stop;
        stop.space = Line::space(&passages, route, mark.s);
        let (place, is_place) = match mark.s {
            s if s <= 0.0 => (&route.start, is_name(&route.start)),
            s if s >= total => (&route.goal, is_name(&route.goal)),
            _ => (&route.goal, false),
        };
        if stop.words.is_empty() {
            stop.words = if is_place { place.clone() } else { stop.space.clone() };
        }
        stop.id = if is_place { place.clone() } else { named(&stop.words, stop.at) };
        if let Some(before) = stops.last() {
            let body = body(stop.state.as_deref().unwrap_or_default());
            stop.height = lowest(floor.bridges, before.at, stop.at, body.half);
            stop.speed = slowest(floor.areas, before.at, stop.at, body.speed);
        }
        stops.push(stop);
    }
    for index in 1..stops.len().saturating_sub(1) {
        let room = stops[index + 1].clearance.and_then(|next| Some(next.min(stops[index].clearance?)));
        let stop = &mut stops[index];
        stop.deviation = room.filter(|room| !stop.is_wait && stop.becomes.is_none() && *room > SAME);
    }
    stops
}

/// Whether an end is called by a name, not by `x,y`.
fn is_name(end: &str) -> bool {
    !end.is_empty() && !end.split(',').all(|part| part.trim().parse::<f64>().is_ok())
}

fn named(words: &str, at: [f64; 2]) -> String {
    // no -0.00
    let [x, y] = at.map(|v| (v * 100.0).round() / 100.0 + 0.0);
    format!("{words} {x:.2},{y:.2}")
}

pub fn distance(a: [f64; 2], b: [f64; 2]) -> f64 {
    (a[0] - b[0]).hypot(a[1] - b[1])
}

/// The waypoints with their metres from the start.
struct Line {
    points: Vec<[f64; 2]>,
    s: Vec<f64>,
}

impl Line {
    fn of(route: &Route) -> Option<Self> {
        let points: Vec<[f64; 2]> = route.waypoints.iter().map(|point| [point.x, point.y]).collect();
        let mut s = vec![0.0];
        for pair in points.windows(2) {
            s.push(s.last()? + distance(pair[0], pair[1]));
        }
        (!points.is_empty()).then_some(Self { points, s })
    }

    fn total(&self) -> f64 {
        self.s.last().copied().unwrap_or_default()
    }

    /// The point so many metres from the start, and the waypoint to which the leg that it is on leads.
    fn at(&self, s: f64) -> ([f64; 2], usize) {
        let leg = self.s.iter().position(|end| *end >= s).unwrap_or(self.s.len() - 1);
        if leg == 0 || self.s[leg] <= s {
            return (self.points[leg], leg);
        }
        let share = (s - self.s[leg - 1]) / (self.s[leg] - self.s[leg - 1]);
        let (a, b) = (self.points[leg - 1], self.points[leg]);
        ([a[0] + share * (b[0] - a[0]), a[1] + share * (b[1] - a[1])], leg)
    }

    /// Metres from the start of the point of the line that is nearest to this one, at or after `from`.
    fn nearest(&self, to: [f64; 2], from: f64) -> f64 {
        let mut best = (f64::INFINITY, from);
        for leg in 1..self.points.len() {
            let (a, b, length) = (self.points[leg - 1], self.points[leg], self.s[leg] - self.s[leg - 1]);
            if self.s[leg] < from || length <= 0.0 {
                continue;
            }
            let along = ((to[0] - a[0]) * (b[0] - a[0]) + (to[1] - a[1]) * (b[1] - a[1])) / length;
            let s = (self.s[leg - 1] + along.clamp(0.0, length)).max(from);
            let off = distance(self.at(s).0, to);
            // the first of those that are as near
            if off < best.0 - 1e-9 {
                best = (off, s);
            }
        }
        best.1
    }

    /// The waypoints. One that is but a step from the one before is left out where there is room for the vehicle to go straight
    /// by: nobody drives to and fro by a centimetre.
    fn bends(&self, route: &Route) -> Vec<Mark> {
        let mut marks: Vec<Mark> = Vec::new();
        // what is beside the leg that was left out, less what the way is moved by
        let mut beside: Option<f64> = None;
        for (index, point) in route.waypoints.iter().enumerate() {
            let next = route.waypoints.get(index + 1);
            let becomes = next.filter(|next| next.state != point.state).and_then(|next| next.state.clone());
            let (count, room) = (marks.len(), point.clearance);
            if let Some(mark) = marks.last_mut() {
                let step = self.s[index] - mark.s;
                let is_roomy = [room, next.map_or(room, |next| next.clearance)]
                    .iter()
                    .all(|room| room.is_some_and(|room| room > SAME));
                let is_bend = mark.stop.becomes.is_none() && becomes.is_none();
                if step <= NO_WAY || step < SAME && is_roomy && is_bend && (next.is_some() || count > 1) {
                    // several changes at one point are one
                    mark.stop.becomes = becomes.or(mark.stop.becomes.take());
                    beside = least(beside, room.map(|room| room - step));
                    // the goal is where it was said to be
                    if next.is_none() && count > 1 {
                        (mark.s, mark.stop.at) = (self.s[index], [point.x, point.y]);
                        mark.stop.clearance = least(mark.stop.clearance, beside);
                    }
                    continue;
                }
            }
            let before = index.checked_sub(1).map(|before| self.points[before]);
            let heading = before.map(|a| (point.y - a[1]).atan2(point.x - a[0]));
            let stop = Stop {
                at: [point.x, point.y],
                state: point.state.clone(),
                facing: point.facing.map(|facing| along(facing, heading)),
                clearance: least(room, beside.take()),
                becomes,
                ..Stop::default()
            };
            marks.push(Mark { s: self.s[index], stop });
        }
        marks
    }

    /// Where the way passes doorways, with their names.
    fn passages(&self, route: &Route) -> Vec<(f64, String)> {
        let mut found: Vec<(f64, String)> = Vec::new();
        let mut from = 0.0;
        for step in &route.steps {
            let (Some(doorway), Some(x), Some(y)) = (&step.doorway, step.x, step.y) else { continue };
            from = self.nearest([x, y], from);
            found.push((from, doorway.clone()));
        }
        found
    }

    /// The space in which the way is after so many metres: it is another one after each doorway.
    fn space(passages: &[(f64, String)], route: &Route, s: f64) -> String {
        let passed = passages.iter().filter(|(at, _)| *at < s).count();
        let mut doorways = 0;
        let mut found = None;
        for step in &route.steps {
            if step.doorway.is_some() {
                doorways += 1;
            }
            if doorways > passed && found.is_some() {
                break;
            }
            found = step.space.as_ref().or(found);
        }
        found.cloned().unwrap_or_else(|| "floor".to_owned())
    }

    /// Adds a point between waypoints; one that is a waypoint says more of it.
    fn add(&self, marks: &mut Vec<Mark>, s: f64, stop: Stop, route: &Route) {
        if let Some(mark) = marks.iter_mut().find(|mark| (mark.s - s).abs() < SAME) {
            if stop.doorway.is_some() && mark.stop.doorway.is_none() {
                mark.stop.doorway = stop.doorway;
                mark.stop.words = stop.words;
            }
            return;
        }
        let (at, leg) = self.at(s);
        let point = &route.waypoints[leg];
        let heading = leg.checked_sub(1).map(|before| {
            let (a, b) = (self.points[before], self.points[leg]);
            (b[1] - a[1]).atan2(b[0] - a[0])
        });
        let stop = Stop {
            at,
            state: point.state.clone(),
            facing: point.facing.map(|facing| along(facing, heading)),
            clearance: point.clearance,
            ..stop
        };
        marks.push(Mark { s, stop });
    }

    /// Adds where to wait. Nothing is done there, so that it can be sent again as it is: a change of shape comes after it.
    fn add_wait(&self, marks: &mut Vec<Mark>, s: f64, floor: f64, words: String, route: &Route) {
        let here = marks.iter_mut().find(|mark| (mark.s - s).abs() < SAME && mark.s > 0.0);
        let s = match here {
            Some(mark) if mark.stop.becomes.is_none() && mark.stop.doorway.is_none() => {
                mark.stop.is_wait = true;
                mark.stop.words = words;
                return;
            }
            Some(mark) => mark.s - 2.0 * SAME,
            None => s,
        };
        if s > floor {
            self.add(marks, s, Stop { words, is_wait: true, ..Stop::default() }, route);
        }
    }
}

/// The lesser of what is known.
fn least(one: Option<f64>, other: Option<f64>) -> Option<f64> {
    one.into_iter().chain(other).min_by(f64::total_cmp)
}

/// Of the two directions in which a body may lie, the one that is nearer to where it goes.
fn along(facing: f64, heading: Option<f64>) -> f64 {
    let Some(heading) = heading else { return facing };
    if (facing.to_radians() - heading).cos() < -1e-9 { facing + 180.0 } else { facing }
}

/// The lowest bridge over the way of a body so wide.
fn lowest(bridges: &[Bridge], a: [f64; 2], b: [f64; 2], half: f64) -> Option<f64> {
    let over = bridges.iter().filter(|bridge| meets(bridge.rect, a, b, half));
    over.map(|bridge| bridge.height).min_by(f64::total_cmp)
}

/// How fast a body may go there that goes so fast by itself. As rooms have it, its middle is what enters an area.
fn slowest(areas: &[Area], a: [f64; 2], b: [f64; 2], own: Option<f64>) -> Option<f64> {
    let coord = |[x, y]: [f64; 2]| Coord { x, y };
    let leg = Leg::new(coord(a), coord(b));
    let limited = areas.iter().filter_map(|area| Some((area, area.speed_limit(own)?)));
    let met = limited.filter(|(area, _)| {
        let ring: LineString = area.corners.iter().copied().map(coord).collect();
        Polygon::new(ring, Vec::new()).intersects(&leg)
    });
    met.map(|(_, limit)| limit).chain(own).min_by(f64::total_cmp)
}

/// Whether a segment comes as near as that to a rectangle, its corners rounded up.
fn meets(rect: [f64; 4], a: [f64; 2], b: [f64; 2], half: f64) -> bool {
    let (mut from, mut to) = (0.0_f64, 1.0_f64);
    for axis in 0..2 {
        let (low, high) = (rect[axis] - half, rect[axis + 2] + half);
        let step = b[axis] - a[axis];
        if step.abs() < 1e-12 {
            if a[axis] < low || a[axis] > high {
                return false;
            }
            continue;
        }
        let (near, far) = ((low - a[axis]) / step, (high - a[axis]) / step);
        from = from.max(near.min(far));
        to = to.min(near.max(far));
    }
    from <= to
}
