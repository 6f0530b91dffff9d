//! What channels that make no chain are refused for.

use crate::channels::assembly::Cuboid;

/// What is wrong with channels or part. Channels are numbered from 1, the one that leads out.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum AssemblyError<const D: usize> {
    #[error("no channel is given; the first one leads out along +z")]
    NoChannel,
    #[error("channel {channel} is {found}; expected finite numbers, each minimum below its maximum")]
    NotABox { channel: usize, found: Cuboid<D> },
    #[error("the part is {found}; expected finite numbers, each minimum below its maximum")]
    PartIsNoBox { found: Cuboid<D> },
    #[error(
        "channel {channel} reaches up to z = {height}, above channel 1, which leads out and ends at {top}"
    )]
    HigherThanTheFirst { channel: usize, height: f64, top: f64 },
    #[error("channel {channel} {outer} and channel {next} {inner} do not overlap, so there is no junction")]
    Disconnected { channel: usize, outer: Cuboid<D>, next: usize, inner: Cuboid<D> },
    /// Two neighbours in line, one within the other, or sharing a corner only.
    #[error(
        "channel {channel} {outer} and channel {next} {inner} share {junction}, which is neither an L nor a T: \
         each must go on from there along an axis of its own, and one must span the other"
    )]
    NotOrthogonal { channel: usize, outer: Cuboid<D>, next: usize, inner: Cuboid<D>, junction: Cuboid<D> },
    #[error(
        "the part {part} sticks out of channel {last} {channel}, the last one, by {by}; {}",
        lies_in(*holder)
    )]
    PartOutside {
        part: Cuboid<D>,
        last: usize,
        channel: Cuboid<D>,
        by: f64,
        /// The number of the channel that it does lie in.
        holder: Option<usize>,
    },
}

fn lies_in(holder: Option<usize>) -> String {
    holder.map_or_else(|| "it lies in none".to_owned(), |number| format!("it lies in channel {number}"))
}
