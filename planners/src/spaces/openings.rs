//! Openings: where walls come near to each other and the floor is wider on both sides, as at a door.
//!
//! Tips of walls are the corners about which the floor turns by more than half a turn. From each a straight line may lead
//! to another tip, or straight on to a wall; it is an opening where the floor beside it, on either side and within
//! [`DEPTH_M`], goes on past an end of it (Mora et al. 2022 look for narrow passages beside protruding walls). Of two
//! lines that share a tip the much shorter one is meant, and of some that lie beside each other one.

use rayon::prelude::*;

use crate::geometry::outline::{outlines, simplified};
use crate::geometry::{Point, Segment};
use crate::world::Occupancy;

/// The widest opening, metres; what is wider joins.
const WIDEST_M: f64 = 2.2;

/// As deep as walls may be thick, metres.
const DEPTH_M: f64 = 0.6;

/// The floor is looked at so far past the ends of an opening, metres.
const ASIDE_M: f64 = 2.0;

/// A wall protrudes where the floor goes on past its tip by so much on both sides, metres.
const PROTRUDES_M: f64 = 0.25;

/// The floor on either side is so many times as wide as the opening.
const WIDER: f64 = 1.3;

/// An opening goes on as the wall at a tip does, up to this angle, degrees.
const ASKEW_DEGREES: f64 = 40.0;

/// Outlines are simplified by no more than this, cells: noise of a scan is no tip.
const NOISE_CELLS: f64 = 1.6;

/// A corner is a tip where the wall turns by more, degrees.
const TURN_DEGREES: f64 = 25.0;

/// Openings whose middles are nearer to another one are that one, metres.
const BESIDE_M: f64 = 0.5;

/// Tips nearer than this are of one wall's end, metres.
const ONE_END_M: f64 = 0.3;

/// A line from a wall's end gives way to one of less than this share of its length.
const SHORTER: f64 = 0.8;

/// Steps along lines of sight, cells.
const STEP_CELLS: f64 = 0.5;

/// A corner about which the floor turns, with the directions in which its walls would go on.
struct Tip {
    at: Point,
    onward: Vec<Point>,
}

/// A line that may be an opening, in cells.
struct Line {
    segment: Segment,
    tips: Vec<Point>,
}

/// The openings of a floor, in cells.
pub(super) fn openings(floor: &Occupancy) -> Vec<Segment> {
    let outlines: Vec<Vec<Point>> =
        outlines(floor.columns, floor.rows, |column, row| !floor.is_blocked(column, row))
            .iter()
            .map(|outline| simplified(outline, NOISE_CELLS))
            .filter(|outline| outline.len() > 2)
            .collect();
    let tips: Vec<Tip> = outlines.iter().flat_map(|outline| tips(outline)).collect();
    let walls: Vec<Segment> =
        outlines.iter().flat_map(|outline| crate::geometry::polygon::sides(outline)).collect();
    let widest = WIDEST_M / floor.resolution;
    let lines = tips.par_iter().enumerate().flat_map_iter(|(number, tip)| {
        let near = move |p: Point| (2.0..=widest).contains(&tip.at.distance(p));
        let others = tips[number + 1..].iter().filter(move |other| near(other.at));
        let to_tips = others.filter_map(move |other| opening(floor, tip, other.at, Some(other)));
        let feet = walls.iter().map(move |wall| (wall, wall.nearest_to(tip.at)));
        let feet = feet.filter(move |(wall, foot)| *foot != wall.a && *foot != wall.b && near(*foot));
        to_tips.chain(feet.filter_map(move |(_, foot)| opening(floor, tip, foot, None)))
    });
    chosen(lines.collect(), floor.resolution)
}

fn tips(outline: &[Point]) -> impl Iterator<Item = Tip> + '_ {
    let count = outline.len();
    (0..count).filter_map(move |place| {
        let at = outline[place];
        let (to, on) = (at - outline[(place + count - 1) % count], outline[(place + 1) % count] - at);
        let turn = to.cross(on).atan2(to.dot(on)).to_degrees();
        // a side of a cell or two says nothing of the wall's direction
        let sides = [to, -on].into_iter().filter(|side| side.length() >= 2.5);
        let onward = sides.map(|side| Segment::new(Point::default(), side).direction()).collect();
        (turn < -TURN_DEGREES).then_some(Tip { at, onward })
    })
}

