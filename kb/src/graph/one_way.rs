//! Areas that one goes through in one direction, as boundaries that are open to one side: the sides of the area, and lines across
//! it, since who has come in may turn round.

use adit_planners::geometry::{Point, Segment, polygon};
use adit_planners::routes::Closed;

/// So far apart are lines across an area, metres: who goes through it comes back by no more.
const APART_M: f64 = 1.0;

/// So many lines lie across an area at most.
const MOST_LINES: f64 = 200.0;

/// A side that is this near to the direction of an area, as the sine of the angle between them, is open both ways.
const ALONG: f64 = 0.02;

/// An area that one goes through in one direction.
#[derive(Clone, Debug, PartialEq)]
pub struct OneWay {
    /// Its name.
    pub area: String,
    /// The direction, degrees counterclockwise from x.
    pub heading: f64,
    /// In their order, metres.
    pub corners: Vec<Point>,
}

impl OneWay {
    /// What nobody crosses against the direction.
    pub fn boundaries(&self) -> Vec<Closed> {
        let ahead = Point::new(self.heading.to_radians().cos(), self.heading.to_radians().sin());
        let sides = polygon::sides(&self.corners).filter(|side| ahead.cross(side.direction()).abs() > ALONG);
        sides.chain(self.across(ahead)).map(|line| Closed::to_left(leading(line, ahead))).collect()
    }

    /// Lines across the area, inside of it.
    fn across(&self, ahead: Point) -> Vec<Segment> {
        // seen along the direction, they are upright
        let seen: Vec<Point> = self.corners.iter().map(|corner| corner.seen_along(ahead)).collect();
        let (first, last) = seen
            .iter()
            .fold((f64::INFINITY, f64::NEG_INFINITY), |(first, last), p| (first.min(p.x), last.max(p.x)));
        let count = ((last - first) / APART_M).clamp(1.0, MOST_LINES).floor();
        let upright: Vec<Point> = seen.iter().map(|p| Point::new(p.y, p.x)).collect();
        let at = |number: u32| first + (last - first) * f64::from(number) / count;
        let across = ahead.perpendicular();
        (1..count as u32)
            .flat_map(|number| {
                let spans = polygon::spans(polygon::sides(&upright), at(number));
                spans
                    .into_iter()
                    .map(move |span| Segment::from(span.map(|aside| ahead * at(number) + across * aside)))
            })
            .collect()
    }
}

/// A line, turned so that who crosses it to its left goes ahead.
fn leading(line: Segment, ahead: Point) -> Segment {
    if line.direction().perpendicular().dot(ahead) > 0.0 { line } else { line.reversed() }
}
