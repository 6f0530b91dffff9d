//! After each change: which routes between places cost more or less, said to subscribers; then the kept routes, found
//! anew on a thread of their own while edits and questions go on.

use std::sync::Arc;
use std::sync::mpsc::channel;
use std::thread;
use std::time::{Duration, Instant};

use super::event::{Event, Rerouted, RouteCost};
use super::shared::Shared;
use crate::error::{Code, Error, Result};
use crate::graph::pairs::PlaceCosts;
use crate::live::{Renewal, View};

/// How long no change may come before kept routes are found anew.
const QUIET: Duration = Duration::from_millis(400);

/// How long it is waited for a change before it is looked whether the service ends.
const PAUSE: Duration = Duration::from_millis(500);
const SHORTEST: Duration = Duration::from_millis(1);

/// Up to so many pairs of places are compared; a site with more is asked for what is of interest.
const PAIRS: usize = 5_000;

/// Up to so many routes are named in one event.
const NAMED: usize = 200;

/// Trees that are found side by side before they are written.
const BATCH: usize = 4;

/// Works until the service ends.
pub fn start(shared: Arc<Shared>) -> Result<thread::JoinHandle<()>> {
    let work = move || {
        // one view for both: an edit that comes while costs are found is seen as a change
        let first = shared.view.load().view.clone();
        let (found, mut generation) = (costs(&shared, &first), first.generation());
        drop(first);
        let Some(mut costs) = found else { return };
        let mut changed = Instant::now();
        while !*shared.ending.borrow() {
            let view = shared.view.load().view.clone();
            if view.generation() != generation {
                (generation, changed) = (view.generation(), Instant::now());
                let Some(now) = self::costs(&shared, &view) else { return };
                say(&shared, generation, &costs, &now);
                costs = now;
            } else if view.routes_due() && changed.elapsed() > QUIET {
                renew(&shared, generation);
                changed = Instant::now();
            } else {
                let patience =
                    if view.routes_due() { QUIET.saturating_sub(changed.elapsed()) } else { PAUSE };
                shared.wait_for_change(generation, patience.max(SHORTEST));
            }
        }
    };
    let builder = thread::Builder::new().name("routes".to_owned());
    builder.spawn(work).map_err(Error::of(Code::ServeThread))
}

/// What routes between places cost, by robot, start and goal. `None` once the service ends: on a large floor that takes
/// seconds, which nobody should wait for who has told it to.
fn costs(shared: &Shared, view: &View) -> Option<PlaceCosts> {
    let pairs = view.graph().places.len().pow(2) * view.robots().len();
    if pairs > PAIRS { Some(PlaceCosts::new()) } else { view.place_costs(|| !*shared.ending.borrow()) }
}

fn say(shared: &Shared, generation: u64, before: &PlaceCosts, now: &PlaceCosts) {
    let mut changed: Vec<RouteCost> = Vec::new();
    for pair in before.keys().chain(now.keys().filter(|pair| !before.contains_key(*pair))) {
        let (old, new) = (before.get(pair).copied(), now.get(pair).copied());
        if old != new {
            let (robot, start, goal) = pair.clone();
            changed.push(RouteCost { robot, start, goal, old, new });
        }
    }
    if changed.is_empty() {
        return;
    }
    let by = |cost: &RouteCost| cost.new.unwrap_or(f64::MAX) - cost.old.unwrap_or(f64::MAX);
    changed.sort_by(|one, other| by(other).abs().total_cmp(&by(one).abs()));
    let truncated = changed.len() > NAMED;
    changed.truncate(NAMED);
    let total = before.len().max(now.len());
    shared.say(Event::new("routes", &Rerouted { generation, total, changed, truncated }));
}

/// Finds kept routes anew and has them written, until a newer change overtakes that.
fn renew(shared: &Arc<Shared>, generation: u64) {
    let Some(Some(renewal)) = ask(shared, |desk| desk.live.renewal().ok().flatten()) else { return };
    if !renewal.fits() {
        ask(shared, |desk| desk.live.renew_routes().map(drop).unwrap_or_default());
        return;
    }
    let renewal: Arc<Renewal> = Arc::new(renewal);
    let mut first = 0;
    while first < renewal.len().max(1) {
        if *shared.ending.borrow() || shared.view.load().view.generation() != generation {
            return;
        }
        let trees = renewal.trees(first, BATCH);
        first += BATCH;
        let (last, same) = (first >= renewal.len(), Arc::clone(&renewal));
        let kept = ask(shared, move |desk| desk.keep(&same, trees, last));
        if kept != Some(true) {
            return;
        }
    }
}

/// Has something done at the desk, and waits for it.
fn ask<T: Send + 'static>(
    shared: &Shared,
    work: impl FnOnce(&mut super::desk::Desk) -> T + Send + 'static,
) -> Option<T> {
    let (answer, answered) = channel();
    let is_left = shared.leave_at_desk(move |desk| {
        answer.send(work(desk)).ok();
    });
    if is_left { answered.recv().ok() } else { None }
}
