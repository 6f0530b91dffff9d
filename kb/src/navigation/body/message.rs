//! The messages of the protocol, one a line. Units are in the names: metres, radians (counter-clockwise above 0), seconds.

use adit_planners::body::{Contact, Reading};
use adit_planners::pose::Pose;
use adit_planners::rim::Rim;
use serde::{Deserialize, Serialize};

use super::limits::shortened;

/// What Adit says. Each is answered.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(tag = "type", rename_all = "snake_case", deny_unknown_fields)]
pub enum Order {
    /// The first one: the version that Adit speaks, and the names of the shapes into which it may want the body to change.
    Hello {
        protocol: u32,
        shapes: Vec<String>,
    },
    Stop {},
    Turn {
        by_rad: f64,
    },
    Move {
        distance_m: f64,
        speed_m_s: f64,
        /// Left out where it is 0: whoever is round goes where it looks.
        #[serde(default, skip_serializing_if = "is_ahead")]
        bearing_rad: f64,
    },
    Change {
        shape: String,
    },
    Sense {},
    Bye {},
}

/// What a body answers.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(tag = "type", rename_all = "snake_case", deny_unknown_fields)]
pub enum Answer {
    Hello(Profile),
    /// To a command: it is being carried out.
    Accepted {},
    Sensed(Senses),
    /// To what a body does not understand, or cannot do. The link goes on.
    Refused {
        why: String,
    },
    Bye {},
}

/// What a body is.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Profile {
    pub protocol: u32,
    /// All shapes in which it can be.
    pub shapes: Vec<Outline>,
    /// The one in which it is.
    pub shape: String,
    /// Into how many directions it measures, all around.
    pub directions: u32,
    /// How far away something is measured at the most.
    pub range_m: f64,
    pub has_skirt: bool,
}

/// A shape. The body is round in it, or, where it has a length, a rectangle that keeps its facing and goes any way in it.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Outline {
    pub name: String,
    /// Half of its width.
    pub radius_m: f64,
    /// Along its heading.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub length_m: Option<f64>,
}

impl Outline {
    pub fn rim(&self) -> Rim {
        Rim::of(2.0 * self.radius_m, self.length_m)
    }
}

#[expect(clippy::trivially_copy_pass_by_ref, reason = "serde asks so")]
fn is_ahead(bearing_rad: &f64) -> bool {
    *bearing_rad == 0.0
}

/// What a body sensed until it answered.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Senses {
    pub time_s: f64,
    pub odometry: Place,
    pub readings: Vec<Echo>,
    #[serde(deserialize_with = "Option::deserialize")]
    pub contact: Option<Touch>,
    pub is_busy: bool,
    pub shape: String,
}

#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Place {
    pub x_m: f64,
    pub y_m: f64,
    pub heading_rad: f64,
}

#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Echo {
    pub bearing_rad: f64,
    #[serde(deserialize_with = "Option::deserialize")]
    pub range_m: Option<f64>,
    pub odometry: Place,
}

#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Touch {
    pub bearing_rad: f64,
}

impl Order {
    pub fn of_line(line: &str) -> Result<Self, String> {
        serde_json::from_str(line).map_err(|error| unreadable(&error, line))
    }

    /// What it is, as sentences name it.
    pub const fn word(&self) -> &'static str {
        match self {
            Self::Hello { .. } => "hello",
            Self::Stop {} => "stop",
            Self::Turn { .. } => "turn",
            Self::Move { .. } => "move",
            Self::Change { .. } => "change",
            Self::Sense {} => "sense",
            Self::Bye {} => "bye",
        }
    }
}

impl Answer {
    pub fn of_line(line: &str) -> Result<Self, String> {
        serde_json::from_str(line).map_err(|error| unreadable(&error, line))
    }

    /// What it is, as sentences name it.
    pub const fn word(&self) -> &'static str {
        match self {
            Self::Hello(_) => "hello",
            Self::Accepted {} => "accepted",
            Self::Sensed(_) => "sensed",
            Self::Refused { .. } => "refused",
            Self::Bye {} => "bye",
        }
    }
}

/// A message as a line.
pub fn line(message: &impl Serialize) -> String {
    let mut text = serde_json::to_string(message).unwrap_or_default();
    text.push('\n');
    text
}

fn unreadable(error: &serde_json::Error, line: &str) -> String {
    format!("{error}, in the line {}", shortened(line))
}

impl From<Pose> for Place {
    fn from(pose: Pose) -> Self {
        Self { x_m: pose.at.x, y_m: pose.at.y, heading_rad: pose.heading }
    }
}

impl From<Place> for Pose {
    fn from(place: Place) -> Self {
        Self::new(place.x_m, place.y_m, place.heading_rad)
    }
}

impl From<Reading> for Echo {
    fn from(reading: Reading) -> Self {
        let Reading { bearing, range_m, odometry } = reading;
        Self { bearing_rad: bearing, range_m, odometry: odometry.into() }
    }
}

impl From<Echo> for Reading {
    fn from(echo: Echo) -> Self {
        Self { bearing: echo.bearing_rad, range_m: echo.range_m, odometry: echo.odometry.into() }
    }
}

impl From<Contact> for Touch {
    fn from(contact: Contact) -> Self {
        Self { bearing_rad: contact.bearing }
    }
}

impl From<Touch> for Contact {
    fn from(touch: Touch) -> Self {
        Self { bearing: touch.bearing_rad }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_number_is_the_same_number_on_the_other_side_to_the_bit() {
        for value in
            [0.1 + 0.2, 1.0 / 3.0, -1.234_567_890_123_456_7e-7, f64::MIN_POSITIVE, std::f64::consts::TAU]
        {
            let order = Order::Move { distance_m: value, speed_m_s: 1.0, bearing_rad: value };
            let Ok(Order::Move { distance_m, bearing_rad, .. }) = Order::of_line(&line(&order)) else {
                panic!("{order:?}")
            };
            assert_eq!([distance_m.to_bits(), bearing_rad.to_bits()], [value.to_bits(); 2]);
        }
    }

    #[test]
    fn what_is_no_message_is_said_with_what_was_found_what_was_expected_and_the_line() {
        for (text, words) in [
            (r#"{"type":"dance"}"#, "unknown variant `dance`, expected one of `hello`"),
            (r#"{"type":"accepted","soon":true}"#, "unknown field `soon`"),
            (r#"{"type":"sensed","time_s":1}"#, "missing field `odometry`"),
            (r#"{"type":"refused","why":7}"#, "invalid type: integer `7`, expected a string"),
            (r#"{"type":"accep"#, "EOF while parsing a string"),
            (r#"{"type":"bye"} {"#, "trailing characters"),
            ("NaN", "expected value"),
        ] {
            let said = Answer::of_line(text).expect_err(text);
            assert!(said.contains(words) && said.contains(&format!("`{text}`")), "{said}");
        }
    }

    #[test]
    fn what_may_be_null_must_be_there() {
        let at = r#"{"x_m":0,"y_m":0,"heading_rad":0}"#;
        let echo = format!(r#"{{"bearing_rad":0,"odometry":{at}}}"#);
        assert!(
            serde_json::from_str::<Echo>(&echo).unwrap_err().to_string().contains("missing field `range_m`")
        );
        let echo = format!(r#"{{"bearing_rad":0,"range_m":null,"odometry":{at}}}"#);
        assert_eq!(serde_json::from_str::<Echo>(&echo).unwrap().range_m, None);
    }
}
