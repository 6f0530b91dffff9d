//! Which tables a site's database has, and how a row of each is known: read from SQLite itself, so that a column more is one more
//! in PostgreSQL, too.

use std::collections::BTreeMap;
use std::path::Path;
use std::sync::OnceLock;

use sqlx::{Connection, Row, SqliteConnection};

use super::changes::Object;
use crate::dynamic::identifier;
use crate::error::Result;
use crate::migrate::{self, STEPS, Step};

/// Tables that follow from others, or are the same in every database: each copy has its own.
const OF_EACH_COPY: [&str; 4] = ["blocks", "octets", "step_parts", "writer"];

/// What a column of a table of ours holds besides NULL.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Kind {
    Integer,
    Real,
    Text,
    Blob,
    /// Values of any type: in PostgreSQL a text of JSON.
    Any,
}

impl Kind {
    fn of(declared: &str) -> Self {
        match declared {
            "INTEGER" | "INT" => Self::Integer,
            "REAL" => Self::Real,
            "TEXT" => Self::Text,
            "BLOB" => Self::Blob,
            _ => Self::Any,
        }
    }

    /// The type in PostgreSQL.
    pub(super) fn declared(self) -> &'static str {
        match self {
            Self::Integer => "bigint",
            Self::Real => "double precision",
            Self::Text | Self::Any => "text",
            Self::Blob => "bytea",
        }
    }
}

#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Column {
    pub name: String,
    pub kind: Kind,
    pub required: bool,
}

/// A table whose rows are shared.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Table {
    pub name: String,
    /// Whether it is ours, and so a table of PostgreSQL as well.
    pub ours: bool,
    pub columns: Vec<Column>,
    /// The columns of the key; of somebody's own table that has none the name of the row's number.
    pub key: Vec<String>,
    /// Other columns by which rows are found.
    pub indexes: Vec<Vec<String>>,
}

impl Table {
    /// The columns that are read: all of them, and of somebody's own table its key before.
    pub(super) fn read(&self) -> Vec<&str> {
        let columns = self.columns.iter().map(|column| column.name.as_str());
        let key = self.key.iter().filter(|_| !self.ours).map(String::as_str);
        key.chain(columns).collect()
    }

    /// How many values of the key stand before a row's columns.
    pub(super) fn before(&self) -> usize {
        if self.ours { 0 } else { self.key.len() }
    }

    /// The names, each quoted, behind a name of the table.
    pub(super) fn list<'n>(of: &str, names: impl IntoIterator<Item = &'n str>) -> String {
        let one = |name: &str| format!("{of}{}", identifier(name));
        names.into_iter().map(one).collect::<Vec<_>>().join(", ")
    }

    pub(super) fn kind(&self, name: &str) -> Kind {
        self.columns.iter().find(|column| column.name == name).map_or(Kind::Integer, |column| column.kind)
    }
}

/// What a database of ours has before anybody makes anything of their own in it.
#[derive(Clone, Debug, Default)]
pub(super) struct Template {
    pub tables: BTreeMap<String, Table>,
    names: Vec<(String, String)>,
    worlds: bool,
    /// What leads to its version.
    steps: &'static [Step],
}

impl Template {
    /// Of the newest version; `worlds`: of a database that keeps worlds. To make one goes through all versions that there were: it
    /// is done once.
    pub(super) async fn new(worlds: bool) -> Result<Self> {
        static KNOWN: [OnceLock<Template>; 2] = [const { OnceLock::new() }; 2];
        let known = &KNOWN[usize::from(worlds)];
        if let Some(known) = known.get() {
            return Ok(known.clone());
        }
        let made = Self::of(STEPS, worlds).await?;
        Ok(known.get_or_init(|| made).clone())
    }

    /// Of the version to which these steps lead.
    pub(super) async fn of(steps: &'static [Step], worlds: bool) -> Result<Self> {
        let mut empty = SqliteConnection::connect("sqlite::memory:").await?;
        let none = Self { tables: BTreeMap::new(), names: Vec::new(), worlds, steps };
        none.make(&mut empty, Path::new("")).await?;
        let sql = "SELECT type, name FROM sqlite_schema";
        let names = sqlx::query_as(sql).fetch_all(&mut empty).await?;
        let tables = none.described(&mut empty, true).await?;
        empty.close().await?;
        Ok(Self { tables, names, ..none })
    }

    /// Makes of a new database one of its version.
    pub(super) async fn make(&self, connection: &mut SqliteConnection, file: &Path) -> Result<()> {
        migrate::migrate(connection, file, self.steps).await?;
        if self.worlds { migrate::keep_worlds(connection, file, self.steps).await } else { Ok(()) }
    }

    /// The tables of a database whose rows are shared.
    pub(super) async fn tables_of(
        &self,
        connection: &mut SqliteConnection,
    ) -> Result<BTreeMap<String, Table>> {
        self.described(connection, false).await
    }

