//! Straight lines across the floor from the tips of walls, each of which may be where one space ends and another begins.
//!
//! Tips are the corners about which the floor turns by more than half a turn. From each a line may lead to another tip, or
//! straight on to a wall. It is as short as it can be: an end that could slide along its wall to make it shorter is none.

use rayon::prelude::*;

use crate::geometry::outline::{outlines, simplified};
use crate::geometry::{Point, Rect, Segment, polygon};
use crate::rect_index::RectIndex;
use crate::world::Occupancy;

/// The longest line, metres; where the floor is wider it is one space.
const LONGEST_M: f64 = 4.0;

/// The widest opening, metres; what is wider parts only what is wider still.
const WIDEST_M: f64 = 2.2;

/// As deep as walls may be thick, metres.
const DEPTH_M: f64 = 0.6;

/// The floor is looked at so far past the ends of a line, metres.
const ASIDE_M: f64 = 2.0;

/// A wall protrudes where the floor goes on past its tip by so much, metres; a table's leg at a wall does not.
const PROTRUDES_M: f64 = 0.3;

/// The floor beside an opening is so many times as wide.
const WIDER: f64 = 1.2;

/// An end slides along a wall at less than this angle to the line, degrees.
const SLIDES_DEGREES: f64 = 60.0;

/// A shorter side of an outline, cells, says nothing of the direction of a wall.
const LEAST_SIDE_CELLS: f64 = 4.0;

/// Outlines are simplified by no more than this, cells: noise of a scan is no tip.
const NOISE_CELLS: f64 = 1.6;

/// A corner is a tip where the wall turns by more, degrees.
const TURN_DEGREES: f64 = 25.0;

/// Steps along lines of sight, cells.
const STEP_CELLS: f64 = 0.5;

/// A corner about which the floor turns, with the directions in which its walls lead away.
struct Tip {
    at: Point,
    away: Vec<Point>,
}

/// In cells.
pub(super) struct Line {
    pub segment: Segment,
    /// Whether the second end is a tip, as the first one is; else it lies on a wall.
    pub is_between_tips: bool,
}

/// What a line may be, by how the floor goes on beside it.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum Kind {
    /// A wall protrudes, and the floor is wider on both sides.
    Opening,
    /// The same, and wider than doors are.
    Wide,
    /// The floor is wider on one side, as where a corridor comes into a hall.
    Mouth,
}

/// The lines of a floor, the shortest first.
pub(super) fn lines(floor: &Occupancy) -> Vec<Line> {
    let outlines: Vec<Vec<Point>> =
        outlines(floor.columns, floor.rows, |column, row| !floor.is_blocked(column, row))
            .iter()
            .map(|outline| simplified(outline, NOISE_CELLS))
            .filter(|outline| outline.len() > 2)
            .collect();
    let tips: Vec<Tip> = outlines.iter().flat_map(|outline| tips(outline)).collect();
    let walls: Vec<Segment> = outlines.iter().flat_map(|outline| polygon::sides(outline)).collect();
    let longest = LONGEST_M / floor.resolution;
    let tips_at = RectIndex::new(tips.iter().map(|tip| Rect::around([tip.at])));
    let walls_at = RectIndex::new(walls.iter().map(Segment::bounds));
    let about = |index: &RectIndex, at: Point| {
        let mut found: Vec<usize> = index.meeting(Rect::around([at]).grown(longest)).collect();
        found.sort_unstable();
        found.into_iter()
    };
    let (tips, walls) = (&tips[..], &walls[..]);
    let lines = tips.par_iter().enumerate().flat_map_iter(|(number, tip)| {
        let near = move |p: Point| (2.0..=longest).contains(&tip.at.distance(p));
        let others = about(&tips_at, tip.at).filter(move |other| *other > number);
        let others = others.map(move |other| &tips[other]).filter(move |other| near(other.at));
        let to_tips = others.filter_map(move |other| line(floor, tip, other.at, Some(other)));
        let feet = about(&walls_at, tip.at).map(move |wall| &walls[wall]);
        let feet = feet.map(move |wall| (wall, wall.nearest_to(tip.at)));
        let feet = feet.filter(move |(wall, foot)| *foot != wall.a && *foot != wall.b && near(*foot));
        to_tips.chain(feet.filter_map(move |(_, foot)| line(floor, tip, foot, None)))
    });
    let mut lines: Vec<Line> = lines.collect();
    lines.sort_by(|a, b| a.segment.length().total_cmp(&b.segment.length()));
    lines
}

