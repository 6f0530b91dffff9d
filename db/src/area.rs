//! Strips and prime areas: the tables `strips` and `prime_area_strips`, behind the view `prime_areas`.

use serde::Serialize;
use sqlx::{Row, SqliteConnection};

use crate::bulk::{self, Record, Values};
use crate::error::Result;
use crate::reason::Derived;
use crate::transaction::Tx;

/// A prime area: the strips that it covers.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Area {
    /// Its number, from 1.
    pub area: i64,
    /// First and last strip of the x axis, from 0.
    pub x: (i64, i64),
    /// First and last strip of the y axis, from 0.
    pub y: (i64, i64),
    /// Whether a rule calls it open.
    pub open: Derived<bool>,
}

struct Strip {
    axis: &'static str,
    index: usize,
    low: f64,
    high: f64,
}

impl Record for Strip {
    const TABLE: &'static str = "strips";
    const COLUMNS: &'static [&'static str] = &["axis", "strip", "low", "high"];

    fn bind(&self, values: &mut Values) {
        values.text(self.axis);
        values.integer(self.index as i64);
        values.real(self.low);
        values.real(self.high);
    }
}

impl Record for &Area {
    const TABLE: &'static str = "prime_area_strips";
    const COLUMNS: &'static [&'static str] =
        &["area", "x_first", "x_last", "y_first", "y_last", "open", "open_rule", "open_witness"];

    fn bind(&self, values: &mut Values) {
        values.integer(self.area);
        values.integer(self.x.0);
        values.integer(self.x.1);
        values.integer(self.y.0);
        values.integer(self.y.1);
        values.truth(self.open.value);
        self.open.bind_reason(values);
    }
}

fn strips<'e>(axis: &'static str, edges: &'e [f64]) -> impl Iterator<Item = Strip> + use<'e> {
    edges.windows(2).enumerate().map(move |(index, edge)| Strip { axis, index, low: edge[0], high: edge[1] })
}

/// Replaces the strips by those between these edges (metres, ascending), and the prime areas by these.
pub async fn replace(
    connection: &mut SqliteConnection,
    x_edges: &[f64],
    y_edges: &[f64],
    areas: &[Area],
) -> Result<()> {
    sqlx::query("DELETE FROM strips").execute(&mut *connection).await?;
    sqlx::query("DELETE FROM prime_area_strips").execute(&mut *connection).await?;
    bulk::insert(connection, strips("x", x_edges).chain(strips("y", y_edges))).await?;
    bulk::insert(connection, areas).await?;
    Ok(())
}

struct Openness<'a>(&'a Area);

impl Record for Openness<'_> {
    const TABLE: &'static str = "prime_area_strips";
    const COLUMNS: &'static [&'static str] = &["area", "open", "open_rule", "open_witness"];

    fn bind(&self, values: &mut Values) {
        values.integer(self.0.area);
        values.truth(self.0.open.value);
        self.0.open.bind_reason(values);
    }
}

/// Says anew of these prime areas whether they are open, and why.
pub async fn put_open(
    connection: &mut SqliteConnection,
    areas: impl IntoIterator<Item = &Area>,
) -> Result<u64> {
    bulk::update::<1, _>(connection, areas.into_iter().map(Openness)).await
}

/// All prime areas, by number.
pub async fn read(connection: &mut SqliteConnection) -> Result<Vec<Area>> {
    let rows = sqlx::query(
        "SELECT area, x_first, x_last, y_first, y_last, open, open_rule, open_witness FROM prime_area_strips
         ORDER BY area",
    );
    let mut areas = Vec::new();
    for row in rows.fetch_all(connection).await? {
        areas.push(Area {
            area: row.try_get(0)?,
            x: (row.try_get(1)?, row.try_get(2)?),
            y: (row.try_get(3)?, row.try_get(4)?),
            open: Derived::of(&row, 5, 6)?,
        });
    }
    Ok(areas)
}

impl Tx<'_> {
    /// All prime areas, by number.
    pub fn areas(&mut self) -> Result<Vec<Area>> {
        self.run(read)
    }

    /// Says anew of these prime areas whether they are open, and why; how many.
    pub fn put_open_areas<'a>(&mut self, areas: impl IntoIterator<Item = &'a Area>) -> Result<u64> {
        self.run(async |connection| put_open(connection, areas).await)
    }

    /// Replaces the strips by those between these edges (metres, ascending), and the prime areas by these.
    pub fn replace_areas(&mut self, x_edges: &[f64], y_edges: &[f64], areas: &[Area]) -> Result<()> {
        self.run(async |connection| replace(connection, x_edges, y_edges, areas).await)
    }
}
