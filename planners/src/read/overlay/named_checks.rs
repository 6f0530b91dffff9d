//! Named areas and doors against the world over which they are laid.

use geo::{Area as _, Centroid};

use super::super::diagnostic::{Code, Problem, Text};
use super::super::fields::Located;
use super::checks::{extent, inside, taken};
use super::named::{Given, centre};
use crate::geometry::{Point, Rect};
use crate::world::{Area, NamedDoor, Property, Shape, World};

pub(super) fn add_area(world: &mut World, text: &Text, area: &Located<Area>, found: &mut Vec<Problem>) {
    if let Some(problem) = taken(world, text, "area", &area.value.name, &area.span) {
        found.push(problem);
        return;
    }
    let enclosing = area.value.shape.enclosing_rect();
    let mut laid = area.value.clone();
    match &area.value.shape {
        Shape::Rect(_) => {
            let Some(rect) = inside(world.bounds, text, "area", enclosing, area, found) else { return };
            laid.shape = Shape::Rect(rect);
            laid.centre = centre(&laid.shape);
        }
        shape @ Shape::Polygon(_) => {
            let within = shape.part_in(world.bounds);
            // a polygon may lie outside though the rectangle about it does not
            let is_in = within.unsigned_area() > 0.0;
            let rect = if is_in { enclosing } else { Rect::around([]) };
            if inside(world.bounds, text, "area", rect, area, found).is_none() {
                return;
            }
            laid.centre = within.centroid().map_or(laid.centre, |p| Point::new(p.x(), p.y()));
        }
    }
    world.areas.push(laid);
}

pub(super) fn add_door(world: &mut World, text: &Text, door: &Located<NamedDoor>, found: &mut Vec<Problem>) {
    let NamedDoor { name, from, to, .. } = &door.value;
    if let Some(problem) = taken(world, text, "door", name, &door.span) {
        found.push(problem);
        return;
    }
    let Some((from, to)) = world.bounds.clip(*from, *to) else {
        let environment = extent(world.bounds);
        let message = format!("the door `{name}` lies outside of the environment, which is {environment}");
        found.push(text.problem(Code::Outside, &door.span, message));
        return;
    };
    if (from, to) != (door.value.from, door.value.to) {
        let message = format!("the door `{name}` is cut at the edge of the environment");
        found.push(text.problem(Code::Clipped, &door.span, message).as_advice());
    }
    if is_walled(world, from, to) {
        let message = format!("the door `{name}` lies in walls from end to end: nobody passes it");
        let problem = text.problem(Code::DoorInWall, &door.span, message).as_advice();
        found.push(problem.with_help("draw it across the opening, from post to post"));
    }
    world.named_doors.push(NamedDoor { from, to, ..door.value.clone() });
}

/// Properties of this text against those of the world: each holds values of one kind.
pub(super) fn one_kind_each(world: &World, text: &Text, given: &[Located<Given>], found: &mut Vec<Problem>) {
    let known: Vec<(&str, &(String, Property))> = crate::overlays::further(world).collect();
    for Located { value: Given { class, property, kind }, span } in given {
        let same = |(of, (name, _)): &&(&str, &(String, Property))| of == class && name == property;
        if let Some((_, (_, value))) = known.iter().find(same)
            && value.kind() != *kind
        {
            let message = format!(
                "`{property}` is a {kind} here and a {} in the map: a property holds values of one kind",
                value.kind()
            );
            found.push(text.problem(Code::WrongType, span, message));
        }
    }
}

/// Whether a segment lies in something solid, looked at in 200 places.
fn is_walled(world: &World, from: Point, to: Point) -> bool {
    (0..200).map(|step| (f64::from(step) + 0.5) / 200.0).all(|share| world.is_solid(from.lerp(to, share)))
}
