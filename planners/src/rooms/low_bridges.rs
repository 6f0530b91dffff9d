//! Rooms under low bridges: the paper's list 1.

use crate::facts::Facts;
use crate::geometry::Rect;
use crate::known::KnownClass;
use crate::planner::PlannerError;

use super::{LowBridge, Room};

/// How the free part of a rectangle is cut into rooms, given what blocks it.
type Cutter = fn(Rect, &[Rect]) -> Vec<Rect>;

/// The rooms under low bridges, in the order of the bridges. A solid obstacle wins over a bridge; where bridges
/// overlap, the lower one limits (of equal heights the first), so that a bridge may give several rooms or none.
pub(crate) fn cut_low_bridges(bounds: Rect, solid: &[Rect], low: &[LowBridge], cut: Cutter) -> Vec<Room> {
    let mut rooms = Vec::new();
    for (i, bridge) in low.iter().enumerate() {
        let Some(area) = bridge.rect.intersection(&bounds) else { continue };
        let wins = |j: usize, other: &LowBridge| {
            other.height < bridge.height || (other.height <= bridge.height && j < i)
        };
        let lower = low.iter().enumerate().filter(|&(j, other)| wins(j, other)).map(|(_, other)| other.rect);
        let blocked: Vec<_> =
            solid.iter().copied().chain(lower).filter(|rect| rect.overlaps(&area)).collect();
        let height = Some(bridge.height);
        rooms.extend(cut(area, &blocked).into_iter().map(|rect| Room { rect, height }));
    }
    rooms
}

/// The bridges that are known to be low, by `BRIDGES.low`.
pub(crate) fn known_low_bridges(planner: &str, known: &Facts) -> Result<Vec<LowBridge>, PlannerError> {
    let bridges = KnownClass::find(planner, "BRIDGES", known)?;
    let (rects, heights, low) = (bridges.rects()?, bridges.numbers("height")?, bridges.truths("low")?);
    let all = rects.into_iter().zip(heights).zip(low);
    Ok(all.filter_map(|((rect, height), low)| low.then_some(LowBridge { rect, height })).collect())
}
