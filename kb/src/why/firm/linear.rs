//! Weights between two values of a cell, where they are linear in it.

use adit_planners::routes::Walking;

use super::Weights;

/// To such a share of its size a weight must be where the line says.
const STRAIGHT: f64 = 1e-9;

/// Weights on a line through two values of a cell.
pub struct Line {
    from: (f64, Weights),
    to: (f64, Weights),
}

impl Line {
    pub fn new(from: (f64, Weights), to: (f64, Weights)) -> Self {
        Self { from, to }
    }

    /// Through two values, if a third one between them lies on it.
    pub fn through(from: (f64, Weights), between: (f64, &Weights), to: (f64, Weights)) -> Option<Self> {
        let line = Self { from, to };
        line.holds(between.0, between.1).then_some(line)
    }

    /// Whether weights at a value are where the line says.
    pub fn holds(&self, value: f64, weights: &Weights) -> bool {
        let Some(said) = self.at(value) else { return false };
        let near = |one: f64, two: f64, scale: f64| {
            one.total_cmp(&two).is_eq() || (one - two).abs() <= STRAIGHT * scale.max(one.abs()).max(1e-300)
        };
        let rooms = said.rooms.iter().zip(&weights.rooms).zip(&self.to.1.rooms);
        let mut same_rooms = rooms.map(|((one, two), far)| match (one, two, far) {
            (Walking::PerMetre(one), Walking::PerMetre(two), Walking::PerMetre(far)) => {
                near(*one, *two, far.abs())
            }
            (one, two, _) => one == two,
        });
        let mut doors = said.doors.iter().zip(&weights.doors).zip(&self.to.1.doors);
        let is_same = |((one, two), far): ((&f64, &f64), &f64)| {
            near(*one, *two, if far.is_finite() { far.abs() } else { 0.0 })
        };
        same_rooms.all(|same| same) && doors.all(is_same)
    }

    /// The weights at a value; `None` where the two values have another kind of weight for something.
    pub fn at(&self, value: f64) -> Option<Weights> {
        let (x0, x1) = (self.from.0, self.to.0);
        let share = (value - x0) / (x1 - x0);
        let between = |one: f64, two: f64| {
            if one.total_cmp(&two).is_eq() {
                Some(one)
            } else {
                (one.is_finite() && two.is_finite()).then_some(one + (two - one) * share)
            }
        };
        let rooms = self.from.1.rooms.iter().zip(&self.to.1.rooms).map(|pair| match pair {
            (Walking::PerMetre(one), Walking::PerMetre(two)) => {
                Some(Walking::PerMetre(between(*one, *two)?.max(0.0)))
            }
            (one, two) => (one == two).then_some(*one),
        });
        let rooms: Option<Vec<Walking>> = rooms.collect();
        let doors = self.from.1.doors.iter().zip(&self.to.1.doors);
        let doors: Option<Vec<f64>> = doors.map(|(one, two)| Some(between(*one, *two)?.max(0.0))).collect();
        Some(Weights { rooms: rooms?, doors: doors? })
    }
}
