//! Who changed what, when and why: the table `history`.

use serde::Serialize;
use sqlx::sqlite::SqliteRow;
use sqlx::{Row, SqliteConnection};

use crate::cell::Cell;
use crate::dynamic;
use crate::error::Result;
use crate::transaction::Tx;

/// Who edits, and why.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Author {
    /// Who.
    pub who: String,
    /// Why; may be empty.
    pub why: String,
}

/// An edit that was made.
#[derive(Clone, Debug, PartialEq, Serialize, utoipa::ToSchema)]
#[schema(as = HistoryEntry)]
pub struct Edit {
    /// Its number, ascending in time.
    pub id: i64,
    /// When, in UTC.
    pub at: String,
    /// Who.
    pub who: String,
    /// Why.
    pub why: String,
    /// The table.
    pub table: String,
    /// The row's key, its columns joined by `/`.
    pub key: String,
    /// The column; `None` where a whole row came or went.
    pub column: Option<String>,
    /// The value before, or the row that went, as JSON.
    #[schema(value_type = Value)]
    pub old: Cell,
    /// The value after, or the row that came, as JSON.
    #[schema(value_type = Value)]
    pub new: Cell,
    /// The edit that took this one back.
    pub undone: Option<i64>,
    /// The first of those that were made together with it: in one transaction.
    pub change_set: i64,
}

/// What an edit did, before it has a number.
pub(crate) struct Entry<'e> {
    pub table: &'e str,
    pub key: &'e str,
    pub column: Option<&'e str>,
    pub old: &'e Cell,
    pub new: &'e Cell,
}

/// Writes an entry; its number.
pub(crate) async fn record(
    connection: &mut SqliteConnection,
    author: &Author,
    entry: &Entry<'_>,
) -> Result<i64> {
    let sql = "INSERT INTO history (who, why, table_name, key, column_name, old, new) \
               VALUES (?, ?, ?, ?, ?, ?, ?)";
    let column = entry.column.map_or(Cell::Null, Cell::from);
    let texts = [&author.who, &author.why].map(|text| Cell::from(text.as_str()));
    let [who, why] = texts;
    let values =
        [who, why, entry.table.into(), entry.key.into(), column, entry.old.clone(), entry.new.clone()];
    dynamic::execute(connection, sql.to_owned(), &values).await?;
    Ok(sqlx::query_scalar("SELECT last_insert_rowid()").fetch_one(connection).await?)
}

fn edit(row: &SqliteRow) -> Result<Edit> {
    Ok(Edit {
        id: row.try_get(0)?,
        at: row.try_get(1)?,
        who: row.try_get(2)?,
        why: row.try_get(3)?,
        table: row.try_get(4)?,
        key: row.try_get(5)?,
        column: row.try_get(6)?,
        old: Cell::of(row, 7)?,
        new: Cell::of(row, 8)?,
        undone: row.try_get(9)?,
        change_set: row.try_get(10)?,
    })
}

/// Edits, the newest first; at most `most`.
pub async fn read(connection: &mut SqliteConnection, most: u32) -> Result<Vec<Edit>> {
    before(connection, None, most).await
}

/// Edits before one of a number, the newest first; at most `most`.
pub async fn before(connection: &mut SqliteConnection, before: Option<i64>, most: u32) -> Result<Vec<Edit>> {
    let query = sqlx::query(
        "SELECT id, at, who, why, table_name, key, column_name, old, new, undone, coalesce(change_set, id) FROM history
         WHERE ?1 IS NULL OR id < ?1 ORDER BY id DESC LIMIT ?2",
    );
    query.bind(before).bind(most).fetch_all(connection).await?.iter().map(edit).collect()
}

/// One edit.
pub async fn entry(connection: &mut SqliteConnection, id: i64) -> Result<Option<Edit>> {
    let query = sqlx::query(
        "SELECT id, at, who, why, table_name, key, column_name, old, new, undone, coalesce(change_set, id) FROM history WHERE id = ?",
    );
    query.bind(id).fetch_optional(connection).await?.as_ref().map(edit).transpose()
}

/// Those that were made together with one, and it itself, in their order.
pub async fn together(connection: &mut SqliteConnection, id: i64) -> Result<Vec<Edit>> {
    let query = sqlx::query(
        "SELECT id, at, who, why, table_name, key, column_name, old, new, undone, coalesce(change_set, id) FROM history
         WHERE change_set = (SELECT change_set FROM history WHERE id = ?1) OR id = ?1 ORDER BY id",
    );
    query.bind(id).fetch_all(connection).await?.iter().map(edit).collect()
}

/// Edits of what one table name stands for, of one key where one is said; the newest first.
pub async fn about(connection: &mut SqliteConnection, table: &str, key: Option<&str>) -> Result<Vec<Edit>> {
    let query = sqlx::query(
        "SELECT id, at, who, why, table_name, key, column_name, old, new, undone, coalesce(change_set, id) FROM history
         WHERE table_name = ?1 AND (?2 IS NULL OR key = ?2) ORDER BY id DESC",
    );
    query.bind(table).bind(key).fetch_all(connection).await?.iter().map(edit).collect()
}