fn tips(outline: &[Point]) -> impl Iterator<Item = Tip> + '_ {
    let count = outline.len();
    (0..count).filter_map(move |place| {
        let at = outline[place];
        let (to, on) = (at - outline[(place + count - 1) % count], outline[(place + 1) % count] - at);
        let turn = to.cross(on).atan2(to.dot(on)).to_degrees();
        let sides = [-to, on].into_iter().filter(|side| side.length() >= LEAST_SIDE_CELLS);
        let away = sides.map(|side| Segment::new(Point::default(), side).direction()).collect();
        (turn < -TURN_DEGREES).then_some(Tip { at, away })
    })
}

/// The line from a tip to another one, or to a wall, if it may be anything.
fn line(floor: &Occupancy, tip: &Tip, to: Point, other: Option<&Tip>) -> Option<Line> {
    let segment = Segment::new(tip.at, to);
    let (length, along) = (segment.length(), segment.direction());
    let most = SLIDES_DEGREES.to_radians().cos();
    let slides = |tip: &Tip, along: Point| tip.away.iter().any(|wall| wall.dot(along) > most);
    if slides(tip, along) || other.is_some_and(|tip| slides(tip, -along)) {
        return None;
    }
    let margin = if length > 4.0 { 1.5 / length } else { 0.3 };
    let steps = (length / STEP_CELLS) as usize + 2;
    let share = |step: usize| margin + (1.0 - 2.0 * margin) * step as f64 / (steps - 1) as f64;
    if !(0..steps).all(|step| is_free(floor, segment.at(share(step)))) {
        return None;
    }
    let line = Line { segment, is_between_tips: other.is_some() };
    kind(floor, &line).map(|_| line)
}

/// What a line is on a floor, if it is anything.
pub(super) fn kind(floor: &Occupancy, line: &Line) -> Option<Kind> {
    let segment = line.segment;
    let along = segment.direction();
    let left = along.perpendicular();
    let past = |end: Point, out: Point| [left, -left].map(|side| past(floor, end, out, side));
    let (here, there) = (past(segment.a, -along), past(segment.b, along));
    let wide = segment.length() * floor.resolution;
    let is_wider = [0, 1].map(|side| wide + here[side] + there[side] >= WIDER * wide);
    let protrudes = |past: [f64; 2]| past[0].min(past[1]) >= PROTRUDES_M;
    if is_wider == [true; 2] && (protrudes(here) || line.is_between_tips && protrudes(there)) {
        return Some(if wide <= WIDEST_M { Kind::Opening } else { Kind::Wide });
    }
    let furthest = here.into_iter().chain(there).fold(0.0, f64::max);
    (is_wider != [false; 2] && furthest >= PROTRUDES_M).then_some(Kind::Mouth)
}

/// How far the floor goes on past an end of a line, on one side of it, metres.
fn past(floor: &Occupancy, end: Point, out: Point, side: Point) -> f64 {
    let most = (ASIDE_M / floor.resolution / STEP_CELLS) as usize;
    let mut furthest = 0;
    let mut aside = 1.5;
    while aside <= DEPTH_M / floor.resolution {
        let from = end + side * aside;
        // a jamb's stop is narrower than two cells
        if !is_free(floor, from - out * 2.0) {
            break;
        }
        let free = (0..most).take_while(|step| is_free(floor, from + out * (*step as f64 * STEP_CELLS)));
        furthest = furthest.max(free.count());
        aside += 1.0;
    }
    furthest as f64 * STEP_CELLS * floor.resolution
}

pub(super) fn is_free(floor: &Occupancy, p: Point) -> bool {
    let is_inside = p.x >= 0.0 && p.y >= 0.0 && p.x < floor.columns as f64 && p.y < floor.rows as f64;
    is_inside && !floor.is_blocked(p.x as usize, p.y as usize)
}
