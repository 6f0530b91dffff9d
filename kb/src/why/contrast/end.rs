//! Two sets of ways, and the end of the values at which the one holds against the other.

use super::Path;
use crate::state::tunable::Weights;
use crate::why::probe::Probe;

/// Two sets of ways: those that hold, and those that speak against them.
pub trait Contrast: Sync {
    /// The best of both at some weights; `None` where there is nothing to compare.
    fn look(&self, weights: &Weights) -> Option<Look>;

    /// As [`look`](Self::look), where a way is known that holds, and what the others cost at least: if the others have not won
    /// against that way, they are not looked at further, nor is a better one that holds.
    fn look_beside(&self, weights: &Weights, _known: &Known) -> Option<Look> {
        self.look(weights)
    }

    /// The best of the others, and what it costs, if that is no more than a limit; one that costs more may be found or not.
    fn rival(&self, weights: &Weights, limit: f64) -> Option<(Path, f64)>;

    /// As [`look`](Self::look), without a search for what is not the best: `own` or `rival` may be missing.
    fn glance(&self, weights: &Weights) -> Option<Look> {
        self.look(weights)
    }

    /// Whether the others have won where the ways that hold cost so much, and the others so much.
    fn is_turned(&self, own: f64, rival: f64) -> bool;

    /// As a share of an end, how far to either side of it is looked at what is the best there; 0 where ways are sums of doors, and
    /// ends follow from them.
    fn hair(&self) -> f64;
}

/// The best of both sets of ways at some weights.
#[derive(Clone, Debug)]
pub struct Look {
    /// The best way of those that hold, and what it costs.
    pub own: Option<(Path, f64)>,
    /// The best of the others, if it was found.
    pub rival: Option<(Path, f64)>,
    /// What the others cost at least.
    pub least: f64,
    /// Whether the others have won.
    pub is_turned: bool,
}

/// What is known before it is looked.
#[derive(Clone, Copy, Debug)]
pub struct Known<'k> {
    /// A way of those that hold.
    pub own: &'k Path,
    /// What the others cost at least; 0 where nothing is known.
    pub least: f64,
}

/// What takes over.
#[derive(Clone, Debug)]
pub enum Takeover {
    /// Another way, with what it costs where it has won.
    Way(Path, f64),
    /// Rooms and doors are cut anew.
    CutAnew,
    /// Rules give no hardness that counts.
    Refused,
    NoWay,
}

/// The value up to which ways hold.
#[derive(Clone, Debug)]
pub struct End {
    pub at: f64,
    /// Where the others were seen to have won: there, or a little beyond.
    pub won_at: f64,
    /// Whether they still hold there.
    pub is_closed: bool,
    pub beyond: Takeover,
}

impl End {
    /// Up to which value ways hold, and the others do not yet.
    pub fn at(value: f64, beyond: Takeover) -> Self {
        Self { at: value, won_at: value, is_closed: true, beyond }
    }

    /// What the other way costs that takes over, where it has.
    pub fn cost(&self) -> Option<f64> {
        match &self.beyond {
            Takeover::Way(_, cost) => Some(*cost),
            _ => None,
        }
    }
}

/// What one side of a cell showed.
#[derive(Clone, Debug)]
pub struct Found {
    /// `None`: there is none, as far as is known.
    pub end: Option<End>,
    /// Whether it is exact but for rounding.
    pub is_exact: bool,
    /// Whether all values were looked at, or all up to the end.
    pub is_whole: bool,
}

impl Found {
    /// That there is no end.
    pub fn nothing() -> Self {
        Self { end: None, is_exact: true, is_whole: true }
    }
}

impl Look {
    /// What has taken over, if anything has.
    pub fn takeover(self) -> Option<Takeover> {
        if !self.is_turned {
            return None;
        }
        Some(self.rival.map_or(Takeover::NoWay, |(path, cost)| Takeover::Way(path, cost)))
    }
}

impl Takeover {
    /// What has taken over where rooms and doors do not just weigh otherwise.
    pub fn of(probe: &Probe) -> Option<Self> {
        match probe {
            Probe::Weighs(_) => None,
            Probe::CutAnew => Some(Self::CutAnew),
            Probe::Refused => Some(Self::Refused),
        }
    }
}
