//! Any table or view of the database, read whole: so the domain expert's own tables become classes.

use serde::Serialize;
use sqlx::{Row, SqliteConnection};

use crate::cell::Cell;
use crate::dynamic::{self, identifier};
use crate::error::{Error, Result};
use crate::transaction::Tx;
use crate::worlds;

/// Our own tables and views.
pub(crate) const OWN: &[&str] = &[
    "action_sequence",
    "active_tunings",
    "area_outlines",
    "attachments",
    "blocks",
    "carried_out",
    "cells_in_force",
    "changes",
    "changes_in_force",
    "conclusions",
    "course_steps",
    "course_waypoints",
    "courses",
    "derivations",
    "doors",
    "doorways",
    "drawn",
    "drawn_outlines",
    "ends",
    "facts_told",
    "frames",
    "gpkg_contents",
    "gpkg_geometry_columns",
    "gpkg_spatial_ref_sys",
    "history",
    "hours",
    "kept_routes",
    "kept_steps",
    "kept_waypoints",
    "laid",
    "laid_shapes",
    "loads",
    "loads_in_force",
    "map_areas",
    "map_doorways",
    "map_rooms",
    "map_routes",
    "map_spaces",
    "measured_routes",
    "measured_waypoints",
    "measures",
    "octets",
    "opening_hours",
    "places",
    "prime_area_strips",
    "prime_areas",
    "robots",
    "robots_in_force",
    "rooms",
    "route",
    "routes",
    "rules",
    "saved_queries",
    "site",
    "site_hours",
    "spaces",
    "stale_marks",
    "staleness",
    "starts",
    "step_parts",
    "strips",
    "told",
    "told_states",
    "traversals",
    "tree_measures",
    "tree_rows",
    "tuning_cells",
    "waypoints",
    "witnesses",
    "writer",
];

/// How rows are kept.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, utoipa::ToSchema)]
#[serde(rename_all = "lowercase")]
pub enum Form {
    /// A table.
    Table,
    /// A view.
    View,
}

/// A table or view of the user's own.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct UserTable {
    /// Its name.
    pub name: String,
    /// Table or view.
    pub form: Form,
}

/// A table or view, with the names of its columns.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, utoipa::ToSchema)]
pub struct Named {
    /// Its name.
    pub name: String,
    /// Table or view.
    pub kind: Form,
    /// Its columns.
    pub columns: Vec<String>,
}

/// A column of a [`Relation`].
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct RelationColumn {
    /// Its name.
    pub name: String,
    /// The type that it was declared with, upper case; empty where none was.
    pub declared: String,
    /// Its place in the primary key, from 1; 0 if it is no part of it.
    pub key: i64,
    /// Whether it needs a value: none is refused, and nothing stands in for it.
    pub required: bool,
    /// A value for each row.
    pub values: Vec<Cell>,
}

/// A table or view, read whole: by its key, or by all its columns where it has none.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Relation {
    /// Its name.
    pub name: String,
    /// Its columns, all of the same length.
    pub columns: Vec<RelationColumn>,
}

impl Relation {
    /// The column of this name.
    pub fn column(&self, name: &str) -> Option<&RelationColumn> {
        self.columns.iter().find(|column| column.name == name)
    }

    /// What a row has in the column of this name.
    pub fn value(&self, name: &str, row: usize) -> Option<&Cell> {
        self.column(name)?.values.get(row)
    }
}

/// A foreign key: columns that hold the key of a row of another table.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, utoipa::ToSchema)]
pub struct Reference {
    /// The other table.
    pub table: String,
    /// Each column, with the one of the other table that it is equal to.
    pub columns: Vec<[String; 2]>,
}

/// The foreign keys of a table, in the order in which they are declared.
pub async fn references(connection: &mut SqliteConnection, table: &str) -> Result<Vec<Reference>> {
    let query = sqlx::query(
        "SELECT f.id, f.[table], f.[from], f.[to]
         FROM sqlite_schema AS s, pragma_foreign_key_list(s.name) AS f
         WHERE s.name = ? AND f.[to] IS NOT NULL ORDER BY f.id DESC, f.seq",
    );
    let mut found: Vec<(i64, Reference)> = Vec::new();
    for row in query.bind(table).fetch_all(connection).await? {
        let (id, columns) = (row.try_get(0)?, [row.try_get(2)?, row.try_get(3)?]);
        match found.last_mut().filter(|(last, _)| *last == id) {
            Some((_, reference)) => reference.columns.push(columns),
            None => found.push((id, Reference { table: row.try_get(1)?, columns: vec![columns] })),
        }
    }
    Ok(found.into_iter().map(|(_, reference)| reference).collect())
}

