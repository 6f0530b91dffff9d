//! Local path planning: round an obstacle on the left and on the right (Crowley 1985, section 4.6).

use super::field::{Field, Ground};
use super::highway::free_ahead;
use crate::geometry::{Point, Rect, Segment, cross, path_length};

/// The two senses round an obstacle.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Detours {
    pub left: Option<Vec<Point>>,
    pub right: Option<Vec<Point>>,
}

impl Detours {
    pub fn shortest_m(&self) -> Option<f64> {
        self.left.iter().chain(&self.right).map(|points| path_length(points)).min_by(f64::total_cmp)
    }
}

impl Ground<'_> {
    /// The shortest paths that leave the obstacle to the right (`left`), and to the left (`right`).
    pub fn detours(&self, from: Point, to: Point) -> Detours {
        let field = Field::new(Rect::around([from, to]).grown(self.aside), self);
        let Some(best) = field.path(from, to) else { return Detours::default() };
        let Some([left, right]) = self.cuts(from, to) else {
            return Detours { left: Some(best), right: None };
        };
        let crosses = |cut: &Segment| best.windows(2).any(|leg| Segment::new(leg[0], leg[1]).meets(cut));
        if crosses(&left) || (!crosses(&right) && lies_left(from, to, &best)) {
            Detours { right: field.cut(&left).path(from, to), left: Some(best) }
        } else {
            Detours { left: field.cut(&right).path(from, to), right: Some(best) }
        }
    }

    /// Lines from the obstacle that is met first to what is next on its left, and on its right.
    fn cuts(&self, from: Point, to: Point) -> Option<[Segment; 2]> {
        let free = free_ahead(&self.rim, from, to, [self.least, self.reach], self.barriers);
        let met = free.by?;
        let whole = from.distance(to);
        let ahead = Segment::new(from, to).direction();
        let root = self.barriers[met].nearest_to(from + ahead * free.metres);
        let group = self.group(met);
        let far = |towards: Point| {
            let others = self.barriers.iter().enumerate().filter(|(index, _)| !group[*index]);
            let hits = others.filter_map(|(_, barrier)| barrier.hit(root, towards));
            hits.map(|(range, _)| range).fold(whole + self.aside, f64::min)
        };
        let cut = |towards: Point| Segment::new(root, root + towards * far(towards));
        Some([cut(ahead.perpendicular()), cut(-ahead.perpendicular())])
    }

    /// The barriers that are one obstacle with the one met: the robot does not fit between them.
    fn group(&self, met: usize) -> Vec<bool> {
        let mut group = vec![false; self.barriers.len()];
        group[met] = true;
        let width = 2.0 * (self.rim.inner_m() - self.rim.radius_m() + self.reach);
        let mut open = if met < self.obstacles_from { Vec::new() } else { vec![met] };
        while let Some(one) = open.pop() {
            let a = self.barriers[one];
            for (other, b) in self.barriers.iter().enumerate().skip(self.obstacles_from) {
                if !group[other] && a.gap(b) < width {
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
    let aside = |&p: &Point| cross(from, to, p);
    path.iter().map(aside).sum::<f64>() > 0.0
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::rim::Rim;

    const ENDS: [Point; 2] = [Point::new(0.0, 0.0), Point::new(4.0, 0.0)];

    fn line(x0: f64, y0: f64, x1: f64, y1: f64) -> Segment {
        Segment::new(Point::new(x0, y0), Point::new(x1, y1))
    }

    /// Walls on both sides of the way, and a screen across it from `low` to `high`.
    fn detours(low: f64, high: f64) -> Detours {
        let barriers = [line(-1.0, 2.0, 5.0, 2.0), line(-1.0, -2.0, 5.0, -2.0), line(2.0, low, 2.0, high)];
        let ground = Ground {
            barriers: &barriers,
            obstacles_from: 2,
            rim: Rim::disc(0.25),
            reach: 0.3,
            least: 0.25,
            aside: 2.0,
            grain: 0.04,
        };
        ground.detours(ENDS[0], ENDS[1])
    }

    #[test]
    fn an_obstacle_is_passed_in_both_senses() {
        let Detours { left: Some(left), right: Some(right) } = detours(-0.5, 0.8) else {
            panic!("both are free")
        };
        assert!(left.iter().any(|p| p.y >= 1.1) && left.iter().all(|p| p.y > -0.1));
        assert!(right.iter().any(|p| p.y <= -0.8) && right.iter().all(|p| p.y < 0.1));
        // by Pythagoras, and a little for the grain
        let shortest = 2.0 * 2.0_f64.hypot(0.8);
        assert!((shortest..1.05 * shortest).contains(&path_length(&right)), "{}", path_length(&right));
    }

    #[test]
    fn a_gap_that_is_too_narrow_is_no_detour() {
        let found = detours(-1.45, 0.5);
        assert!(found.left.is_some() && found.right.is_none());
        assert_eq!(detours(-1.45, 1.45), Detours::default());
    }
}
