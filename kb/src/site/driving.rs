//! How a robot that drives is set: the figures of its navigator, and what it senses where it is simulated.

use std::path::Path;

use adit_planners::figures::Figure;
use adit_planners::navigation::{Outfit, Settings};
use adit_planners::read::{Code, Fields, Problem};
use adit_planners::simulator;

use super::figures::{figures, table};
use super::tables::TableFile;

/// The tables that a file has of it, and those of the database.
pub const NAVIGATION: &str = "navigation";
pub const SENSORS: &str = "sensors";

/// How fast a robot goes is said by its state, where there are states.
const SPEED: &str = "speed";

#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Driving {
    pub navigation: Settings,
    pub sensors: simulator::Settings,
    /// Whether states of robots say how fast these are.
    has_states: bool,
}

impl Driving {
    /// A robot as Crowley's: with a sonar that turns.
    pub fn of_floor() -> Self {
        Self { navigation: Settings::default(), sensors: simulator::Settings::default(), has_states: false }
    }

    /// A robot on a site that is cut into rooms: with a lidar.
    pub fn of_rooms() -> Self {
        Self { sensors: simulator::Settings::lidar(), has_states: true, ..Self::of_floor() }
    }

    /// Takes what a file says.
    pub fn read(mut self, fields: &Fields<'_, '_>, titles: [&str; 2], problems: &mut Vec<Problem>) -> Self {
        let [navigation, sensors] = titles;
        if let Some(table) = fields.table(NAVIGATION, navigation, problems) {
            figures(&table, &self.navigator(), &mut self.navigation, problems);
        }
        if let Some(table) = fields.table(SENSORS, sensors, problems) {
            figures(&table, simulator::Settings::FIGURES, &mut self.sensors, problems);
            if let Some(wrong) = self.too_many_at_once() {
                problems.push(table.text.problem(Code::NotPositive, &table.span, wrong));
            }
        }
        self
    }

    /// The tables that keep it.
    pub fn tables(&self, file: &Path) -> [TableFile; 2] {
        [
            table(file, NAVIGATION, &self.navigator(), &self.navigation),
            table(file, SENSORS, simulator::Settings::FIGURES, &self.sensors),
        ]
    }

    /// What is wrong where it measures into more directions at once than there are.
    pub fn too_many_at_once(&self) -> Option<String> {
        let [at_once, all] = [self.sensors.readings_at_once, self.sensors.readings_a_turn];
        (at_once > all).then(|| {
            format!(
                "sensors: `at_once` is {at_once}, and there are {all} `directions`; expected at most {all}"
            )
        })
    }

    /// A robot that is set so.
    pub fn outfit(&self, radius_m: f64) -> Outfit {
        Outfit::of(simulator::Settings { radius_m, ..self.sensors }, self.navigation)
    }

    /// The figures of the navigator that may be set.
    pub fn navigator(&self) -> Vec<Figure<Settings>> {
        let all = Settings::FIGURES.iter().copied();
        all.filter(|figure| !self.has_states || figure.name != SPEED).collect()
    }
}
