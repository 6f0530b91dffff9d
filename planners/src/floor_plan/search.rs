//! Which cuts make the largest region of a face, then the next, with no more regions than merged triangles give.

use std::cmp::Ordering;

use rayon::prelude::*;

use super::face::Face;
use super::layout::{Cut, Layout};
use super::merged::merged;
use crate::geometry::tolerance::ROUNDING;
use crate::random::Xorshift;

/// Layouts are tried in rounds; so many at least, and so many more for each corner.
const TRIALS: usize = 24;
const TRIALS_PER_CORNER: usize = 8;
const MOST_TRIALS: usize = 300;

/// A trial looks from each corner at all walls; all trials of a face together look so often at most.
const MOST_LOOKS: usize = 100_000_000;

/// Of more pairs of corners it is not counted which hinder which: a scan has tens of thousands.
const MOST_PAIRS: usize = 4_000;

/// The order of cuts that was found best.
pub(super) fn best_order(face: &Face) -> Vec<Cut> {
    let mut best = first_order(face);
    let mut areas = Layout::new(face, &best).areas();
    let most = match merged(face) {
        Some(merged) => {
            let order = order_of(face, &merged.diagonals);
            let found = Layout::new(face, &order).areas();
            if compare(&found, &areas, merged.regions) == Ordering::Greater {
                (best, areas) = (order, found);
            }
            merged.regions
        }
        None => areas.len(),
    };
    let mut random = Xorshift::new();
    let trials = TRIALS + TRIALS_PER_CORNER * face.corners.len();
    let looks = face.corners.len() * (face.points.len() + face.sides.len());
    for _ in 0..trials.min(MOST_TRIALS).min(MOST_LOOKS / looks.max(1)) {
        let mut other = best.clone();
        for _ in 0..=random.below(2) {
            change(face, &mut other, &mut random);
        }
        let found = Layout::new(face, &other).areas();
        if compare(&found, &areas, most) != Ordering::Less {
            (best, areas) = (other, found);
        }
    }
    best
}

/// Greater is better: no more regions than `most`, then the larger one at the first place where they differ.
fn compare(a: &[f64], b: &[f64], most: usize) -> Ordering {
    let by_area = || {
        let differ = a.iter().zip(b).find(|(x, y)| (*x - *y).abs() > ROUNDING * x.max(**y));
        differ.map_or(Ordering::Equal, |(x, y)| x.total_cmp(y))
    };
    b.len().max(most).cmp(&a.len().max(most)).then_with(by_area)
}

/// Cuts that resolve two corners at once, those first that hinder the fewest others; then the rest along walls.
fn first_order(face: &Face) -> Vec<Cut> {
    let mut pairs = Vec::new();
    for (number, corner) in (0_u32..).zip(&face.corners) {
        for (place, sight) in (0_u32..).zip(&corner.sights) {
            if let Some(other) = sight.resolves.filter(|&other| number < other) {
                pairs.push(([number, other], place));
            }
        }
    }
    let ends: Vec<[u32; 2]> = pairs.iter().map(|(ends, _)| *ends).collect();
    let chosen = if pairs.len() <= MOST_PAIRS { least_hindering(face, &ends) } else { shortest(face, &ends) };
    let (mut order, mut is_taken) = (Vec::new(), vec![false; face.corners.len()]);
    for chosen in chosen {
        let ([corner, other], sight) = pairs[chosen];
        order.push(Cut::Towards { corner, sight });
        (is_taken[corner as usize], is_taken[other as usize]) = (true, true);
    }
    let rest = (0..face.corners.len() as u32).filter(|&corner| !is_taken[corner as usize]);
    order.extend(rest.map(|corner| Cut::First { corner }));
    order
}

/// Pairs that do not hinder one another, each time one that hinders the fewest that are left.
fn least_hindering(face: &Face, pairs: &[[u32; 2]]) -> Vec<usize> {
    let do_hinder = |i: usize, j: usize| face.do_hinder(pairs[i], pairs[j]);
    let all = 0..pairs.len();
    // by how many that are left each one is hindered, itself counted
    let rivals = |i: usize| all.clone().filter(|&j| do_hinder(i, j)).count();
    let mut rivals: Vec<usize> = all.clone().into_par_iter().map(rivals).collect();
    let (mut left, mut order): (Vec<usize>, Vec<usize>) = (all.collect(), Vec::new());
    while let Some(chosen) = left.iter().copied().min_by_key(|&i| rivals[i]) {
        order.push(chosen);
        let (gone, stays): (Vec<usize>, Vec<usize>) = left.into_iter().partition(|&i| do_hinder(chosen, i));
        left = stays;
        for &i in &left {
            rivals[i] -= gone.iter().filter(|&&j| do_hinder(i, j)).count();
        }
    }
    order
}

/// Pairs that do not hinder one another, the shortest first: they mostly hinder few.
fn shortest(face: &Face, pairs: &[[u32; 2]]) -> Vec<usize> {
    let mut left: Vec<(f64, usize)> =
        pairs.iter().enumerate().map(|(place, &ends)| (face.squared_length(ends), place)).collect();
    left.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
    let mut order: Vec<usize> = Vec::new();
    for (_, place) in left {
        if order.iter().all(|&chosen| !face.do_hinder(pairs[chosen], pairs[place])) {
            order.push(place);
        }
    }
    order
}

/// Cuts along diagonals, from both ends: the second one is left out where the first resolved both.
fn order_of(face: &Face, diagonals: &[[u32; 2]]) -> Vec<Cut> {
    let towards = |[from, to]: [u32; 2]| {
        let corner = face.corners.iter().position(|corner| corner.node == from)?;
        let sight = face.corners[corner].sights.iter().position(|sight| sight.node == Some(to))?;
        Some(Cut::Towards { corner: corner as u32, sight: sight as u32 })
    };
    let mut order: Vec<Cut> =
        diagonals.iter().flat_map(|&[a, b]| [towards([a, b]), towards([b, a])]).flatten().collect();
    if order.is_empty() {
        order.push(Cut::First { corner: 0 });
    }
    order
}

/// Cuts one corner otherwise, earlier or later, once more or once less.
fn change(face: &Face, order: &mut Vec<Cut>, random: &mut Xorshift) {
    let place = random.below(order.len());
    let kind = random.below(5);
    if kind == 0 && order.len() > 1 {
        order.remove(place);
        return;
    }
    let corner = if kind < 3 { random.below(face.corners.len()) as u32 } else { order[place].corner() };
    let sight = random.below(face.corners[corner as usize].sights.len()) as u32;
    let sees = !face.corners[corner as usize].sights.is_empty();
    let cut = match random.below(if sees { 6 } else { 2 }) {
        0 => Cut::First { corner },
        1 => Cut::Last { corner },
        2 | 3 => Cut::Towards { corner, sight },
        _ => Cut::Through { corner, sight },
    };
    match kind {
        1 => order.insert(0, cut),
        2 => order.insert(place, cut),
        3 => order[place] = cut,
        _ => {
            order.remove(place);
            order.insert(0, cut);
        }
    }
}
