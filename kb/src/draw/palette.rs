//! Colours, widths and dashes: of actions, and of hardness. Nothing is told by colour alone.

use super::scene::Scene;

/// Walls, and the dark of all lines.
pub(super) const INK: &str = "#2b303b";
/// Texts of the second rank, outlines of rooms.
pub(super) const GREY: &str = "#68707d";
/// What nobody passes.
pub(super) const CLOSED: &str = "#8a9099";
pub(super) const BRIDGE: &str = "#b5651d";
/// The start and the goal.
pub(super) const ROUTE: &str = "#17365d";

/// An action's colour and dash, by its position: those of the page (`kb/page/palette.js`).
const ACTIONS: [(&str, &str); 7] = [
    ("#0072b2", ""),
    ("#d55e00", "10 4"),
    ("#007a5a", "3 4"),
    ("#a3487d", "12 4 3 4"),
    ("#5b3fa8", "6 3"),
    ("#7a5c00", "2 2"),
    ("#000000", "16 6"),
];

/// From easy to hard: viridis from its light to its dark end, so that order survives a grey print.
const HARDNESS: [&str; 5] = ["#7ad151", "#22a884", "#2a788e", "#414487", "#440154"];

#[derive(Debug)]
pub(super) struct Palette {
    actions: Vec<String>,
    closed: Vec<String>,
}

impl Palette {
    /// Actions in the order of the scene's list, then of first use by the route, the rooms and the doors.
    /// Those that lead through no passable door are not worth a colour: they are grey.
    pub fn of(scene: &Scene) -> Self {
        let on_route = scene.route.iter().flat_map(|r| &r.steps).filter_map(|s| s.action.as_ref());
        let in_rooms = scene.rooms.iter().filter_map(|r| r.action.as_ref());
        let used = |passable: bool| {
            scene.doors.iter().filter(move |d| d.passable == passable).filter_map(|d| d.action.as_ref())
        };
        let mut closed: Vec<String> = Vec::new();
        for action in used(false) {
            if !closed.contains(action) && !used(true).chain(on_route.clone()).any(|open| open == action) {
                closed.push(action.clone());
            }
        }
        let mut actions: Vec<String> = Vec::new();
        for action in scene.actions.iter().chain(on_route).chain(in_rooms).chain(used(true)) {
            if !actions.contains(action) && !closed.contains(action) {
                actions.push(action.clone());
            }
        }
        Self { actions, closed }
    }

    pub fn actions(&self) -> &[String] {
        &self.actions
    }

    /// The actions that lead nowhere.
    pub fn closed(&self) -> &[String] {
        &self.closed
    }

    pub fn colour(&self, action: Option<&str>) -> &'static str {
        self.position(action).map_or(CLOSED, |i| ACTIONS[i % ACTIONS.len()].0)
    }

    /// Dash of an action's line; empty: solid.
    pub fn dash(&self, action: Option<&str>) -> &'static str {
        self.position(action).map_or("", |i| ACTIONS[i % ACTIONS.len()].1)
    }

    fn position(&self, action: Option<&str>) -> Option<usize> {
        self.actions.iter().position(|a| Some(a.as_str()) == action)
    }
}

/// Hardness in up to five classes.
#[derive(Debug, PartialEq)]
pub(super) struct Scale {
    /// Upper limits of the classes, ascending; the last is the greatest value.
    pub limits: Vec<f64>,
    pub least: f64,
}

impl Scale {
    /// Classes of equal ratio where values differ much, else of equal step. `None` where there is no value.
    pub fn of(values: impl Iterator<Item = f64>) -> Option<Self> {
        let mut values: Vec<f64> = values.filter(|v| v.is_finite()).collect();
        values.sort_by(f64::total_cmp);
        let (&least, &most) = (values.first()?, values.last()?);
        let classes = HARDNESS.len();
        let share = |i: usize| (i + 1) as f64 / classes as f64;
        let limit = |i: usize| {
            if least > 0.0 && most / least > 30.0 {
                least * (most / least).powf(share(i))
            } else {
                least + (most - least) * share(i)
            }
        };
        let mut limits: Vec<f64> = (0..classes - 1).map(limit).chain([most]).collect();
        limits.dedup_by(|a, b| (*a - *b).abs() <= 1e-9 * most.abs());
        Some(Self { limits, least })
    }

    /// The class of a value, from 0 (easy).
    pub fn class(&self, value: f64) -> usize {
        let above = self.limits.iter().position(|limit| value <= *limit);
        above.unwrap_or(self.limits.len().saturating_sub(1))
    }

    pub fn colour(class: usize) -> &'static str {
        HARDNESS[class.min(HARDNESS.len() - 1)]
    }

    pub fn width(class: usize) -> f64 {
        2.0 + 0.9 * class.min(HARDNESS.len() - 1) as f64
    }
}

/// The scale of the passable doors' hardness.
pub(super) fn door_scale(scene: &Scene) -> Option<Scale> {
    Scale::of(scene.doors.iter().filter(|d| d.passable).filter_map(|d| d.hardness))
}

#[cfg(test)]
mod tests {
    use super::ACTIONS;

    /// The list that begins with these words, as the page has it.
    fn of_page(begin: &str) -> String {
        let page = include_str!("../../page/palette.js");
        let list = page.split_once(begin).expect("the page has it").1;
        list.split_once('\n').expect("a line").0.to_owned()
    }

    #[test]
    fn an_action_looks_on_pictures_as_on_the_page() {
        let actions = include_str!("../../page/palette.js").split_once("const ACTIONS").expect("actions").1;
        let light = actions.split_once("light: [").and_then(|(_, rest)| rest.split_once(']'));
        let light: Vec<&str> =
            light.expect("a list").0.split(',').map(|colour| colour.trim().trim_matches('\'')).collect();
        assert_eq!(light, ACTIONS.map(|(colour, _)| colour));
        let dashes = of_page("const DASHES = [").trim_end_matches("];").to_owned();
        let dashes: Vec<String> =
            dashes.split("],").map(|dash| dash.trim_matches([' ', '[', ']']).replace(", ", " ")).collect();
        assert_eq!(dashes, ACTIONS.map(|(_, dash)| dash));
    }
}
