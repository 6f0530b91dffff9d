//! A disc that moves straight among segments: how far it gets.

use crate::geometry::tolerance::ROUNDING_M;
use crate::geometry::{Point, Segment};

/// Discs stop so far before what they touch, metres, so that rounding never puts them into it.
pub(super) const HAIR_M: f64 = ROUNDING_M;

/// A way along what is touched leads towards it by no larger a cosine: what rounding leaves of 0.
const ACROSS: f64 = 1e-12;

#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Touch {
    /// Share of the way until then.
    pub share: f64,
    /// The point that was touched, where it was at that time.
    pub at: Point,
}

/// How far a disc gets on its way until it touches a segment; `None` where it does not.
/// A disc that touches already may move along and away, and no nearer.
pub(super) fn touch(centre: Point, radius_m: f64, way: Point, segment: &Segment) -> Option<Touch> {
    let length = way.length();
    if length <= 0.0 {
        return None;
    }
    let nearest = centre.nearest_on(segment.a, segment.b);
    if centre.distance(nearest) <= radius_m + 2.0 * HAIR_M {
        let nearer = way.dot(nearest - centre);
        return (nearer > ACROSS * length).then_some(Touch { share: 0.0, at: nearest });
    }
    let towards = Point::new(way.x / length, way.y / length);
    let reach = radius_m + HAIR_M;
    let ends = [segment.a, segment.b].into_iter().filter_map(|end| to_point(centre, reach, towards, end));
    let first = ends.chain(to_line(centre, reach, towards, segment)).filter(|(far, _)| *far <= length);
    let (far, at) = first.min_by(|a, b| a.0.total_cmp(&b.0))?;
    Some(Touch { share: far / length, at })
}

fn to_point(centre: Point, reach: f64, towards: Point, point: Point) -> Option<(f64, Point)> {
    let Point { x: ahead, y: aside } = (point - centre).seen_along(towards);
    let half = (reach.powi(2) - aside.powi(2)).max(0.0).sqrt();
    (aside.abs() < reach && ahead - half >= 0.0).then_some((ahead - half, point))
}

fn to_line(centre: Point, reach: f64, towards: Point, segment: &Segment) -> Option<(f64, Point)> {
    let along = segment.direction();
    let aside = (centre - segment.a).cross(along);
    let approach = along.cross(towards);
    let approach = if aside < 0.0 { -approach } else { approach };
    let far = (aside.abs() - reach) / approach;
    if approach <= 0.0 || far < 0.0 {
        return None;
    }
    let then = centre + towards * far;
    let place = (then - segment.a).dot(along);
    let is_beside = place >= 0.0 && place <= segment.length();
    let at = segment.a + along * place;
    is_beside.then_some((far, at))
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn point() -> impl Strategy<Value = Point> {
        (-3.0..3.0, -3.0..3.0).prop_map(|(x, y)| Point::new(x, y))
    }

    proptest! {
        #[test]
        fn a_disc_stops_where_it_touches_and_not_before(centre in point(), way in point(), a in point(), b in point()) {
            let (segment, radius) = (Segment::new(a, b), 0.3);
            prop_assume!(segment.distance(centre) > radius + 1e-6);
            let share = touch(centre, radius, way, &segment).map_or(1.0, |touch| touch.share);
            let at = |share: f64| centre + way * share;
            let gap = |share: f64| segment.distance(at(share)) - radius;
            let least = (0..=1000).map(|i| gap(share * f64::from(i) / 1000.0)).fold(f64::INFINITY, f64::min);
            prop_assert!(least >= 0.0, "{least}");
            prop_assert!(share >= 1.0 || gap(share) < 3.0 * HAIR_M, "{share} {}", gap(share));
        }
    }

    #[test]
    fn a_disc_that_touches_goes_along_and_away_but_no_nearer() {
        let wall = Segment::new(Point::new(-5.0, 0.0), Point::new(5.0, 0.0));
        let centre = Point::new(0.0, 0.3 + HAIR_M);
        assert_eq!(touch(centre, 0.3, Point::new(1.0, 0.0), &wall), None);
        assert_eq!(touch(centre, 0.3, Point::new(0.5, 1.0), &wall), None);
        let touched = touch(centre, 0.3, Point::new(1.0, -0.1), &wall);
        assert_eq!(touched, Some(Touch { share: 0.0, at: Point::default() }));
    }
}
