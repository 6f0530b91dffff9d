//! A robot of ours, as others hear it: it reads orders and writes answers, one line each.

use std::io::{self, BufRead, Write};

use adit_planners::body::{Body, Command};

use super::limits::PROTOCOL;
use super::link::order_line;
use super::message::{Answer, Order, Outline, Profile, Senses, line};
use super::terms::names;

/// A robot, and what it says of itself.
#[derive(Debug)]
pub struct Host<B> {
    pub body: B,
    /// Its shapes in the order of the body's numbers.
    pub shapes: Vec<Outline>,
    /// In which it is, by number.
    pub shape: usize,
    pub range_m: f64,
    pub has_skirt: bool,
    is_greeted: bool,
}

impl<B: Body> Host<B> {
    pub fn new(body: B, (shapes, shape): (Vec<Outline>, usize), (range_m, has_skirt): (f64, bool)) -> Self {
        Self { body, shapes, shape, range_m, has_skirt, is_greeted: false }
    }

    /// Answers until who drives it takes leave or is not heard any more; then it stops. `watch` sees the body after each step.
    pub fn serve(
        &mut self,
        input: &mut impl BufRead,
        output: &mut impl Write,
        mut watch: impl FnMut(&B),
    ) -> io::Result<()> {
        let outcome = self.answer_all(input, output, &mut watch);
        self.body.command(Command::Stop);
        outcome
    }

    fn answer_all(
        &mut self,
        input: &mut impl BufRead,
        output: &mut impl Write,
        watch: &mut impl FnMut(&B),
    ) -> io::Result<()> {
        loop {
            let (answer, is_last) = match order_line(input) {
                Ok(None) => return Ok(()),
                Ok(Some(text)) => match Order::of_line(&text) {
                    Ok(order) => (self.answer(&order), order == Order::Bye {}),
                    Err(why) => (Answer::Refused { why }, false),
                },
                Err(why) => (Answer::Refused { why }, true),
            };
            output.write_all(line(&answer).as_bytes())?;
            output.flush()?;
            if is_last {
                return Ok(());
            }
            if let Answer::Sensed(_) = answer {
                watch(&self.body);
            }
        }
    }

    fn answer(&mut self, order: &Order) -> Answer {
        self.answered(order).unwrap_or_else(|why| Answer::Refused { why })
    }

    fn answered(&mut self, order: &Order) -> Result<Answer, String> {
        let command = match order {
            Order::Hello { protocol, shapes } => return self.greeted(*protocol, shapes).map(Answer::Hello),
            Order::Bye {} => return Ok(Answer::Bye {}),
            _ if !self.is_greeted => {
                return Err(format!("`{}` comes before `hello`, expected `hello` first", order.word()));
            }
            Order::Sense {} => return self.sensed(),
            Order::Stop {} => Command::Stop,
            Order::Turn { by_rad } => Command::Turn { by: *by_rad },
            Order::Move { distance_m, speed_m_s, bearing_rad } if *speed_m_s > 0.0 => {
                self.moved(*distance_m, *speed_m_s, *bearing_rad)?
            }
            Order::Move { speed_m_s, .. } => {
                return Err(format!("`speed_m_s` is {speed_m_s}, expected more than 0"));
            }
            Order::Change { shape } => Command::Change { to: self.number(shape)? },
        };
        self.body.command(command);
        Ok(Answer::Accepted {})
    }

    /// Whoever is round goes where it looks.
    fn moved(&self, distance_m: f64, speed_m_s: f64, bearing: f64) -> Result<Command, String> {
        let outline = &self.shapes[self.shape];
        if outline.length_m.is_none() && bearing != 0.0 {
            return Err(format!(
                "`bearing_rad` is {bearing}, expected 0: the shape `{}` is round",
                outline.name
            ));
        }
        Ok(Command::Move { distance_m, bearing, speed_m_s })
    }

    fn greeted(&mut self, protocol: u32, uses: &[String]) -> Result<Profile, String> {
        if self.is_greeted {
            return Err("`hello` was said already".to_owned());
        }
        if protocol != PROTOCOL {
            return Err(format!("this body speaks protocol {PROTOCOL}, found {protocol}"));
        }
        for name in uses {
            self.number(name)?;
        }
        self.is_greeted = true;
        Ok(self.profile())
    }

    fn profile(&self) -> Profile {
        Profile {
            protocol: PROTOCOL,
            shapes: self.shapes.clone(),
            shape: self.shapes[self.shape].name.clone(),
            directions: self.body.directions() as u32,
            range_m: self.range_m,
            has_skirt: self.has_skirt,
        }
    }

    fn sensed(&mut self) -> Result<Answer, String> {
        let sensed = self.body.sense().map_err(|silence| silence.0)?;
        self.shape = sensed.shape;
        Ok(Answer::Sensed(Senses {
            time_s: sensed.time_s,
            odometry: sensed.odometry.into(),
            readings: sensed.readings.into_iter().map(Into::into).collect(),
            contact: sensed.contact.map(Into::into),
            is_busy: sensed.is_busy,
            shape: self.shapes[sensed.shape].name.clone(),
        }))
    }

    fn number(&self, name: &str) -> Result<usize, String> {
        self.shapes
            .iter()
            .position(|outline| outline.name == name)
            .ok_or_else(|| format!("this body has no shape `{name}`; it has {}", names(&self.profile())))
    }
}
