//! Points and axis-parallel rectangles, in metres in the map's frame (x to the right, y up).

/// A point, in metres.
#[derive(Clone, Copy, Debug, PartialEq, PartialOrd, Default)]
pub struct Point {
    /// To the right.
    pub x: f64,
    /// Up.
    pub y: f64,
}

impl Point {
    /// A point from its coordinates.
    pub const fn new(x: f64, y: f64) -> Self {
        Self { x, y }
    }

    /// Euclidean distance, in metres.
    pub fn distance(self, other: Self) -> f64 {
        // `hypot` minds numbers near the ends of their range, and takes several times as long.
        ((self.x - other.x).powi(2) + (self.y - other.y).powi(2)).sqrt()
    }
}

impl Point {
    /// The point of the segment from `a` to `b` that is nearest to this one.
    #[must_use]
    pub fn nearest_on(self, a: Self, b: Self) -> Self {
        let (dx, dy) = (b.x - a.x, b.y - a.y);
        let squared = dx * dx + dy * dy;
        if squared <= 0.0 {
            return a;
        }
        let share = (((self.x - a.x) * dx + (self.y - a.y) * dy) / squared).clamp(0.0, 1.0);
        Self::new(a.x + dx * share, a.y + dy * share)
    }
}

/// A closed axis-parallel rectangle; `x0 <= x1` and `y0 <= y1`.
#[derive(Clone, Copy, Debug, PartialEq, PartialOrd)]
pub struct Rect {
    /// Left edge.
    pub x0: f64,
    /// Lower edge.
    pub y0: f64,
    /// Right edge.
    pub x1: f64,
    /// Upper edge.
    pub y1: f64,
}

impl Rect {
    /// A rectangle from its edges, in the order of the file formats.
    pub const fn new(x0: f64, y0: f64, x1: f64, y1: f64) -> Self {
        Self { x0, y0, x1, y1 }
    }

    /// Extent along x, in metres.
    pub fn dx(&self) -> f64 {
        self.x1 - self.x0
    }

    /// Extent along y, in metres.
    pub fn dy(&self) -> f64 {
        self.y1 - self.y0
    }

    /// Area, in square metres.
    pub fn area(&self) -> f64 {
        self.dx() * self.dy()
    }

    /// The smaller side: the paper's width of a room.
    pub fn smaller_side(&self) -> f64 {
        self.dx().min(self.dy())
    }

    /// The middle.
    pub fn centre(&self) -> Point {
        Point::new(f64::midpoint(self.x0, self.x1), f64::midpoint(self.y0, self.y1))
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
        let inside =
            self.clip(from, to).map(|(a, b)| Point::new(f64::midpoint(a.x, b.x), f64::midpoint(a.y, b.y)));
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
        let at = |share: f64| Point::new(from.x + share * dx, from.y + share * dy);
        let start = if enters > 0.0 { at(enters) } else { from };
        let end = if leaves < 1.0 { at(leaves) } else { to };
        (enters < leaves).then_some((start, end))
    }

    /// The point of this rectangle that is nearest to `p`.
    pub fn nearest_to(&self, p: Point) -> Point {
        Point::new(p.x.clamp(self.x0, self.x1), p.y.clamp(self.y0, self.y1))
    }
}
