//! Routes on maps that are not cut into rooms: the tables `courses`, `course_steps` and `course_waypoints`.

use sqlx::{Row as _, SqliteConnection};

use crate::bulk::{self, Record, Values};
use crate::error::Result;
use crate::measure::Measures;
use crate::route::{Step, Waypoint};
use crate::transaction::Tx;

/// A route, or why there is none.
#[derive(Clone, Debug, PartialEq)]
pub struct Course {
    /// Whose.
    pub robot: String,
    /// From where.
    pub start: String,
    /// Where to.
    pub goal: String,
    /// Why there is none; `None` where there is one.
    pub reason: Option<String>,
    /// What is worth a look, in sentences.
    pub remarks: Vec<String>,
    /// What its steps weigh together.
    pub cost: Option<f64>,
    /// Metres.
    pub distance: Option<f64>,
    /// The least metres from anything solid.
    pub clearance: Option<f64>,
    /// What it takes of each measure that rules say.
    pub measures: Measures,
    /// What to do, from the start.
    pub steps: Vec<Step>,
    /// Where it bends, from the start.
    pub waypoints: Vec<Waypoint>,
}

impl Course {
    /// One of which no more is known than between what.
    pub fn blank(robot: &str, start: &str, goal: &str) -> Self {
        Self {
            robot: robot.to_owned(),
            start: start.to_owned(),
            goal: goal.to_owned(),
            reason: None,
            remarks: Vec::new(),
            cost: None,
            distance: None,
            clearance: None,
            measures: Measures::default(),
            steps: Vec::new(),
            waypoints: Vec::new(),
        }
    }
}

impl Record for &Course {
    const TABLE: &'static str = "courses";
    const COLUMNS: &'static [&'static str] = &[
        "robot",
        "start",
        "goal",
        "status",
        "reason",
        "remarks",
        "cost",
        "distance",
        "clearance",
        "steps",
        "measures",
    ];

    fn bind(&self, values: &mut Values) {
        values.text(&*self.robot);
        values.text(&*self.start);
        values.text(&*self.goal);
        values.text(if self.reason.is_none() { "ok" } else { "no_route" });
        values.text(self.reason.as_deref());
        values.text(&*self.remarks.join("\n"));
        values.real(self.cost);
        values.real(self.distance);
        values.real(self.clearance);
        values.integer(self.reason.is_none().then_some(self.steps.len() as i64));
        values.text(self.measures.text().as_deref());
    }
}

/// A step of a course.
struct StepOf<'c>(&'c Course, &'c Step);

impl Record for StepOf<'_> {
    const TABLE: &'static str = "course_steps";
    const COLUMNS: &'static [&'static str] = &[
        "robot", "start", "goal", "step", "kind", "place", "state", "action", "hardness", "cost", "x", "y",
        "z", "heading", "rule", "measures",
    ];

    fn bind(&self, values: &mut Values) {
        let Self(course, step) = self;
        values.text(&*course.robot);
        values.text(&*course.start);
        values.text(&*course.goal);
        values.integer(step.step);
        values.text(&*step.kind);
        values.text(&*step.place);
        values.text(step.state.as_deref());
        values.text(step.action.as_deref());
        values.real(step.hardness);
        values.real(step.cost);
        values.real(step.x);
        values.real(step.y);
        values.real(step.z);
        values.real(step.heading);
        values.text(step.rule.as_deref());
        values.text(step.measures.text().as_deref());
    }
}

/// A waypoint of a course.
struct WaypointOf<'c>(&'c Course, &'c Waypoint);

impl Record for WaypointOf<'_> {
    const TABLE: &'static str = "course_waypoints";
    const COLUMNS: &'static [&'static str] = &[
        "robot",
        "start",
        "goal",
        "waypoint",
        "x",
        "y",
        "z",
        "heading",
        "state",
        "action",
        "clearance",
        "distance",
        "cost",
        "centre_x",
        "centre_y",
        "turn",
        "measures",
    ];

    fn bind(&self, values: &mut Values) {
        let Self(course, point) = self;
        values.text(&*course.robot);
        values.text(&*course.start);
        values.text(&*course.goal);
        values.integer(point.waypoint);
        values.real(point.x);
        values.real(point.y);
        values.real(point.z);
        values.real(point.heading);
        values.text(point.state.as_deref());
        values.text(point.action.as_deref());
        values.real(point.clearance);
        values.real(point.distance);
        values.real(point.cost);
        values.real(point.centre_x);
        values.real(point.centre_y);
        values.text(point.turn.as_deref());
        values.text(point.measures.text().as_deref());
    }
}

async fn replace(connection: &mut SqliteConnection, by: &[Course]) -> Result<()> {
    for table in ["courses", "course_steps", "course_waypoints"] {
        let sql = sqlx::AssertSqlSafe(format!("DELETE FROM {table}"));
        sqlx::query(sql).execute(&mut *connection).await?;
    }
    bulk::insert(connection, by).await?;
    let steps = by.iter().flat_map(|course| course.steps.iter().map(move |step| StepOf(course, step)));
    bulk::insert(connection, steps).await?;
    let points = by.iter().flat_map(|course| course.waypoints.iter().map(move |at| WaypointOf(course, at)));
    bulk::insert(connection, points).await?;
    Ok(())
}

async fn robots(connection: &mut SqliteConnection) -> Result<Vec<String>> {
    let rows = sqlx::query_scalar("SELECT DISTINCT robot FROM courses ORDER BY robot");
    Ok(rows.fetch_all(connection).await?)
}

async fn remarks(connection: &mut SqliteConnection, key: [&str; 3]) -> Result<Vec<String>> {
    let query = sqlx::query_scalar("SELECT remarks FROM courses WHERE robot = ? AND start = ? AND goal = ?");
    let query = key.into_iter().fold(query, |query, part| query.bind(part.to_owned()));
    let lines: Option<String> = query.fetch_optional(connection).await?;
    Ok(lines.iter().flat_map(|lines| lines.lines()).map(str::to_owned).collect())
}

/// Robot, start and goal of a route.
type Key = (String, String, String);

async fn costs(connection: &mut SqliteConnection) -> Result<Vec<(Key, Option<f64>)>> {
    let rows = sqlx::query("SELECT robot, start, goal, cost FROM courses").fetch_all(connection).await?;
    let read = |row: &sqlx::sqlite::SqliteRow| -> sqlx::Result<(Key, Option<f64>)> {
        Ok(((row.try_get(0)?, row.try_get(1)?, row.try_get(2)?), row.try_get(3)?))
    };
    Ok(rows.iter().map(read).collect::<sqlx::Result<_>>()?)
}

impl Tx<'_> {
    /// The robots of which courses are kept.
    pub fn course_robots(&mut self) -> Result<Vec<String>> {
        self.run(robots)
    }

    /// What is worth a look of a course, in sentences.
    pub fn course_remarks(&mut self, robot: &str, start: &str, goal: &str) -> Result<Vec<String>> {
        self.run(async |connection| remarks(connection, [robot, start, goal]).await)
    }

    /// What all courses cost; `None`: there is none.
    pub fn course_costs(&mut self) -> Result<Vec<(Key, Option<f64>)>> {
        self.run(costs)
    }

    /// Replaces all courses by these.
    pub fn replace_courses(&mut self, by: &[Course]) -> Result<()> {
        self.run(async |connection| replace(connection, by).await)
    }
}
