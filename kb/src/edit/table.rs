//! A table as a file has it: what differs is set, added and removed, as one edit.

use std::collections::BTreeMap;

use adit_db::Tx;
use adit_db::cell::Cell;
use adit_db::edit::Edited;
use adit_db::history::Author;
use adit_db::relation::RelationColumn;

use super::cells::{cell_of, columns, explain, gone_with, is_equal};
use crate::error::{Code, Error, Result};
use crate::knowledge::tables::version;
use crate::site::robots::ONLY_ROBOT;
use crate::site::sheet::Sheet;
use crate::words::number::counted;
use crate::words::suggest::did_you_mean;

/// So many changes are listed one by one.
const LISTED: usize = 20;

/// So many entries of the history are looked through for who edited a table.
const SEARCHED: u32 = 1_000;

/// How many cells were set, rows added and rows removed.
#[derive(Clone, Copy, Default)]
struct Count([usize; 3]);

impl Count {
    fn words(self) -> String {
        let [set, new, gone] = self.0;
        let parts = [
            (set, format!("{} set", counted(set, "cell"))),
            (new, format!("{} new", counted(new, "row"))),
            (gone, format!("{} gone", counted(gone, "row"))),
        ];
        parts
            .into_iter()
            .filter(|(count, _)| *count > 0)
            .map(|(_, words)| words)
            .collect::<Vec<_>>()
            .join(", ")
    }
}

/// Makes the rows of a table those of a file; columns that the file has not stay as they are. Nothing differs, or the table is no
/// longer of the version that the editor saw: an error.
pub(super) fn take(
    tx: &mut Tx<'_>,
    (table, seen): (&str, Option<&str>),
    sheet: &Sheet,
    author: &Author,
) -> Result<Edited> {
    let columns = columns(tx, table)?;
    if seen.is_some_and(|seen| version(&columns) != seen) {
        return Err(conflict(tx, table)?);
    }
    let file = Columns::of(table, &columns, sheet)?;
    let mut kept: BTreeMap<Vec<String>, usize> = BTreeMap::new();
    for row in 0..columns.first().map_or(0, |column| column.values.len()) {
        let key = file.keys.iter().map(|(column, _)| columns[*column].values[row].to_string()).collect();
        kept.insert(key, row);
    }
    let mut count = Count::default();
    let mut first: Option<Edited> = None;
    let mut listed: Vec<String> = Vec::new();
    let mut note = |edited: Edited, of: usize, column: Option<&str>| {
        count.0[of] += 1;
        listed.push(match (column, of) {
            (Some(column), _) => format!("  {}.{column}: {} → {}", edited.key, edited.old, edited.new),
            (None, 1) => format!("  {} is new", edited.key),
            (None, _) => format!("  {} is gone{}", edited.key, gone_with(&edited.old)),
        });
        first.get_or_insert(edited);
    };
    for (at, row) in sheet.rows.iter().enumerate() {
        let told = |error: Error| sheet.wrong(Some(at), &error.to_string(), "the table is as it was");
        let cell = |(column, place): &(usize, Option<usize>)| -> Result<(usize, Cell)> {
            let known = &columns[*column];
            // around texts blanks count, but for those of keys
            let is_text = known.declared.contains("TEXT") && known.key == 0;
            let text =
                place.map_or(ONLY_ROBOT, |place| if is_text { &row[place] } else { row[place].trim() });
            Ok((*column, cell_of(table, &known.name, text, &columns)?))
        };
        let keys = file.keys.iter().map(cell).collect::<Result<Vec<_>>>().map_err(told)?;
        let others = file.others.iter().map(cell).collect::<Result<Vec<_>>>().map_err(told)?;
        let key: Vec<String> = keys.iter().map(|(_, cell)| cell.to_string()).collect();
        let whole = key.join("/");
        let refused = |tx: &mut Tx<'_>, error: adit_db::Error| told(explain(tx, error, table, &whole, ""));
        if let Some(kept) = kept.remove(&key) {
            for (column, cell) in others {
                let known = &columns[column];
                // a file does not tell an empty text from none
                let is_empty = |cell: &Cell| *cell == Cell::Null || *cell == Cell::Text(String::new());
                let (old, is_bytes) = (&known.values[kept], matches!(known.values[kept], Cell::Blob(_)));
                let is_same = is_equal(old, &cell) || is_empty(old) && is_empty(&cell);
                if !(is_same || is_bytes) {
                    match tx.set_cell((table, &whole, &known.name), &cell, author) {
                        Ok(edited) => note(edited, 0, Some(&known.name)),
                        Err(error) => return Err(refused(tx, error)),
                    }
                }
            }
            continue;
        }
        let named = keys.into_iter().chain(others).filter(|(_, cell)| *cell != Cell::Null);
        let named: Vec<(&str, Cell)> =
            named.map(|(column, cell)| (columns[column].name.as_str(), cell)).collect();
        match tx.add_row(table, &named, author) {
            Ok(edited) => note(edited, 1, None),
            Err(error) => return Err(refused(tx, error)),
        }
    }
    // a row may have gone with another one already
    for key in kept.into_keys().map(|key| key.join("/")) {
        match tx.remove_row(table, &key, author) {
            Ok(edited) => note(edited, 2, None),
            Err(adit_db::Error::UnknownKey { .. }) => {}
            Err(error) => return Err(explain(tx, error, table, &key, "")),
        }
    }
    let more = listed.len().saturating_sub(LISTED);
    listed.truncate(LISTED);
    if more > 0 {
        listed.push(format!("  and {more} more"));
    }
    let words = [vec![count.words()], listed].concat().join("\n");
    first
        .map(|edited| Edited { key: table.to_owned(), old: Cell::Null, new: Cell::Text(words), ..edited })
        .ok_or_else(|| {
            let message = format!("the table {table} holds what {} says already", sheet.path.display());
            Error::said(Code::EditNoDifference, message, None)
        })
}

