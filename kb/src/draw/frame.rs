//! From metres (y up) to the picture (y down), and boxes there.

use adit_planners::geometry::{Point, Rect};

/// A point or a direction in the picture: x to the right, y down.
pub(super) type At = (f64, f64);

#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Block {
    pub x: f64,
    pub y: f64,
    pub w: f64,
    pub h: f64,
}

impl Block {
    /// The box of this size about a centre.
    pub fn about(x: f64, y: f64, w: f64, h: f64) -> Self {
        Self { x: x - w / 2.0, y: y - h / 2.0, w, h }
    }

    pub fn centre(&self) -> At {
        (self.x + self.w / 2.0, self.y + self.h / 2.0)
    }

    pub fn overlaps(&self, other: &Self) -> bool {
        self.x < other.x + other.w
            && other.x < self.x + self.w
            && self.y < other.y + other.h
            && other.y < self.y + self.h
    }

    /// Whether `other` lies inside.
    pub fn encloses(&self, other: &Self) -> bool {
        self.x <= other.x
            && other.x + other.w <= self.x + self.w
            && self.y <= other.y
            && other.y + other.h <= self.y + self.h
    }

    /// The box without a margin of `by` on each side; never of negative size.
    pub fn inset(&self, by: f64) -> Self {
        let (x, y) = self.centre();
        Self::about(x, y, (self.w - 2.0 * by).max(0.0), (self.h - 2.0 * by).max(0.0))
    }
}

/// Where the map lies in the picture.
#[derive(Clone, Copy, Debug)]
pub(super) struct Frame {
    bounds: Rect,
    /// Picture units a metre.
    pub scale: f64,
    pub map: Block,
}

impl Frame {
    /// The frame in which the map's longest side measures `longest`, its upper left corner at (left, top).
    pub fn new(bounds: Rect, longest: f64, left: f64, top: f64) -> Self {
        let side = |length: f64| if length.is_finite() && length > 0.0 { length } else { 1.0 };
        let (dx, dy) = (side(bounds.dx()), side(bounds.dy()));
        let scale = longest / dx.max(dy);
        Self { bounds, scale, map: Block { x: left, y: top, w: dx * scale, h: dy * scale } }
    }

    pub fn x(&self, x: f64) -> f64 {
        self.map.x + (x - self.bounds.x0) * self.scale
    }

    pub fn y(&self, y: f64) -> f64 {
        self.map.y + self.map.h - (y - self.bounds.y0) * self.scale
    }

    pub fn at(&self, p: Point) -> At {
        (self.x(p.x), self.y(p.y))
    }

    pub fn block(&self, r: &Rect) -> Block {
        Block { x: self.x(r.x0), y: self.y(r.y1), w: r.dx() * self.scale, h: r.dy() * self.scale }
    }
}
