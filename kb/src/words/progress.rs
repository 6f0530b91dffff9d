//! How long work shows that it goes on.

use std::time::{Duration, Instant};

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

/// A stage of the work and how long it took.
#[derive(Clone, Debug, PartialEq)]
pub struct Stage {
    /// Its name.
    pub name: String,
    /// Its time.
    pub took: Duration,
    /// Whether its result was kept from before, because nothing that it needs has changed.
    pub kept: bool,
}

/// Times stages; one that comes again adds to its time.
pub struct Stopwatch {
    began: Instant,
    /// What was done.
    pub stages: Vec<Stage>,
}

impl Stopwatch {
    /// It runs.
    pub fn new() -> Self {
        Self { began: Instant::now(), stages: Vec::new() }
    }

    /// What was done since the last stage ended.
    pub fn lap(&mut self, name: &str) {
        self.lap_of(name, false);
    }

    /// What was done since the last stage ended was timed by somebody else.
    pub fn skip(&mut self) {
        self.began = Instant::now();
    }

    /// What was done since the last stage ended was to recall what is kept.
    pub fn kept(&mut self, name: &str) {
        self.lap_of(name, true);
    }

    /// What was done since the last stage ended, or recalled.
    pub fn lap_of(&mut self, name: &str, kept: bool) {
        let took = self.began.elapsed();
        self.began = Instant::now();
        match self.stages.iter_mut().find(|stage| stage.name == name) {
            Some(stage) => (stage.took, stage.kept) = (stage.took + took, stage.kept && kept),
            None => self.stages.push(Stage { name: name.to_owned(), took, kept }),
        }
    }
}
