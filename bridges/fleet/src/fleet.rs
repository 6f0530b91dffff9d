//! All vehicles of a site: what is heard goes to the vehicle that it is about, and what follows is done.

mod asked;
mod clock;
mod seen;

use std::collections::{BTreeMap, BTreeSet};
use std::sync::Arc;
use std::sync::atomic::{AtomicU64, Ordering};
use std::time::Duration;

use adit_site::say;
use rumqttc::{AsyncClient, QoS};
use serde_json::{Value, json};
use tokio::sync::mpsc::{UnboundedReceiver, UnboundedSender};
use tokio::task::JoinHandle;

use crate::driver::{Clock, Driver, Effect, World};
use crate::heard::Heard;
use crate::site::{Area, Fleet as Tables, Site, VEHICLES};
use crate::way::{Bridge, Margins};
use crate::wire;

/// How often vehicles are thought of where nothing is heard.
const TICK: Duration = Duration::from_millis(500);

/// How many vehicles that the site does not know, or that speak for others, are named.
const NAMED: usize = 100;

/// What stands in the rows of vehicles when this program was ended.
const LEFT: &str = "nobody drives it: adit fleet was ended";

/// How long the site may take to write that.
const LEAVE: Duration = Duration::from_secs(20);

/// How many edits go to the site as one; it takes a thousand.
const AT_ONCE: usize = 1000;

/// The settings.
pub struct Settings {
    /// The first part of all topics.
    pub interface: String,
    /// How vehicles call the map.
    pub map: String,
    pub margins: Margins,
}

/// What all vehicles have to do with.
struct Known {
    settings: Settings,
    tables: Tables,
    bridges: Vec<Bridge>,
    bounds: Option<[f64; 4]>,
    areas: Vec<Area>,
}

/// The vehicles, and what connects them.
pub struct Fleet {
    site: Site,
    client: AsyncClient,
    heard: UnboundedSender<Heard>,
    known: Known,
    drivers: BTreeMap<String, Driver>,
    follows: BTreeMap<String, asked::Following>,
    /// Who was named that is not in the table, and what was said of messages of others.
    strangers: BTreeSet<String>,
    writers: BTreeMap<String, JoinHandle<()>>,
    seen: seen::Seen,
    /// How many edits were answered.
    answers: Arc<AtomicU64>,
    is_up: bool,
    /// Whether the table of vehicles was read.
    is_read: bool,
    trouble: Option<String>,
    clock: clock::Watch,
}

impl Known {
    /// The same at one moment, as a vehicle thinks of it.
    fn world<'k>(&'k self, clock: &'k Clock) -> World<'k> {
        World {
            fleet: &self.tables,
            margins: &self.settings.margins,
            bridges: &self.bridges,
            areas: &self.areas,
            bounds: self.bounds,
            map: &self.settings.map,
            clock,
        }
    }
}

impl Fleet {
    pub fn new(site: Site, client: AsyncClient, settings: Settings, heard: UnboundedSender<Heard>) -> Self {
        Self {
            site,
            client,
            heard,
            known: Known {
                settings,
                tables: Tables::default(),
                bridges: Vec::new(),
                bounds: None,
                areas: Vec::new(),
            },
            drivers: BTreeMap::new(),
            follows: BTreeMap::new(),
            strangers: BTreeSet::new(),
            writers: BTreeMap::new(),
            seen: seen::Seen::default(),
            answers: Arc::default(),
            is_up: false,
            is_read: false,
            trouble: None,
            clock: clock::Watch::start(),
        }
    }

    /// Runs until it is to end; then says in the table that nobody drives the vehicles any more.
    pub async fn run(mut self, mut hears: UnboundedReceiver<Heard>, end: impl Future<Output = ()>) {
        // until it has left: who speaks and is not listened to any more ends the program
        tokio::select! {
            () = self.hear(&mut hears) => {}
            () = end => {}
        }
        if tokio::time::timeout(LEAVE, self.leave()).await.is_err() {
            say("the site does not answer: its table of vehicles says what they did last");
        }
    }

