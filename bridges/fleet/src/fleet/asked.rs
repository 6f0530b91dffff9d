//! What is asked of the site, beside: routes that are followed, events, tables.

use std::sync::atomic::{AtomicU64, Ordering};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use std::time::Duration;

use serde_json::{Value, json};
use tokio::sync::mpsc::UnboundedSender;
use tokio::task::JoinHandle;

use crate::heard::Heard;
use crate::site::{Area, Fleet as Tables, Followed, Route, Site, Trouble, query};
use crate::way::Bridge;

/// How long to wait before a service that is away is asked again.
const PAUSE: Duration = Duration::from_millis(500);

/// Metres by which a vehicle's position may be moved to where its robot fits.
const WITHIN: &str = "0.5";

/// Why rows of vehicles are written.
pub const SAID: &str = "the vehicle says so";

/// A task that ends with whoever holds it.
pub struct Kept<T>(pub JoinHandle<T>);

impl<T> Drop for Kept<T> {
    fn drop(&mut self) {
        self.0.abort();
    }
}

/// Whose way is followed.
#[derive(Clone)]
pub struct Way {
    pub vehicle: String,
    pub epoch: u64,
    pub goal: String,
    pub robot: Option<String>,
}

/// A way that is followed, as long as this is kept.
pub struct Following {
    site: Site,
    way: Way,
    /// From where, and by which name.
    place: Arc<Mutex<Place>>,
    _task: Kept<()>,
}

#[derive(Default)]
struct Place {
    at: [f64; 2],
    follower: Option<String>,
}

fn lock(place: &Mutex<Place>) -> MutexGuard<'_, Place> {
    place.lock().unwrap_or_else(PoisonError::into_inner)
}

impl Following {
    pub fn begin(site: Site, way: Way, at: [f64; 2], heard: UnboundedSender<Heard>) -> Self {
        let place = Arc::new(Mutex::new(Place { at, follower: None }));
        let task = tokio::spawn(follow(site.clone(), way.clone(), Arc::clone(&place), heard));
        Self { site, way, place, _task: Kept(task) }
    }

    /// The name by which the service knows it.
    pub fn is_named(&self, epoch: u64, follower: String) {
        if epoch == self.way.epoch {
            lock(&self.place).follower = Some(follower);
        }
    }

    /// From now on the way from there is followed.
    pub fn goes_on(&self, at: [f64; 2]) {
        let follower = {
            let mut place = lock(&self.place);
            place.at = at;
            place.follower.clone()
        };
        let (site, place) = (self.site.clone(), Arc::clone(&self.place));
        let Some(follower) = follower else { return };
        tokio::spawn(async move {
            let path = format!("/api/route/follow/{follower}");
            // who is not known any more comes again by itself, and from there
            if site.post(&path, &json!({"x": at[0], "y": at[1]})).await.is_err() {
                lock(&place).follower = None;
            }
        });
    }
}

async fn follow(site: Site, way: Way, place: Arc<Mutex<Place>>, heard: UnboundedSender<Heard>) {
    let mut told = None;
    loop {
        let at = lock(&place).at;
        let asked = question(at, &way.goal, way.robot.as_deref());
        let path = format!("/api/route/follow?{asked}&{}", query(&[("name", &way.vehicle)]));
        let ended = site.hear(&path, |event, data| {
            if event != "route" {
                return;
            }
            let said = match serde_json::from_str::<Followed>(data) {
                Ok(Followed { follower, route, .. }) => {
                    Heard::Route { vehicle: way.vehicle.clone(), epoch: way.epoch, follower, route }
                }
                Err(error) => {
                    Heard::Said(format!("{}: the site's route cannot be read: {error}", way.vehicle))
                }
            };
            let _ = heard.send(said);
        });
        let words = match ended.await {
            Ok(()) => None,
            Err(Trouble::Refused { words, .. }) => {
                let route =
                    Route { status: "refused".to_owned(), reason: Some(words.clone()), ..Route::default() };
                let refused = Heard::Route {
                    vehicle: way.vehicle.clone(),
                    epoch: way.epoch,
                    follower: String::new(),
                    route,
                };
                let _ = heard.send(refused);
                Some(format!("{}: {words}", way.vehicle))
            }
            Err(trouble) => Some(trouble.to_string()),
        };
        if words.is_some() && words != told {
            let _ = heard.send(Heard::Said(words.clone().unwrap_or_default()));
        }
        told = words;
        tokio::time::sleep(PAUSE).await;
    }
}

