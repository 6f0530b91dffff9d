//! What a transaction changes in a copy of a site, noted by triggers of this connection alone; and how the changes of others are
//! put into it.

use std::collections::{BTreeMap, BTreeSet};

use sqlx::{Row, SqliteConnection};

use super::changes::{Changes, Object, Rows};
use super::tables::{Table, Template};
use crate::cell::Cell;
use crate::dynamic::{self, identifier, literal};
use crate::error::Result;
use crate::guard;

/// Before the name of a table: where the keys of its changed rows are noted.
const NOTED: &str = "adit_changed_";

/// Values bound in one statement.
const VALUES: usize = 4_000;

/// The tables of a copy, and what of its schema is known.
pub(super) struct Capture {
    template: Template,
    tables: BTreeMap<String, Table>,
    objects: Vec<Object>,
    sequences: Vec<(String, i64)>,
    schema: i64,
}

/// What is known of a copy once a transaction is committed.
pub(super) struct Known {
    tables: BTreeMap<String, Table>,
    objects: Vec<Object>,
    sequences: Vec<(String, i64)>,
    schema: i64,
}

impl Capture {
    /// Notes from now on what this connection changes.
    pub(super) async fn begin(connection: &mut SqliteConnection, template: Template) -> Result<Self> {
        run(connection, "PRAGMA temp_store = MEMORY").await?;
        let tables = template.tables_of(connection).await?;
        let objects = template.objects(connection).await?;
        let mut capture =
            Self { template, tables, objects, sequences: sequences(connection).await?, schema: 0 };
        for table in capture.tables.values() {
            watch(connection, table).await?;
        }
        capture.schema = schema(connection).await?;
        Ok(capture)
    }

    /// What the open transaction has changed so far, and what is known once it is committed.
    pub(super) async fn changes(&self, connection: &mut SqliteConnection) -> Result<(Changes, Known)> {
        let mut changes = Changes::default();
        let schema = schema(connection).await?;
        let (mut tables, mut objects) = (self.tables.clone(), self.objects.clone());
        if schema != self.schema {
            tables = self.template.tables_of(connection).await?;
            objects = self.template.objects(connection).await?;
            let watched = watched(connection).await?;
            for table in tables.values() {
                let is_watched = watched.contains(&table.name);
                if is_watched && self.tables.get(&table.name) == Some(table) {
                    continue;
                }
                if !is_watched {
                    watch(connection, table).await?;
                }
                let rows = Rows {
                    whole: true,
                    gone: Vec::new(),
                    now: all(connection, table).await?,
                    key: table.before(),
                };
                changes.tables.insert(table.name.clone(), rows);
            }
        }
        for name in noted(connection, self.tables.keys()).await? {
            let Some(table) = tables.get(&name).filter(|table| !changes.tables.contains_key(&table.name))
            else {
                continue;
            };
            changes.tables.insert(name, changed(connection, table).await?);
        }
        let sequences = sequences(connection).await?;
        changes.objects = (objects != self.objects).then(|| objects.clone());
        changes.sequences = (sequences != self.sequences).then(|| sequences.clone());
        let schema = self::schema(connection).await?;
        Ok((changes, Known { tables, objects, sequences, schema }))
    }

    /// What was changed is committed: the next transaction begins with nothing noted.
    pub(super) fn accept(&mut self, known: Known) {
        (self.tables, self.objects) = (known.tables, known.objects);
        (self.sequences, self.schema) = (known.sequences, known.schema);
    }

    /// Forgets what is noted.
    pub(super) async fn forget(&self, connection: &mut SqliteConnection) -> Result<()> {
        for name in noted(connection, self.tables.keys()).await? {
            run(connection, &format!("DELETE FROM temp.{}", identifier(&format!("{NOTED}{name}")))).await?;
        }
        Ok(())
    }