    /// What is written of the vehicles is not true for long now.
    async fn leave(&mut self) {
        self.follows.clear();
        for (_, writer) in std::mem::take(&mut self.writers) {
            let _ = writer.await;
        }
        let last = [("doing", Value::from(LEFT)), ("connection", Value::Null)];
        let edits: Vec<Value> = (self.drivers.iter())
            .flat_map(|(name, driver)| {
                let written = last.iter().filter(|(column, _)| driver.row.written.contains_key(*column));
                written.map(move |(column, value)| {
                    json!({"kind": "set", "table": VEHICLES, "key": name, "column": column, "value": value})
                })
            })
            .collect();
        for edits in edits.chunks(AT_ONCE) {
            let body = json!({"edit": {"kind": "together", "edits": edits}, "why": LEFT});
            if let Err(trouble) = self.site.post("/api/edits", &body).await {
                say(&format!("rows of vehicles cannot be written: {trouble}"));
            }
        }
        self.seen.leave(&self.site).await;
    }

    async fn hear(&mut self, hears: &mut UnboundedReceiver<Heard>) {
        let _events = asked::Kept(tokio::spawn(asked::events(
            self.site.clone(),
            Arc::clone(&self.answers),
            self.heard.clone(),
        )));
        let heard = self.heard.clone();
        let _ticks = asked::Kept(tokio::spawn(async move {
            while heard.send(Heard::Tick).is_ok() {
                tokio::time::sleep(TICK).await;
            }
        }));
        while let Some(heard) = hears.recv().await {
            let about = self.take(heard);
            let names: Vec<String> = match about {
                About::Nobody => continue,
                About::One(name) => vec![name],
                About::All => self.drivers.keys().cloned().collect(),
            };
            // where there is no broker nothing can be said, and what is decided now would be forgotten
            if self.is_up {
                for name in names {
                    self.think(&name);
                }
            }
        }
    }

    fn take(&mut self, heard: Heard) -> About {
        match heard {
            Heard::Broker(None) => {
                say("the broker is there");
                self.is_up = true;
                self.drivers.values_mut().for_each(Driver::connected);
                return About::All;
            }
            Heard::Broker(Some(why)) => {
                say(&format!("the broker is away: {why}"));
                self.is_up = false;
            }
            Heard::Message(topic, payload) => return self.message(&topic, &payload),
            Heard::Tables(Ok(tables)) => {
                self.trouble = None;
                self.read(tables);
                return About::All;
            }
            Heard::Tables(Err(why)) => {
                if self.trouble.as_ref() != Some(&why) {
                    say(&why);
                    self.trouble = Some(why);
                }
            }
            Heard::Map(bridges, bounds) => (self.known.bridges, self.known.bounds) = (bridges, bounds),
            Heard::Areas(areas) => {
                self.known.areas = areas;
                return About::All;
            }
            Heard::Floor => {
                self.drivers.values_mut().for_each(Driver::doubted);
                return About::All;
            }
            Heard::Route { vehicle, epoch, follower, route } => {
                if let Some(following) = self.follows.get(&vehicle) {
                    following.is_named(epoch, follower);
                }
                if let Some(driver) = self.drivers.get_mut(&vehicle) {
                    driver.routed(epoch, route);
                    return About::One(vehicle);
                }
            }
            Heard::Fresh { vehicle, epoch, route } => {
                if let Some(driver) = self.drivers.get_mut(&vehicle) {
                    driver.answered(epoch, route);
                    return About::One(vehicle);
                }
            }
            Heard::Checked { vehicle, order, update, holds } => {
                if let Some(driver) = self.drivers.get_mut(&vehicle) {
                    driver.checked(&order, update, holds);
                    return About::One(vehicle);
                }
            }
            Heard::Written { vehicle, column, answer } => {
                if let Some(driver) = self.drivers.get_mut(&vehicle) {
                    driver.wrote(column, answer);
                }
            }
            Heard::Cleared { vehicle } => {
                if let Some(driver) = self.drivers.get_mut(&vehicle) {
                    driver.is_written();
                    return About::One(vehicle);
                }
            }
            Heard::Said(words) => say(&words),
            Heard::Tick => {
                self.show();
                return About::All;
            }
        }
        About::Nobody
    }

