//! How a set of ratios is spread.

use std::fmt;

/// Ratios, with what each was measured on.
#[derive(Clone, Debug, Default)]
pub struct Tally(Vec<(f64, String)>);

impl Tally {
    /// Adds a ratio.
    pub fn add(&mut self, ratio: f64, of: String) {
        self.0.push((ratio, of));
        self.0.sort_by(|a, b| a.0.total_cmp(&b.0));
    }

    /// Adds those of another.
    pub fn extend(&mut self, other: Self) {
        other.0.into_iter().for_each(|(ratio, of)| self.add(ratio, of));
    }

    /// How many.
    pub fn count(&self) -> usize {
        self.0.len()
    }

    /// The ratio below which this share of all lie.
    pub fn quantile(&self, share: f64) -> f64 {
        self.0[((self.0.len() - 1) as f64 * share).round() as usize].0
    }

    /// The middle one.
    pub fn median(&self) -> f64 {
        self.quantile(0.5)
    }

    /// The largest one.
    pub fn worst(&self) -> f64 {
        self.quantile(1.0)
    }

    /// The smallest one.
    pub fn least(&self) -> f64 {
        self.quantile(0.0)
    }
}

impl fmt::Display for Tally {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if self.0.is_empty() {
            return write!(f, "none");
        }
        write!(f, "{} routes: least {:.4}", self.count(), self.least())?;
        for share in [0.25, 0.5, 0.75, 0.9, 0.95] {
            write!(f, ", {:.0} % {:.4}", share * 100.0, self.quantile(share))?;
        }
        write!(f, ", worst {:.4}", self.worst())?;
        for (ratio, of) in self.0.iter().rev().take(5) {
            write!(f, "\n    {ratio:.4} {of}")?;
        }
        Ok(())
    }
}
