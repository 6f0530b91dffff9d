//! Chords: straight ways through free space from one concave corner to the next.

use std::collections::BTreeMap;

use super::corners::Corner;
use super::matching::{Graph, largest_independent_set};

/// A chord on the line `at`, between two concave corners. Across: `at` is y, and it goes from x `from` to x `to`.
/// Upright: `at` is x, and it goes from y `from` to y `to`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Chord {
    pub(super) at: u32,
    pub(super) from: u32,
    pub(super) to: u32,
}

/// Chords of which no two meet.
pub(super) struct Choice {
    pub(super) across: Vec<Chord>,
    pub(super) upright: Vec<Chord>,
}

/// The chords along the lines of the corners, which come line by line from left to right.
pub(super) fn chords(corners: &[Corner]) -> Vec<Chord> {
    let facing = |pair: &[Corner]| pair[0].y == pair[1].y && pair[0].reach == pair[1].x;
    let pairs = corners.windows(2).filter(|pair| facing(pair));
    pairs.map(|pair| Chord { at: pair[0].y, from: pair[0].x, to: pair[1].x }).collect()
}

/// As many of the chords as possible such that no two cross or share a corner.
pub(super) fn largest_choice(across: &[Chord], upright: &[Chord]) -> Choice {
    let graph = Graph { left: meetings(across, upright), right_count: upright.len() };
    let (keep_across, keep_upright) = largest_independent_set(&graph);
    let kept = |chords: &[Chord], keep: &[bool]| {
        chords.iter().zip(keep).filter(|&(_, &keep)| keep).map(|(&chord, _)| chord).collect()
    };
    Choice { across: kept(across, &keep_across), upright: kept(upright, &keep_upright) }
}

/// For each chord across, the upright ones that cross it or share a corner with it.
fn meetings(across: &[Chord], upright: &[Chord]) -> Vec<Vec<u32>> {
    let by = |chords: &[Chord], key: fn(&Chord) -> u32| {
        let mut order: Vec<_> = (0..chords.len()).collect();
        order.sort_by_key(|&i| (key(&chords[i]), i));
        order
    };
    let mut starts = by(upright, |chord| chord.from).into_iter().peekable();
    let mut ends = by(upright, |chord| chord.to).into_iter().peekable();
    // Upright chords at the present height by their x: no two on one line share even an end.
    let mut present = BTreeMap::new();
    let mut meetings = vec![Vec::new(); across.len()];
    for i in by(across, |chord| chord.at) {
        let chord = across[i];
        while let Some(j) = ends.next_if(|&j| upright[j].to < chord.at) {
            if present.get(&upright[j].at) == Some(&(j as u32)) {
                present.remove(&upright[j].at);
            }
        }
        while let Some(j) = starts.next_if(|&j| upright[j].from <= chord.at) {
            if upright[j].to >= chord.at {
                present.insert(upright[j].at, j as u32);
            }
        }
        meetings[i].extend(present.range(chord.from..=chord.to).map(|(_, &j)| j));
    }
    meetings
}
