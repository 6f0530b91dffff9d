//! What a body said of itself at first, and whether what it senses goes with that.

use std::f64::consts::TAU;

use super::limits::{FARTHEST_M, LARGEST_RADIUS_M, LATEST_S, MOST_DIRECTIONS, PROTOCOL, WORLD_M};
use super::message::{Place, Profile, Senses};

/// What a body is, as it said; it makes sense.
#[derive(Clone, Debug)]
pub struct Terms {
    pub profile: Profile,
}

/// Of what something that was sensed says what cannot be.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum About {
    Time,
    Angle,
    Range,
    Place,
    Number,
    Contact,
    Shape,
}

/// Something that cannot be, in words.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Wrong {
    pub about: About,
    pub why: String,
}

impl Terms {
    /// Takes a body at its word, where that makes sense.
    pub fn of(profile: Profile) -> Result<Self, String> {
        let Profile { protocol, shapes, shape, directions, range_m, .. } = &profile;
        if *protocol != PROTOCOL {
            return Err(format!("the body speaks protocol {protocol}, expected {PROTOCOL}"));
        }
        if shapes.is_empty() {
            return Err("the body has no shape, expected one or more".to_owned());
        }
        for (place, outline) in shapes.iter().enumerate() {
            let name = &outline.name;
            if shapes[..place].iter().any(|before| before.name == *name) {
                return Err(format!("the body names its shape `{name}` twice"));
            }
            if !(outline.radius_m > 0.0 && outline.radius_m <= LARGEST_RADIUS_M) {
                let found = outline.radius_m;
                return Err(format!(
                    "the radius of the shape `{name}` is {found} m, expected more than 0 and at most {LARGEST_RADIUS_M}"
                ));
            }
            let most = 2.0 * LARGEST_RADIUS_M;
            if let Some(found) = outline.length_m.filter(|length| !(*length > 0.0 && *length <= most)) {
                return Err(format!(
                    "the length of the shape `{name}` is {found} m, expected more than 0 and at most {most}"
                ));
            }
        }
        if !(1..=MOST_DIRECTIONS).contains(directions) {
            return Err(format!(
                "the body measures into {directions} directions, expected 1 to {MOST_DIRECTIONS}"
            ));
        }
        if !(*range_m > 0.0 && *range_m <= FARTHEST_M) {
            return Err(format!(
                "the body hears as far as {range_m} m, expected more than 0 and at most {FARTHEST_M}"
            ));
        }
        let is_own = shapes.iter().any(|outline| outline.name == *shape);
        if !is_own {
            return Err(format!(
                "the body is in the shape `{shape}`, expected one of its own: {}",
                names(&profile)
            ));
        }
        Ok(Self { profile })
    }

    /// All of what was sensed that cannot be, given the time that was told before.
    pub fn wrong(&self, senses: &Senses, before_s: Option<f64>) -> Vec<Wrong> {
        let mut found = Vec::new();
        let mut say = |about, why| found.push(Wrong { about, why });
        let time_s = senses.time_s;
        match before_s {
            Some(before_s) if time_s <= before_s => {
                say(
                    About::Time,
                    format!("`time_s` is {time_s}, expected more than {before_s}, which it was before"),
                );
            }
            _ if (0.0..=LATEST_S).contains(&time_s) => {}
            _ => say(About::Time, format!("`time_s` is {time_s}, expected 0 to {LATEST_S}")),
        }
        let profile = &self.profile;
        let most = profile.directions as usize;
        if senses.readings.len() > most {
            let count = senses.readings.len();
            say(
                About::Number,
                format!("there are {count} readings, expected at most {most}: one a direction"),
            );
        }
        let places = senses.readings.iter().map(|echo| echo.odometry).chain([senses.odometry]);
        let bearings = senses.readings.iter().map(|echo| echo.bearing_rad);
        let bearings = bearings.chain(senses.contact.map(|touch| touch.bearing_rad));
        if let Some(bearing) = bearings.into_iter().find(|bearing| !is_angle(*bearing)) {
            say(About::Angle, format!("`bearing_rad` is {bearing}, {ANGLES}"));
        }
        for place in places {
            let Place { x_m, y_m, heading_rad } = place;
            if !is_angle(heading_rad) {
                say(About::Angle, format!("`heading_rad` is {heading_rad}, {ANGLES}"));
                break;
            }
            if x_m.abs() > WORLD_M || y_m.abs() > WORLD_M {
                say(About::Place, format!("the odometry is at {x_m}, {y_m}, expected within {WORLD_M} m"));
                break;
            }
        }
        let ranges = senses.readings.iter().filter_map(|echo| echo.range_m);
        if let Some(range_m) = ranges.into_iter().find(|range_m| !(0.0..=profile.range_m).contains(range_m)) {
            let most = profile.range_m;
            say(
                About::Range,
                format!("`range_m` is {range_m}, expected null, or 0 to {most}, which the body said"),
            );
        }
        if senses.contact.is_some() && !profile.has_skirt {
            say(
                About::Contact,
                "there is a contact, expected null: the body said that it has no skirt".to_owned(),
            );
        }
        if !profile.shapes.iter().any(|outline| outline.name == senses.shape) {
            say(About::Shape, format!("the shape is `{}`, expected one of {}", senses.shape, names(profile)));
        }
        found
    }
}

