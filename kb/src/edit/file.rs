//! Rule files and tests of rules, edited with rows: what the history says of them. They are written once that is committed.

use std::collections::BTreeMap;

use adit_db::Tx;
use adit_db::cell::Cell;
use adit_db::edit::Edited;
use adit_db::history::{Author, Edit as Entry};

use crate::error::{Code, Error, Result};
use crate::knowledge::KnowledgeBase;
use crate::site::journal::FILES;
use crate::site::rules::{self, Drafts, version};

/// What each edit of a file is of.
const PART: Option<&str> = Some("text");

/// A rule file or a test of rules with another text.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Write {
    /// Its name in the folder of the user's own rules: `doors.rhai`, `tests/doors.toml`.
    pub file: String,
    /// The text from now on; without one the file goes.
    pub text: Option<String>,
    /// Names the text that the editor saw; none where there was no file.
    pub seen: Option<String>,
}

/// The files that taking an entry of the history back would have others, as they were before it.
pub(super) fn undone(tx: &mut Tx<'_>, id: Option<i64>) -> Result<Drafts> {
    let Some(id) = id.or(tx.undoable(1)?.first().copied()) else { return Ok(Drafts::new()) };
    let made = tx.made_together(id)?;
    // what a rule did of it is taken back alone
    let of = made.iter().find(|entry| entry.id == id).map(|entry| (entry.who.clone(), entry.why.clone()));
    let open = made.into_iter().rev().filter(|entry| {
        let is_of = of.as_ref().is_some_and(|(who, why)| (who, why) == (&entry.who, &entry.why));
        entry.table == FILES && entry.undone.is_none() && is_of
    });
    Ok(open.map(|entry| (entry.key, text(&entry.old).map(str::to_owned))).collect())
}

/// The text in an entry of the history about a file.
pub(super) fn text(cell: &Cell) -> Option<&str> {
    match cell {
        Cell::Text(text) => Some(text),
        _ => None,
    }
}

fn cell(text: Option<&str>) -> Cell {
    text.map_or(Cell::Null, Cell::from)
}

/// The text of before, if it is the one that the editor saw.
pub(super) fn before(site: &KnowledgeBase, Write { file, text, seen }: &Write) -> Result<Option<String>> {
    let before = rules::text(&site.rule_folder().join(file))?;
    if before.is_none() && text.is_none() {
        return Err(Error::said(Code::RulesUnknownFile, format!("there is no rule file {file}"), None));
    }
    if before.as_deref().map(version) != *seen {
        let (message, help) = match (&before, seen) {
            (Some(_), None) => (
                format!("{file} is there already: say the version that was read"),
                "GET /api/rules says the version of each file",
            ),
            _ => (
                format!("{file} has changed: somebody saved it since it was read"),
                "read it again, then make the change again",
            ),
        };
        return Err(Error::said(Code::RulesConflict, message, Some(help.to_owned())));
    }
    Ok(before)
}

/// Writes down that a file has another text, or is gone.
pub(super) fn write(tx: &mut Tx<'_>, site: &KnowledgeBase, write: &Write, author: &Author) -> Result<Edited> {
    let before = before(site, write)?;
    let Write { file, text, .. } = write;
    let (old, new) = (cell(before.as_deref()), cell(text.as_deref()));
    let id = tx.record((FILES, file, PART), (&old, &new), author)?;
    Ok(Edited { id, key: file.clone(), old, new })
}

/// Writes down that a file is as it was before an edit, unless it was edited since.
pub(super) fn take_back(
    tx: &mut Tx<'_>,
    site: &KnowledgeBase,
    entry: &Entry,
    author: &Author,
) -> Result<Edited> {
    let now = rules::text(&site.rule_folder().join(&entry.key))?;
    if now.as_deref() != text(&entry.new) {
        let message =
            format!("{} was edited since: edit {} is not taken back over that", entry.key, entry.id);
        let help = "the page shows its versions, of which each can be taken up again";
        return Err(Error::said(Code::RulesConflict, message, Some(help.to_owned())));
    }
    let id = tx.record((FILES, &entry.key, PART), (&entry.new, &entry.old), author)?;
    tx.mark_undone(entry.id, id)?;
    Ok(Edited { id, key: entry.key.clone(), old: entry.new.clone(), new: entry.old.clone() })
}

/// Before the name of a rule file.
const CALLED: &str = "rule file ";

/// What a rule file is called among tables.
pub(super) fn called(file: &str) -> String {
    format!("{CALLED}{file}")
}

/// Whether something is called as a rule file is.
pub(super) fn is_called(name: &str) -> bool {
    name.starts_with(CALLED)
}

/// What became of a file's text, in a few words.
pub(super) fn change(old: &Cell, new: &Cell) -> String {
    let lines = |count: usize| if count == 1 { "1 line".to_owned() } else { format!("{count} lines") };
    match (text(old), text(new)) {
        (None, Some(text)) => format!("new, {}", lines(text.lines().count())),
        (Some(text), None) => format!("gone, {}", lines(text.lines().count())),
        (Some(old), Some(new)) => {
            let [more, gone] = [(new, old), (old, new)].map(|(one, other)| lines_only_in(one, other));
            match (more, gone) {
                (0, 0) if old == new => "as it was".to_owned(),
                (0, 0) => "lines in another order".to_owned(),
                (more, 0) => format!("{} more", lines(more)),
                (0, gone) => format!("{} fewer", lines(gone)),
                (more, gone) if more == gone => format!("{} changed", lines(more)),
                (more, gone) => format!("{} in place of {gone}", lines(more)),
            }
        }
        (None, None) => String::new(),
    }
}

/// How many lines of a text another one lacks.
fn lines_only_in(one: &str, other: &str) -> usize {
    let mut there: BTreeMap<&str, usize> = BTreeMap::new();
    for line in other.lines() {
        *there.entry(line).or_default() += 1;
    }
    let mut lacking = 0;
    for line in one.lines() {
        match there.get_mut(line) {
            Some(left) if *left > 0 => *left -= 1,
            _ => lacking += 1,
        }
    }
    lacking
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_became_of_a_file_is_said_in_lines() {
        let said = |old: Option<&str>, new: Option<&str>| change(&cell(old), &cell(new));
        assert_eq!(said(None, Some("a\nb\n")), "new, 2 lines");
        assert_eq!(said(Some("a\n"), None), "gone, 1 line");
        assert_eq!(said(Some("a\nb\n"), Some("a\nc\nd\n")), "2 lines in place of 1");
        assert_eq!(said(Some("a\nb\n"), Some("a\nb\nb\n")), "1 line more");
        assert_eq!(said(Some("a\nb\n"), Some("b\na\n")), "lines in another order");
        assert_eq!(said(Some("a\n"), Some("a\n")), "as it was");
    }
}