    /// Puts the changes of another service into the copy; those of tables named `but` are left out. What triggers would do is
    /// among the changes already.
    pub(super) async fn apply(
        &self,
        connection: &mut SqliteConnection,
        changes: &Changes,
        but: &str,
    ) -> Result<()> {
        run(connection, "PRAGMA defer_foreign_keys = ON").await?;
        quietly(connection, async |connection| {
            let mut tables = self.tables.clone();
            if let Some(objects) = &changes.objects {
                self.make(connection, objects, changes).await?;
                tables = self.template.tables_of(connection).await?;
            }
            let changed = || changes.tables.iter().filter(|(name, _)| *name != but);
            let of = |name: &str| {
                tables.get(name).ok_or_else(|| crate::error::Error::UnknownTable(name.to_owned()))
            };
            for (name, rows) in changed() {
                let table = of(name)?;
                if rows.whole {
                    run(connection, &format!("DELETE FROM main.{}", identifier(name))).await?;
                }
                remove(connection, table, &rows.gone).await?;
                if !table.ours {
                    let keys: Vec<Vec<Cell>> =
                        rows.now.iter().map(|row| row[..table.key.len().min(row.len())].to_vec()).collect();
                    remove(connection, table, &keys).await?;
                }
            }
            for (name, rows) in changed() {
                put(connection, of(name)?, &rows.now).await?;
                if ["rooms", "doors"].contains(&name.as_str()) {
                    // they are these rows once more, and were written of others
                    run(connection, &format!("DELETE FROM blocks WHERE class = {}", literal(name))).await?;
                }
            }
            if let Some(sequences) = &changes.sequences {
                number(connection, sequences).await?;
            }
            if let Some(objects) = &changes.objects {
                let there = self.template.objects(connection).await?;
                for object in objects.iter().filter(|object| !there.contains(object)) {
                    run(connection, &object.sql).await?;
                }
            }
            Ok(())
        })
        .await
    }

    /// Takes away what is not among the objects any more, or is another now, and makes the tables that are missing.
    async fn make(
        &self,
        connection: &mut SqliteConnection,
        objects: &[Object],
        changes: &Changes,
    ) -> Result<()> {
        let there = self.template.objects(connection).await?;
        let is_kept = |object: &Object| {
            let rows = changes.tables.get(&object.name).filter(|_| object.kind == "table");
            objects.contains(object) && rows.is_none_or(|rows| !rows.whole)
        };
        for object in there.iter().rev().filter(|object| !is_kept(object)) {
            let sql = format!("DROP {} IF EXISTS main.{}", object.kind, identifier(&object.name));
            run(connection, &sql).await?;
        }
        let there = self.template.objects(connection).await?;
        for table in objects.iter().filter(|object| object.kind == "table" && !there.contains(object)) {
            run(connection, &table.sql).await?;
        }
        Ok(())
    }

    /// What is known of the copy after it took changes of others.
    pub(super) async fn look(&mut self, connection: &mut SqliteConnection) -> Result<()> {
        let schema = schema(connection).await?;
        if schema != self.schema {
            self.tables = self.template.tables_of(connection).await?;
            self.objects = self.template.objects(connection).await?;
            let watched = watched(connection).await?;
            for table in self.tables.values().filter(|table| !watched.contains(&table.name)) {
                watch(connection, table).await?;
            }
            self.schema = self::schema(connection).await?;
        }
        self.sequences = sequences(connection).await?;
        Ok(())
    }
}

/// All that is in a database, as one change that makes it of an empty one.
pub(super) async fn everything(connection: &mut SqliteConnection, template: &Template) -> Result<Changes> {
    let mut changes = Changes::default();
    for (name, table) in template.tables_of(connection).await? {
        let rows =
            Rows { whole: true, gone: Vec::new(), now: all(connection, &table).await?, key: table.before() };
        changes.tables.insert(name, rows);
    }
    changes.objects = Some(template.objects(connection).await?);
    changes.sequences = Some(sequences(connection).await?);
    Ok(changes)
}

/// Makes of a new database what a change holds that [`everything`] made.
pub(super) async fn fill(
    connection: &mut SqliteConnection,
    template: Template,
    changes: &Changes,
) -> Result<()> {
    let tables = template.tables_of(connection).await?;
    let none = Capture { template, tables, objects: Vec::new(), sequences: Vec::new(), schema: 0 };
    none.apply(connection, changes, "").await
}

