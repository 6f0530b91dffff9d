//! What no person would do on the way: found, not judged by eye.

use adit_planners::geometry::Point;

use super::space::Space;
use super::way::{Piece, Way};

/// A state that is held for less is a stumble, unless it has to be, metres.
const STUMBLE: f64 = 0.3;

/// What a turn must save if left out before anybody would see it, in hardness.
const SEEN: f64 = 0.01;

/// Something that no person would do.
#[derive(Clone, Debug, PartialEq)]
pub struct Silly {
    /// Where.
    pub at: Point,
    /// What.
    pub what: String,
}

/// What is silly about a way. `exact` is the true free space; of what is free in `fair` the layers of cells of `side`
/// metres know, too.
pub fn find(way: &Way, [exact, fair]: [&Space; 2], side: f64) -> Vec<Silly> {
    let mut found = stumbles(way, exact, fair);
    let pieces: Vec<Piece> = way.pieces().filter(|piece| piece.from != piece.to).collect();
    for pair in pieces.windows(2).filter(|pair| pair[0].state == pair[1].state) {
        let (a, b) = (pair[0].from, pair[1].to);
        let state = pair[0].state;
        let weigh = |piece: &Piece| exact.weigh(state, piece.from, piece.to);
        let gain = weigh(&pair[0]) + weigh(&pair[1]) - exact.weigh(state, a, b);
        if gain > SEEN && fair.is_free(state, a, b) {
            let what = format!("a turn that saves {gain:.3} if left out");
            found.push(Silly { at: pair[0].to, what });
        }
    }
    // Short pieces along an arc are no fault; a short one between two long ones that could be left out is.
    for piece in &pieces {
        let length = piece.from.distance(piece.to);
        if length < side / 10.0 {
            found.push(Silly { at: piece.from, what: format!("two waypoints {length:.5} m apart") });
        }
    }
    found
}

/// States that are held only for a moment, though the state before or after would do and cost no more.
fn stumbles(way: &Way, exact: &Space, fair: &Space) -> Vec<Silly> {
    let pieces: Vec<Piece> = way.pieces().collect();
    let mut found = Vec::new();
    let mut first = 0;
    for run in pieces.chunk_by(|a, b| a.state == b.state) {
        let next = first + run.len();
        let length: f64 = run.iter().map(|piece| piece.from.distance(piece.to)).sum();
        let around =
            [first.checked_sub(1).map(|i| pieces[i].state), pieces.get(next).map(|piece| piece.state)];
        let body = exact.body();
        let (state, [before, after]) = (run[0].state, around);
        let change = |from: Option<usize>, to: Option<usize>| match (from, to) {
            (Some(from), Some(to)) if from != to => body.change(from, to),
            _ => 0.0,
        };
        let price = |held: usize| {
            let metres = run.iter().map(|piece| exact.weigh(held, piece.from, piece.to));
            change(before, Some(held)) + metres.sum::<f64>() + change(Some(held), after)
        };
        let would_do = |&other: &usize| {
            price(other) <= price(state) && run.iter().all(|piece| fair.is_free(other, piece.from, piece.to))
        };
        if let Some(other) = around.into_iter().flatten().find(would_do).filter(|_| length < STUMBLE) {
            let named = |state: Option<usize>| state.map_or("nothing", |state| &body.states[state].name);
            let saved = price(state) - price(other);
            let what = format!(
                "{} for {length:.3} m between {} and {}, where {} saves {saved:.3}",
                named(Some(state)),
                named(before),
                named(after),
                named(Some(other))
            );
            found.push(Silly { at: run[0].from, what });
        }
        first = next;
    }
    found
}