    /// What a vehicle says, by its topic: `INTERFACE/v2/MANUFACTURER/SERIAL/WHAT`.
    fn message(&mut self, topic: &str, payload: &[u8]) -> About {
        let parts: Vec<&str> = topic.rsplitn(5, '/').collect();
        let [what, serial, manufacturer, version, ..] = parts[..] else { return About::Nobody };
        let known = self
            .drivers
            .values_mut()
            .find(|driver| driver.row.serial == serial && driver.row.manufacturer == manufacturer);
        let Some(driver) = known else {
            // what the broker has kept comes before the table does; it is asked for again for each vehicle of the table
            if !self.is_read {
                return About::Nobody;
            }
            let stranger = format!("{manufacturer}/{serial}");
            if self.strangers.len() < NAMED && self.strangers.insert(stranger.clone()) {
                say(&format!("vehicle {stranger} is on the broker and not in table `{VEHICLES}`"));
            }
            return About::Nobody;
        };
        if let Some(other) = wire::of_another(payload, manufacturer, serial) {
            let words = format!(
                "{}: a message on the topics of {manufacturer}/{serial} says that it is of {other}; what it says is not believed",
                driver.row.name
            );
            if self.strangers.len() < NAMED && self.strangers.insert(words.clone()) {
                say(&words);
            }
            return About::Nobody;
        }
        // a factsheet that the broker has kept may be of before the vehicle spoke another version
        if what != "factsheet" {
            driver.topical(version);
        }
        let read = match what {
            "state" => wire::state(payload).map(|report| driver.reported(report)),
            "connection" => wire::connection(payload)
                .map(|connection| driver.linked(connection.connection_state, &connection.version)),
            "factsheet" => wire::factsheet(payload).map(|factsheet| driver.described(factsheet)),
            _ => return About::Nobody,
        };
        let name = driver.row.name.clone();
        match read {
            Ok(()) => About::One(name),
            Err(why) => {
                say(&format!("{name}: {why}"));
                About::Nobody
            }
        }
    }

    fn read(&mut self, tables: Tables) {
        (self.known.tables, self.is_read) = (tables, true);
        let rows = self.known.tables.vehicles.clone();
        let names: BTreeSet<String> = rows.iter().map(|row| row.name.clone()).collect();
        self.drivers.retain(|name, _| names.contains(name));
        self.follows.retain(|name, _| names.contains(name));
        for row in rows {
            if let Some(driver) = self.drivers.get_mut(&row.name) {
                driver.read(row);
            } else {
                self.strangers.remove(&format!("{}/{}", row.manufacturer, row.serial));
                say(&format!("vehicle {}: {}/{}", row.name, row.manufacturer, row.serial));
                self.drivers.insert(row.name.clone(), Driver::new(row));
                // what it said before is kept by the broker
                let again = ["connection", "factsheet"];
                for topic in again {
                    let all = format!("{}/+/+/+/{topic}", self.known.settings.interface);
                    let _ = self.client.try_subscribe(all, QoS::AtLeastOnce);
                }
            }
        }
    }

    /// Shows people where the vehicles are.
    fn show(&mut self) {
        let clock = self.clock.now();
        let world = self.known.world(&clock);
        let vehicles = self.drivers.iter();
        let vehicles = vehicles.filter_map(|(name, driver)| Some((name.clone(), driver.whereabout(&world)?)));
        self.seen.say(&self.site, vehicles);
    }

    fn think(&mut self, name: &str) {
        let Some(driver) = self.drivers.get_mut(name) else { return };
        let clock = self.clock.now();
        let world = self.known.world(&clock);
        for effect in driver.think(&world) {
            self.does(name, effect);
        }
    }

