//! One way to cut a face: cuts are laid in an order, each from a corner to the first wall or cut that it meets.

use std::f64::consts::PI;

use super::face::{ANGLE, Face};
use super::planar::{Edge, Planar};
use crate::geometry::Point;
use crate::geometry::tolerance::ROUNDING_M;

/// What is cut next. A corner is one by its place in the face's list, a sight by its place in the corner's list.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Cut {
    /// On from the wall (or earlier cut) where the free space of a corner begins, counterclockwise.
    First {
        corner: u32,
    },
    /// On from the wall where it ends.
    Last {
        corner: u32,
    },
    Towards {
        corner: u32,
        sight: u32,
    },
    /// Along a sight to both sides, also where nothing has to be resolved.
    Through {
        corner: u32,
        sight: u32,
    },
}

impl Cut {
    pub fn corner(self) -> u32 {
        match self {
            Self::First { corner }
            | Self::Last { corner }
            | Self::Towards { corner, .. }
            | Self::Through { corner, .. } => corner,
        }
    }
}

/// A face with its cuts.
pub(super) struct Layout<'h> {
    face: &'h Face,
    pub points: Vec<Point>,
    /// Cuts by their end nodes; behind the face's sides in the numbering of lines.
    pub cuts: Vec<[u32; 2]>,
    /// Ends of cuts on lines: line, distance from its first end, node.
    pub stops: Vec<(u32, f64, u32)>,
    /// For each corner the directions at it, by angle.
    spokes: Vec<Vec<(f64, Point)>>,
    /// For each of the face's points the corner that it is.
    corner_at: Vec<Option<u32>>,
}

impl<'h> Layout<'h> {
    /// Cuts in an order; what is not resolved then is cut along its first wall.
    pub fn new(face: &'h Face, order: &[Cut]) -> Self {
        let corner_at = face.corner_at();
        let spokes = face.corners.iter().map(|corner| corner.bounds.to_vec()).collect();
        let (cuts, stops) = (Vec::new(), Vec::new());
        let mut layout = Self { face, points: face.points.clone(), cuts, stops, spokes, corner_at };
        let rest = (0..face.corners.len() as u32).map(|corner| Cut::First { corner });
        for cut in order.iter().copied().chain(rest) {
            layout.carry_out(cut);
        }
        layout
    }

    fn carry_out(&mut self, cut: Cut) {
        let corner = cut.corner();
        let onward = |spoke: (f64, Point)| Point::new(-spoke.1.x, -spoke.1.y);
        let sight = |sight: u32| self.face.corners[corner as usize].sights[sight as usize].direction;
        match (cut, self.gap(corner)) {
            (Cut::First { .. }, Some([first, _])) => self.cut(corner, onward(first)),
            (Cut::Last { .. }, Some([_, last])) => self.cut(corner, onward(last)),
            (Cut::Towards { sight: number, .. }, Some(_)) => self.cut(corner, sight(number)),
            (Cut::Through { sight: number, .. }, _) => {
                let there = sight(number);
                self.cut(corner, there);
                self.cut(corner, -there);
            }
            (_, None) => {}
        }
    }

    /// The directions about a corner between which there is more than half a turn.
    fn gap(&self, corner: u32) -> Option<[(f64, Point); 2]> {
        let spokes = &self.spokes[corner as usize];
        spokes.windows(2).find(|gap| gap[1].0 - gap[0].0 > PI + ANGLE).map(|gap| [gap[0], gap[1]])
    }

    /// Cuts from a corner to what is met first; nothing where that leads into a wall or along an earlier cut.
    fn cut(&mut self, corner: u32, direction: Point) {
        let Some(angle) = self.face.corners[corner as usize].place(direction) else { return };
        if self.spokes[corner as usize].iter().any(|spoke| (spoke.0 - angle).abs() <= ANGLE) {
            return;
        }
        let from = self.face.corners[corner as usize].node;
        let to = self.first_hit(from, direction);
        let length = direction.length();
        let there = Point::new(direction.x / length, direction.y / length);
        self.add_spoke(corner, there);
        if let Some(other) = self.corner_at.get(to as usize).copied().flatten() {
            self.add_spoke(other, -there);
        }
        self.cuts.push([from, to]);
    }

    fn add_spoke(&mut self, corner: u32, direction: Point) {
        if let Some(angle) = self.face.corners[corner as usize].place(direction) {
            let spokes = &mut self.spokes[corner as usize];
            let place = spokes.partition_point(|spoke| spoke.0 < angle);
            spokes.insert(place, (angle, direction));
        }
    }

    /// The node at which a ray from a node first meets something; made where it meets the inside of a line.
    fn first_hit(&mut self, from: u32, direction: Point) -> u32 {
        let start = self.points[from as usize];
        let length = direction.length();
        let along = Point::new(direction.x / length, direction.y / length);
        let aside = |p: Point| along.cross(p - start);
        let ahead = |p: Point| along.dot(p - start);
        let (mut nearest, mut node) = (f64::INFINITY, None);
        for (number, &p) in (0..).zip(&self.points) {
            let distance = ahead(p);
            if number != from && distance > ROUNDING_M && distance < nearest && aside(p).abs() <= ROUNDING_M {
                (nearest, node) = (distance, Some(number));
            }
        }
        let mut line_hit = None;
        let sides = self.face.sides.iter().map(|side| side.ends);
        for (line, ends) in (0..).zip(sides.chain(self.cuts.iter().copied())) {
            if ends.contains(&from) {
                continue;
            }
            let [a, b] = ends.map(|n| self.points[n as usize]);
            let (left, right) = (aside(a), aside(b));
            if left * right < 0.0 && left.abs() > ROUNDING_M && right.abs() > ROUNDING_M {
                let share = left / (left - right);
                let at = a.lerp(b, share);
                let distance = ahead(at);
                if distance > ROUNDING_M && distance < nearest - ROUNDING_M {
                    (nearest, node, line_hit) = (distance, None, Some((line, a.distance(at), at)));
                }
            }
        }
        if let Some(node) = node {
            return node;
        }
        let (line, distance, at) = line_hit.expect("a face is closed: every ray from a corner meets a wall");
        let made = self.points.len() as u32;
        self.points.push(at);
        self.stops.push((line, distance, made));
        made
    }

    /// The areas of the regions, the largest first.
    pub fn areas(&self) -> Vec<f64> {
        let mut stops = self.stops.clone();
        stops.sort_unstable_by(|a, b| a.0.cmp(&b.0).then(a.1.total_cmp(&b.1)));
        let (mut edges, mut free) = (Vec::new(), Vec::new());
        let mut next = 0;
        let lines = self.face.sides.iter().map(|side| (side.ends, side.direction, side.free));
        let cuts = self
            .cuts
            .iter()
            .map(|&[a, b]| (([a, b]), Edge::between(&self.points, a, b).direction, [true; 2]));
        for (line, (ends, direction, sides)) in (0..).zip(lines.chain(cuts)) {
            let mut last = ends[0];
            while next < stops.len() && stops[next].0 == line {
                edges.push(Edge { ends: [last, stops[next].2], direction });
                free.extend(sides);
                last = stops[next].2;
                next += 1;
            }
            edges.push(Edge { ends: [last, ends[1]], direction });
            free.extend(sides);
        }
        let planar = Planar::new(self.points.clone(), edges);
        let mut areas: Vec<f64> = planar
            .cycles
            .iter()
            .filter(|cycle| free[cycle.first as usize] && cycle.area > 0.0)
            .map(|cycle| cycle.area)
            .collect();
        areas.sort_unstable_by(|a, b| b.total_cmp(a));
        areas
    }
}
