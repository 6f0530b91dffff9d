//! How good the simulated wheels and the simulated sonar are.

#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Settings {
    pub radius_m: f64,
    pub greatest_speed_m_s: f64,
    /// How fast it turns, radians a second.
    pub turning_speed: f64,
    /// Standard deviation of the distance that the wheels count, as a share of it; one error for each command.
    pub distance_noise: f64,
    /// Standard deviation of the heading, radians after one metre; it grows with the root of the metres.
    pub heading_noise: f64,
    /// By how much the heading drifts to the left unnoticed, radians a metre.
    pub heading_bias: f64,
    /// Into how many directions it measures, all around.
    pub readings_a_turn: u16,
    /// In how many of them at once, one beside the other: 1 for a sonar that turns, all of them for a lidar.
    pub readings_at_once: u16,
    /// Seconds from these readings to the next. Sound needs 0.047 s for 8 m and back.
    pub reading_period_s: f64,
    /// Whether a skirt feels what the robot touches.
    pub has_skirt: bool,
    /// How far away something is measured, metres.
    pub sonar_range_m: f64,
    /// Standard deviation of a reading, as a share of it.
    pub range_noise: f64,
    /// Share of the readings without an echo where there is one.
    pub missed: f64,
    /// Share of the readings with an echo from anywhere.
    pub false_echoes: f64,
}

impl Default for Settings {
    fn default() -> Self {
        Self {
            radius_m: 0.25,
            greatest_speed_m_s: 0.5,
            turning_speed: 90.0_f64.to_radians(),
            distance_noise: 0.02,
            heading_noise: 1.0_f64.to_radians(),
            heading_bias: 0.05_f64.to_radians(),
            readings_a_turn: 120,
            readings_at_once: 1,
            reading_period_s: 0.05,
            has_skirt: true,
            sonar_range_m: 8.0,
            range_noise: 0.01,
            missed: 0.02,
            false_echoes: 0.01,
        }
    }
}

impl Settings {
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
