//! How long work shows that it goes on.

use std::time::Duration;

use indicatif::{ProgressBar, ProgressStyle};

/// Hears of the stages of a build as they begin.
pub trait Progress {
    /// A stage begins.
    fn stage(&self, name: &str);
}

/// Says nothing.
pub struct Silent;

impl Progress for Silent {
    fn stage(&self, _name: &str) {}
}

/// A line on standard error that turns while a stage runs; nothing where that is no terminal.
pub struct Spinner(ProgressBar);

impl Spinner {
    /// A spinner that shows itself only when work takes longer than a moment.
    pub fn new() -> Self {
        let bar = ProgressBar::new_spinner();
        if let Ok(style) = ProgressStyle::with_template("{spinner} {msg} ({elapsed})") {
            bar.set_style(style);
        }
        bar.enable_steady_tick(Duration::from_millis(120));
        Self(bar)
    }
}

impl Default for Spinner {
    fn default() -> Self {
        Self::new()
    }
}

impl Progress for Spinner {
    fn stage(&self, name: &str) {
        self.0.set_message(name.to_owned());
    }
}

impl Drop for Spinner {
    fn drop(&mut self) {
        self.0.finish_and_clear();
    }
}

/// A bar on standard error for work of known size; nothing where that is no terminal.
pub struct Bar(ProgressBar);

impl Bar {
    /// A bar for so many pieces of work.
    pub fn new(what: &str, pieces: u64) -> Self {
        let bar = ProgressBar::new(pieces);
        if let Ok(style) = ProgressStyle::with_template("{wide_bar} {pos} of {len} {msg}, {eta} left") {
            bar.set_style(style);
        }
        bar.set_message(what.to_owned());
        Self(bar)
    }

    /// A piece is done.
    pub fn step(&self) {
        self.0.inc(1);
    }
}

impl Drop for Bar {
    fn drop(&mut self) {
        self.0.finish_and_clear();
    }
}
