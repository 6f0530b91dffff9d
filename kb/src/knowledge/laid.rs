//! Areas, obstacles, places, bridges and named doors that people lay over the map while the site is in use: read and checked as those of `site.toml` are.

use adit_db::Tx;
use adit_db::laid::Laid as Row;
use adit_planners::read::Overlay;
use adit_planners::world::World;
use serde_json::{Map, Value};

use crate::error::{Code, Error, Result};
use crate::site::clock::{Clock, stored};

/// What lies over the map now, by name.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Laid(Vec<Item>);

/// One of them with its text in the map's own language.
#[derive(Clone, Debug, PartialEq)]
struct Item {
    /// What people call it: ``the area `wet spot` ``.
    name: String,
    /// What is amiss where it cannot be read.
    text: std::result::Result<String, String>,
}

impl Laid {
    /// What has not ended.
    pub fn read(tx: &mut Tx<'_>, clock: &Clock) -> Result<Self> {
        let now = stored(clock.now());
        let rows = tx.laid()?.into_iter();
        let rows = rows.filter(|row| !row.is_over(&now));
        Ok(Self(rows.map(|row| Item::of(&row)).collect()))
    }

    pub fn is_empty(&self) -> bool {
        self.0.is_empty()
    }

    /// What lay over the map then and does no longer, in sentences.
    pub fn ended_since(&self, before: &Self) -> impl Iterator<Item = String> {
        let gone = before.0.iter().filter(|item| self.0.iter().all(|known| known.name != item.name));
        gone.map(|item| format!("{} has ended", item.name))
    }

    /// Lays all of it over a map. What does not fit there any more counts for nothing, and is said.
    pub fn over(&self, world: &World) -> (World, Vec<String>) {
        let (mut laid, mut notes) = (world.clone(), Vec::new());
        for item in &self.0 {
            if let Err(error) = item.lay(&mut laid) {
                let name = &item.name;
                notes.push(format!("{name}, laid over the map, counts for nothing: {error}"));
            }
        }
        (laid, notes)
    }

    /// A number that stands for it.
    pub fn hash(&self, hasher: &mut impl std::hash::Hasher) {
        for item in &self.0 {
            std::hash::Hash::hash(&item.text, hasher);
        }
    }
}

/// The sides of a rectangle along the axes: left, low, right, high.
fn rect_of(corners: &[[f64; 2]]) -> Option<[f64; 4]> {
    let side = |axis: usize, pick: fn(f64, f64) -> f64, from: f64| {
        corners.iter().map(|corner| corner[axis]).fold(from, pick)
    };
    let [x0, y0] = [0, 1].map(|axis| side(axis, f64::min, f64::INFINITY));
    let [x1, y1] = [0, 1].map(|axis| side(axis, f64::max, f64::NEG_INFINITY));
    let is_corner = |&[x, y]: &[f64; 2]| (x <= x0 || x >= x1) && (y <= y0 || y >= y1);
    (corners.len() == 4 && corners.iter().all(is_corner)).then_some([x0, y0, x1, y1])
}

impl Item {
    fn of(row: &Row) -> Self {
        Self { name: format!("the {} `{}`", row.what, row.name), text: Self::text_of(row) }
    }

    fn text_of(row: &Row) -> std::result::Result<String, String> {
        let corners: Vec<[f64; 2]> = serde_json::from_str(&row.outline)
            .map_err(|_| "its outline is no list of corners [[x,y],…]".to_owned())?;
        let further: Map<String, Value> = serde_json::from_str(&row.properties)
            .map_err(|_| "its properties are no JSON object".to_owned())?;
        let mut item = toml::Table::new();
        if !matches!(row.what.as_str(), "obstacle" | "bridge") {
            item.insert("name".to_owned(), row.name.as_str().into());
            item.extend(row.kind.as_deref().map(|kind| ("kind".to_owned(), kind.into())));
        }
        let rect = rect_of(&corners);
        let mut corners = corners.iter().map(|&[x, y]| toml::Value::from(vec![x, y]));
        match row.what.as_str() {
            "place" => item.extend(corners.next().map(|at| ("at".to_owned(), at))),
            "door" => item.extend(["from", "to"].map(str::to_owned).into_iter().zip(corners)),
            "bridge" => {
                let rect = rect.ok_or("a bridge is a rectangle along the axes")?;
                item.insert("rect".to_owned(), rect.to_vec().into());
            }
            _ => drop(item.insert("polygon".to_owned(), corners.collect::<Vec<_>>().into())),
        }
        for (property, value) in further {
            let value = match value {
                Value::Bool(truth) => truth.into(),
                Value::String(text) => text.into(),
                Value::Number(number) => number.as_f64().unwrap_or(f64::NAN).into(),
                _ => return Err(format!("its `{property}` is no number, text or truth value")),
            };
            item.insert(property, value);
        }
        Ok(format!("[[{}]]\n{item}", row.what))
    }

    fn lay(&self, world: &mut World) -> Result<()> {
        let unreadable = |what: &String| Error::said(Code::LaidUnreadable, what.clone(), None);
        let text = self.text.as_ref().map_err(unreadable)?;
        let laid = Overlay::from_toml(&self.name, text).and_then(|overlay| overlay.lay_over(world));
        laid.map(drop).map_err(|errors| Error::all(errors.problems))
    }
}

/// Whether something may be laid over a map, over which others lie already.
pub fn check(row: &Row, world: &mut World) -> Result<()> {
    Item::of(row).lay(world)
}
