//! Missions as they were driven, entry by entry.

use serde::Serialize;
use sqlx::SqliteConnection;

use super::{Decided, Entry};
use crate::error::Result;
use crate::transaction::Tx;
use crate::worlds::are_kept;

/// A mission without its journal.
#[derive(Clone, Debug, PartialEq, Serialize, utoipa::ToSchema)]
#[schema(as = KeptMission)]
pub struct Kept {
    /// The name of its world.
    pub world: String,
    /// Its number, from 1.
    pub mission: i64,
    /// Which robot drove, if that is kept.
    pub robot: Option<String>,
    /// The rule base that decided.
    pub rules: String,
    /// Where it began, metres.
    pub start: [f64; 2],
    /// Where it led, metres.
    pub goal: [f64; 2],
    /// A row of `endings`: `arrived`, `no_way`, `lost`, `silent` or `gave_up`.
    pub ending: String,
    /// What the ending means, in words.
    pub meaning: String,
    /// Metres that the robot went.
    pub length: f64,
    /// By the robot's clock.
    pub seconds: f64,
    /// When it was kept, in UTC.
    pub at: String,
}

type KeptRow = (String, i64, Option<String>, String, f64, f64, f64, f64, String, String, f64, f64, String);

impl Kept {
    fn of(
        (world, mission, robot, rules, x0, y0, x1, y1, ending, meaning, length, seconds, at): KeptRow,
    ) -> Self {
        let (start, goal) = ([x0, y0], [x1, y1]);
        Self { world, mission, robot, rules, start, goal, ending, meaning, length, seconds, at }
    }
}

const COLUMNS: &str = "SELECT world, mission, robot, rules, start_x, start_y, goal_x, goal_y, ending, meaning, length, seconds, at
                       FROM missions JOIN endings USING (ending)";

/// The missions of a world that were kept last, the newest first.
pub async fn list(connection: &mut SqliteConnection, world: &str, most: u32) -> Result<Vec<Kept>> {
    if !are_kept(connection).await? {
        return Ok(Vec::new());
    }
    let sql = format!("{COLUMNS} WHERE world = ? ORDER BY mission DESC LIMIT ?");
    let rows = sqlx::query_as(sqlx::AssertSqlSafe(sql)).bind(world).bind(most);
    let rows: Vec<KeptRow> = rows.fetch_all(&mut *connection).await?;
    Ok(rows.into_iter().map(Kept::of).collect())
}

/// A mission with all that happened on it.
pub async fn replay(
    connection: &mut SqliteConnection,
    world: &str,
    mission: i64,
) -> Result<Option<(Kept, Vec<Entry>)>> {
    if !are_kept(connection).await? {
        return Ok(None);
    }
    let sql = format!("{COLUMNS} WHERE world = ? AND mission = ?");
    let kept = sqlx::query_as(sqlx::AssertSqlSafe(sql)).bind(world).bind(mission);
    let kept: Option<KeptRow> = kept.fetch_optional(&mut *connection).await?;
    let Some(kept) = kept.map(Kept::of) else { return Ok(None) };
    let rows = sqlx::query_as(
        "SELECT time, event, state, next, action, rule, table_row, file, line, x, y, heading, true_x, true_y, true_heading,
                detail
         FROM journal WHERE world = ? AND mission = ? ORDER BY entry",
    );
    let rows: Vec<EntryRow> = rows.bind(world).bind(mission).fetch_all(&mut *connection).await?;
    Ok(Some((kept, rows.into_iter().map(entry).collect())))
}

type Text = Option<String>;
type Number = Option<f64>;
type EntryRow = (
    f64,
    String,
    Text,
    Text,
    Text,
    Text,
    Option<i64>,
    Text,
    Option<i64>,
    f64,
    f64,
    f64,
    Number,
    Number,
    Number,
    Text,
);

fn entry(
    (
        time,
        event,
        state,
        next,
        action,
        rule,
        row,
        file,
        line,
        x,
        y,
        heading,
        true_x,
        true_y,
        true_heading,
        detail,
    ): EntryRow,
) -> Entry {
    let change = state.zip(next).zip(action).map(|((state, next), action)| [state, next, action]);
    let rule = rule.zip(file).zip(line).map(|((rule, file), line)| Decided { rule, row, file, line });
    let truth = true_x.zip(true_y).zip(true_heading).map(|((x, y), heading)| [x, y, heading]);
    Entry { time, event, change, rule, pose: [x, y, heading], truth, detail }
}

impl Tx<'_> {
    /// The missions of a world that were kept last, the newest first.
    pub fn missions(&mut self, world: &str, most: u32) -> Result<Vec<Kept>> {
        self.run(async |connection| list(connection, world, most).await)
    }

    /// A mission with all that happened on it; `None`: there is none.
    pub fn replay(&mut self, world: &str, mission: i64) -> Result<Option<(Kept, Vec<Entry>)>> {
        self.run(async |connection| replay(connection, world, mission).await)
    }
}
