//! The robot among its objects, what is known of them, and the count of what that cost.

use std::collections::BTreeSet;
use std::sync::Arc;

use super::clearance::{Clearance, Known};
use super::object::Object;
use super::robot::{Link, Links, Robot, wider};
use crate::geometry::tolerance::{ROUNDING_M, SNAP_M};
use crate::geometry::{Point, Rect, Segment};
use crate::pose::Frame;

/// Number of the state of a cell: 0 at first, one more with each change.
pub type Revision = u32;

/// An object as the cell has it now.
#[derive(Clone, Debug)]
pub struct Placed {
    pub object: Object,
    /// Since when it is where it is, and as it is.
    pub since: Revision,
    pub times_moved: u32,
    pub(super) frame: Frame,
    pub(super) known: Known,
}

/// How near an object counts as touched, metres, where nothing else is said.
pub const TOUCHING_M: f64 = 0.005;

/// The share of that distance that is kept all along a motion. The rest is what an evaluation teaches of room about the
/// robot where it is only just free: without any, no motion along an object could be known to be free.
const KEPT: f64 = 0.5;

/// A robot and the objects about it. Plug-ins see it through a [`Probe`](super::Probe) only.
#[derive(Clone, Debug)]
pub struct Workcell {
    robot: Arc<dyn Robot>,
    pub(super) placed: Vec<Placed>,
    pub(super) revision: Revision,
    touching_m: f64,
    evaluations: u64,
    learned: Vec<(String, Clearance)>,
    last_touched: Option<usize>,
}

/// Why objects are no cell.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum WorkcellError {
    /// What is attached to a name has to find one object.
    #[error("two objects are called {0}")]
    SameName(String),
    #[error("object {0} is not at a finite pose")]
    NotFinite(String),
    #[error("object {0} is more than 1000 km away")]
    TooFar(String),
}

impl Workcell {
    /// A cell of which nothing is known yet. What comes nearer to an object than `touching_m` metres counts as touching it; that is at least a micrometre.
    pub fn new(robot: Arc<dyn Robot>, objects: Vec<Object>, touching_m: f64) -> Result<Self, WorkcellError> {
        let placed = objects.into_iter().map(|object| Placed::new(object, 0)).collect();
        Self::resume(robot, placed, 0, touching_m)
    }

    /// A cell that goes on where another one was; what was known of its objects is to be [recalled](Self::recall).
    pub fn resume(
        robot: Arc<dyn Robot>,
        placed: Vec<Placed>,
        revision: Revision,
        touching_m: f64,
    ) -> Result<Self, WorkcellError> {
        check(placed.iter().map(|placed| &placed.object))?;
        let touching_m = touching_m.max(SNAP_M);
        Ok(Self {
            robot,
            placed,
            revision,
            touching_m,
            evaluations: 0,
            learned: Vec::new(),
            last_touched: None,
        })
    }

    pub fn robot(&self) -> &Arc<dyn Robot> {
        &self.robot
    }

    /// The objects as they are now, in the order in which they were given.
    pub fn placed(&self) -> &[Placed] {
        &self.placed
    }

    pub fn revision(&self) -> Revision {
        self.revision
    }

    pub fn touching_m(&self) -> f64 {
        self.touching_m
    }

    /// What is kept between the robot and an object all along a motion, metres.
    pub(super) fn kept_m(&self) -> f64 {
        self.touching_m * KEPT
    }

    /// The body of the robot at a configuration, wider by what is kept.
    pub(super) fn links(&self, at: &[f64]) -> Links {
        wider(self.robot.links(at), self.kept_m())
    }

    /// How many configurations were evaluated against one object so far.
    pub fn evaluations(&self) -> u64 {
        self.evaluations
    }

    /// What is known of the objects, by their names.
    pub fn clearances(&self) -> impl Iterator<Item = (&str, Clearance)> {
        let of = |placed: &'_ Placed| placed.known.clearances().collect::<Vec<_>>();
        self.placed.iter().flat_map(move |placed| {
            of(placed).into_iter().map(|clearance| (placed.object.name.as_str(), clearance))
        })
    }

    /// Takes in what was known of an object; whether there is one of that name.
    pub fn recall(&mut self, object: &str, clearance: &Clearance) -> bool {
        let found = self.placed.iter_mut().find(|placed| placed.object.name == object);
        found.map(|placed| placed.known.put(clearance)).is_some()
    }

    pub(super) fn forget_clearances(&mut self) {
        for placed in &mut self.placed {
            placed.known = Known::default();
        }
        self.learned.clear();
    }

    /// The object that was last found to be touched.
    pub(super) fn last_touched(&self) -> Option<&str> {
        self.placed.get(self.last_touched?).map(|placed| placed.object.name.as_str())
    }

    /// Whether the robot, with these links, is known to touch an object.
    pub(super) fn is_known_to_touch(&mut self, index: usize, links: &[Link]) -> bool {
        let touches = self.placed[index].is_known_to_touch(links);
        if touches {
            self.last_touched = Some(index);
        }
        touches
    }

