//! Walls cut where they cross, so that they meet at ends only.

use std::collections::{BTreeMap, BTreeSet};

use crate::geometry::{Point, Segment};

/// Ends lie on a lattice of this grain, so that what nearly meets does meet, metres.
const LATTICE_M: f64 = 0.001;

/// A wall that passes an end of another one so closely leads through it, metres.
const REACH_M: f64 = 0.005;

/// A piece that passes an end so closely leads through it, in grains. Less than half a diagonal of the lattice: a piece that
/// could go round both sides of a square would be cut for ever.
const TOUCH: f64 = 0.7;

/// An end that runs past another wall by no more than this is left out, metres.
const STUB_M: f64 = 0.2;

/// Cutting moves ends by less than the lattice's grain, and may make walls cross anew; after so many rounds none do.
const ROUNDS: usize = 50;

type Knot = [i64; 2];
/// A piece by its ends, the smaller one first.
type Piece = [Knot; 2];

/// The same walls in pieces that meet at ends only, each once, without the stubs that run past others.
pub(super) fn pieces(walls: &[Segment]) -> Vec<Segment> {
    let mut pieces: BTreeSet<Piece> = (0..walls.len()).flat_map(|index| parts(walls, index)).collect();
    settle(&mut pieces);
    without_stubs(&mut pieces);
    pieces.iter().map(segment).collect()
}

/// The parts of a wall between those that it meets. Ends are rounded only when it is cut: rounding first would part walls
/// that meet.
fn parts(walls: &[Segment], index: usize) -> Vec<Piece> {
    let wall = &walls[index];
    let along = wall.direction();
    let far = |p: Point| (p - wall.a).dot(along);
    let mut stops = vec![wall.a, wall.b];
    for (number, other) in walls.iter().enumerate().filter(|(number, _)| *number != index) {
        stops.extend([other.a, other.b].into_iter().filter(|end| wall.distance(*end) <= REACH_M));
        // Where two walls cross has to be the same point for both of them, to the bit.
        let (first, second) = if index < number { (wall, other) } else { (other, wall) };
        stops.extend(across(first, second));
    }
    stops.sort_by(|a, b| far(*a).total_cmp(&far(*b)));
    let knots: Vec<Knot> = stops.into_iter().map(knot).collect();
    knots.windows(2).filter_map(|ends| piece(ends[0], ends[1])).collect()
}

fn settle(pieces: &mut BTreeSet<Piece>) {
    for _ in 0..ROUNDS {
        let cut = cut(pieces);
        if cut == *pieces {
            break;
        }
        *pieces = cut;
    }
}

/// How many pieces meet at each end.
fn meeting(pieces: &BTreeSet<Piece>) -> BTreeMap<Knot, usize> {
    let mut meeting = BTreeMap::new();
    for end in pieces.iter().flatten() {
        *meeting.entry(*end).or_default() += 1;
    }
    meeting
}

fn knot(p: Point) -> Knot {
    [p.x, p.y].map(|value| (value / LATTICE_M).round() as i64)
}

fn point(knot: Knot) -> Point {
    let [x, y] = knot.map(|value| value as f64 * LATTICE_M);
    Point::new(x, y)
}

fn piece(a: Knot, b: Knot) -> Option<Piece> {
    (a != b).then(|| [a.min(b), a.max(b)])
}

fn segment(piece: &Piece) -> Segment {
    Segment::new(point(piece[0]), point(piece[1]))
}

fn cut(pieces: &BTreeSet<Piece>) -> BTreeSet<Piece> {
    let mut cut = BTreeSet::new();
    for one in pieces {
        let wall = segment(one);
        let mut stops = vec![one[0], one[1]];
        for other in pieces.iter().filter(|other| *other != one && are_near(one, other)) {
            stops.extend(other.iter().filter(|end| is_on(point(**end), &wall)));
            stops.extend(crossing(one.min(other), one.max(other)));
        }
        let far = |stop: &Knot| wall.a.distance(point(*stop));
        stops.sort_by(|a, b| far(a).total_cmp(&far(b)));
        cut.extend(stops.windows(2).filter_map(|ends| piece(ends[0], ends[1])));
    }
    cut
}

/// Where two pieces cross; for both of them it has to be the same to the bit.
fn crossing(one: &Piece, other: &Piece) -> Option<Knot> {
    if one.iter().any(|end| other.contains(end)) {
        return None;
    }
    across(&segment(one), &segment(other)).map(knot)
}

/// Where two walls cross. Those along one line do not, though rounding may let them meet anywhere on it.
fn across(wall: &Segment, other: &Segment) -> Option<Point> {
    let along = wall.direction();
    let (far, _) = other.hit(wall.a, along).filter(|(far, _)| *far < wall.length())?;
    let at = wall.a + along * far;
    (other.distance(at) < LATTICE_M).then_some(at)
}

