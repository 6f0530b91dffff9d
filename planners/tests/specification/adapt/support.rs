//! A judge and cells for the tests.

use std::f64::consts::PI;
use std::sync::Arc;

use adit_planners::adapt::{
    Adapt, Arm, ChangeFacts, Configuration, EdgeFacts, Judge, LandmarkFacts, Limit, Object, Plugins, Robot,
    RrtConnect, Settings, Shape, Straight, Strategy, Trust, Workcell,
};
use adit_planners::geometry::Point;
use adit_planners::pose::Pose;

/// Answers always the same: a strategy, the landmark whose frame is nearest, and that edges are to be verified.
pub struct Table(pub Strategy);

impl Judge for Table {
    fn strategy(&mut self, _: &ChangeFacts) -> Strategy {
        self.0
    }

    fn landmark(&mut self, facts: &LandmarkFacts<'_>) -> Option<f64> {
        Some(facts.distance_m)
    }

    fn trust(&mut self, _: &EdgeFacts) -> Trust {
        Trust::Verify
    }
}

/// A rectangle whose frame lies in its middle.
pub fn rect(name: &str, [x0, y0, x1, y1]: [f64; 4]) -> Object {
    let (w, h) = ((x1 - x0) / 2.0, (y1 - y0) / 2.0);
    let corners = [(-w, -h), (w, -h), (w, h), (-w, h)].map(|(x, y)| Point::new(x, y));
    Object {
        name: name.to_owned(),
        shape: Shape::new(corners.to_vec()).unwrap(),
        pose: Pose::new(x0 + w, y0 + h, 0.0),
        is_movable: true,
    }
}

/// The object, moved and turned.
pub fn moved(object: &Object, dx: f64, dy: f64, turn: f64) -> Object {
    let at = object.pose;
    Object { pose: Pose::new(at.at.x + dx, at.at.y + dy, at.heading + turn), ..object.clone() }
}

/// An arm of two links at the origin.
pub fn arm() -> Arc<dyn Robot> {
    let limits = vec![Limit { low: -PI, high: PI }, Limit { low: -2.7, high: 2.7 }];
    Arc::new(Arm::new(Point::default(), vec![1.0, 0.9], 0.03, limits).unwrap())
}

/// The planners that join straight motions and two trees.
pub fn plugins() -> Plugins {
    Plugins { reach: Arc::new(Straight), solve: Arc::new(RrtConnect { step: 0.6, samples: 2000 }) }
}

/// A learning planner for a robot among objects.
pub fn planner(robot: Arc<dyn Robot>, objects: Vec<Object>, start: &[f64]) -> Adapt {
    planner_with(robot, objects, start, Settings::default())
}

pub fn planner_with(robot: Arc<dyn Robot>, objects: Vec<Object>, start: &[f64], settings: Settings) -> Adapt {
    let cell = Workcell::new(robot, objects, 0.005).unwrap();
    Adapt::new(cell, plugins(), settings, start.to_vec())
}

/// The ends of the edges of a graph, by number.
pub fn edges(adapt: &Adapt) -> Vec<(u32, u32)> {
    adapt.experience().edges().map(|edge| (edge.ends.0.0, edge.ends.1.0)).collect()
}

/// Where the vertices of a graph are.
pub fn places(adapt: &Adapt) -> Vec<Configuration> {
    adapt.experience().vertices().map(|vertex| vertex.at.clone()).collect()
}
