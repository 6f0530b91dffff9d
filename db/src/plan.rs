//! What the planners of worlds of their own found: the tables `plans`, `channels`, `junctions`, `corners`, `path_steps`,
//! `step_facts` and `step_rules`.

use sqlx::sqlite::SqliteArguments;
use sqlx::{Arguments, SqliteConnection};

use crate::cell::Cell;
use crate::error::Result;
use crate::transaction::Tx;

/// A plan with everything that is kept of it.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Plan {
    /// The name of its world.
    pub plan: String,
    /// `assembly` or `corridor`.
    pub kind: String,
    /// The rule base.
    pub rules: String,
    /// Why there is no path; `None` where there is one.
    pub reason: Option<String>,
    /// Metres.
    pub length: Option<f64>,
    /// The least distance from a wall, in metres.
    pub min_clearance: Option<f64>,
    /// Channels, by number.
    pub channels: Vec<Channel>,
    /// Junctions, by number.
    pub junctions: Vec<Junction>,
    /// Corners of junctions.
    pub corners: Vec<Corner>,
    /// The path, from its start.
    pub steps: Vec<PathStep>,
    /// What rules were told and concluded.
    pub facts: Vec<Fact>,
    /// Which rules spoke.
    pub considered: Vec<Considered>,
}

/// A box along x, y and z; what is not there is unknown.
pub type Extent = [Option<f64>; 6];

/// A channel.
#[derive(Clone, Debug, PartialEq)]
pub struct Channel {
    /// Along which it leads: x, y or z.
    pub axis: String,
    /// Least x, y, z, then greatest.
    pub extent: Extent,
}

/// A junction.
#[derive(Clone, Debug, PartialEq)]
pub struct Junction {
    /// The numbers of its channels.
    pub channels: [i64; 2],
    /// Least x, y, z, then greatest.
    pub extent: Extent,
}

/// A corner of a junction.
#[derive(Clone, Debug, PartialEq)]
pub struct Corner {
    /// Number of the junction.
    pub junction: i64,
    /// Which: `min,max` is least x and greatest y.
    pub corner: String,
    /// Where.
    pub at: [f64; 2],
    /// Whether the robot turns round it.
    pub turned: bool,
}

/// A step of a path.
#[derive(Clone, Debug, PartialEq)]
pub struct PathStep {
    /// `start`, `line` or `arc`.
    pub kind: &'static str,
    /// `assembled` or `disassembled` where a part is one of the two at its end.
    pub state: Option<&'static str>,
    /// The junction that it belongs to.
    pub junction: Option<i64>,
    /// The number of the rule by which it was chosen.
    pub rule: Option<f64>,
    /// Where it ends: x, y, z.
    pub at: [Option<f64>; 3],
    /// Centre and radius of an arc.
    pub circle: Option<([f64; 2], f64)>,
    /// `left` or `right`, of an arc.
    pub turn: Option<&'static str>,
    /// Where a robot looks at its end, in degrees.
    pub heading: Option<f64>,
    /// Metres.
    pub length: f64,
    /// The least distance from a wall, in metres.
    pub clearance: f64,
}

/// A property at a junction.
#[derive(Clone, Debug, PartialEq)]
pub struct Fact {
    /// Number of the junction.
    pub junction: i64,
    /// The property.
    pub property: String,
    /// Its value.
    pub value: Cell,
    /// The rule that concluded it, and its version; `None` where it was told.
    pub rule: Option<(String, String)>,
}

/// A rule that was looked at.
#[derive(Clone, Debug, PartialEq)]
pub struct Considered {
    /// Number of the junction.
    pub junction: i64,
    /// The rule or table.
    pub rule: String,
    /// The row of the table, from 1.
    pub row: Option<i64>,
    /// Its file.
    pub file: String,
    /// Its line there.
    pub line: i64,
    /// Whether it spoke.
    pub spoke: bool,
    /// Why it did not.
    pub because: Option<String>,
}

