//! What the navigator knows of the building, and of obstacles in it.

use std::f64::consts::{FRAC_PI_2, PI};

use super::Settings;
use crate::floor_plan::{Disc, FloorPlan, Network};
use crate::geometry::{Point, Segment};
use crate::local_model::{LocalModel, ModelSegment, SegmentId, Source};
use crate::pose::wrapped;
use crate::rim::Rim;

/// A building that is known before a mission: the global model and the network of places.
///
/// It is so for a robot in one stance: in a shape, and, where that is longer than wide, at one of its facings.
#[derive(Clone, Debug)]
pub struct Building {
    /// The shape, by number.
    pub shape: usize,
    /// Radians; half a turn shows the robot the same. `None` for a shape that turns on the spot.
    pub facing: Option<f64>,
    /// Of the robot, as it stands there.
    pub rim: Rim,
    pub network: Network,
    /// The surfaces of the global model.
    pub walls: Vec<Segment>,
    /// What the robot does not fit beneath; no sonar hears it.
    pub overhead: Vec<Segment>,
    /// Where the middle of the robot may be, in convex pieces, if that is known beside the network.
    pub floor: Vec<Vec<Point>>,
    /// What nobody may cross, though nothing is there. A way that is given to the robot keeps off it; its detours do, too.
    pub closed: Vec<Segment>,
}

impl Building {
    /// The building of a floor plan with its network.
    pub fn new(plan: &FloorPlan, network: Network) -> Self {
        Self::of_walls(network, plan.barriers().into_iter().map(Segment::from).collect())
    }

    /// Walls, and nothing that a sonar does not hear.
    pub fn of_walls(network: Network, walls: Vec<Segment>) -> Self {
        let rim = Rim::disc(network.disc.radius);
        let (overhead, floor, closed) = (Vec::new(), Vec::new(), Vec::new());
        Self { shape: 0, facing: None, rim, network, walls, overhead, floor, closed }
    }

    /// The same for a robot in another stance, whose rim is told as it is at heading 0.
    #[must_use]
    pub fn in_stance(self, shape: usize, rim: &Rim, facing: Option<f64>) -> Self {
        Self { shape, facing, rim: rim.turned(facing.unwrap_or(0.0)), ..self }
    }

    /// By how much a robot is off its facing, radians; 0 for one that turns on the spot.
    pub fn off_facing(&self, heading: f64) -> f64 {
        self.facing.map_or(0.0, |facing| {
            let off = wrapped(facing - heading);
            if off.abs() > FRAC_PI_2 { wrapped(off + PI) } else { off }
        })
    }

    /// A building of which nothing is known, for a robot.
    pub fn unknown(disc: Disc) -> Self {
        Self::of_walls(Network::none(disc), Vec::new())
    }
}

/// How many shapes the robot has that stands in a building in these stances.
pub(super) fn shapes(stances: &[Building]) -> usize {
    stances.iter().map(|stance| stance.shape + 1).max().unwrap_or(0)
}

/// Obstacles that the local model has dropped because they are far.
#[derive(Clone, Debug, Default)]
pub(super) struct Memory {
    lately: Vec<(SegmentId, Segment, u8)>,
    kept: Vec<(Segment, u8)>,
}

impl Memory {
    /// Takes note of the model after an update.
    pub fn note(&mut self, model: &LocalModel, walls: &[Segment], settings: &Settings) {
        let at = model.estimate().pose.at;
        let now: Vec<(SegmentId, Segment, u8)> = obstacles(model, settings)
            .map(|segment| (segment.id, segment.line, segment.confidence))
            .collect();
        for (id, line, confidence) in std::mem::take(&mut self.lately) {
            let is_gone = now.binary_search_by_key(&id, |known| known.0).is_err();
            if is_gone && line.distance(at) > settings.memory_m {
                self.kept.push((line, confidence));
            }
        }
        self.lately = now;
        // What is near and in sight is the model's: it is seen again if it is still there.
        self.kept.retain(|(line, _)| {
            line.distance(at) > settings.memory_m / 2.0 || !is_in_sight(at, line.middle(), walls)
        });
    }

    /// Surfaces of obstacles of at least a confidence.
    ///
    /// # Arguments
    /// `spacing` is the angle between beams, radians: what is seen to end may go on between two of them.
    pub fn obstacles(
        &self,
        (model, spacing): (&LocalModel, f64),
        confidence: u8,
        settings: &Settings,
    ) -> Vec<Segment> {
        let at = model.estimate().pose.at;
        let seen = obstacles(model, settings).filter(|segment| segment.confidence >= confidence);
        let kept = self.kept.iter().filter(|(_, known)| *known >= confidence);
        let seen = seen.map(|segment| lengthened(segment, at, spacing, settings.corner_m));
        seen.chain(kept.map(|(line, _)| *line)).collect()
    }
}

/// Surfaces of the model that the building does not have, and that stand.
fn obstacles<'m>(model: &'m LocalModel, settings: &Settings) -> impl Iterator<Item = &'m ModelSegment> {
    let firm = settings.firm_confidence;
    let unknown = model.segments().iter().filter(|segment| segment.source != Source::RECALLED);
    unknown.filter(move |segment| !is_moving(model, segment, firm))
}

/// A surface as far as it may go on unseen where it does not join another one, up to so many metres.
fn lengthened(segment: &ModelSegment, from: Point, spacing: f64, most_m: f64) -> Segment {
    let line = segment.line;
    let along = line.direction();
    let beyond = |end: Point| {
        let beam = end - from;
        let range_m = beam.length();
        // a beam that grazes a surface leaves more of it unseen
        let across = (beam.cross(along) / range_m.max(f64::MIN_POSITIVE)).abs().max(spacing);
        (range_m * spacing / across).min(most_m)
    };
    let [a, b] = [line.a, line.b].map(beyond);
    let more = |metres: f64, is_joined: bool| along * if is_joined { 0.0 } else { metres };
    Segment::new(line.a - more(a, segment.joins[0].is_some()), line.b + more(b, segment.joins[1].is_some()))
}

pub(super) fn moving<'m>(model: &'m LocalModel, settings: &Settings) -> impl Iterator<Item = Segment> + 'm {
    let firm = settings.firm_confidence;
    let moving = model.segments().iter().filter(move |segment| is_moving(model, segment, firm));
    moving.map(|segment| segment.line)
}

fn is_moving(model: &LocalModel, segment: &ModelSegment, firm: u8) -> bool {
    segment.confidence < firm
        && model.objects().iter().any(|object| Some(object.id) == segment.object && object.is_moving)
}

fn is_in_sight(from: Point, to: Point, walls: &[Segment]) -> bool {
    let far = from.distance(to);
    let towards = Segment::new(from, to).direction();
    !walls.iter().any(|wall| wall.hit(from, towards).is_some_and(|(range, _)| range < far - 0.2))
}
