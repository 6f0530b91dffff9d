//! Numbers of chance, the same ones from the same seed on every machine.

use rand_pcg::Pcg64;
use rand_pcg::rand_core::{Rng, SeedableRng};

use super::robot::{Configuration, Robot};

/// A source of numbers of chance.
#[derive(Clone, Debug)]
pub struct Chance(Pcg64);

impl Chance {
    /// The numbers of a seed.
    pub fn new(seed: u64) -> Self {
        Self(Pcg64::seed_from_u64(seed))
    }

    /// From 0 up to, but without, 1.
    pub fn share(&mut self) -> f64 {
        (self.0.next_u64() >> 11) as f64 * 2.0_f64.powi(-53)
    }

    /// A number from 0 up to, but without, `count`; 0 where that is 0.
    pub fn below(&mut self, count: usize) -> usize {
        ((self.share() * count as f64) as usize).min(count.saturating_sub(1))
    }

    /// A configuration anywhere within the limits.
    pub fn configuration(&mut self, robot: &dyn Robot) -> Configuration {
        robot.limits().iter().map(|limit| limit.low + self.share() * (limit.high - limit.low)).collect()
    }
}