const ANGLES: &str = "expected radians, from -2 pi to 2 pi";

fn is_angle(angle: f64) -> bool {
    (-TAU..=TAU).contains(&angle)
}

/// The names of a body's shapes.
pub fn names(profile: &Profile) -> String {
    profile.shapes.iter().map(|outline| outline.name.as_str()).collect::<Vec<_>>().join(", ")
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::navigation::body::message::{Echo, Outline, Touch};

    type Change<T> = fn(&mut T);

    fn profile() -> Profile {
        let outline = |name: &str, radius_m| Outline { name: name.to_owned(), radius_m, length_m: None };
        Profile {
            protocol: PROTOCOL,
            shapes: vec![outline("tall", 0.3), outline("low", 0.4)],
            shape: "tall".to_owned(),
            directions: 4,
            range_m: 8.0,
            has_skirt: false,
        }
    }

    fn senses() -> Senses {
        let odometry = Place { x_m: 1.0, y_m: 2.0, heading_rad: -3.0 };
        let readings = vec![Echo { bearing_rad: 6.2, range_m: Some(8.0), odometry }; 4];
        Senses { time_s: 1.0, odometry, readings, contact: None, is_busy: true, shape: "low".to_owned() }
    }

    #[test]
    fn what_a_body_says_of_itself_has_to_make_sense() {
        assert!(Terms::of(profile()).is_ok());
        let changes: [(Change<Profile>, &str); 9] = [
            (|it| it.protocol = 2, "speaks protocol 2, expected 1"),
            (|it| it.shapes.clear(), "no shape"),
            (|it| it.shapes[1].name = "tall".to_owned(), "`tall` twice"),
            (|it| it.shapes[0].radius_m = 0.0, "is 0 m, expected more than 0"),
            (
                |it| it.shapes[0].length_m = Some(-1.0),
                "the length of the shape `tall` is -1 m, expected more than 0",
            ),
            (|it| it.directions = 0, "into 0 directions"),
            (|it| it.directions = 5000, "into 5000 directions"),
            (|it| it.range_m = -1.0, "as far as -1 m"),
            (|it| it.shape = "flat".to_owned(), "in the shape `flat`, expected one of its own: tall, low"),
        ];
        for (change, words) in changes {
            let mut profile = profile();
            change(&mut profile);
            let said = Terms::of(profile).expect_err(words);
            assert!(said.contains(words), "{said}");
        }
    }

    #[test]
    fn what_cannot_be_is_said_with_what_was_found_and_what_was_expected() {
        let terms = Terms::of(profile()).expect("it makes sense");
        assert_eq!(terms.wrong(&senses(), Some(0.5)), []);
        let changes: [(Change<Senses>, About, &str); 11] = [
            (|it| it.time_s = 0.5, About::Time, "`time_s` is 0.5, expected more than 0.5"),
            (|it| it.time_s = 1e10, About::Time, "expected 0 to"),
            (|it| it.readings[1].bearing_rad = 90.0, About::Angle, "`bearing_rad` is 90, expected radians"),
            (|it| it.odometry.heading_rad = -7.0, About::Angle, "`heading_rad` is -7"),
            (|it| it.readings[3].odometry.heading_rad = 7.0, About::Angle, "`heading_rad` is 7"),
            (
                |it| it.readings[0].range_m = Some(8.1),
                About::Range,
                "`range_m` is 8.1, expected null, or 0 to 8",
            ),
            (|it| it.readings[0].range_m = Some(-0.1), About::Range, "`range_m` is -0.1"),
            (|it| it.odometry.x_m = -1e300, About::Place, "expected within "),
            (|it| it.readings.push(it.readings[0]), About::Number, "5 readings, expected at most 4"),
            (|it| it.contact = Some(Touch { bearing_rad: 0.0 }), About::Contact, "it has no skirt"),
            (|it| it.shape = "flat".to_owned(), About::Shape, "`flat`, expected one of tall, low"),
        ];
        for (change, about, words) in changes {
            let mut senses = senses();
            change(&mut senses);
            let found = terms.wrong(&senses, Some(0.5));
            assert!(found.len() == 1 && found[0].about == about && found[0].why.contains(words), "{found:?}");
        }
    }
}
