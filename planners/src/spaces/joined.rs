//! The pieces between openings and mouths, joined over mouths: a mouth parts two pieces only where they are unlike, as a
//! corridor and a hall are, or where it is narrow beside both.

use std::collections::btree_map::Entry;
use std::collections::{BTreeMap, BTreeSet};
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
const ALONE_M: f64 = 2.5;

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
    clear_away(&mut swept, ALONE_M);
    close(&mut swept, found.closed());
    let (mut of_cell, pieces) = pieces([&closed, &swept], &cut);
    flood(&closed, &mut of_cell);
    let mut joining = Joining::of(pieces, &passes(&closed, &of_cell, found));
    while let Some(two) = joining.next() {
        joining.join(two);
    }
    for piece in &mut of_cell {
        *piece = joining.now(*piece);
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

/// Two pieces, the lower number first.
type Two = [u32; 2];

fn two(one: u32, other: u32) -> Two {
    [one.min(other), one.max(other)]
}

/// The pieces as they are joined.
struct Joining {
    pieces: Vec<Piece>,
    /// Into which one a piece went; itself while it stands.
    went: Vec<u32>,
    /// For each piece those that it has mouths into.
    beside: Vec<BTreeSet<u32>>,
    mouths: BTreeMap<Two, Mouths>,
    /// How unlike two pieces are that are to be joined.
    unlike: BTreeMap<Two, u64>,
    /// The same, the most alike first; numbers that are not negative are in the order of their bits.
    order: BTreeSet<(u64, Two)>,
    openings: Vec<Pass>,
    /// How many times as wide openings are as what lies behind them is broad, as far as it is known.
    over: Vec<Option<f64>>,
}

impl Joining {
    fn of(pieces: Vec<Piece>, passes: &[Pass]) -> Self {
        let openings: Vec<Pass> = passes.iter().filter(|pass| pass.kind == Kind::Opening).copied().collect();
        let mut all = Self {
            went: (0..pieces.len() as u32).collect(),
            beside: vec![BTreeSet::new(); pieces.len()],
            pieces,
            mouths: BTreeMap::new(),
            unlike: BTreeMap::new(),
            order: BTreeSet::new(),
            over: vec![None; openings.len()],
            openings,
        };
        for pass in passes.iter().filter(|pass| pass.kind != Kind::Opening) {
            all.add(pass.between, Mouths { lines: vec![pass.line], kind: pass.kind });
        }
        for pair in all.mouths.keys().copied().collect::<Vec<_>>() {
            all.compare(pair);
        }
        all
    }

    fn add(&mut self, [one, other]: Two, more: Mouths) {
        self.beside[one as usize].insert(other);
        self.beside[other as usize].insert(one);
        match self.mouths.entry(two(one, other)) {
            Entry::Vacant(entry) => {
                entry.insert(more);
            }
            Entry::Occupied(mut entry) => {
                let mouths = entry.get_mut();
                mouths.lines.extend(more.lines);
                mouths.kind = mouths.kind.max(more.kind);
            }
        }
    }

    /// Finds out how unlike two pieces are, if they are joined.
    fn compare(&mut self, pair: Two) {
        self.forget(pair);
        let found = self.mouths.get(&pair).and_then(|mouths| {
            let two = pair.map(|piece| &self.pieces[piece as usize]);
            unlike(two, mouths)
        });
        if let Some(unlike) = found {
            self.unlike.insert(pair, unlike.to_bits());
            self.order.insert((unlike.to_bits(), pair));
        }
    }

    fn forget(&mut self, pair: Two) {
        if let Some(unlike) = self.unlike.remove(&pair) {
            self.order.remove(&(unlike, pair));
        }
    }

    /// The piece that one has become.
    fn now(&self, mut piece: u32) -> u32 {
        while self.went[piece as usize] != piece {
            piece = self.went[piece as usize];
        }
        piece
    }

    /// The two pieces to join next, the first of which stays; over an opening only when no mouth is left.
    fn next(&mut self) -> Option<Two> {
        if let Some((_, pair)) = self.order.first() {
            return Some(*pair);
        }
        let mut best: Option<(f64, Two)> = None;
        for place in 0..self.openings.len() {
            let Pass { between, line, .. } = self.openings[place];
            if between[0] == between[1] {
                continue;
            }
            let over = self.over[place].unwrap_or_else(|| {
                let breadths = between.map(|piece| self.pieces[piece as usize].breadth_behind(&line));
                line.length() / breadths[0].min(breadths[1])
            });
            self.over[place] = Some(over);
            if over > WIDER_THAN_BROAD && best.is_none_or(|best| over > best.0) {
                best = Some((over, between));
            }
        }
        best.map(|(_, between)| between)
    }

    fn join(&mut self, [into, from]: Two) {
        for (opening, over) in self.openings.iter_mut().zip(&mut self.over) {
            let between = opening.between.map(|piece| if piece == from { into } else { piece });
            if between.contains(&into) {
                (opening.between, *over) = (between, None);
            }
        }
        let gone = take(&mut self.pieces[from as usize]);
        let whole = &mut self.pieces[into as usize];
        whole.cells += gone.cells;
        whole.samples.extend(gone.samples);
        self.went[from as usize] = into;
        for other in take(&mut self.beside[from as usize]) {
            self.beside[other as usize].remove(&from);
            self.forget(two(from, other));
            if let Some(mouths) = self.mouths.remove(&two(from, other))
                && other != into
            {
                self.add([into, other], mouths);
            }
        }
        for other in self.beside[into as usize].clone() {
            self.compare(two(into, other));
        }
    }
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