/// Whether a point lies on a wall, up to the grain, and beside none of its ends.
fn is_on(p: Point, wall: &Segment) -> bool {
    let (along, length) = (wall.direction(), wall.length());
    let place = (p - wall.a).dot(along);
    (0.0..length).contains(&place) && wall.distance(p) <= TOUCH * LATTICE_M
}

fn are_near(one: &Piece, other: &Piece) -> bool {
    (0..2).all(|axis| {
        let span = |piece: &Piece| (piece[0][axis].min(piece[1][axis]), piece[0][axis].max(piece[1][axis]));
        let ((a, b), (c, d)) = (span(one), span(other));
        a <= d + 1 && c <= b + 1
    })
}

/// Takes out short pieces that end free at one end and on more than one other piece at the other.
fn without_stubs(pieces: &mut BTreeSet<Piece>) {
    let meeting = meeting(pieces);
    pieces.retain(|piece| {
        let [least, most] =
            [meeting[&piece[0]].min(meeting[&piece[1]]), meeting[&piece[0]].max(meeting[&piece[1]])];
        segment(piece).length() > STUB_M || least > 1 || most < 3
    });
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;
    use crate::floor_plan::{Drawn, FloorPlan};

    fn wall(x0: f64, y0: f64, x1: f64, y1: f64) -> Segment {
        Segment::new(Point::new(x0, y0), Point::new(x1, y1))
    }

    #[test]
    fn what_runs_a_little_past_a_wall_is_left_out_and_what_ends_free_stays() {
        // A wall across, one that runs past it by 10 cm, and one that ends 1 m beyond.
        let walls = [wall(0.0, 0.0, 4.0, 0.0), wall(1.0, -0.1, 1.0, 2.0), wall(3.0, -1.0, 3.0, 2.0)];
        let lengths: f64 = pieces(&walls).iter().map(Segment::length).sum();
        assert!((lengths - 9.0).abs() < 1e-6, "{lengths}");
    }

    #[test]
    fn walls_that_meet_still_meet_when_their_ends_are_rounded() {
        // The second wall ends on a slanting one; the third goes on from there.
        let foot = Point::new(1.234_567, 0.123_456_7 * 2.0);
        let walls = [
            wall(0.0, 0.0, 2.0 * foot.x, 2.0 * foot.y),
            Segment::new(foot, Point::new(1.0, 3.0)),
            Segment::new(foot, Point::new(1.0, -3.0)),
        ];
        let pieces = pieces(&walls);
        let at_foot = pieces.iter().filter(|piece| [piece.a, piece.b].contains(&point(knot(foot))));
        assert_eq!((pieces.len(), at_foot.count()), (4, 4), "{pieces:?}");
    }

    /// Twice the area of a triangle, above 0 where the last corner lies left of the first side.
    fn turn(a: Knot, b: Knot, c: Knot) -> i64 {
        (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])
    }

    fn do_cross([a, b]: Piece, [c, d]: Piece) -> bool {
        turn(a, b, c).signum() * turn(a, b, d).signum() < 0
            && turn(c, d, a).signum() * turn(c, d, b).signum() < 0
    }

    fn is_inside(p: Knot, [a, b]: Piece) -> bool {
        let along = (p[0] - a[0]) * (b[0] - p[0]) + (p[1] - a[1]) * (b[1] - p[1]);
        turn(a, b, p) == 0 && along > 0
    }

    proptest! {
        #[test]
        fn pieces_meet_at_ends_only_and_are_walls_of_a_floor_plan(
            ends in prop::collection::vec([0.0..3.0_f64, 0.0..3.0, 0.0..3.0, 0.0..3.0], 1..12)
        ) {
            let mut walls: Vec<Segment> = ends.iter().map(|[x0, y0, x1, y1]| wall(*x0, *y0, *x1, *y1)).collect();
            let frame = [[-1.0, -1.0], [4.0, -1.0], [4.0, 4.0], [-1.0, 4.0], [-1.0, -1.0]];
            walls.extend(frame.windows(2).map(|side| wall(side[0][0], side[0][1], side[1][0], side[1][1])));
            let pieces = pieces(&walls);
            let knots: Vec<Piece> = pieces.iter().map(|piece| [knot(piece.a), knot(piece.b)]).collect();
            for (index, one) in knots.iter().enumerate() {
                for other in &knots[index + 1..] {
                    prop_assert!(!do_cross(*one, *other), "{one:?} crosses {other:?}");
                    let is_on = one.iter().any(|end| is_inside(*end, *other)) || other.iter().any(|end| is_inside(*end, *one));
                    prop_assert!(!is_on, "{one:?} ends on {other:?}");
                }
            }
            let walls = pieces.iter().map(|piece| [piece.a, piece.b]).collect();
            let plan = FloorPlan::around(Drawn { walls, ..Drawn::default() }, Point::new(-0.5, -0.5));
            prop_assert!(plan.is_ok(), "{:?}", plan.err());
        }
    }
}
