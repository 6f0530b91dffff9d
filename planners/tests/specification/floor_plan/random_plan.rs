//! Random buildings: rooms by repeated halving, doors that join all of them, pillars, oblique free-standing walls,
//! and the whole turned by a random angle.

use adit_planners::floor_plan::{Drawn, FloorPlan};
use adit_planners::geometry::{Point, Rect};
use adit_planners::world::Place;

use super::dice::Dice;

const DOOR_M: [f64; 2] = [0.9, 1.3];
const APART_M: f64 = 0.8;

/// A wall between two lines of rooms; `at` is its constant coordinate.
struct Split {
    is_upright: bool,
    at: f64,
    from: f64,
    to: f64,
}

/// A building of about `rooms` rooms.
pub fn random_plan(seed: u64, rooms: usize) -> FloorPlan {
    FloorPlan::new(random_drawing(seed, rooms)).unwrap_or_else(|errors| panic!("seed {seed}: {errors}"))
}

pub fn random_drawing(seed: u64, rooms: usize) -> Drawn {
    let mut dice = Dice::new(seed);
    let side = (rooms as f64 * dice.between(14.0, 40.0)).sqrt();
    let stretch = dice.between(0.8, 1.5);
    let outer = Rect::new(0.0, 0.0, side * stretch, side / stretch);
    let (mut rects, mut splits) = (vec![outer], Vec::new());
    while rects.len() < rooms {
        let largest = (0..rects.len()).max_by(|&a, &b| rects[a].area().total_cmp(&rects[b].area()));
        let largest = largest.expect("there is always a room");
        let rect = rects.swap_remove(largest);
        let share = dice.between(0.35, 0.65);
        let is_upright = rect.dx() > rect.dy();
        if is_upright {
            let at = rect.x0 + share * rect.dx();
            rects.push(Rect { x1: at, ..rect });
            rects.push(Rect { x0: at, ..rect });
            splits.push(Split { is_upright, at, from: rect.y0, to: rect.y1 });
        } else {
            let at = rect.y0 + share * rect.dy();
            rects.push(Rect { y1: at, ..rect });
            rects.push(Rect { y0: at, ..rect });
            splits.push(Split { is_upright, at, from: rect.x0, to: rect.x1 });
        }
    }
    let mut walls = outline(&outer);
    walls.extend(with_doors(&rects, &splits, &mut dice));
    let mut solids = Vec::new();
    for rect in &rects {
        furnish(rect, &mut walls, &mut solids, &mut dice);
    }
    let mut places = Vec::new();
    for (number, rect) in rects.iter().enumerate() {
        if let Some(at) = free_spot(rect, &walls, &solids, &mut dice) {
            places.push(Place { name: format!("room-{number}"), at });
        }
    }
    let angle = if dice.below(3) == 0 { 0.0 } else { dice.between(0.0, 6.0) };
    let (sin, cos) = angle.sin_cos();
    let turned = |p: Point| Point::new(cos * p.x - sin * p.y, sin * p.x + cos * p.y);
    Drawn {
        name: format!("random-{seed}"),
        walls: walls.into_iter().map(|wall| wall.map(turned)).collect(),
        solids: solids.into_iter().map(|solid: Vec<Point>| solid.into_iter().map(turned).collect()).collect(),
        places: places.into_iter().map(|place| Place { at: turned(place.at), ..place }).collect(),
    }
}

fn outline(r: &Rect) -> Vec<[Point; 2]> {
    let corners = [(r.x0, r.y0), (r.x1, r.y0), (r.x1, r.y1), (r.x0, r.y1)].map(|(x, y)| Point::new(x, y));
    (0..4).map(|i| [corners[i], corners[(i + 1) % 4]]).collect()
}

