//! Floor plans of worlds: the tables `floor_plans`, `floor_regions`, `floor_doorways`, `floor_adits`, `floor_ways` and
//! those beside them.

use sqlx::SqliteConnection;

use crate::bulk::{Record, Values, insert};
use crate::error::Result;
use crate::transaction::Tx;

/// A floor plan with its network.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct FloorPlan {
    /// The name of its world.
    pub world: String,
    /// The rule base.
    pub rules: String,
    /// Of the robot, metres.
    pub radius: f64,
    /// What it keeps free besides, metres.
    pub margin: f64,
    /// Of the free space, square metres.
    pub area: f64,
    /// Outline and area of each region.
    pub regions: Vec<(Vec<[f64; 2]>, f64)>,
    /// The regions on either side and the two ends of each doorway.
    pub doorways: Vec<Doorway>,
    /// Adits by number.
    pub adits: Vec<Adit>,
    /// Named places.
    pub places: Vec<Place>,
    /// Ways by number.
    pub ways: Vec<Way>,
}

/// What two regions share.
#[derive(Clone, Debug, PartialEq)]
pub struct Doorway {
    /// The regions.
    pub regions: [i64; 2],
    /// Its ends: x, y of one, x, y of the other.
    pub ends: [f64; 4],
    /// Metres.
    pub width: f64,
}

/// A point beside a doorway.
#[derive(Clone, Debug, PartialEq)]
pub struct Adit {
    /// The doorway.
    pub doorway: i64,
    /// The region that it lies in.
    pub region: i64,
    /// The adit on the other side.
    pub twin: i64,
    /// Where it is.
    pub at: [f64; 2],
}

/// A named place.
#[derive(Clone, Debug, PartialEq)]
pub struct Place {
    /// Its name.
    pub name: String,
    /// Where it is.
    pub at: [f64; 2],
    /// The region that it lies in, where the robot can stand there.
    pub region: Option<i64>,
}

/// A way to an adit.
#[derive(Clone, Debug, PartialEq)]
pub struct Way {
    /// The adit that it begins at; `None`: at a place.
    pub from_adit: Option<i64>,
    /// The place that it begins at.
    pub from_place: Option<String>,
    /// The adit that it leads to.
    pub to: i64,
    /// The doorway that it passes.
    pub doorway: Option<i64>,
    /// The region that it stays in.
    pub region: Option<i64>,
    /// Metres.
    pub length: f64,
    /// What stays free beside the robot, metres.
    pub clearance: f64,
    /// By the rules; `None` where they close it.
    pub weight: Option<f64>,
}

/// A row of one of the tables: the world, its number, and the rest.
struct Row<'r, T, const TABLE: usize> {
    world: &'r str,
    number: i64,
    rest: &'r T,
}

const REGIONS: usize = 0;
const CORNERS: usize = 1;
const DOORWAYS: usize = 2;
const ADITS: usize = 3;
const PLACES: usize = 4;
const WAYS: usize = 5;

impl Record for Row<'_, f64, REGIONS> {
    const TABLE: &'static str = "floor_regions";
    const COLUMNS: &'static [&'static str] = &["world", "region", "area"];

    fn bind(&self, values: &mut Values) {
        values.text(self.world);
        values.integer(self.number);
        values.real(*self.rest);
    }
}

impl Record for Row<'_, (i64, [f64; 2]), CORNERS> {
    const TABLE: &'static str = "floor_corners";
    const COLUMNS: &'static [&'static str] = &["world", "region", "corner", "x", "y"];

    fn bind(&self, values: &mut Values) {
        let (region, [x, y]) = *self.rest;
        values.text(self.world);
        values.integer(region);
        values.integer(self.number);
        values.real(x);
        values.real(y);
    }
}

