//! One vehicle: what is known of it, and what follows. Nothing here waits or sends: what is to be done is said as effects.
//! In a circle with the files beside it, which are parts of what follows.

mod cells;
mod effect;
mod held;
mod orders;
mod stopping;
mod telling;
mod words;
mod zones;

use std::collections::BTreeSet;

use cells::Cells;
pub use effect::{Clock, Effect};
pub use telling::Whereabout;

use crate::given::Given;
use crate::site::{Area, Fleet, Route, Vehicle};
use crate::way::{Bridge, Margins};
use crate::wire::{Addressee, Factsheet, Link, Report, Version};

/// Seconds after which what was not acknowledged is said again.
const AGAIN: f64 = 3.0;

/// A vehicle, the order that it has, and the way that it is to go.
pub struct Driver {
    pub row: Vehicle,
    link: Option<Link>,
    /// The version that it says, and that of its topics.
    speaks: Option<String>,
    topic: Option<String>,
    report: Option<Report>,
    factsheet: Option<Factsheet>,
    given: Option<Sent>,
    follows: Option<Follows>,
    /// The newest route that is not in the order.
    route: Option<Route>,
    /// Since when it is asked whether more may be released, and the answer.
    asks: Option<f64>,
    fresh: Option<Route>,
    cancels: Option<Cancel>,
    /// Until when no order is tried.
    waits: f64,
    /// The goal that was reached, until the table is without it.
    reached: Option<String>,
    /// The goal at which it is.
    at: Option<String>,
    /// Whether what is released is no way any more.
    is_broken: bool,
    checks: bool,
    /// Errors on which something was done.
    acted: BTreeSet<String>,
    cells: Cells,
    /// What it does, in words.
    doing: String,
    /// What is wrong with what it says, and was said in the log.
    said: BTreeSet<About>,
    /// The zones that it was told, and what could not be told.
    zones: Option<(String, Vec<String>)>,
    heads: [u32; 3],
    epoch: u64,
    orders: u32,
}

/// An order on its way, or acknowledged.
struct Sent {
    order: Given,
    /// The stop that the vehicle has reached.
    reached: usize,
    at: f64,
    tries: u32,
    is_known: bool,
}

/// What is asked of the site.
struct Follows {
    goal: String,
    start: [f64; 2],
}

/// A cancelling on its way.
struct Cancel {
    action: String,
    at: f64,
    why: String,
    reports: u32,
}

impl Driver {
    pub fn new(row: Vehicle) -> Self {
        Self {
            cells: Cells::new(row.written.clone()),
            doing: String::new(),
            row,
            link: None,
            speaks: None,
            topic: None,
            report: None,
            factsheet: None,
            given: None,
            follows: None,
            route: None,
            asks: None,
            fresh: None,
            cancels: None,
            waits: 0.0,
            reached: None,
            at: None,
            is_broken: false,
            checks: false,
            acted: BTreeSet::new(),
            said: BTreeSet::new(),
            zones: None,
            heads: [0; 3],
            epoch: 0,
            orders: 0,
        }
    }

    /// Its row of the table is another one.
    pub fn read(&mut self, row: Vehicle) {
        if self.reached.is_some() && self.reached != row.goal {
            self.reached = None;
        }
        self.cells.read(row.written.clone(), row.answers);
        if row.robot != self.row.robot {
            self.follows = None;
        }
        self.row = row;
    }

    /// An edit of its row was answered, as the answer of this number.
    pub fn wrote(&mut self, column: &str, answer: u64) {
        self.cells.wrote(column, answer);
    }

    /// The table is without the goal that was reached.
    pub fn is_written(&mut self) {
        self.reached = None;
        self.row.goal = None;
    }

    pub fn linked(&mut self, link: Link, version: &str) {
        self.link = Some(link);
        self.spoken(version);
    }

    pub fn reported(&mut self, report: Report) {
        self.spoken(&report.version);
        if let Some(cancel) = &mut self.cancels {
            cancel.reports += 1;
        }
        // who speaks is there again, also where it does not say so
        self.link = self.link.map(|link| if link == Link::ConnectionBroken { Link::Online } else { link });
        self.report = Some(report);
    }

    pub fn described(&mut self, factsheet: Factsheet) {
        self.factsheet = Some(factsheet);
    }

    /// It says something on topics of this version: `v2`.
    pub fn topical(&mut self, version: &str) {
        self.topic = Some(version.to_owned());
    }

    fn spoken(&mut self, version: &str) {
        if !version.is_empty() || self.speaks.is_none() {
            self.speaks = Some(version.to_owned());
        }
    }

    /// By which version it is spoken to; a sentence where there is none that it would hear.
    fn version(&self) -> Result<Version, String> {
        let said = self.speaks.clone().unwrap_or_default();
        let told = self.row.version.as_deref().and_then(Version::read);
        let Some(version) = told.or_else(|| Version::read(&said)) else {
            let known = Version::ALL.map(|version| version.to_string()).join(", ");
            return Err(if said.is_empty() {
                format!(
                    "does not say which version of VDA 5050 it speaks; say it in a column `version` ({known})"
                )
            } else {
                format!("speaks {said}, which this program does not ({known})")
            });
        };
        let topic = self.topic.as_deref().filter(|topic| *topic != version.of_topic());
        topic.map_or(Ok(version), |topic| {
            Err(format!(
                "speaks {version} on topics of {topic}; orders would go to those of {}",
                version.of_topic()
            ))
        })
    }