/// The walls of the splits, with doors that join all rooms, and some more.
fn with_doors(rects: &[Rect], splits: &[Split], dice: &mut Dice) -> Vec<[Point; 2]> {
    let range = |r: &Rect, split: &Split| if split.is_upright { (r.y0, r.y1) } else { (r.x0, r.x1) };
    let mut openings = Vec::new();
    for (number, split) in splits.iter().enumerate() {
        let touches = |low: f64, high: f64| (low - split.at).abs() < 1e-9 || (high - split.at).abs() < 1e-9;
        let beside = |r: &&Rect| {
            let (from, to) = range(r, split);
            let meets = if split.is_upright { touches(r.x0, r.x1) } else { touches(r.y0, r.y1) };
            meets && from < split.to - 1e-9 && split.from + 1e-9 < to
        };
        let near: Vec<(usize, &Rect)> = rects.iter().enumerate().filter(|(_, r)| beside(r)).collect();
        let before =
            |r: &Rect| if split.is_upright { r.x1 < split.at + 1e-9 } else { r.y1 < split.at + 1e-9 };
        for &(a, first) in near.iter().filter(|(_, r)| before(r)) {
            for &(b, second) in near.iter().filter(|(_, r)| !before(r)) {
                let ((f0, t0), (f1, t1)) = (range(first, split), range(second, split));
                let (from, to) = (f0.max(f1), t0.min(t1));
                let width = dice.between(DOOR_M[0], DOOR_M[1]);
                if to - from > width + 0.5 {
                    let start = dice.between(from + 0.2, to - 0.2 - width);
                    openings.push((number, a, b, start, start + width));
                }
            }
        }
    }
    dice.shuffle(&mut openings);
    let mut group: Vec<usize> = (0..rects.len()).collect();
    let mut gaps: Vec<Vec<(f64, f64)>> = vec![Vec::new(); splits.len()];
    for (number, a, b, from, to) in openings {
        let joins = group[a] != group[b];
        if joins || dice.below(3) == 0 {
            let (old, new) = (group[a], group[b]);
            group.iter_mut().filter(|g| **g == old).for_each(|g| *g = new);
            gaps[number].push((from, to));
        }
    }
    let mut walls = Vec::new();
    for (split, mut gaps) in splits.iter().zip(gaps) {
        gaps.sort_by(|a, b| a.0.total_cmp(&b.0));
        let point = |along: f64| {
            if split.is_upright { Point::new(split.at, along) } else { Point::new(along, split.at) }
        };
        let mut last = split.from;
        for (from, to) in gaps {
            walls.push([point(last), point(from)]);
            last = to;
        }
        walls.push([point(last), point(split.to)]);
    }
    walls
}

/// Pillars and free-standing walls, apart from the walls of the room and from each other.
fn furnish(room: &Rect, walls: &mut Vec<[Point; 2]>, solids: &mut Vec<Vec<Point>>, dice: &mut Dice) {
    let mut taken: Vec<(Point, f64)> = Vec::new();
    for _ in 0..=dice.below(3) {
        let radius = dice.between(0.15, 0.6);
        let keep = radius + APART_M;
        if room.dx() < 2.0 * keep || room.dy() < 2.0 * keep {
            continue;
        }
        let centre = Point::new(
            dice.between(room.x0 + keep, room.x1 - keep),
            dice.between(room.y0 + keep, room.y1 - keep),
        );
        if taken.iter().any(|(other, size)| centre.distance(*other) < size + keep) {
            continue;
        }
        taken.push((centre, radius));
        let angle = if dice.below(2) == 0 { 0.0 } else { dice.between(0.0, 3.0) };
        let at = |turn: f64| Point::new(centre.x + radius * turn.cos(), centre.y + radius * turn.sin());
        if dice.below(3) == 0 {
            walls.push([at(angle), at(angle + std::f64::consts::PI)]);
        } else {
            let corners = 3 + dice.below(4);
            let step = std::f64::consts::TAU / corners as f64;
            solids.push((0..corners).map(|i| at(angle + step / 2.0 + i as f64 * step)).collect());
        }
    }
}

fn free_spot(room: &Rect, walls: &[[Point; 2]], solids: &[Vec<Point>], dice: &mut Dice) -> Option<Point> {
    let is_clear = |p: Point| {
        let from_walls = walls.iter().all(|[a, b]| p.distance(p.nearest_on(*a, *b)) > 0.35);
        from_walls
            && solids.iter().all(|solid| {
                let centre = solid.iter().fold(Point::default(), |c, p| Point::new(c.x + p.x, c.y + p.y));
                let count = solid.len() as f64;
                p.distance(Point::new(centre.x / count, centre.y / count)) > 1.0
            })
    };
    (0..50)
        .map(|_| Point::new(dice.between(room.x0, room.x1), dice.between(room.y0, room.y1)))
        .find(|&p| is_clear(p))
}
