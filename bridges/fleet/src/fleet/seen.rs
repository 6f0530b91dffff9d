//! Where vehicles are, said to the site for people who look on.

use std::collections::BTreeMap;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::{Duration, Instant};

use adit_site::say;
use serde_json::json;
use tokio::task::JoinHandle;

use crate::driver::Whereabout;
use crate::site::{Site, Trouble};

/// How often it is said of a vehicle that stands still that it is still there.
const STILL: Duration = Duration::from_secs(5);

/// What was said, and when.
#[derive(Default)]
pub struct Seen {
    said: BTreeMap<String, (Whereabout, Instant)>,
    /// One message after the other: a slow service is not asked more and more.
    talks: Option<JoinHandle<()>>,
    /// Whether it was said that the site does not take it.
    is_refused: Arc<AtomicBool>,
}

/// Robots that one message may speak of.
const AT_ONCE: usize = 1_000;

impl Seen {
    /// Says where vehicles are that moved, or were not spoken of for a while.
    pub fn say(&mut self, site: &Site, vehicles: impl Iterator<Item = (String, Whereabout)>) {
        if self.talks.as_ref().is_some_and(|task| !task.is_finished()) {
            return;
        }
        let is_news = |name: &String, now: &Whereabout| {
            self.said.get(name).is_none_or(|(was, when)| was != now || when.elapsed() > STILL)
        };
        let news: Vec<(String, Whereabout)> =
            vehicles.filter(|(name, now)| is_news(name, now)).take(AT_ONCE).collect();
        if news.is_empty() {
            return;
        }
        let robots: Vec<&Whereabout> = news.iter().map(|(_, now)| now).collect();
        let body = json!({"robots": robots});
        let (site, is_refused) = (site.clone(), Arc::clone(&self.is_refused));
        // where nobody hears it, it is said again in a moment
        self.talks = Some(tokio::spawn(async move {
            if let Err(Trouble::Refused { words, .. }) = site.post("/api/whereabouts", &body).await
                && !is_refused.swap(true, Ordering::Relaxed)
            {
                say(&format!("people do not see where vehicles are: {words}"));
            }
        }));
        let now = Instant::now();
        self.said.extend(news.into_iter().map(|(name, at)| (name, (at, now))));
    }

    /// Nobody says any more where they are.
    pub async fn leave(&mut self, site: &Site) {
        if let Some(task) = self.talks.take() {
            drop(task.await);
        }
        for (name, _) in std::mem::take(&mut self.said) {
            drop(site.delete(&format!("/api/whereabouts/{}", path_of(&name))).await);
        }
    }
}

/// A name as a part of an address.
fn path_of(name: &str) -> String {
    crate::site::query(&[("", name)]).trim_start_matches('=').replace('+', "%20")
}
