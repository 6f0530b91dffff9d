//! Local path planning: round an obstacle on the left and on the right (Crowley 1985, section 4.6).

use super::field::{Field, window};
use super::highway::free_ahead;
use crate::floor_plan::clear::distance_between;
use crate::geometry::Point;
use crate::segment::Segment;

/// What a detour is planned with.
#[derive(Clone, Copy, Debug)]
pub(super) struct Ground<'b> {
    /// Whatever the robot must not touch.
    pub barriers: &'b [Segment],
    /// From this index on they are obstacles, before it walls.
    pub obstacles_from: usize,
    /// What the robot's middle keeps from barriers, metres.
    pub reach: f64,
    /// What it keeps from barriers at the goal, at the least, metres.
    pub least: f64,
    /// By how much a detour may leave the rectangle about its ends, metres.
    pub aside: f64,
    /// The grain of the search, metres.
    pub grain: f64,
}

/// The two senses round an obstacle.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Detours {
    pub left: Option<Vec<Point>>,
    pub right: Option<Vec<Point>>,
}

impl Detours {
    /// The length of the shorter one.
    pub fn shortest_m(&self) -> Option<f64> {
        self.left.iter().chain(&self.right).map(|points| length(points)).min_by(f64::total_cmp)
    }
}

impl Ground<'_> {
    /// The shortest paths that leave the obstacle to the right (`left`), and to the left (`right`).
    pub fn detours(&self, from: Point, to: Point) -> Detours {
        let field = Field::new(window([from, to], self.aside), self);
        let Some(best) = field.path(from, to) else { return Detours::default() };
        let Some([left, right]) = self.cuts(from, to) else {
            return Detours { left: Some(best), right: None };
        };
        let crosses = |cut: &Segment| {
            best.windows(2).any(|leg| distance_between([leg[0], leg[1]], [cut.a, cut.b]) <= 0.0)
        };
        if crosses(&left) || (!crosses(&right) && lies_left(from, to, &best)) {
            Detours { right: field.cut(&left).path(from, to), left: Some(best) }
        } else {
            Detours { left: field.cut(&right).path(from, to), right: Some(best) }
        }
    }

    /// Lines from the obstacle that is met first to what is next on its left, and on its right.
    fn cuts(&self, from: Point, to: Point) -> Option<[Segment; 2]> {
        let free = free_ahead(from, to, [self.least, self.reach], self.barriers);
        let met = free.by?;
        let whole = from.distance(to);
        let (ux, uy) = ((to.x - from.x) / whole, (to.y - from.y) / whole);
        let stop = Point::new(from.x + free.metres * ux, from.y + free.metres * uy);
        let root = stop.nearest_on(self.barriers[met].a, self.barriers[met].b);
        let group = self.group(met);
        let far = |towards: Point| {
            let others = self.barriers.iter().enumerate().filter(|(index, _)| !group[*index]);
            let hits = others.filter_map(|(_, barrier)| barrier.hit(root, towards));
            hits.map(|(range, _)| range).fold(whole + self.aside, f64::min)
        };
        let cut = |towards: Point| {
            let range = far(towards);
            Segment::new(root, Point::new(root.x + range * towards.x, root.y + range * towards.y))
        };
        Some([cut(Point::new(-uy, ux)), cut(Point::new(uy, -ux))])
    }

    /// The barriers that are one obstacle with the one met: the robot does not fit between them.
    fn group(&self, met: usize) -> Vec<bool> {
        let mut group = vec![false; self.barriers.len()];
        group[met] = true;
        let mut open = if met < self.obstacles_from { Vec::new() } else { vec![met] };
        while let Some(one) = open.pop() {
            let a = self.barriers[one];
            for (other, b) in self.barriers.iter().enumerate().skip(self.obstacles_from) {
                if !group[other] && distance_between([a.a, a.b], [b.a, b.b]) < 2.0 * self.reach {
                    group[other] = true;
                    open.push(other);
                }
            }
        }
        group
    }
}

/// Whether most of a path lies left of the line between its ends.
fn lies_left(from: Point, to: Point, path: &[Point]) -> bool {
    let aside = |p: &Point| (to.x - from.x) * (p.y - from.y) - (to.y - from.y) * (p.x - from.x);
    path.iter().map(aside).sum::<f64>() > 0.0
}

/// The length of a path, metres.
pub(super) fn length(points: &[Point]) -> f64 {
    points.windows(2).map(|leg| leg[0].distance(leg[1])).sum()
}
