//! Convex outlines: of rooms, and of what two of them share.

use std::f64::consts::{FRAC_PI_2, PI, TAU};
use std::sync::Arc;

use smallvec::SmallVec;

use super::tolerance::{ROUNDING_M, SNAP_M};
use super::{Point, Rect, Sector, Segment, cross};

/// A convex polygon. A rectangle along the axes is kept as what it is, and everything about it is exact; of others
/// corners may lie a rounding inside of where they would be convex.
#[derive(Clone, Debug, PartialEq)]
pub struct Convex {
    bounds: Rect,
    /// Counterclockwise; `None` for a rectangle along the axes.
    corners: Option<Arc<[Point]>>,
}

/// Where a polygon lies by a line.
enum Cut {
    Left,
    Both,
    Right,
}

/// A convex polygon that is cut, line by line: most have few corners, and many are cut for each that is kept.
struct Part {
    bounds: Rect,
    is_rect: bool,
    corners: SmallVec<[Point; 16]>,
}

impl From<Rect> for Convex {
    fn from(bounds: Rect) -> Self {
        Self { bounds, corners: None }
    }
}

impl Convex {
    /// # Arguments
    /// `corners` are at least three, counterclockwise.
    pub fn new(corners: Vec<Point>) -> Self {
        let (bounds, is_rect) = about(&corners);
        Self { bounds, corners: (!is_rect).then(|| corners.into()) }
    }

    /// The least rectangle along the axes about it.
    pub fn bounds(&self) -> Rect {
        self.bounds
    }

    /// The rectangle along the axes that it is.
    pub fn rect(&self) -> Option<Rect> {
        self.corners.is_none().then_some(self.bounds)
    }

