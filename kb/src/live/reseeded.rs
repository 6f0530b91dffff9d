//! What a build that takes tables from their files again replaces in them, written down as an edit, so that it can be taken
//! back like one.

use std::collections::BTreeMap;

use adit_db::Tx;
use adit_db::cell::Cell;
use adit_db::history::Author;
use adit_db::relation::Relation;

use crate::error::Result;
use crate::words::number::counted;

/// Tables as they were before; those that name rows of others come before these.
pub struct Held(Vec<Kept>);

/// A table, and its rows as the history keeps them.
type Kept = (Relation, Vec<Cell>);

impl Held {
    /// Those of the tables that are there.
    pub fn of(tx: &mut Tx<'_>, tables: &[&str]) -> Result<Self> {
        let known: Vec<String> = tx.relations()?.into_iter().map(|relation| relation.name).collect();
        let is_meant = |name: &&String| tables.iter().any(|table| table.eq_ignore_ascii_case(name));
        let place = |name: &&String| tables.iter().position(|table| table.eq_ignore_ascii_case(name));
        let mut names: Vec<&String> = known.iter().filter(is_meant).collect();
        names.sort_by_key(place);
        Ok(Self(names.into_iter().map(|name| kept(tx, name)).collect::<Result<_>>()?))
    }

    /// Writes down what is otherwise by now; a word about it.
    pub fn record(&self, tx: &mut Tx<'_>, author: &Author) -> Result<Vec<String>> {
        let (mut notes, mut both) = (Vec::new(), Vec::new());
        for old in &self.0 {
            let new = kept(tx, &old.0.name)?;
            if is_alike(&old.0, &new.0) {
                both.push((old, new));
            } else {
                notes.push(format!(
                    "the table {} has other columns than before: what was edited in it cannot be taken back",
                    old.0.name
                ));
            }
        }
        let mut written = Vec::new();
        for (old, new) in &both {
            for (key, row) in gone(old, new) {
                written.push(tx.record((&old.0.name, &key, None), (row, &Cell::Null), author)?);
            }
        }
        for ((old, _), (new, _)) in &both {
            let rows = by_key(new);
            for (key, was) in by_key(old) {
                let Some(&is) = rows.get(&key) else { continue };
                for (before, after) in old.columns.iter().zip(&new.columns) {
                    let (before, after, column) = (&before.values[was], &after.values[is], &before.name);
                    if before != after {
                        let cell = (old.name.as_str(), key.as_str(), Some(column.as_str()));
                        written.push(tx.record(cell, (before, after), author)?);
                    }
                }
            }
        }
        for (old, new) in both.iter().rev() {
            for (key, row) in gone(new, old) {
                written.push(tx.record((&old.0.name, &key, None), (&Cell::Null, row), author)?);
            }
        }
        if let Some(last) = written.last() {
            notes.push(format!(
                "what the files replaced is in the history, {}: undo {last} brings it back",
                counted(written.len(), "change")
            ));
        }
        Ok(notes)
    }
}

/// Whether two tables have the same columns, and a key by which their rows are found again.
fn is_alike(one: &Relation, other: &Relation) -> bool {
    let column = |of: &Relation| -> Vec<(String, i64)> {
        of.columns.iter().map(|column| (column.name.clone(), column.key)).collect()
    };
    one.columns.iter().any(|column| column.key > 0) && column(one) == column(other)
}

/// The rows by their whole key, its parts joined by `/`.
fn by_key(table: &Relation) -> BTreeMap<String, usize> {
    let mut keys: Vec<_> = table.columns.iter().filter(|column| column.key > 0).collect();
    keys.sort_by_key(|column| column.key);
    let count = table.columns.first().map_or(0, |column| column.values.len());
    let key =
        |row: usize| keys.iter().map(|column| column.values[row].to_string()).collect::<Vec<_>>().join("/");
    (0..count).map(|row| (key(row), row)).collect()
}

/// The rows of a table that another one has not, by key.
fn gone<'k>((table, rows): &'k Kept, (other, _): &Kept) -> Vec<(String, &'k Cell)> {
    let others = by_key(other);
    let gone = by_key(table).into_iter().filter(|(key, _)| !others.contains_key(key));
    gone.filter_map(|(key, row)| Some((key, rows.get(row)?))).collect()
}

fn kept(tx: &mut Tx<'_>, table: &str) -> Result<Kept> {
    Ok((tx.read_table(table)?, tx.rows_as_kept(table)?))
}
