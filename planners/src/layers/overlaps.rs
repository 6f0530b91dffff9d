//! Where a shape is changed: what rooms of two layers have in common.

use std::collections::BTreeMap;
use std::sync::Arc;

use super::layer::Layer;
use super::places::Places;
use crate::geometry::tolerance::SNAP_M;
use crate::geometry::{Convex, Point, Rect, Segment};
use crate::rooms::outline::part_of;

/// An overlap not thicker than this is left out beside a thicker one, metres.
const THIN_M: f64 = 0.1;

/// A rectangle for turning is found to within this share of its size.
const FITTED: f64 = 1e-3;

/// Two layers, and which way a body turns from the one into the other, where it does.
#[derive(Clone)]
pub(super) struct Pair {
    pub(super) layers: [Arc<Layer>; 2],
    pub(super) turn: Option<Turn>,
}

impl PartialEq for Pair {
    fn eq(&self, other: &Self) -> bool {
        let is_same = |at: usize| Arc::ptr_eq(&self.layers[at], &other.layers[at]);
        is_same(0) && is_same(1) && self.turn == other.turn
    }
}

/// A change between two rooms of two layers, by their numbers there.
pub(super) struct Change {
    pub(super) rooms: [u32; 2],
    /// Opposite corners of the least rectangle about where it is made.
    pub(super) across: Segment,
    /// Where the area lies in which it is made.
    pub(super) at: Point,
    /// How wide that is, metres.
    pub(super) width: f64,
}

/// Which of two layers has the facing from which the other's is the next one.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Turn {
    FromFirst,
    FromSecond,
}

/// What rooms of two layers have in common, by their numbers.
type Overlaps = BTreeMap<(u32, u32), Convex>;

/// The changes between two layers.
pub(super) fn between(pair: &Pair) -> Vec<Change> {
    let [from, to] = &pair.layers;
    let turning = match pair.turn {
        Some(Turn::FromFirst) => from.ground.turning.as_ref(),
        Some(Turn::FromSecond) => to.ground.turning.as_ref(),
        None => None,
    };
    let mut overlaps = Overlaps::new();
    for (a, room) in (0..).zip(&from.rooms) {
        for (b, common) in to.places.common(room) {
            // rooms are cut along the same lines: what lies in other areas is a rounding
            let is_alike = from.labels[a as usize] == to.labels[b as usize];
            if is_alike && common.breadth() > SNAP_M {
                overlaps.insert((a, b), common);
            }
        }
    }
    let change = |(a, b): (u32, u32), common: &Convex, within: Rect| {
        let Rect { x0, y0, x1, y1 } = within;
        let across = Segment::new(Point::new(x0, y0), Point::new(x1, y1));
        let area = part_of(common.clone(), within);
        Change { rooms: [a, b], across, at: area.centre(), width: area.breadth() }
    };
    if let Some(turning) = turning {
        return overlaps
            .iter()
            .filter_map(|(&pair, common)| Some(change(pair, common, largest_within(turning, common)?)))
            .collect();
    }
    let layers = (&**from, &**to);
    let is_needed =
        |pair: (u32, u32), common: &Convex| !is_thin(common) || !has_thicker_beside(&overlaps, layers, pair);
    let needed = overlaps.iter().filter(|(pair, common)| is_needed(**pair, common));
    needed.map(|(&pair, common)| change(pair, common, common.bounds())).collect()
}

fn is_thin(overlap: &Convex) -> bool {
    overlap.breadth() <= THIN_M
}

/// Whether the same room overlaps a neighbour of the other room, right beside this overlap and thicker than it: there
/// the robot may change as well, and go through the door between the neighbours. No change stands for another one across a
/// named door or the outline of an area, which may be closed.
fn has_thicker_beside(overlaps: &Overlaps, layers: (&Layer, &Layer), (a, b): (u32, u32)) -> bool {
    let is_beside = |pair: (u32, u32), room: &Convex, door: &Segment, labels: (u32, u32), of: &Layer| {
        let is_alike = of.labels[labels.0 as usize] == of.labels[labels.1 as usize];
        let touches = || room.clip(*door).is_some_and(|part| part.length() > SNAP_M);
        overlaps.get(&pair).is_some_and(|other| !is_thin(other)) && is_alike && touches()
    };
    let (one, other) = layers;
    let (room_a, room_b) = (&one.rooms[a as usize], &other.rooms[b as usize]);
    other
        .neighbours
        .of(b as usize)
        .iter()
        .any(|(next, door)| is_beside((a, *next), room_a, door, (b, *next), other))
        || one
            .neighbours
            .of(a as usize)
            .iter()
            .any(|(next, door)| is_beside((*next, b), room_b, door, (a, *next), one))
}

/// A rectangle in the largest part of an overlap in which a body can turn, as large as it fits about its middle.
fn largest_within(turning: &Places, overlap: &Convex) -> Option<Rect> {
    let parts = turning.common(overlap).into_iter().map(|(_, part)| part);
    let part = parts.max_by(|a, b| a.area().total_cmp(&b.area()))?;
    let (middle, bounds) = (part.centre(), part.bounds());
    let sized = |share: f64| {
        let (dx, dy) = (bounds.dx() * share / 2.0, bounds.dy() * share / 2.0);
        Rect::new(middle.x - dx, middle.y - dy, middle.x + dx, middle.y + dy)
    };
    let fits = |share: f64| sized(share).corners().iter().all(|&corner| part.contains(corner));
    let (mut fitting, mut large) = (0.0, 1.0);
    if fits(large) {
        return Some(bounds);
    }
    while large - fitting > FITTED {
        let share = f64::midpoint(fitting, large);
        if fits(share) {
            fitting = share;
        } else {
            large = share;
        }
    }
    (fitting > 0.0 && sized(fitting).smaller_side() > SNAP_M).then(|| sized(fitting))
}
