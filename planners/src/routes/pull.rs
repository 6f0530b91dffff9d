//! Pulling a way tight: straight where nothing is in the way, bent only about corners, refracted where hardness
//! changes, and a shape changed at the best point of the rim on which it may be changed.

use std::ops::Range;

use super::cone::{Gap, Segment, View, cross};
use super::graph::RouteGraph;
use super::mesh::{EPSILON, Exit, NONE};
use super::parts::{DoorIndex, RoomIndex};
use super::rounded::{Arc, Kept};
use super::way::Way;
use crate::geometry::Point;
use crate::geometry::tolerance::SNAP_M;

/// Rounds of sliding and straightening; most ways settle in two or three.
const ROUNDS: usize = 16;

/// A round that gains less than this share is the last.
const GAIN: f64 = 1e-7;

/// A stop is slid to its best place so finely, metres: finer than points are told apart.
const FINE_M: f64 = 0.1 * SNAP_M;

/// Steps in which it is slid there at most; halving alone would take some thirty.
const STEPS: usize = 100;

/// A door on a way.
#[derive(Clone, Copy, Debug)]
pub(super) struct Link {
    pub door: DoorIndex,
    /// Where it may be passed.
    pub segment: Segment,
    /// Where it is passed.
    pub at: Point,
    /// The room behind it.
    pub room: RoomIndex,
    /// Whether the way goes straight on through it, or stops to be refracted or to change shape.
    pub is_straight: bool,
}

impl Link {
    pub fn new(graph: &RouteGraph, door: DoorIndex, at: Point, room: RoomIndex) -> Self {
        let of = &graph[door];
        let before = if of.room1 == room { of.room2 } else { of.room1 };
        let Some(segment) = of.crossing.segment() else {
            let is_at = |segment: &Segment| segment.nearest_to(at).distance(at) <= SNAP_M;
            let segment = graph.gates(door, before).iter().map(|gate| gate.segment).find(is_at);
            // what is no gate is changed on, too, by those who start or end there
            let segment = segment.or_else(|| graph.sides(door, room).find(is_at));
            let segment = segment.unwrap_or(Segment { a: at, b: at });
            return Self { door, segment, at, room, is_straight: false };
        };
        let is_straight = graph.per_m(room).to_bits() == graph.per_m(before).to_bits();
        Self { door, segment, at, room, is_straight }
    }
}

/// Links that are passed at one point, and how the way bends there.
struct Bend {
    links: Range<usize>,
    at: Point,
    /// About what it bends, where that is an arc.
    arc: Option<Arc>,
    /// Whether the wall lies to the left.
    is_left: bool,
}

/// The doors on a way from a start to a goal.
pub(super) struct Chain<'g> {
    pub graph: &'g RouteGraph,
    pub start: (RoomIndex, Point),
    pub links: Vec<Link>,
    pub goal: Point,
}

