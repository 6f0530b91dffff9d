//! The views `routes`, `route` and `action_sequence`, read as any SQL client reads them.

use serde::Serialize;
use sqlx::sqlite::SqliteRow;
use sqlx::{Row, SqliteConnection};

use crate::error::Result;
use crate::measure::Measures;
use crate::transaction::Tx;

/// A row of the view `routes`: the least-cost route into one room.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Reach {
    /// The robot.
    pub robot: String,
    /// The start's name.
    pub start: String,
    /// The room's number.
    pub room: i64,
    /// `None` is unreachable.
    pub cost: Option<f64>,
    /// The last door.
    pub from_door: Option<i64>,
    /// The room before it.
    pub from_room: Option<i64>,
}

/// A row of the view `route`.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Route {
    /// The robot.
    pub robot: String,
    /// The start's name.
    pub start: String,
    /// The goal's name.
    pub goal: String,
    /// ok, `same_room`, `no_route`, `not_kept` or stale.
    pub status: String,
    /// Cost of the whole route.
    pub cost: Option<f64>,
    /// Rows of its action sequence.
    pub steps: Option<i64>,
    /// Metres; `None` where ways are not measured.
    pub distance: Option<f64>,
}

/// A row of the view `action_sequence`.
#[derive(Clone, Debug, Default, PartialEq, Serialize, utoipa::ToSchema)]
pub struct Step {
    /// From 1.
    pub step: i64,
    /// room, door or change.
    pub kind: String,
    /// The room's name or the door's number.
    pub place: String,
    /// The state to be in.
    pub state: Option<String>,
    /// What to do.
    pub action: Option<String>,
    /// What this step adds to the cost.
    pub hardness: Option<f64>,
    /// Cost so far.
    pub cost: f64,
    /// Where the step ends, metres.
    pub x: Option<f64>,
    /// Where the step ends, metres.
    pub y: Option<f64>,
    /// Direction of the movement into that point, degrees counterclockwise from +x.
    pub heading: Option<f64>,
    /// The rule that set the door's hardness or the room's action.
    pub rule: Option<String>,
    /// Of a room the space that it is of.
    pub space: Option<String>,
    /// Of a door the doorway through which it leads into another space.
    pub doorway: Option<String>,
    /// Where the step ends, metres, on maps with heights.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub z: Option<f64>,
    /// What this step takes of each measure that rules say; none where it is not known.
    #[serde(skip_serializing_if = "Measures::is_empty")]
    pub measures: Measures,
}

/// A row of the view `waypoints`: where a route bends, changes shape, starts or ends.
#[derive(Clone, Debug, Default, PartialEq, Serialize, utoipa::ToSchema)]
pub struct Waypoint {
    /// From 1.
    pub waypoint: i64,
    /// Metres.
    pub x: f64,
    /// Metres.
    pub y: f64,
    /// Direction of the movement into that point, degrees counterclockwise from +x; `None` where nothing moves.
    pub heading: Option<f64>,
    /// The state in which the robot comes there; at the start, in which it leaves.
    pub state: Option<String>,
    /// What it does on the way there.
    pub action: Option<String>,
    /// How a body that is longer than wide lies on the way there, degrees counterclockwise from +x, less than 180;
    /// `None` for a disc.
    pub facing: Option<f64>,
    /// The least metres between the robot's rim and anything solid on the way there; `None`: not measured.
    pub clearance: Option<f64>,
    /// Metres from the start; `None` where ways are not measured.
    pub distance: Option<f64>,
    /// Cost so far, with what is passed at that point.
    pub cost: f64,
    /// Metres, on maps with heights.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub z: Option<f64>,
    /// Of an arc that leads there, the centre, metres.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub centre_x: Option<f64>,
    /// Of an arc that leads there, the centre, metres.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub centre_y: Option<f64>,
    /// Of an arc that leads there, to which side it turns: left or right.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub turn: Option<String>,
    /// What the way there takes of each measure that rules say: its `seconds` are the time since the start.
    #[serde(skip_serializing_if = "Measures::is_empty")]
    pub measures: Measures,
}

/// The waypoints of a route, in order; none where there is no route or no such name.
pub async fn waypoints(
    connection: &mut SqliteConnection,
    robot: &str,
    start: &str,
    goal: &str,
) -> Result<Vec<Waypoint>> {
    let query = sqlx::query(
        "SELECT waypoint, x, y, heading, state, action, facing, clearance, distance, cost, z, centre_x, centre_y, turn,
           measures
         FROM waypoints
         WHERE robot = ? AND start = ? AND goal = ? ORDER BY waypoint",
    );
    let read = |row: &SqliteRow| -> sqlx::Result<Waypoint> {
        Ok(Waypoint {
            waypoint: row.try_get(0)?,
            x: row.try_get(1)?,
            y: row.try_get(2)?,
            heading: row.try_get(3)?,
            state: row.try_get(4)?,
            action: row.try_get(5)?,
            facing: row.try_get(6)?,
            clearance: row.try_get(7)?,
            distance: row.try_get(8)?,
            cost: row.try_get(9)?,
            z: row.try_get(10)?,
            centre_x: row.try_get(11)?,
            centre_y: row.try_get(12)?,
            turn: row.try_get(13)?,
            measures: said(row, 14)?,
        })
    };
    let rows = query.bind(robot).bind(start).bind(goal).fetch_all(connection).await?;
    Ok(rows.iter().map(read).collect::<sqlx::Result<_>>()?)
}

