//! How missions went, whoever knows where the robot is.

use super::{Ending, Event, Happening, Navigator};
use crate::geometry::Point;

/// How a mission went. Where the robot was is where it really was, if somebody knows that; else it is by its own account.
#[derive(Clone, Debug, PartialEq)]
pub struct Trip {
    pub ending: Ending,
    /// The shape in which it ended.
    pub shape: usize,
    /// Metres that it went, by shape; by the count of its wheels where nobody knows better.
    pub metres: Vec<f64>,
    /// Of these, those that it went without setting off or coming to a stand, by shape.
    pub paces: Vec<Pace>,
    /// Changes of shape, in order: from which into which; of one that is longer than wide into itself where it turned to the next
    /// facing.
    pub changes: Vec<(usize, usize)>,
    /// Times that a way was closed and another one looked for.
    pub replans: u32,
    pub detours: u32,
    /// Seconds by the body's clock.
    pub seconds: f64,
    /// Touches that the skirt felt; of a simulated robot those to which it went itself.
    pub touches: usize,
    /// Where it was, in which shape, whenever it had gone on a little.
    pub track: Vec<(Point, usize)>,
    /// The stance in which it is now, where that is known.
    pub(super) stance: Option<usize>,
}

/// How fast a robot went.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Pace {
    pub metres: f64,
    pub seconds: f64,
}

/// From one reading to the next.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Advance {
    pub metres: f64,
    pub seconds: f64,
    /// Whether the command was still being carried out at its end.
    pub is_under_way: bool,
}

/// The track has a point each so many metres.
const TRACK_M: f64 = 0.25;

impl Trip {
    /// Of a robot in one of so many shapes, of which nothing was driven yet.
    pub fn begun(at: Point, shape: usize, shapes: usize) -> Self {
        Self {
            ending: Ending::OutOfPatience,
            shape,
            metres: vec![0.0; shapes],
            paces: vec![Pace::default(); shapes],
            changes: Vec::new(),
            replans: 0,
            detours: 0,
            seconds: 0.0,
            touches: 0,
            track: vec![(at, shape)],
            stance: None,
        }
    }

    /// Takes note of a step to where the robot is now, in the shape in which it is now, and of what happened.
    ///
    /// # Arguments
    /// `stance` is that in which it stands, where that is known.
    pub fn note(
        &mut self,
        step: &Advance,
        (at, now): (Point, usize),
        stance: Option<usize>,
        events: &[Event],
    ) {
        self.metres[self.shape] += step.metres;
        if step.is_under_way && step.metres > 0.0 {
            let pace = &mut self.paces[self.shape];
            *pace = Pace { metres: pace.metres + step.metres, seconds: pace.seconds + step.seconds };
        }
        let is_changed = now != self.shape;
        let is_turned = self.stance.is_some() && stance != self.stance;
        if is_changed || is_turned {
            self.changes.push((self.shape, now));
        }
        (self.shape, self.stance) = (now, stance);
        if is_changed || self.track.last().is_none_or(|(last, _)| last.distance(at) >= TRACK_M) {
            self.track.push((at, now));
        }
        for event in events {
            self.detours += u32::from(matches!(event.what, Happening::Detour { .. }));
            self.touches += usize::from(matches!(event.what, Happening::Contact { .. }));
        }
    }

    pub(super) fn ended(self, ending: Ending, navigator: &Navigator<'_>) -> Self {
        Self { ending, replans: navigator.replans(), seconds: navigator.time_s(), ..self }
    }

    /// Metres that it went.
    pub fn path_m(&self) -> f64 {
        self.metres.iter().sum()
    }
}
