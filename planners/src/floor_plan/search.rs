//! Which cuts make the largest region of a face, then the next, with no more regions than merged triangles give.

use std::cmp::Ordering;

use super::face::Face;
use super::layout::{Cut, Layout};
use super::merged::merged;
use crate::geometry::tolerance::ROUNDING;
use crate::random::Xorshift;

/// Layouts are tried in rounds; so many at least, and so many more for each corner.
const TRIALS: usize = 24;
const TRIALS_PER_CORNER: usize = 8;
const MOST_TRIALS: usize = 300;

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
    for _ in 0..trials.min(MOST_TRIALS) {
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
    let mut left: Vec<usize> = (0..pairs.len()).collect();
    let (mut order, mut is_taken) = (Vec::new(), vec![false; face.corners.len()]);
    while !left.is_empty() {
        let rivals = |&i: &usize| left.iter().filter(|&&j| face.do_hinder(pairs[i].0, pairs[j].0)).count();
        let Some(chosen) = left.iter().copied().min_by_key(rivals) else { break };
        let ([corner, other], sight) = pairs[chosen];
        order.push(Cut::Towards { corner, sight });
        (is_taken[corner as usize], is_taken[other as usize]) = (true, true);
        left.retain(|&i| !face.do_hinder(pairs[chosen].0, pairs[i].0));
    }
    let rest = (0..face.corners.len() as u32).filter(|&corner| !is_taken[corner as usize]);
    order.extend(rest.map(|corner| Cut::First { corner }));
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