/// What a column says of measures, as answers say it.
fn said(row: &SqliteRow, column: usize) -> sqlx::Result<Measures> {
    Ok(Measures::of(row.try_get::<Option<&str>, _>(column)?).rounded())
}

fn step(row: &SqliteRow) -> sqlx::Result<Step> {
    Ok(Step {
        step: row.try_get(0)?,
        kind: row.try_get(1)?,
        place: row.try_get(2)?,
        state: row.try_get(3)?,
        action: row.try_get(4)?,
        hardness: row.try_get(5)?,
        cost: row.try_get(6)?,
        x: row.try_get(7)?,
        y: row.try_get(8)?,
        heading: row.try_get(9)?,
        rule: row.try_get(10)?,
        space: row.try_get(11)?,
        doorway: row.try_get(12)?,
        z: row.try_get(13)?,
        measures: said(row, 14)?,
    })
}

/// The steps of a route, in order; none where there is no route or no such name.
pub async fn action_sequence(
    connection: &mut SqliteConnection,
    robot: &str,
    start: &str,
    goal: &str,
) -> Result<Vec<Step>> {
    let query = sqlx::query(
        "SELECT step, kind, place, state, action, hardness, cost, x, y, heading, rule, space, doorway, z, measures
         FROM action_sequence WHERE robot = ? AND start = ? AND goal = ? ORDER BY step",
    );
    let rows = query.bind(robot).bind(start).bind(goal).fetch_all(connection).await?;
    Ok(rows.iter().map(step).collect::<sqlx::Result<_>>()?)
}

/// Whether there is a route, and what it costs; `None` where a name is unknown.
pub async fn route(
    connection: &mut SqliteConnection,
    robot: &str,
    start: &str,
    goal: &str,
) -> Result<Option<Route>> {
    let query = sqlx::query(
        "SELECT robot, start, goal, status, cost, steps, distance FROM route
         WHERE robot = ? AND start = ? AND goal = ?",
    );
    let row = query.bind(robot).bind(start).bind(goal).fetch_optional(connection).await?;
    let read = |row: SqliteRow| -> sqlx::Result<Route> {
        Ok(Route {
            robot: row.try_get(0)?,
            start: row.try_get(1)?,
            goal: row.try_get(2)?,
            status: row.try_get(3)?,
            cost: row.try_get(4)?,
            steps: row.try_get(5)?,
            distance: row.try_get(6)?,
        })
    };
    Ok(row.map(read).transpose()?)
}

/// The least-cost routes from `start` into every room, by room.
pub async fn routes(connection: &mut SqliteConnection, robot: &str, start: &str) -> Result<Vec<Reach>> {
    let query = sqlx::query(
        "SELECT robot, start, room, cost, from_door, from_room FROM routes
         WHERE robot = ? AND start = ? ORDER BY room",
    );
    let read = |row: &SqliteRow| -> sqlx::Result<Reach> {
        Ok(Reach {
            robot: row.try_get(0)?,
            start: row.try_get(1)?,
            room: row.try_get(2)?,
            cost: row.try_get(3)?,
            from_door: row.try_get(4)?,
            from_room: row.try_get(5)?,
        })
    };
    let rows = query.bind(robot).bind(start).fetch_all(connection).await?;
    Ok(rows.iter().map(read).collect::<sqlx::Result<_>>()?)
}

impl Tx<'_> {
    /// The steps of a route, in order; none where there is no route or no such name.
    pub fn action_sequence(&mut self, robot: &str, start: &str, goal: &str) -> Result<Vec<Step>> {
        self.run(async |connection| action_sequence(connection, robot, start, goal).await)
    }

    /// The waypoints of a route, in order; none where there is no route or no such name.
    pub fn waypoints(&mut self, robot: &str, start: &str, goal: &str) -> Result<Vec<Waypoint>> {
        self.run(async |connection| waypoints(connection, robot, start, goal).await)
    }

    /// Whether there is a route, and what it costs; `None` where a name is unknown.
    pub fn route(&mut self, robot: &str, start: &str, goal: &str) -> Result<Option<Route>> {
        self.run(async |connection| route(connection, robot, start, goal).await)
    }

    /// The least-cost routes from `start` into every room, by room.
    pub fn routes(&mut self, robot: &str, start: &str) -> Result<Vec<Reach>> {
        self.run(async |connection| routes(connection, robot, start).await)
    }
}
