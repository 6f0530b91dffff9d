//! Which cuts make the largest region of a face, then the next, with no more regions than merged triangles give.

use std::cmp::Ordering;

use rayon::prelude::*;
use rstar::primitives::Line;
use rstar::{RTree, RTreeObject};

use super::face::Face;
use super::layout::{Cut, Layout};
use super::merged::merged;
use crate::geometry::tolerance::ROUNDING;
use crate::geometry::{Point, Segment};
use crate::random::Xorshift;

/// Layouts are tried in rounds; so many at least, and so many more for each corner.
const TRIALS: usize = 24;
const TRIALS_PER_CORNER: usize = 8;
const MOST_TRIALS: usize = 300;

/// A trial looks from each corner at all walls; all trials of a face together look so often at most.
const MOST_LOOKS: usize = 100_000_000;

/// Of more pairs of corners it is not counted which hinder which: a scan has tens of thousands.
const MOST_PAIRS: usize = 4_000;

/// The cuts that were found best.
pub(super) fn best_layout(face: &Face) -> Layout<'_> {
    let laid = |order: Vec<Cut>| {
        let layout = Layout::new(face, &order);
        let areas = layout.areas();
        Laid { order, layout, areas }
    };
    let (mut best, by_merging) = rayon::join(
        || laid(first_order(face)),
        || merged(face).map(|merged| (laid(order_of(face, &merged.diagonals)), merged.regions)),
    );
    let mut most = best.areas.len();
    if let Some((other, regions)) = by_merging {
        most = regions;
        if compare(&other.areas, &best.areas, most) == Ordering::Greater {
            best = other;
        }
    }
    let mut random = Xorshift::new();
    let trials = TRIALS + TRIALS_PER_CORNER * face.corners.len();
    let looks = face.corners.len() * (face.points.len() + face.sides.len());
    for _ in 0..trials.min(MOST_TRIALS).min(MOST_LOOKS / looks.max(1)) {
        let mut order = best.order.clone();
        for _ in 0..=random.below(2) {
            change(face, &mut order, &mut random);
        }
        let other = laid(order);
        if compare(&other.areas, &best.areas, most) != Ordering::Less {
            best = other;
        }
    }
    best.layout
}

/// Cuts in an order, and the areas of the regions that they make, the largest first.
struct Laid<'f> {
    order: Vec<Cut>,
    layout: Layout<'f>,
    areas: Vec<f64>,
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
    let cut = |place: usize| face.between(pairs[place]);
    let mut left: Vec<(f64, usize)> = (0..pairs.len()).map(|place| (cut(place).length(), place)).collect();
    left.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
    let (mut order, mut is_taken) = (Vec::new(), vec![false; face.corners.len()]);
    let mut chosen: RTree<Line<[f64; 2]>> = RTree::new();
    for (_, place) in left {
        let way = cut(place);
        let line = Line::new([way.a.x, way.a.y], [way.b.x, way.b.y]);
        let crosses = |other: &Line<[f64; 2]>| {
            way.crosses(&Segment::from([other.from, other.to].map(|[x, y]| Point::new(x, y))))
        };
        let is_free = pairs[place].iter().all(|&corner| !is_taken[corner as usize]);
        if is_free && !chosen.locate_in_envelope_intersecting(line.envelope()).any(crosses) {
            chosen.insert(line);
            pairs[place].iter().for_each(|&corner| is_taken[corner as usize] = true);
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
