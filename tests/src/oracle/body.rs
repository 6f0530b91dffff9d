//! A robot as the judge sees it: its states, and what a change of shape costs.

use std::fmt::Write;

/// A shape in which the robot moves.
#[derive(Clone, Debug, PartialEq)]
pub struct State {
    /// Its name.
    pub name: String,
    /// Metres.
    pub height: f64,
    /// Metres.
    pub width: f64,
    /// Per metre.
    pub hardness: f64,
}

/// A robot.
#[derive(Clone, Debug, PartialEq, Default)]
pub struct Body {
    /// Its states.
    pub states: Vec<State>,
    /// From one state to another, by index, and what that costs; what is not said costs nothing.
    pub changes: Vec<(usize, usize, f64)>,
}

impl Body {
    /// A robot of states `(name, height, width, hardness)` that changes freely.
    pub fn new(states: &[(&str, f64, f64, f64)]) -> Self {
        let state = |&(name, height, width, hardness): &(&str, f64, f64, f64)| State {
            name: name.to_owned(),
            height,
            width,
            hardness,
        };
        Self { states: states.iter().map(state).collect(), changes: Vec::new() }
    }

    /// The same with changes `(from, to, hardness)`.
    #[must_use]
    pub fn with_changes(mut self, changes: &[(usize, usize, f64)]) -> Self {
        self.changes = changes.to_vec();
        self
    }

    /// What a change costs.
    pub fn change(&self, from: usize, to: usize) -> f64 {
        self.changes.iter().find(|change| (change.0, change.1) == (from, to)).map_or(0.0, |change| change.2)
    }

    /// Index of a state.
    pub fn index(&self, name: &str) -> Option<usize> {
        self.states.iter().position(|state| state.name == name)
    }

    /// The widest state, metres.
    pub fn widest(&self) -> f64 {
        self.states.iter().map(|state| state.width).fold(0.0, f64::max)
    }

    /// The file `robots.toml`.
    pub fn to_toml(&self) -> String {
        let mut text = String::new();
        for State { name, height, width, hardness } in &self.states {
            writeln!(
                text,
                "[[robots]]\nstate = \"{name}\"\naction = \"{name}\"\nheight = {height:?}\nwidth = {width:?}\n\
                 hardness = {hardness:?}\n"
            )
            .expect("writing to a string cannot fail");
        }
        for &(from, to, hardness) in &self.changes {
            let (from, to) = (&self.states[from].name, &self.states[to].name);
            writeln!(
                text,
                "[[changes]]\nfrom_state = \"{from}\"\nto_state = \"{to}\"\nhardness = {hardness:?}\n"
            )
            .expect("writing to a string cannot fail");
        }
        text
    }
}
