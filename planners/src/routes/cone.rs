//! What is seen from a point through a gap.

use super::mesh::{EPSILON, NONE};
use crate::geometry::Point;
pub(super) use crate::geometry::{Segment, cross};

/// A way that passes an end of a door by no more than this share of the door leads to the end itself.
const AT_END: f64 = 1e-12;

/// A part of a door as it is seen, with the door's ends where they are seen.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Gap {
    pub left: Point,
    pub right: Point,
    /// Number of the door's end at `left`; [`NONE`] where the view is cut off before.
    pub left_end: u32,
    pub right_end: u32,
}

/// In which directions a point looks into a room.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum View {
    All,
    /// To one side of the line on which it was reached from `from`.
    Side {
        from: Point,
        left: bool,
    },
    Through(Gap),
}

impl Segment {
    /// Whether the point lies on the segment's line.
    pub(super) fn is_in_line_with(&self, p: Point) -> bool {
        cross(self.a, self.b, p).abs() <= EPSILON * self.length().max(1.0)
    }

    /// Where the way from `from` to `to` passes, or comes nearest to passing, the segment.
    pub(super) fn passed_at(&self, from: Point, to: Point) -> Point {
        let (one, two) = (cross(from, to, self.a), cross(from, to, self.b));
        if (one - two).abs() <= f64::MIN_POSITIVE {
            return self.nearest_to(from);
        }
        let share = one / (one - two);
        let at = self.at(share.clamp(0.0, 1.0));
        if share <= AT_END {
            self.a
        } else if share >= 1.0 - AT_END {
            self.b
        } else {
            at
        }
    }

    /// The part where `side` is not negative; `None` where that is less than a point.
    fn clipped(self, side: impl Fn(Point) -> f64) -> Option<Self> {
        let (one, two) = (side(self.a), side(self.b));
        if one < 0.0 && two < 0.0 {
            return None;
        }
        let limit = || self.at(one / (one - two));
        let a = if one < 0.0 { limit() } else { self.a };
        let b = if two < 0.0 { limit() } else { self.b };
        Some(Self { a, b })
    }
}

impl View {
    /// The part of a segment that is seen from `root`.
    pub fn of(&self, root: Point, segment: Segment) -> Option<Segment> {
        match self {
            Self::All => Some(segment),
            Self::Side { from, left } => {
                let sign = if *left { 1.0 } else { -1.0 };
                segment.clipped(|p| sign * cross(*from, root, p) + EPSILON * EPSILON)
            }
            Self::Through(gap) => segment
                .clipped(|p| cross(root, gap.right, p) + EPSILON * EPSILON)?
                .clipped(|p| -cross(root, gap.left, p) + EPSILON * EPSILON),
        }
    }

    /// The part that is seen of a segment that may lie along a limit of the view.
    pub fn of_gate(&self, root: Point, gate: Segment) -> Option<Segment> {
        if !gate.is_in_line_with(root) {
            return self.of(root, gate);
        }
        let near = gate.nearest_to(root);
        let end = |end: Point| if self.sees(root, end) { end } else { near };
        self.sees(root, near).then(|| Segment { a: end(gate.a), b: end(gate.b) })
    }

    /// Whether it is one through a gap on the segment's line, which a straight way beyond it does not come to again.
    pub fn is_through(&self, segment: Segment) -> bool {
        match self {
            Self::Through(gap) => {
                gap.segment().length() > EPSILON
                    && segment.is_in_line_with(gap.left)
                    && segment.is_in_line_with(gap.right)
            }
            _ => false,
        }
    }

    pub fn sees(&self, root: Point, p: Point) -> bool {
        let slack = EPSILON * root.distance(p).max(EPSILON);
        match self {
            Self::All => true,
            Self::Side { from, left } => {
                let sign = if *left { 1.0 } else { -1.0 };
                sign * cross(*from, root, p) >= -slack * from.distance(root).max(1.0)
            }
            Self::Through(gap) => cross(root, gap.right, p) >= -slack && cross(root, gap.left, p) <= slack,
        }
    }
}

impl Gap {
    /// The seen part of a door from `root`, left and right told apart; `ends` are the numbers of the door's ends.
    pub fn new(root: Point, door: Segment, seen: Segment, ends: [u32; 2]) -> Self {
        let number = |p: Point, of: Point, end: u32| if p.distance(of) <= EPSILON { end } else { NONE };
        let (a, b) = (number(seen.a, door.a, ends[0]), number(seen.b, door.b, ends[1]));
        if cross(root, seen.a, seen.b) > 0.0 {
            Self { left: seen.b, right: seen.a, left_end: b, right_end: a }
        } else {
            Self { left: seen.a, right: seen.b, left_end: a, right_end: b }
        }
    }

    pub fn segment(&self) -> Segment {
        Segment { a: self.left, b: self.right }
    }
}
