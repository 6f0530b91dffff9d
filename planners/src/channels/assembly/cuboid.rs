//! Boxes along the axes.

use std::fmt;

/// An axis-parallel box, in metres: (x, z) for `D` = 2, (x, y, z) for `D` = 3. The last axis leads out.
#[derive(Clone, Copy, Debug, PartialEq, PartialOrd)]
pub struct Cuboid<const D: usize> {
    /// The corner with the smallest coordinates.
    pub min: [f64; D],
    /// The corner with the largest.
    pub max: [f64; D],
}

impl<const D: usize> Cuboid<D> {
    pub const fn new(min: [f64; D], max: [f64; D]) -> Self {
        Self { min, max }
    }

    pub fn size(&self, axis: usize) -> f64 {
        self.max[axis] - self.min[axis]
    }

    /// The common part; `None` where the two share no interior.
    pub fn intersection(&self, other: &Self) -> Option<Self> {
        let mut common = *self;
        for axis in 0..D {
            common.min[axis] = self.min[axis].max(other.min[axis]);
            common.max[axis] = self.max[axis].min(other.max[axis]);
        }
        common.is_solid().then_some(common)
    }

    /// Whether it has an extent along every axis.
    pub fn is_solid(&self) -> bool {
        (0..D).all(|axis| self.min[axis] < self.max[axis])
    }

    pub fn is_finite(&self) -> bool {
        self.min.iter().chain(&self.max).all(|value| value.is_finite())
    }

    #[must_use]
    pub fn moved(&self, by: &[f64; D]) -> Self {
        let shifted = |corner: &[f64; D]| std::array::from_fn(|axis| corner[axis] + by[axis]);
        Self::new(shifted(&self.min), shifted(&self.max))
    }

    /// The smallest box that holds this one and another.
    #[must_use]
    pub fn joined(&self, other: &Self) -> Self {
        let mut hull = *self;
        for axis in 0..D {
            hull.min[axis] = self.min[axis].min(other.min[axis]);
            hull.max[axis] = self.max[axis].max(other.max[axis]);
        }
        hull
    }

    /// By how much `other` sticks out of this box, at most; 0 where it lies wholly inside.
    pub fn excess(&self, other: &Self) -> f64 {
        let over = |axis: usize| (self.min[axis] - other.min[axis]).max(other.max[axis] - self.max[axis]);
        (0..D).map(over).fold(0.0, f64::max)
    }
}

/// `[x0, z0, x1, z1]`, or `[x0, y0, z0, x1, y1, z1]`: as files give it.
impl<const D: usize> fmt::Display for Cuboid<D> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_list().entries(self.min.iter().chain(&self.max).map(Plain)).finish()
    }
}

/// A number as it is written: 5, not 5.0.
struct Plain<'a>(&'a f64);

impl fmt::Debug for Plain<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}", self.0)
    }
}
