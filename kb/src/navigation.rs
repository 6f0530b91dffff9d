//! Navigation on floor plans (Crowley): paths over regions and adits, and missions of a simulated robot that meets what
//! its plan does not know. Rules decide; `adit_planners::navigation` drives.

pub mod body;
pub mod course;
pub mod drive;
pub mod floor;
pub mod ground;
pub mod journal;
pub mod judge;
pub mod keep;
pub mod learning;
pub mod missions;
pub mod reading;
pub mod reporting;
pub mod routed;
pub(crate) mod story;
mod stretches;
pub mod together;
pub mod told;
pub mod tours;
mod walks;
pub mod why;