/// The tables and views that are not ours, by name; what a GeoPackage keeps about its layers is nobody's.
pub async fn user_tables(connection: &mut SqliteConnection) -> Result<Vec<UserTable>> {
    let query = sqlx::query(
        "SELECT name, type FROM sqlite_schema
         WHERE type IN ('table', 'view') AND substr(name, 1, 7) <> 'sqlite_'
         AND substr(name, 1, 5) <> 'gpkg_' AND substr(name, 1, 6) <> 'rtree_' ORDER BY name",
    );
    let mut tables = Vec::new();
    for row in query.fetch_all(&mut *connection).await? {
        let name: String = row.try_get(0)?;
        let form = if row.try_get::<&str, _>(1)? == "view" { Form::View } else { Form::Table };
        if !OWN.contains(&name.as_str()) {
            tables.push(UserTable { name, form });
        }
    }
    let names: Vec<String> = tables.iter().map(|table| table.name.clone()).collect();
    let of_worlds = worlds::own(connection, &names).await?;
    tables.retain(|table| !of_worlds.contains(&table.name.as_str()));
    Ok(tables)
}

/// All tables and views, ours and the user's, with the names of their columns.
pub async fn all(connection: &mut SqliteConnection) -> Result<Vec<Named>> {
    let query = sqlx::query(
        "SELECT s.name, s.type, c.name FROM sqlite_schema AS s, pragma_table_info(s.name) AS c
         WHERE s.type IN ('table', 'view') AND substr(s.name, 1, 7) <> 'sqlite_' ORDER BY s.name, c.cid",
    );
    let mut all: Vec<Named> = Vec::new();
    for row in query.fetch_all(connection).await? {
        let (name, column): (String, String) = (row.try_get(0)?, row.try_get(2)?);
        let form = if row.try_get::<&str, _>(1)? == "view" { Form::View } else { Form::Table };
        match all.last_mut().filter(|last| last.name == name) {
            Some(last) => last.columns.push(column),
            None => all.push(Named { name, kind: form, columns: vec![column] }),
        }
    }
    Ok(all)
}

/// The columns of a table or view, without values.
pub(crate) async fn columns(connection: &mut SqliteConnection, table: &str) -> Result<Vec<RelationColumn>> {
    // the name is matched as the schema spells it, so that no text of a user is ever taken for an identifier
    let query = sqlx::query(
        "SELECT c.name, upper(c.type), c.pk, c.[notnull] AND c.dflt_value IS NULL
         FROM sqlite_schema AS s, pragma_table_info(s.name) AS c
         WHERE s.name = ? AND s.type IN ('table', 'view') ORDER BY c.cid",
    );
    let rows = query.bind(table).fetch_all(connection).await?;
    if rows.is_empty() {
        return Err(Error::UnknownTable(table.to_owned()));
    }
    let read = |row: &sqlx::sqlite::SqliteRow| -> sqlx::Result<RelationColumn> {
        Ok(RelationColumn {
            name: row.try_get(0)?,
            declared: row.try_get(1)?,
            key: row.try_get(2)?,
            required: row.try_get(3)?,
            values: Vec::new(),
        })
    };
    Ok(rows.iter().map(read).collect::<sqlx::Result<_>>()?)
}

/// The names of the key's columns, in the key's order.
pub(crate) fn key_names(columns: &[RelationColumn]) -> Vec<&str> {
    let mut keys: Vec<&RelationColumn> = columns.iter().filter(|column| column.key > 0).collect();
    keys.sort_by_key(|column| column.key);
    keys.iter().map(|column| column.name.as_str()).collect()
}

/// Reads a table or view whole: ours or the user's.
pub async fn read(connection: &mut SqliteConnection, table: &str) -> Result<Relation> {
    let mut columns = columns(connection, table).await?;
    let names: Vec<String> = columns.iter().map(|column| identifier(&column.name)).collect();
    let order: Vec<String> = match key_names(&columns).as_slice() {
        [] => names.clone(),
        keys => keys.iter().map(|name| identifier(name)).collect(),
    };
    let sql = format!("SELECT {} FROM {} ORDER BY {}", names.join(", "), identifier(table), order.join(", "));
    for (number, row) in dynamic::fetch(connection, sql, &[]).await?.into_iter().enumerate() {
        for (index, column) in columns.iter_mut().enumerate() {
            let value = Cell::of(&row, index).map_err(|error| Error::Unreadable {
                table: table.to_owned(),
                column: column.name.clone(),
                row: number + 1,
                reason: error.to_string(),
            })?;
            column.values.push(value);
        }
    }
    Ok(Relation { name: table.to_owned(), columns })
}

impl Tx<'_> {
    /// The tables and views that are not ours, by name.
    pub fn user_tables(&mut self) -> Result<Vec<UserTable>> {
        self.run(user_tables)
    }

    /// All tables and views, ours and the user's, with the names of their columns.
    pub fn relations(&mut self) -> Result<Vec<Named>> {
        self.run(all)
    }

    /// The foreign keys of a table, in the order in which they are declared.
    pub fn references(&mut self, table: &str) -> Result<Vec<Reference>> {
        self.run(async |connection| references(connection, table).await)
    }

    /// Reads a table or view whole, ours or the user's: by its key, or by all its columns where it has none.
    pub fn read_table(&mut self, name: &str) -> Result<Relation> {
        self.run(async |connection| read(connection, name).await)
    }
}
