//! Missions of a body of which nobody knows where it really is, and how they went by its own account.

use super::judge::Judge;
use super::known::Building;
use super::log::Log;
use super::mission::{Entry, Outfit};
use super::router::Router;
use super::run::run;
use super::{Ending, Happening, Navigator};
use crate::body::Body;
use crate::geometry::Point;
use crate::pose::Pose;

/// How a mission went, as the body and its navigator have it: where the robot really was is not known.
#[derive(Clone, Debug, PartialEq)]
pub struct Trip {
    pub ending: Ending,
    /// The shape in which it ended.
    pub shape: usize,
    /// Metres that the wheels counted, by shape.
    pub metres: Vec<f64>,
    /// Changes of shape, in order: from which into which.
    pub changes: Vec<(usize, usize)>,
    /// Times that a way was closed and another one looked for.
    pub replans: u32,
    pub detours: u32,
    /// Seconds by the body's clock.
    pub seconds: f64,
    /// Touches that the skirt felt.
    pub touches: usize,
    /// Where it thought that it was, in which shape, whenever it had gone on a little.
    pub track: Vec<(Point, usize)>,
}

/// Has a body driven from where it is said to stand to a goal.
///
/// # Arguments
/// `buildings` is the building as it is known, for each shape of the robot, with the number of the shape in which it is. `router`
/// finds the ways, where somebody else than the navigator does. `journal` gets every event.
pub fn trip<B: Body>(
    body: &mut B,
    (buildings, shape): (&[Building], usize),
    (start, goal): (Pose, Point),
    outfit: &Outfit,
    router: Option<&mut dyn Router>,
    judge: &mut impl Judge,
    mut journal: impl FnMut(Entry),
) -> Trip {
    let mut navigator =
        Navigator::of_shapes((buildings, shape), outfit.model, outfit.navigation, outfit.estimate(start));
    let mut log = Log::begun(start.at, shape, buildings.len());
    let (mut before, mut detours, mut touches) = (navigator.odometry(), 0, 0);
    let ending = run(body, &mut navigator, goal, router, judge, |_, navigator, events| {
        let counted = navigator.odometry();
        log.note(before.at.distance(counted.at), navigator.estimate().pose.at, navigator.shape());
        before = counted;
        for event in events {
            detours += u32::from(matches!(event.what, Happening::Detour { .. }));
            touches += usize::from(matches!(event.what, Happening::Contact { .. }));
            journal(Entry { event, truth: None });
        }
    });
    let Log { metres, changes, track, .. } = log;
    Trip {
        ending,
        shape: navigator.shape(),
        metres,
        changes,
        replans: navigator.replans(),
        detours,
        seconds: navigator.time_s(),
        touches,
        track,
    }
}