    /// The share of a motion over which, from where the robot has these links on and either way, an object is not known to be
    /// touched, as far as `most`; `None` where it is.
    pub(super) fn known_clear(
        &mut self,
        index: usize,
        links: &[Link],
        travel: &[f64],
        most: f64,
    ) -> Option<f64> {
        let placed = &self.placed[index];
        let Some(about) = placed.about_taken() else { return Some(most) };
        let mut share = most;
        for (link, &travel) in links.iter().zip(travel) {
            if is_beyond(about, link, share * travel) {
                continue;
            }
            let Some(metres) = placed.known.nearer(&placed.inward(link), share * travel) else { continue };
            if metres < 0.0 {
                self.last_touched = Some(index);
                return None;
            }
            share = share.min(metres / travel);
        }
        Some(share)
    }

    /// What was learned since this was last asked.
    pub(super) fn take_learned(&mut self) -> Vec<(String, Clearance)> {
        std::mem::take(&mut self.learned)
    }

    /// Whether the robot, with these links (wider by what is kept), is free of an object. This is the one place where a planner reads the shape of
    /// an object, and each call is one evaluation: one configuration against one object.
    pub(super) fn evaluate(&mut self, index: usize, links: &[Link]) -> bool {
        self.evaluations += 1;
        let spare_m = self.touching_m - self.kept_m();
        let placed = &mut self.placed[index];
        let mut is_free = true;
        for link in links {
            let inward = placed.inward(link);
            let distance = placed.object.shape.distance(&inward.axis);
            is_free &= distance.metres - link.radius >= spare_m;
            let kept = placed.known.learn(&inward, &distance);
            self.learned.extend(kept.map(|clearance| (placed.object.name.clone(), clearance)));
        }
        if !is_free {
            self.last_touched = Some(index);
        }
        is_free
    }
}

impl Placed {
    pub(super) fn new(object: Object, since: Revision) -> Self {
        Self::with(object, since, 0)
    }

    /// An object that has been as it is since a state of the cell, and was moved so often.
    pub fn with(object: Object, since: Revision, times_moved: u32) -> Self {
        let frame = Frame::from(&object.pose);
        Self { object, since, times_moved, frame, known: Known::default() }
    }

    /// By how many metres the known free room exceeds the links, or that it does by `enough`; negative where they are not known
    /// to be free.
    pub(super) fn slack(&self, links: &[Link], enough: f64) -> f64 {
        let mut least = f64::INFINITY;
        for link in links.iter().rev() {
            least = least.min(self.known.slack(&self.inward(link), enough));
            if least < 0.0 {
                break;
            }
        }
        least
    }

    pub(super) fn inward(&self, link: &Link) -> Link {
        let Segment { a, b } = link.axis;
        Link { axis: Segment::new(self.frame.seen(a), self.frame.seen(b)), radius: link.radius }
    }

    pub(super) fn is_known_to_touch(&self, links: &[Link]) -> bool {
        let Some(about) = self.about_taken() else { return false };
        links
            .iter()
            .any(|link| !is_beyond(about, link, 0.0) && self.known.nearer(&self.inward(link), 0.0).is_some())
    }

    /// Whether something in a rectangle may be known to be taken.
    pub(super) fn may_be_taken_in(&self, about: &Rect) -> bool {
        self.about_taken().is_some_and(|(at, within_m)| about.grown(within_m + ROUNDING_M).contains(at))
    }

    /// A disc about all that is known to be taken, in the frame of the cell.
    fn about_taken(&self) -> Option<(Point, f64)> {
        self.known.about_taken().map(|(at, within_m)| (self.frame.place(at), within_m))
    }
}

/// Whether a link keeps more than so many metres from a disc: most do, and that is told in the frame of the cell.
fn is_beyond((at, within_m): (Point, f64), link: &Link, than_m: f64) -> bool {
    let near_m = within_m + link.radius + than_m + ROUNDING_M;
    link.axis.squared_distance(at) > near_m * near_m
}

/// Places are told to a micrometre up to there, metres; what is farther off no arm comes near.
const FARTHEST_M: f64 = 1e6;

pub(super) fn check<'o>(objects: impl IntoIterator<Item = &'o Object>) -> Result<(), WorkcellError> {
    let mut names = BTreeSet::new();
    for object in objects {
        let pose = &object.pose;
        if !(pose.at.x.is_finite() && pose.at.y.is_finite() && pose.heading.is_finite()) {
            return Err(WorkcellError::NotFinite(object.name.clone()));
        }
        if pose.at.length() > FARTHEST_M {
            return Err(WorkcellError::TooFar(object.name.clone()));
        }
        if !names.insert(&object.name) {
            return Err(WorkcellError::SameName(object.name.clone()));
        }
    }
    Ok(())
}
