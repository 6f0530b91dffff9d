//! Areas, obstacles, places, bridges and named doors laid over the map while the site is in use.

use adit_db::edit::Edited;
use adit_db::history::Author;
use adit_db::laid::Laid as Row;
use adit_db::{Cell, Tx};
use adit_engine::RuleBase;
use adit_planners::facts::Column;
use serde_json::{Map, Value};

use super::place;
use super::tell::{self, Tell};
use crate::error::{Code, Error, Result};
use crate::graph::Building;
use crate::knowledge::{KnowledgeBase, laid, tables};
use crate::site::clock::stored;
use crate::words::suggest::{did_you_mean, listed};

/// What can be laid over the map.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Thing {
    /// A part of the floor with a name, of which rules speak.
    #[default]
    Area,
    /// Something that no robot comes through.
    Obstacle,
    /// A named point.
    Place,
    /// Something to pass under, a rectangle along the axes; it has a `height`.
    Bridge,
    /// A doorway with a name, from post to post.
    Door,
}

impl Thing {
    pub fn name(self) -> &'static str {
        match self {
            Self::Area => "area",
            Self::Obstacle => "obstacle",
            Self::Place => "place",
            Self::Bridge => "bridge",
            Self::Door => "door",
        }
    }

    /// By the name that people give it.
    pub(crate) fn called(name: &str) -> Option<Self> {
        let all = [Self::Area, Self::Obstacle, Self::Place, Self::Bridge, Self::Door];
        all.into_iter().find(|what| what.name() == name)
    }

    /// The class whose properties it may have; `None`: it has none of its own, but for the height of a bridge.
    fn class(self) -> Option<&'static str> {
        match self {
            Self::Area => Some("AREAS"),
            Self::Door => Some("NAMED_DOORS"),
            Self::Obstacle | Self::Place | Self::Bridge => None,
        }
    }

    /// How many corners say where it is, in words, and whether so many do.
    fn corners(self, count: usize) -> (&'static str, bool) {
        match self {
            Self::Place => ("one point", count == 1),
            Self::Door => ("two points, the posts", count == 2),
            Self::Bridge => ("two corners", count == 2 || count == 4),
            Self::Area | Self::Obstacle => ("two corners or more", count > 1),
        }
    }
}

/// Something that is laid over the map, as it is said.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Lay {
    pub what: Thing,
    pub name: String,
    /// Metres, in the order in which they follow one another; two are those of a rectangle or the posts of a door, and one is a
    /// place.
    pub corners: Vec<[f64; 2]>,
    /// What an area or a door is.
    pub kind: Option<String>,
    /// What else is said of an area or a door, or how high a bridge is: property and value.
    pub properties: Vec<(String, String)>,
    /// When it ends, as [`KnowledgeBase::moment`] reads times.
    pub until: Option<String>,
}

/// The most corners of something that is laid over the map, and of all that lies there: rooms are cut along them at each such
/// edit, while others wait.
const CORNERS: usize = 1_000;
const ALL_CORNERS: usize = 20_000;

/// Refuses what would take long to cut.
fn check_corners(corners: &[[f64; 2]], there: &[Row]) -> Result<()> {
    // a corner of a row is `[x,y]`
    let there: usize = there.iter().map(|row| row.outline.matches("],").count() + 1).sum();
    let count = corners.len();
    let message = if count > CORNERS {
        format!("it has {count} corners; {CORNERS} are the most")
    } else if there + count > ALL_CORNERS {
        format!(
            "with its {count} corners all that is laid over the map has {}; {ALL_CORNERS} are the most",
            there + count
        )
    } else {
        return Ok(());
    };
    let help = "draw it with fewer corners, or take away what no longer counts".to_owned();
    Err(Error::said(Code::LaidCorners, message, Some(help)))
}

impl Lay {
    pub(super) fn apply(
        &self,
        tx: &mut Tx<'_>,
        (site, rules): (&KnowledgeBase, &RuleBase),
        author: &Author,
    ) -> Result<Edited> {
        let (name, what) = (self.name.trim(), self.what.name());
        self.check_said()?;
        let (needed, is_so_many) = self.what.corners(self.corners.len());
        if !is_so_many {
            let message = format!("where `{name}` lies is said by {needed}, not by {}", self.corners.len());
            return Err(Error::said(Code::LaidUsage, message, None));
        }
        let now = stored(site.clock().now());
        let known = tx.laid()?.into_iter().find(|row| row.name == name);
        if let Some(row) = known.as_ref().filter(|row| !row.is_over(&now)) {
            let message = format!("the {} `{name}` lies there already", row.what);
            let help = format!("`adit lift SITE \"{name}\"`, or `DELETE /api/areas/{name}`, takes it away");
            return Err(Error::said(Code::LaidTaken, message, Some(help)));
        }
        check_corners(&self.corners, &tx.laid()?)?;
        self.check_name(tx)?;
        let row = Row {
            name: name.to_owned(),
            what: what.to_owned(),
            kind: self.kind.clone(),
            outline: self.outline()?,
            properties: self.further(tx, site, rules)?,
            until: self.until.as_deref().map(|until| tell::end(site, until)).transpose()?,
            who: author.who.clone(),
            why: author.why.clone(),
            at: now,
        };
        site.site().needs_rooms()?;
        laid::check(&row, &mut site.world(tx)?)?;
        let optional = |text: &Option<String>| text.as_deref().map_or(Cell::Null, Cell::from);
        let cells = [
            ("name", Cell::from(name)),
            ("what", what.into()),
            ("kind", optional(&row.kind)),
            ("outline", row.outline.as_str().into()),
            ("properties", row.properties.as_str().into()),
            ("until", optional(&row.until)),
            ("who", row.who.as_str().into()),
            ("why", row.why.as_str().into()),
            ("at", row.at.as_str().into()),
        ];
        if known.is_some() {
            // what has ended by itself keeps its name from nobody
            tx.remove_row("laid", name, author)?;
        }
        Ok(tx.add_row("laid", &cells, author)?)
    }

