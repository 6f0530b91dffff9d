//! What was measured all around, direction by direction.

use std::f64::consts::TAU;

use adit_planners::geometry::Point;

use crate::navigation::body::message::Senses;

/// Ranges that differ by more say no more than that they differ, metres.
const DIFFERENT_M: f64 = 0.5;

/// The middle range in each of so many directions; `None` where nothing was heard, or nothing measured.
#[derive(Clone, Debug)]
pub struct Scan {
    ranges: Vec<Option<f64>>,
    /// Directions into which something was measured.
    pub measured: usize,
}

impl Scan {
    pub fn of(senses: &[Senses], directions: usize) -> Self {
        let mut all: Vec<Vec<f64>> = vec![Vec::new(); directions];
        for echo in senses.iter().flat_map(|senses| &senses.readings) {
            // what was not heard is farther away than all that was
            all[sector(echo.bearing_rad, directions)].push(echo.range_m.unwrap_or(f64::INFINITY));
        }
        let measured = all.iter().filter(|ranges| !ranges.is_empty()).count();
        let middle = |mut ranges: Vec<f64>| {
            ranges.sort_by(f64::total_cmp);
            ranges.get(ranges.len() / 2).copied().filter(|range| range.is_finite())
        };
        Self { ranges: all.into_iter().map(middle).collect(), measured }
    }

    /// Radians between two directions.
    pub fn step(&self) -> f64 {
        TAU / self.ranges.len() as f64
    }

    /// The nearest echo: its bearing and its range.
    pub fn nearest(&self) -> Option<(f64, f64)> {
        let heard = self.heard().map(|(place, range)| (self.step() * place as f64, range));
        heard.min_by(|a, b| a.1.total_cmp(&b.1))
    }

    /// How much this differs on the whole from what was seen before a turn of so many directions, metres; `None` where too little
    /// was heard.
    pub fn differs_turned(&self, before: &Self, by: isize) -> Option<f64> {
        let count = self.ranges.len() as isize;
        let pairs = self.heard().filter_map(|(place, range)| {
            Some((range, before.ranges[(place as isize + by).rem_euclid(count) as usize]?))
        });
        self.mean(pairs)
    }

    /// As [`Self::differs_turned`], before a move of so many metres ahead.
    pub fn differs_moved(&self, before: &Self, ahead_m: f64) -> Option<f64> {
        let pairs = before.heard().filter_map(|(place, range)| {
            let at = Point::towards(self.step() * place as f64) * range - Point::new(ahead_m, 0.0);
            Some((at.length(), self.ranges[sector(at.angle(), self.ranges.len())]?))
        });
        self.mean(pairs)
    }

    fn heard(&self) -> impl Iterator<Item = (usize, f64)> + '_ {
        self.ranges.iter().enumerate().filter_map(|(place, range)| Some((place, (*range)?)))
    }

    fn mean(&self, pairs: impl Iterator<Item = (f64, f64)>) -> Option<f64> {
        let all: Vec<f64> = pairs.map(|(one, other)| (one - other).abs().min(DIFFERENT_M)).collect();
        (all.len() * 4 >= self.ranges.len()).then(|| all.iter().sum::<f64>() / all.len() as f64)
    }
}

/// The direction nearest to a bearing, by number from ahead, counter-clockwise.
fn sector(bearing: f64, directions: usize) -> usize {
    (bearing.rem_euclid(TAU) / TAU * directions as f64).round() as usize % directions
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::navigation::body::message::{Echo, Place};

    const AT: Place = Place { x_m: 0.0, y_m: 0.0, heading_rad: 0.0 };

    /// A scan of eight directions, the first of them ahead.
    fn scan(ranges: [f64; 8]) -> Scan {
        let echo = |(place, range): (usize, f64)| Echo {
            bearing_rad: TAU * place as f64 / 8.0,
            range_m: Some(range),
            odometry: AT,
        };
        let readings = ranges.into_iter().enumerate().map(echo).collect();
        let senses = Senses {
            time_s: 1.0,
            odometry: AT,
            readings,
            contact: None,
            is_busy: false,
            shape: String::new(),
        };
        Scan::of(&[senses], 8)
    }

    #[test]
    fn after_a_turn_to_the_left_what_was_seen_is_farther_to_the_right() {
        let before = scan([1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0, 8.0]);
        let after = scan([2.0, 3.0, 4.0, 5.0, 6.0, 7.0, 8.0, 1.0]);
        assert_eq!(after.differs_turned(&before, 1), Some(0.0));
        assert!(after.differs_turned(&before, -1) > Some(0.4));
        assert_eq!(before.nearest(), Some((0.0, 1.0)));
    }

    #[test]
    fn after_a_move_ahead_a_wall_there_is_nearer_and_one_behind_farther_away() {
        let (before, after) =
            (scan([2.0, 2.5, 2.0, 2.5, 2.0, 2.5, 2.0, 2.5]), scan([1.7, 2.3, 2.0, 2.7, 2.3, 2.7, 2.0, 2.3]));
        assert!(after.differs_moved(&before, 0.3) < after.differs_moved(&before, -0.3));
    }

    #[test]
    fn bearings_a_hair_below_a_whole_turn_are_ahead() {
        assert_eq!((sector(-1e-18, 8), sector(TAU, 8), sector(-TAU, 8)), (0, 0, 0));
    }
}