    /// Another route is the best from where it was asked for.
    pub fn routed(&mut self, epoch: u64, route: Route) {
        if epoch == self.epoch && self.follows.is_some() {
            self.route = Some(route);
        }
    }

    /// The best way from where the base ends, as it is now.
    pub fn answered(&mut self, epoch: u64, route: Route) {
        if epoch == self.epoch && self.asks.is_some() {
            self.fresh = Some(route);
        }
    }

    /// Something about the floor is another one: what is released is looked at again.
    pub fn doubted(&mut self) {
        self.checks = true;
    }

    /// What was released of this order is still a way, or is none any more.
    pub fn checked(&mut self, order: &str, update: u32, holds: bool) {
        let is_it =
            self.given.as_ref().is_some_and(|sent| sent.order.id == order && sent.order.update == update);
        if is_it && !holds {
            self.is_broken = true;
        }
    }

    /// The broker was away: what was not acknowledged is said again at once.
    pub fn connected(&mut self) {
        self.zones = None;
        for at in
            self.given.iter_mut().map(|sent| &mut sent.at).chain(self.cancels.iter_mut().map(|c| &mut c.at))
        {
            *at = f64::NEG_INFINITY;
        }
    }

    /// What now follows.
    pub fn think(&mut self, world: &World<'_>) -> Vec<Effect> {
        let mut effects = Vec::new();
        let words = self.decide(world, &mut effects);
        self.tell(words, &mut effects);
        effects
    }

    /// What the vehicle does, in words; effects beside.
    fn decide(&mut self, world: &World<'_>, effects: &mut Vec<Effect>) -> String {
        if self.link.is_some_and(|link| link != Link::Online) {
            return self.link.map(Link::word).unwrap_or_default().to_owned();
        }
        let Some(report) = self.report.clone() else { return "not heard of".to_owned() };
        let version = match self.version() {
            Ok(version) => version,
            Err(words) => {
                self.remark(About::Version, Some(words.clone()), effects);
                return words;
            }
        };
        self.remark(About::Version, None, effects);
        let to = Addressee {
            version,
            manufacturer: self.row.manufacturer.clone(),
            serial: self.row.serial.clone(),
        };
        let (robot, map) = (self.robot(world), self.map(world));
        let off = held::off_the_map(&report, &map, world.bounds);
        let at = report.position.as_ref();
        let lost = at
            .filter(|_| off.is_some())
            .map(|at| format!("says that it is at {:.2},{:.2}, off the map", at.x, at.y));
        self.remark(About::Place, lost, effects);
        let is_placed = off.is_none() && at.is_none_or(|at| at.localized);
        let held = off.or_else(|| held::why(&report, self.factsheet.as_ref(), (&robot, &map), world.fleet));
        let now = Now { report: &report, held: held.as_deref(), is_placed, to: &to, world };
        self.act_on_errors(&now, effects);
        self.tell_zones(&now, effects);
        if self.is_cancelling(&now, effects) {
            let why = self.cancels.as_ref().map(|cancel| cancel.why.clone());
            return format!("stops: {}", why.unwrap_or_default());
        }
        let goal = self.row.goal.clone().filter(|goal| self.reached.as_ref() != Some(goal));
        let Some(goal) = goal else {
            self.unfollow(effects);
            let is_done = self.given.as_ref().is_none_or(|sent| sent.is_known && !report.is_busy());
            if is_done {
                self.given = None;
                return self.at.as_ref().map(|goal| format!("at {goal}")).unwrap_or_default();
            }
            return self.cancel("it has no goal any more", &now, effects);
        };
        self.at = None;
        match self.given.take() {
            Some(sent) => self.drive(sent, &goal, &now, effects),
            None => self.begin(&goal, &now, effects),
        }
    }

    /// Says in the log what is wrong with what it says, once as long as it is so.
    fn remark(&mut self, about: About, words: Option<String>, effects: &mut Vec<Effect>) {
        let Some(words) = words else {
            self.said.remove(&about);
            return;
        };
        if self.said.insert(about) {
            effects.push(Effect::Say(format!("{} {words}", self.row.name)));
        }
    }

    /// Whose routes it drives.
    fn robot(&self, world: &World<'_>) -> String {
        self.row.robot.clone().unwrap_or_else(|| world.fleet.only_robot())
    }

    /// How it calls the map.
    fn map(&self, world: &World<'_>) -> String {
        self.row.map.clone().unwrap_or_else(|| world.map.to_owned())
    }
}

/// What may be wrong with what a vehicle says.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
enum About {
    Battery,
    Node,
    Place,
    Version,
}

/// A vehicle at one moment.
struct Now<'a, 'w> {
    report: &'a Report,
    /// Why nothing is sent to it but a stop.
    held: Option<&'a str>,
    /// Whether where it says that it is says where it is.
    is_placed: bool,
    to: &'a Addressee,
    world: &'a World<'w>,
}

/// What is known beside the vehicle.
pub struct World<'a> {
    pub fleet: &'a Fleet,
    pub margins: &'a Margins,
    pub bridges: &'a [Bridge],
    pub areas: &'a [Area],
    /// How far the map goes: x0, y0, x1, y1, metres; `None` where nobody says.
    pub bounds: Option<[f64; 4]>,
    /// How vehicles call the map, unless their rows say otherwise.
    pub map: &'a str,
    pub clock: &'a Clock,
}
