//! Frames: what TF says of them, and where things are in the map's.

use std::collections::BTreeMap;
use std::sync::{Mutex, PoisonError};
use std::time::{Duration, Instant};

use nalgebra::{Isometry3, Quaternion as Quat, Translation3, UnitQuaternion, Vector3};

use crate::failure::{Failure, Kind};
use crate::msgs::{PoseStamped, Quaternion, TfMessage};

/// How old a transform may be that is not a static one.
const FRESH: Duration = Duration::from_secs(5);

/// So many links lead from any frame to the map; more are a circle.
const LINKS: usize = 64;

/// So many frames are kept; what comes after them is not heard.
const KEPT: usize = 4096;

/// A pose on the floor, in the map's frame.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct OnFloor {
    pub x: f64,
    pub y: f64,
    /// Radians; `None` where the pose has no orientation.
    pub yaw: Option<f64>,
}

struct Link {
    parent: String,
    to_parent: Isometry3<f64>,
    /// When it was heard; `None` for one that holds always.
    heard: Option<Instant>,
}

/// The frames that are known.
pub struct Frames {
    map: String,
    links: Mutex<BTreeMap<String, Link>>,
}

impl Frames {
    pub fn new(map: &str) -> Self {
        Self { map: bare(map).to_owned(), links: Mutex::default() }
    }

    /// The map's frame.
    pub fn map(&self) -> &str {
        &self.map
    }

    /// Hears transforms; those that are none are said in the answer.
    pub fn hear(&self, message: &TfMessage, is_static: bool) -> Result<(), String> {
        let mut links = self.links.lock().unwrap_or_else(PoisonError::into_inner);
        for stamped in &message.transforms {
            let (parent, child) = (bare(&stamped.header.frame_id), bare(&stamped.child_frame_id));
            let at = &stamped.transform.translation;
            let turned = unit(&stamped.transform.rotation)
                .filter(|_| at.x.is_finite() && at.y.is_finite() && at.z.is_finite());
            let Some(turned) = turned.filter(|_| !parent.is_empty() && !child.is_empty() && parent != child)
            else {
                return Err(format!("the transform from `{child}` to `{parent}` is none, and is not heard"));
            };
            if links.len() >= KEPT && !links.contains_key(child) {
                return Err(format!("there are more than {KEPT} frames; `{child}` is not heard"));
            }
            let to_parent = Isometry3::from_parts(Translation3::new(at.x, at.y, at.z), turned);
            let heard = (!is_static).then(Instant::now);
            links.insert(child.to_owned(), Link { parent: parent.to_owned(), to_parent, heard });
        }
        Ok(())
    }

    /// Where a frame lies in the map's.
    pub fn of(&self, frame: &str) -> Result<Isometry3<f64>, Failure> {
        let links = self.links.lock().unwrap_or_else(PoisonError::into_inner);
        let mut to_map = Isometry3::identity();
        let mut here = bare(frame);
        for _ in 0..LINKS {
            if here == self.map {
                return Ok(to_map);
            }
            let Some(link) = links.get(here) else {
                let from = bare(frame);
                let words = format!(
                    "frame `{from}` is not known: TF says no way from it to the map's frame `{}`",
                    self.map
                );
                return Err(Failure::new(Kind::Tf, words));
            };
            if let Some(age) = link.heard.map(|heard| heard.elapsed()).filter(|age| *age > FRESH) {
                let words = format!(
                    "TF said last {:.0} s ago where `{here}` is in `{}`",
                    age.as_secs_f64(),
                    link.parent
                );
                return Err(Failure::new(Kind::Tf, words));
            }
            to_map = link.to_parent * to_map;
            here = &link.parent;
        }
        Err(Failure::new(Kind::Tf, format!("the frames from `{frame}` on lead in a circle")))
    }

    /// Where a pose is on the floor; `what` it is for, in words.
    pub fn on_floor(&self, what: &str, pose: &PoseStamped) -> Result<OnFloor, Failure> {
        let at = &pose.pose.position;
        if !(at.x.is_finite() && at.y.is_finite() && at.z.is_finite()) {
            let words = format!("the {what} is at ({}, {}, {}); expected metres", at.x, at.y, at.z);
            return Err(Failure::new(Kind::Unknown, words));
        }
        if bare(&pose.header.frame_id).is_empty() {
            let words =
                format!("the {what} has no frame; expected `{}`, or one that TF leads to it from", self.map);
            return Err(Failure::new(Kind::Tf, words));
        }
        let frame = self.of(&pose.header.frame_id)?;
        let turned = unit(&pose.pose.orientation);
        let in_map = frame
            * Isometry3::from_parts(
                Translation3::new(at.x, at.y, at.z),
                turned.unwrap_or_else(UnitQuaternion::identity),
            );
        let yaw = turned.map(|_| yaw(&in_map));
        Ok(OnFloor { x: in_map.translation.x, y: in_map.translation.y, yaw })
    }

    /// Where a frame's origin is on the floor.
    pub fn origin(&self, frame: &str) -> Result<OnFloor, Failure> {
        let to_map = self.of(frame)?;
        Ok(OnFloor { x: to_map.translation.x, y: to_map.translation.y, yaw: Some(yaw(&to_map)) })
    }
}

/// The direction in which its x axis shows on the floor, radians.
pub fn yaw(of: &Isometry3<f64>) -> f64 {
    let ahead = of.rotation * Vector3::x();
    ahead.y.atan2(ahead.x)
}

/// The rotation; `None` where it is none.
pub fn unit(of: &Quaternion) -> Option<UnitQuaternion<f64>> {
    let quaternion = Quat::new(of.w, of.x, of.y, of.z);
    let norm = quaternion.norm();
    (norm.is_finite() && (norm - 1.0).abs() < 0.1).then(|| UnitQuaternion::from_quaternion(quaternion))
}

/// Frames were written with a slash once.
fn bare(frame: &str) -> &str {
    frame.trim_start_matches('/')
}
