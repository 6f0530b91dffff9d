//! The way inside one channel, from where it is entered to where it is left.

use std::fmt;

#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum End {
    Start,
    Junction(usize),
    Goal,
}

/// The way inside one channel, from where it is entered to where it is left.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Passage {
    pub channel: usize,
    pub from: End,
    pub to: End,
    /// Metres between the two; a junction counts with its centre.
    pub length: f64,
    /// Of the channel, across its axis.
    pub width: f64,
}

impl fmt::Display for End {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Start => f.write_str("the start"),
            Self::Junction(number) => write!(f, "junction {number}"),
            Self::Goal => f.write_str("the goal"),
        }
    }
}

impl fmt::Display for Passage {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "channel {} from {} to {}", self.channel, self.from, self.to)
    }
}
