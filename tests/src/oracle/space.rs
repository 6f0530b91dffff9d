//! Configuration space: where each state of a robot fits.

use adit_planners::geometry::{Point, Rect};
use adit_planners::world::World;

use super::body::Body;
use super::distances::within;
use super::walls::Walls;

/// What decimal fractions lose in binary, metres.
pub const ROUNDING: f64 = 1e-9;

/// Where the states of a robot fit in a world.
pub struct Space {
    walls: Walls,
    body: Body,
    /// Kept free by each state, metres.
    keep: Vec<f64>,
    areas: Vec<(Rect, f64)>,
}

impl Space {
    /// The free space of every state. Each of them keeps `margin` metres more than it has to: with 0 this is the
    /// true free space.
    pub fn new(world: &World, body: &Body, margin: f64) -> Self {
        let keep: Vec<f64> =
            body.states.iter().map(|state| state.width / 2.0 + world.clearance + margin).collect();
        let reach = keep.iter().copied().fold(0.0, f64::max) + 0.3;
        Self { walls: Walls::new(world, reach), body: body.clone(), keep, areas: Vec::new() }
    }

    /// The same with areas, that do not overlap, in which a metre weighs so many times as much.
    #[must_use]
    pub fn with_areas(mut self, areas: &[(Rect, f64)]) -> Self {
        self.areas = areas.to_vec();
        self
    }

    /// The least that a metre's weight is multiplied by anywhere.
    pub fn lightest(&self) -> f64 {
        self.areas.iter().map(|area| area.1).fold(1.0, f64::min)
    }

    /// What the straight way from `a` to `b` weighs in a state.
    pub fn weigh(&self, state: usize, a: Point, b: Point) -> f64 {
        let more = self.areas.iter().map(|(rect, factor)| (factor - 1.0) * within(a, b, rect));
        (a.distance(b) + more.sum::<f64>()) * self.body.states[state].hardness
    }

    /// The robot.
    pub fn body(&self) -> &Body {
        &self.body
    }

    /// The environment.
    pub fn bounds(&self) -> Rect {
        self.walls.bounds()
    }

    /// By how much a state fits on the straight way from `a` to `b`, metres; less than 0 where it does not.
    pub fn spare(&self, state: usize, a: Point, b: Point) -> f64 {
        let height = self.body.states[state].height;
        self.walls.near(a, b, 0.0).min(self.walls.near_bridges(a, b, height)) - self.keep[state]
    }

    /// By how much each state fits at a point.
    pub fn spares_at(&self, p: Point) -> impl Iterator<Item = f64> {
        let to_walls = self.walls.near(p, p, 0.0);
        (0..self.keep.len()).map(move |state| {
            let to_bridges = self.walls.near_bridges(p, p, self.body.states[state].height);
            to_walls.min(to_bridges) - self.keep[state]
        })
    }

    /// Whether a state fits all along the straight way.
    pub fn is_free(&self, state: usize, a: Point, b: Point) -> bool {
        let keep = self.keep[state] - ROUNDING;
        self.walls.near_bridges(a, b, self.body.states[state].height) >= keep
            && self.walls.near(a, b, keep) >= keep
    }

    /// Whether no state is near to its limit here, and some state fits: where the answer does not hang on a cell.
    pub fn is_plain(&self, p: Point, margin: f64) -> bool {
        let spares: Vec<f64> = self.spares_at(p).collect();
        spares.iter().all(|spare| spare.abs() > margin) && spares.iter().any(|spare| *spare > 0.0)
    }
}
