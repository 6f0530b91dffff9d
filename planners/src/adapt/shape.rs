//! The outline of an object, in its own frame, and how far a link is from it.

use smallvec::{SmallVec, smallvec};

use crate::geometry::tolerance::ROUNDING_M;
use crate::geometry::{Point, Segment, polygon};

/// A simple polygon, convex or not, in the frame of its object, metres.
#[derive(Clone, Debug, PartialEq)]
pub struct Shape {
    corners: Vec<Point>,
}

/// Why corners are no outline of an object.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum ShapeError {
    #[error("an outline has {0} corners, and needs three at least")]
    TooFewCorners(usize),
    #[error("corner {0} is not at a finite place")]
    NotFinite(usize),
    #[error("corners {0} and {1} are at the same place")]
    SameCorner(usize, usize),
    /// Two sides cross or touch that are not neighbours. Sides are named by the corner from which they go.
    #[error("the outline crosses itself: the side from corner {0} meets the side from corner {1}")]
    SelfCrossing(usize, usize),
}

/// How far a link's axis is from an outline.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Distance {
    /// Metres from the axis to the outline; where the axis enters it, minus the depth of the witness in it.
    pub metres: f64,
    /// The point of the object that is nearest to the axis, or the deepest known point of the axis in the object.
    pub witness: Point,
    /// Where all of the object lies behind the line through the witness, across the way to the axis: the direction of that
    /// way, of length 1.
    pub ahead: Option<Point>,
}

impl Shape {
    /// An outline from its corners in order, either way round; the last side goes back to the first corner. Corners
    /// are numbered from 0 in errors.
    pub fn new(corners: Vec<Point>) -> Result<Self, ShapeError> {
        if corners.len() < 3 {
            return Err(ShapeError::TooFewCorners(corners.len()));
        }
        if let Some(bad) = corners.iter().position(|c| !(c.x.is_finite() && c.y.is_finite())) {
            return Err(ShapeError::NotFinite(bad));
        }
        let shape = Self { corners };
        let sides: Vec<Segment> = shape.sides().collect();
        let count = sides.len();
        if let Some(same) = sides.iter().position(|side| side.length() <= 0.0) {
            return Err(ShapeError::SameCorner(same, (same + 1) % count));
        }
        if let Some((first, second)) = polygon::self_crossing(&shape.corners) {
            return Err(ShapeError::SelfCrossing(first, second));
        }
        Ok(shape)
    }

    /// The corners, in the frame of the object.
    pub fn corners(&self) -> &[Point] {
        &self.corners
    }

    fn sides(&self) -> impl Iterator<Item = Segment> + '_ {
        polygon::sides(&self.corners)
    }

    pub(super) fn encloses(&self, p: Point) -> bool {
        polygon::encloses(self.sides(), p)
    }

    /// How far the axis of a link, given in the frame of the object, is from the object.
    pub(super) fn distance(&self, axis: &Segment) -> Distance {
        let mut nearest = Distance { metres: f64::INFINITY, witness: axis.a, ahead: None };
        let mut cuts: SmallVec<[f64; 8]> = smallvec![0.0, 1.0];
        for side in self.sides() {
            if let Some(share) = crossing(axis, &side) {
                cuts.push(share);
            }
            for (witness, metres) in [
                (side.a, axis.distance(side.a)),
                (side.nearest_to(axis.a), side.distance(axis.a)),
                (side.nearest_to(axis.b), side.distance(axis.b)),
            ] {
                if metres < nearest.metres {
                    nearest = Distance { metres, witness, ahead: None };
                }
            }
        }
        if cuts.len() == 2 && !self.encloses(axis.a) {
            let way = Segment::new(nearest.witness, axis.nearest_to(nearest.witness)).direction();
            let is_ahead = |&corner: &Point| (corner - nearest.witness).dot(way) > ROUNDING_M;
            nearest.ahead = (!self.corners.iter().any(is_ahead)).then_some(way);
            return nearest;
        }
        self.deepest(axis, &mut cuts)
    }

    /// The deepest of a few points of an axis that enters the outline at these shares of its length.
    fn deepest(&self, axis: &Segment, cuts: &mut [f64]) -> Distance {
        const PROBES: u32 = 8;
        cuts.sort_unstable_by(f64::total_cmp);
        let mut deepest = Distance { metres: 0.0, witness: axis.at(cuts[1]), ahead: None };
        for pair in cuts.windows(2) {
            if !self.encloses(axis.at(f64::midpoint(pair[0], pair[1]))) {
                continue;
            }
            for probe in 0..=PROBES {
                let witness = axis.at(pair[0] + (pair[1] - pair[0]) * f64::from(probe) / f64::from(PROBES));
                let depth = self.sides().map(|side| side.distance(witness)).fold(f64::INFINITY, f64::min);
                if -depth < deepest.metres {
                    deepest = Distance { metres: -depth, witness, ahead: None };
                }
            }
        }
        deepest
    }
}