/// Does something while triggers of the database itself are off.
async fn quietly<T>(
    connection: &mut SqliteConnection,
    work: impl AsyncFnOnce(&mut SqliteConnection) -> Result<T>,
) -> Result<T> {
    guard::fire_triggers(&mut connection.lock_handle().await?, false);
    let done = work(connection).await;
    guard::fire_triggers(&mut connection.lock_handle().await?, true);
    done
}

async fn run(connection: &mut SqliteConnection, sql: &str) -> Result<()> {
    dynamic::execute(connection, sql.to_owned(), &[]).await.map(drop)
}

async fn schema(connection: &mut SqliteConnection) -> Result<i64> {
    Ok(sqlx::query_scalar("PRAGMA main.schema_version").fetch_one(connection).await?)
}

async fn sequences(connection: &mut SqliteConnection) -> Result<Vec<(String, i64)>> {
    let sql = "SELECT name, CAST(seq AS INTEGER) FROM sqlite_sequence WHERE name IS NOT NULL ORDER BY name";
    Ok(sqlx::query_as(sql).fetch_all(connection).await?)
}

async fn number(connection: &mut SqliteConnection, sequences: &[(String, i64)]) -> Result<()> {
    run(connection, "DELETE FROM sqlite_sequence").await?;
    for (name, last) in sequences {
        let sql = "INSERT INTO sqlite_sequence (name, seq) VALUES (?, ?)";
        sqlx::query(sql).bind(name).bind(last).execute(&mut *connection).await?;
    }
    Ok(())
}

/// Has triggers of this connection note the keys of rows that change. A key may be noted twice: an outer `OR ABORT` would make an
/// error of a key that must be there once.
async fn watch(connection: &mut SqliteConnection, table: &Table) -> Result<()> {
    let noted = identifier(&format!("{NOTED}{}", table.name));
    let columns: Vec<String> = (0..table.key.len()).map(|at| format!("k{at}")).collect();
    run(connection, &format!("CREATE TEMP TABLE IF NOT EXISTS {noted} ({})", columns.join(", "))).await?;
    for (event, rows) in [("insert", &["NEW"][..]), ("update", &["OLD", "NEW"]), ("delete", &["OLD"])] {
        let note = |row: &&str| {
            let key = Table::list(&format!("{row}."), table.key.iter().map(String::as_str));
            format!("INSERT INTO {noted} VALUES ({key});")
        };
        let body: String = rows.iter().map(note).collect();
        let name = identifier(&format!("{NOTED}{event}_{}", table.name));
        let on = identifier(&table.name);
        run(connection, &format!("CREATE TEMP TRIGGER {name} AFTER {event} ON main.{on} BEGIN {body} END"))
            .await?;
    }
    Ok(())
}

/// The tables whose changes are noted: with a table its triggers go.
async fn watched(connection: &mut SqliteConnection) -> Result<BTreeSet<String>> {
    let sql = "SELECT tbl_name FROM sqlite_temp_schema WHERE type = 'trigger'";
    Ok(sqlx::query_scalar::<_, String>(sql).fetch_all(connection).await?.into_iter().collect())
}

/// The tables of which something is noted.
async fn noted<'n>(
    connection: &mut SqliteConnection,
    tables: impl Iterator<Item = &'n String>,
) -> Result<Vec<String>> {
    let one = |name: &String| {
        let noted = identifier(&format!("{NOTED}{name}"));
        format!("SELECT {} WHERE EXISTS (SELECT 1 FROM temp.{noted})", literal(name))
    };
    let sql: Vec<String> = tables.map(one).collect();
    let mut names = Vec::new();
    for some in sql.chunks(100) {
        let rows = dynamic::fetch(connection, some.join(" UNION ALL "), &[]).await?;
        for row in rows {
            names.push(row.try_get(0)?);
        }
    }
    Ok(names)
}