    /// Counterclockwise.
    pub fn corners(&self) -> impl Iterator<Item = Point> + Clone + '_ {
        let corners = self.all();
        (0..corners.count()).map(move |number| corners.at(number))
    }

    /// Counterclockwise, with the ground to the left.
    pub fn sides(&self) -> impl Iterator<Item = Segment> + Clone + '_ {
        let corners = self.all();
        let last = corners.count() - 1;
        let next = move |number: usize| if number == last { 0 } else { number + 1 };
        (0..=last).map(move |number| Segment::new(corners.at(number), corners.at(next(number))))
    }

    fn all(&self) -> Corners<'_> {
        match &self.corners {
            Some(corners) => Corners::Polygon(corners),
            None => Corners::Rect(self.bounds.corners()),
        }
    }

    fn count(&self) -> usize {
        self.corners.as_ref().map_or(4, |corners| corners.len())
    }

    fn corner(&self, number: usize) -> Point {
        self.all().at(number)
    }

    /// Whether a point lies inside or on the outline; of what is no rectangle, or a rounding beside it.
    pub fn contains(&self, p: Point) -> bool {
        match self.corners {
            None => self.bounds.contains(p),
            Some(_) => {
                self.bounds.grown(ROUNDING_M).contains(p)
                    && self.sides().all(|side| cross(side.a, side.b, p) >= -ROUNDING_M * side.length())
            }
        }
    }

    /// The point of it that is nearest to another one.
    pub fn nearest_to(&self, p: Point) -> Point {
        if self.corners.is_none() {
            return self.bounds.nearest_to(p);
        }
        if self.sides().all(|side| cross(side.a, side.b, p) >= 0.0) {
            return p;
        }
        let near = self.sides().map(|side| side.nearest_to(p));
        near.min_by(|one, two| one.squared_distance(p).total_cmp(&two.squared_distance(p))).unwrap_or(p)
    }

    /// Metres to a point; 0 inside.
    pub fn distance(&self, p: Point) -> f64 {
        self.nearest_to(p).distance(p)
    }

    /// The shares of the way between two points at which it comes in and leaves again (Cyrus and Beck 1978); `None`
    /// where at most a point of it lies inside. A way along a side, or a rounding beside it, lies inside.
    pub fn shares(&self, from: Point, to: Point) -> Option<(f64, f64)> {
        self.shares_near(from, to, ROUNDING_M)
    }

    fn shares_near(&self, from: Point, to: Point, slack_m: f64) -> Option<(f64, f64)> {
        // most that are asked about are far apart, and boxes tell that soonest
        let (dx, dy) = self.bounds.axis_gaps(&Segment::new(from, to).bounds());
        if dx.max(dy) > slack_m {
            return None;
        }
        let (mut enters, mut leaves) = (0.0_f64, 1.0_f64);
        for side in self.sides() {
            let (one, two) = (cross(side.a, side.b, from), cross(side.a, side.b, to));
            if is_in([one, two], &side, slack_m) {
                continue;
            }
            if one < 0.0 && two < 0.0 {
                return None;
            }
            let share = one / (one - two);
            if two > one {
                enters = if one < 0.0 { enters.max(share) } else { enters };
            } else if two < one {
                leaves = if two < 0.0 { leaves.min(share) } else { leaves };
            }
        }
        (enters < leaves).then_some((enters, leaves))
    }

    /// The share of a way from a point inside at which it leaves; infinite where it would not if it went on.
    pub fn leaves(&self, from: Point, to: Point) -> f64 {
        let leaves = |from: f64, to: f64, low: f64, high: f64| {
            if to > from {
                (high - from) / (to - from)
            } else if to < from {
                (low - from) / (to - from)
            } else {
                f64::INFINITY
            }
        };
        if let Some(rect) = self.rect() {
            return leaves(from.x, to.x, rect.x0, rect.x1).min(leaves(from.y, to.y, rect.y0, rect.y1));
        }
        let through = |side: Segment| {
            let (one, two) = (cross(side.a, side.b, from), cross(side.a, side.b, to));
            (two < one && !is_in([one, two], &side, ROUNDING_M)).then(|| one / (one - two))
        };
        self.sides().filter_map(through).fold(f64::INFINITY, f64::min)
    }

    /// The angle of the ground about a point that it takes, radians: half a turn on a side, a whole one inside.
    pub fn angle_at(&self, p: Point) -> f64 {
        if let Some(rect) = self.rect() {
            let halves = |low: f64, high: f64, at: f64| {
                if at < low - SNAP_M || at > high + SNAP_M {
                    0.0
                } else if at > low + SNAP_M && at < high - SNAP_M {
                    2.0
                } else {
                    1.0
                }
            };
            return halves(rect.x0, rect.x1, p.x) * halves(rect.y0, rect.y1, p.y) * FRAC_PI_2;
        }
        if !self.bounds.grown(SNAP_M).contains(p) {
            return 0.0;
        }
        let count = self.count();
        if let Some(number) = (0..count).find(|&number| self.corner(number).distance(p) <= SNAP_M) {
            let at = self.corner(number);
            let out = self.corner((number + 1) % count) - at;
            let back = self.corner((number + count - 1) % count) - at;
            return out.cross(back).atan2(out.dot(back)).abs();
        }
        if self.sides().any(|side| side.distance(p) <= SNAP_M) {
            return PI;
        }
        if self.contains(p) { TAU } else { 0.0 }
    }

    /// The directions in which it lies from a point of its outline; `None` from elsewhere.
    pub fn sector_at(&self, p: Point) -> Option<Sector> {
        let is_at = |side: &Segment| side.distance(p) <= SNAP_M;
        let (on, by): (Vec<Segment>, Vec<Segment>) =
            self.sides().filter(is_at).partition(|side| side.b.distance(p) > SNAP_M);
        let on = on.last()?.direction();
        let back = by.first().map_or(-on, |by| -by.direction());
        Some(Sector::between(on, back))
    }

    /// What of a segment lies inside, or as near to it as points are told apart; `None` where at most a point does.
    pub fn clip_near(&self, segment: Segment) -> Option<Segment> {
        let (enters, leaves) = self.shares_near(segment.a, segment.b, SNAP_M)?;
        Some(Segment::new(segment.at(enters), segment.at(leaves)))
    }

    /// What of a segment lies inside; `None` where at most a point does.
    pub fn clip(&self, segment: Segment) -> Option<Segment> {
        let (enters, leaves) = self.shares(segment.a, segment.b)?;
        let at = |share: f64| {
            if self.corners.is_none() { self.bounds.nearest_to(segment.at(share)) } else { segment.at(share) }
        };
        let a = if enters > 0.0 { at(enters) } else { segment.a };
        let b = if leaves < 1.0 { at(leaves) } else { segment.b };
        Some(Segment::new(a, b))
    }

    /// What lies left of the line through a segment, in its direction; `None` where nothing does but a rounding.
    pub fn left_of(&self, line: Segment) -> Option<Self> {
        let mut part = Part::of(self);
        match part.cut_by(line)? {
            Cut::Left => Some(self.clone()),
            Cut::Both => Some(part.into()),
            Cut::Right => None,
        }
    }

    /// Whether nothing but a rounding lies left of the line through a segment.
    fn is_right_of(&self, line: Segment) -> bool {
        let slack = ROUNDING_M * line.length();
        self.corners().all(|corner| cross(line.a, line.b, corner) <= slack)
    }

    /// Whether both have an area in common, or come as near to it as a rounding.
    pub fn overlaps(&self, other: &Self) -> bool {
        // a side of one of them lies between what is apart
        let parts = |one: &Self, two: &Self| {
            one.sides().any(|side| two.corners().all(|corner| cross(side.a, side.b, corner) <= 0.0))
        };
        self.bounds.overlaps(&other.bounds) && !parts(self, other) && !parts(other, self)
    }

    /// What both have in common; `None` where that is less than an area.
    pub fn common(&self, other: &Self) -> Option<Self> {
        let bounds = self.bounds.intersection(&other.bounds)?;
        if let (None, None) = (&self.corners, &other.corners) {
            return Some(bounds.into());
        }
        // most of what comes near is apart, and told so before anything is cut
        if other.sides().any(|side| self.is_right_of(side)) {
            return None;
        }
        let (mut rest, mut is_cut) = (Part::of(self), false);
        for side in other.sides() {
            match rest.cut_by(side)? {
                Cut::Left => {}
                Cut::Both => is_cut = true,
                Cut::Right => return None,
            }
        }
        Some(if is_cut { rest.into() } else { self.clone() })
    }

    /// The longest part of a side on which another one lies to its other side; `None` where there is none.
    pub fn border(&self, other: &Self) -> Option<Segment> {
        if self.bounds.gap(&other.bounds) > SNAP_M {
            return None;
        }
        let faces = |one: &Segment, two: &Segment| (one.b - one.a).dot(two.b - two.a) < 0.0;
        let shared = self.sides().flat_map(|one| {
            other.sides().filter(move |two| faces(&one, two)).filter_map(move |two| one.shared_with(&two))
        });
        shared.max_by(|one, two| one.length().total_cmp(&two.length()))
    }

    /// Square metres.
    pub fn area(&self) -> f64 {
        if self.corners.is_none() {
            return self.bounds.area();
        }
        let origin = self.corner(0);
        let twice: f64 = self.sides().map(|side| cross(origin, side.a, side.b)).sum();
        twice / 2.0
    }

    /// Its centre of gravity.
    pub fn centre(&self) -> Point {
        if self.corners.is_none() {
            return self.bounds.centre();
        }
        let area = self.area();
        if area <= 0.0 {
            return self.bounds.centre();
        }
        let origin = self.corner(0);
        let weighed = self.sides().map(|side| {
            let (a, b) = (side.a - origin, side.b - origin);
            (a + b) * (a.cross(b) / (6.0 * area))
        });
        weighed.fold(origin, |sum, part| sum + part)
    }

    /// The least distance between two parallel lines that it lies between: of a rectangle its smaller side. Metres.
    pub fn breadth(&self) -> f64 {
        if self.corners.is_none() {
            return self.bounds.smaller_side();
        }
        let across = |side: Segment| {
            let farthest = self.corners().map(|corner| cross(side.a, side.b, corner));
            farthest.fold(0.0, f64::max) / side.length().max(ROUNDING_M)
        };
        self.sides().map(across).fold(f64::INFINITY, f64::min)
    }
}

