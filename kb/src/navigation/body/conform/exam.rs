//! A body under examination: what is asked of it, and what holds of everything that it answers.

use std::collections::BTreeMap;
use std::time::{Duration, Instant};

use adit_planners::pose::{Pose, wrapped};

use crate::navigation::body::link::{Ends, Link};
use crate::navigation::body::message::{Answer, Order, Outline, Profile, Senses};
use crate::navigation::body::terms::{About, Terms};

/// The link is over: nothing more can be asked.
#[derive(Debug)]
pub struct Over;

/// Odometry is rounded by so much, metres and radians.
const ROUNDED: f64 = 0.02;

/// It is sensed no oftener than so many times for one thing to end, whatever the body's clock says.
const MOST_SENSES: usize = 4_000;

/// How long a turn or a short move may take, seconds by the body's clock.
pub const PATIENCE_S: f64 = 30.0;

/// What came of a command.
#[derive(Debug)]
pub struct Done {
    /// Why it was not taken.
    pub refused: Option<String>,
    /// What odometry said before, and once it was done and the body at rest.
    pub from: Pose,
    pub to: Pose,
    /// Until it was idle, by the body's clock.
    pub seconds: f64,
    /// What was sensed until it was idle.
    pub senses: Vec<Senses>,
}

impl Done {
    /// The way it went, as seen from where it began.
    pub fn way(&self) -> Pose {
        self.from.to(&self.to)
    }
}

/// A body that is examined.
pub struct Exam {
    link: Option<Link>,
    terms: Option<Terms>,
    last: Option<Senses>,
    answers: usize,
    slowest: Duration,
    readings: usize,
    /// What was found, by check.
    found: BTreeMap<&'static str, (Option<bool>, String)>,
}

impl Exam {
    pub fn new(link: Link) -> Self {
        Self {
            link: Some(link),
            terms: None,
            last: None,
            answers: 0,
            slowest: Duration::ZERO,
            readings: 0,
            found: BTreeMap::new(),
        }
    }

    pub fn found(&self, check: &str) -> Option<(Option<bool>, String)> {
        self.found.get(check).cloned()
    }

    /// Keeps what came of a check.
    pub fn say(&mut self, check: &'static str, held: impl Into<Option<bool>>, seen: impl Into<String>) {
        self.found.insert(check, (held.into(), seen.into()));
    }

    /// Keeps that a check does not hold, the first time that it is seen.
    pub fn fault(&mut self, check: &'static str, seen: impl Into<String>) {
        self.found.entry(check).or_insert_with(|| (Some(false), seen.into()));
    }

    /// What holds of everything that was answered, where nothing spoke against it.
    pub fn take_stock(&mut self) {
        let (answers, slowest) = (self.answers, self.slowest.as_secs_f64() * 1e3);
        let mut all = vec![("answers", format!("{answers} answers, the slowest after {slowest:.1} ms"))];
        if let Some(last) = &self.last {
            all.push(("time", format!("it grew to {:.2} s", last.time_s)));
            all.push(("angles", "all within a turn".to_owned()));
            all.push(("ranges", format!("{} readings", self.readings)));
            all.push(("readings", format!("{} readings", self.readings)));
            all.push(("busy", "with each command".to_owned()));
        }
        for (check, seen) in all {
            self.found.entry(check).or_insert((Some(true), seen));
        }
    }

    pub fn agree(&mut self, terms: Terms) {
        self.terms = Some(terms);
    }

    /// What the body said of itself.
    pub fn profile(&self) -> Result<&Profile, Over> {
        self.terms.as_ref().map(|terms| &terms.profile).ok_or(Over)
    }

    /// The shape in which it is.
    pub fn outline(&self) -> Result<&Outline, Over> {
        let profile = self.profile()?;
        let now = self.last.as_ref().map_or(&profile.shape, |last| &last.shape);
        profile.shapes.iter().find(|outline| outline.name == *now).ok_or(Over)
    }

    pub fn ask(&mut self, order: &Order) -> Result<Answer, Over> {
        self.heard(|link| link.ask(order))
    }

    pub fn ask_line(&mut self, text: &str) -> Result<Answer, Over> {
        self.heard(|link| link.ask_line(&format!("{text}\n"), text))
    }

    fn heard(&mut self, ask: impl FnOnce(&mut Link) -> Result<Answer, Ends>) -> Result<Answer, Over> {
        let before = Instant::now();
        let heard = ask(self.link.as_mut().ok_or(Over)?);
        self.slowest = self.slowest.max(before.elapsed());
        match heard {
            Ok(answer) => {
                self.answers += 1;
                Ok(answer)
            }
            Err(ends) => {
                self.fault("answers", ends.why());
                if let Some(link) = self.link.take() {
                    link.leave();
                }
                Err(Over)
            }
        }
    }

