//! The pieces between openings and mouths, joined over mouths: a mouth parts two pieces only where they are unlike, as a
//! corridor and a hall are, or where it is narrow beside both.

use std::collections::BTreeMap;
use std::collections::btree_map::Entry;
use std::mem::take;

use super::clutter::clear_away;
use super::openings::{Openings, close};
use super::rest::{NONE, flood};
use super::runs::touching;
use crate::geometry::{Point, Segment};
use crate::layers::squared_gaps_by_rows;
use crate::world::Occupancy;

/// Pieces of which the broader is at most so many times as broad are alike.
const ALIKE: f64 = 2.2;

/// What has two mouths into another piece is an aisle of it up to this, times as broad: it leads around something.
const AISLE: f64 = 3.0;

/// A piece less than so many times as deep as it is broad is a niche, as between two beds.
const NICHE: f64 = 4.0;

/// A mouth of less than this share of the breadth of the narrower piece parts even what is alike.
const NARROW: f64 = 0.6;

/// The same where walls protrude.
const NARROW_BESIDE_WALLS: f64 = 0.8;

/// An opening so many times as wide as what lies behind it is broad is none.
const WIDER_THAN_BROAD: f64 = 1.3;

/// Breadth is looked for as near as so many widths of the mouth.
const REACH: f64 = 4.0;

/// What stands alone and is no larger, metres, makes nothing narrow: a hall with a pillar is as broad as one without.
const STANDS_ALONE_M: f64 = 2.5;

/// Where breadth is looked for, metres from each other.
const SAMPLE_M: f64 = 0.15;

/// A piece of the floor.
#[derive(Clone, Default)]
struct Piece {
    cells: f64,
    samples: Vec<Sample>,
}

/// A cell of a piece, with distances from walls and openings, in cells.
#[derive(Clone, Copy)]
struct Sample {
    at: Point,
    clear: f64,
    /// Were there nothing that stands alone.
    swept: f64,
}

/// A line between two pieces.
#[derive(Clone, Copy)]
struct Pass {
    between: [u32; 2],
    line: Segment,
    kind: Kind,
}

#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
enum Kind {
    Mouth,
    WideOpening,
    Opening,
}

/// The mouths between two pieces.
struct Mouths {
    lines: Vec<Segment>,
    kind: Kind,
}

/// For each cell the number of its space; [`NONE`] on openings.
pub(super) fn joined(floor: &Occupancy, found: &Openings) -> Vec<u32> {
    let mut closed = floor.clone();
    close(&mut closed, found.closed());
    let mut cut = closed.clone();
    close(&mut cut, found.mouths.iter().map(|(mouth, _)| mouth));
    let mut swept = floor.clone();
    clear_away(&mut swept, STANDS_ALONE_M);
    close(&mut swept, found.closed());
    let (mut of_cell, mut pieces) = pieces([&closed, &swept], &cut);
    flood(&closed, &mut of_cell);
    let mut passes = passes(&closed, &of_cell, found);
    let mut number: Vec<u32> = (0..pieces.len() as u32).collect();
    let mut known = BTreeMap::new();
    while let Some([into, from]) = most_alike(&pieces, &passes, &mut known) {
        let gone = take(&mut pieces[from as usize]);
        let whole = &mut pieces[into as usize];
        whole.cells += gone.cells;
        whole.samples.extend(gone.samples);
        number.iter_mut().filter(|number| **number == from).for_each(|number| *number = into);
        for pass in &mut passes {
            pass.between = pass.between.map(|piece| if piece == from { into } else { piece });
        }
        passes.retain(|pass| pass.between[0] != pass.between[1]);
        known.retain(|[one, other], _| ![into, from].iter().any(|piece| piece == one || piece == other));
    }
    for piece in &mut of_cell {
        *piece = number[*piece as usize];
    }
    of_cell
}

/// For each cell the number of its piece, from 1, and the pieces, of which the first is none.
fn pieces([closed, swept]: [&Occupancy; 2], cut: &Occupancy) -> (Vec<u32>, Vec<Piece>) {
    let columns = closed.columns;
    let every = (SAMPLE_M / closed.resolution).round().max(1.0) as usize;
    let [clear, broad] = [closed, swept].map(|floor| {
        squared_gaps_by_rows((columns, floor.rows), |column, row| floor.is_blocked(column, row), every)
    });
    let (runs, of_run) = touching(cut, false, false);
    let mut of_cell = vec![NONE; cut.blocked.len()];
    let mut pieces = vec![Piece::default(); of_run.iter().max().map_or(1, |most| most + 2)];
    for (run, number) in runs.iter().zip(of_run) {
        let (row, piece) = (run.row * columns, &mut pieces[number + 1]);
        of_cell[row + run.first..row + run.end].fill(number as u32 + 1);
        piece.cells += (run.end - run.first) as f64;
        if run.row.is_multiple_of(every) {
            for column in (run.first.next_multiple_of(every)..run.end).step_by(every) {
                let at = Point::new(column as f64 + 0.5, run.row as f64 + 0.5);
                let [clear, swept] = [&clear, &broad].map(|gaps| f64::from(gaps[row + column]).sqrt() + 0.5);
                piece.samples.push(Sample { at, clear, swept });
            }
        }
    }
    (of_cell, pieces)
}

