//! A robot at the other end of a link, as a navigator drives it.

use std::fmt;

use adit_planners::body::{Body, Command, Sensed, Silence};
use adit_planners::geometry::Point;
use adit_planners::rim::Rim;

use super::limits::PROTOCOL;
use super::link::Link;
use super::message::{Answer, Order, Senses};
use super::terms::{Terms, names};
use crate::words::number::number;

/// A radius may be larger than the site has it by so much, metres: both are rounded.
const ROUNDED_M: f64 = 1e-3;

/// A shape into which Adit may want a body to change.
#[derive(Clone, Debug, PartialEq)]
pub struct Used {
    /// `None` for the shape in which it is, whatever it is called.
    pub name: Option<String>,
    /// As ways are found for it.
    pub rim: Rim,
}

/// Half of how long and of how wide it is, metres.
fn halves(rim: &Rim) -> [f64; 2] {
    [Point::new(1.0, 0.0), Point::new(0.0, 1.0)].map(|side| rim.extent_m(side))
}

/// Whether a body lies within what ways are found for, but for what both are rounded by.
fn does_fit(own: &Rim, used: &Rim) -> bool {
    let has_room = halves(own).iter().zip(halves(used)).all(|(own, used)| *own <= used + ROUNDED_M);
    has_room && (own.is_disc() || !used.is_disc() || own.outer_m() <= used.radius_m() + ROUNDED_M)
}

fn size(rim: &Rim) -> String {
    match halves(rim) {
        [radius, _] if rim.is_disc() => format!("{} m", number(radius)),
        [length, width] => format!("{} x {} m", number(2.0 * length), number(2.0 * width)),
    }
}

fn said(rim: &Rim) -> String {
    let what = if rim.is_disc() { "the radius of the body" } else { "the body" };
    format!("{what} is {}", size(rim))
}

/// A robot that is heard by lines of JSON.
pub struct Remote {
    /// `None` once it is not heard any more.
    link: Option<Link>,
    /// Its shapes by name, in the order in which Adit numbers them.
    shapes: Vec<(String, Rim)>,
    /// The one in which it was when it was last heard, by number.
    shape: usize,
    directions: usize,
    range_m: Option<f64>,
    terms: Option<Terms>,
    time_s: Option<f64>,
    silence: Option<Silence>,
}

impl Remote {
    /// Greets a robot.
    ///
    /// # Returns
    /// Always one: where the link did not come about, or it cannot be driven, it is silent from the beginning.
    pub fn greet(link: Result<Link, String>, used: &[Used]) -> Self {
        let shapes = used.iter().map(|used| (used.name.clone().unwrap_or_default(), used.rim)).collect();
        let mut remote = Self {
            link: None,
            shapes,
            shape: 0,
            directions: 1,
            range_m: None,
            terms: None,
            time_s: None,
            silence: None,
        };
        match link {
            Ok(link) => {
                remote.link = Some(link);
                if let Err(why) = remote.meet(used) {
                    remote.fall_silent(why);
                }
            }
            Err(why) => remote.fall_silent(why),
        }
        remote
    }

    /// The shape in which it is, by number.
    pub fn shape(&self) -> usize {
        self.shape
    }

    /// How far away it measures something, if it said so.
    pub fn range_m(&self) -> Option<f64> {
        self.range_m
    }

    /// Why it is not heard any more, if it is not.
    pub fn silence(&self) -> Option<&str> {
        self.silence.as_ref().map(|silence| silence.0.as_str())
    }

    /// Takes leave: it stops, and ends.
    pub fn bye(mut self) {
        if let Some(mut link) = self.link.take() {
            // what it answers changes nothing any more
            link.ask(&Order::Bye {}).ok();
        }
    }

    fn meet(&mut self, used: &[Used]) -> Result<(), String> {
        let named = used.iter().filter_map(|used| used.name.clone()).collect();
        let profile = match self.ask(&Order::Hello { protocol: PROTOCOL, shapes: named })? {
            Answer::Hello(profile) => profile,
            other => return Err(unexpected("hello", "hello", &other)),
        };
        let terms = Terms::of(profile).map_err(|why| self.in_line(&why))?;
        let profile = &terms.profile;
        let own = |used: &Used| {
            let name = used.name.as_ref().unwrap_or(&profile.shape);
            let own = profile.shapes.iter().find(|outline| outline.name == *name).ok_or_else(|| {
                format!("the body has no shape `{name}`, which Adit uses; it has {}", names(profile))
            })?;
            let rim = own.rim();
            if !does_fit(&rim, &used.rim) {
                return Err(format!(
                    "{} in the shape `{name}`, and ways are found for {}: it would touch what they pass",
                    said(&rim),
                    size(&used.rim)
                ));
            }
            Ok((own.name.clone(), rim))
        };
        self.shapes = used.iter().map(own).collect::<Result<_, _>>()?;
        self.directions = profile.directions as usize;
        self.range_m = Some(profile.range_m);
        self.shape = self.number(&profile.shape).map_err(|why| self.in_line(&why))?;
        self.terms = Some(terms);
        Ok(())
    }

