//! The layers of the database as a GeoPackage: what they are called, the shape of a row, and the outlines of areas.

use sqlx::{Row, SqliteConnection};

use crate::bulk::{self, Record, Values};
use crate::error::Result;
use crate::transaction::Tx;

/// A table or view whose rows have a shape.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Layer {
    /// The table or view.
    pub table: String,
    /// What people call it.
    pub name: String,
    /// The column that holds the shape.
    pub shape: String,
}

/// An area of the map, or one that is laid over it.
#[derive(Clone, Debug, PartialEq)]
pub struct AreaOutline {
    /// Its name.
    pub area: String,
    /// What it is, where that is said.
    pub kind: Option<String>,
    /// A JSON list of corners `[[x,y],…]`, metres.
    pub outline: String,
    /// The direction in which one goes through it, degrees counterclockwise from x; `None`: in any.
    pub heading: Option<f64>,
}

impl Record for &AreaOutline {
    const TABLE: &'static str = "area_outlines";
    const COLUMNS: &'static [&'static str] = &["area", "kind", "outline", "heading"];

    fn bind(&self, values: &mut Values) {
        values.text(&*self.area);
        values.text(self.kind.as_deref());
        values.text(&*self.outline);
        values.real(self.heading);
    }
}

/// The shape of a row, metres.
#[derive(Clone, Debug, PartialEq)]
pub enum Shape {
    LineString(Vec<[f64; 2]>),
    /// Rings of which the last point is the first again, the outer ring first.
    Polygon(Vec<Vec<[f64; 2]>>),
}

impl Shape {
    /// Reads the geometry of a GeoPackage; `None` where it is none, or neither a line nor a polygon of the plane.
    pub fn of_blob(blob: &[u8]) -> Option<Self> {
        let flags = *blob.strip_prefix(b"GP")?.get(1)?;
        let envelope = match flags >> 1 & 7 {
            0 => 0,
            1 => 32,
            2 | 3 => 48,
            4 => 64,
            _ => return None,
        };
        let mut rest = Bytes(blob.get(8 + envelope..)?);
        // the numbers of the shape are little-endian
        let [1] = rest.take()? else { return None };
        let shape = match rest.number()? {
            2 => Self::LineString(rest.points()?),
            3 => Self::Polygon((0..rest.number()?).map(|_| rest.points()).collect::<Option<_>>()?),
            _ => return None,
        };
        rest.0.is_empty().then_some(shape)
    }
}

/// What is still to be read.
struct Bytes<'b>(&'b [u8]);

impl Bytes<'_> {
    fn take<const N: usize>(&mut self) -> Option<[u8; N]> {
        let (taken, rest) = self.0.split_first_chunk()?;
        self.0 = rest;
        Some(*taken)
    }

    fn number(&mut self) -> Option<u32> {
        self.take().map(u32::from_le_bytes)
    }

    fn points(&mut self) -> Option<Vec<[f64; 2]>> {
        let coordinate = |bytes: &mut Self| bytes.take().map(f64::from_le_bytes);
        (0..self.number()?).map(|_| Some([coordinate(self)?, coordinate(self)?])).collect()
    }
}

async fn layers(connection: &mut SqliteConnection) -> Result<Vec<Layer>> {
    let query = sqlx::query(
        "SELECT c.table_name, coalesce(c.identifier, c.table_name), g.column_name
         FROM gpkg_contents AS c JOIN gpkg_geometry_columns AS g ON g.table_name = c.table_name ORDER BY 1",
    );
    let rows = query.fetch_all(connection).await?;
    let read = |row: &sqlx::sqlite::SqliteRow| -> sqlx::Result<Layer> {
        Ok(Layer { table: row.try_get(0)?, name: row.try_get(1)?, shape: row.try_get(2)? })
    };
    Ok(rows.iter().map(read).collect::<sqlx::Result<_>>()?)
}

async fn area_outlines(connection: &mut SqliteConnection) -> Result<Vec<AreaOutline>> {
    let query = sqlx::query("SELECT area, kind, outline, heading FROM area_outlines ORDER BY area");
    let read = |row: &sqlx::sqlite::SqliteRow| -> sqlx::Result<AreaOutline> {
        let (area, kind) = (row.try_get(0)?, row.try_get(1)?);
        Ok(AreaOutline { area, kind, outline: row.try_get(2)?, heading: row.try_get(3)? })
    };
    Ok(query.fetch_all(connection).await?.iter().map(read).collect::<sqlx::Result<_>>()?)
}

async fn replace(connection: &mut SqliteConnection, outlines: &[AreaOutline]) -> Result<()> {
    sqlx::query("DELETE FROM area_outlines").execute(&mut *connection).await?;
    bulk::insert(connection, outlines).await?;
    Ok(())
}

impl Tx<'_> {
    /// The layers that the database has as a GeoPackage, by table.
    pub fn layers(&mut self) -> Result<Vec<Layer>> {
        self.run(layers)
    }

    /// The outlines of all areas, by name.
    pub fn area_outlines(&mut self) -> Result<Vec<AreaOutline>> {
        self.run(area_outlines)
    }

    /// Replaces the outlines of all areas by these.
    pub fn replace_area_outlines(&mut self, by: &[AreaOutline]) -> Result<()> {
        self.run(async |connection| replace(connection, by).await)
    }
}
