//! Reading what was kept.

use sqlx::sqlite::SqliteRow;
use sqlx::{Row, SqliteConnection};

use super::numbers::{read as read_numbers, read_rows};
use super::{Cell, Clearance, Edge, Experience, Object, Pair, Subgoal, Tag};
use crate::error::{Error, Result};
use crate::worlds;

pub(super) async fn cells(connection: &mut SqliteConnection) -> Result<Vec<String>> {
    if !worlds::are_kept(connection).await? {
        return Ok(Vec::new());
    }
    Ok(sqlx::query_scalar("SELECT cell FROM cells ORDER BY cell").fetch_all(connection).await?)
}

pub(super) async fn read(connection: &mut SqliteConnection, cell: &str) -> Result<Option<Experience>> {
    if !worlds::are_kept(connection).await? {
        return Ok(None);
    }
    let found = sqlx::query(
        "SELECT cell, robot, seed, tasks, revision, next_subgoal, next_edge, configuration, stands, figures, copied_from
         FROM cells WHERE cell = ?",
    )
    .bind(cell)
    .fetch_optional(&mut *connection)
    .await?;
    let Some(row) = found else { return Ok(None) };
    Ok(Some(Experience {
        cell: Cell {
            cell: row.try_get(0)?,
            robot: row.try_get(1)?,
            seed: row.try_get(2)?,
            tasks: row.try_get(3)?,
            revision: row.try_get(4)?,
            next_subgoal: row.try_get(5)?,
            next_edge: row.try_get(6)?,
            configuration: numbers(&row, 7, ("cells", "configuration", 1))?,
            stands: row.try_get(8)?,
            figures: row.try_get(9)?,
            copied_from: row.try_get(10)?,
        },
        objects: objects(connection, cell).await?,
        subgoals: subgoals(connection, cell).await?,
        edges: edges(connection, cell).await?,
        subgoal_pairs: subgoal_pairs(connection, cell).await?,
        clearances: clearances(connection, cell).await?,
    }))
}

async fn objects(connection: &mut SqliteConnection, cell: &str) -> Result<Vec<Object>> {
    let sql = "SELECT object, revision, times_moved, movable, x, y, heading_rad, polygon FROM cell_objects
               WHERE cell = ? ORDER BY number";
    let rows = sqlx::query(sql).bind(cell).fetch_all(connection).await?;
    let object = |(number, row): (usize, &SqliteRow)| {
        let place = ("cell_objects", "polygon", number);
        let corners = lists(row, 7, place)?;
        let corner = |corner: &Vec<f64>| <[f64; 2]>::try_from(corner.as_slice()).ok();
        let polygon: Option<Vec<[f64; 2]>> = corners.iter().map(corner).collect();
        Ok(Object {
            object: row.try_get(0)?,
            revision: row.try_get(1)?,
            times_moved: row.try_get(2)?,
            movable: row.try_get::<i64, _>(3)? != 0,
            pose: [row.try_get(4)?, row.try_get(5)?, row.try_get(6)?],
            polygon: polygon.ok_or_else(|| unreadable(place))?,
        })
    };
    (1..).zip(&rows).map(object).collect()
}

async fn subgoals(connection: &mut SqliteConnection, cell: &str) -> Result<Vec<Subgoal>> {
    let sql = "SELECT subgoal, configuration, made_task, object, tool_x, tool_y, tool_heading_rad, branch FROM subgoals
               WHERE cell = ? AND removed_task IS NULL ORDER BY subgoal";
    let rows = sqlx::query(sql).bind(cell).fetch_all(connection).await?;
    let subgoal = |(number, row): (usize, &SqliteRow)| {
        let tag = match row.try_get::<Option<String>, _>(3)? {
            None => None,
            Some(object) => {
                let tool = [row.try_get(4)?, row.try_get(5)?, row.try_get(6)?];
                Some(Tag { object, tool, branch: row.try_get(7)? })
            }
        };
        Ok(Subgoal {
            subgoal: row.try_get(0)?,
            configuration: numbers(row, 1, ("subgoals", "configuration", number))?,
            made_task: row.try_get(2)?,
            tag,
        })
    };
    (1..).zip(&rows).map(subgoal).collect()
}

async fn edges(connection: &mut SqliteConnection, cell: &str) -> Result<Vec<Edge>> {
    let sql = "SELECT edge, subgoal1, subgoal2, via, length, made_task, verified_task, verified_revision, times_verified, loose
               FROM edges WHERE cell = ? AND removed_task IS NULL ORDER BY edge";
    let rows = sqlx::query(sql).bind(cell).fetch_all(connection).await?;
    let edge = |(number, row): (usize, &SqliteRow)| {
        Ok(Edge {
            edge: row.try_get(0)?,
            ends: [row.try_get(1)?, row.try_get(2)?],
            via: lists(row, 3, ("edges", "via", number))?,
            length: row.try_get(4)?,
            made_task: row.try_get(5)?,
            verified_task: row.try_get(6)?,
            verified_revision: row.try_get(7)?,
            times_verified: row.try_get(8)?,
            loose: row.try_get::<i64, _>(9)? != 0,
        })
    };
    (1..).zip(&rows).map(edge).collect()
}

async fn subgoal_pairs(connection: &mut SqliteConnection, cell: &str) -> Result<Vec<Pair>> {
    let sql = "SELECT subgoal1, subgoal2, revision, kind FROM subgoal_pairs WHERE cell = ?
               ORDER BY subgoal1, subgoal2, kind";
    let rows = sqlx::query(sql).bind(cell).fetch_all(connection).await?;
    let pair = |row: &SqliteRow| {
        let tightened = row.try_get::<&str, _>(3)? == "tightened";
        Ok(Pair { ends: [row.try_get(0)?, row.try_get(1)?], tightened, revision: row.try_get(2)? })
    };
    rows.iter().map(pair).collect()
}

async fn clearances(connection: &mut SqliteConnection, cell: &str) -> Result<Vec<Clearance>> {
    let sql = "SELECT object, ax, ay, bx, by, within FROM clearances WHERE cell = ? ORDER BY rowid";
    let rows = sqlx::query(sql).bind(cell).fetch_all(connection).await?;
    let clearance = |row: &SqliteRow| {
        let b: (Option<f64>, Option<f64>) = (row.try_get(3)?, row.try_get(4)?);
        Ok(Clearance {
            object: row.try_get(0)?,
            a: [row.try_get(1)?, row.try_get(2)?],
            b: b.0.zip(b.1).map(|(x, y)| [x, y]),
            within: row.try_get(5)?,
        })
    };
    rows.iter().map(clearance).collect()
}

type Place = (&'static str, &'static str, usize);

fn numbers(row: &SqliteRow, column: usize, place: Place) -> Result<Vec<f64>> {
    let text: &str = row.try_get(column)?;
    read_numbers(text).ok_or_else(|| unreadable(place))
}

fn lists(row: &SqliteRow, column: usize, place: Place) -> Result<Vec<Vec<f64>>> {
    let text: &str = row.try_get(column)?;
    read_rows(text).ok_or_else(|| unreadable(place))
}

fn unreadable((table, column, row): Place) -> Error {
    Error::Unreadable {
        table: table.to_owned(),
        column: column.to_owned(),
        row,
        reason: "expected a list of finite numbers as JSON".to_owned(),
    }
}
