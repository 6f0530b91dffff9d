//! A stretch of a way between two stops, and the corners of walls that it passes.

use std::collections::BTreeMap;
use std::f64::consts::{FRAC_PI_2, PI};
use std::ops::Range;

use super::super::cone::Segment;
use super::super::graph::RouteGraph;
use super::super::parts::{DoorIndex, RoomIndex};
use super::super::pull::{Opening, taut, turns};
use super::super::rounded::{Arc, tangents};
use super::super::way::Leg;
use crate::geometry::tolerance::SNAP_M;
use crate::geometry::{Point, Rect, Sector};

/// A way is kept to its side of a corner by a line that leads so far away from it, metres.
const FAR_M: f64 = 1.0;

/// A wall of no more than this angle is a line that nobody can touch, radians.
const FLAT: f64 = 1e-3;

/// A way through doors that cost nothing, between two stops.
pub(super) struct Run {
    /// Which of the tight way's legs.
    pub legs: Range<usize>,
    /// Whether it begins or ends elsewhere than there.
    pub is_moved: bool,
    /// Where the tight way turns, with both ends.
    pub points: Vec<Point>,
    /// How far each of them is along the way.
    pub along: Vec<f64>,
    pub per_m: f64,
    pub corners: Vec<Corner>,
}

/// A corner of a wall that a way comes near to.
pub(super) struct Corner {
    pub centre: Point,
    /// Nearer than this nobody comes, metres.
    pub least: f64,
    /// How much farther the way is wanted to keep, metres.
    pub berth: f64,
    /// What of that it keeps, from 0 to 1.
    pub share: f64,
    /// From the centre to tangents of a circle of one metre about it, as far as they are passed.
    pub around: Vec<Point>,
    pub is_left: bool,
    /// How far along the way.
    pub along: f64,
    /// Whether it keeps the way in its place, so far as is known.
    pub is_active: bool,
    /// The arc up to which the ground is free, where it is.
    pub arc: Option<Arc>,
}

impl Corner {
    pub fn radius(&self) -> f64 {
        self.least + self.berth * self.share
    }
}

/// A bend of a way about a corner of a run, by number.
pub(super) type Bend = (Point, usize);

impl Run {
    /// # Arguments
    /// `ends` are where it begins and ends: it may do so elsewhere than the tight way does.
    pub fn new(graph: &RouteGraph, legs: &[Leg], range: Range<usize>, ends: [Point; 2]) -> Self {
        let legs_of = &legs[range.clone()];
        let last = legs_of[legs_of.len() - 1].to;
        let is_moved = ends != [legs_of[0].from, last];
        let mut points = vec![ends[0]];
        for (leg, next) in legs_of.iter().zip(&legs_of[1..]) {
            let last = points[points.len() - 1];
            points.extend(turns(last, leg.to, next.to).then_some(leg.to));
        }
        points.push(ends[1]);
        let mut along = vec![0.0];
        along.extend(points.windows(2).scan(0.0, |sum, ends| {
            *sum += ends[0].distance(ends[1]);
            Some(*sum)
        }));
        let per_m = graph.per_m(legs_of[0].room);
        let mut run = Self { legs: range, is_moved, points, along, per_m, corners: Vec::new() };
        let berth = graph[legs_of[0].room].berth.metres;
        if berth > 0.0 {
            run.corners = run.corners_beside(graph, legs_of, berth);
        }
        run
    }

    /// The first leg at whose end the way bends, and about no corner of a wall.
    pub fn bend_off_walls(&self, legs: &[Leg]) -> Option<usize> {
        // tangents to an arc about a corner meet farther from it than the arc, by less than half of its radius
        let is_about = |corner: &Corner, at: Point| {
            corner.centre.distance(at) <= 1.5 * corner.least + corner.berth + SNAP_M
        };
        let is_off = |leg: &usize| {
            let (leg, next) = (&legs[*leg], &legs[*leg + 1]);
            turns(leg.from, leg.to, next.to) && !self.corners.iter().any(|corner| is_about(corner, leg.to))
        };
        let is_berthed = !self.corners.is_empty();
        (self.legs.start..self.legs.end - 1).filter(|_| is_berthed).find(is_off)
    }

    /// The corners that the way comes near to, or may when it keeps off others.
    fn corners_beside(&self, graph: &RouteGraph, legs: &[Leg], berth: f64) -> Vec<Corner> {
        let radius = graph[legs[0].room].radius.unwrap_or(0.0);
        // where tangents meet, they are farther from a corner than the arc by less than half of its radius
        let reach = 2.0 * berth + radius / 2.0;
        let mut ends: BTreeMap<u32, (DoorIndex, Point, (f64, f64))> = BTreeMap::new();
        let mut walls: Vec<Segment> = Vec::new();
        let mut walled: Vec<RoomIndex> = Vec::new();
        let mut walked = 0.0;
        for leg in legs {
            let line = Segment::new(leg.from, leg.to);
            let about = line.bounds().grown(reach);
            let within = (walked - reach, walked + line.length() + reach);
            let (mut rooms, mut next) = (vec![leg.room], 0);
            while let Some(&room) = rooms.get(next) {
                next += 1;
                if !walled.contains(&room) {
                    walled.push(room);
                    walls.extend(graph.walls_beside(room, about));
                }
                for exit in graph.exits.portals(room).iter().filter(|exit| graph.costs_nothing(exit.door)) {
                    let Some(door) = graph[exit.door].crossing.segment() else { continue };
                    if !door.bounds().grown(reach).overlaps(&line.bounds()) || door.gap(&line) > reach {
                        continue;
                    }
                    for (end, point) in graph.turning().mesh.ends(exit.door).into_iter().zip([door.a, door.b])
                    {
                        if graph.turning().bends_at(end) && line.distance(point) <= reach {
                            ends.entry(end).or_insert((exit.door, point, within));
                        }
                    }
                    if !rooms.contains(&exit.to) {
                        rooms.push(exit.to);
                    }
                }
            }
            walked += line.length();
        }
        let corner = |&(door, at, within): &(DoorIndex, Point, (f64, f64))| {
            self.corner(graph, (door, at), within, &walls, berth)
        };
        let mut corners: Vec<Corner> = ends.values().filter_map(corner).collect();
        corners.sort_by(|one, two| one.along.total_cmp(&two.along));
        corners
    }

