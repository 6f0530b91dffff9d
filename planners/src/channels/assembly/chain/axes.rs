//! Along which axis each channel leads.

use super::error::AssemblyError;
use crate::channels::assembly::Cuboid;

/// One axis for each channel: z for the first, and for each other one along which it goes on from the junction
/// with its neighbour, which leads along another. Where several would do (in three dimensions), the one that
/// channels go on furthest along, of all choices for the chain together.
pub(super) fn axes<const D: usize>(
    channels: &[Cuboid<D>],
    junctions: &[Cuboid<D>],
    tolerance: f64,
) -> Result<Vec<usize>, AssemblyError<D>> {
    // For each axis that the channel may lead along: how far the best chain so far goes on, and from which axis.
    let mut reached = [None; D];
    reached[D - 1] = Some((0.0, D - 1));
    let mut steps = vec![reached];
    for (index, (pair, junction)) in channels.windows(2).zip(junctions).enumerate() {
        let next: [Option<(f64, usize)>; D] = std::array::from_fn(|axis| {
            let length = (pair[1].size(axis) - junction.size(axis)) / pair[1].size(axis);
            let before = (0..D).filter(|&before| {
                reached[before].is_some() && is_bend([&pair[0], &pair[1]], [before, axis], tolerance)
            });
            let ways = before.filter_map(|before| Some((reached[before]?.0 + length, before)));
            ways.reduce(|best, way| if way.0 > best.0 { way } else { best })
        });
        if next.iter().all(Option::is_none) {
            return Err(AssemblyError::NotOrthogonal {
                channel: index + 1,
                outer: pair[0],
                next: index + 2,
                inner: pair[1],
                junction: *junction,
            });
        }
        reached = next;
        steps.push(next);
    }
    Ok(followed_back(&steps))
}

/// Whether two boxes that lead along these axes make an L or a T where they overlap: each goes on from the junction
/// along its axis, the inner one more than it goes on along the other's, and one of them (by more than
/// half) spans the other, so that they do not just share a corner.
pub(in crate::channels::assembly) fn is_bend<const D: usize>(
    [outer, inner]: [&Cuboid<D>; 2],
    [leaving, entering]: [usize; 2],
    tolerance: f64,
) -> bool {
    let Some(junction) = outer.intersection(inner) else { return false };
    let rest = |channel: &Cuboid<D>, axis| channel.size(axis) - junction.size(axis);
    let spans = |channel: &Cuboid<D>, axis| junction.size(axis) > channel.size(axis) / 2.0;
    let goes_on = rest(outer, leaving) > tolerance
        && rest(inner, entering) > tolerance
        && rest(inner, entering) >= rest(inner, leaving);
    let across = spans(outer, entering) || spans(inner, leaving);
    let others = (0..D).filter(|&axis| axis != leaving && axis != entering);
    let beside = others.into_iter().all(|axis| spans(outer, axis) || spans(inner, axis));
    leaving != entering && goes_on && across && beside
}

/// The axes of the chain that goes on furthest, found from its last channel.
fn followed_back<const D: usize>(steps: &[[Option<(f64, usize)>; D]]) -> Vec<usize> {
    let last = steps.last().into_iter().flatten().enumerate();
    let ends = last.filter_map(|(axis, way)| Some((axis, way.as_ref()?.0)));
    let best = ends.reduce(|best, end| if end.1 > best.1 { end } else { best });
    let mut axis = best.map_or(D - 1, |(axis, _)| axis);
    let mut axes = vec![axis];
    for step in steps[1..].iter().rev() {
        axis = step[axis].map_or(axis, |(_, before)| before);
        axes.push(axis);
    }
    axes.reverse();
    axes
}
