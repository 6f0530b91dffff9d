//! `[[obstacle]]`, `[[bridge]]` and `[[place]]` as values, checked in themselves.

use std::ops::Range;

use geo::{Coord, LineString, Polygon, Validation};

use super::super::diagnostic::{Code, Problem, Text};
use super::super::fields::{Fields, Located};
use crate::geometry::{Point, Rect};
use crate::world::{Bridge, Place, Shape};

pub(super) fn obstacles(document: &Fields<'_, '_>, problems: &mut Vec<Problem>) -> Vec<Located<Shape>> {
    let mut found = Vec::new();
    for item in document.tables("obstacle", "[[obstacle]]", problems) {
        item.refuse_unknown(&["rect", "polygon"], problems);
        let shape = match (item.get("rect"), item.get("polygon")) {
            (Some(_), Some(polygon)) => {
                let message = "an [[obstacle]] has either a `rect` or a `polygon`, not both";
                problems.push(item.text.problem(Code::WrongType, &polygon.span(), message));
                None
            }
            (None, Some(_)) => polygon(&item, problems),
            _ => rect(&item, problems).map(|rect| Shape::Rect(rect.value)),
        };
        found.extend(shape.map(|value| Located { value, span: item.span.clone() }));
    }
    found
}

pub(super) fn bridges(document: &Fields<'_, '_>, problems: &mut Vec<Problem>) -> Vec<Located<Bridge>> {
    let mut found = Vec::new();
    for item in document.tables("bridge", "[[bridge]]", problems) {
        item.refuse_unknown(&["rect", "height"], problems);
        let (rect, height) = (rect(&item, problems), item.positive("height", problems));
        if let (Some(rect), Some(height)) = (rect, height) {
            let value = Bridge { rect: rect.value, height: height.value };
            found.push(Located { value, span: item.span.clone() });
        }
    }
    found
}

pub(super) fn places(document: &Fields<'_, '_>, problems: &mut Vec<Problem>) -> Vec<Located<Place>> {
    let mut found: Vec<Located<Place>> = Vec::new();
    for item in document.tables("place", "[[place]]", problems) {
        item.refuse_unknown(&["name", "at"], problems);
        let (name, at) = (item.string("name", problems), item.numbers::<2>("at", problems));
        let Some(name) = name else { continue };
        if name.value.trim().is_empty() {
            problems.push(item.text.problem(Code::EmptyName, &name.span, "a place needs a name"));
            continue;
        }
        if name.value.contains(char::is_control) {
            let message = format!("the name {:?} holds a control character, which is no letter", name.value);
            problems.push(item.text.problem(Code::EmptyName, &name.span, message));
            continue;
        }
        if let Some(first) = found.iter().find(|place| place.value.name == name.value) {
            let line = item.text.line(first.span.start);
            let message = format!("`{}` is already the name of the place on line {line}", name.value);
            let problem = item.text.problem(Code::DuplicatePlace, &name.span, message);
            problems.push(problem.and_at(&first.span, "the first one"));
            continue;
        }
        if let Some(at) = at {
            let value = Place { name: name.value, at: Point::new(at.value[0], at.value[1]) };
            found.push(Located { value, span: at.span });
        }
    }
    found
}

fn rect(item: &Fields<'_, '_>, problems: &mut Vec<Problem>) -> Option<Located<Rect>> {
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
        (message, "a wall needs a thickness, say 0.1 m".to_owned())
    };
    problems.push(item.text.problem(Code::Degenerate, &span, message).with_help(help));
    None
}

fn polygon(item: &Fields<'_, '_>, problems: &mut Vec<Problem>) -> Option<Shape> {
    let Located { value, span } = item.points("polygon", problems)?;
    let mut corners: Vec<Point> = value.iter().map(|&[x, y]| Point::new(x, y)).collect();
    corners.dedup();
    if corners.len() > 1 && corners.first() == corners.last() {
        corners.pop();
    }
    if let Some(problem) = outline_problem(item.text, &span, &corners) {
        problems.push(problem);
        return None;
    }
    Some(Shape::Polygon(corners))
}

fn outline_problem(text: &Text, span: &Range<usize>, corners: &[Point]) -> Option<Problem> {
    if corners.len() < 3 {
        let message = format!("a polygon needs three different corners, this one has {}", corners.len());
        return Some(text.problem(Code::FewCorners, span, message));
    }
    let ring = corners.iter().map(|p| Coord { x: p.x, y: p.y }).collect();
    let outline = Polygon::new(LineString::new(ring), Vec::new());
    outline.check_validation().err().map(|invalid| {
        let message = format!("this polygon is not a simple outline: {invalid}");
        text.problem(Code::SelfCrossing, span, message)
            .with_help("list the corners in order around the obstacle, each once")
    })
}