/// A question for the way between two ends.
fn question(from: [f64; 2], goal: &str, robot: Option<&str>) -> String {
    let start = format!("{},{}", from[0], from[1]);
    let mut asked = vec![("start", start.as_str()), ("goal", goal), ("within", WITHIN)];
    asked.extend(robot.map(|robot| ("robot", robot)));
    query(&asked)
}

/// The best way from there, once. Where nobody answers it is asked again in a while.
pub async fn once(site: Site, way: Way, from: [f64; 2], heard: UnboundedSender<Heard>) {
    let path = format!("/api/route?{}", question(from, &way.goal, way.robot.as_deref()));
    let Ok(answer) = site.get(&path).await else { return };
    if let Ok(route) = serde_json::from_value(answer) {
        let _ = heard.send(Heard::Fresh { vehicle: way.vehicle, epoch: way.epoch, route });
    }
}

/// What was released.
pub struct Along {
    pub from: [f64; 2],
    pub to: [f64; 2],
    pub metres: f64,
    pub doorways: Vec<String>,
    pub robot: Option<String>,
}

/// Whether the best way to where it ends is as short, by the same doorways; `None` where nobody answers.
pub async fn holds(site: &Site, along: &Along) -> Option<bool> {
    let to = format!("{},{}", along.to[0], along.to[1]);
    let asked = question(along.from, &to, along.robot.as_deref());
    let route: Route = match site.get(&format!("/api/route?{asked}")).await {
        Ok(answer) => serde_json::from_value(answer).ok()?,
        Err(Trouble::Refused { code, .. }) if code.starts_with("route/") => return Some(false),
        Err(_) => return None,
    };
    let doorways: Vec<&String> = route.steps.iter().filter_map(|step| step.doorway.as_ref()).collect();
    let is_as_short = route.distance.is_none_or(|metres| metres <= along.metres * 1.02 + 0.15);
    Some(route.leads() && is_as_short && doorways.iter().copied().eq(&along.doorways))
}

/// Hears of changes; tables are read after each, and once in a while of a service that says nothing.
pub async fn events(site: Site, answers: Arc<AtomicU64>, heard: UnboundedSender<Heard>) {
    let changed = Arc::new(tokio::sync::Notify::new());
    let _reader = Kept(tokio::spawn(read(site.clone(), answers, Arc::clone(&changed), heard.clone())));
    while !heard.is_closed() {
        changed.notify_one();
        let ended = site.hear("/api/events", |event, data| match event {
            "hello" => {
                changed.notify_one();
                let _ = heard.send(Heard::Floor);
            }
            "changed" => {
                changed.notify_one();
                let said: Value = serde_json::from_str(data).unwrap_or_default();
                if said["ways"] != false {
                    let _ = heard.send(Heard::Floor);
                }
            }
            _ => {}
        });
        if let Err(trouble) = ended.await {
            let _ = heard.send(Heard::Tables(Err(trouble.to_string())));
        }
        tokio::time::sleep(PAUSE).await;
    }
}

async fn read(
    site: Site,
    answers: Arc<AtomicU64>,
    changed: Arc<tokio::sync::Notify>,
    heard: UnboundedSender<Heard>,
) {
    let mut layout = None;
    loop {
        changed.notified().await;
        let answered = answers.load(Ordering::SeqCst);
        let tables = match site.get("/api/tables").await {
            Ok(answer) => Tables::read(&answer).map(|mut tables| {
                tables.vehicles.iter_mut().for_each(|row| row.answers = answered);
                tables
            }),
            Err(trouble) => Err(trouble.to_string()),
        };
        let _ = heard.send(Heard::Tables(tables));
        if let Ok(answer) = site.get("/api/areas").await {
            let _ = heard.send(Heard::Areas(Area::read(&answer)));
        }
        let now = site.get("/api/site").await.ok().map(|site| site["layout"].clone());
        if now.is_some()
            && now != layout
            && let Ok(map) = site.get("/api/map").await
        {
            let bridges: Vec<Bridge> =
                map["bridges"].as_array().into_iter().flatten().filter_map(bridge).collect();
            let bounds = serde_json::from_value(map["bounds"].clone()).ok();
            let _ = heard.send(Heard::Map(bridges, bounds));
            layout = now;
        }
    }
}

fn bridge(of: &Value) -> Option<Bridge> {
    let rect: [f64; 4] = serde_json::from_value(of["rect"].clone()).ok()?;
    Some(Bridge { rect, height: of["height"].as_f64()? })
}
