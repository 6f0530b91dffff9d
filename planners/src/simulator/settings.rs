//! What a simulated robot senses, and how good its wheels are.

use crate::figures::settings;

settings! {
    /// Figures of a simulated robot. One error of the wheels is drawn for each command, one of each reading.
    #[derive(Clone, Copy, Debug, PartialEq)]
    pub struct Settings {
        others {
            radius_m: f64 = 0.25;
            greatest_speed_m_s: f64 = 0.5;
        }
        figures {
            readings_a_turn: u16 = 120, "directions", "", Count, "Into how many directions it measures, all around.";
            readings_at_once: u16 = 1, "at_once", "", Count, "In how many of them at once, one beside the other: 1 for a sonar that turns, all of them for a lidar or a ring.";
            reading_period_s: f64 = 0.05, "period", "s", Grain, "Time from these readings to the next; sound needs 0.047 s for 8 m and back.";
            sonar_range_m: f64 = 8.0, "range", "m", Positive, "How far away something is measured.";
            range_noise: f64 = 0.01, "noise", "", Share, "Standard deviation of a reading, as a share of it.";
            missed: f64 = 0.02, "missed", "", Share, "Share of the readings without an echo where there is one.";
            false_echoes: f64 = 0.01, "false_echoes", "", Share, "Share of the readings with an echo from anywhere.";
            has_skirt: bool = true, "skirt", "", YesOrNo, "Whether a skirt feels what the robot touches.";
            turning_speed: degrees = 90.0, "turning_speed", "°/s", Positive, "How fast it turns.";
            distance_noise: f64 = 0.02, "distance_noise", "", Share, "Standard deviation of the distance that the wheels count, as a share of it.";
            heading_noise: degrees = 1.0, "heading_noise", "°/√m", NotNegative, "Standard deviation of the heading after one metre; it grows with the root of the metres.";
            heading_bias: degrees = 0.05, "heading_bias", "°/m", NotNegative, "By how much the heading drifts to the left unnoticed.";
        }
    }
}

impl Settings {
    /// A robot that measures all around at once, ten times a second.
    pub fn lidar() -> Self {
        Self {
            readings_a_turn: 240,
            readings_at_once: 240,
            reading_period_s: 0.1,
            sonar_range_m: 12.0,
            range_noise: 0.005,
            ..Self::default()
        }
    }

    /// A robot whose wheels and sonar make no errors.
    pub fn exact() -> Self {
        Self {
            distance_noise: 0.0,
            heading_noise: 0.0,
            heading_bias: 0.0,
            range_noise: 0.0,
            missed: 0.0,
            false_echoes: 0.0,
            ..Self::default()
        }
    }

    /// The first figure that makes no sense, by name.
    pub(super) fn wrong(&self) -> Option<(&'static str, f64)> {
        let above = [
            ("radius_m", self.radius_m),
            ("greatest_speed_m_s", self.greatest_speed_m_s),
            ("turning_speed", self.turning_speed),
            ("readings_a_turn", f64::from(self.readings_a_turn)),
            ("readings_at_once", f64::from(self.readings_at_once)),
            ("reading_period_s", self.reading_period_s),
            ("sonar_range_m", self.sonar_range_m),
        ];
        let shares = [("missed", self.missed), ("false_echoes", self.false_echoes)];
        let noises = [
            ("distance_noise", self.distance_noise),
            ("heading_noise", self.heading_noise),
            ("range_noise", self.range_noise),
        ];
        let bad_above = above.into_iter().find(|(_, value)| !(value.is_finite() && *value > 0.0));
        let bad_share = shares.into_iter().find(|(_, value)| !(0.0..=1.0).contains(value));
        let bad_noise = noises.into_iter().find(|(_, value)| !(value.is_finite() && *value >= 0.0));
        let bad_count = (self.readings_at_once > self.readings_a_turn)
            .then_some(("readings_at_once", f64::from(self.readings_at_once)));
        let bad_bias = (!self.heading_bias.is_finite()).then_some(("heading_bias", self.heading_bias));
        bad_above.or(bad_count).or(bad_share).or(bad_noise).or(bad_bias)
    }
}