/// Where on the axis a side crosses it, as a share of its length; where that is a corner, one of its two sides does.
fn crossing(axis: &Segment, side: &Segment) -> Option<f64> {
    let [from, to] = side.sides_of(axis);
    let [one, other] = axis.sides_of(side);
    ((from > 0.0) != (to > 0.0) && (one > 0.0) != (other > 0.0)).then(|| from / (from - to))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn shape(corners: &[(f64, f64)]) -> Result<Shape, ShapeError> {
        Shape::new(corners.iter().map(|&(x, y)| Point::new(x, y)).collect())
    }

    fn axis(x0: f64, y0: f64, x1: f64, y1: f64) -> Segment {
        Segment::new(Point::new(x0, y0), Point::new(x1, y1))
    }

    #[test]
    fn an_outline_that_crosses_or_touches_itself_is_refused() {
        let bow_tie = shape(&[(0.0, 0.0), (2.0, 2.0), (2.0, 0.0), (0.0, 2.0)]);
        assert_eq!(bow_tie, Err(ShapeError::SelfCrossing(0, 2)));
        let spike = shape(&[(0.0, 0.0), (2.0, 0.0), (1.0, 0.0), (1.0, 2.0)]);
        assert_eq!(spike, Err(ShapeError::SelfCrossing(0, 1)));
        let pinched = shape(&[(0.0, 0.0), (2.0, 0.0), (2.0, 2.0), (1.0, 0.0), (0.0, 2.0)]);
        assert!(matches!(pinched, Err(ShapeError::SelfCrossing(0, _))));
    }

    #[test]
    fn an_outline_needs_three_corners_at_places_of_their_own() {
        assert_eq!(shape(&[(0.0, 0.0), (1.0, 0.0)]), Err(ShapeError::TooFewCorners(2)));
        let same = shape(&[(0.0, 0.0), (1.0, 0.0), (1.0, 0.0), (0.0, 1.0)]);
        assert_eq!(same, Err(ShapeError::SameCorner(1, 2)));
        assert_eq!(shape(&[(0.0, 0.0), (f64::NAN, 0.0), (1.0, 1.0)]), Err(ShapeError::NotFinite(1)));
    }

    #[test]
    fn a_link_outside_is_as_far_as_its_nearest_point() {
        let square = shape(&[(0.0, 0.0), (2.0, 0.0), (2.0, 2.0), (0.0, 2.0)]).unwrap();
        let beside = square.distance(&axis(3.0, -5.0, 3.0, 5.0));
        assert!((beside.metres - 1.0).abs() < 1e-12 && (beside.witness.x - 2.0).abs() < 1e-12);
        assert!((square.distance(&axis(-1.0, -1.0, -4.0, -1.0)).metres - 2.0_f64.sqrt()).abs() < 1e-12);
    }

    #[test]
    fn a_link_that_enters_or_lies_wholly_inside_is_as_deep_as_its_deepest_point() {
        let square = shape(&[(0.0, 0.0), (2.0, 0.0), (2.0, 2.0), (0.0, 2.0)]).unwrap();
        assert!((square.distance(&axis(0.5, 1.0, 1.5, 1.0)).metres + 1.0).abs() < 1e-12);
        assert!((square.distance(&axis(-3.0, 1.0, 0.25, 1.0)).metres + 0.25).abs() < 1e-12);
        assert!((square.distance(&axis(-3.0, 1.0, 5.0, 1.0)).metres + 1.0).abs() < 1e-12);
    }

    #[test]
    fn the_mouth_of_a_horseshoe_is_free() {
        let corners =
            [(0.0, 0.0), (3.0, 0.0), (3.0, 1.0), (1.0, 1.0), (1.0, 2.0), (3.0, 2.0), (3.0, 3.0), (0.0, 3.0)];
        let horseshoe = shape(&corners).unwrap();
        assert!((horseshoe.distance(&axis(1.4, 1.5, 5.0, 1.5)).metres - 0.4).abs() < 1e-12);
        assert!(horseshoe.distance(&axis(1.4, 1.5, 0.5, 1.5)).metres < -0.4);
    }
}
