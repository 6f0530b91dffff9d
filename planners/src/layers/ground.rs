//! Where the middle of a disc or of a body can be, by what is solid alone: names and areas cut it later.

use super::dents::without_dents;
use super::footprint;
use super::grown::{Moved, Rings};
use super::pieces::Pieces;
use super::places::Places;
use super::record::State;
use super::walls::Walls;
use crate::geometry::Rect;
use crate::geometry::tolerance::SNAP_M;
use crate::world::World;

/// Dents of free space up to so deep are no part of rooms, metres. A point in one is joined with them by a straight leg.
const DENT_M: f64 = 0.02;

/// What of a state decides where it can be.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Body {
    pub(super) width: f64,
    /// Length and facing; `None` for a disc.
    pub(super) lies: Option<(f64, usize)>,
    /// Indices of the bridges that it does not pass.
    low: Vec<usize>,
}

impl Body {
    pub(super) fn of(world: &World, state: &State, facing: Option<usize>) -> Self {
        let passes = |height: f64| state.height < height;
        let low = (0..world.bridges.len()).filter(|&bridge| !passes(world.bridges[bridge].height));
        Self { width: state.width, lies: state.length.zip(facing), low: low.collect() }
    }

    /// What it takes of the floor, with so many metres around it.
    pub(super) fn moved(&self, margin: f64) -> Moved {
        match self.lies {
            None => Moved::Disc(self.width / 2.0 + margin),
            Some((length, facing)) => Moved::Body(footprint::body(length, self.width, margin, facing)),
        }
    }
}

pub(super) struct Ground {
    pub(super) free: Rings,
    /// Where a body can turn to the next facing, in convex pieces; `None` for a disc.
    pub(super) turning: Option<Places>,
}

impl Ground {
    /// The error is one sentence.
    pub(super) fn of(world: &World, walls: &Walls, body: &Body) -> Result<Self, String> {
        let low: Vec<Rect> = body.low.iter().map(|&bridge| world.bridges[bridge].rect).collect();
        // what is free within a rounding is not free
        let (bounds, clearance) = (world.bounds, world.clearance + SNAP_M);
        let keep = body.width / 2.0 + clearance;
        let (solid, sweep) = match body.lies {
            None => (walls.about_discs(&low, bounds, [2.0 * keep, 2.0 * keep * Moved::most()]), None),
            Some((length, facing)) => {
                (walls.straight(&low), Some(footprint::sweep(length, body.width, clearance, facing)))
            }
        };
        let free = without_dents(&body.moved(clearance).free_space(bounds, &solid), DENT_M);
        let turning = sweep.map(|sweep| Moved::Body(sweep).free_space(bounds, &solid));
        let turning = turning.map(|turning| Pieces::of(&turning, &[])).transpose()?;
        Ok(Self { free, turning: turning.map(|turning| Places::new(turning.pieces)) })
    }
}
