//! A door or doorway that lets nobody through, as a boundary for all layers: its segment, carried on from both ends into the
//! walls, as far as some slimmer state finds room there.

use adit_planners::geometry::tolerance::SNAP_M;
use adit_planners::geometry::{Point, Sector, Segment};
use adit_planners::routes::{DoorIndex, RouteDoor};

use super::SiteGraph;
use super::layers::Layer;

/// A boundary is carried on by so much at most, metres: more than half of what a robot is wide.
const FURTHEST_M: f64 = 3.0;

/// Walls that take less than this of the ground about a point, radians, are none.
const SLIGHT: f64 = 1e-3;

/// A doorway ends at walls, to a few cells of an image: by so much at most it is carried on, metres.
const INTO_WALL_M: f64 = 0.5;

/// What closes a boundary.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Closer {
    /// A door that is told to let nobody through.
    Door(DoorIndex),
    /// A doorway, by its number.
    Doorway(i64),
    /// What a fact says, by its place among the [lines](super::Building::lines).
    Line(usize),
    /// An area that one goes through in one direction, by its place among [those](super::Building::one_ways).
    OneWay(usize),
}

impl SiteGraph {
    /// The boundary of a doorway.
    pub(super) fn of_doorway(&self, segment: Segment) -> Vec<Segment> {
        let along = segment.direction() * INTO_WALL_M;
        let on = [(segment.b, segment.b + along), (segment.a, segment.a - along)].map(|(end, far)| {
            let share = self.beside(None, end, far);
            end.lerp(far, share)
        });
        vec![Segment::new(on[1], on[0])]
    }

    /// The boundary that a door closes; nothing for a change of shape.
    pub(super) fn of_door(&self, door: &RouteDoor) -> Vec<Segment> {
        let Some(segment) = door.crossing.segment() else { return Vec::new() };
        let own = self.index.layers.iter().position(|layer| layer.holds(door.room1));
        let on = [segment.a, segment.b].into_iter().filter_map(|end| {
            let far = end + self.led_into_wall(&self.index.layers[own?], end)? * FURTHEST_M;
            let share = self.beside(own, end, far);
            (share > 0.0).then(|| Segment::new(end, end.lerp(far, share)))
        });
        on.chain([segment]).collect()
    }

    /// The direction from a point on the rim of a layer into the middle of what is solid there; `None` where nothing is.
    fn led_into_wall(&self, layer: &Layer, at: Point) -> Option<Point> {
        let near = layer.meeting(Segment::new(at, at).bounds().grown(SNAP_M));
        let wall = Sector::widest_gap(near.filter_map(|room| self.graph[room].outline.sector_at(at)))?;
        (wall.turn > SLIGHT).then(|| wall.middle())
    }

    /// The share of a way, from its beginning, that lies in rooms of other layers and in none of a door's own.
    fn beside(&self, own: Option<usize>, from: Point, to: Point) -> f64 {
        let start = SNAP_M / from.distance(to);
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
        let reach =
            others.into_iter().fold(
                0.0_f64,
                |reach, (begins, ends)| {
                    if begins <= reach + start { reach.max(ends) } else { reach }
                },
            );
        reach.min(limit)
    }
}
