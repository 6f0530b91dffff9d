//! Missions of a body of which nobody knows where it really is.

use super::Navigator;
use super::judge::Judge;
use super::known::{Building, shapes};
use super::mission::{Entry, Outfit};
use super::router::Router;
use super::run::run;
use super::trip::{Advance, Trip};
use crate::body::Body;
use crate::geometry::Point;
use crate::pose::Pose;

/// Has a body driven from where it is said to stand to a goal.
///
/// # Arguments
/// `buildings` is the building as it is known, for each stance of the robot, with the number of the stance in which it is. `router`
/// finds the ways, where somebody else than the navigator does. `journal` gets every event.
pub fn trip<B: Body>(
    body: &mut B,
    (buildings, stance): (&[Building], usize),
    (start, goal): (Pose, Point),
    outfit: &Outfit,
    router: Option<&mut dyn Router>,
    judge: &mut impl Judge,
    mut journal: impl FnMut(Entry),
) -> Trip {
    let mut navigator =
        Navigator::of_stances((buildings, stance), outfit.model, outfit.navigation, outfit.estimate(start));
    let mut trip = Trip::begun(start.at, buildings[stance].shape, shapes(buildings));
    let (mut before, mut since_s) = (navigator.odometry(), None);
    let ending = run(body, &mut navigator, goal, router, judge, |_, navigator, events| {
        let (counted, now_s) = (navigator.odometry(), navigator.time_s());
        let step = Advance {
            metres: before.at.distance(counted.at),
            seconds: now_s - since_s.unwrap_or(now_s),
            is_under_way: navigator.is_busy() && since_s.is_some(),
        };
        let now = (navigator.estimate().pose.at, navigator.shape());
        trip.note(&step, now, Some(navigator.stance()), &events);
        (before, since_s) = (counted, Some(now_s));
        for event in events {
            journal(Entry { event, truth: None });
        }
    });
    trip.ended(ending, &navigator)
}
