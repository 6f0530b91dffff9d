//! Taking edits back, those of rules in one go.

use std::collections::BTreeMap;

use adit_db::Tx;
use adit_db::carried_out::CarriedOut as Kept;
use adit_db::edit::Edited;
use adit_db::history::{Author, Edit as Entry};
use adit_engine::RuleBase;
use jiff::Timestamp;

use crate::error::Result;

/// Takes an edit back: with what rules did of it at once, and of what a rule did in one go all of it. No rule does it again for
/// the same reason.
pub(super) fn undo(tx: &mut Tx<'_>, rules: &RuleBase, id: i64, author: &Author) -> Result<Edited> {
    let around = tx.history_before(Some(id + TOGETHER), 2 * TOGETHER as u32)?;
    let standing: BTreeMap<i64, &Entry> =
        around.iter().filter(|of| of.undone.is_none()).map(|of| (of.id, of)).collect();
    let Some(&entry) = standing.get(&id) else { return Ok(tx.undo(id, author)?) };
    let by_rule =
        |of: &Entry| rules.rules().iter().find(|rule| rule.reacts() && called(rule.name()) == of.who);
    let is_rules_own = by_rule(entry).is_some();
    let is_part = |of: &Entry| {
        if is_rules_own {
            (&of.who, &of.why) == (&entry.who, &entry.why)
        } else {
            by_rule(of).is_some() && is_at_once(entry, of)
        }
    };
    let in_a_row = |step: i64| {
        let ids = (1..TOGETHER).map(move |nth| id + step * nth);
        ids.map_while(|id| standing.get(&id).copied()).take_while(|of| is_part(of)).collect::<Vec<_>>()
    };
    let mut parts = vec![entry];
    parts.extend(in_a_row(1));
    if is_rules_own {
        parts.extend(in_a_row(-1));
    }
    parts.sort_by_key(|of| of.id);
    let mut carried_out = tx.carried_out()?;
    let known = carried_out.len();
    for of in &parts {
        if let Some(rule) = by_rule(of) {
            let (rule, version) = (rule.name().to_owned(), rule.version().to_owned());
            let done = Kept { rule, version, because: of.why.clone() };
            if !carried_out[known..].contains(&done) {
                carried_out.push(done);
            }
        }
    }
    tx.replace_carried_out(&carried_out)?;
    let mut done = None;
    for of in parts.iter().rev() {
        let undone = tx.undo(of.id, author)?;
        if of.id == id {
            done = Some(undone);
        }
    }
    match done {
        Some(done) => Ok(done),
        None => Ok(tx.undo(id, author)?),
    }
}

/// Whether something was done within two seconds of something else: in one step, as far as the history can tell.
fn is_at_once(one: &Entry, other: &Entry) -> bool {
    let [one, other] = [one, other].map(|of| of.at.parse::<Timestamp>().ok());
    one.zip(other).is_some_and(|(one, other)| other.duration_since(one).as_secs().abs() <= 2)
}

/// Entries of the history about one among which others that a rule made with it are looked for.
const TOGETHER: i64 = 500;

/// Who tells what a rule tells.
pub(super) fn called(rule: &str) -> String {
    format!("rule \"{rule}\"")
}