    /// The corner of a wall at the end of a door; `None` where it is none, or there is no more room beside it.
    fn corner(
        &self,
        graph: &RouteGraph,
        (door, at): (DoorIndex, Point),
        within: (f64, f64),
        walls: &[Segment],
        mut berth: f64,
    ) -> Option<Corner> {
        let open: Vec<DoorIndex> = graph.turning().mesh.doors_at(door, at)?.to_vec();
        let mut rooms = graph.rooms_of(&open);
        rooms.retain(|&room| graph.is_entered(room));
        let wall = graph.wall_between(&rooms, at).filter(|wall| wall.turn > FLAT && wall.turn < PI - FLAT)?;
        let normals = Sector { from: wall.from + wall.turn + FRAC_PI_2, turn: PI - wall.turn };
        let mut around = tangents(Point::default(), normals, 1.0);
        let arc = graph.arc(door, at);
        let (centre, least) = arc.as_ref().map_or((at, 0.0), |arc| (arc.centre, arc.radius));
        let (along, foot, ahead) = self.beside(at, within);
        let is_left = ahead.cross(wall.middle()) > 0.0;
        if !is_left {
            around.reverse();
        }
        for end in [self.points[0], self.points[self.points.len() - 1]] {
            berth = berth.min(0.99 * end.distance(centre) - least);
        }
        let reach = least + 2.0 * berth;
        let about = Rect::around([centre]).grown(reach);
        let beside = |wall: &&Segment| about.overlaps(&wall.bounds()) && wall.distance(at) > SNAP_M;
        for wall in walls.iter().filter(beside) {
            let near = wall.nearest_to(centre);
            let side = ahead.cross(near - foot);
            if if is_left { side < -SNAP_M } else { side > SNAP_M } {
                berth = berth.min((near.distance(centre) - least) / 2.0);
            }
        }
        let corner =
            Corner { centre, least, berth, share: 1.0, around, is_left, along, is_active: false, arc };
        (berth > SNAP_M).then_some(corner)
    }

    /// Where the way is nearest to a point: how far along, where, and in which direction it leads there.
    ///
    /// # Arguments
    /// `within` is the stretch of the way that is looked at.
    fn beside(&self, p: Point, (from, to): (f64, f64)) -> (f64, Point, Point) {
        let last = self.points.len() - 2;
        let first = self.along.partition_point(|along| *along < from).saturating_sub(1).min(last);
        let mut best = (f64::INFINITY, first, self.points[first]);
        for leg in (first..=last).take_while(|&leg| leg == first || self.along[leg] <= to) {
            let foot = p.nearest_on(self.points[leg], self.points[leg + 1]);
            let off = foot.squared_distance(p);
            if off < best.0 {
                best = (off, leg, foot);
            }
        }
        let (_, leg, foot) = best;
        let ahead = Segment::new(self.points[leg], self.points[leg + 1]).direction();
        (self.along[leg] + self.points[leg].distance(foot), foot, ahead)
    }

    /// The bends of the tightest way about the corners that keep it in its place.
    pub fn pulled(&self) -> Vec<Bend> {
        let mut openings: Vec<(f64, Opening, usize)> = Vec::new();
        for (number, corner) in self.corners.iter().enumerate().filter(|(_, corner)| corner.is_active) {
            let reach = PI * corner.radius() + corner.berth;
            let within = (corner.along - reach, corner.along + reach);
            for outward in &corner.around {
                let at = corner.centre + *outward * corner.radius();
                let (along, foot, ahead) = self.beside(at, within);
                let side = ahead.cross(at - foot);
                let depth = if corner.is_left { side } else { -side };
                if depth > corner.berth {
                    continue;
                }
                let far = at + *outward * FAR_M;
                let (left, right) = if corner.is_left { (at, far) } else { (far, at) };
                openings.push((along, Opening { segment: Segment::new(at, far), left, right }, number));
            }
        }
        openings.sort_by(|one, two| one.0.total_cmp(&two.0));
        let (from, to) = (self.points[0], self.points[self.points.len() - 1]);
        let of: Vec<usize> = openings.iter().map(|(_, _, corner)| *corner).collect();
        let openings: Vec<Opening> = openings.into_iter().map(|(_, opening, _)| opening).collect();
        let points = taut(from, &openings, to);
        let mut bends = Vec::new();
        let mut before = from;
        for (place, corner) in of.into_iter().enumerate() {
            let (at, after) = (points[place], points.get(place + 1).copied().unwrap_or(to));
            if turns(before, at, after) {
                bends.push((at, corner));
                before = at;
            }
        }
        bends
    }

    /// The way over some bends, with both ends.
    pub fn line(&self, bends: &[Bend]) -> Vec<Point> {
        let mut line = vec![self.points[0]];
        line.extend(bends.iter().map(|(at, _)| *at));
        line.push(self.points[self.points.len() - 1]);
        line
    }
}
