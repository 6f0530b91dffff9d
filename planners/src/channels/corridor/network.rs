//! Corridors as a network: channels, joined where an upright and a lying one overlap.

use thiserror::Error;

use super::axis::Axis;
use super::walls::{Wall, outline};
use crate::geometry::tolerance::ROUNDING_M;
use crate::geometry::{Point, Rect};

/// Where two channels meet at right angles.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Junction {
    /// What the two have in common; where one ends inside the other, all that it would share if it went on to the other's
    /// far side, which is just as free.
    pub rect: Rect,
    /// Number of the channel along x.
    pub lying: usize,
    /// Number of the channel along y.
    pub upright: usize,
}

/// How two channels overlap that do not meet at right angles.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Overlap {
    /// One continues the other, or runs beside it.
    InLine,
    /// Each has one corner in the other.
    Corner,
    /// One lies inside the other.
    Within,
}

/// Why channels make no corridors.
#[derive(Clone, Debug, Error, PartialEq)]
#[non_exhaustive]
pub enum CorridorError {
    #[error("there are no channels, expected at least one rectangle")]
    NoChannels,
    #[error(
        "channel {channel} is [{}, {}, {}, {}], expected x0 < x1 and y0 < y1, all finite",
        rect.x0, rect.y0, rect.x1, rect.y1
    )]
    NotARectangle { channel: usize, rect: Rect },
    /// Two overlap, and a robot could not tell where to turn.
    #[error(
        "channels {first} and {second} overlap, but are not orthogonal: {how}; they share [{}, {}, {}, {}], and one of \
         them should cross the other there, or end in it, over its full width",
        rect.x0, rect.y0, rect.x1, rect.y1
    )]
    NotOrthogonal { first: usize, second: usize, how: Overlap, rect: Rect },
    /// A channel is upright for one neighbour and lying for another.
    #[error(
        "channel {channel} lies along {axis} where it meets channel {one}, but along {} where it meets channel {other}; \
         give it as two channels",
        axis.across()
    )]
    TwoAxes { channel: usize, axis: Axis, one: usize, other: usize },
}

impl std::fmt::Display for Overlap {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(match self {
            Self::InLine => "they lie in line or side by side",
            Self::Corner => "they overlap at a corner only",
            Self::Within => "one lies inside the other",
        })
    }
}

/// Corridors: channels, the junctions between them, and the walls around them.
#[derive(Clone, Debug, PartialEq)]
pub struct Corridors {
    channels: Vec<Rect>,
    /// The channels with all of their junctions.
    whole: Vec<Rect>,
    axes: Vec<Axis>,
    junctions: Vec<Junction>,
    /// Of each channel, by index, the indices of its junctions.
    pub(super) on: Vec<Vec<usize>>,
    walls: Vec<Wall>,
}

impl Corridors {
    /// Reads a chain or a network of channels, in any order. O(channels²).
    ///
    /// Two channels that overlap make a junction: the upright one's range of x lies in that of the lying one, or the
    /// lying one's range of y in that of the upright one, and it sticks out there. Junctions are numbered in the order of
    /// the pairs of channels; in a listed chain, junction i is that of channels i and i + 1. Channels that only touch are
    /// not joined, though no wall is between them.
    pub fn new(channels: &[Rect]) -> Result<Self, CorridorError> {
        if channels.is_empty() {
            return Err(CorridorError::NoChannels);
        }
        for (index, rect) in channels.iter().enumerate() {
            let is_finite = [rect.x0, rect.y0, rect.x1, rect.y1].iter().all(|edge| edge.is_finite());
            if !(is_finite && rect.x0 < rect.x1 && rect.y0 < rect.y1) {
                return Err(CorridorError::NotARectangle { channel: index + 1, rect: *rect });
            }
        }
        let mut junctions = Vec::new();
        for (first, one) in channels.iter().enumerate() {
            for (second, other) in channels.iter().enumerate().skip(first + 1) {
                let Some(rect) = one.intersection(other).filter(|rect| rect.smaller_side() > ROUNDING_M)
                else {
                    continue;
                };
                let (first, second) = (first + 1, second + 1);
                junctions.push(match upright(one, other) {
                    Ok(true) => Junction { rect: crossing(one, other), upright: first, lying: second },
                    Ok(false) => Junction { rect: crossing(other, one), upright: second, lying: first },
                    Err(how) => return Err(CorridorError::NotOrthogonal { first, second, how, rect }),
                });
            }
        }
        let axes = axes(channels, &junctions)?;
        let (mut on, mut whole) = (vec![Vec::new(); channels.len()], channels.to_vec());
        for (index, junction) in junctions.iter().enumerate() {
            for channel in [junction.lying - 1, junction.upright - 1] {
                on[channel].push(index);
                whole[channel] = hull(&whole[channel], &junction.rect);
            }
        }
        Ok(Self { channels: channels.to_vec(), whole, axes, junctions, on, walls: outline(channels) })
    }