/// The line from a tip to another one, or to a wall, if it is an opening.
fn opening(floor: &Occupancy, tip: &Tip, to: Point, other: Option<&Tip>) -> Option<Line> {
    let segment = Segment::new(tip.at, to);
    let (length, along) = (segment.length(), segment.direction());
    let margin = if length > 4.0 { 1.5 / length } else { 0.3 };
    let steps = (length / STEP_CELLS) as usize + 2;
    let share = |step: usize| margin + (1.0 - 2.0 * margin) * step as f64 / (steps - 1) as f64;
    if !(0..steps).all(|step| is_free(floor, segment.at(share(step)))) {
        return None;
    }
    let left = along.perpendicular();
    let sides = [left, -left];
    let past = |end: Point, out: Point| sides.map(|side| past(floor, end, out, side));
    let (here, there) = (past(segment.a, -along), past(segment.b, along));
    let protrudes = |past: [f64; 2], tip: &Tip, out: Point| {
        let askew = |wall: &Point| wall.dot(out).clamp(-1.0, 1.0).acos().to_degrees() > ASKEW_DEGREES;
        past[0].min(past[1]) >= PROTRUDES_M && (tip.onward.is_empty() || !tip.onward.iter().all(askew))
    };
    let wide = length * floor.resolution;
    let is_wider = |side: usize| wide + here[side] + there[side] >= WIDER * wide;
    let is_end = protrudes(here, tip, along) || other.is_some_and(|tip| protrudes(there, tip, -along));
    let tips = std::iter::once(tip.at).chain(other.map(|tip| tip.at)).collect();
    (is_end && is_wider(0) && is_wider(1)).then_some(Line { segment, tips })
}

/// How far the floor goes on past an end of a line, on one side of it, metres.
fn past(floor: &Occupancy, end: Point, out: Point, side: Point) -> f64 {
    let most = (ASIDE_M / floor.resolution / STEP_CELLS) as usize;
    let mut furthest = 0;
    let mut aside = 1.5;
    while aside <= DEPTH_M / floor.resolution {
        let from = end + side * aside;
        if !is_free(floor, from - out) {
            break;
        }
        let free = (0..most).take_while(|step| is_free(floor, from + out * (*step as f64 * STEP_CELLS)));
        furthest = furthest.max(free.count());
        aside += 1.0;
    }
    furthest as f64 * STEP_CELLS * floor.resolution
}

fn is_free(floor: &Occupancy, p: Point) -> bool {
    let is_inside = p.x >= 0.0 && p.y >= 0.0 && p.x < floor.columns as f64 && p.y < floor.rows as f64;
    is_inside && !floor.is_blocked(p.x as usize, p.y as usize)
}

/// The shortest first, each where none that was chosen before stands for it.
fn chosen(mut lines: Vec<Line>, resolution: f64) -> Vec<Segment> {
    lines.sort_by(|a, b| a.segment.length().total_cmp(&b.segment.length()));
    let mut chosen: Vec<Segment> = Vec::new();
    for line in lines {
        let middle = line.segment.middle();
        let stands_for = |known: &Segment| {
            let is_end =
                |tip: &Point| tip.distance(known.a).min(tip.distance(known.b)) * resolution < ONE_END_M;
            known.distance(middle) * resolution < BESIDE_M
                || known.length() < SHORTER * line.segment.length() && line.tips.iter().any(is_end)
        };
        if !chosen.iter().any(stands_for) {
            chosen.push(line.segment);
        }
    }
    chosen
}

/// Openings that are drawn, in the place of those found beside them, and all others.
pub(super) fn with_drawn(found: Vec<Segment>, drawn: Vec<Segment>, floor: &Occupancy) -> Vec<Segment> {
    let is_beside = |one: &Segment, drawn: &Segment| {
        let off = one.distance(drawn.middle()).min(drawn.distance(one.middle()));
        off * floor.resolution < BESIDE_M
    };
    let others = found.into_iter().filter(|one| !drawn.iter().any(|drawn| is_beside(one, drawn)));
    others.collect::<Vec<_>>().into_iter().chain(drawn).collect()
}

/// Closes the floor along openings, so that cells on both sides touch nowhere, not even in a corner.
pub(super) fn close(floor: &mut Occupancy, openings: &[Segment]) {
    for opening in openings {
        let along = opening.direction();
        let line = Segment::new(opening.a - along * 1.2, opening.b + along * 1.2);
        let steps = (line.length() * 4.0) as usize + 2;
        let mut before: Option<(i64, i64)> = None;
        for step in 0..=steps {
            let p = line.at(step as f64 / steps as f64);
            let cell = (p.x.floor() as i64, p.y.floor() as i64);
            block(floor, cell);
            if let Some((column, _)) = before.filter(|before| before.0 != cell.0 && before.1 != cell.1) {
                block(floor, (column, cell.1));
            }
            before = Some(cell);
        }
    }
}

fn block(floor: &mut Occupancy, (column, row): (i64, i64)) {
    if let (Ok(column), Ok(row)) = (usize::try_from(column), usize::try_from(row))
        && column < floor.columns
        && row < floor.rows
    {
        floor.blocked[row * floor.columns + column] = true;
    }
}