/// Says of one edit which other one took it back.
pub(crate) async fn mark_undone(connection: &mut SqliteConnection, id: i64, by: i64) -> Result<()> {
    // what it took back itself is in force again
    sqlx::query("UPDATE history SET undone = NULL WHERE undone = ?")
        .bind(id)
        .execute(&mut *connection)
        .await?;
    let mark = sqlx::query("UPDATE history SET undone = ? WHERE id = ?").bind(by).bind(id);
    mark.execute(connection).await?;
    Ok(())
}

/// Marks the edits of a row that came after one, and whose row went when that was taken back: they are taken back with it.
pub(crate) async fn mark_gone(
    connection: &mut SqliteConnection,
    (table, key): (&str, &str),
    (after, by): (i64, i64),
) -> Result<()> {
    let mark = sqlx::query(
        "UPDATE history SET undone = ?1 WHERE table_name = ?2 AND key = ?3 AND id > ?4 AND id < ?1 AND undone IS NULL
         AND id NOT IN (SELECT undone FROM history WHERE undone IS NOT NULL)",
    );
    mark.bind(by).bind(table).bind(key).bind(after).execute(connection).await?;
    Ok(())
}

/// Joins what was written since the last transaction to a change set.
pub(crate) async fn join(connection: &mut SqliteConnection) -> Result<()> {
    let sql = "UPDATE history SET change_set = (SELECT min(id) FROM history WHERE change_set IS NULL)
               WHERE change_set IS NULL";
    sqlx::query(sql).execute(connection).await?;
    Ok(())
}

/// The newest edit after one, of the same, that is neither taken back nor takes one back.
pub async fn later(connection: &mut SqliteConnection, edit: &Edit) -> Result<Option<i64>> {
    let query = sqlx::query_scalar(
        "SELECT max(id) FROM history WHERE id > ? AND table_name = ? AND key = ? AND column_name IS ? AND undone IS NULL
         AND id NOT IN (SELECT undone FROM history WHERE undone IS NOT NULL)",
    );
    Ok(query.bind(edit.id).bind(&edit.table).bind(&edit.key).bind(&edit.column).fetch_one(connection).await?)
}

/// The newest `most` edits that are neither taken back nor take one back: what undo undoes, in this order.
pub async fn undoable(connection: &mut SqliteConnection, most: u32) -> Result<Vec<i64>> {
    let query = sqlx::query_scalar(
        "SELECT id FROM history WHERE undone IS NULL
         AND id NOT IN (SELECT undone FROM history WHERE undone IS NOT NULL) ORDER BY id DESC LIMIT ?",
    );
    Ok(query.bind(most).fetch_all(connection).await?)
}

impl Tx<'_> {
    /// Writes down the edit of something that is no row, as a file is, under the name of its kind in place of a table's; its
    /// number.
    pub fn record(
        &mut self,
        (kind, name, part): (&str, &str, Option<&str>),
        (old, new): (&Cell, &Cell),
        author: &Author,
    ) -> Result<i64> {
        let entry = Entry { table: kind, key: name, column: part, old, new };
        self.run(async |connection| record(connection, author, &entry).await)
    }

    /// Says of one edit which other one took it back.
    pub fn mark_undone(&mut self, id: i64, by: i64) -> Result<()> {
        self.run(async |connection| mark_undone(connection, id, by).await)
    }

    /// One edit.
    pub fn entry(&mut self, id: i64) -> Result<Option<Edit>> {
        self.run(async |connection| entry(connection, id).await)
    }

    /// Edits of what one table name stands for, of one key where one is said; the newest first.
    pub fn history_of(&mut self, table: &str, key: Option<&str>) -> Result<Vec<Edit>> {
        self.run(async |connection| about(connection, table, key).await)
    }

    /// Edits, the newest first; at most `most`.
    pub fn history(&mut self, most: u32) -> Result<Vec<Edit>> {
        self.run(async |connection| read(connection, most).await)
    }

    /// Edits before one of a number, the newest first; at most `most`.
    pub fn history_before(&mut self, id: Option<i64>, most: u32) -> Result<Vec<Edit>> {
        self.run(async |connection| before(connection, id, most).await)
    }

    /// Those that were made together with one, and it itself, in their order.
    pub fn made_together(&mut self, id: i64) -> Result<Vec<Edit>> {
        self.run(async |connection| together(connection, id).await)
    }

    /// The newest `most` edits that are neither taken back nor take one back: what undo undoes, in this order.
    pub fn undoable(&mut self, most: u32) -> Result<Vec<i64>> {
        self.run(async |connection| undoable(connection, most).await)
    }
}
