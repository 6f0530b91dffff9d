//! What the journals of missions say of one decision.

use sqlx::SqliteConnection;

use crate::error::Result;
use crate::transaction::Tx;
use crate::worlds::are_kept;

/// A change of state of a robot, as its journal has it.
#[derive(Clone, Debug, PartialEq)]
pub struct Decision {
    /// The rule base of the mission.
    pub rules: String,
    /// Which robot drove, if that is kept.
    pub robot: Option<String>,
    /// How the mission ended: a row of `endings`.
    pub ending: String,
    /// Where the mission led from and to.
    pub ends: [[f64; 2]; 2],
    /// Metres that the robot went in all.
    pub length: f64,
    /// The number of the entry.
    pub entry: i64,
    /// Seconds by the robot's clock.
    pub time: f64,
    /// The state before.
    pub state: String,
    /// The state after.
    pub next: String,
    /// What was done on the way.
    pub action: String,
    /// Where the robot thought it was, metres.
    pub at: [f64; 2],
    /// What the rules were told, as JSON.
    pub detail: Option<String>,
}

/// The worlds that have missions, sorted.
pub async fn worlds(connection: &mut SqliteConnection) -> Result<Vec<String>> {
    if !are_kept(connection).await? {
        return Ok(Vec::new());
    }
    let worlds = sqlx::query_scalar("SELECT DISTINCT world FROM missions ORDER BY world");
    Ok(worlds.fetch_all(&mut *connection).await?)
}

/// The numbers of a world's missions: how many there are, the first and the last.
pub async fn numbers(connection: &mut SqliteConnection, world: &str) -> Result<(i64, i64, i64)> {
    let numbers = sqlx::query_as(
        "SELECT count(*), coalesce(min(mission), 0), coalesce(max(mission), 0) FROM missions WHERE world = ?",
    );
    Ok(numbers.bind(world).fetch_one(&mut *connection).await?)
}

/// The decision of a mission that was in force so many seconds after the robot was switched on; `None` where none was yet.
pub async fn decision(
    connection: &mut SqliteConnection,
    world: &str,
    mission: i64,
    at: f64,
) -> Result<Option<Decision>> {
    let found = sqlx::query_as(
        "SELECT missions.rules, robot, ending, start_x, start_y, goal_x, goal_y, length,
                entry, time, state, next, action, x, y, detail
         FROM journal JOIN missions USING (world, mission)
         WHERE world = ? AND mission = ? AND event = 'state' AND time <= ?
         ORDER BY entry DESC LIMIT 1",
    );
    let found = found.bind(world).bind(mission).bind(at);
    let found: Option<Columns> = found.fetch_optional(&mut *connection).await?;
    Ok(found.map(
        |(rules, robot, ending, x0, y0, x1, y1, length, entry, time, state, next, action, x, y, detail)| {
            Decision {
                rules,
                robot,
                ending,
                ends: [[x0, y0], [x1, y1]],
                length,
                entry,
                time,
                state,
                next,
                action,
                at: [x, y],
                detail,
            }
        },
    ))
}

type Columns = (
    String,
    Option<String>,
    String,
    f64,
    f64,
    f64,
    f64,
    f64,
    i64,
    f64,
    String,
    String,
    String,
    f64,
    f64,
    Option<String>,
);

/// What happened on a mission besides its changes of state, up to so many seconds after the robot was switched on.
pub async fn events(
    connection: &mut SqliteConnection,
    world: &str,
    mission: i64,
    until: f64,
) -> Result<Vec<Happened>> {
    let found = sqlx::query_as(
        "SELECT time, event, detail FROM journal
         WHERE world = ? AND mission = ? AND event <> 'state' AND time <= ? ORDER BY entry",
    );
    Ok(found.bind(world).bind(mission).bind(until).fetch_all(&mut *connection).await?)
}

/// When something happened, what it was, and what else there is of it, as JSON.
pub type Happened = (f64, String, Option<String>);

impl Tx<'_> {
    /// The worlds that have missions.
    pub fn worlds_of_missions(&mut self) -> Result<Vec<String>> {
        self.run(async |connection| worlds(connection).await)
    }

    /// The numbers of a world's missions: how many there are, the first and the last.
    pub fn numbers_of_missions(&mut self, world: &str) -> Result<(i64, i64, i64)> {
        self.run(async |connection| numbers(connection, world).await)
    }

    /// What happened on a mission besides its changes of state, up to so many seconds after the robot was switched on.
    pub fn events_of_mission(&mut self, world: &str, mission: i64, until: f64) -> Result<Vec<Happened>> {
        self.run(async |connection| events(connection, world, mission, until).await)
    }

    /// The decision of a mission that was in force so many seconds after the robot was switched on.
    pub fn decision(&mut self, world: &str, mission: i64, at: f64) -> Result<Option<Decision>> {
        self.run(async |connection| decision(connection, world, mission, at).await)
    }
}
