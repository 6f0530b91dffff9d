//! Buildings that robots have learned: the tables `learned_buildings`, `learned_walls`, `learned_unseen` and
//! `learned_places`.

use sqlx::{Row, SqliteConnection};

use crate::bulk::{Record, Values, insert};
use crate::error::Result;
use crate::transaction::Tx;
use crate::worlds;

/// A learned building.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Learned {
    /// The name of its world.
    pub world: String,
    /// The name of its network among the floor plans.
    pub learned: String,
    /// The rule base.
    pub rules: String,
    /// What chance was drawn from; a text, since SQL has no unsigned numbers of 64 bits.
    pub seed: String,
    /// Of the robot, metres.
    pub radius: f64,
    /// Where the robot began.
    pub start: [f64; 2],
    /// Metres that the robot went.
    pub length: f64,
    /// By the robot's clock.
    pub seconds: f64,
    /// Surfaces by their ends: x, y, x, y.
    pub walls: Vec<[f64; 4]>,
    /// Boxes that are not free: least x, y, greatest x, y.
    pub unseen: Vec<[f64; 4]>,
    /// Names and points.
    pub places: Vec<(String, [f64; 2])>,
}

/// A row of walls (0) or boxes (1).
struct Numbered<'r, const TABLE: usize>(&'r str, i64, [f64; 4]);

impl<const TABLE: usize> Numbered<'_, TABLE> {
    fn put(&self, values: &mut Values) {
        values.text(self.0);
        values.integer(self.1);
        for metres in self.2 {
            values.real(metres);
        }
    }
}

impl Record for Numbered<'_, 0> {
    const TABLE: &'static str = "learned_walls";
    const COLUMNS: &'static [&'static str] = &["world", "wall", "x0", "y0", "x1", "y1"];

    fn bind(&self, values: &mut Values) {
        self.put(values);
    }
}

impl Record for Numbered<'_, 1> {
    const TABLE: &'static str = "learned_unseen";
    const COLUMNS: &'static [&'static str] = &["world", "box", "x0", "y0", "x1", "y1"];

    fn bind(&self, values: &mut Values) {
        self.put(values);
    }
}

/// A row of places.
struct Named<'r>(&'r str, &'r (String, [f64; 2]));

impl Record for Named<'_> {
    const TABLE: &'static str = "learned_places";
    const COLUMNS: &'static [&'static str] = &["world", "place", "x", "y"];

    fn bind(&self, values: &mut Values) {
        let (name, [x, y]) = self.1;
        values.text(self.0);
        values.text(name.as_str());
        values.real(*x);
        values.real(*y);
    }
}

fn numbered<'r, const TABLE: usize>(
    world: &'r str,
    boxes: &'r [[f64; 4]],
) -> impl Iterator<Item = Numbered<'r, TABLE>> {
    (0..).zip(boxes).map(move |(number, ends)| Numbered(world, number, *ends))
}

/// Keeps a building in the stead of an earlier one of that world.
pub async fn keep(connection: &mut SqliteConnection, learned: &Learned) -> Result<()> {
    sqlx::query("DELETE FROM learned_buildings WHERE world = ?")
        .bind(&learned.world)
        .execute(&mut *connection)
        .await?;
    sqlx::query(
        "INSERT INTO learned_buildings (world, learned, rules, seed, radius, start_x, start_y, length, seconds)
         VALUES (?, ?, ?, ?, ?, ?, ?, ?, ?)",
    )
    .bind(&learned.world)
    .bind(&learned.learned)
    .bind(&learned.rules)
    .bind(&learned.seed)
    .bind(learned.radius)
    .bind(learned.start[0])
    .bind(learned.start[1])
    .bind(learned.length)
    .bind(learned.seconds)
    .execute(&mut *connection)
    .await?;
    let world = learned.world.as_str();
    insert(connection, numbered::<0>(world, &learned.walls)).await?;
    insert(connection, numbered::<1>(world, &learned.unseen)).await?;
    insert(connection, learned.places.iter().map(|place| Named(world, place))).await?;
    Ok(())
}

/// The learned building of a world; `None` where none was learned.
pub async fn learned(connection: &mut SqliteConnection, world: &str) -> Result<Option<Learned>> {
    if !worlds::are_kept(connection).await? {
        return Ok(None);
    }
    let found = sqlx::query(
        "SELECT learned, rules, seed, radius, start_x, start_y, length, seconds FROM learned_buildings WHERE world = ?",
    )
    .bind(world)
    .fetch_optional(&mut *connection)
    .await?;
    let Some(row) = found else { return Ok(None) };
    let mut learned = Learned {
        world: world.to_owned(),
        learned: row.try_get(0)?,
        rules: row.try_get(1)?,
        seed: row.try_get(2)?,
        radius: row.try_get(3)?,
        start: [row.try_get(4)?, row.try_get(5)?],
        length: row.try_get(6)?,
        seconds: row.try_get(7)?,
        ..Learned::default()
    };
    let ends = |row: &sqlx::sqlite::SqliteRow| -> sqlx::Result<[f64; 4]> {
        Ok([row.try_get(0)?, row.try_get(1)?, row.try_get(2)?, row.try_get(3)?])
    };
    let walls =
        sqlx::query("SELECT x0, y0, x1, y1 FROM learned_walls WHERE world = ? ORDER BY wall").bind(world);
    learned.walls = walls.fetch_all(&mut *connection).await?.iter().map(ends).collect::<sqlx::Result<_>>()?;
    let unseen =
        sqlx::query("SELECT x0, y0, x1, y1 FROM learned_unseen WHERE world = ? ORDER BY box").bind(world);
    learned.unseen =
        unseen.fetch_all(&mut *connection).await?.iter().map(ends).collect::<sqlx::Result<_>>()?;
    let places =
        sqlx::query("SELECT place, x, y FROM learned_places WHERE world = ? ORDER BY place").bind(world);
    let place = |row: &sqlx::sqlite::SqliteRow| -> sqlx::Result<(String, [f64; 2])> {
        Ok((row.try_get(0)?, [row.try_get(1)?, row.try_get(2)?]))
    };
    learned.places =
        places.fetch_all(&mut *connection).await?.iter().map(place).collect::<sqlx::Result<_>>()?;
    Ok(Some(learned))
}

impl Tx<'_> {
    /// Keeps a learned building in the stead of an earlier one of that world.
    pub fn keep_learned(&mut self, building: &Learned) -> Result<()> {
        self.run(async |connection| keep(connection, building).await)
    }

    /// The learned building of a world; `None` where none was learned.
    pub fn learned(&mut self, world: &str) -> Result<Option<Learned>> {
        self.run(async |connection| learned(connection, world).await)
    }
}
