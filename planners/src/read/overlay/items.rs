//! `[[obstacle]]`, `[[bridge]]` and `[[place]]` as values, checked in themselves.

use super::super::diagnostic::Problem;
use super::super::fields::{Fields, Located};
use super::names::Names;
use super::outline;
use crate::geometry::Point;
use crate::world::{Bridge, Place, Shape};

pub(super) fn obstacles(document: &Fields<'_, '_>, problems: &mut Vec<Problem>) -> Vec<Located<Shape>> {
    let mut found = Vec::new();
    for item in document.tables("obstacle", "[[obstacle]]", problems) {
        item.refuse_unknown(&["rect", "polygon"], problems);
        let shape = outline::shape(&item, problems);
        found.extend(shape.map(|value| Located { value, span: item.span.clone() }));
    }
    found
}

pub(super) fn bridges(document: &Fields<'_, '_>, problems: &mut Vec<Problem>) -> Vec<Located<Bridge>> {
    let mut found = Vec::new();
    for item in document.tables("bridge", "[[bridge]]", problems) {
        item.refuse_unknown(&["rect", "height"], problems);
        let (rect, height) = (outline::rect(&item, problems), item.positive("height", problems));
        if let (Some(rect), Some(height)) = (rect, height) {
            let value = Bridge { rect: rect.value, height: height.value };
            found.push(Located { value, span: item.span.clone() });
        }
    }
    found
}

pub(super) fn places(
    document: &Fields<'_, '_>,
    names: &mut Names,
    problems: &mut Vec<Problem>,
) -> Vec<Located<Place>> {
    let mut found = Vec::new();
    for item in document.tables("place", "[[place]]", problems) {
        item.refuse_unknown(&["name", "at"], problems);
        let (name, at) = (names.take(&item, "place", problems), item.numbers::<2>("at", problems));
        if let (Some(name), Some(at)) = (name, at) {
            let value = Place { name: name.value, at: Point::new(at.value[0], at.value[1]) };
            found.push(Located { value, span: at.span });
        }
    }
    found
}