impl Chain<'_> {
    pub fn pulled_tight(mut self) -> Way {
        let mut cost = self.cost();
        for _ in 0..ROUNDS {
            self.straighten();
            self.cut_corners();
            self.slide();
            let now = self.cost();
            if cost - now <= GAIN * now {
                break;
            }
            cost = now;
        }
        self.straighten();
        self.join_changes();
        Way::through(self.graph, self.start, self.rounded(), self.goal)
    }

    fn cost(&self) -> f64 {
        let (mut room, mut from, mut cost) = (self.start.0, self.start.1, 0.0);
        for link in &self.links {
            cost += from.distance(link.at) * self.graph.per_m(room);
            (room, from) = (link.room, link.at);
        }
        cost + from.distance(self.goal) * self.graph.per_m(room)
    }

    fn room_before(&self, link: usize) -> RoomIndex {
        if link == 0 { self.start.0 } else { self.links[link - 1].room }
    }

    /// Pulls each run of doors between two stops taut.
    fn straighten(&mut self) {
        let mut first = 0;
        let mut from = self.start.1;
        while first <= self.links.len() {
            let stop = (first..self.links.len()).find(|&link| !self.links[link].is_straight);
            let end = stop.unwrap_or(self.links.len());
            let to = stop.map_or(self.goal, |stop| self.links[stop].at);
            let openings: Vec<Opening> = (first..end).map(|link| self.opening(link)).collect();
            for (link, at) in (first..end).zip(taut(from, &openings, to)) {
                self.links[link].at = at;
            }
            from = to;
            first = end + 1;
        }
    }

    /// What the way comes through, in its order, with arcs where it bends about corners of walls.
    fn rounded(&self) -> Vec<(Option<DoorIndex>, Point, RoomIndex)> {
        let mut passed: Vec<(Option<DoorIndex>, Point, RoomIndex)> = Vec::with_capacity(self.links.len());
        let (mut first, mut from) = (0, self.start.1);
        while first <= self.links.len() {
            let stop = (first..self.links.len()).find(|&link| !self.links[link].is_straight);
            let end = stop.unwrap_or(self.links.len());
            let to = stop.map_or(self.goal, |stop| self.links[stop].at);
            let (openings, of): (Vec<Opening>, Vec<Option<usize>>) =
                self.openings(first..end).into_iter().unzip();
            let mut points = taut(from, &openings, to);
            points.push(to);
            let mut before = from;
            for (place, of) in of.into_iter().enumerate() {
                let (at, after) = (points[place], points[place + 1]);
                let room = passed.last().map_or(self.start.0, |(_, _, room)| *room);
                match of {
                    Some(link) => passed.push((Some(self.links[link].door), at, self.links[link].room)),
                    None if turns(before, at, after) => passed.push((None, at, room)),
                    None => continue,
                }
                before = at;
            }
            if let Some(stop) = stop {
                passed.push((Some(self.links[stop].door), to, self.links[stop].room));
            }
            from = to;
            first = end + 1;
        }
        passed
    }

    /// The doors of some links with the links, and where the way bends about an arc what keeps it off.
    fn openings(&self, links: Range<usize>) -> Vec<(Opening, Option<usize>)> {
        let mut bends: Vec<Bend> = Vec::new();
        let mut first = links.start;
        while first < links.end {
            let at = self.links[first].at;
            let here = (first..links.end).take_while(|&link| self.links[link].at.distance(at) <= SNAP_M);
            let end = first + here.count();
            let before = if first == 0 { self.start.1 } else { self.links[first - 1].at };
            let after = self.links.get(end).map_or(self.goal, |next| next.at);
            let arc = turns(before, at, after).then(|| self.graph.arc(self.links[first].door, at)).flatten();
            bends.push(Bend { links: first..end, at, arc, is_left: cross(before, at, after) > 0.0 });
            first = end;
        }
        let mut all: Vec<(Opening, Option<usize>)> = Vec::with_capacity(links.len());
        for (number, bend) in bends.iter().enumerate() {
            let Some(arc) = &bend.arc else {
                all.extend(bend.links.clone().map(|link| (self.opening(link), Some(link))));
                continue;
            };
            let beside = [number.checked_sub(1), Some(number + 1)];
            let along = beside.map(|beside| {
                let beside = bends.get(beside?)?;
                (beside.arc.is_some() && beside.is_left == bend.is_left).then_some(beside.at)
            });
            let of = |link: usize| (link, self.links[link].segment);
            let opening = |kept: Kept| {
                let Kept { inner, outer, link } = kept;
                let (left, right) = if bend.is_left { (inner, outer) } else { (outer, inner) };
                (Opening { segment: Segment::new(inner, outer), left, right }, link)
            };
            let links: Vec<_> = bend.links.clone().map(of).collect();
            all.extend(arc.keeps(&links, bend.is_left, along).into_iter().map(opening));
        }
        all
    }

    /// The door of a link, as one comes to it.
    fn opening(&self, link: usize) -> Opening {
        let graph = self.graph;
        let (before, after) = (&graph[self.room_before(link)].outline, &graph[self.links[link].room].outline);
        let (one, two) = (before.centre(), after.centre());
        let segment = self.links[link].segment;
        let Segment { a, b } = segment;
        let is_b_left = (two.x - one.x) * (b.y - a.y) - (two.y - one.y) * (b.x - a.x) > 0.0;
        let (left, right) = if is_b_left { (b, a) } else { (a, b) };
        Opening { segment, left, right }
    }

    /// Whether the way bends or stops at a door.
    fn is_vertex(&self, link: usize) -> bool {
        if !self.links[link].is_straight {
            return true;
        }
        let at = self.links[link].at;
        let before = if link == 0 { self.start.1 } else { self.links[link - 1].at };
        let after = self.links.get(link + 1).map_or(self.goal, |next| next.at);
        let turn = cross(before, at, after).abs();
        turn > EPSILON * before.distance(at).max(EPSILON) * at.distance(after).max(EPSILON)
            && before.distance(at) > EPSILON
            || before.distance(at) <= EPSILON && link > 0 && self.is_vertex(link - 1)
    }

    /// Goes straight from vertex to vertex where that is possible through other doors.
    fn cut_corners(&mut self) {
        let mut link = 0;
        while link < self.links.len() {
            if self.links[link].is_straight && self.is_vertex(link) {
                let first = (0..link).rev().find(|&before| self.is_vertex(before));
                let last = (link + 1..self.links.len()).find(|&after| self.is_vertex(after));
                let (room, from) = first.map_or(self.start, |at| (self.links[at].room, self.links[at].at));
                let to = last.map_or(self.goal, |at| self.links[at].at);
                let end = last.unwrap_or(self.links.len());
                let into = self.room_before(end);
                if let Some(links) = self.walk(room, from, into, to) {
                    let begin = first.map_or(0, |first| first + 1);
                    let count = links.len();
                    self.links.splice(begin..end, links);
                    link = begin + count;
                    continue;
                }
            }
            link += 1;
        }
    }

    /// The doors on the straight line between two points; `None` where they do not see each other.
    fn walk(&self, room: RoomIndex, from: Point, into: RoomIndex, to: Point) -> Option<Vec<Link>> {
        let graph = self.graph;
        let (mut links, mut room, mut at) = (Vec::new(), room, 0.0);
        let length = from.distance(to);
        let mut passed = vec![room];
        while room != into {
            let share = graph[room].outline.leaves(from, to).max(at).min(1.0);
            let on = Segment { a: from, b: to };
            let (here, beyond) = (on.at(share), on.at((share + SNAP_M / length.max(SNAP_M)).min(1.0)));
            let near = |p: Point, room: RoomIndex| graph[room].outline.distance(p);
            let exits = graph.exits.portals(room).iter().filter(|exit| {
                graph.costs_nothing(exit.door)
                    && graph[exit.door].crossing.nearest_to(here).distance(here) <= SNAP_M
                    && !passed.contains(&exit.to)
            });
            let next = exits.min_by(|one, two| near(beyond, one.to).total_cmp(&near(beyond, two.to)))?;
            links.push(Link::new(graph, next.door, here, next.to));
            room = next.to;
            passed.push(room);
            at = share;
        }
        Some(links)
    }

    /// Takes one change of shape instead of several at one point, where that costs no more, and none where doors lead there.
    fn join_changes(&mut self) {
        let graph = self.graph;
        let mut first = 0;
        while first < self.links.len() {
            let at = self.links[first].at;
            let is_here = |link: &&Link| link.at.distance(at) <= SNAP_M;
            let count = self.links[first..].iter().take_while(is_here).count();
            let from = self.room_before(first);
            let joined = (2..=count).rev().find_map(|count| {
                let run = &self.links[first..first + count];
                let to = run.last()?.room;
                let price: f64 = run.iter().filter_map(|link| graph.passage(link.door)).sum();
                if to == from {
                    return Some((count, Vec::new()));
                }
                if run.iter().any(|link| !graph.costs_nothing(link.door))
                    && let Some(doors) = self.around(from, to, at)
                {
                    return Some((count, doors));
                }
                let exit = graph.exits.changes(from).iter().find(|exit| {
                    let crossing = &graph[exit.door].crossing;
                    exit.to == to
                        && crossing.nearest_to(at).distance(at) <= SNAP_M
                        && graph.passage(exit.door).is_some_and(|weight| weight <= price + EPSILON)
                })?;
                Some((count, vec![Link::new(graph, exit.door, at, to)]))
            });
            if let Some((count, links)) = joined {
                self.links.splice(first..first + count, links);
            }
            first += 1;
        }
    }

    /// The doors that weigh nothing through which one comes from a room into another about a point of both.
    fn around(&self, from: RoomIndex, to: RoomIndex, at: Point) -> Option<Vec<Link>> {
        let graph = self.graph;
        if graph.turning().mesh.layer(from) != graph.turning().mesh.layer(to) {
            return None;
        }
        // each room with the door by which it was entered, and which one was left
        let mut reached: Vec<(RoomIndex, Option<(usize, DoorIndex)>)> = vec![(from, None)];
        let mut next = 0;
        while let Some(&(room, _)) = reached.get(next).filter(|(room, _)| *room != to) {
            for exit in graph.exits.portals(room).iter().filter(|exit| graph.costs_nothing(exit.door)) {
                let is_new = reached.iter().all(|(room, _)| *room != exit.to);
                if is_new && graph[exit.door].crossing.nearest_to(at).distance(at) <= SNAP_M {
                    reached.push((exit.to, Some((next, exit.door))));
                }
            }
            next += 1;
        }
        let mut links = Vec::new();
        let mut place = next;
        while let (room, Some((before, door))) = *reached.get(place)? {
            links.push(Link::new(graph, door, at, room));
            place = before;
        }
        links.reverse();
        Some(links)
    }

    /// Slides each stop along its segment to where its two neighbours are joined at least hardness.
    fn slide(&mut self) {
        let mut next = 0;
        while let Some(stop) = (next..self.links.len()).find(|&link| !self.links[link].is_straight) {
            next = stop + 1;
            let here = self.links[stop].at;
            // doors passed at the stop itself move along with it, but other stops do not
            let is_end = |link: &usize| {
                let link = *link;
                self.is_vertex(link)
                    && (!self.links[link].is_straight || self.links[link].at.distance(here) > EPSILON)
            };
            let first = (0..stop).rev().find(is_end);
            let last = (stop + 1..self.links.len()).find(is_end);
            let from = first.map_or(self.start.1, |link| self.links[link].at);
            let to = last.map_or(self.goal, |link| self.links[link].at);
            let mut part = Some(self.links[stop].segment);
            for link in first.map_or(0, |first| first + 1)..stop {
                part = part.and_then(|part| seen_through(from, self.links[link].segment, part));
            }
            for link in stop + 1..last.unwrap_or(self.links.len()) {
                part = part.and_then(|part| seen_through(to, self.links[link].segment, part));
            }
            let Some(part) = part else { continue };
            let (one, two) =
                (self.graph.per_m(self.room_before(stop)), self.graph.per_m(self.links[stop].room));
            let cost = |p: Point| one * from.distance(p) + two * p.distance(to);
            let best = least(&part, (one, from), (two, to));
            if cost(best) < cost(self.links[stop].at) {
                self.links[stop].at = best;
            }
            let segment = self.links[stop].segment;
            if [segment.a, segment.b].iter().any(|end| end.distance(self.links[stop].at) <= SNAP_M) {
                self.step_over(stop, first, last);
            }
        }
    }

    /// A stop at the end of its segment goes over to one that begins there, if that gains something.
    fn step_over(&mut self, stop: usize, first: Option<usize>, last: Option<usize>) {
        let (room, from) = first.map_or(self.start, |at| (self.links[at].room, self.links[at].at));
        let to = last.map_or(self.goal, |link| self.links[link].at);
        let end = last.unwrap_or(self.links.len());
        let into = self.room_before(end);
        let (before, here) = (self.room_before(stop), self.links[stop]);
        let graph = self.graph;
        let (one, two) = (graph.per_m(before), graph.per_m(here.room));
        let cost = |p: Point| one * from.distance(p) + two * p.distance(to);
        let mut best: Option<(f64, Vec<Link>)> = None;
        for link in self.stops_beside(before, &here) {
            let at = least(&link.segment, (one, from), (two, to));
            let gain = cost(here.at) - cost(at);
            if gain <= GAIN * cost(here.at) || best.as_ref().is_some_and(|(most, _)| gain <= *most) {
                continue;
            }
            let of = &graph[link.door];
            let outside = if of.room1 == link.room { of.room2 } else { of.room1 };
            if let (Some(mut links), Some(rest)) =
                (self.walk(room, from, outside, at), self.walk(link.room, at, into, to))
            {
                links.push(Link { at, ..link });
                links.extend(rest);
                best = Some((gain, links));
            }
        }
        if let Some((_, links)) = best {
            self.links.splice(first.map_or(0, |first| first + 1)..end, links);
        }
    }

    /// Other doors between the same two layers, weighed the same, that can be passed where a stop is.
    fn stops_beside(&self, before: RoomIndex, stop: &Link) -> Vec<Link> {
        let graph = self.graph;
        let is_change = graph[stop.door].is_change();
        let weight = graph.passage(stop.door);
        let mut rooms = vec![before];
        let free = graph.exits.portals(before).iter().filter(|exit| graph.costs_nothing(exit.door));
        rooms.extend(free.map(|exit| exit.to));
        rooms.retain(|&room| graph[room].outline.distance(stop.at) <= SNAP_M);
        let mut found = Vec::new();
        for room in rooms {
            let exits = if is_change { graph.exits.changes(room) } else { graph.exits.portals(room) };
            for &Exit { door, to } in exits {
                let is_like = graph.turning().mesh.layer(to) == graph.turning().mesh.layer(stop.room)
                    && graph.per_m(to).to_bits() == graph.per_m(stop.room).to_bits()
                    && graph.passage(door) == weight;
                if !is_like {
                    continue;
                }
                let link = |segment: Segment| Link { door, segment, room: to, ..*stop };
                match graph[door].crossing.segment() {
                    Some(segment) => found.push(link(segment)),
                    None => found.extend(graph.gates(door, room).iter().map(|gate| link(gate.segment))),
                }
            }
        }
        found.retain(|link| {
            link.segment != stop.segment && link.segment.nearest_to(stop.at).distance(stop.at) <= SNAP_M
        });
        found
    }
}

