//! Free way for a robot that goes straight, as it stands.

use crate::geometry::tolerance::ROUNDING_M;
use crate::geometry::{Point, Segment};
use crate::rim::Rim;

/// A robot that is nearer to a surface than it should be may go along it; so much nearer it may come, metres.
const SLIDE_M: f64 = 0.005;

/// How far a robot gets is found so finely, metres: no wheels are stopped more finely.
const FINE_M: f64 = 1e-4;

#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Free {
    /// Metres; no more than to the goal point.
    pub metres: f64,
    /// What it meets then, by index.
    pub by: Option<usize>,
}

/// How far the middle of a robot can go from one point towards another before it is [nearer](Rim::distance) than `reach` to a
/// barrier. Where it is nearer from the start, it may go along or away; where the goal is nearer, it may come as near, but no nearer
/// than `least`.
pub(super) fn free_ahead(
    rim: &Rim,
    from: Point,
    to: Point,
    [least, reach]: [f64; 2],
    barriers: &[Segment],
) -> Free {
    let whole = from.distance(to);
    let mut free = Free { metres: whole, by: None };
    for (index, barrier) in barriers.iter().enumerate() {
        if is_far(rim, (from, to), reach, barrier) {
            continue;
        }
        let reach = reach.min(rim.distance(to, barrier).max(least));
        if let Some(metres) = hit(rim, (from, to), reach, barrier).filter(|metres| *metres < free.metres) {
            free = Free { metres, by: Some(index) };
        }
    }
    free
}

/// Whether a robot can go straight from one point to another, nowhere nearer to a barrier than `reach`; than at its ends,
/// where those are nearer.
pub(super) fn is_clear(rim: &Rim, from: Point, to: Point, reach: f64, barriers: &[Segment]) -> bool {
    barriers.iter().all(|barrier| {
        is_far(rim, (from, to), reach, barrier) || {
            let least = reach.min(rim.distance(from, barrier)).min(rim.distance(to, barrier));
            rim.way_distance(&Segment::new(from, to), barrier) >= least - ROUNDING_M
        }
    })
}

/// The points of a way that are left where it goes straight to the farthest that can be reached so, again and again.
pub(super) fn straightened(points: &[Point], is_clear: impl Fn(Point, Point) -> bool) -> Vec<Point> {
    let mut kept: Vec<Point> = points.first().copied().into_iter().collect();
    let mut at = 0;
    while at + 1 < points.len() {
        let farthest = (at + 2..points.len()).rev().find(|&next| is_clear(points[at], points[next]));
        at = farthest.unwrap_or(at + 1);
        kept.push(points[at]);
    }
    kept
}

fn hit(rim: &Rim, (from, to): (Point, Point), reach: f64, barrier: &Segment) -> Option<f64> {
    if is_far(rim, (from, to), reach, barrier) {
        return None;
    }
    let nearest = rim.way_distance(&Segment::new(from, to), barrier);
    let now = rim.distance(from, barrier);
    if now < reach {
        return (nearest < now - SLIDE_M).then_some(0.0);
    }
    // what is only just far enough away may be slid along, too
    let reach = reach.min(now - SLIDE_M);
    (nearest < reach).then(|| first_within(rim, (from, to), reach, barrier))
}

/// The distance to a segment falls until it is least, and then rises: a point before that is found by halving.
fn first_within(rim: &Rim, (from, to): (Point, Point), reach: f64, barrier: &Segment) -> f64 {
    let whole = from.distance(to);
    let (mut low, mut high) = (0.0, whole);
    while high - low > FINE_M {
        let middle = f64::midpoint(low, high);
        let way = Segment::new(from, from.lerp(to, middle / whole));
        let is_met = rim.way_distance(&way, barrier) < reach;
        (low, high) = if is_met { (low, middle) } else { (middle, high) };
    }
    low
}

fn is_far(rim: &Rim, (from, to): (Point, Point), reach: f64, barrier: &Segment) -> bool {
    let (dx, dy) = Segment::new(from, to).bounds().axis_gaps(&barrier.bounds());
    dx.max(dy) > reach + rim.core_m()
}

#[cfg(test)]
mod tests {
    use super::*;

    const EAST: [Point; 2] = [Point::new(0.0, 0.0), Point::new(4.0, 0.0)];

    fn ahead(barrier: [f64; 4]) -> f64 {
        let [x0, y0, x1, y1] = barrier;
        let barrier = Segment::new(Point::new(x0, y0), Point::new(x1, y1));
        free_ahead(&Rim::disc(0.3), EAST[0], EAST[1], [0.3, 0.3], &[barrier]).metres
    }

    #[test]
    fn a_wall_across_stops_the_disc_before_its_middle_is_there() {
        assert!((ahead([2.0, -1.0, 2.0, 1.0]) - 1.7).abs() < 1e-3);
        assert!((ahead([2.0, 0.18, 2.0, 1.0]) - 1.76).abs() < 1e-3);
    }

    #[test]
    fn what_is_beside_or_beyond_is_not_in_the_way() {
        assert!((ahead([0.0, 0.31, 4.0, 0.31]) - 4.0).abs() < 1e-9);
        assert!((ahead([4.31, -1.0, 4.31, 1.0]) - 4.0).abs() < 1e-9);
        assert!((ahead([-1.0, -1.0, -1.0, 1.0]) - 4.0).abs() < 1e-9);
    }

    #[test]
    fn a_goal_near_a_wall_may_be_gone_to_as_far_as_the_disc_fits() {
        let beside = |y: f64| Segment::new(Point::new(3.5, y), Point::new(5.0, y));
        let free = |y: f64| free_ahead(&Rim::disc(0.3), EAST[0], EAST[1], [0.25, 0.3], &[beside(y)]).metres;
        assert!((free(0.26) - 4.0).abs() < 1e-9);
        assert!(free(0.24) < 3.5);
    }

    #[test]
    fn a_disc_too_near_may_go_along_and_away_but_not_on() {
        assert!((ahead([0.0, 0.28, 4.0, 0.28]) - 4.0).abs() < 1e-9);
        assert!((ahead([-0.2, -1.0, -0.2, 1.0]) - 4.0).abs() < 1e-9);
        assert!(ahead([0.28, -1.0, 0.28, 1.0]) < 1e-9);
        assert!(ahead([-1.0, 0.29, 4.0, 0.0]) < 1e-9);
    }
}
