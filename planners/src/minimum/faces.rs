//! The rectangles into which cuts part the free space.

use std::collections::{BTreeMap, BTreeSet};

use crate::prime_areas::maximal::merge;
use crate::skyline::Skyline;
use crate::strips::Block;

use super::chords::Choice;
use super::corners::Corner;

/// The faces after cutting along the chosen chords and then across, from each corner that no chord has reached
/// to the next obstacle or cut.
pub(super) fn faces(
    columns: u32,
    rows: u32,
    blocks: &[Block],
    corners: &[Corner],
    chosen: &Choice,
) -> Vec<Block> {
    let mut sweep = Sweep {
        skyline: Skyline::of(columns, blocks),
        chords: BTreeSet::new(),
        open: BTreeMap::new(),
        merged: Vec::new(),
        faces: Vec::new(),
    };
    for (y, level) in levels(columns, rows, blocks, corners, chosen).into_iter().enumerate().rev() {
        sweep.pass(y as u32, level);
    }
    sweep.faces
}

/// What lies on one horizontal line.
#[derive(Clone, Default)]
struct Level {
    /// Tops of obstacles.
    floors: Vec<(u32, u32)>,
    /// Bottoms of obstacles.
    ceilings: Vec<(u32, u32)>,
    /// Chords across.
    cuts: Vec<(u32, u32)>,
    /// Corners that no chord has reached.
    loose: Vec<Corner>,
    /// Upright chords that hang down from here, by x.
    hanging: Vec<u32>,
    /// Upright chords that stand here, by x.
    standing: Vec<u32>,
}

fn levels(columns: u32, rows: u32, blocks: &[Block], corners: &[Corner], chosen: &Choice) -> Vec<Level> {
    let mut levels = vec![Level::default(); rows as usize + 1];
    levels[0].floors.push((0, columns));
    levels[rows as usize].ceilings.push((0, columns));
    for block in blocks {
        levels[block.y1 as usize].floors.push((block.x0, block.x1));
        levels[block.y0 as usize].ceilings.push((block.x0, block.x1));
    }
    let mut reached = BTreeSet::new();
    for chord in &chosen.across {
        levels[chord.at as usize].cuts.push((chord.from, chord.to));
        reached.extend([(chord.from, chord.at), (chord.to, chord.at)]);
    }
    for chord in &chosen.upright {
        levels[chord.to as usize].hanging.push(chord.at);
        levels[chord.from as usize].standing.push(chord.at);
        reached.extend([(chord.at, chord.from), (chord.at, chord.to)]);
    }
    for corner in corners.iter().filter(|corner| !reached.contains(&(corner.x, corner.y))) {
        levels[corner.y as usize].loose.push(*corner);
    }
    levels
}

/// A line that moves down and carries the faces that have begun above it.
struct Sweep {
    skyline: Skyline,
    /// Upright chords at the line, by x.
    chords: BTreeSet<u32>,
    /// Faces that have begun: left edge, with right edge and top.
    open: BTreeMap<u32, (u32, u32)>,
    merged: Vec<(u32, u32)>,
    faces: Vec<Block>,
}

impl Sweep {
    fn pass(&mut self, y: u32, mut level: Level) {
        for chord in &level.standing {
            self.chords.remove(chord);
        }
        level.cuts.extend(level.loose.iter().map(|corner| self.cut_from(corner)));
        self.chords.extend(&level.hanging);
        self.merge(level.floors, &level.cuts);
        self.close(y);
        self.merge(level.ceilings, &level.cuts);
        self.skyline.look_below(y);
        self.begin(y);
    }

    fn merge(&mut self, mut lines: Vec<(u32, u32)>, cuts: &[(u32, u32)]) {
        lines.extend(cuts);
        lines.sort_unstable();
        merge(lines, &mut self.merged);
    }

    /// The cut from a corner across to what it meets first: an upright chord, or where free space ends.
    fn cut_from(&self, corner: &Corner) -> (u32, u32) {
        let Corner { x, reach, .. } = *corner;
        if reach > x {
            (x, self.chords.range(x + 1..reach).next().copied().unwrap_or(reach))
        } else {
            (self.chords.range(reach + 1..x).next_back().copied().unwrap_or(reach), x)
        }
    }

    /// Ends the faces that stand on the merged floors.
    fn close(&mut self, y: u32) {
        for &(from, to) in &self.merged {
            while let Some((&x0, &(x1, top))) = self.open.range(from..to).next() {
                self.open.remove(&x0);
                self.faces.push(Block { x0, y0: y, x1, y1: top });
            }
        }
    }

    /// Begins the faces that hang from the merged ceilings, between obstacles and upright chords below them.
    fn begin(&mut self, y: u32) {
        let limit = self.skyline.below(y);
        for &(from, to) in &self.merged {
            for (left, right) in self.skyline.gaps(from, to, limit) {
                let (mut left, right) = (left.max(from), right.min(to));
                for &chord in self.chords.range(left + 1..right) {
                    self.open.insert(left, (chord, y));
                    left = chord;
                }
                self.open.insert(left, (right, y));
            }
        }
    }
}
