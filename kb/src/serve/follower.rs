//! A route that is followed: what its follower holds, where it now is, and what it hears when another route is the best.

mod held;
mod words;

use std::collections::{BTreeMap, VecDeque};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use std::time::{Duration, Instant};

use adit_planners::geometry::Point;
use tokio::sync::broadcast::error::RecvError;
use tokio::sync::watch;

use super::event::{Changed, Event, Followed};
use super::fault::{Answered, Fault};
use super::question::Question;
use super::share::Asker;
use super::shared::{Shared, Subscription};
use super::token;
use crate::answer::{Answer, Status};
use crate::edit::Errand;
use crate::error::Code;
use crate::live::View;
use held::Held;

/// Random bytes of a follower's name: whoever knows it may say where the follower is.
const BYTES: usize = 16;

/// Changes that one word about a route names; of more the newest.
const NAMED: usize = 20;

/// Words about a route that are remembered, for people who look on.
const TOLD: usize = 5;

/// How long the word about a change may be behind the site that shows it.
const BEHIND: Duration = Duration::from_millis(200);

/// Who follows routes now, by name.
#[derive(Default)]
pub struct Followers(Mutex<BTreeMap<String, Known>>);

/// What others may ask of a follower, and tell it.
#[derive(Clone)]
struct Known {
    question: Arc<Question>,
    held: Arc<watch::Sender<Arc<Held>>>,
    since: Instant,
    /// When it said last where it is; none where it only asked for its way.
    moved: Option<(Instant, Point)>,
    told: VecDeque<(Instant, String)>,
}

/// A follower, as others see it.
pub struct Following {
    /// What people call it.
    pub name: Option<String>,
    pub answer: Arc<Answer>,
    /// Since when it follows its way.
    pub since: Instant,
    /// When it said last from where.
    pub moved: Instant,
    /// From where its way leads.
    pub at: Option<Point>,
    /// What it was told last, the newest last.
    pub told: Vec<(Instant, String)>,
}

/// A stream's side of it. Its name goes with it.
pub struct Follower {
    shared: Arc<Shared>,
    asker: Arc<Asker>,
    name: String,
    question: Arc<Question>,
    subscription: Subscription,
    held: Arc<Held>,
    moved: watch::Receiver<Arc<Held>>,
    /// What was heard last.
    changes: VecDeque<Changed>,
    /// The newest state of which it was heard.
    heard: u64,
}

impl Followers {
    fn all(&self) -> MutexGuard<'_, BTreeMap<String, Known>> {
        self.0.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// A follower is elsewhere by now: the route from there, which it holds from now on.
    pub fn moves(&self, name: &str, view: &View, to: Point) -> Answered<Arc<Answer>> {
        let known = self.all().get(name).cloned().ok_or_else(|| {
            Fault::new(Code::FollowUnknown, "nobody of this name follows a route")
                .helped("open the stream anew, from where the robot now is")
        })?;
        let question = Question {
            start: format!("{},{}", to.x, to.y),
            goals: known.question.goals.clone(),
            robot: known.question.robot.clone(),
            within: known.question.within,
            name: None,
            errand: Errand::default(),
        };
        let answer = question.answer(view)?;
        if answer.status == Status::NoRoute && answer.nearest.as_ref().is_some_and(|of| of.end == "start") {
            let reason = answer.reason.unwrap_or_default();
            let help = "the follower is where it was; say where the robot fits, or follow with `within`";
            return Err(Fault::new(Code::RouteUnfit, reason).helped(help));
        }
        let held = Held::of(answer, view);
        let answer = Arc::clone(&held.answer);
        known.held.send_replace(Arc::new(held));
        if let Some(known) = self.all().get_mut(name) {
            known.moved = Some((Instant::now(), to));
        }
        Ok(answer)
    }

    /// All of them, as they now are.
    pub fn listed(&self) -> Vec<Following> {
        let following = |known: &Known| {
            let answer = Arc::clone(&known.held.borrow().answer);
            let start = answer.waypoints.first().map(|point| Point::new(point.x, point.y));
            Following {
                name: known.question.name.clone(),
                at: known.moved.map(|(_, at)| at).or(start),
                moved: known.moved.map_or(known.since, |(when, _)| when),
                since: known.since,
                told: known.told.iter().cloned().collect(),
                answer,
            }
        };
        self.all().values().map(following).collect()
    }
}

