//! The cells that people tune, and how far their values go.

/// Values beyond this are not looked at: there is no end.
pub const LARGEST: f64 = 1e6;

/// A number of a table that people tune.
#[derive(Clone, Debug, PartialEq)]
pub struct Lever {
    pub class: String,
    pub row: usize,
    /// The key by which edits name the row.
    pub key: String,
    pub column: String,
    pub value: f64,
    /// The other values of the column, ascending.
    pub others: Vec<f64>,
}

impl Lever {
    /// What a change of it is measured by.
    pub fn scale(&self) -> f64 {
        self.value.abs().max(0.1)
    }

    /// The values between the present one and a limit, exclusively, where rules may switch, outwards; the limit is the last.
    pub fn breaks(&self, limit: f64) -> Vec<f64> {
        let (low, high) = (self.value.min(limit), self.value.max(limit));
        let mut breaks: Vec<f64> =
            self.others.iter().copied().filter(|other| *other > low && *other < high).collect();
        if limit < self.value {
            breaks.reverse();
        }
        breaks.push(limit);
        breaks
    }

    /// The values by which it shows whether weights are linear up to a limit, outwards: where rules may switch, and between.
    pub fn values(&self, limit: f64) -> Vec<f64> {
        let mut from = self.value;
        let mut values = Vec::new();
        for to in self.breaks(limit) {
            values.extend([f64::midpoint(from, to), to]);
            from = to;
        }
        values
    }
}

/// To which side of the present value.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Side {
    Below,
    Above,
}

impl Side {
    /// The last value on it, or as far as is looked.
    pub fn limit(self, lever: &Lever, within: Option<f64>) -> f64 {
        let reach = within.map_or(f64::INFINITY, |share| share * lever.scale());
        match self {
            Self::Below => (lever.value - reach).max(lowest(lever)),
            Self::Above => (lever.value + reach).min(LARGEST.max(lever.value * 2.0)),
        }
    }
}

/// So near to the last value of a range, as a share of it, there is no end.
pub const LAST: f64 = 1e-4;

/// Nobody sets a hardness so near to nothing, or to so small a share of what it is.
const LOWEST: f64 = 1e-3;

/// The least value of a cell that is looked at. Where all weighs nothing, all ways are as good.
pub fn lowest(lever: &Lever) -> f64 {
    if lever.value < 0.0 { least(lever) } else { LOWEST * lever.value.min(1.0) }
}

/// The least value that a cell may have.
pub fn least(lever: &Lever) -> f64 {
    if lever.value < 0.0 { -LARGEST } else { 0.0 }
}