    /// The link, to be ended.
    pub fn take_link(&mut self) -> Result<Link, Over> {
        self.link.take().ok_or(Over)
    }

    /// Gives a command; says why it was not taken, if so.
    pub fn obey(&mut self, order: &Order) -> Result<Result<(), String>, Over> {
        Ok(match self.ask(order)? {
            Answer::Accepted {} => Ok(()),
            Answer::Refused { why } => Err(format!("`{}` was refused: {why}", order.word())),
            other => {
                let said =
                    format!("`{}` was answered with `{}`, expected `accepted`", order.word(), other.word());
                self.fault("answers", said.clone());
                Err(said)
            }
        })
    }

    pub fn sense(&mut self) -> Result<Senses, Over> {
        let senses = match self.ask(&Order::Sense {})? {
            Answer::Sensed(senses) => senses,
            other => {
                self.fault(
                    "answers",
                    format!("`sense` was answered with `{}`, expected `sensed`", other.word()),
                );
                return Err(Over);
            }
        };
        self.readings += senses.readings.len();
        let before_s = self.last.as_ref().map(|last| last.time_s);
        let wrong = self.terms.as_ref().map(|terms| terms.wrong(&senses, before_s)).unwrap_or_default();
        for wrong in wrong {
            self.fault(check_of(wrong.about), wrong.why);
        }
        if let Some(last) = &self.last
            && let Some(seen) = astray(last, &senses)
        {
            self.fault("readings", seen);
        }
        self.last = Some(senses.clone());
        Ok(senses)
    }

    /// Where odometry puts it now.
    pub fn pose(&mut self) -> Result<Pose, Over> {
        match &self.last {
            Some(last) => Ok(last.odometry.into()),
            None => Ok(self.sense()?.odometry.into()),
        }
    }

    fn time_s(&self) -> f64 {
        self.last.as_ref().map_or(0.0, |last| last.time_s)
    }

    /// Gives a command and senses until it is done; stops the body where it never is.
    pub fn done(&mut self, order: &Order, most_s: f64) -> Result<Done, Over> {
        let (from, begun_s) = (self.pose()?, self.time_s());
        let refused = self.obey(order)?.err();
        let mut senses = Vec::new();
        if refused.is_none() {
            senses = self.until(|senses| !senses.is_busy, most_s)?;
        }
        let seconds = self.time_s() - begun_s;
        if senses.last().is_some_and(|last| last.is_busy) {
            self.fault("busy", format!("`{}` was not done after {seconds:.1} s", order.word()));
            self.obey(&Order::Stop {})?.ok();
            self.sense()?;
        }
        let idle = self.pose()?;
        self.sense()?;
        let to = Pose::from(self.sense()?.odometry);
        if idle.at.distance(to.at) > ROUNDED {
            let far = idle.at.distance(to.at);
            self.fault(
                "busy",
                format!("it went on by {far:.2} m after it was idle again, after `{}`", order.word()),
            );
        }
        Ok(Done { refused, from, to, seconds, senses })
    }

    /// Senses until something is so, or for so long.
    pub fn until(&mut self, is_so: impl Fn(&Senses) -> bool, most_s: f64) -> Result<Vec<Senses>, Over> {
        let begun_s = self.time_s();
        let mut all = Vec::new();
        loop {
            let senses = self.sense()?;
            let is_over = is_so(&senses) || senses.time_s - begun_s > most_s;
            all.push(senses);
            if is_over || all.len() >= MOST_SENSES {
                return Ok(all);
            }
        }
    }
}

/// The check that is about it.
const fn check_of(about: About) -> &'static str {
    match about {
        About::Time => "time",
        About::Angle => "angles",
        About::Range => "ranges",
        About::Number => "readings",
        About::Contact => "contact",
        About::Shape => "change",
        About::Place => "rest",
    }
}

/// Says of a reading that it was not taken between where the body was and where it is.
fn astray(before: &Senses, now: &Senses) -> Option<String> {
    let (from, to) = (Pose::from(before.odometry), Pose::from(now.odometry));
    let far = |a: &Pose, b: &Pose| (a.at.distance(b.at), wrapped(b.heading - a.heading).abs());
    let (way, turn) = far(&from, &to);
    now.readings.iter().find_map(|echo| {
        let at = Pose::from(echo.odometry);
        let ((come, come_by), (go, go_by)) = (far(&from, &at), far(&at, &to));
        let is_between = come + go <= way + ROUNDED && come_by + go_by <= turn + ROUNDED;
        let told = |pose: &Pose| format!("{:.2}, {:.2}, {:.2} rad", pose.at.x, pose.at.y, pose.heading);
        (!is_between).then(|| {
            format!("a reading carries {}, the body went from {} to {}", told(&at), told(&from), told(&to))
        })
    })
}
