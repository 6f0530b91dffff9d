//! Where a doorway is meant by a point, or the cross-section at which a robot was blocked.

use adit_db::space::Doorway;
use adit_planners::geometry::{Point, Segment};
use adit_planners::world::World;

use crate::error::{Code, Error, Result};
use crate::graph::Building;
use crate::knowledge::told::Object;
use crate::words::number::number;
use crate::words::point::point;

/// A robot that is blocked stands at most so far before a doorway, or in it, metres.
const BEFORE_M: f64 = 1.75;

/// What blocks a robot in no doorway is so far ahead of its middle, metres, where there is room.
const AHEAD_M: f64 = 0.5;

/// Steps in which walls are looked for on both sides of a robot, metres.
const STEP_M: f64 = 0.02;

/// Farther than this no wall is looked for, metres.
const FURTHEST_M: f64 = 50.0;

/// A robot takes itself to be at most so far off, metres; in so many directions the floor is looked for.
const ASTRAY_M: f64 = 0.3;
const TURNS: i32 = 32;

/// Where there is less room than this, along and across, no robot stands, metres.
const LEAST_M: f64 = 0.2;

/// A point, with a heading in degrees where one is said: `x,y` or `x,y@degrees`.
pub(crate) fn split(text: &str) -> Option<(Point, Option<f64>)> {
    let (at, heading) = match text.split_once('@') {
        Some((at, heading)) => {
            (at, Some(heading.trim().parse().ok().filter(|degrees: &f64| degrees.is_finite())?))
        }
        None => (text, None),
    };
    point(at).map(|at| (at, heading))
}

/// The doorway, or else the cross-section, at which a robot was blocked that stood at a point and was heading somewhere; the
/// doorway that is nearest to a point where no heading is said.
pub(crate) fn at(world: &World, building: &Building, (at, heading): (Point, Option<f64>)) -> Result<Object> {
    let doorways = building.doorways.iter().map(Building::segment);
    let Some(heading) = heading else {
        let nearest = doorways.min_by(|one, other| one.distance(at).total_cmp(&other.distance(at)));
        if let Some(segment) = nearest.filter(|segment| segment.distance(at) <= BEFORE_M) {
            return Ok(object(segment));
        }
        let place = format!("{},{}", number(at.x), number(at.y));
        let message = match nearest {
            Some(nearest) => format!("the nearest doorway to {place} is {:.2} m away", nearest.distance(at)),
            None => format!("no doorway is near {place}: the map has none"),
        };
        let help = format!("say a heading, too, and what is ahead of it is closed: {place}@90");
        return Err(Error::said(Code::TellNoDoor, message, Some(help)));
    };
    // what is white on an image beyond a wall, or within one, is no floor
    let is_inside = |at: Point| building.spaces.is_empty() || building.space_at(at).is_some();
    let is_floor = |at: Point| world.bounds.contains(at) && !world.is_solid(at) && is_inside(at);
    let ahead = Point::towards(heading.to_radians());
    let is_roomy = |at: Point| {
        let both = |way: Point| {
            free_along(world, building, at, way) + free_along(world, building, at, -way) >= LEAST_M
        };
        is_floor(at) && both(ahead) && both(ahead.perpendicular())
    };
    let Some(at) = beside(at, is_roomy).or_else(|| Some(at).filter(|&at| is_floor(at))) else {
        let message = format!("{},{} is not on the floor, nor is what is near", number(at.x), number(at.y));
        return Err(Error::said(Code::TellNoDoor, message, None));
    };
    let way = Segment::new(at, at + ahead * BEFORE_M);
    let met = doorways.filter(|doorway| doorway.crosses(&way) || doorway.distance(at) < STEP_M);
    if let Some(doorway) = met.min_by(|one, other| one.distance(at).total_cmp(&other.distance(at))) {
        return Ok(object(doorway));
    }
    let reach = free_along(world, building, at, ahead);
    let middle = at + ahead * AHEAD_M.min(reach / 2.0);
    let across = ahead.perpendicular();
    let [left, right] =
        [across, -across].map(|side| middle + side * free_along(world, building, middle, side));
    Ok(object(Segment::new(left, right)))
}

/// The point, or the nearest one on the floor: a robot's idea of where it is may lie a little within a wall.
fn beside(at: Point, is_floor: impl Fn(Point) -> bool) -> Option<Point> {
    if is_floor(at) {
        return Some(at);
    }
    let around = |turn: i32| Point::towards(f64::from(turn) * std::f64::consts::TAU / f64::from(TURNS));
    let rings = (1..).map(|ring| f64::from(ring) * STEP_M).take_while(|metres| *metres <= ASTRAY_M);
    let points = rings.flat_map(|metres| (0..TURNS).map(move |turn| (metres, turn)));
    points.map(|(metres, turn)| at + around(turn) * metres).find(|&point| is_floor(point))
}

pub(super) fn object(segment: Segment) -> Object {
    let middle = segment.middle();
    let Segment { a, b } = segment;
    Object::Point([middle.x, middle.y], Some([a.x, a.y, b.x, b.y]))
}

/// How far the floor goes on in a direction, up to a wall or into another space, metres.
fn free_along(world: &World, building: &Building, from: Point, direction: Point) -> f64 {
    let mut metres = 0.0;
    let mut here = from;
    while metres < FURTHEST_M {
        let next = from + direction * (metres + STEP_M);
        let step = Segment::new(here, next);
        let is_left = building.doorways.iter().any(|doorway| is_passed(doorway, &step));
        if is_left || !world.bounds.contains(next) || world.is_solid(next) {
            break;
        }
        metres += STEP_M;
        here = next;
    }
    metres
}

/// Whether a step leads through a doorway, or along one of its posts.
fn is_passed(doorway: &Doorway, step: &Segment) -> bool {
    let of = Building::segment(doorway);
    let aside = of.direction() * STEP_M;
    Segment::new(of.a - aside, of.b + aside).crosses(step)
}

#[cfg(test)]
mod tests {
    use adit_planners::geometry::Rect;
    use adit_planners::world::{Obstacle, Shape};

    use super::*;

    #[test]
    fn a_cross_section_along_the_post_of_a_doorway_ends_at_the_doorway() {
        let mut world = World::empty(Rect::new(0.0, 0.0, 6.0, 10.0));
        let wall = |x0, x1| Obstacle { shape: Shape::Rect(Rect::new(x0, 5.9, x1, 6.1)) };
        world.obstacles.extend([wall(0.0, 2.0), wall(3.2, 6.0)]);
        let doorway = Doorway { doorway: 1, x0: 2.0, y0: 6.0, x1: 3.2, y1: 6.0, ..Doorway::default() };
        let building = Building { doorways: vec![doorway], ..Building::default() };
        let Ok(Object::Point(_, Some([x0, y0, x1, y1]))) =
            at(&world, &building, (Point::new(1.5, 8.0), Some(0.0)))
        else {
            panic!("it is a cross-section")
        };
        assert!((x0 - 2.0).abs() < 1e-9 && (x1 - 2.0).abs() < 1e-9, "{x0} {x1}");
        let [low, high] = [y0.min(y1), y0.max(y1)];
        assert!(low > 5.9 && high > 9.9, "from {low} to {high}");
    }
}