impl Record for Row<'_, Doorway, DOORWAYS> {
    const TABLE: &'static str = "floor_doorways";
    const COLUMNS: &'static [&'static str] =
        &["world", "doorway", "region1", "region2", "x0", "y0", "x1", "y1", "width"];

    fn bind(&self, values: &mut Values) {
        values.text(self.world);
        values.integer(self.number);
        for region in self.rest.regions {
            values.integer(region);
        }
        for metres in self.rest.ends {
            values.real(metres);
        }
        values.real(self.rest.width);
    }
}

impl Record for Row<'_, Adit, ADITS> {
    const TABLE: &'static str = "floor_adits";
    const COLUMNS: &'static [&'static str] = &["world", "adit", "doorway", "region", "twin", "x", "y"];

    fn bind(&self, values: &mut Values) {
        let Adit { doorway, region, twin, at } = *self.rest;
        values.text(self.world);
        for number in [self.number, doorway, region, twin] {
            values.integer(number);
        }
        for metres in at {
            values.real(metres);
        }
    }
}

impl Record for Row<'_, Place, PLACES> {
    const TABLE: &'static str = "floor_places";
    const COLUMNS: &'static [&'static str] = &["world", "place", "x", "y", "region"];

    fn bind(&self, values: &mut Values) {
        values.text(self.world);
        values.text(self.rest.name.as_str());
        for metres in self.rest.at {
            values.real(metres);
        }
        values.integer(self.rest.region);
    }
}

impl Record for Row<'_, Way, WAYS> {
    const TABLE: &'static str = "floor_ways";
    const COLUMNS: &'static [&'static str] = &[
        "world",
        "way",
        "from_adit",
        "from_place",
        "to_adit",
        "doorway",
        "region",
        "length",
        "clearance",
        "weight",
    ];

    fn bind(&self, values: &mut Values) {
        let Way { from_adit, from_place, to, doorway, region, length, clearance, weight } = self.rest;
        values.text(self.world);
        values.integer(self.number);
        values.integer(*from_adit);
        values.text(from_place.as_deref());
        values.integer(*to);
        values.integer(*doorway);
        values.integer(*region);
        values.real(*length);
        values.real(*clearance);
        values.real(*weight);
    }
}

/// Rows with their numbers from 0.
fn rows<'r, T, const TABLE: usize>(
    world: &'r str,
    rest: impl IntoIterator<Item = &'r T>,
) -> Vec<Row<'r, T, TABLE>> {
    (0..).zip(rest).map(|(number, rest)| Row { world, number, rest }).collect()
}

/// Keeps a floor plan in the stead of an earlier one of that world.
pub async fn keep(connection: &mut SqliteConnection, plan: &FloorPlan) -> Result<()> {
    sqlx::query("DELETE FROM floor_plans WHERE world = ?")
        .bind(&plan.world)
        .execute(&mut *connection)
        .await?;
    sqlx::query("INSERT INTO floor_plans (world, rules, radius, margin, area) VALUES (?, ?, ?, ?, ?)")
        .bind(&plan.world)
        .bind(&plan.rules)
        .bind(plan.radius)
        .bind(plan.margin)
        .bind(plan.area)
        .execute(&mut *connection)
        .await?;
    let world = plan.world.as_str();
    insert(connection, rows::<_, REGIONS>(world, plan.regions.iter().map(|(_, area)| area))).await?;
    for (region, (outline, _)) in (0..).zip(&plan.regions) {
        let corners: Vec<(i64, [f64; 2])> = outline.iter().map(|corner| (region, *corner)).collect();
        insert(connection, rows::<_, CORNERS>(world, &corners)).await?;
    }
    insert(connection, rows::<_, DOORWAYS>(world, &plan.doorways)).await?;
    insert(connection, rows::<_, ADITS>(world, &plan.adits)).await?;
    insert(connection, rows::<_, PLACES>(world, &plan.places)).await?;
    insert(connection, rows::<_, WAYS>(world, &plan.ways)).await?;
    Ok(())
}

impl Tx<'_> {
    /// Keeps a floor plan in the stead of an earlier one of that world.
    pub fn keep_floor_plan(&mut self, plan: &FloorPlan) -> Result<()> {
        self.run(async |connection| keep(connection, plan).await)
    }
}
