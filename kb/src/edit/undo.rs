//! Taking edits back, those of rules in one go.

use std::collections::BTreeSet;

use adit_db::Tx;
use adit_db::carried_out::CarriedOut as Kept;
use adit_db::edit::Edited;
use adit_db::history::{Author, Edit as Entry};
use adit_engine::RuleBase;

use crate::error::Result;

/// Takes an edit back; of what a rule did in one go, all of it, and the rule does not do it again for the same reason.
pub(super) fn undo(tx: &mut Tx<'_>, rules: &RuleBase, id: i64, author: &Author) -> Result<Edited> {
    let around = tx.history_before(Some(id + TOGETHER), 2 * TOGETHER as u32)?;
    let entry = around.iter().find(|entry| entry.id == id);
    let rule = entry.and_then(|entry| {
        rules.rules().iter().filter(|rule| rule.reacts()).find(|rule| called(rule.name()) == entry.who)
    });
    let (Some(entry), Some(rule)) = (entry, rule) else { return Ok(tx.undo(id, author)?) };
    let is_same = |of: &&Entry| of.who == entry.who && of.why == entry.why && of.undone.is_none();
    let ids: BTreeSet<i64> = around.iter().filter(is_same).map(|of| of.id).collect();
    let first = (0..TOGETHER).map(|back| id - back).take_while(|id| ids.contains(id)).last().unwrap_or(id);
    let last = (0..TOGETHER).map(|on| id + on).take_while(|id| ids.contains(id)).last().unwrap_or(id);
    let mut done = None;
    for id in (first..=last).rev() {
        let undone = tx.undo(id, author)?;
        done.get_or_insert(undone);
    }
    let mut carried_out = tx.carried_out()?;
    let (rule, version) = (rule.name().to_owned(), rule.version().to_owned());
    carried_out.push(Kept { rule, version, because: entry.why.clone() });
    tx.replace_carried_out(&carried_out)?;
    match done {
        Some(done) => Ok(done),
        None => Ok(tx.undo(id, author)?),
    }
}

/// Entries of the history about one among which others that a rule made with it are looked for.
const TOGETHER: i64 = 500;

/// Who tells what a rule tells.
pub(super) fn called(rule: &str) -> String {
    format!("rule \"{rule}\"")
}