    /// The number of a shape.
    fn number(&self, name: &str) -> Result<usize, String> {
        self.shapes.iter().position(|(known, _)| known == name).ok_or_else(|| {
            let known: Vec<&str> = self.shapes.iter().map(|(name, _)| name.as_str()).collect();
            format!("the body is in the shape `{name}`, expected one that Adit uses: {}", known.join(", "))
        })
    }

    fn ask(&mut self, order: &Order) -> Result<Answer, String> {
        let link = self.link.as_mut().ok_or("the body is not heard any more")?;
        match link.ask(order).map_err(|ends| ends.why().to_owned())? {
            Answer::Refused { why } => Err(format!("the body refused `{}`: {why}", order.word())),
            answer => Ok(answer),
        }
    }

    fn hear(&mut self) -> Result<Sensed, String> {
        let senses = match self.ask(&Order::Sense {})? {
            Answer::Sensed(senses) => senses,
            other => return Err(unexpected("sense", "sensed", &other)),
        };
        let wrong = self.terms.iter().flat_map(|terms| terms.wrong(&senses, self.time_s)).next();
        if let Some(wrong) = wrong {
            return Err(self.in_line(&format!("what the body sensed cannot be: {}", wrong.why)));
        }
        let Senses { time_s, odometry, readings, contact, is_busy, shape } = senses;
        self.time_s = Some(time_s);
        self.shape = self.number(&shape).map_err(|why| self.in_line(&why))?;
        Ok(Sensed {
            time_s,
            odometry: odometry.into(),
            readings: readings.into_iter().map(Into::into).collect(),
            contact: contact.map(Into::into),
            is_busy,
            shape: self.shape,
        })
    }

    /// What is wrong, with the line in which it was heard.
    fn in_line(&self, why: &str) -> String {
        let line =
            self.link.as_ref().map_or_else(String::new, |link| format!(", in the line {}", link.line()));
        format!("{why}{line}")
    }

    fn obey(&mut self, order: &Order) -> Result<(), String> {
        match self.ask(order)? {
            Answer::Accepted {} => Ok(()),
            other => Err(unexpected(order.word(), "accepted", &other)),
        }
    }

    /// Does not hear it any more. Whatever is wrong, it is told to stop: it may hear, though it speaks no sense.
    fn fall_silent(&mut self, why: String) {
        if let Some(link) = self.link.take() {
            link.leave();
        }
        self.silence.get_or_insert(Silence(why));
    }
}

fn unexpected(asked: &str, expected: &str, found: &Answer) -> String {
    format!("the body answered `{asked}` with `{}`, expected `{expected}`", found.word())
}

impl Body for Remote {
    fn rim(&self) -> Rim {
        self.shapes[self.shape].1
    }

    fn directions(&self) -> usize {
        self.directions
    }

    fn command(&mut self, command: Command) {
        let order = match command {
            Command::Stop => Order::Stop {},
            Command::Turn { by } => Order::Turn { by_rad: by },
            Command::Move { distance_m, bearing, speed_m_s } => {
                Order::Move { distance_m, speed_m_s, bearing_rad: bearing }
            }
            Command::Change { to } => Order::Change { shape: self.shapes[to].0.clone() },
        };
        if self.silence.is_none()
            && let Err(why) = self.obey(&order)
        {
            self.fall_silent(why);
        }
    }

    fn sense(&mut self) -> Result<Sensed, Silence> {
        if self.silence.is_none() {
            match self.hear() {
                Ok(sensed) => return Ok(sensed),
                Err(why) => self.fall_silent(why),
            }
        }
        Err(self.silence.clone().unwrap_or_else(|| Silence(String::new())))
    }
}

impl fmt::Debug for Remote {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Remote")
            .field("shapes", &self.shapes)
            .field("silence", &self.silence)
            .finish_non_exhaustive()
    }
}