impl Follower {
    /// Whoever asks, at a place among the subscribers; with the first word.
    pub fn new(
        shared: &Arc<Shared>,
        asker: Arc<Asker>,
        subscription: Subscription,
        question: Question,
        view: &View,
    ) -> Answered<(Self, Arc<Event>)> {
        let answer = question.answer(view)?;
        // whose route it is does not change when other robots come
        let question = Arc::new(Question { robot: Some(answer.robot.clone()), ..question });
        let held = Arc::new(Held::of(answer, view));
        let name = token::random::<BYTES>()?;
        let (sender, moved) = watch::channel(Arc::clone(&held));
        let (since, told) = (Instant::now(), VecDeque::new());
        let question_of = Arc::clone(&question);
        let known = Known { question: question_of, held: Arc::new(sender), since, moved: None, told };
        shared.followers.all().insert(name.clone(), known);
        let follower = Self {
            shared: Arc::clone(shared),
            asker,
            name,
            question,
            subscription,
            held,
            moved,
            changes: VecDeque::new(),
            heard: view.generation(),
        };
        let first = follower.word(words::first(&follower.held.answer), None, Vec::new());
        Ok((follower, first))
    }

    /// Waits until another route is the best: the word about it. `None` where the service ends.
    pub async fn next(&mut self) -> Option<Arc<Event>> {
        loop {
            tokio::select! {
                event = self.subscription.events.recv() => match event {
                    Ok(event) => self.hear(&event),
                    // who lags hears of the newest state, and of no more changes than there is place for
                    Err(RecvError::Lagged(_)) => {}
                    Err(RecvError::Closed) => return None,
                },
                // the route from there was the answer to whoever said so
                _ = self.moved.changed() => {}
            }
            if let Some(word) = self.renew().await {
                return Some(word);
            }
        }
    }

    /// Finds the route anew where the site is another one by now; a word where it is another route.
    async fn renew(&mut self) -> Option<Arc<Event>> {
        let seen = self.shared.view.load_full();
        self.hear_up_to(seen.view.generation()).await;
        self.held = Arc::clone(&self.moved.borrow_and_update());
        if self.held.answer.generation == seen.view.generation() {
            return None;
        }
        let now = if let Some(kept) = self.held.kept(&seen.view) {
            kept
        } else {
            let (held, question) = (Arc::clone(&self.held), Arc::clone(&self.question));
            self.shared.renew(&self.asker, move || held.renewed(&question, &seen.view)).await.ok()?
        };
        let now = Arc::new(now);
        let before = std::mem::replace(&mut self.held, Arc::clone(&now));
        let is_kept = self.shared.followers.all().get(&self.name).is_some_and(|known| {
            known.held.send_if_modified(|held| {
                // who has moved meanwhile holds the route from there
                let is_here = Arc::ptr_eq(held, &before);
                if is_here {
                    *held = Arc::clone(&now);
                }
                is_here
            })
        });
        if !is_kept || before.is_same(&now) {
            return None;
        }
        let meanwhile = before.answer.generation + 1..=now.answer.generation;
        let changes = self.changes.iter().filter(|change| meanwhile.contains(&change.generation));
        let changes: Vec<Changed> = changes.cloned().collect();
        let words = words::changed(&before, &now, &changes);
        Some(self.word(words, before.answer.cost, changes))
    }

    fn word(&self, words: String, cost_before: Option<f64>, changes: Vec<Changed>) -> Arc<Event> {
        let (follower, route) = (self.name.clone(), (*self.held.answer).clone());
        if let Some(known) = self.shared.followers.all().get_mut(&self.name) {
            if known.told.len() == TOLD {
                known.told.pop_front();
            }
            known.told.push_back((Instant::now(), words.clone()));
        }
        Arc::new(Event::new("route", &Followed { follower, words, cost_before, changes, route }))
    }

    fn hear(&mut self, event: &Event) {
        let Some(changed) = &event.changed else { return };
        self.heard = changed.generation;
        if self.changes.len() == NAMED {
            self.changes.pop_front();
        }
        self.changes.push_back(changed.clone());
    }

    /// Hears why the site is as it is shown: that is said right after. What is newer is left, and heard in its turn.
    async fn hear_up_to(&mut self, generation: u64) {
        while self.heard < generation {
            match tokio::time::timeout(BEHIND, self.subscription.events.recv()).await {
                Ok(Ok(event)) => self.hear(&event),
                Ok(Err(RecvError::Lagged(_))) => {}
                Ok(Err(RecvError::Closed)) | Err(_) => return,
            }
        }
    }
}

impl Drop for Follower {
    fn drop(&mut self) {
        self.shared.followers.all().remove(&self.name);
    }
}
