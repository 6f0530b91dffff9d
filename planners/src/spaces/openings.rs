//! Which of the lines from tips of walls are openings, and which are mouths that may part spaces that are unlike.
//!
//! An opening is where the floor beside it, on either side, goes on past the tip of a wall (Mora et al. 2022 look for
//! narrow passages beside protruding walls). The shortest are chosen first, and once one is closed the floor no longer
//! goes on through it: a corridor is not wider where a door leads out of it.

use super::lines::{Kind, Line, is_free, kind, lines};
use crate::geometry::{Point, Segment};
use crate::world::Occupancy;

/// Lines whose middles are nearer to another one are of that passage, metres.
const BESIDE_M: f64 = 0.5;

/// Tips nearer than this are of one wall's end, metres.
const ONE_END_M: f64 = 0.3;

/// A line from a wall's end gives way to one of less than this share of its length.
const SHORTER: f64 = 0.8;

/// A mouth gives way to a shorter one from the same tip at less than this angle, degrees.
const TURNED_DEGREES: f64 = 80.0;

/// A line in the middle of a passage goes on to walls that are no further, cells.
const NICHE_CELLS: f64 = 8.0;

/// Steps towards a wall, cells.
const STEP_CELLS: f64 = 0.5;

/// Lines that part the floor, in cells.
#[derive(Default)]
pub(super) struct Openings {
    /// Between tips of walls.
    pub between_tips: Vec<Segment>,
    /// Drawn doors: what is drawn parts whatever lies there.
    pub drawn: Vec<Segment>,
    /// Each with whether walls protrude there: it is an opening, and wide.
    pub mouths: Vec<(Segment, bool)>,
}

/// The lines across one passage, the shortest first: at both faces of a wall.
struct Passage(Vec<Segment>);

impl Openings {
    pub fn of(floor: &Occupancy) -> Self {
        let mut closed = floor.clone();
        let mut passages: Vec<Passage> = Vec::new();
        let mut others = Vec::new();
        for line in lines(floor) {
            if let Some(passage) = passages.iter_mut().find(|passage| passage.has(&line, floor.resolution)) {
                passage.widen(line.segment, &mut closed);
            } else if kind(&closed, &line) != Some(Kind::Opening) {
                others.push(line);
            } else if !passages.iter().any(|passage| passage.stands_for(&line, floor.resolution)) {
                close(&mut closed, [&line.segment]);
                passages.push(Passage(vec![line.segment]));
            }
        }
        let mut mouths: Vec<(Segment, bool)> = Vec::new();
        for line in others {
            let middle = line.segment.middle();
            let is_there = |known: &Segment| {
                known.distance(middle) * floor.resolution < BESIDE_M || known.crosses(&line.segment)
            };
            let is_mouth = |known: &Segment| is_there(known) || turns(known, &line, floor.resolution);
            if passages.iter().flat_map(|passage| &passage.0).any(is_there)
                || mouths.iter().any(|(known, _)| is_mouth(known))
            {
                continue;
            }
            if let Some(kind) = kind(&closed, &line) {
                mouths.push((line.segment, kind != Kind::Mouth));
            }
        }
        let between_tips = passages.iter().map(|passage| passage.middle(floor)).collect();
        Self { between_tips, drawn: Vec::new(), mouths }
    }

    /// With those that are drawn in the place of those found beside them.
    pub fn with_drawn(mut self, drawn: Vec<Segment>, floor: &Occupancy) -> Self {
        let is_beside = |one: &Segment| {
            let off = |drawn: &Segment| one.distance(drawn.middle()).min(drawn.distance(one.middle()));
            drawn.iter().any(|drawn| off(drawn) * floor.resolution < BESIDE_M)
        };
        self.between_tips.retain(|one| !is_beside(one));
        self.mouths.retain(|(one, _)| !is_beside(one));
        Self { drawn, ..self }
    }

