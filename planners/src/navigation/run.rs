//! From a goal to the end of a mission, step by step, whoever finds the ways and whatever body is driven.

use super::judge::Judge;
use super::router::{Met, Router};
use super::stretch::{Stretch, with_room};
use super::{Ending, Event, Happening, Navigator};
use crate::body::Body;
use crate::geometry::Point;
use crate::pose::Pose;

/// A goal that a navigator is on its way to.
#[derive(Clone, Debug)]
pub struct Run {
    /// Where its way was closed.
    met: Vec<Met>,
    /// When it was asked last whether there is news, seconds.
    heeded_s: f64,
}

impl Run {
    /// Sets a navigator on its way to a goal.
    ///
    /// # Arguments
    /// `by_route` is whether a router finds the ways; otherwise the navigator does, over the network of the building that it knows.
    pub fn begin(navigator: &mut Navigator<'_>, goal: Point, by_route: bool, judge: &mut impl Judge) -> Self {
        if by_route {
            navigator.go_by_route(goal);
        } else {
            navigator.go(goal, judge);
        }
        Self { met: Vec::new(), heeded_s: navigator.time_s() }
    }

    /// One reading, one question to the judge, one step.
    pub fn step<B: Body>(
        &mut self,
        body: &mut B,
        navigator: &mut Navigator<'_>,
        router: Option<&mut dyn Router>,
        judge: &mut impl Judge,
    ) -> (Option<Ending>, Vec<Event>) {
        if let Some(router) = router {
            self.look_for_way(navigator, router);
        }
        let ending = navigator.step(body, judge);
        let events = navigator.take_events();
        for event in &events {
            match &event.what {
                Happening::WayClosed { at, is_known, seen, .. } => {
                    let heading = heading(event.pose, *at);
                    self.met.push(Met { at: *at, heading, is_known: *is_known, seen: seen.clone() });
                }
                Happening::Retried => self.met.clear(),
                _ => {}
            }
        }
        (ending, events)
    }

    /// Gives the navigator the way that it waits for, or another one where others changed what ways there are.
    fn look_for_way(&mut self, navigator: &mut Navigator<'_>, router: &mut dyn Router) {
        if let Some(to) = navigator.wants_way() {
            let way = self.way(navigator, router, to);
            navigator.take_way(way, self.met.is_empty());
        } else if navigator.time_s() >= self.heeded_s + navigator.settings().heed_s {
            self.heeded_s = navigator.time_s();
            if let Some(to) = navigator.heeds().filter(|_| router.has_news()) {
                let way = self.way(navigator, router, to);
                navigator.heed(way);
            }
        }
    }

    fn way(&self, navigator: &mut Navigator<'_>, router: &mut dyn Router, to: Point) -> Option<Vec<Stretch>> {
        let (from, stance) = (navigator.estimate().pose.at, navigator.stance());
        let way = router.way([from, to], stance, &self.met).map(|way| begun_in(stance, from, way));
        navigator.has_told(router.take_told());
        let met_there = navigator.surfaces();
        way.map(|way| with_room(way, navigator.stances(), &met_there, navigator.settings()))
    }
}

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
    let mut run = Run::begin(navigator, goal, router.is_some(), judge);
    loop {
        let router = router.as_mut().map(|router| &mut **router as &mut dyn Router);
        let (ending, events) = run.step(body, navigator, router, judge);
        watch(body, navigator, events);
        if let Some(ending) = ending {
            return ending;
        }
    }
}

/// A way that begins where the robot is, in the stance that it has.
fn begun_in(stance: usize, from: Point, mut way: Vec<Stretch>) -> Vec<Stretch> {
    let first = way.first().filter(|first| first.stance != stance);
    if let Some(to) = first.and_then(|first| first.points.first().copied()) {
        way.insert(0, Stretch { stance, points: vec![from, to] });
    }
    way
}

/// Towards what is in the way; where the robot looks, if it stands in it.
fn heading(pose: Pose, at: Point) -> f64 {
    let towards = at - pose.at;
    if towards.length() > 0.0 { towards.y.atan2(towards.x) } else { pose.heading }
}
