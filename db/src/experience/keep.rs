//! Writing: what a step changed, or all.

use sqlx::SqliteConnection;

use super::records::{GoneEdge, GoneSubgoal, Moved, Of, kind};
use super::{Cell, Experience, Object, Pair, Step};
use crate::bulk::{insert, update};
use crate::error::Result;

pub(super) async fn step(connection: &mut SqliteConnection, step: &Step) -> Result<()> {
    let cell = step.cell.cell.as_str();
    if is_kept(connection, cell).await? {
        update::<1, _>(connection, [&step.cell]).await?;
    } else {
        insert(connection, [&step.cell]).await?;
    }
    if let Some(all) = &step.objects {
        objects(connection, cell, all).await?;
    }
    insert(connection, step.object_changes.iter().map(|change| Of(cell, change))).await?;
    if let Some(task) = step.forgotten {
        forget_graph(connection, cell, task).await?;
    }
    insert(connection, step.subgoals.iter().map(|subgoal| Of(cell, subgoal))).await?;
    update::<2, _>(connection, step.moved.iter().map(|moved| Moved(cell, moved))).await?;
    // A new edge takes the place of one that stood between the same subgoals: a trigger sees to that.
    insert(connection, step.edges.iter().map(|edge| Of(cell, edge))).await?;
    update::<2, _>(connection, step.edges_changed.iter().map(|edge| Of(cell, edge))).await?;
    update::<2, _>(connection, step.edges_removed.iter().map(|gone| GoneEdge(cell, gone))).await?;
    update::<2, _>(connection, step.subgoals_removed.iter().map(|gone| GoneSubgoal(cell, gone))).await?;
    pairs(connection, cell, &step.subgoal_pairs).await?;
    for object in &step.clearances_forgotten {
        sqlx::query("DELETE FROM clearances WHERE cell = ? AND object = ?")
            .bind(cell)
            .bind(object)
            .execute(&mut *connection)
            .await?;
    }
    insert(connection, step.clearances.iter().map(|clearance| Of(cell, clearance))).await?;
    insert(connection, step.tasks.iter().map(|task| Of(cell, task))).await?;
    insert(connection, step.strategies.iter().map(|chosen| Of(cell, chosen))).await?;
    Ok(())
}

async fn is_kept(connection: &mut SqliteConnection, cell: &str) -> Result<bool> {
    let found: Option<i64> = sqlx::query_scalar("SELECT 1 FROM cells WHERE cell = ?")
        .bind(cell)
        .fetch_optional(connection)
        .await?;
    Ok(found.is_some())
}

async fn objects(connection: &mut SqliteConnection, cell: &str, all: &[Object]) -> Result<()> {
    sqlx::query("DELETE FROM cell_objects WHERE cell = ?").bind(cell).execute(&mut *connection).await?;
    insert(connection, (1_i64..).zip(all).map(|object| Of(cell, object))).await?;
    Ok(())
}

async fn forget_graph(connection: &mut SqliteConnection, cell: &str, task: i64) -> Result<()> {
    for sql in [
        "UPDATE edges SET removed_task = ?2, because = 'forgotten' WHERE cell = ?1 AND removed_task IS NULL",
        "UPDATE subgoals SET removed_task = ?2, because = 'forgotten' WHERE cell = ?1 AND removed_task IS NULL",
    ] {
        sqlx::query(sql).bind(cell).bind(task).execute(&mut *connection).await?;
    }
    for sql in ["DELETE FROM subgoal_pairs WHERE cell = ?", "DELETE FROM clearances WHERE cell = ?"] {
        sqlx::query(sql).bind(cell).execute(&mut *connection).await?;
    }
    Ok(())
}

/// A pair may have been looked at before, in another state of the cell.
async fn pairs(connection: &mut SqliteConnection, cell: &str, pairs: &[Pair]) -> Result<()> {
    for pair in pairs {
        sqlx::query(
            "DELETE FROM subgoal_pairs WHERE cell = ? AND subgoal1 = ? AND subgoal2 = ? AND kind = ?",
        )
        .bind(cell)
        .bind(pair.ends[0])
        .bind(pair.ends[1])
        .bind(kind(pair))
        .execute(&mut *connection)
        .await?;
    }
    insert(connection, pairs.iter().map(|pair| Of(cell, pair))).await?;
    Ok(())
}

pub(super) async fn whole(connection: &mut SqliteConnection, experience: &Experience) -> Result<()> {
    super::make(connection).await?;
    let cell = &experience.cell.cell;
    forget(connection, cell).await?;
    let all = Step {
        cell: Cell::clone(&experience.cell),
        objects: Some(experience.objects.clone()),
        subgoals: experience.subgoals.clone(),
        edges: experience.edges.clone(),
        subgoal_pairs: experience.subgoal_pairs.clone(),
        clearances: experience.clearances.clone(),
        ..Step::default()
    };
    step(connection, &all).await
}

pub(super) async fn forget(connection: &mut SqliteConnection, cell: &str) -> Result<()> {
    sqlx::query("DELETE FROM cells WHERE cell = ?").bind(cell).execute(connection).await?;
    Ok(())
}