    async fn described(
        &self,
        connection: &mut SqliteConnection,
        all_ours: bool,
    ) -> Result<BTreeMap<String, Table>> {
        let sql = "SELECT name, wr, strict FROM pragma_table_list
                   WHERE schema = 'main' AND type = 'table' AND name NOT LIKE 'sqlite\\_%' ESCAPE '\\'";
        let listed: Vec<(String, bool, bool)> = sqlx::query_as(sql).fetch_all(&mut *connection).await?;
        let mut tables = BTreeMap::new();
        for (name, without_rowid, strict) in listed {
            if OF_EACH_COPY.contains(&name.as_str()) {
                continue;
            }
            let known = self.tables.get(&name);
            let table = match known.filter(|known| known.ours && strict) {
                Some(known) => known.clone(),
                None => describe(connection, name.clone(), strict && all_ours, without_rowid).await?,
            };
            tables.insert(name, table);
        }
        Ok(tables)
    }

    /// What somebody made in a database: tables first, in an order that makes all of it anew.
    pub(super) async fn objects(&self, connection: &mut SqliteConnection) -> Result<Vec<Object>> {
        let sql = "SELECT type, name, tbl_name, sql FROM sqlite_schema
                   WHERE sql IS NOT NULL AND name NOT LIKE 'sqlite\\_%' ESCAPE '\\' AND type <> 'virtual'";
        let rows = sqlx::query(sql).fetch_all(connection).await?;
        let mut objects = Vec::new();
        for row in rows {
            let (kind, name): (String, String) = (row.try_get(0)?, row.try_get(1)?);
            if self.names.iter().any(|known| (&known.0, &known.1) == (&kind, &name)) {
                continue;
            }
            objects.push(Object { kind, name, table: row.try_get(2)?, sql: row.try_get(3)? });
        }
        Self::order(&mut objects);
        Ok(objects)
    }

    /// Has tables come before what is made of them.
    pub(super) fn order(objects: &mut [Object]) {
        let place = |of: &Object| ["table", "index", "view"].iter().position(|kind| of.kind == *kind);
        objects.sort_by_cached_key(|of| (place(of).unwrap_or(3), of.name.clone()));
    }

    /// Whether it is that of a database that keeps worlds.
    pub(super) fn keeps_worlds(&self) -> bool {
        self.worlds
    }
}

async fn describe(
    connection: &mut SqliteConnection,
    name: String,
    may_be_ours: bool,
    without_rowid: bool,
) -> Result<Table> {
    let sql = "SELECT name, type, \"notnull\", pk FROM pragma_table_xinfo(?) WHERE hidden = 0 ORDER BY cid";
    let rows: Vec<(String, String, bool, i64)> =
        sqlx::query_as(sql).bind(&name).fetch_all(&mut *connection).await?;
    let mut key: Vec<(i64, String)> =
        rows.iter().filter(|(.., key)| *key > 0).map(|(column, _, _, key)| (*key, column.clone())).collect();
    key.sort();
    let mut key: Vec<String> = key.into_iter().map(|(_, column)| column).collect();
    let ours = may_be_ours && !key.is_empty();
    if !ours && !without_rowid {
        let is_free = |name: &&str| !rows.iter().any(|(column, ..)| column.eq_ignore_ascii_case(name));
        key = ["rowid", "_rowid_", "oid"].into_iter().filter(is_free).take(1).map(str::to_owned).collect();
    }
    let columns = rows.into_iter().map(|(name, declared, required, _)| Column {
        name,
        kind: Kind::of(&declared),
        required,
    });
    let columns = columns.collect();
    let indexes = if ours { indexes(connection, &name).await? } else { Vec::new() };
    Ok(Table { name, ours, columns, key, indexes })
}

/// The columns of indexes that somebody made for a table, but for those of its key.
async fn indexes(connection: &mut SqliteConnection, table: &str) -> Result<Vec<Vec<String>>> {
    let sql =
        "SELECT name FROM pragma_index_list(?) WHERE origin IN ('c', 'u') AND partial = 0 ORDER BY name";
    let names: Vec<String> = sqlx::query_scalar(sql).bind(table).fetch_all(&mut *connection).await?;
    let mut indexes = Vec::new();
    for name in names {
        let sql = "SELECT name FROM pragma_index_xinfo(?) WHERE key = 1 ORDER BY seqno";
        let columns: Vec<Option<String>> =
            sqlx::query_scalar(sql).bind(&name).fetch_all(&mut *connection).await?;
        // one over an expression has no names
        if let Some(columns) = columns.into_iter().collect::<Option<Vec<_>>>() {
            indexes.push(columns);
        }
    }
    Ok(indexes)
}
