//! The tables `spaces` and `doorways`: the rooms of a building as people see them, and the openings between them.

use serde::Serialize;
use sqlx::sqlite::SqliteRow;
use sqlx::{Row, SqliteConnection};

use crate::bulk::{self, Record, Values};
use crate::error::Result;
use crate::stale::quietly;
use crate::transaction::Tx;

/// A part of the floor that people see as one.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct Space {
    /// Its number, from 1.
    pub space: i64,
    /// What the map calls it, by the only place or area in it.
    pub called: Option<String>,
    /// What rules call it.
    pub name: Option<String>,
    /// What rules say it is: a corridor, a hall.
    pub kind: Option<String>,
    /// Square metres.
    pub area: f64,
    /// Metres across, where it is widest.
    pub breadth: f64,
    /// Where it is widest, metres.
    pub x: f64,
    /// Where it is widest, metres.
    pub y: f64,
    /// A JSON list of rings `[[x,y],…]`, the outer one first, metres.
    pub outline: String,
    /// Whether nobody comes in or out.
    pub closed: Option<bool>,
}

/// Where one comes from a space into another.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct Doorway {
    /// Its number, from 1.
    pub doorway: i64,
    /// The named door that is drawn there.
    pub called: Option<String>,
    /// What rules call it.
    pub name: Option<String>,
    /// The number of a space.
    pub space1: i64,
    /// The number of the other space; the same one where a door is drawn within a space.
    pub space2: i64,
    /// Its middle, metres.
    pub x: f64,
    /// Its middle, metres.
    pub y: f64,
    /// One end, metres.
    pub x0: f64,
    /// One end, metres.
    pub y0: f64,
    /// The other end, metres.
    pub x1: f64,
    /// The other end, metres.
    pub y1: f64,
    /// Metres.
    pub width: f64,
    /// Of the lowest bridge over it, metres.
    pub height: Option<f64>,
    /// Whether nobody passes it.
    pub closed: Option<bool>,
    /// The space from which nobody passes it, by the name that people have for it.
    pub closed_from: Option<String>,
}

impl Record for &Space {
    const TABLE: &'static str = "spaces";
    const COLUMNS: &'static [&'static str] =
        &["space", "called", "name", "kind", "area", "breadth", "x", "y", "outline", "closed"];

    fn bind(&self, values: &mut Values) {
        values.integer(self.space);
        values.text(self.called.as_deref());
        values.text(self.name.as_deref());
        values.text(self.kind.as_deref());
        values.real(self.area);
        values.real(self.breadth);
        values.real(self.x);
        values.real(self.y);
        values.text(&*self.outline);
        values.truth(self.closed);
    }
}

impl Record for &Doorway {
    const TABLE: &'static str = "doorways";
    const COLUMNS: &'static [&'static str] = &[
        "doorway",
        "called",
        "name",
        "space1",
        "space2",
        "x",
        "y",
        "x0",
        "y0",
        "x1",
        "y1",
        "width",
        "height",
        "closed",
        "closed_from",
    ];

    fn bind(&self, values: &mut Values) {
        values.integer(self.doorway);
        values.text(self.called.as_deref());
        values.text(self.name.as_deref());
        values.integer(self.space1);
        values.integer(self.space2);
        values.real(self.x);
        values.real(self.y);
        values.real(self.x0);
        values.real(self.y0);
        values.real(self.x1);
        values.real(self.y1);
        values.real(self.width);
        values.real(self.height);
        values.truth(self.closed);
        values.text(self.closed_from.as_deref());
    }
}

/// All spaces, by number.
pub async fn spaces(connection: &mut SqliteConnection) -> Result<Vec<Space>> {
    let query = sqlx::query(
        "SELECT space, called, name, kind, area, breadth, x, y, outline, closed FROM spaces ORDER BY space",
    );
    let read = |row: &SqliteRow| -> sqlx::Result<Space> {
        Ok(Space {
            space: row.try_get(0)?,
            called: row.try_get(1)?,
            name: row.try_get(2)?,
            kind: row.try_get(3)?,
            area: row.try_get(4)?,
            breadth: row.try_get(5)?,
            x: row.try_get(6)?,
            y: row.try_get(7)?,
            outline: row.try_get(8)?,
            closed: row.try_get(9)?,
        })
    };
    Ok(query.fetch_all(connection).await?.iter().map(read).collect::<sqlx::Result<_>>()?)
}

/// All doorways, by number.
pub async fn doorways(connection: &mut SqliteConnection) -> Result<Vec<Doorway>> {
    let query = sqlx::query(
        "SELECT doorway, called, name, space1, space2, x, y, x0, y0, x1, y1, width, height, closed, closed_from FROM doorways
         ORDER BY doorway",
    );
    let read = |row: &SqliteRow| -> sqlx::Result<Doorway> {
        Ok(Doorway {
            doorway: row.try_get(0)?,
            called: row.try_get(1)?,
            name: row.try_get(2)?,
            space1: row.try_get(3)?,
            space2: row.try_get(4)?,
            x: row.try_get(5)?,
            y: row.try_get(6)?,
            x0: row.try_get(7)?,
            y0: row.try_get(8)?,
            x1: row.try_get(9)?,
            y1: row.try_get(10)?,
            width: row.try_get(11)?,
            height: row.try_get(12)?,
            closed: row.try_get(13)?,
            closed_from: row.try_get(14)?,
        })
    };
    Ok(query.fetch_all(connection).await?.iter().map(read).collect::<sqlx::Result<_>>()?)
}

/// Replaces all spaces and doorways by these.
pub async fn replace(
    connection: &mut SqliteConnection,
    spaces: &[Space],
    doorways: &[Doorway],
) -> Result<()> {
    quietly(connection, async |connection| {
        sqlx::query("DELETE FROM spaces").execute(&mut *connection).await?;
        sqlx::query("DELETE FROM doorways").execute(&mut *connection).await?;
        bulk::insert(connection, spaces).await?;
        bulk::insert(connection, doorways).await.map(drop)
    })
    .await
}

impl Tx<'_> {
    /// All spaces, by number.
    pub fn spaces(&mut self) -> Result<Vec<Space>> {
        self.run(spaces)
    }

    /// All doorways, by number.
    pub fn doorways(&mut self) -> Result<Vec<Doorway>> {
        self.run(doorways)
    }

    /// Replaces all spaces and doorways by these.
    pub fn replace_spaces(&mut self, spaces: &[Space], doorways: &[Doorway]) -> Result<()> {
        self.run(async |connection| replace(connection, spaces, doorways).await)
    }
}
