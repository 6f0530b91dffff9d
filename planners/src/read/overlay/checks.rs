//! Items against the world over which they are laid: inside of the environment, places not in a wall.

use std::ops::Range;

use super::super::diagnostic::{Code, Problem, Text};
use super::super::fields::Located;
use super::names::duplicate;
use crate::geometry::Rect;
use crate::world::{Bridge, Obstacle, Place, Shape, World};

pub(super) fn add_obstacle(
    world: &mut World,
    text: &Text,
    obstacle: &Located<Shape>,
    found: &mut Vec<Problem>,
) {
    let rect = obstacle.value.enclosing_rect();
    if rect.dx() <= 0.0 || rect.dy() <= 0.0 {
        let message = "this obstacle has no area: its corners lie on one line".to_owned();
        let problem = text.problem(Code::Degenerate, &obstacle.span, message);
        found.push(
            problem.with_help("an outline has corners on either side: a wall needs a thickness, say 0.1 m"),
        );
        return;
    }
    let Some(inside) = inside(world.bounds, text, "obstacle", rect, obstacle, found) else { return };
    let shape = match &obstacle.value {
        Shape::Rect(_) => Shape::Rect(inside),
        polygon @ Shape::Polygon(_) => polygon.clone(),
    };
    world.obstacles.push(Obstacle { shape });
}

pub(super) fn add_bridge(world: &mut World, text: &Text, bridge: &Located<Bridge>, found: &mut Vec<Problem>) {
    if let Some(rect) = inside(world.bounds, text, "bridge", bridge.value.rect, bridge, found) {
        world.bridges.push(Bridge { rect, ..bridge.value });
    }
}

/// The complaint where a place, an area or a door of the world has this name.
pub(super) fn taken(
    world: &World,
    text: &Text,
    what: &str,
    name: &str,
    span: &Range<usize>,
) -> Option<Problem> {
    let of = world.kind_of_named(name)?;
    let article = if of == "area" { "an" } else { "a" };
    let message = format!("the map has {article} {of} `{name}` already");
    Some(text.problem(duplicate(of, what), span, message))
}

/// What of `rect` is inside of the environment; says what is not.
pub(super) fn inside<T>(
    bounds: Rect,
    text: &Text,
    what: &str,
    rect: Rect,
    item: &Located<T>,
    found: &mut Vec<Problem>,
) -> Option<Rect> {
    let common = bounds.intersection(&rect);
    let problem = match common {
        None => {
            let message = format!("this {what} lies outside of the environment, which is {}", extent(bounds));
            text.problem(Code::Outside, &item.span, message)
        }
        Some(_) if !bounds.encloses(&rect) => {
            let message = format!("this {what} is cut at the edge of the environment");
            text.problem(Code::Clipped, &item.span, message).as_advice()
        }
        Some(_) => return common,
    };
    found.push(problem);
    common
}

/// Places that were there before, against the obstacles that are new.
pub(super) fn known_places(
    world: &World,
    text: &Text,
    obstacles: &[Located<Shape>],
    before: usize,
    found: &mut Vec<Problem>,
) {
    if world.obstacles.len() == before {
        return;
    }
    for place in &world.places {
        if let Some(over) = obstacles.iter().find(|obstacle| obstacle.value.contains(place.at)) {
            // a pallet is put down where it is put down
            let message =
                format!("this obstacle lies over the map's place `{}`: nobody gets there", place.name);
            found.push(text.problem(Code::PlaceInWall, &over.span, message).as_advice());
        }
    }
}

pub(super) fn add_place(
    world: &mut World,
    text: &Text,
    place: &Located<Place>,
    obstacles: &[Located<Shape>],
    found: &mut Vec<Problem>,
) {
    let Place { name, at } = &place.value;
    let here = format!("the place `{name}` at ({}, {})", at.x, at.y);
    if let Some(problem) = taken(world, text, "place", name, &place.span) {
        found.push(problem);
        return;
    }
    if !world.bounds.contains(*at) {
        let message = format!("{here} lies outside of the environment, which is {}", extent(world.bounds));
        found.push(text.problem(Code::PlaceOutside, &place.span, message));
        return;
    }
    if let Some(over) = obstacles.iter().find(|obstacle| obstacle.value.contains(*at)) {
        let message = format!("{here} lies inside the obstacle on line {}", text.line(over.span.start));
        let problem = text.problem(Code::PlaceInWall, &place.span, message);
        found.push(problem.and_at(&over.span, "this obstacle"));
        return;
    }
    if let Some(over) = world.obstacles.iter().find(|obstacle| obstacle.shape.contains(*at)) {
        let over = extent(over.shape.enclosing_rect());
        let message = format!("{here} lies inside an obstacle of the map, {over}");
        found.push(text.problem(Code::PlaceInWall, &place.span, message));
        return;
    }
    if world.occupancy.as_ref().is_some_and(|cells| cells.is_blocked_at(*at)) {
        let message = format!("{here} lies in a wall of the map's image, or where the image is unknown");
        found.push(text.problem(Code::PlaceInWall, &place.span, message));
        return;
    }
    world.places.push(place.value.clone());
}

/// From where to where a rectangle goes: `x 0 to 30.2, y -2 to 17`.
pub(super) fn extent(rect: Rect) -> String {
    let micrometres = |metres: f64| (metres * 1e6).round() / 1e6;
    let [x0, y0, x1, y1] = [rect.x0, rect.y0, rect.x1, rect.y1].map(micrometres);
    format!("x {x0} to {x1}, y {y0} to {y1}")
}
