//! Random chains of channels.

use adit_planners::channels::assembly::Cuboid;
use proptest::prelude::*;

/// A chain in which the part never needs to move towards -z, with a part that fits.
#[derive(Clone, Debug)]
pub struct Chain<const D: usize> {
    pub channels: Vec<Cuboid<D>>,
    /// Along which each channel leads.
    pub axes: Vec<usize>,
    pub part: Cuboid<D>,
    /// For each junction and axis, the share of the safest gap that is kept.
    pub shares: Vec<[f64; D]>,
}

/// Raw numbers from 0 to 1 that a chain is made of, so that proptest can shrink them.
type Raw<const D: usize> = (Vec<[f64; 4]>, [f64; D], [f64; D], Vec<[f64; D]>);

pub fn chains<const D: usize>(channels: std::ops::Range<usize>) -> impl Strategy<Value = Chain<D>>
where
    [f64; D]: std::fmt::Debug,
{
    let number = 0.0..1.0_f64;
    let per_axis = move || prop::collection::vec(0.0..1.0_f64, D).prop_map(|v| std::array::from_fn(|k| v[k]));
    let shares = prop::collection::vec(per_axis(), channels.end);
    let steps = prop::collection::vec(prop::array::uniform4(number), channels);
    (steps, per_axis(), per_axis(), shares).prop_map(chain)
}

fn chain<const D: usize>((steps, size, place, shares): Raw<D>) -> Chain<D> {
    let up = D - 1;
    let size = size.map(|share| 0.2 + 2.0 * share);
    // The junction that the chain has come to, outermost first; each channel changes one of its intervals.
    let mut junction =
        Cuboid::new([0.0; D], std::array::from_fn(|k| size[k] + 0.02 + 2.0 * steps[0][0] * place[k]));
    let mut mouth = junction;
    mouth.max[up] += 0.5 + 5.0 * steps[0][1];
    let (mut channels, mut axes) = (vec![mouth], vec![up]);
    for [turn, way, length, width] in &steps[1..] {
        let others: Vec<usize> = (0..D).filter(|axis| axis != axes.last().unwrap()).collect();
        let axis = others[((turn * others.len() as f64) as usize).min(others.len() - 1)];
        let mut next = junction;
        let wide = size[axis] + 0.02 + 2.0 * width;
        if axis == up || *way < 0.5 {
            // Both ends lie lower than those of the junction, so neither interval holds the other.
            next.max[axis] -= 0.1 + 4.0 * length;
            next.min[axis] = (next.max[axis] - wide).min(junction.min[axis] - 0.1);
        } else {
            next.min[axis] += 0.1 + 4.0 * length;
            next.max[axis] = (next.min[axis] + wide).max(junction.max[axis] + 0.1);
        }
        channels.push(junction.joined(&next));
        axes.push(axis);
        junction = next;
    }
    let last = channels[channels.len() - 1];
    let min: [f64; D] = std::array::from_fn(|k| last.min[k] + place[k] * (last.size(k) - size[k]));
    let part = Cuboid::new(min, std::array::from_fn(|k| min[k] + size[k]));
    Chain { channels, axes, part, shares }
}
