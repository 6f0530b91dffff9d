//! From a goal to the end of a mission, step by step, whoever finds the ways and whatever body is driven.

use super::judge::Judge;
use super::router::{Met, Router};
use super::stretch::{Stretch, with_room};
use super::{Ending, Event, Happening, Navigator};
use crate::body::Body;
use crate::geometry::Point;
use crate::pose::Pose;

/// Has a navigator drive a body to a goal.
///
/// # Arguments
/// `router` finds the ways; without one the navigator does, over the network of the building that it knows. `watch` is called
/// after each step, with what happened in it.
pub fn run<B: Body>(
    body: &mut B,
    navigator: &mut Navigator<'_>,
    goal: Point,
    mut router: Option<&mut dyn Router>,
    judge: &mut impl Judge,
    mut watch: impl FnMut(&B, &Navigator<'_>, Vec<Event>),
) -> Ending {
    match router {
        Some(_) => navigator.go_by_route(goal),
        None => navigator.go(goal, judge),
    }
    let mut met: Vec<Met> = Vec::new();
    loop {
        if let (Some(to), Some(router)) = (navigator.wants_way(), router.as_deref_mut()) {
            let (from, shape) = (navigator.estimate().pose.at, navigator.shape());
            let way = router.way([from, to], shape, &met).map(|way| begun_in(shape, from, way));
            let met_there = navigator.surfaces();
            let way = way.map(|way| with_room(way, navigator.shapes(), &met_there, navigator.settings()));
            navigator.take_way(way, met.is_empty());
        }
        let ending = navigator.step(body, judge);
        let events = navigator.take_events();
        for event in &events {
            match &event.what {
                Happening::WayClosed { at, is_known, seen, .. } => {
                    let heading = heading(event.pose, *at);
                    met.push(Met { at: *at, heading, is_known: *is_known, seen: seen.clone() });
                }
                Happening::Retried => met.clear(),
                _ => {}
            }
        }
        watch(body, navigator, events);
        if let Some(ending) = ending {
            return ending;
        }
    }
}

/// A way that begins where the robot is, in the shape that it has.
fn begun_in(shape: usize, from: Point, mut way: Vec<Stretch>) -> Vec<Stretch> {
    let first = way.first().filter(|first| first.shape != shape);
    if let Some(to) = first.and_then(|first| first.points.first().copied()) {
        way.insert(0, Stretch { shape, points: vec![from, to] });
    }
    way
}

/// Towards what is in the way; where the robot looks, if it stands in it.
fn heading(pose: Pose, at: Point) -> f64 {
    let towards = at - pose.at;
    if towards.length() > 0.0 { towards.y.atan2(towards.x) } else { pose.heading }
}