    /// The channels as they were given; the first one has number 1.
    pub fn channels(&self) -> &[Rect] {
        &self.channels
    }

    /// The junctions; the first one has number 1.
    pub fn junctions(&self) -> &[Junction] {
        &self.junctions
    }

    /// The outline of all channels together.
    pub fn walls(&self) -> &[Wall] {
        &self.walls
    }

    /// The axis along which a channel lies, by its number: of one without junctions, that of its longer side. `None`
    /// where there is no such channel.
    pub fn axis(&self, channel: usize) -> Option<Axis> {
        self.axes.get(channel.checked_sub(1)?).copied()
    }

    /// The numbers of the channels that hold a point, on their edge or inside. A junction is in both of its channels.
    pub fn at(&self, point: Point) -> impl Iterator<Item = usize> {
        (1..).zip(&self.whole).filter(move |(_, rect)| rect.contains(point)).map(|(number, _)| number)
    }

    /// With all of its junctions.
    pub(super) fn channel(&self, number: usize) -> &Rect {
        &self.whole[number - 1]
    }

    pub(super) fn axis_of(&self, number: usize) -> Axis {
        self.axes[number - 1]
    }

    /// Across its axis.
    pub(super) fn width(&self, number: usize) -> f64 {
        self.axis_of(number).across().extent(self.channel(number))
    }
}

impl Junction {
    /// Number of the channel that is met here, coming from another.
    pub fn other(&self, channel: usize) -> usize {
        if channel == self.lying { self.upright } else { self.lying }
    }
}

/// Whether the first one of two that overlap is the upright one.
fn upright(one: &Rect, other: &Rect) -> Result<bool, Overlap> {
    match (is_upright(one, other), is_upright(other, one)) {
        (true, false) => Ok(true),
        (false, true) => Ok(false),
        _ if one.encloses(other) || other.encloses(one) => Err(Overlap::Within),
        _ if shares_side(one, other) => Err(Overlap::InLine),
        _ => Err(Overlap::Corner),
    }
}

/// Whether `one` is upright and `other` lying: each sticks out of the other, and one of them keeps its whole width in the
/// other, which is not just the wider part of the same corridor.
fn is_upright(one: &Rect, other: &Rect) -> bool {
    let sticks_out = !within((one.y0, one.y1), (other.y0, other.y1));
    let is_stuck_out_of = !within((other.x0, other.x1), (one.x0, one.x1));
    let stands = within((one.x0, one.x1), (other.x0, other.x1)) && other.dx() >= other.dy();
    let lies = within((other.y0, other.y1), (one.y0, one.y1)) && one.dy() >= one.dx();
    let crosses =
        within((one.x0, one.x1), (other.x0, other.x1)) && within((other.y0, other.y1), (one.y0, one.y1));
    sticks_out && is_stuck_out_of && (stands || lies || crosses)
}

/// All that an upright and a lying channel can share.
fn crossing(upright: &Rect, lying: &Rect) -> Rect {
    Rect::new(upright.x0, lying.y0, upright.x1, lying.y1)
}

fn hull(one: &Rect, other: &Rect) -> Rect {
    Rect::new(one.x0.min(other.x0), one.y0.min(other.y0), one.x1.max(other.x1), one.y1.max(other.y1))
}

/// Whether the range of one lies in that of the other on some axis.
fn shares_side(one: &Rect, other: &Rect) -> bool {
    let (x, y) = ((one.x0, one.x1), (one.y0, one.y1));
    let (other_x, other_y) = ((other.x0, other.x1), (other.y0, other.y1));
    within(x, other_x) || within(other_x, x) || within(y, other_y) || within(other_y, y)
}

fn within(inner: (f64, f64), outer: (f64, f64)) -> bool {
    inner.0 >= outer.0 - ROUNDING_M && inner.1 <= outer.1 + ROUNDING_M
}

fn axes(channels: &[Rect], junctions: &[Junction]) -> Result<Vec<Axis>, CorridorError> {
    let mut met: Vec<Option<(Axis, usize)>> = vec![None; channels.len()];
    for junction in junctions {
        let roles =
            [(junction.lying, Axis::X, junction.upright), (junction.upright, Axis::Y, junction.lying)];
        for (channel, axis, with) in roles {
            match met[channel - 1] {
                Some((known, one)) if known != axis => {
                    return Err(CorridorError::TwoAxes { channel, axis: known, one, other: with });
                }
                _ => met[channel - 1] = Some((axis, with)),
            }
        }
    }
    let longer = |rect: &Rect| if rect.dx() >= rect.dy() { Axis::X } else { Axis::Y };
    Ok(channels.iter().zip(met).map(|(rect, met)| met.map_or_else(|| longer(rect), |met| met.0)).collect())
}
