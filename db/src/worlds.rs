//! Whether a database keeps worlds of their own, as `adit simulate` and `adit tasks` do: missions, learned buildings and
//! experience. It has all their tables or none, so that a site without worlds is 65 pages smaller
//! and may have `tasks`, `edges` or `cells` of its own.

use sqlx::SqliteConnection;

use crate::error::Result;

/// Whether the tables of worlds are there; one is known by a column that nobody else's table of that name has. Programs
/// before version 5 made them one kind at a time.
pub(crate) async fn are_kept(connection: &mut SqliteConnection) -> Result<bool> {
    let sql = "SELECT EXISTS (
        SELECT 1 FROM sqlite_schema AS s, pragma_table_info(s.name) AS c
        WHERE s.type = 'table' AND (s.name, c.name) IN (VALUES
            ('plans', 'min_clearance'), ('missions', 'optimum'), ('floor_plans', 'margin'),
            ('learned_buildings', 'learned'), ('cells', 'next_subgoal')))";
    Ok(sqlx::query_scalar(sql).fetch_one(connection).await?)
}

/// The tables of worlds, where they are kept.
const TABLES: [&str; 23] = [
    "cell_objects",
    "cells",
    "clearances",
    "edges",
    "endings",
    "floor_adits",
    "floor_corners",
    "floor_doorways",
    "floor_places",
    "floor_plans",
    "floor_regions",
    "floor_ways",
    "journal",
    "learned_buildings",
    "learned_places",
    "learned_unseen",
    "learned_walls",
    "missions",
    "object_changes",
    "strategies",
    "subgoal_pairs",
    "subgoals",
    "tasks",
];

/// Those of the tables of this name that are of worlds that are kept here.
pub(crate) async fn own(connection: &mut SqliteConnection, names: &[String]) -> Result<Vec<&'static str>> {
    let named: Vec<&'static str> =
        TABLES.into_iter().filter(|table| names.iter().any(|name| name == table)).collect();
    Ok(if !named.is_empty() && are_kept(connection).await? { named } else { Vec::new() })
}
