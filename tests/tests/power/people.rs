//! People and robots who edit at once.

use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::atomic::{AtomicUsize, Ordering};
use std::thread;

use adit_tests::service::request;
use serde_json::{Value, json};

/// Who edit by the service at an address.
pub struct People<'t> {
    pub address: &'t str,
    /// What is left of their edits has this name.
    pub day: String,
    /// Done right after an edit was acknowledged, with its number in the history.
    pub acknowledged: &'t (dyn Fn(i64) + Sync),
}

/// Nobody answers any more.
struct Gone;

fn hardness(state: &str, value: f64) -> Value {
    json!({"kind": "set", "table": "robots", "key": state, "column": "hardness", "value": value})
}

impl People<'_> {
    /// Four of them edit at once, so often, or until nobody answers; gives how many edits were refused.
    pub fn edit(&self, rounds: usize) -> usize {
        let refused = AtomicUsize::new(0);
        let made = |edit: &Value| match self.made(edit)? {
            Some(id) => Ok(id),
            None => Ok(refused.fetch_add(1, Ordering::Relaxed) as i64),
        };
        let tunes = |round: usize| {
            made(&hardness("SQUAT", 4.0 + round as f64 / 64.0))?;
            made(&hardness("SQUAT", 3.0 + round as f64 / 64.0))
        };
        let closes = |_| {
            made(&json!({"kind": "close", "what": "doorway 1", "for_seconds": 3_600}))?;
            made(&json!({"kind": "open", "what": "doorway 1"}))
        };
        let lays = |round: usize| {
            let name = format!("charger {round} of {}", self.day);
            let charger = json!({"kind": "lay", "what": "place", "name": name, "corners": [[1.0, 1.0]]});
            let together = [hardness("SIDE-STAND", 3.0 + round as f64 / 64.0), charger];
            let both = made(&json!({"kind": "together", "edits": together}))?;
            if round.is_multiple_of(2) { made(&json!({"kind": "undo", "edit": both})) } else { Ok(both) }
        };
        let switches = |round: usize| {
            made(&json!({"kind": "set_in_tuning", "tuning": "guests", "table": "robots", "key": "STAND",
                "column": "hardness", "value": 1.0 + round as f64 / 64.0}))?;
            made(&json!({"kind": "switch", "tuning": "guests", "on": true}))?;
            made(&json!({"kind": "switch", "tuning": "guests", "on": false}))
        };
        let people: [&(dyn Fn(usize) -> Result<i64, Gone> + Sync); 4] = [&tunes, &closes, &lays, &switches];
        thread::scope(|scope| {
            for one in people {
                scope.spawn(move || (0..rounds).try_for_each(|round| one(round).map(drop)).is_ok());
            }
        });
        refused.into_inner()
    }

    /// The number of an edit that was made; `None` where it was refused.
    fn made(&self, edit: &Value) -> Result<Option<i64>, Gone> {
        let body = json!({"edit": edit, "why": "a test"});
        // somebody killed in the middle of an answer gives half of one
        let ask = AssertUnwindSafe(|| request(self.address, "POST", "/api/edits", Some(&body)));
        let Ok((status, answer)) = catch_unwind(ask) else { return Err(Gone) };
        let id = answer["done"]["id"].as_i64().filter(|_| status == 200);
        if let Some(id) = id {
            (self.acknowledged)(id);
        }
        Ok(id)
    }
}