/// The lines that lie between two pieces.
fn passes(closed: &Occupancy, of_cell: &[u32], found: &Openings) -> Vec<Pass> {
    let beside = |line: &Segment, aside: f64| {
        let by = line.direction().perpendicular() * aside;
        let steps = line.length() as usize + 1;
        let mut counts: BTreeMap<u32, usize> = BTreeMap::new();
        for p in (0..=steps).map(|step| line.at(step as f64 / steps as f64) + by) {
            let is_inside =
                p.x >= 0.0 && p.y >= 0.0 && p.x < closed.columns as f64 && p.y < closed.rows as f64;
            let piece = if is_inside { of_cell[p.y as usize * closed.columns + p.x as usize] } else { NONE };
            if piece != NONE {
                *counts.entry(piece).or_insert(0) += 1;
            }
        }
        counts.into_iter().max_by_key(|(_, count)| *count).map_or(NONE, |(piece, _)| piece)
    };
    let pass = |line: &Segment, kind: Kind| {
        let between = [beside(line, 2.0), beside(line, -2.0)];
        let parts = between[0] != between[1] && !between.contains(&NONE);
        parts.then_some(Pass { between, line: *line, kind })
    };
    let mouths = found
        .mouths
        .iter()
        .filter_map(|(line, protrudes)| pass(line, if *protrudes { Kind::WideOpening } else { Kind::Mouth }));
    mouths.chain(found.between_tips.iter().filter_map(|line| pass(line, Kind::Opening))).collect()
}

/// The two pieces to join next; over an opening only when no mouth is left.
///
/// # Arguments
/// `known` is what was found out before of two pieces: how unlike they are, if they are joined.
fn most_alike(
    pieces: &[Piece],
    passes: &[Pass],
    known: &mut BTreeMap<[u32; 2], Option<f64>>,
) -> Option<[u32; 2]> {
    let mut all: BTreeMap<[u32; 2], Mouths> = BTreeMap::new();
    for pass in passes.iter().filter(|pass| pass.kind != Kind::Opening) {
        let [one, other] = pass.between;
        match all.entry([one.min(other), one.max(other)]) {
            Entry::Vacant(entry) => {
                entry.insert(Mouths { lines: vec![pass.line], kind: pass.kind });
            }
            Entry::Occupied(mut entry) => {
                let mouths = entry.get_mut();
                mouths.lines.push(pass.line);
                mouths.kind = mouths.kind.max(pass.kind);
            }
        }
    }
    let mut best: Option<(f64, [u32; 2])> = None;
    for (two, mouths) in &all {
        let unlike = *known.entry(*two).or_insert_with(|| {
            let [one, other] = two.map(|piece| &pieces[piece as usize]);
            unlike([one, other], mouths)
        });
        if let Some(unlike) = unlike.filter(|unlike| best.is_none_or(|best| *unlike < best.0)) {
            best = Some((unlike, *two));
        }
    }
    if best.is_none() {
        for pass in passes.iter().filter(|pass| pass.kind == Kind::Opening) {
            let breadths = pass.between.map(|piece| pieces[piece as usize].breadth_behind(&pass.line));
            let over = pass.line.length() / breadths[0].min(breadths[1]);
            if over > WIDER_THAN_BROAD && best.is_none_or(|best| over > best.0) {
                best = Some((over, pass.between));
            }
        }
    }
    best.map(|(_, two)| two)
}

/// How many times as broad one of two pieces is as the other, if they are joined.
fn unlike(two: [&Piece; 2], mouths: &Mouths) -> Option<f64> {
    let width = mouths.lines.iter().map(Segment::length).fold(0.0, f64::max);
    let breadths = two.map(|piece| piece.breadth_near(&mouths.lines, width, |sample| sample.clear));
    let swept = two.map(|piece| piece.breadth_near(&mouths.lines, width, |sample| sample.swept));
    let (narrow, broad) = if swept[0] < swept[1] { (0, 1) } else { (1, 0) };
    let unlike = swept[broad] / swept[narrow];
    let is_niche = two[narrow].cells < NICHE * breadths[narrow].powi(2);
    let is_aisle = mouths.lines.len() > 1 && unlike < AISLE;
    let least = if mouths.kind == Kind::WideOpening { NARROW_BESIDE_WALLS } else { NARROW };
    let is_joined = (unlike <= ALIKE || is_niche || is_aisle) && width >= least * breadths[narrow];
    is_joined.then_some(unlike)
}

impl Piece {
    /// The breadth that it comes to near some lines, as if they were walls, in cells; no less than they are wide.
    fn breadth_near(&self, lines: &[Segment], width: f64, clear: impl Fn(&Sample) -> f64) -> f64 {
        let most = self.samples.iter().fold(width / 2.0, |most, sample| {
            let clear = clear(sample);
            if clear <= most {
                return most;
            }
            let off = lines.iter().map(|line| line.distance(sample.at)).fold(f64::INFINITY, f64::min);
            if off <= REACH * width { most.max(clear.min(off)) } else { most }
        });
        2.0 * most
    }

    /// The breadth that it comes to anywhere.
    fn breadth_behind(&self, line: &Segment) -> f64 {
        let clears = self.samples.iter().map(|of| of.clear.min(line.distance(of.at) + 0.5));
        2.0 * clears.fold(0.5, f64::max)
    }
}
