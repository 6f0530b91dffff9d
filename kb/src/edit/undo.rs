//! Taking edits back, those that were made together in one go.

use adit_db::Tx;
use adit_db::carried_out::CarriedOut as Kept;
use adit_db::edit::Edited;
use adit_db::history::{Author, Edit as Entry};
use adit_engine::RuleBase;

use super::file;
use crate::error::{Code, Error, Result};
use crate::knowledge::KnowledgeBase;
use crate::site::journal::FILES;

/// Takes an edit back with all that was made together with it: other cells and rows of one edit, and what rules did of it; of
/// what a rule did, what it did for the same reason. No rule does it again for that reason.
pub(super) fn undo(
    tx: &mut Tx<'_>,
    (site, rules): (&KnowledgeBase, &RuleBase),
    id: i64,
    author: &Author,
) -> Result<(Edited, usize)> {
    let mut parts = tx.made_together(id)?;
    if parts.is_empty() {
        return Err(Error::said(Code::EditNothingToUndo, format!("there is no edit {id}"), None));
    }
    parts.retain(|of| of.undone.is_none());
    let by_rule =
        |of: &Entry| rules.rules().iter().find(|rule| rule.reacts() && called(rule.name()) == of.who);
    match parts.iter().find(|of| of.id == id).cloned() {
        None => return Ok((tx.undo(id, author)?, 0)),
        Some(entry) if by_rule(&entry).is_some() => {
            parts.retain(|of| (&of.who, &of.why) == (&entry.who, &entry.why));
        }
        Some(_) => {}
    }
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
        let is_file = of.table == FILES;
        let undone = if is_file { file::take_back(tx, site, of, author)? } else { tx.undo(of.id, author)? };
        if of.id == id {
            let key = match &of.column {
                Some(_) if is_file => file::called(&of.key),
                Some(column) => format!("{}.{}.{column}", of.table, undone.key),
                None => undone.key.clone(),
            };
            done = Some(Edited { key, ..undone });
        }
    }
    match done {
        Some(done) => Ok((done, parts.len() - 1)),
        None => Ok((tx.undo(id, author)?, 0)),
    }
}

/// Why an edit is not taken back, with the one that can be instead.
pub(super) fn refused(tx: &mut Tx<'_>, id: i64, error: Error) -> Result<Error> {
    let is_conflict = error.problems().iter().any(|problem| problem.code() == Some(Code::EditConflict));
    let made = tx.made_together(id)?;
    let before = tx.undoable(u32::MAX)?.into_iter().find(|other| made.iter().all(|of| *other < of.id));
    let Some(before) = before.filter(|_| is_conflict) else { return Ok(error) };
    let help = format!("the edit before it is {before}: say its number to take that one back");
    Ok(Error::said(Code::EditConflict, error.to_string(), Some(help)))
}

/// Who tells what a rule tells.
pub(super) fn called(rule: &str) -> String {
    format!("rule \"{rule}\"")
}