impl Part {
    fn of(whole: &Convex) -> Self {
        let corners = match whole.all() {
            Corners::Rect(corners) => SmallVec::from_slice(&corners),
            Corners::Polygon(corners) => SmallVec::from_slice(corners),
        };
        Self { bounds: whole.bounds, is_rect: whole.corners.is_none(), corners }
    }

    /// Where it lies on both sides of the line through a segment, leaves what lies to the left, in its direction; `None` where that is
    /// no area.
    fn cut_by(&mut self, line: Segment) -> Option<Cut> {
        let slack = ROUNDING_M * line.length();
        let by: SmallVec<[f64; 16]> =
            self.corners.iter().map(|&corner| cross(line.a, line.b, corner)).collect();
        if by.iter().all(|&by| by >= -slack) {
            return Some(Cut::Left);
        }
        if by.iter().all(|&by| by <= slack) {
            return Some(Cut::Right);
        }
        let (Rect { x0, y0, x1, y1 }, Point { x, y }, way) = (self.bounds, line.a, line.b - line.a);
        if self.is_rect && (way.x == 0.0 || way.y == 0.0) {
            self.bounds = if way.x == 0.0 {
                if way.y > 0.0 { Rect::new(x0, y0, x, y1) } else { Rect::new(x, y0, x1, y1) }
            } else {
                if way.x > 0.0 { Rect::new(x0, y, x1, y1) } else { Rect::new(x0, y0, x1, y) }
            };
            self.corners = SmallVec::from_slice(&self.bounds.corners());
            return Some(Cut::Both);
        }
        let mut kept: SmallVec<[Point; 16]> = SmallVec::new();
        for (number, (&a, &one)) in self.corners.iter().zip(&by).enumerate() {
            let next = if number + 1 == by.len() { 0 } else { number + 1 };
            let (b, two) = (self.corners[next], by[next]);
            if one >= 0.0 {
                kept.push(a);
            }
            if one.min(two) < 0.0 && one.max(two) > 0.0 {
                kept.push(a.lerp(b, one / (one - two)));
            }
        }
        kept.dedup_by(|b, a| a.distance(*b) <= ROUNDING_M);
        if kept.len() > 1 && kept[0].distance(kept[kept.len() - 1]) <= ROUNDING_M {
            kept.pop();
        }
        if kept.len() < 3 {
            return None;
        }
        (self.bounds, self.is_rect) = about(&kept);
        self.corners = kept;
        Some(Cut::Both)
    }
}