/// Whether a way turns at a point.
pub(super) fn turns(before: Point, at: Point, after: Point) -> bool {
    let (come, go) = (before.distance(at), at.distance(after));
    come > EPSILON && go > EPSILON && cross(before, at, after).abs() > EPSILON * come.max(1.0) * go.max(1.0)
}

/// The part of a segment that is seen from a point through a door.
fn seen_through(from: Point, door: Segment, part: Segment) -> Option<Segment> {
    if door.is_in_line_with(from) {
        return Some(part);
    }
    View::Through(Gap::new(from, door, door, [NONE; 2])).of(from, part)
}

/// Where on a segment a way from one point and on to another one costs least, each with what a metre on its side weighs: Newton's
/// method on the slope of what it costs, within the stretch where that changes its sign.
fn least(segment: &Segment, (one, from): (f64, Point), (two, to): (f64, Point)) -> Point {
    let (length, ahead) = (segment.length(), segment.direction());
    let [from_seen, to_seen] = [from, to].map(|p| (p - segment.a).seen_along(ahead));
    // how fast the cost grows along the segment, and how fast that does
    let grows = |x: f64| {
        [(one, from_seen), (two, to_seen)].into_iter().fold((0.0, 0.0), |(slope, curve), (weight, p)| {
            let (along, aside) = (x - p.x, p.y * p.y);
            let square = along * along + aside;
            if square <= 0.0 {
                return (slope, curve);
            }
            let distance = square.sqrt();
            (slope + weight * along / distance, curve + weight * aside / (square * distance))
        })
    };
    let (mut low, mut high) = (0.0, length);
    let aside = from_seen.y.abs() + to_seen.y.abs();
    let straight = (from_seen.x * to_seen.y.abs() + to_seen.x * from_seen.y.abs()) / aside;
    let mut x = if straight > low && straight < high { straight } else { 0.5 * length };
    let mut was_short = false;
    for _ in 0..STEPS {
        let (slope, curve) = grows(x);
        if slope > 0.0 {
            high = x;
        } else {
            low = x;
        }
        if high - low <= FINE_M {
            break;
        }
        let step = -slope / curve;
        // a short step may have come to the place or, beside a point that all but lies on the segment, not come on: one over it tells
        let is_short = step.abs() < FINE_M;
        let next = x + if is_short { FINE_M.copysign(step) } else { step };
        let is_within = next > low && next < high && !(is_short && was_short);
        (x, was_short) = (if is_within { next } else { f64::midpoint(low, high) }, is_short);
    }
    // an end beats a point just beside it
    let inner = segment.at(if length > 0.0 { x / length } else { 0.0 });
    let cost = |p: &Point| one * from.distance(*p) + two * p.distance(to);
    let all = [segment.a, segment.b, inner];
    all.into_iter().min_by(|a, b| cost(a).total_cmp(&cost(b))).unwrap_or(inner)
}

