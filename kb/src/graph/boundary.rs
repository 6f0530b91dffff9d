//! A door that is told to let nobody through, as a boundary for all layers: its segment, carried on at both ends as far as
//! some slimmer state finds room beside it.

use adit_planners::geometry::tolerance::SNAP_M;
use adit_planners::geometry::{Point, Segment};
use adit_planners::routes::{Closed, RouteDoor};

use super::SiteGraph;
use super::layers::Layer;

/// A boundary is carried on by so much at most, metres: more than half of what a robot is wide.
const FURTHEST_M: f64 = 3.0;

impl SiteGraph {
    /// The boundary that a door closes; `None` for a change of shape.
    pub(super) fn boundary(&self, door: &RouteDoor) -> Option<Closed> {
        let segment = door.crossing.segment()?;
        let own = self.index.layers.iter().position(|layer| layer.holds(door.room1));
        let ahead = segment.direction() * FURTHEST_M;
        let ends = [(segment.a, segment.a - ahead), (segment.b, segment.b + ahead)];
        let [a, b] = ends.map(|(end, far)| end.lerp(far, self.beside(own, end, far)));
        Some(Closed { door: door.door, segment: Segment::new(a, b) })
    }

    /// The share of a way, from its beginning, that lies in rooms of other layers and in none of a door's own.
    fn beside(&self, own: Option<usize>, from: Point, to: Point) -> f64 {
        let start = SNAP_M / FURTHEST_M;
        let inside = |layer: &Layer| -> Vec<(f64, f64)> {
            let rooms = layer.meeting(Segment::new(from, to).bounds());
            rooms.filter_map(|room| self.graph[room].outline.shares(from, to)).collect()
        };
        let (mut limit, mut others) = (1.0_f64, Vec::new());
        for (number, layer) in self.index.layers.iter().enumerate() {
            if Some(number) == own {
                let begins = inside(layer).into_iter().filter(|(_, ends)| *ends > start);
                limit = begins.map(|(begins, _)| begins).fold(limit, f64::min);
            } else {
                others.extend(inside(layer));
            }
        }
        others.sort_by(|one, two| one.0.total_cmp(&two.0));
        let reach = others.into_iter().fold(0.0_f64, |reach, (begins, ends)| {
            if begins <= reach + start { reach.max(ends) } else { reach }
        });
        reach.min(limit)
    }
}
