//! Edits of the tables that people tune.

use adit_db::Tx;
use adit_db::cell::Cell;
use adit_db::edit::Edited;
use adit_db::history::Author;
use adit_db::robot::{Change, State};
use serde::Serialize;

use adit_engine::RuleBase;

use crate::error::{Code, Error, Result};
use crate::knowledge::KnowledgeBase;
use crate::knowledge::tunings;
use crate::site::rules::{self, Drafts};
use crate::site::sheet::Sheet;

pub(crate) mod cells;
mod close;
mod errand;
mod file;
mod lay;
pub(crate) mod place;
pub(crate) mod react;
pub mod rehearse;
mod table;
mod tell;
mod tuning;
mod undo;
mod words;

pub(crate) use cells::TUNABLE;
use cells::{cell, cell_of, columns, explain, is_equal, row};
pub use close::Close;
pub use errand::Errand;
pub use file::Write;
pub use lay::{Lay, Thing};
pub use tell::Tell;
pub(crate) use tuning::known as known_tuning;
pub(crate) use words::{change, changed, entry, subject};

/// What is to be edited. Values are as people write them; the column says what they must be.
#[derive(Clone, Debug, PartialEq)]
pub enum Edit {
    /// One cell: table, key, column, value.
    Set(String, String, String, String),
    /// One cell that must still hold what the editor saw: table, key and column, the value seen, the value from now on.
    SetFrom([String; 3], String, String),
    /// A new row: table, key, and the columns that the key does not say.
    Add(String, String, Vec<(String, String)>),
    /// A row that goes: table, key.
    Remove(String, String),
    /// A table whose rows are those of a file from now on; of a version that it must still have, where one is said.
    Table(String, Sheet, Option<String>),
    Tell(Tell),
    /// What nobody passes from now on.
    Close(Close),
    /// What is open again, by the name that people have for it.
    Open(String),
    /// An area, an obstacle or a place that lies over the map from now on.
    Lay(Lay),
    /// What no longer lies over the map, by name.
    Lift(String),
    /// A fact, by its number, that is no longer told.
    Retract(i64),
    /// A cell of a named tuning: the tuning, then table, key, column, value.
    SetInTuning(String, [String; 4]),
    /// A cell of a named tuning that goes: the tuning, then table, key, column.
    UnsetInTuning(String, [String; 3]),
    /// A named tuning that is switched on or off.
    Switch(String, bool),
    /// A rule file or a test of rules with another text.
    Write(Write),
    /// An entry of the history that is taken back; the latest one without a number.
    Undo(Option<i64>),
    /// Several edits, one after the other, of which all are made or none.
    Together(Vec<Edit>),
}

#[derive(Clone, Debug, PartialEq, Serialize, utoipa::ToSchema)]
pub struct Done {
    pub id: i64,
    pub key: String,
    /// The value, or the row, of before.
    #[schema(value_type = Value)]
    pub old: Cell,
    /// The value, or the row, of now.
    #[schema(value_type = Value)]
    pub new: Cell,
    /// Entries of the history that were taken back with it.
    pub with: usize,
    /// What each of several edits did that were made together, this one being the first of them.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    #[schema(no_recursion)]
    pub parts: Vec<Done>,
}

impl Done {
    fn of(done: Edited, with: usize) -> Self {
        let Edited { id, key, old, new } = done;
        Self { id, key, old, new, with, parts: Vec::new() }
    }
}

