//! Weights between two values of a cell, where they are linear in it.

use std::sync::Arc;

use adit_planners::routes::Walking;

use super::Weights;

/// To such a share of its size a weight must be where the line says.
const STRAIGHT: f64 = 1e-9;

/// Weights on a line through two values of a cell.
pub struct Line {
    from: (f64, Arc<Weights>),
    to: f64,
    /// What weighs otherwise at the other value, by index.
    rooms: Vec<(usize, Walking)>,
    doors: Vec<(usize, f64)>,
}

impl Line {
    pub fn new(from: (f64, Arc<Weights>), to: (f64, &Weights)) -> Self {
        let rooms = from.1.rooms.iter().zip(&to.1.rooms).enumerate();
        let rooms = rooms.filter(|(_, (one, two))| one != two).map(|(room, (_, two))| (room, *two)).collect();
        let doors = from.1.doors.iter().zip(&to.1.doors).enumerate();
        let doors = doors.filter(|(_, (one, two))| one.total_cmp(two).is_ne());
        let doors = doors.map(|(door, (_, two))| (door, *two)).collect();
        Self { from, to: to.0, rooms, doors }
    }

    /// Through two values, if a third one between them lies on it.
    pub fn through(from: (f64, Weights), between: (f64, &Weights), to: (f64, &Weights)) -> Option<Self> {
        let line = Self::new((from.0, Arc::new(from.1)), to);
        line.holds(between.0, between.1).then_some(line)
    }

    /// The first value with its weights, and the other one.
    pub fn ends(&self) -> [(f64, Weights); 2] {
        let (from, to) = (self.from.0, self.to);
        [
            (from, Weights::clone(&self.from.1)),
            (to, self.at(to).unwrap_or_else(|| Weights::clone(&self.from.1))),
        ]
    }

    /// How many rooms and doors weigh otherwise.
    pub fn size(&self) -> usize {
        self.rooms.len() + self.doors.len()
    }

    /// Whether everything weighs the same at both values.
    pub fn is_level(&self) -> bool {
        self.size() == 0
    }

    /// Whether weights at a value are where the line says.
    pub fn holds(&self, value: f64, weights: &Weights) -> bool {
        let Some(said) = self.at(value) else { return false };
        let near = |one: f64, two: f64, from: f64| {
            let scale = if from.is_finite() { from.abs() } else { 0.0 };
            one.total_cmp(&two).is_eq() || (one - two).abs() <= STRAIGHT * scale.max(one.abs()).max(1e-300)
        };
        let rooms = said.rooms.iter().zip(&weights.rooms).zip(&self.from.1.rooms);
        let mut same_rooms = rooms.map(|((one, two), from)| match (one, two, from) {
            (Walking::PerMetre(one), Walking::PerMetre(two), Walking::PerMetre(from)) => {
                near(*one, *two, *from)
            }
            (one, two, _) => one == two,
        });
        let mut doors = said.doors.iter().zip(&weights.doors).zip(&self.from.1.doors);
        same_rooms.all(|same| same) && doors.all(|((one, two), from)| near(*one, *two, *from))
    }

    /// The weights at a value; `None` where the two values have another kind of weight for something.
    pub fn at(&self, value: f64) -> Option<Weights> {
        let mut weights = Weights::clone(&self.from.1);
        for &(room, two) in &self.rooms {
            let (Walking::PerMetre(one), Walking::PerMetre(two)) = (weights.rooms[room], two) else {
                return None;
            };
            weights.rooms[room] = Walking::PerMetre(self.between(one, two, value)?);
        }
        for &(door, two) in &self.doors {
            weights.doors[door] = self.between(weights.doors[door], two, value)?;
        }
        Some(weights)
    }

    fn between(&self, one: f64, two: f64, value: f64) -> Option<f64> {
        let share = (value - self.from.0) / (self.to - self.from.0);
        (one.is_finite() && two.is_finite()).then_some((one + (two - one) * share).max(0.0))
    }

    /// Makes everything weigh no more than at a value; nothing where it would weigh more there.
    ///
    /// # Arguments
    /// `least` holds what everything weighs at most so far.
    pub fn lower(&self, value: f64, least: &mut Weights) {
        for &(room, two) in &self.rooms {
            if let (Walking::PerMetre(one), Walking::PerMetre(two)) = (self.from.1.rooms[room], two)
                && let (Some(there), Walking::PerMetre(known)) =
                    (self.between(one, two, value), least.rooms[room])
            {
                least.rooms[room] = Walking::PerMetre(known.min(there));
            }
        }
        for &(door, two) in &self.doors {
            if let Some(there) = self.between(self.from.1.doors[door], two, value) {
                least.doors[door] = least.doors[door].min(there);
            }
        }
    }
}
