//! Floors and robots by chance.

use adit_planners::geometry::{Point, Rect};
use adit_planners::world::Shape;

use super::body::Body;
use super::plan::Plan;
use super::random::Chance;

/// A hall of some obstacles: boxes, polygons of three to six corners, low pipes.
pub fn hall(chance: &mut Chance) -> Plan {
    let mut plan = Plan::hall(chance.metres(6.0, 10.0).round(), chance.metres(5.0, 8.0).round());
    for _ in 0..4 + chance.below(8) {
        let (x, y) = (chance.metres(0.0, plan.width), chance.metres(0.0, plan.depth));
        if chance.is(0.5) {
            let (dx, dy) = (chance.metres(0.1, 2.0), chance.metres(0.1, 2.0));
            plan.add(Rect::new(x, y, (x + dx).min(plan.width), (y + dy).min(plan.depth)));
        } else {
            plan.obstacles.push(Shape::Polygon(polygon(chance, Point::new(x, y))));
        }
    }
    plan.obstacles.retain(|shape| {
        let r = shape.enclosing_rect();
        r.dx() > 0.02 && r.dy() > 0.02
    });
    for _ in 0..chance.below(3) {
        let (x, y) = (chance.metres(0.5, plan.width - 1.5), chance.metres(0.0, plan.depth - 2.0));
        let height = chance.metres(0.7, 1.9);
        let thick = chance.metres(0.2, 1.0);
        let rect = if chance.is(0.5) {
            Rect::new(x, 0.0, x + thick, plan.depth)
        } else {
            Rect::new(0.0, y, plan.width, y + thick)
        };
        plan.bridges.push((rect, height));
    }
    plan
}

/// Corners around a middle, in turn: simple, not always convex.
fn polygon(chance: &mut Chance, middle: Point) -> Vec<Point> {
    let count = 3 + chance.below(4);
    let first = chance.between(0.0, 1.0);
    (0..count)
        .map(|corner| {
            let turn = (first + corner as f64 + chance.between(0.0, 0.5)) / count as f64;
            let (sin, cos) = (turn * std::f64::consts::TAU).sin_cos();
            let far = chance.between(0.3, 1.2);
            let round = |v: f64| (v * 100.0).round() / 100.0;
            Point::new(round(middle.x + far * cos), round(middle.y + far * sin))
        })
        .collect()
}

/// A floor of rooms on both sides of a corridor: thin walls, doorways, furniture, a pipe across the corridor.
pub fn wards(chance: &mut Chance) -> Plan {
    let rooms = 2 + chance.below(3);
    let (wide, deep, corridor) = (chance.metres(2.6, 3.6), chance.metres(2.4, 3.2), chance.metres(1.6, 2.4));
    let (width, depth) = (wide * rooms as f64, 2.0 * deep + corridor);
    let mut plan = Plan::hall((width * 10.0).ceil() / 10.0, (depth * 10.0).ceil() / 10.0);
    let thick = chance.metres(0.1, 0.3);
    for upper in [false, true] {
        let wall = if upper { deep + corridor } else { deep - thick };
        for room in 0..rooms {
            let left = wide * room as f64;
            if room > 0 {
                let (y0, y1) = if upper { (wall + thick, plan.depth) } else { (0.0, wall) };
                plan.add(Rect::new(left - thick / 2.0, y0, left + thick / 2.0, y1));
            }
            let gap = chance.metres(0.5, 1.3);
            let door = left + chance.metres(0.3, wide - gap - 0.3);
            plan.add(Rect::new(left, wall, door, wall + thick));
            let right = if room + 1 == rooms { plan.width } else { left + wide };
            plan.add(Rect::new(door + gap, wall, right, wall + thick));
            for _ in 0..chance.below(3) {
                let (dx, dy) = (chance.metres(0.3, 0.9), chance.metres(0.3, 1.2));
                let x = left + chance.metres(0.2, wide - dx - 0.2);
                let y = if upper { wall + thick } else { 0.0 } + chance.metres(0.0, deep - thick - dy);
                plan.add(Rect::new(x, y, x + dx, y + dy));
            }
        }
    }
    for _ in 0..chance.below(3) {
        let x = chance.metres(0.5, plan.width - 1.5);
        let rect = Rect::new(x, deep, x + chance.metres(0.2, 0.8), deep + corridor);
        plan.bridges.push((rect, chance.metres(0.7, 1.8)));
    }
    // A stored bed in the corridor leaves a gap beside it.
    let bed = chance.metres(0.5, plan.width - 2.0);
    let rect = Rect::new(bed, deep, bed + 1.2, deep + chance.metres(0.4, corridor - 0.5));
    plan.add(rect);
    plan
}

/// The same floor with one or two wet or dry areas, that do not overlap.
#[must_use]
pub fn with_areas(mut plan: Plan, chance: &mut Chance) -> Plan {
    // In tenths, so that an outline lies on the lines of any grid that divides them.
    let tenths = |value: f64| (value * 10.0).round() / 10.0;
    let middle = tenths(plan.width / 2.0);
    for (left, right) in [(0.0, middle), (middle, plan.width)] {
        if chance.is(0.75) {
            let (x, y) = (chance.between(left, right - 1.0), chance.between(0.0, plan.depth - 1.0));
            let (dx, dy) = (chance.between(0.5, right - x), chance.between(0.5, plan.depth - y));
            let rect = Rect::new(tenths(x), tenths(y), tenths(x + dx), tenths(y + dy));
            plan.areas.push((rect, chance.metres(1.2, 4.0)));
        }
    }
    plan
}

/// A robot of two to four states. Changes, where there are any, cost so that no detour over a third state is cheaper.
pub fn body(chance: &mut Chance) -> Body {
    let states = states(chance);
    let count = 2 + chance.below(3);
    let body = Body::new(&states[..count]);
    if chance.is(0.3) {
        return body;
    }
    let (low, high) = if chance.is(0.5) { (0.2, 0.4) } else { (1.0, 2.0) };
    changing(body, || chance.metres(low, high))
}

/// A robot of three or four states of which some changes cost more than two others that come to the same.
pub fn uneven_body(chance: &mut Chance) -> Body {
    let states = states(chance);
    let count = 3 + chance.below(2);
    let dear = chance.metres(2.0, 8.0);
    changing(Body::new(&states[..count]), || if chance.is(0.4) { dear } else { chance.metres(0.2, 1.0) })
}

fn states(chance: &mut Chance) -> [(&'static str, f64, f64, f64); 4] {
    [
        ("STAND", chance.metres(1.5, 1.9), chance.metres(0.5, 0.7), 1.0),
        ("SIDE", chance.metres(1.5, 1.9), chance.metres(0.3, 0.4), chance.metres(1.2, 2.5)),
        ("SQUAT", chance.metres(0.9, 1.2), chance.metres(0.5, 0.8), chance.metres(1.5, 4.0)),
        ("LIE", chance.metres(0.5, 0.7), chance.metres(0.4, 0.8), chance.metres(3.0, 8.0)),
    ]
}

/// The same with each change at a price.
fn changing(body: Body, mut price: impl FnMut() -> f64) -> Body {
    let count = body.states.len();
    let pairs =
        (0..count).flat_map(|from| (0..count).map(move |to| (from, to))).filter(|(from, to)| from != to);
    let changes: Vec<_> = pairs.map(|(from, to)| (from, to, price())).collect();
    body.with_changes(&changes)
}