    fn does(&mut self, name: &str, effect: Effect) {
        let (site, heard, vehicle) = (self.site.clone(), self.heard.clone(), name.to_owned());
        match effect {
            Effect::Say(words) => say(&words),
            Effect::Send { to, topic, message } => {
                let topic = format!(
                    "{}/{}/{}/{}/{topic}",
                    self.known.settings.interface,
                    to.version.of_topic(),
                    to.manufacturer,
                    to.serial
                );
                // what does not go out now is not acknowledged, and goes out again
                if self.client.try_publish(topic, QoS::AtMostOnce, false, message.to_string()).is_err() {
                    say(&format!("{name}: too much is waiting to go to the broker"));
                }
            }
            Effect::Follow { epoch, start, goal, robot } => {
                let asked = asked::Way { vehicle, epoch, goal, robot };
                self.follows.insert(name.to_owned(), asked::Following::begin(site, asked, start, heard));
            }
            Effect::Ask { epoch, start, goal, robot } => {
                let asked = asked::Way { vehicle, epoch, goal, robot };
                tokio::spawn(asked::once(site, asked, start, heard));
            }
            Effect::Moved { at } => {
                if let Some(following) = self.follows.get(name) {
                    following.goes_on(at);
                }
            }
            Effect::Unfollow => {
                self.follows.remove(name);
            }
            Effect::Check { order, update, from, to, metres, doorways, robot } => {
                let along = asked::Along { from, to, metres, doorways, robot };
                tokio::spawn(async move {
                    if let Some(holds) = asked::holds(&site, &along).await {
                        let _ = heard.send(Heard::Checked { vehicle, order, update, holds });
                    }
                });
            }
            Effect::Block { at, heading, seconds, only, why } => {
                let mut body =
                    json!({"x": at[0], "y": at[1], "heading": heading, "for_seconds": seconds, "why": why});
                if let Some(only) = only {
                    body["only"] = json!([only]);
                }
                tokio::spawn(async move {
                    let words = match site.post("/api/blocked", &body).await {
                        Ok(_) => format!("{why}: the way ahead is closed for {seconds} s"),
                        Err(trouble) => format!("{why}: the way ahead cannot be closed: {trouble}"),
                    };
                    let _ = heard.send(Heard::Said(words));
                });
            }
            Effect::Write { column, value } => {
                self.write(name, &json!({"column": column, "value": value}), move |answer, _| {
                    Some(Heard::Written { vehicle, column, answer })
                });
            }
            Effect::Arrived { goal } => {
                say(&format!("{name} is at {goal}"));
                let cell = json!({"column": "goal", "value": Value::Null, "old": goal});
                self.write(name, &cell, |_, is_done| is_done.then_some(Heard::Cleared { vehicle }));
            }
        }
    }

    /// One edit of the vehicle's row after the other; `then` is given the number of its answer, and whether it was done.
    fn write(
        &mut self,
        name: &str,
        cell: &Value,
        then: impl FnOnce(u64, bool) -> Option<Heard> + Send + 'static,
    ) {
        let (site, heard, vehicle) = (self.site.clone(), self.heard.clone(), name.to_owned());
        let mut edit = json!({"kind": "set", "table": VEHICLES, "key": name});
        if let (Some(edit), Some(cell)) = (edit.as_object_mut(), cell.as_object()) {
            edit.extend(cell.clone());
        }
        let body = json!({"edit": edit, "why": asked::SAID});
        let answers = Arc::clone(&self.answers);
        let before = self.writers.remove(name);
        let task = tokio::spawn(async move {
            if let Some(before) = before {
                let _ = before.await;
            }
            let done = site.post("/api/edits", &body).await;
            let answer = answers.fetch_add(1, Ordering::SeqCst) + 1;
            if let Err(trouble) = &done {
                let words = format!("{vehicle}: its row cannot be written: {trouble}");
                let _ = heard.send(Heard::Said(words));
            }
            if let Some(then) = then(answer, done.is_ok()) {
                let _ = heard.send(then);
            }
        });
        self.writers.insert(name.to_owned(), task);
    }
}

/// Which vehicles are to be thought of.
enum About {
    Nobody,
    One(String),
    All,
}
