//! Missions of robots on floor plans: the tables `missions` and `journal`.

mod decision;
mod replay;

pub use decision::{Decision, Happened, decision, events, numbers, worlds};
pub use replay::{Kept, list, replay};

use sqlx::SqliteConnection;

use crate::error::Result;
use crate::transaction::Tx;

/// A mission with its journal.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Mission {
    /// The name of its world.
    pub world: String,
    /// Its number, from 1.
    pub mission: i64,
    /// What chance was drawn from; a text, since SQL has no unsigned numbers of 64 bits.
    pub seed: String,
    /// The rule base.
    pub rules: String,
    /// Which robot drove; its kind, where there is one only.
    pub robot: Option<String>,
    /// Where it began.
    pub start: [f64; 2],
    /// Where it led.
    pub goal: [f64; 2],
    /// Obstacles that were not known.
    pub obstacles: i64,
    /// A row of `endings`: `arrived`, `no_way`, `lost`, `silent` or `gave_up`.
    pub ending: String,
    /// Metres that the robot went.
    pub length: f64,
    /// Of the shortest path.
    pub optimum: Option<f64>,
    /// By the robot's clock.
    pub seconds: f64,
    /// What happened.
    pub journal: Vec<Entry>,
}

/// Something that happened.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Entry {
    /// Seconds by the robot's clock.
    pub time: f64,
    /// What it was.
    pub event: String,
    /// State, next state, action.
    pub change: Option<[String; 3]>,
    /// The rule that decided.
    pub rule: Option<Decided>,
    /// Where the robot thought it was: x, y, heading in degrees.
    pub pose: [f64; 3],
    /// Where it was, if anybody knows.
    pub truth: Option<[f64; 3]>,
    /// What else there is, as JSON.
    pub detail: Option<String>,
}

/// The rule that decided.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Decided {
    /// Rule or table.
    pub rule: String,
    /// The row of a table, from 1.
    pub row: Option<i64>,
    /// Its file.
    pub file: String,
    /// Its line there.
    pub line: i64,
}

/// Keeps a mission in the stead of an earlier one of that world and number.
pub async fn keep(connection: &mut SqliteConnection, mission: &Mission) -> Result<()> {
    sqlx::query("DELETE FROM missions WHERE world = ? AND mission = ?")
        .bind(&mission.world)
        .bind(mission.mission)
        .execute(&mut *connection)
        .await?;
    sqlx::query(
        "INSERT INTO missions (world, mission, seed, rules, start_x, start_y, goal_x, goal_y, obstacles, ending, length,
                               optimum, seconds, robot)
         VALUES (?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?)",
    )
    .bind(&mission.world)
    .bind(mission.mission)
    .bind(&mission.seed)
    .bind(&mission.rules)
    .bind(mission.start[0])
    .bind(mission.start[1])
    .bind(mission.goal[0])
    .bind(mission.goal[1])
    .bind(mission.obstacles)
    .bind(&mission.ending)
    .bind(mission.length)
    .bind(mission.optimum)
    .bind(mission.seconds)
    .bind(mission.robot.as_deref())
    .execute(&mut *connection)
    .await?;
    for (number, entry) in (1_i64..).zip(&mission.journal) {
        let [state, next, action] = match &entry.change {
            Some(change) => change.each_ref().map(|word| Some(word.as_str())),
            None => [None; 3],
        };
        let rule = entry.rule.as_ref();
        sqlx::query(
            "INSERT INTO journal (world, mission, entry, time, event, state, next, action, rule, table_row, file, line,
                                  x, y, heading, true_x, true_y, true_heading, detail)
             VALUES (?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?)",
        )
        .bind(&mission.world)
        .bind(mission.mission)
        .bind(number)
        .bind(entry.time)
        .bind(&entry.event)
        .bind(state)
        .bind(next)
        .bind(action)
        .bind(rule.map(|rule| rule.rule.as_str()))
        .bind(rule.and_then(|rule| rule.row))
        .bind(rule.map(|rule| rule.file.as_str()))
        .bind(rule.map(|rule| rule.line))
        .bind(entry.pose[0])
        .bind(entry.pose[1])
        .bind(entry.pose[2])
        .bind(entry.truth.map(|truth| truth[0]))
        .bind(entry.truth.map(|truth| truth[1]))
        .bind(entry.truth.map(|truth| truth[2]))
        .bind(entry.detail.as_deref())
        .execute(&mut *connection)
        .await?;
    }
    Ok(())
}

impl Tx<'_> {
    /// Keeps a mission in the stead of an earlier one of that world and number.
    pub fn keep_mission(&mut self, mission: &Mission) -> Result<()> {
        self.run(async |connection| keep(connection, mission).await)
    }
}