/// Keeps a plan in the stead of an earlier one of that name.
pub async fn keep(connection: &mut SqliteConnection, plan: &Plan) -> Result<()> {
    sqlx::query("DELETE FROM plans WHERE plan = ?").bind(&plan.plan).execute(&mut *connection).await?;
    sqlx::query(
        "INSERT INTO plans (plan, kind, rules, status, reason, length, min_clearance) VALUES (?, ?, ?, ?, ?, ?, ?)",
    )
    .bind(&plan.plan)
    .bind(&plan.kind)
    .bind(&plan.rules)
    .bind(if plan.reason.is_none() { "ok" } else { "no_path" })
    .bind(plan.reason.as_deref())
    .bind(plan.length)
    .bind(plan.min_clearance)
    .execute(&mut *connection)
    .await?;
    geometry(connection, plan).await?;
    for (number, step) in (1_i64..).zip(&plan.steps) {
        let [x, y, z] = step.at;
        let (centre, radius) = step.circle.unzip();
        sqlx::query(
            "INSERT INTO path_steps (plan, step, kind, state, junction, rule, x, y, z, centre_x, centre_y, radius, turn, heading,
                                     length, clearance)
             VALUES (?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?)",
        )
        .bind(&plan.plan)
        .bind(number)
        .bind(step.kind)
        .bind(step.state)
        .bind(step.junction)
        .bind(step.rule)
        .bind(x)
        .bind(y)
        .bind(z)
        .bind(centre.map(|[x, _]| x))
        .bind(centre.map(|[_, y]| y))
        .bind(radius)
        .bind(step.turn)
        .bind(step.heading)
        .bind(step.length)
        .bind(step.clearance)
        .execute(&mut *connection)
        .await?;
    }
    for fact in &plan.facts {
        let (rule, version) =
            fact.rule.as_ref().map(|(rule, version)| (rule.as_str(), version.as_str())).unzip();
        let mut arguments = SqliteArguments::default();
        arguments.add(&plan.plan).map_err(sqlx::Error::Encode)?;
        arguments.add(fact.junction).map_err(sqlx::Error::Encode)?;
        arguments.add(&fact.property).map_err(sqlx::Error::Encode)?;
        fact.value.bind(&mut arguments)?;
        arguments.add(rule).map_err(sqlx::Error::Encode)?;
        arguments.add(version).map_err(sqlx::Error::Encode)?;
        let sql = "INSERT INTO step_facts (plan, junction, property, value, rule, version) VALUES (?, ?, ?, ?, ?, ?)";
        sqlx::query_with(sql, arguments).execute(&mut *connection).await?;
    }
    for (number, row) in (1_i64..).zip(&plan.considered) {
        sqlx::query(
            "INSERT INTO step_rules (plan, junction, number, rule, table_row, file, line, spoke, because)
             VALUES (?, ?, ?, ?, ?, ?, ?, ?, ?)",
        )
        .bind(&plan.plan)
        .bind(row.junction)
        .bind(number)
        .bind(&row.rule)
        .bind(row.row)
        .bind(&row.file)
        .bind(row.line)
        .bind(row.spoke)
        .bind(row.because.as_deref())
        .execute(&mut *connection)
        .await?;
    }
    Ok(())
}

async fn geometry(connection: &mut SqliteConnection, plan: &Plan) -> Result<()> {
    for (number, channel) in (1_i64..).zip(&plan.channels) {
        let sql = "INSERT INTO channels (plan, channel, axis, x0, y0, z0, x1, y1, z1) VALUES (?, ?, ?, ?, ?, ?, ?, ?, ?)";
        let query = sqlx::query(sql).bind(&plan.plan).bind(number).bind(&channel.axis);
        let query = channel.extent.iter().fold(query, |query, edge| query.bind(edge));
        query.execute(&mut *connection).await?;
    }
    for (number, junction) in (1_i64..).zip(&plan.junctions) {
        let sql = "INSERT INTO junctions (plan, junction, channel1, channel2, x0, y0, z0, x1, y1, z1)
                   VALUES (?, ?, ?, ?, ?, ?, ?, ?, ?, ?)";
        let [one, other] = junction.channels;
        let query = sqlx::query(sql).bind(&plan.plan).bind(number).bind(one).bind(other);
        let query = junction.extent.iter().fold(query, |query, edge| query.bind(edge));
        query.execute(&mut *connection).await?;
    }
    for corner in &plan.corners {
        sqlx::query("INSERT INTO corners (plan, junction, corner, x, y, turned) VALUES (?, ?, ?, ?, ?, ?)")
            .bind(&plan.plan)
            .bind(corner.junction)
            .bind(&corner.corner)
            .bind(corner.at[0])
            .bind(corner.at[1])
            .bind(corner.turned)
            .execute(&mut *connection)
            .await?;
    }
    Ok(())
}

impl Tx<'_> {
    /// Keeps a plan in the stead of an earlier one of that name.
    pub fn keep_plan(&mut self, plan: &Plan) -> Result<()> {
        self.run(async |connection| keep(connection, plan).await)
    }
}