    /// Refuses what cannot be said of such a thing.
    fn check_said(&self) -> Result<()> {
        let (name, what) = (self.name.trim(), self.what.name());
        let message = if self.what == Thing::Bridge {
            let is_height = |(property, _): &(String, String)| property == "height";
            if self.kind.is_none() && self.properties.len() == 1 && self.properties.iter().all(is_height) {
                return Ok(());
            }
            format!("`{name}` is a bridge: how high it is, and nothing else, is said of it, as `height=1.3`")
        } else if self.what.class().is_none() && (self.kind.is_some() || !self.properties.is_empty()) {
            let article = if self.what == Thing::Obstacle { "an" } else { "a" };
            format!("`{name}` is {article} {what}: only an area or a door has a kind and properties")
        } else {
            return Ok(());
        };
        Err(Error::said(Code::LaidUsage, message, None))
    }

    /// Refuses a name that means something else to whoever closes or avoids by names.
    fn check_name(&self, tx: &mut Tx<'_>) -> Result<()> {
        let (name, building) = (self.name.trim(), Building::read(tx)?);
        // doors have numbers painted on them, and a place gives its space that name
        let is_place = self.what == Thing::Place;
        let other = if place::split(name).is_some() {
            "a point".to_owned()
        } else if let Some(doorway) = building.doorway_named(name) {
            format!("the doorway at {:.2}, {:.2}", doorway.x, doorway.y)
        } else if let Some(space) =
            building.space_named(name).filter(|space| space.called.is_none() && !is_place)
        {
            format!("the {} at {:.2}, {:.2}", space.kind.as_deref().unwrap_or("space"), space.x, space.y)
        } else {
            return Ok(());
        };
        let message = format!("`{name}` would mean two things: this {} and {other}", self.what.name());
        let help = format!("give the {} another name", self.what.name());
        Err(Error::said(Code::LaidTaken, message, Some(help)))
    }

    fn outline(&self) -> Result<String> {
        let corners = match *self.corners {
            [[x0, y0], [x1, y1]] if self.what != Thing::Door => {
                let (left, right, low, high) = (x0.min(x1), x0.max(x1), y0.min(y1), y0.max(y1));
                vec![[left, low], [right, low], [right, high], [left, high]]
            }
            _ => self.corners.clone(),
        };
        if corners.iter().flatten().any(|metres| !metres.is_finite()) {
            return Err(Error::said(Code::LaidUsage, "a corner is two finite numbers, metres", None));
        }
        Ok(Value::from(corners.iter().map(|corner| Value::from(corner.to_vec())).collect::<Vec<_>>())
            .to_string())
    }

    /// The properties as JSON, each of the type that it has in its class.
    fn further(&self, tx: &mut Tx<'_>, site: &KnowledgeBase, rules: &RuleBase) -> Result<String> {
        let mut further = Map::new();
        for (property, value) in &self.properties {
            if property == "kind" {
                let message =
                    format!("the kind of `{}` is not one of its further properties", self.name.trim());
                let help = "say it by `--kind`".to_owned();
                return Err(Error::said(Code::LaidUsage, message, Some(help)));
            }
            if further.contains_key(property) {
                let message = format!("`{property}` of `{}` is said twice", self.name.trim());
                return Err(Error::said(Code::LaidUsage, message, None));
            }
            let Some(class) = self.what.class() else {
                let metres = value.trim().parse::<f64>().ok().filter(|metres| metres.is_finite());
                let wrong =
                    || format!("`{property}` of `{}` is a number of metres, not `{value}`", self.name.trim());
                let metres = metres.ok_or_else(|| Error::said(Code::LaidUsage, wrong(), None))?;
                further.insert(property.clone(), Value::from(metres));
                continue;
            };
            let tell = Tell {
                class: class.to_owned(),
                object: self.name.clone(),
                property: property.clone(),
                value: value.clone(),
                ..Tell::default()
            };
            let value = match tell.typed(tx, site, rules)? {
                ("truth", Cell::Integer(truth)) => Value::Bool(truth != 0),
                (_, Cell::Real(number)) => Value::from(number),
                (_, Cell::Text(text)) => Value::String(text),
                (_, other) => Value::String(other.to_string()),
            };
            further.insert(property.clone(), value);
        }
        Ok(Value::Object(further).to_string())
    }
}

/// Takes away what was laid over the map.
pub(super) fn lift(tx: &mut Tx<'_>, name: &str, author: &Author) -> Result<Edited> {
    let laid = tx.laid()?;
    if !laid.iter().any(|row| row.name == name) {
        let names = || laid.iter().map(|row| row.name.as_str());
        let is_of_map = match tables::kept(tx, "areas")?.column("area") {
            Some(Column::Text(areas)) => areas.iter().flatten().any(|area| area == name),
            _ => false,
        };
        let help = is_of_map
            .then(|| format!("`{name}` stands in the map or in site.toml: edit it there, or `adit close` it"))
            .or_else(|| did_you_mean(name, names()))
            .or_else(|| listed("laid over it", names()));
        let message = format!("nothing called `{name}` was laid over the map");
        return Err(Error::said(Code::LaidUnknown, message, help));
    }
    Ok(tx.remove_row("laid", name, author)?)
}