    /// What is closed whatever lies beside it, or nearly.
    pub fn closed(&self) -> impl Iterator<Item = &Segment> {
        self.between_tips.iter().chain(&self.drawn)
    }

    pub fn all(&self) -> Vec<Segment> {
        self.closed().chain(self.mouths.iter().map(|(mouth, _)| mouth)).copied().collect()
    }
}

impl Passage {
    fn has(&self, line: &Line, resolution: f64) -> bool {
        self.0[0].distance(line.segment.middle()) * resolution < BESIDE_M
    }

    /// By one more line, if it is as long.
    fn widen(&mut self, line: Segment, closed: &mut Occupancy) {
        let first = self.0[0];
        if line.length() * SHORTER <= first.length() && !line.crosses(&first) {
            let line = alike(&first, line);
            let steps = first.a.distance(line.a).max(first.b.distance(line.b)) as usize + 1;
            for step in 0..=steps {
                let share = step as f64 / steps as f64;
                close(closed, [&Segment::new(first.a.lerp(line.a, share), first.b.lerp(line.b, share))]);
            }
            self.0.push(line);
        }
    }

    /// Whether it is meant, rather than a longer line from the same end of a wall.
    fn stands_for(&self, line: &Line, resolution: f64) -> bool {
        let known = &self.0[0];
        let is_end = |tip: Point| tip.distance(known.a).min(tip.distance(known.b)) * resolution < ONE_END_M;
        let ends = is_end(line.segment.a) || line.is_between_tips && is_end(line.segment.b);
        ends && known.length() < SHORTER * line.segment.length() || known.crosses(&line.segment)
    }

    /// The line in the middle between its faces.
    fn middle(&self, floor: &Occupancy) -> Segment {
        let (first, along) = (self.0[0], self.0[0].direction());
        let off = |line: &Segment| (line.middle() - first.middle()).dot(along.perpendicular());
        // 11 degrees
        let faces = || self.0.iter().filter(|line| line.direction().dot(along) > 0.98);
        let by_side = |a: &&Segment, b: &&Segment| off(a).total_cmp(&off(b));
        let (one, other) = (faces().min_by(by_side), faces().max_by(by_side));
        let (one, other) = (one.unwrap_or(&first), other.unwrap_or(&first));
        to_walls(floor, Segment::new(one.a.midpoint(other.a), one.b.midpoint(other.b)))
    }
}

/// The segment, in the direction of another one.
fn alike(one: &Segment, other: Segment) -> Segment {
    if one.direction().dot(other.direction()) < 0.0 { other.reversed() } else { other }
}

/// Whether a line leads from the same tip as a shorter one, and in nearly its direction.
fn turns(known: &Segment, line: &Line, resolution: f64) -> bool {
    let least = TURNED_DEGREES.to_radians().cos();
    let from = |line: &Segment| {
        [*known, known.reversed()].into_iter().any(|known| {
            known.a.distance(line.a) * resolution < ONE_END_M
                && known.direction().dot(line.direction()) > least
        })
    };
    from(&line.segment) || line.is_between_tips && from(&line.segment.reversed())
}

/// As far as the walls at its ends.
fn to_walls(floor: &Occupancy, line: Segment) -> Segment {
    let along = line.direction();
    let reach = |end: Point, out: Point| {
        let steps = (NICHE_CELLS / STEP_CELLS) as usize;
        let mut by = (0..steps).map(|step| step as f64 * STEP_CELLS);
        let wall = by.find(|by| !is_free(floor, end + out * (by + 0.2)));
        wall.map_or(end, |by| end + out * by)
    };
    Segment::new(reach(line.a, -along), reach(line.b, along))
}

/// Closes the floor along lines, so that cells on both sides touch nowhere, not even in a corner.
pub(super) fn close<'a>(floor: &mut Occupancy, lines: impl IntoIterator<Item = &'a Segment>) {
    for line in lines {
        let along = line.direction();
        let line = Segment::new(line.a - along * 1.2, line.b + along * 1.2);
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
