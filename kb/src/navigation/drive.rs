//! Orders of a user who drives a robot by hand, as a text: one a line.
//!
//! ```text
//! start 1.5,1.5 90      # a place or x,y; degrees
//! forward 2             # metres; `back 0.5`
//! turn -90              # degrees, counter-clockwise above 0
//! look                  # all around
//! place desk            # the rest of the line is the name
//! go desk               # by itself: a place or x,y
//! ```

use std::ops::Range;

use adit_planners::geometry::Point;
use adit_planners::navigation::Order;
use adit_planners::pose::Pose;
use adit_planners::read::{Code, Problem, Text};

use super::floor::Floor;
use crate::error::{Error, Result};

/// The words that a line begins with.
const WORDS: &str = "start, forward, back, turn, look, place, go";
/// No way is longer, metres, and no turn larger, degrees.
const FARTHEST_M: f64 = 1000.0;
const LARGEST_TURN: f64 = 3600.0;

/// Where a drive begins, and what the robot is told.
#[derive(Clone, Debug, PartialEq)]
pub struct Script {
    pub start: Pose,
    pub orders: Vec<Order>,
    /// The line of each order, from 1.
    pub lines: Vec<usize>,
}

/// Reads orders; places are those of what was learned, of the plan beneath it, and those that were named before.
///
/// # Returns
/// All lines that are wrong, each with what was expected.
pub fn parse(name: &str, text: &str, floors: [&Floor; 2]) -> Result<Script> {
    let mut reader = Reader { text: Text::new(name, text), floors, named: Vec::new(), problems: Vec::new() };
    let (mut start, mut orders, mut lines) = (None, Vec::new(), Vec::new());
    let mut from = 0;
    for (number, line) in (1..).zip(text.split('\n')) {
        let until = from + line.len();
        let told = line.split('#').next().unwrap_or_default();
        let begin = from + told.len() - told.trim_start().len();
        let (words, span) = (told.trim(), begin..begin + told.trim().len());
        from = until + 1;
        if words.is_empty() {
            continue;
        }
        let (word, rest) = words.split_once(char::is_whitespace).unwrap_or((words, ""));
        let rest = rest.trim();
        match (word, start) {
            ("start", None) => start = reader.start(rest, &span).or(Some(Pose::default())),
            ("start", Some(_)) => {
                reader.wrong(&span, "`start` stands in the first line, and once".to_owned());
            }
            (_, None) => {
                reader.wrong(&span, format!("found `{words}`, expected `start` with a place or x,y first"));
                start = Some(Pose::default());
            }
            _ => {
                if let Some(order) = reader.order(word, rest, &span) {
                    orders.push(order);
                    lines.push(number);
                }
            }
        }
    }
    if start.is_none() {
        reader.wrong(&(0..0), "found no order, expected `start` with a place or x,y".to_owned());
    }
    match start {
        Some(start) if reader.problems.is_empty() => Ok(Script { start, orders, lines }),
        _ => Err(Error::all(reader.problems)),
    }
}

struct Reader<'f> {
    text: Text,
    /// What was learned, and the plan.
    floors: [&'f Floor; 2],
    /// Places that were named by orders before; where, only the drive will tell.
    named: Vec<String>,
    problems: Vec<Problem>,
}

impl Reader<'_> {
    /// A place, as the robot knows it rather than as the plan has it, or `x,y`.
    fn point(&self, text: &str) -> Option<Point> {
        self.floors.iter().find_map(|floor| floor.point(text).ok())
    }

    fn wrong(&mut self, span: &Range<usize>, message: String) {
        self.problems.push(self.text.problem(Code::Syntax, span, message));
    }

    fn start(&mut self, rest: &str, span: &Range<usize>) -> Option<Pose> {
        let point = self.point(rest).map(|at| (at, 0.0));
        let with_heading = || {
            let (place, degrees) = rest.rsplit_once(char::is_whitespace)?;
            let degrees: f64 = degrees.parse().ok().filter(|degrees: &f64| degrees.abs() <= LARGEST_TURN)?;
            Some((self.point(place.trim())?, degrees))
        };
        let found = point.or_else(with_heading);
        if found.is_none() {
            let expected = format!("expected {} or x,y, and degrees if need be", self.place());
            self.wrong(span, format!("found `{rest}`, {expected}"));
        }
        found.map(|(at, degrees)| Pose { at, heading: degrees.to_radians() })
    }

    fn order(&mut self, word: &str, rest: &str, span: &Range<usize>) -> Option<Order> {
        match word {
            "forward" => self.number(rest, "metres", FARTHEST_M, span).map(Order::Forward),
            "back" => self.number(rest, "metres", FARTHEST_M, span).map(|metres| Order::Forward(-metres)),
            "turn" => self
                .number(rest, "degrees", LARGEST_TURN, span)
                .map(|degrees| Order::Turn(degrees.to_radians())),
            "look" if rest.is_empty() => Some(Order::Look),
            "look" => {
                self.wrong(span, format!("found `{rest}` after `look`, expected nothing"));
                None
            }
            "place" if rest.is_empty() => {
                self.wrong(span, "found no name, expected one after `place`".to_owned());
                None
            }
            "place" => {
                self.named.push(rest.to_owned());
                Some(Order::Name(rest.to_owned()))
            }
            "go" => self.goal(rest, span).map(Order::Go),
            other => {
                self.wrong(span, format!("found `{other}`, expected one of {WORDS}"));
                None
            }
        }
    }

    fn number(&mut self, rest: &str, unit: &str, most: f64, span: &Range<usize>) -> Option<f64> {
        let number = rest.parse().ok().filter(|number: &f64| number.abs() <= most);
        if number.is_none() {
            self.wrong(span, format!("found `{rest}`, expected {unit}: a number up to {most}"));
        }
        number
    }

    /// What a place may be, as it goes on from `expected`.
    fn place(&self) -> String {
        let mut names: Vec<&str> = self.floors.iter().flat_map(|floor| floor.names()).collect();
        names.sort_unstable();
        names.dedup();
        match names.as_slice() {
            [] => "a point (the plan has no place)".to_owned(),
            names => format!("a place ({})", names.join(", ")),
        }
    }

    fn goal(&mut self, rest: &str, span: &Range<usize>) -> Option<Point> {
        let found = self.point(rest);
        if found.is_none() {
            let message = if self.named.iter().any(|name| name == rest) {
                format!("`{rest}` is named in this drive; where it is is known to the next one")
            } else {
                format!("found `{rest}`, expected {} or x,y", self.place())
            };
            self.wrong(span, message);
        }
        found
    }
}
