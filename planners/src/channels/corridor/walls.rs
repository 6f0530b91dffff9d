//! Walls: the outline of all channels together.

use crate::geometry::{Point, Rect};

/// A piece of wall, along x or y; `a` is its end with the smaller coordinates.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Wall {
    pub a: Point,
    pub b: Point,
}

/// The outline of the union of rectangles, in pieces as long as they can be.
pub(super) fn outline(rects: &[Rect]) -> Vec<Wall> {
    let turned: Vec<Rect> = rects.iter().map(|r| Rect::new(r.y0, r.x0, r.y1, r.x1)).collect();
    let upright = upright(rects).into_iter().map(|(x, from, to)| (Point::new(x, from), Point::new(x, to)));
    let lying = self::upright(&turned);
    let lying = lying.into_iter().map(|(y, from, to)| (Point::new(from, y), Point::new(to, y)));
    upright.chain(lying).map(|(a, b)| Wall { a, b }).collect()
}

/// The upright pieces: `x`, from where, to where.
fn upright(rects: &[Rect]) -> Vec<(f64, f64, f64)> {
    let mut pieces = Vec::new();
    for rect in rects {
        // what lies just to the left of a left edge, or to the right of a right one, is free where a rectangle holds it
        let left = rects.iter().filter(|other| other.x0 < rect.x0 && rect.x0 <= other.x1);
        let right = rects.iter().filter(|other| other.x0 <= rect.x1 && rect.x1 < other.x1);
        pieces.extend(closed(rect, left).into_iter().map(|(from, to)| (rect.x0, from, to)));
        pieces.extend(closed(rect, right).into_iter().map(|(from, to)| (rect.x1, from, to)));
    }
    pieces.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.total_cmp(&b.1)));
    let mut joined: Vec<(f64, f64, f64)> = Vec::with_capacity(pieces.len());
    for piece in pieces {
        match joined.last_mut() {
            Some(last) if last.0.total_cmp(&piece.0).is_eq() && piece.1 <= last.2 => {
                last.2 = last.2.max(piece.2);
            }
            _ => joined.push(piece),
        }
    }
    joined
}

/// What of a rectangle's range of y no opening covers.
fn closed<'a>(rect: &Rect, openings: impl Iterator<Item = &'a Rect>) -> Vec<(f64, f64)> {
    let mut openings: Vec<(f64, f64)> = openings.map(|opening| (opening.y0, opening.y1)).collect();
    openings.sort_by(|a, b| a.0.total_cmp(&b.0));
    let (mut from, mut pieces) = (rect.y0, Vec::new());
    for (opens, ends) in openings {
        if opens > from {
            pieces.push((from, opens.min(rect.y1)));
        }
        from = from.max(ends);
        if from >= rect.y1 {
            return pieces;
        }
    }
    pieces.push((from, rect.y1));
    pieces
}
