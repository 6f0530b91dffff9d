//! A way as driven: straight from point to point, each piece in one state.

use adit_planners::geometry::Point;

use super::body::Body;
use super::space::Space;

/// A way; at least one point.
#[derive(Clone, Debug, PartialEq)]
pub struct Way {
    /// Its points.
    pub points: Vec<Point>,
    /// The state of each piece; one fewer than points.
    pub states: Vec<usize>,
}

/// A piece of a way.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Piece {
    /// From here.
    pub from: Point,
    /// To here.
    pub to: Point,
    /// In this state.
    pub state: usize,
}

impl Way {
    /// Its straight pieces.
    pub fn pieces(&self) -> impl Iterator<Item = Piece> {
        let ends = self.points.iter().zip(self.points.iter().skip(1));
        ends.zip(&self.states).map(|((&from, &to), &state)| Piece { from, to, state })
    }

    /// Metres times hardness, and the changes of shape.
    pub fn cost(&self, space: &Space) -> f64 {
        let body = space.body();
        let metres = self.pieces().map(|piece| space.weigh(piece.state, piece.from, piece.to));
        let changes = self.states.windows(2).filter(|pair| pair[0] != pair[1]);
        metres.sum::<f64>() + changes.map(|pair| body.change(pair[0], pair[1])).sum::<f64>()
    }

    /// The piece that leaves its state's free space furthest, and by how many metres; `None` where none does so by
    /// more than `tolerance`.
    pub fn worst_trespass(&self, space: &Space, tolerance: f64) -> Option<(Piece, f64)> {
        let trespasses = self.pieces().map(|piece| (piece, -space.spare(piece.state, piece.from, piece.to)));
        trespasses.max_by(|a, b| a.1.total_cmp(&b.1)).filter(|worst| worst.1 > tolerance)
    }

    /// The same without points that are passed straight, in one state, and without changes there and back.
    #[must_use]
    pub fn without_idle_points(&self, body: &Body) -> Self {
        let mut way = Self { points: vec![self.points[0]], states: Vec::new() };
        for (number, piece) in self.pieces().enumerate() {
            if piece.from == piece.to && !self.is_between_changes(number, body) {
                continue;
            }
            if way.states.last() == Some(&piece.state) {
                let (a, b) = (way.points[way.points.len() - 2], piece.from);
                let turn = (b.x - a.x) * (piece.to.y - b.y) - (b.y - a.y) * (piece.to.x - b.x);
                let ahead = (b.x - a.x) * (piece.to.x - b.x) + (b.y - a.y) * (piece.to.y - b.y);
                if ahead >= 0.0 && turn.abs() <= 1e-12 * ahead {
                    way.points.pop();
                    way.states.pop();
                }
            }
            way.points.push(piece.to);
            way.states.push(piece.state);
        }
        way
    }

    /// Whether changing by way of this piece's state costs less than changing at once.
    fn is_between_changes(&self, number: usize, body: &Body) -> bool {
        let Some((before, after)) = number.checked_sub(1).zip(self.states.get(number + 1)) else {
            return false;
        };
        let (before, state, after) = (self.states[before], self.states[number], *after);
        before != after && body.change(before, state) + body.change(state, after) < body.change(before, after)
    }
}