impl Edit {
    /// Carries it out and writes the history.
    pub fn apply(
        &self,
        tx: &mut Tx<'_>,
        site: &KnowledgeBase,
        rules: &RuleBase,
        author: &Author,
    ) -> Result<Done> {
        let done = match self {
            Self::Set(table, key, column, value) => {
                let columns = columns(tx, table)?;
                let cell = cell_of(table, column, value, &columns)?;
                let found = tx.set_cell((table, key, column), &cell, author);
                found.map_err(|error| explain(tx, error, table, key, value))?
            }
            Self::SetFrom([table, key, column], seen, value) => {
                let set = Self::Set(table.clone(), key.clone(), column.clone(), value.clone());
                let done = set.apply(tx, site, rules, author)?;
                if !is_equal(&done.old, &cell(seen)) && crate::words::cells::text(&done.old) != *seen {
                    return Err(conflict(tx, (table, &done, column))?);
                }
                return Ok(done);
            }
            Self::Add(table, key, cells) => {
                let row = row(tx, table, key, cells)?;
                let named: Vec<(&str, Cell)> =
                    row.iter().map(|(name, value)| (name.as_str(), value.clone())).collect();
                tx.add_row(table, &named, author).map_err(|error| explain(tx, error, table, key, ""))?
            }
            Self::Remove(table, key) => {
                columns(tx, table)?;
                let gone = tx.remove_row(table, key, author);
                gone.map_err(|error| explain(tx, error, table, key, ""))?
            }
            Self::Table(table, sheet, seen) => table::take(tx, (table, seen.as_deref()), sheet, author)?,
            Self::Tell(tell) => {
                let row = tell.row(tx, site, rules, author)?;
                tx.add_row("told", &row, author)?
            }
            Self::Close(close) => {
                let row = close.fact(tx)?.row(tx, site, rules, author)?;
                tx.add_row("told", &row, author)?
            }
            Self::Open(what) => close::open(tx, (site, rules), what, author)?,
            Self::Lay(lay) => lay.apply(tx, (site, rules), author)?,
            Self::Lift(name) => lay::lift(tx, name, author)?,
            Self::Retract(id) => {
                let gone = tx.remove_row("told", &id.to_string(), author);
                gone.map_err(|error| match error {
                    adit_db::Error::UnknownKey { .. } => {
                        let help =
                            "`adit tell SITE --list`, or `GET /api/facts`, shows what is told".to_owned();
                        Error::said(Code::TellUnknownFact, format!("there is no fact {id}"), Some(help))
                    }
                    error => error.into(),
                })?
            }
            Self::SetInTuning(tuning, cell) => tuning::set(tx, tuning, cell, author)?,
            Self::UnsetInTuning(tuning, cell) => tuning::unset(tx, tuning, cell, author)?,
            Self::Switch(tuning, on) => tuning::switch(tx, tuning, *on, author)?,
            Self::Write(write) => file::write(tx, site, write, author)?,
            Self::Undo(id) => match id.or(tx.undoable(1)?.first().copied()) {
                Some(id) => {
                    let undone = undo::undo(tx, (site, rules), id, author);
                    // who said a number knows which edit was meant
                    let (done, with) = match undone {
                        Err(error) if matches!(self, Self::Undo(None)) => {
                            return Err(undo::refused(tx, id, error)?);
                        }
                        undone => undone?,
                    };
                    return Ok(Done::of(done, with));
                }
                None => return Err(Error::said(Code::EditNothingToUndo, "there is nothing to undo", None)),
            },
            Self::Together(edits) => {
                let each = edits.iter().map(|edit| edit.apply(tx, site, rules, author));
                let parts = each.collect::<Result<Vec<Done>>>()?;
                let Some(first) = parts.first().cloned() else {
                    return Err(Error::said(Code::EditUsage, "there is nothing to edit", None));
                };
                return Ok(Done { parts, ..first });
            }
        };
        Ok(Done::of(done, 0))
    }
}

impl Edit {
    /// The rule files that would be others, by name.
    pub(crate) fn files(&self, tx: &mut Tx<'_>) -> Result<Drafts> {
        match self {
            Self::Write(Write { file, text, .. }) => {
                rules::check(file, text.as_deref())?;
                Ok([(file.clone(), text.clone())].into())
            }
            Self::Undo(id) => file::undone(tx, *id),
            Self::Together(edits) => {
                let mut files = Drafts::new();
                for edit in edits {
                    for (file, text) in edit.files(tx)? {
                        if files.insert(file.clone(), text).is_some() {
                            let message = format!("{file} is edited twice in one go");
                            return Err(Error::said(Code::EditUsage, message, None));
                        }
                    }
                }
                Ok(files)
            }
            _ => Ok(Drafts::new()),
        }
    }

    /// Refuses edits of files that are others by now than the editor saw.
    pub(crate) fn check_files(&self, site: &KnowledgeBase) -> Result<()> {
        match self {
            Self::Write(write) => file::before(site, write).map(drop),
            Self::Together(edits) => edits.iter().try_for_each(|edit| edit.check_files(site)),
            _ => Ok(()),
        }
    }
}

