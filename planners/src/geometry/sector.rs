//! What of the directions about a point something takes.

use std::f64::consts::TAU;

use super::Point;

/// Directions from one counterclockwise on, radians.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sector {
    pub from: f64,
    /// How far it reaches from there, less than a whole turn.
    pub turn: f64,
}

impl Sector {
    /// From one direction to another.
    pub fn between(from: Point, to: Point) -> Self {
        let from = from.angle();
        Self { from, turn: (to.angle() - from).rem_euclid(TAU) }
    }

    /// The direction in its middle, of length 1.
    pub fn middle(&self) -> Point {
        Point::towards(self.from + self.turn / 2.0)
    }

    /// The widest sector that no other one has a part in; `None` where there are none.
    pub fn widest_gap(sectors: impl IntoIterator<Item = Self>) -> Option<Self> {
        let mut sectors: Vec<Self> = sectors.into_iter().collect();
        sectors.sort_by(|one, two| one.from.total_cmp(&two.from));
        let first = sectors.first()?.from;
        let mut widest = Self { from: first, turn: 0.0 };
        let mut taken = first;
        for Self { from, turn } in sectors.into_iter().chain([Self { from: first + TAU, turn: 0.0 }]) {
            if from - taken > widest.turn {
                widest = Self { from: taken, turn: from - taken };
            }
            taken = taken.max(from + turn);
        }
        Some(widest)
    }
}

#[cfg(test)]
mod tests {
    use std::f64::consts::{FRAC_PI_2, PI};

    use super::*;

    #[test]
    fn the_gap_that_is_widest_may_lie_about_the_first_direction() {
        let taken = [Sector { from: -FRAC_PI_2, turn: PI }, Sector { from: 2.0, turn: 0.5 }];
        let gap = Sector::widest_gap(taken).unwrap();
        assert!((gap.from - 2.5).abs() < 1e-12 && (gap.turn - (1.5 * PI - 2.5)).abs() < 1e-12, "{gap:?}");
        assert_eq!(Sector::widest_gap([]), None);
        let around = [Sector { from: 0.0, turn: PI }, Sector { from: PI, turn: PI }];
        assert!(Sector::widest_gap(around).unwrap().turn < 1e-12);
    }
}
