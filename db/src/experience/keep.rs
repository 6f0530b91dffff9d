//! Writing: what a step changed, or all.

use sqlx::SqliteConnection;

use super::records::{GoneEdge, GoneSubgoal, Moved, Of};
use super::{Cell, Experience, Step};
use crate::bulk::Batch;
use crate::error::Result;

pub(super) async fn step(connection: &mut SqliteConnection, step: &Step) -> Result<()> {
    let cell = step.cell.cell.as_str();
    let mut batch = Batch::new();
    batch.put::<1, _>([&step.cell]);
    if let Some(all) = &step.objects {
        batch.run("DELETE FROM cell_objects WHERE cell = ?", |values| values.text(cell));
        batch.insert((1_i64..).zip(all).map(|object| Of(cell, object)));
    }
    batch.insert(step.object_changes.iter().map(|change| Of(cell, change)));
    if let Some(task) = step.forgotten {
        forget_graph(&mut batch, cell, task);
    }
    batch.insert(step.subgoals.iter().map(|subgoal| Of(cell, subgoal)));
    batch.update::<2, _>(step.moved.iter().map(|moved| Moved(cell, moved)));
    // A new edge takes the place of one that stood between the same subgoals: a trigger sees to that.
    batch.insert(step.edges.iter().map(|edge| Of(cell, edge)));
    batch.update::<2, _>(step.edges_changed.iter().map(|edge| Of(cell, edge)));
    batch.update::<2, _>(step.edges_removed.iter().map(|gone| GoneEdge(cell, gone)));
    batch.update::<2, _>(step.subgoals_removed.iter().map(|gone| GoneSubgoal(cell, gone)));
    // A pair may have been looked at before, in another state of the cell.
    batch.put::<4, _>(step.subgoal_pairs.iter().map(|pair| Of(cell, pair)));
    for object in &step.clearances_forgotten {
        batch.run("DELETE FROM clearances WHERE cell = ? AND object = ?", |values| {
            values.text(cell);
            values.text(object.as_str());
        });
    }
    batch.insert(step.clearances.iter().map(|clearance| Of(cell, clearance)));
    batch.insert(step.tasks.iter().map(|task| Of(cell, task)));
    batch.insert(step.strategies.iter().map(|chosen| Of(cell, chosen)));
    batch.send(connection).await
}

fn forget_graph(batch: &mut Batch, cell: &str, task: i64) {
    for sql in [
        "UPDATE edges SET removed_task = ?, because = 'forgotten' WHERE cell = ? AND removed_task IS NULL",
        "UPDATE subgoals SET removed_task = ?, because = 'forgotten' WHERE cell = ? AND removed_task IS NULL",
    ] {
        batch.run(sql, |values| {
            values.integer(task);
            values.text(cell);
        });
    }
    for sql in ["DELETE FROM subgoal_pairs WHERE cell = ?", "DELETE FROM clearances WHERE cell = ?"] {
        batch.run(sql, |values| values.text(cell));
    }
}

pub(super) async fn whole(connection: &mut SqliteConnection, experience: &Experience) -> Result<()> {
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
