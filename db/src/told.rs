//! What people and robots told, and what the last build made of it: the tables `told`, `attachments` and `told_states`.

use serde::Serialize;
use sqlx::{Row, SqliteConnection};

use crate::bulk::{self, Record, Values};
use crate::cell::Cell;
use crate::error::Result;
use crate::transaction::Tx;

/// A fact that was told.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Told {
    /// Its number.
    pub id: i64,
    /// The class, in capitals.
    pub class: String,
    /// The object's key; `None` where a point says which objects are meant.
    pub key: Option<String>,
    /// The point, metres.
    pub at: Option<[f64; 2]>,
    /// The segment of the door that was meant, `x0, y0, x1, y1`.
    pub segment: Option<[f64; 4]>,
    /// The property.
    pub property: String,
    /// number, text or truth.
    pub kind: String,
    /// The value; a truth value is 0 or 1.
    pub value: Cell,
    /// When it ends, in UTC.
    pub until: Option<String>,
    /// Who told it.
    pub who: String,
    /// Why.
    pub why: String,
    /// When it was told, in UTC.
    pub told_at: String,
}

/// What a build made of a fact.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Standing {
    /// The fact's number.
    pub told: i64,
    /// attached, lost or expired.
    pub state: String,
    /// Keys of the objects that it is about.
    pub keys: Vec<String>,
}

/// All facts, in the order in which they were told.
pub async fn told(connection: &mut SqliteConnection) -> Result<Vec<Told>> {
    let query = sqlx::query(
        "SELECT id, class, key, x, y, x0, y0, x1, y1, property, kind, value, until, who, why, at
         FROM told ORDER BY id",
    );
    let mut facts = Vec::new();
    for row in query.fetch_all(connection).await? {
        let at: (Option<f64>, Option<f64>) = (row.try_get(3)?, row.try_get(4)?);
        let ends: [Option<f64>; 4] = [row.try_get(5)?, row.try_get(6)?, row.try_get(7)?, row.try_get(8)?];
        let segment =
            if let [Some(x0), Some(y0), Some(x1), Some(y1)] = ends { Some([x0, y0, x1, y1]) } else { None };
        facts.push(Told {
            id: row.try_get(0)?,
            class: row.try_get(1)?,
            key: row.try_get(2)?,
            at: at.0.zip(at.1).map(|(x, y)| [x, y]),
            segment,
            property: row.try_get(9)?,
            kind: row.try_get(10)?,
            value: Cell::of(&row, 11)?,
            until: row.try_get(12)?,
            who: row.try_get(13)?,
            why: row.try_get(14)?,
            told_at: row.try_get(15)?,
        });
    }
    Ok(facts)
}

/// What the last build made of the facts, by their number; none of a fact that no build has seen.
pub async fn standings(connection: &mut SqliteConnection) -> Result<Vec<Standing>> {
    let query = sqlx::query("SELECT told, state FROM told_states ORDER BY told");
    let mut standings = Vec::new();
    for row in query.fetch_all(&mut *connection).await? {
        standings.push(Standing { told: row.try_get(0)?, state: row.try_get(1)?, keys: Vec::new() });
    }
    for standing in &mut standings {
        let query = sqlx::query_scalar("SELECT key FROM attachments WHERE told = ? ORDER BY key");
        standing.keys = query.bind(standing.told).fetch_all(&mut *connection).await?;
    }
    Ok(standings)
}

struct Attachment<'s>(i64, &'s str);
struct State<'s>(i64, &'s str);

impl Record for Attachment<'_> {
    const TABLE: &'static str = "attachments";
    const COLUMNS: &'static [&'static str] = &["told", "key"];

    fn bind(&self, values: &mut Values) {
        values.integer(self.0);
        values.text(self.1);
    }
}

impl Record for State<'_> {
    const TABLE: &'static str = "told_states";
    const COLUMNS: &'static [&'static str] = &["told", "state"];

    fn bind(&self, values: &mut Values) {
        values.integer(self.0);
        values.text(self.1);
    }
}

/// Replaces what the last build made of the facts.
pub async fn replace_standings(connection: &mut SqliteConnection, by: &[Standing]) -> Result<()> {
    sqlx::query("DELETE FROM attachments").execute(&mut *connection).await?;
    sqlx::query("DELETE FROM told_states").execute(&mut *connection).await?;
    bulk::insert(connection, by.iter().map(|standing| State(standing.told, &standing.state))).await?;
    let attached = by.iter().flat_map(|standing| {
        standing.keys.iter().map(|key| Attachment(standing.told, key)).collect::<Vec<_>>()
    });
    bulk::insert(connection, attached.collect::<Vec<_>>()).await?;
    Ok(())
}

impl Tx<'_> {
    /// All facts, in the order in which they were told.
    pub fn facts_told(&mut self) -> Result<Vec<Told>> {
        self.run(told)
    }

    /// What the last build made of the facts, by their number; none of a fact that no build has seen.
    pub fn standings(&mut self) -> Result<Vec<Standing>> {
        self.run(standings)
    }

    /// Replaces what the last build made of the facts.
    pub fn replace_standings(&mut self, by: &[Standing]) -> Result<()> {
        self.run(async |connection| replace_standings(connection, by).await)
    }
}