/// The rows of a table that are noted.
async fn changed(connection: &mut SqliteConnection, table: &Table) -> Result<Rows> {
    let noted = identifier(&format!("{NOTED}{}", table.name));
    let name = identifier(&table.name);
    let same = |at: usize, key: &String| format!("t.{} = c.k{at}", identifier(key));
    let on = table.key.iter().enumerate().map(|(at, key)| same(at, key)).collect::<Vec<_>>().join(" AND ");
    let keys = (0..table.key.len()).map(|at| format!("k{at}")).collect::<Vec<_>>().join(", ");
    let once = format!("(SELECT DISTINCT {keys} FROM temp.{noted}) AS c");
    let gone =
        format!("SELECT {keys} FROM {once} WHERE NOT EXISTS (SELECT 1 FROM main.{name} AS t WHERE {on})");
    let now =
        format!("SELECT {} FROM {once} CROSS JOIN main.{name} AS t ON {on}", Table::list("t.", table.read()));
    Ok(Rows {
        whole: false,
        gone: rows(connection, gone).await?,
        now: rows(connection, now).await?,
        key: table.before(),
    })
}

/// All rows of a table, by their keys.
async fn all(connection: &mut SqliteConnection, table: &Table) -> Result<Vec<Vec<Cell>>> {
    let (columns, key) =
        (Table::list("", table.read()), Table::list("", table.key.iter().map(String::as_str)));
    rows(connection, format!("SELECT {columns} FROM main.{} ORDER BY {key}", identifier(&table.name))).await
}

async fn rows(connection: &mut SqliteConnection, sql: String) -> Result<Vec<Vec<Cell>>> {
    let rows = dynamic::fetch(connection, sql, &[]).await?;
    rows.iter().map(|row| (0..row.len()).map(|at| Cell::of(row, at)).collect()).collect()
}

/// Takes rows away by their keys.
async fn remove(connection: &mut SqliteConnection, table: &Table, keys: &[Vec<Cell>]) -> Result<()> {
    let most = (VALUES / table.key.len().max(1)).max(1);
    for some in keys.chunks(most) {
        let key = Table::list("", table.key.iter().map(String::as_str));
        let sql = format!(
            "DELETE FROM main.{} WHERE ({key}) IN (VALUES {})",
            identifier(&table.name),
            holes(table.key.len(), some.len())
        );
        dynamic::execute(connection, sql, &some.concat()).await?;
    }
    Ok(())
}

/// Puts rows in, or in the place of those of the same key.
async fn put(connection: &mut SqliteConnection, table: &Table, rows: &[Vec<Cell>]) -> Result<()> {
    let columns = table.read();
    // a key that is a column as well is said once
    let repeated = if table.ours {
        0
    } else {
        table.key.iter().filter(|key| table.columns.iter().any(|c| c.name == **key)).count()
    };
    let columns = &columns[repeated..];
    let most = (VALUES / columns.len().max(1)).max(1);
    let conflict = if table.ours {
        let set: Vec<String> = columns
            .iter()
            .filter(|name| !table.key.iter().any(|key| key == *name))
            .map(|name| format!("{0} = excluded.{0}", identifier(name)))
            .collect();
        let key = Table::list("", table.key.iter().map(String::as_str));
        let what =
            if set.is_empty() { "NOTHING".to_owned() } else { format!("UPDATE SET {}", set.join(", ")) };
        format!(" ON CONFLICT ({key}) DO {what}")
    } else {
        String::new()
    };
    for some in rows.chunks(most) {
        let sql = format!(
            "INSERT INTO main.{} ({}) VALUES {}{conflict}",
            identifier(&table.name),
            Table::list("", columns.iter().copied()),
            holes(columns.len(), some.len())
        );
        let values: Vec<Cell> = some.iter().flat_map(|row| row.iter().skip(repeated).cloned()).collect();
        dynamic::execute(connection, sql, &values).await?;
    }
    Ok(())
}

fn holes(columns: usize, rows: usize) -> String {
    let row = format!("({})", vec!["?"; columns].join(","));
    vec![row; rows].join(",")
}
