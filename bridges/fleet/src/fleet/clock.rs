//! The time.

use std::time::Instant;

use crate::driver::Clock;

/// Seconds since it was started, and the time of day.
pub struct Watch(Instant);

impl Watch {
    pub fn start() -> Self {
        Self(Instant::now())
    }

    pub fn now(&self) -> Clock {
        let words = jiff::Timestamp::now().strftime("%Y-%m-%dT%H:%M:%S%.3fZ").to_string();
        Clock { seconds: self.0.elapsed().as_secs_f64(), words }
    }
}
