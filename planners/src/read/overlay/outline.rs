//! Rectangles and polygons of items, checked in themselves.

use std::ops::Range;

use geo::{Area, Validation};

use super::super::diagnostic::{Code, Problem, Text};
use super::super::fields::{Fields, Located};
use crate::geometry::polygon::{self_crossing, to_geo};
use crate::geometry::{Point, Rect, orient};
use crate::world::Shape;

/// What is smaller is a line that rounding made wide; square metres.
const LEAST_AREA: f64 = 1e-9;

/// The most corners of one polygon. Whether it crosses itself takes a time that grows with their square: a second for so many.
const CORNERS: usize = 10_000;

/// The outline of an item: either a `rect` or a `polygon`.
pub(super) fn shape(item: &Fields<'_, '_>, problems: &mut Vec<Problem>) -> Option<Shape> {
    match (item.get("rect"), item.get("polygon")) {
        (Some(_), Some(polygon)) => {
            let message = format!("{} has either a `rect` or a `polygon`, not both", item.what);
            problems.push(item.text.problem(Code::WrongType, &polygon.span(), message));
            None
        }
        (None, Some(_)) => polygon(item, problems),
        _ => rect(item, problems).map(|rect| Shape::Rect(rect.value)),
    }
}

pub(super) fn rect(item: &Fields<'_, '_>, problems: &mut Vec<Problem>) -> Option<Located<Rect>> {
    let Located { value: [x0, y0, x1, y1], span } = item.numbers::<4>("rect", problems)?;
    if x0 < x1 && y0 < y1 {
        return Some(Located { value: Rect::new(x0, y0, x1, y1), span });
    }
    let (message, help) = if x0 > x1 || y0 > y1 {
        let message = "`rect` is x0, y0, x1, y1 with x0 < x1 and y0 < y1".to_owned();
        let [a, b, c, d] = [x0.min(x1), y0.min(y1), x0.max(x1), y0.max(y1)];
        (message, format!("did you mean [{a}, {b}, {c}, {d}]?"))
    } else {
        let message = "this `rect` has no area: it is a line or a point".to_owned();
        let help = if item.what == "[[area]]" {
            "what is passed like a line is a [[door]]: `from` and `to`"
        } else {
            "a wall needs a thickness, say 0.1 m"
        };
        (message, help.to_owned())
    };
    problems.push(item.text.problem(Code::Degenerate, &span, message).with_help(help));
    None
}

fn polygon(item: &Fields<'_, '_>, problems: &mut Vec<Problem>) -> Option<Shape> {
    let Located { value, span } = item.points("polygon", problems)?;
    let corners =
        value.into_iter().map(|Located { value: [x, y], span }| Located { value: Point::new(x, y), span });
    ring(item.text, thing(item), &span, corners.collect()).map_err(|problem| problems.push(problem)).ok()
}

/// The outline of a `thing` through these corners; the first may stand at the end once more.
pub(crate) fn ring(
    text: &Text,
    thing: &str,
    span: &Range<usize>,
    mut corners: Vec<Located<Point>>,
) -> Result<Shape, Problem> {
    corners.dedup_by_key(|corner| corner.value);
    if corners.len() > 1 && corners.first().map(|c| c.value) == corners.last().map(|c| c.value) {
        corners.pop();
    }
    let problem = |code, message: String| text.problem(code, span, message);
    if corners.len() < 3 {
        let message = format!("a polygon needs three different corners, this one has {}", corners.len());
        return Err(problem(Code::FewCorners, message));
    }
    if corners.len() > CORNERS {
        let message = format!("this polygon has {} corners; {CORNERS} are the most", corners.len());
        return Err(problem(Code::TooManyCorners, message)
            .with_help("leave out corners that lie nearly on a line, or make it several polygons"));
    }
    let points: Vec<Point> = corners.iter().map(|corner| corner.value).collect();
    let outline = to_geo(&points);
    let invalid = outline.check_validation().err();
    let is_line = thing == "area" && outline.unsigned_area() < LEAST_AREA;
    if invalid.is_none() && !is_line {
        return Ok(Shape::Polygon(points));
    }
    Err(match (crossing_edges(&points), invalid.filter(|_| !is_line)) {
        (Some((i, j)), _) => {
            let (a, b) = (edge(&points, i), edge(&points, j));
            let message = format!("this polygon crosses itself: its edge {a} meets its edge {b}");
            problem(Code::SelfCrossing, message)
                .and_at(&corners[i].span, "one edge begins here")
                .and_at(&corners[j].span, "the other one here")
                .with_help(format!("list the corners in order around the {thing}, each once"))
        }
        (None, Some(invalid)) => {
            problem(Code::SelfCrossing, format!("this polygon is not a simple outline: {invalid}"))
                .with_help(format!("list the corners in order around the {thing}, each once"))
        }
        (None, None) => {
            let message = "this polygon has no area: its corners lie on one line".to_owned();
            problem(Code::Degenerate, message)
        }
    })
}

fn thing<'a>(item: &Fields<'a, '_>) -> &'a str {
    item.what.trim_matches(['[', ']'])
}

/// How a message calls the edge from a corner to the next.
fn edge(corners: &[Point], from: usize) -> String {
    let (a, b) = (corners[from], corners[(from + 1) % corners.len()]);
    format!("from ({}, {}) to ({}, {})", a.x, a.y, b.x, b.y)
}

/// Edges by the corners where they begin; none of an outline that is one line.
fn crossing_edges(corners: &[Point]) -> Option<(usize, usize)> {
    let is_line = corners.windows(3).all(|w| orient(w[0], w[1], w[2]) == 0.0);
    if is_line { None } else { self_crossing(corners) }
}
