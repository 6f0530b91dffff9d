//! Why no corridors lead from a start to a goal.

use std::collections::BTreeSet;
use std::fmt;

use thiserror::Error;

use super::network::Corridors;
use super::passage::{End, Passage};
use crate::geometry::Point;

/// Why [`Corridors::route`] gives no route; `E` is what its weights fail with.
#[derive(Clone, Debug, Error, PartialEq)]
#[non_exhaustive]
pub enum RouteError<E> {
    #[error("{what} ({}, {}) lies in no channel", point.x, point.y)]
    Outside { what: End, point: Point },
    /// The weights could not be told.
    #[error("{0}")]
    Weigh(E),
    #[error("the weight of {passage} is {weight}, expected a finite number that is not negative")]
    BadWeight { passage: Passage, weight: f64 },
    #[error("{0}")]
    NoRoute(NoRoute),
}

/// Why there is no way from a start to a goal.
#[derive(Clone, Debug, PartialEq)]
pub enum NoRoute {
    /// No chain of channels joins them.
    Apart {
        /// Numbers of the channels that are joined to the start.
        from_start: Vec<usize>,
        /// Numbers of the channels that are joined to the goal.
        from_goal: Vec<usize>,
        /// The channel of each of the two parts that is nearest to the other part.
        nearest: (usize, usize),
        gap: f64,
    },
    /// Every chain of channels holds a passage that must not be used.
    Refused(
        /// The passages that the search came to and that must not be used.
        Vec<Passage>,
    ),
}

impl NoRoute {
    pub(super) fn new(corridors: &Corridors, start: Point, goal: Point, refused: Vec<Passage>) -> Self {
        let (from_start, from_goal) = (joined(corridors, start), joined(corridors, goal));
        if !from_start.is_disjoint(&from_goal) {
            return Self::Refused(refused);
        }
        let pairs = from_start.iter().flat_map(|one| from_goal.iter().map(move |other| (*one, *other)));
        let gaps =
            pairs.map(|(one, other)| (corridors.channel(one).gap(corridors.channel(other)), (one, other)));
        let (gap, nearest) = gaps
            .min_by(|a, b| a.0.total_cmp(&b.0))
            .expect("start and goal were each found in a channel before the search");
        Self::Apart {
            from_start: from_start.into_iter().collect(),
            from_goal: from_goal.into_iter().collect(),
            nearest,
            gap,
        }
    }
}

/// The channels that are joined to a point.
fn joined(corridors: &Corridors, point: Point) -> BTreeSet<usize> {
    let mut joined: BTreeSet<usize> = corridors.at(point).collect();
    let mut open: Vec<usize> = joined.iter().copied().collect();
    while let Some(channel) = open.pop() {
        for index in &corridors.on[channel - 1] {
            let other = corridors.junctions()[*index].other(channel);
            if joined.insert(other) {
                open.push(other);
            }
        }
    }
    joined
}

impl fmt::Display for NoRoute {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Apart { from_start, from_goal, nearest: (one, other), gap } => {
                write!(f, "the start is in {}, the goal in {}, ", list(from_start), list(from_goal))?;
                write!(f, "and no junction joins the two: channels {one} and {other} are nearest, ")?;
                if *gap > 0.0 {
                    write!(f, "{} m apart", super::drive_error::Rounded(*gap))
                } else {
                    write!(f, "and touch without overlapping")
                }
            }
            Self::Refused(passages) if passages.is_empty() => {
                f.write_str("no chain of channels leads through it from the start to the goal")
            }
            Self::Refused(passages) => {
                f.write_str("every way from the start to the goal uses a passage that is not allowed: ")?;
                for (index, passage) in passages.iter().enumerate() {
                    let comma = if index > 0 { ", " } else { "" };
                    write!(f, "{comma}{passage}")?;
                }
                Ok(())
            }
        }
    }
}

fn list(channels: &[usize]) -> String {
    let numbers: Vec<String> = channels.iter().map(ToString::to_string).collect();
    if let [only] = numbers.as_slice() {
        format!("channel {only}")
    } else {
        format!("channels {}", numbers.join(", "))
    }
}