/// That a table holds other rows by now: who made it so, and when.
fn conflict(tx: &mut Tx<'_>, table: &str) -> Result<Error> {
    let last = tx.history(SEARCHED)?.into_iter().find(|edit| edit.table == table);
    let by = last.map_or_else(String::new, |edit| format!(", edited by {} at {}", edit.who, edit.at));
    let message = format!("the table {table} has changed since the file was taken for it{by}");
    let help =
        "look at what it holds, and at what the file would change of it; then take the file again".to_owned();
    Ok(Error::said(Code::EditConflict, message, Some(help)))
}

/// Which column of the table each column of the file is; of a robot that the file leaves out there is one.
struct Columns {
    keys: Vec<(usize, Option<usize>)>,
    others: Vec<(usize, Option<usize>)>,
}

impl Columns {
    fn of(table: &str, columns: &[RelationColumn], sheet: &Sheet) -> Result<Self> {
        let place = |name: &str| sheet.columns.iter().position(|known| known == name);
        let names = || columns.iter().map(|column| column.name.as_str());
        if let Some(unknown) = sheet.columns.iter().find(|name| names().all(|known| known != *name)) {
            let help = did_you_mean(unknown, names());
            let help = help.unwrap_or_else(|| format!("it has {}", names().collect::<Vec<_>>().join(", ")));
            return Err(sheet.wrong(None, &format!("table `{table}` has no column `{unknown}`"), &help));
        }
        let mut of = Self { keys: Vec::new(), others: Vec::new() };
        let mut keys: Vec<(i64, usize)> = Vec::new();
        for (at, column) in columns.iter().enumerate() {
            match (column.key, place(&column.name)) {
                (0, None) => {}
                (0, found) => of.others.push((at, found)),
                (_, None) if column.name != "robot" => {
                    let message = format!(
                        "it has no column `{}`, which is a part of the key of `{table}`",
                        column.name
                    );
                    return Err(sheet.wrong(None, &message, "each row says which object it is"));
                }
                (key, _) => keys.push((key, at)),
            }
        }
        keys.sort_unstable();
        of.keys = keys.into_iter().map(|(_, at)| (at, place(&columns[at].name))).collect();
        Ok(of)
    }
}
