//! The free space: channels in a chain, checked.

mod axes;
mod error;

pub(super) use axes::is_bend;
pub use error::AssemblyError;

use super::walls::walls;
use super::{Cuboid, sweep};
use crate::geometry::tolerance::ROUNDING;

/// A chain of channels with a part in the last of them. The first channel leads out along the last axis, z.
#[derive(Clone, Debug, PartialEq)]
pub struct Assembly<const D: usize> {
    channels: Vec<Cuboid<D>>,
    junctions: Vec<Cuboid<D>>,
    axes: Vec<usize>,
    walls: Vec<Cuboid<D>>,
    part: Cuboid<D>,
    tolerance: f64,
}

impl<const D: usize> Assembly<D> {
    /// Checks that the channels make a chain: neighbours share an interior and are orthogonal, none is higher than
    /// the first, and the part lies in the last one (it may touch the wall). Whether the part fits through the
    /// junctions is not looked at: [`StepFacts`](super::StepFacts) has what that is told by.
    ///
    /// Complexity: O(n w) for n channels and w boxes of wall, of which a chain that does not cross itself has a few for
    /// each channel.
    pub fn new(channels: Vec<Cuboid<D>>, part: Cuboid<D>) -> Result<Self, AssemblyError<D>> {
        const { assert!(D >= 2, "a channel has a direction and a width") };
        check_boxes(&channels, &part)?;
        let extent = channels.iter().fold(part, |hull, channel| hull.joined(channel));
        let tolerance = ROUNDING * (0..D).map(|axis| extent.size(axis)).fold(0.0, f64::max);
        check_top(&channels)?;
        let junctions = junctions(&channels)?;
        let axes = axes::axes(&channels, &junctions, tolerance)?;
        check_part(&channels, &part, tolerance)?;
        let walls = walls(&channels);
        Ok(Self { channels, junctions, axes, walls, part, tolerance })
    }

    /// The channels, the one that leads out first.
    pub fn channels(&self) -> &[Cuboid<D>] {
        &self.channels
    }

    /// Junction I is the I-th, that of channels I and I + 1.
    pub fn junctions(&self) -> &[Cuboid<D>] {
        &self.junctions
    }

    /// The axis along which each channel leads. Neighbours have different ones.
    pub fn axes(&self) -> &[usize] {
        &self.axes
    }

    /// The part in its assembled state.
    pub fn part(&self) -> Cuboid<D> {
        self.part
    }

    /// The height of the free space, which the part is above in its disassembled state (definition 3.2).
    pub fn top(&self) -> f64 {
        self.channels[0].max[D - 1]
    }

    /// What is not channel, as disjoint boxes: a ring of some metres to the sides and below, open above.
    pub fn walls(&self, ring: f64) -> Vec<Cuboid<D>> {
        let mut frame = self.channels.iter().fold(self.channels[0], |hull, channel| hull.joined(channel));
        for axis in 0..D {
            frame.min[axis] -= ring;
            frame.max[axis] += ring;
        }
        self.walls.iter().filter_map(|wall| wall.intersection(&frame)).collect()
    }

    /// The distance of a box from the nearest wall; 0 where it touches one or is in it.
    pub fn clearance(&self, of: &Cuboid<D>) -> f64 {
        let squared = self.walls.iter().map(|wall| sweep::squared_distance(of, wall));
        squared.fold(f64::INFINITY, f64::min).sqrt()
    }

    pub(super) fn unbounded_walls(&self) -> &[Cuboid<D>] {
        &self.walls
    }

    pub(super) fn tolerance(&self) -> f64 {
        self.tolerance
    }
}

fn check_boxes<const D: usize>(channels: &[Cuboid<D>], part: &Cuboid<D>) -> Result<(), AssemblyError<D>> {
    if channels.is_empty() {
        return Err(AssemblyError::NoChannel);
    }
    let is_box = |cuboid: &Cuboid<D>| cuboid.is_finite() && cuboid.is_solid();
    if let Some(index) = channels.iter().position(|channel| !is_box(channel)) {
        return Err(AssemblyError::NotABox { channel: index + 1, found: channels[index] });
    }
    if !is_box(part) {
        return Err(AssemblyError::PartIsNoBox { found: *part });
    }
    Ok(())
}

fn check_top<const D: usize>(channels: &[Cuboid<D>]) -> Result<(), AssemblyError<D>> {
    let top = channels[0].max[D - 1];
    match channels.iter().position(|channel| channel.max[D - 1] > top) {
        None => Ok(()),
        Some(index) => Err(AssemblyError::HigherThanTheFirst {
            channel: index + 1,
            height: channels[index].max[D - 1],
            top,
        }),
    }
}

fn junctions<const D: usize>(channels: &[Cuboid<D>]) -> Result<Vec<Cuboid<D>>, AssemblyError<D>> {
    let junction = |(index, pair): (usize, &[Cuboid<D>])| {
        pair[0].intersection(&pair[1]).ok_or(AssemblyError::Disconnected {
            channel: index + 1,
            outer: pair[0],
            next: index + 2,
            inner: pair[1],
        })
    };
    channels.windows(2).enumerate().map(junction).collect()
}

fn check_part<const D: usize>(
    channels: &[Cuboid<D>],
    part: &Cuboid<D>,
    tolerance: f64,
) -> Result<(), AssemblyError<D>> {
    let last = channels.len();
    let by = channels[last - 1].excess(part);
    if by <= tolerance {
        return Ok(());
    }
    let holder = channels.iter().rposition(|channel| channel.excess(part) <= tolerance);
    let holder = holder.map(|index| index + 1);
    Err(AssemblyError::PartOutside { part: *part, last, channel: channels[last - 1], by, holder })
}
