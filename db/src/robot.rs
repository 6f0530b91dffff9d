//! The states that robots can take: the tables `robots` and `changes`.

use serde::{Deserialize, Serialize};
use sqlx::{Row, SqliteConnection};

use crate::bulk::{self, Record, Values};
use crate::error::Result;
use crate::transaction::Tx;

/// A state of a robot: the size that it has there, and what moving costs.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct State {
    /// The robot's name.
    pub robot: String,
    /// The state's name.
    pub state: String,
    /// How it moves in this state.
    pub action: String,
    /// Metres.
    pub height: f64,
    /// Metres.
    pub width: f64,
    /// Along the facing, metres; `None` for a disc of its width.
    pub length: Option<f64>,
    /// Cost per metre.
    pub hardness: f64,
    /// Row order, which breaks ties.
    pub position: i64,
    /// Metres a second; `None`: not known.
    pub speed: Option<f64>,
    /// Watts while it moves so; `None`: not known.
    pub power: Option<f64>,
}

/// The cost of changing from one state into another.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Change {
    /// The robot's name.
    pub robot: String,
    /// State before.
    pub from_state: String,
    /// State after.
    pub to_state: String,
    /// Cost of one change.
    pub hardness: f64,
    /// How long it takes; `None`: not known.
    pub seconds: Option<f64>,
    /// What it takes of the battery; `None`: not known.
    pub joules: Option<f64>,
}

impl Record for &State {
    const TABLE: &'static str = "robots";
    const COLUMNS: &'static [&'static str] =
        &["robot", "state", "action", "height", "width", "length", "hardness", "position", "speed", "power"];

    fn bind(&self, values: &mut Values) {
        values.text(&*self.robot);
        values.text(&*self.state);
        values.text(&*self.action);
        values.real(self.height);
        values.real(self.width);
        values.real(self.length);
        values.real(self.hardness);
        values.integer(self.position);
        values.real(self.speed);
        values.real(self.power);
    }
}

impl Record for &Change {
    const TABLE: &'static str = "changes";
    const COLUMNS: &'static [&'static str] =
        &["robot", "from_state", "to_state", "hardness", "seconds", "joules"];

    fn bind(&self, values: &mut Values) {
        values.text(&*self.robot);
        values.text(&*self.from_state);
        values.text(&*self.to_state);
        values.real(self.hardness);
        values.real(self.seconds);
        values.real(self.joules);
    }
}

/// All states: by robot, then in row order.
pub async fn states(connection: &mut SqliteConnection) -> Result<Vec<State>> {
    let query = sqlx::query(
        "SELECT robot, state, action, height, width, length, hardness, position, speed, power FROM robots
         ORDER BY robot, position, state",
    );
    read(&query.fetch_all(connection).await?)
}

/// All states as they count, with the named tunings that are on: by robot, then in row order.
pub async fn states_in_force(connection: &mut SqliteConnection) -> Result<Vec<State>> {
    let query = sqlx::query(
        "SELECT robot, state, action, height, width, length, hardness, position, speed, power FROM robots_in_force
         ORDER BY robot, position, state",
    );
    read(&query.fetch_all(connection).await?)
}

fn read(rows: &[sqlx::sqlite::SqliteRow]) -> Result<Vec<State>> {
    let read = |row: &sqlx::sqlite::SqliteRow| -> sqlx::Result<State> {
        Ok(State {
            robot: row.try_get(0)?,
            state: row.try_get(1)?,
            action: row.try_get(2)?,
            height: row.try_get(3)?,
            width: row.try_get(4)?,
            length: row.try_get(5)?,
            hardness: row.try_get(6)?,
            position: row.try_get(7)?,
            speed: row.try_get(8)?,
            power: row.try_get(9)?,
        })
    };
    Ok(rows.iter().map(read).collect::<sqlx::Result<_>>()?)
}

/// All changes, by key.
pub async fn changes(connection: &mut SqliteConnection) -> Result<Vec<Change>> {
    let rows = sqlx::query(
        "SELECT robot, from_state, to_state, hardness, seconds, joules FROM changes ORDER BY 1, 2, 3",
    );
    let rows = rows.fetch_all(connection).await?;
    let read = |row: &sqlx::sqlite::SqliteRow| -> sqlx::Result<Change> {
        Ok(Change {
            robot: row.try_get(0)?,
            from_state: row.try_get(1)?,
            to_state: row.try_get(2)?,
            hardness: row.try_get(3)?,
            seconds: row.try_get(4)?,
            joules: row.try_get(5)?,
        })
    };
    Ok(rows.iter().map(read).collect::<sqlx::Result<_>>()?)
}

/// Replaces all states and changes by these, as seeding does.
pub async fn seed(connection: &mut SqliteConnection, states: &[State], changes: &[Change]) -> Result<()> {
    sqlx::query("DELETE FROM changes").execute(&mut *connection).await?;
    sqlx::query("DELETE FROM robots").execute(&mut *connection).await?;
    bulk::insert(connection, states).await?;
    bulk::insert(connection, changes).await?;
    Ok(())
}

impl Tx<'_> {
    /// All states: by robot, then in row order.
    pub fn states(&mut self) -> Result<Vec<State>> {
        self.run(states)
    }

    /// All states as they count, with the named tunings that are on: by robot, then in row order.
    pub fn states_in_force(&mut self) -> Result<Vec<State>> {
        self.run(states_in_force)
    }

    /// All changes, by key.
    pub fn changes(&mut self) -> Result<Vec<Change>> {
        self.run(changes)
    }

    /// Replaces all states and changes by these, as seeding does.
    pub fn seed(&mut self, to: &[State], costs: &[Change]) -> Result<()> {
        self.run(async |connection| seed(connection, to, costs).await)
    }
}