/// A door as one comes to it.
pub(super) struct Opening {
    pub segment: Segment,
    pub left: Point,
    pub right: Point,
}

/// Where the shortest way between two points passes doors, in their order.
pub(super) fn taut(from: Point, doors: &[Opening], to: Point) -> Vec<Point> {
    let mut passed = vec![from; doors.len()];
    let (mut apex, mut done) = (from, 0);
    while done < doors.len() {
        let corner = next_corner(apex, &doors[done..], to).map(|(point, door)| (point, done + door));
        let (next, end) = corner.map_or((to, doors.len()), |(point, door)| (point, door + 1));
        let mut last = apex;
        for door in done..end {
            let at = doors[door].segment.passed_at(apex, next);
            // where what keeps a way off two corners lies one beside the other, nobody goes back
            if (at - last).dot(next - apex) > 0.0 {
                last = at;
            }
            passed[door] = last;
        }
        if corner.is_some() {
            passed[end - 1] = next;
        }
        (apex, done) = (next, end);
    }
    passed
}

/// The first end of a door about which a string from `apex` through the doors bends, and that door. The doors are seen
/// through one another until one is not.
fn next_corner(apex: Point, doors: &[Opening], to: Point) -> Option<(Point, usize)> {
    let mut left: Option<(Point, usize)> = None;
    let mut right: Option<(Point, usize)> = None;
    for (index, door) in doors.iter().enumerate() {
        // a door at the apex itself narrows nothing
        if door.segment.nearest_to(apex).distance(apex) <= EPSILON {
            continue;
        }
        match (left, right) {
            (_, Some(corner)) if cross(apex, corner.0, door.left) < 0.0 => return Some(corner),
            (Some(corner), _) if cross(apex, corner.0, door.right) > 0.0 => return Some(corner),
            _ => {}
        }
        // one that is seen edge-on is come to at its nearer end, whatever a rounding says of what lies behind it
        if door.segment.is_in_line_with(apex) {
            return Some((door.segment.nearest_to(apex), index));
        }
        if left.is_none_or(|(limit, _)| cross(apex, limit, door.left) <= 0.0) {
            left = Some((door.left, index));
        }
        if right.is_none_or(|(limit, _)| cross(apex, limit, door.right) >= 0.0) {
            right = Some((door.right, index));
        }
    }
    match (left, right) {
        (_, Some(corner)) if cross(apex, corner.0, to) < 0.0 => Some(corner),
        (Some(corner), _) if cross(apex, corner.0, to) > 0.0 => Some(corner),
        _ => None,
    }
}