impl Edit {
    /// Words about what an edit leaves as people may not expect it, once all that follows is written: a cell that does not count, a
    /// state whose changes no row prices, what is closed for longer, or passed all the same, and what is shut all the same.
    pub(crate) fn remarks(&self, tx: &mut Tx<'_>, site: &KnowledgeBase, done: &Done) -> Result<Vec<String>> {
        if let Self::Together(edits) = self {
            let mut all = Vec::new();
            for (edit, done) in edits.iter().zip(&done.parts) {
                all.extend(edit.remarks(tx, site, done)?);
            }
            return Ok(all);
        }
        Ok(self.remark(tx, site, done)?.into_iter().collect())
    }

    fn remark(&self, tx: &mut Tx<'_>, site: &KnowledgeBase, done: &Done) -> Result<Option<String>> {
        match self {
            Self::Add(table, ..) if table == "robots" => unpriced(tx, Some(&done.key)),
            Self::Table(table, ..) if table == "robots" => unpriced(tx, None),
            Self::Close(close) => {
                let place = close::by_place(tx, &close.what)?;
                let word = match close::for_longer(tx, &close.what, &done.key)? {
                    None => close::open_all_the_same(tx, &close.what, &done.key)?,
                    word => word,
                };
                Ok(match (place, word) {
                    (Some(place), Some(word)) => Some(format!("{place}; {word}")),
                    (place, word) => place.or(word),
                })
            }
            Self::Open(what) => match close::shut_all_the_same(tx, what)? {
                None => close::whatever_the_hours(tx, site, what, &done.key),
                word => Ok(word),
            },
            _ => self.overridden(tx, done),
        }
    }

    /// A word about a cell that was set and does not count, since a tuning that is on says otherwise.
    fn overridden(&self, tx: &mut Tx<'_>, done: &Done) -> Result<Option<String>> {
        let (Self::Set(table, _, column, _) | Self::SetFrom([table, _, column], ..)) = self else {
            return Ok(None);
        };
        let cells = tunings::in_force(tx)?;
        let cell =
            cells.iter().find(|cell| cell.table == *table && cell.key == done.key && cell.column == *column);
        Ok(cell.map(|cell| {
            format!(
                "{table}.{}.{column} is {} while the tuning `{}` is on: what was set counts when it is off",
                done.key, cell.value, cell.tuning
            )
        }))
    }
}

/// A word about a state of a robot that has others, where no row says what changing into it or out of it costs: the one of a key, or
/// those of robots that have such rows for others of their states.
fn unpriced(tx: &mut Tx<'_>, key: Option<&str>) -> Result<Option<String>> {
    let (states, changes) = (tx.states()?, tx.changes()?);
    let is_meant = |of: &&State| match key {
        Some(key) => key.split_once('/') == Some((&of.robot, &of.state)),
        None => changes.iter().any(|change| change.robot == of.robot),
    };
    let has_others =
        |of: &&State| states.iter().any(|other| other.robot == of.robot && other.state != of.state);
    let is_priced = |of: &&State| {
        let is_of = |change: &Change| change.from_state == of.state || change.to_state == of.state;
        changes.iter().any(|change| change.robot == of.robot && is_of(change))
    };
    let unpriced = states.iter().filter(is_meant).filter(has_others).filter(|of| !is_priced(of));
    let named: Vec<String> =
        unpriced.map(|of| format!("{} to change into {} and out of it", of.robot, of.state)).collect();
    Ok((!named.is_empty()).then(|| {
        let named = named.join(", nor ");
        format!("no row of changes says what it costs {named}: rules alone say it, the shipped ones that it costs nothing")
    }))
}

/// That a cell is another one by now: who made it so, and when.
fn conflict(tx: &mut Tx<'_>, (table, done, column): (&str, &Done, &str)) -> Result<Error> {
    // the entry of the edit that is about to be taken back is the newest one
    let before = tx.history_before(Some(done.id), 1_000)?;
    let last = before.into_iter().find(|edit| {
        edit.table == table && edit.key == done.key && edit.column.as_deref().is_none_or(|of| of == column)
    });
    let by = last.map_or_else(String::new, |edit| format!(", set by {} at {}", edit.who, edit.at));
    let message = format!("{table}.{}.{column} is {} by now{by}", done.key, done.old);
    Ok(Error::said(
        Code::EditConflict,
        message,
        Some("look at the present value, then set it again".to_owned()),
    ))
}
