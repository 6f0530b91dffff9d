//! Axis-parallel rectangles, in metres in the map's frame.

use super::Point;

/// A closed axis-parallel rectangle; `x0 <= x1` and `y0 <= y1`.
#[derive(Clone, Copy, Debug, PartialEq, PartialOrd)]
pub struct Rect {
    pub x0: f64,
    pub y0: f64,
    pub x1: f64,
    pub y1: f64,
}

impl From<Rect> for geo::Rect {
    fn from(r: Rect) -> Self {
        Self::new((r.x0, r.y0), (r.x1, r.y1))
    }
}

impl Rect {
    /// From its edges, in the order of the file formats.
    pub const fn new(x0: f64, y0: f64, x1: f64, y1: f64) -> Self {
        Self { x0, y0, x1, y1 }
    }

    pub fn dx(&self) -> f64 {
        self.x1 - self.x0
    }

    pub fn dy(&self) -> f64 {
        self.y1 - self.y0
    }

    pub fn area(&self) -> f64 {
        self.dx() * self.dy()
    }

    /// The smaller side: the paper's width of a room.
    pub fn smaller_side(&self) -> f64 {
        self.dx().min(self.dy())
    }

    /// The least rectangle about points; of no points one that is empty: turned inside out, from infinity to minus infinity.
    pub fn around(points: impl IntoIterator<Item = Point>) -> Self {
        let nothing = Self::new(f64::INFINITY, f64::INFINITY, f64::NEG_INFINITY, f64::NEG_INFINITY);
        let grow = |r: Self, p: Point| Self::new(r.x0.min(p.x), r.y0.min(p.y), r.x1.max(p.x), r.y1.max(p.y));
        points.into_iter().fold(nothing, grow)
    }

    /// The same, larger by so many metres on each side.
    #[must_use]
    pub fn grown(&self, by: f64) -> Self {
        Self::new(self.x0 - by, self.y0 - by, self.x1 + by, self.y1 + by)
    }

    /// Counterclockwise from the lower left one.
    pub fn corners(&self) -> [Point; 4] {
        [(self.x0, self.y0), (self.x1, self.y0), (self.x1, self.y1), (self.x0, self.y1)]
            .map(|(x, y)| Point::new(x, y))
    }

    /// Metres from a point outside; below 0 inside, by how far the nearest side is.
    pub fn signed_distance(&self, p: Point) -> f64 {
        let inside = (p.x - self.x0).min(self.x1 - p.x).min(p.y - self.y0).min(self.y1 - p.y);
        if inside > 0.0 { -inside } else { p.distance(self.nearest_to(p)) }
    }

    pub fn centre(&self) -> Point {
        Point::new(f64::midpoint(self.x0, self.x1), f64::midpoint(self.y0, self.y1))
    }

    /// Signed gaps along x and y to another one; negative where they overlap along that axis.
    pub fn axis_gaps(&self, other: &Self) -> (f64, f64) {
        ((self.x0 - other.x1).max(other.x0 - self.x1), (self.y0 - other.y1).max(other.y0 - self.y1))
    }

    /// Metres to another one; 0 where they touch or overlap.
    pub fn gap(&self, other: &Self) -> f64 {
        let (dx, dy) = self.axis_gaps(other);
        dx.max(0.0).hypot(dy.max(0.0))
    }

    /// Whether the two share an area, not just a boundary.
    pub fn overlaps(&self, other: &Self) -> bool {
        self.x0 < other.x1 && other.x0 < self.x1 && self.y0 < other.y1 && other.y0 < self.y1
    }

    /// Whether `other` lies wholly inside (boundaries may touch).
    pub fn encloses(&self, other: &Self) -> bool {
        self.x0 <= other.x0 && other.x1 <= self.x1 && self.y0 <= other.y0 && other.y1 <= self.y1
    }

    /// Whether the point lies inside or on the boundary.
    pub fn contains(&self, p: Point) -> bool {
        self.x0 <= p.x && p.x <= self.x1 && self.y0 <= p.y && p.y <= self.y1
    }

    /// The common part; `None` where they share no area.
    pub fn intersection(&self, other: &Self) -> Option<Self> {
        let common = Self::new(
            self.x0.max(other.x0),
            self.y0.max(other.y0),
            self.x1.min(other.x1),
            self.y1.min(other.y1),
        );
        (common.x0 < common.x1 && common.y0 < common.y1).then_some(common)
    }

    /// Whether the segment has a part of some length inside, not just on the boundary.
    pub fn is_crossed_by(&self, from: Point, to: Point) -> bool {
        let inside = self.clip(from, to).map(|(a, b)| a.midpoint(b));
        inside.is_some_and(|p| self.x0 < p.x && p.x < self.x1 && self.y0 < p.y && p.y < self.y1)
    }

    /// What of a segment lies in the rectangle (Liang and Barsky 1984); `None` where at most a point does.
    pub fn clip(&self, from: Point, to: Point) -> Option<(Point, Point)> {
        let (dx, dy) = (to.x - from.x, to.y - from.y);
        let sides = [
            (-dx, from.x - self.x0),
            (dx, self.x1 - from.x),
            (-dy, from.y - self.y0),
            (dy, self.y1 - from.y),
        ];
        let (mut enters, mut leaves) = (0.0_f64, 1.0_f64);
        for (towards, left) in sides {
            if towards == 0.0 && left < 0.0 {
                return None;
            }
            if towards < 0.0 {
                enters = enters.max(left / towards);
            } else if towards > 0.0 {
                leaves = leaves.min(left / towards);
            }
        }
        let at = |share: f64| from.lerp(to, share);
        let start = if enters > 0.0 { at(enters) } else { from };
        let end = if leaves < 1.0 { at(leaves) } else { to };
        (enters < leaves).then_some((start, end))
    }

    /// The point of this rectangle that is nearest to `p`.
    pub fn nearest_to(&self, p: Point) -> Point {
        Point::new(p.x.clamp(self.x0, self.x1), p.y.clamp(self.y0, self.y1))
    }
}