impl From<Part> for Convex {
    fn from(part: Part) -> Self {
        Self { bounds: part.bounds, corners: (!part.is_rect).then(|| part.corners.as_slice().into()) }
    }
}

/// The least rectangle along the axes about corners, and whether they are those of it.
fn about(corners: &[Point]) -> (Rect, bool) {
    let bounds = Rect::around(corners.iter().copied());
    (bounds, corners.len() == 4 && bounds.corners().iter().all(|corner| corners.contains(corner)))
}

#[derive(Clone, Copy)]
enum Corners<'a> {
    Rect([Point; 4]),
    Polygon(&'a [Point]),
}

impl Corners<'_> {
    fn count(&self) -> usize {
        match self {
            Self::Rect(_) => 4,
            Self::Polygon(corners) => corners.len(),
        }
    }

    fn at(&self, number: usize) -> Point {
        match self {
            Self::Rect(corners) => corners[number],
            Self::Polygon(corners) => corners[number],
        }
    }
}

/// Whether two points lie left of a side's line, by the areas that they span with it, or at most so far right of it.
fn is_in([one, two]: [f64; 2], side: &Segment, slack_m: f64) -> bool {
    let least = one.min(two);
    least >= 0.0 || least >= -slack_m * side.length()
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    fn points(corners: &[(f64, f64)]) -> Vec<Point> {
        corners.iter().map(|&(x, y)| Point::new(x, y)).collect()
    }

    fn diamond() -> Convex {
        Convex::new(points(&[(0.0, -1.0), (1.0, 0.0), (0.0, 1.0), (-1.0, 0.0)]))
    }

    #[test]
    fn a_rectangle_drawn_by_its_corners_is_one() {
        let drawn = Convex::new(points(&[(1.0, 3.0), (0.0, 3.0), (0.0, 1.0), (1.0, 1.0)]));
        assert_eq!(drawn, Rect::new(0.0, 1.0, 1.0, 3.0).into());
        assert_eq!(diamond().rect(), None);
    }

    #[test]
    fn a_diamond_is_measured() {
        let diamond = diamond();
        assert!((diamond.area() - 2.0).abs() < 1e-12);
        assert!((diamond.breadth() - 2f64.sqrt()).abs() < 1e-12);
        assert!(diamond.centre().length() < 1e-12);
        assert!((diamond.distance(Point::new(1.0, 1.0)) - 0.5f64.sqrt()).abs() < 1e-12);
        assert!(diamond.contains(Point::new(0.5, 0.5)) && !diamond.contains(Point::new(0.6, 0.6)));
    }

    #[test]
    fn what_a_diamond_and_a_square_share_is_an_octagon() {
        let square = Convex::from(Rect::new(-0.75, -0.75, 0.75, 0.75));
        let common = diamond().common(&square).unwrap();
        assert_eq!(common.corners().count(), 8);
        assert!((common.area() - (2.0 - 4.0 * 0.0625)).abs() < 1e-12);
        assert_eq!(diamond().common(&Rect::new(0.5, 0.5, 1.0, 1.0).into()), None);
    }

    fn convex() -> impl Strategy<Value = Convex> {
        let point = || (-1.0..1.0, -1.0..1.0).prop_map(|(x, y)| Point::new(x, y));
        prop::collection::vec(point(), 3..9).prop_map(|points| {
            use geo::ConvexHull;
            let hull =
                points.iter().copied().map(geo::Coord::from).collect::<geo::LineString>().convex_hull();
            Convex::new(hull.exterior().coords().skip(1).map(|&corner| corner.into()).collect())
        })
    }

    proptest! {
        #[test]
        fn a_point_lies_in_what_two_share_if_it_lies_in_both(
            a in convex(), b in convex(), x in -1.0..1.0, y in -1.0..1.0
        ) {
            let p = Point::new(x, y);
            let on_rim = |of: &Convex| of.sides().any(|side| side.distance(p) < 1e-6);
            prop_assume!(!on_rim(&a) && !on_rim(&b));
            let common = a.common(&b);
            prop_assert_eq!(common.is_some_and(|common| common.contains(p)), a.contains(p) && b.contains(p));
        }

        #[test]
        fn what_is_clipped_lies_inside_and_what_is_cut_off_outside(
            a in convex(), from in (-2.0..2.0, -2.0..2.0), to in (-2.0..2.0, -2.0..2.0), share in 0.0..1.0
        ) {
            let segment = Segment::new(Point::new(from.0, from.1), Point::new(to.0, to.1));
            let p = segment.at(share);
            prop_assume!(a.sides().all(|side| side.distance(p) > 1e-6));
            let is_in = a.clip(segment).is_some_and(|part| part.distance(p) < 1e-9);
            prop_assert_eq!(is_in, a.contains(p));
        }
    }
}
