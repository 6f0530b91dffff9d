//! Named points and frames: the tables `places` and `frames`.

use serde::{Deserialize, Serialize};
use sqlx::{Row, SqliteConnection};

use crate::bulk::{self, Record, Values};
use crate::error::Result;
use crate::transaction::Tx;

/// A named point of the map.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Place {
    /// Its name.
    pub place: String,
    /// Metres, in the map's frame.
    pub x: f64,
    /// Metres, in the map's frame.
    pub y: f64,
}

/// Where a frame's origin is in the world.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Frame {
    /// Its name.
    pub frame: String,
    /// Metres.
    pub x: f64,
    /// Metres.
    pub y: f64,
    /// Radians counterclockwise, as in the maps of ROS.
    pub yaw: f64,
}

impl Record for &Place {
    const TABLE: &'static str = "places";
    const COLUMNS: &'static [&'static str] = &["place", "x", "y"];

    fn bind(&self, values: &mut Values) {
        values.text(&*self.place);
        values.real(self.x);
        values.real(self.y);
    }
}

impl Record for &Frame {
    const TABLE: &'static str = "frames";
    const COLUMNS: &'static [&'static str] = &["frame", "x", "y", "yaw"];

    fn bind(&self, values: &mut Values) {
        values.text(&*self.frame);
        values.real(self.x);
        values.real(self.y);
        values.real(self.yaw);
    }
}

/// All places, by name.
pub async fn places(connection: &mut SqliteConnection) -> Result<Vec<Place>> {
    let rows = sqlx::query("SELECT place, x, y FROM places ORDER BY place").fetch_all(connection).await?;
    let read = |row: &sqlx::sqlite::SqliteRow| -> sqlx::Result<Place> {
        Ok(Place { place: row.try_get(0)?, x: row.try_get(1)?, y: row.try_get(2)? })
    };
    Ok(rows.iter().map(read).collect::<sqlx::Result<_>>()?)
}

/// All frames, by name.
pub async fn frames(connection: &mut SqliteConnection) -> Result<Vec<Frame>> {
    let rows =
        sqlx::query("SELECT frame, x, y, yaw FROM frames ORDER BY frame").fetch_all(connection).await?;
    let read = |row: &sqlx::sqlite::SqliteRow| -> sqlx::Result<Frame> {
        Ok(Frame { frame: row.try_get(0)?, x: row.try_get(1)?, y: row.try_get(2)?, yaw: row.try_get(3)? })
    };
    Ok(rows.iter().map(read).collect::<sqlx::Result<_>>()?)
}

/// Replaces all places by these.
pub async fn replace_places(connection: &mut SqliteConnection, places: &[Place]) -> Result<()> {
    sqlx::query("DELETE FROM places").execute(&mut *connection).await?;
    bulk::insert(connection, places).await?;
    Ok(())
}

/// Replaces all frames by these.
pub async fn replace_frames(connection: &mut SqliteConnection, frames: &[Frame]) -> Result<()> {
    sqlx::query("DELETE FROM frames").execute(&mut *connection).await?;
    bulk::insert(connection, frames).await?;
    Ok(())
}

impl Tx<'_> {
    /// All places, by name.
    pub fn places(&mut self) -> Result<Vec<Place>> {
        self.run(places)
    }

    /// All frames, by name.
    pub fn frames(&mut self) -> Result<Vec<Frame>> {
        self.run(frames)
    }

    /// Replaces all places by these.
    pub fn replace_places(&mut self, by: &[Place]) -> Result<()> {
        self.run(async |connection| replace_places(connection, by).await)
    }

    /// Replaces all frames by these.
    pub fn replace_frames(&mut self, by: &[Frame]) -> Result<()> {
        self.run(async |connection| replace_frames(connection, by).await)
    }
}
