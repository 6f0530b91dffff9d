//! What a person or robot says, understood: class, object, property, value and end, each checked before it is kept.

use adit_db::Tx;
use adit_db::cell::Cell;
use adit_db::door::{Door, DoorKind};
use adit_db::history::Author;
use adit_engine::{RuleBase, Schema, Type};
use adit_planners::geometry::Point;

use super::place;
use crate::error::{Code, Error, Result};
use crate::graph::{Building, outline_of};
use crate::knowledge::KnowledgeBase;
use crate::knowledge::classes;
use crate::knowledge::told::attach::REACH;
use crate::knowledge::told::closing::{self, lists_robots};
use crate::knowledge::told::kinds::{fixed, unread};
use crate::knowledge::told::{Object, Told};
use crate::site::clock::stored;
use crate::words::number::number;
use crate::words::point::point;
use crate::words::suggest::did_you_mean;

/// A fact as it is said.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Tell {
    /// The class, in letters of any size: `DOORS`, `robots`.
    pub class: String,
    /// The object: its name, `x,y`, `door 7` or `room d`.
    pub object: String,
    pub property: String,
    /// The value: a number, a text, `true` or `false`.
    pub value: String,
    /// When it ends, as [`KnowledgeBase::moment`] reads times.
    pub until: Option<String>,
    /// Whether the property may be one that no rule reads and nothing gives.
    pub new_property: bool,
}

impl Tell {
    /// The columns of the row that keeps the fact.
    pub fn row(
        &self,
        tx: &mut Tx<'_>,
        site: &KnowledgeBase,
        rules: &RuleBase,
        author: &Author,
    ) -> Result<Vec<(&'static str, Cell)>> {
        self.row_about(tx, (site, rules), author, None)
    }

    /// The same about an object that is known; where none is, its name is looked up in what the last build kept.
    pub(super) fn row_about(
        &self,
        tx: &mut Tx<'_>,
        (site, rules): (&KnowledgeBase, &RuleBase),
        author: &Author,
        object: Option<Object>,
    ) -> Result<Vec<(&'static str, Cell)>> {
        let told = site.told(tx, rules)?;
        let schema = site.schema(&told);
        let class = self.class(&schema)?;
        self.check_property(&class, &schema, rules)?;
        let object = match object {
            Some(object) => object,
            None => self.find((tx, site), &class, &schema, &told)?,
        };
        let kind = self.kind(tx, &class, &schema)?;
        let (kind, value) = if lists_robots(&class, &self.property) {
            ("text", robots_of(&told, &self.value)?)
        } else {
            self.value(&class, kind)?
        };
        let mut row = vec![
            ("class", Cell::from(class.as_str())),
            ("property", self.property.as_str().into()),
            ("kind", kind.into()),
            ("value", value),
            ("who", author.who.as_str().into()),
            ("why", author.why.as_str().into()),
            ("at", stored(site.clock().now()).as_str().into()),
        ];
        match object {
            Object::Key(key) => row.push(("key", key.as_str().into())),
            Object::Point([x, y], segment) => {
                row.extend([("x", x.into()), ("y", y.into())]);
                let ends = ["x0", "y0", "x1", "y1"];
                row.extend(
                    segment.into_iter().flat_map(|segment| ends.into_iter().zip(segment.map(Cell::from))),
                );
            }
        }
        if let Some(until) = &self.until {
            row.push(("until", end(site, until)?.as_str().into()));
        }
        Ok(row)
    }

    /// The value as the property holds it, whatever object it is of: number, text or truth, and the cell.
    pub(super) fn typed(
        &self,
        tx: &mut Tx<'_>,
        site: &KnowledgeBase,
        rules: &RuleBase,
    ) -> Result<(&'static str, Cell)> {
        let schema = site.schema(&site.told(tx, rules)?);
        self.check_property(&self.class, &schema, rules)?;
        let kind = self.kind(tx, &self.class, &schema)?;
        self.value(&self.class, kind)
    }

    /// What values of the property are, as far as anybody says.
    fn kind(&self, tx: &mut Tx<'_>, class: &str, schema: &Schema) -> Result<Option<Type>> {
        let kind = schema.kind(class, &self.property).or_else(|| fixed(class, &self.property));
        if kind.is_some() { Ok(kind) } else { concluded(tx, class, &self.property) }
    }

    fn class(&self, schema: &Schema) -> Result<String> {
        let class = self.class.to_uppercase();
        if schema.has(&class) {
            return Ok(class);
        }
        let help = did_you_mean(&class, schema.classes());
        let help =
            help.or_else(|| Some(format!("there are {}", schema.classes().collect::<Vec<_>>().join(", "))));
        let message =
            format!("there is no class {class}: no planner gives it, and no rule reads such a table");
        Err(Error::said(Code::TellUnknownClass, message, help))
    }

    fn check_property(&self, class: &str, schema: &Schema, rules: &RuleBase) -> Result<()> {
        let property = self.property.as_str();
        if schema.key_of(class).is_some_and(|key| key.iter().any(|part| part == property)) {
            let message = format!("{class}.{property} says which object it is, and cannot be told");
            return Err(Error::said(Code::TellKey, message, None));
        }
        let Some((message, meant)) = unread(class, property, schema, rules).filter(|_| !self.new_property)
        else {
            return Ok(());
        };
        let help =
            meant.unwrap_or_else(|| "`adit tell --new` tells a property that no rule reads yet".to_owned());
        Err(Error::said(Code::TellUnknownProperty, message, Some(help)))
    }

    /// Which object is meant. What has a number now is at once turned into a point.
    fn find(
        &self,
        (tx, site): (&mut Tx<'_>, &KnowledgeBase),
        class: &str,
        schema: &Schema,
        told: &Told,
    ) -> Result<Object> {
        let text = self.object.trim();
        if class == "DOORWAYS" {
            let building = Building::read(tx)?;
            if let Some(point) = place::split(text) {
                return place::at(&site.world(tx)?, &building, point);
            }
            let doorway = building.doorway_named(text).or_else(|| {
                let number: i64 = text.parse().ok()?;
                building.doorways.iter().find(|doorway| doorway.doorway == number)
            });
            let unknown = || unknown("doorway", text, building.doorways.iter().map(Building::name));
            return doorway.map(|doorway| place::object(Building::segment(doorway))).ok_or_else(unknown);
        }
        if class == "SPACES" {
            let building = Building::read(tx)?;
            let space = building.space_named(text).or_else(|| {
                let number: i64 = text.parse().ok()?;
                building.spaces.iter().find(|space| space.space == number)
            });
            if let Some(at) = point(text) {
                return Ok(Object::Point([at.x, at.y], None));
            }
            let names = building.spaces.iter().filter_map(|space| building.space(space.space));
            return space
                .map(|space| Object::Point([space.x, space.y], None))
                .ok_or_else(|| unknown("space", text, names));
        }
        let has_place = schema.kind(class, "x0").is_some() && schema.kind(class, "y1").is_some();
        if let Some(at) = point(text).filter(|_| has_place) {
            let segment = if class == "DOORS" { Some(door_at(tx, at)?) } else { None };
            let at = segment.map_or(at, |segment| nearest(at, segment));
            return Ok(Object::Point([at.x, at.y], segment));
        }
        let name = text.split_once(' ').map_or(text, |(kind, name)| {
            let is_kind = ["door", "doors", "room", "rooms"].contains(&kind.to_lowercase().as_str());
            if is_kind { name.trim() } else { text }
        });
        match class {
            "DOORS" => door(tx, name),
            "ROOMS" => room(tx, name),
            _ => key(tx, class, schema, told, text).map(Object::Key),
        }
    }

    fn value(&self, class: &str, kind: Option<Type>) -> Result<(&'static str, Cell)> {
        let text = self.value.as_str();
        let truth = match text {
            "true" | "yes" => Some(true),
            "false" | "no" => Some(false),
            _ => None,
        };
        let found = text.parse::<f64>().ok().filter(|number| number.is_finite());
        let wrong = |wanted: &str| {
            let message = format!("{class}.{} holds {wanted}, and `{text}` is none", self.property);
            Error::said(Code::TellType, message, None)
        };
        // of what routes weigh alone: elsewhere a class may mean what it likes by the word
        let weighs = self.property == "hardness" && ["ROOMS", "DOORS"].contains(&class);
        let as_truth = |truth: bool| ("truth", Cell::Integer(truth.into()));
        let as_number = |number: f64| ("number", Cell::Real(number));
        match kind {
            Some(Type::Truth) => truth
                .or_else(|| found.filter(|found| [0.0, 1.0].contains(found)).map(|found| found != 0.0))
                .map(as_truth)
                .ok_or_else(|| wrong("truth values (true or false)")),
            Some(Type::Number) if weighs && found.is_some_and(|found| found < 0.0) => {
                Err(wrong("numbers that are not negative"))
            }
            Some(Type::Number) => found.map(as_number).ok_or_else(|| wrong("numbers")),
            Some(Type::Text) => Ok(("text", text.into())),
            None => Ok(truth.map(as_truth).or(found.map(as_number)).unwrap_or(("text", text.into()))),
        }
    }
}

/// When something ends that people say; in UTC.
pub(super) fn end(site: &KnowledgeBase, until: &str) -> Result<String> {
    let clock = site.clock();
    let end = clock.parse(until)?;
    if end <= clock.now() {
        let message = format!("the end `{until}` is {}, and that is over", stored(end));
        let help = "say when it will end, or leave it out".to_owned();
        return Err(Error::said(Code::TellPast, message, Some(help)));
    }
    Ok(stored(end))
}

/// A list of robots, each of which there is.
fn robots_of(told: &Told, list: &str) -> Result<Cell> {
    let (robots, names) = (told.robots(), closing::names(list));
    if names.is_empty() {
        return Err(Error::said(Code::TellType, "no robot is named", None));
    }
    if let Some(name) = names.iter().find(|name| !robots.contains(name)) {
        let help = did_you_mean(name, robots.iter().map(String::as_str));
        let help = help.or_else(|| Some(format!("the site has {}", robots.join(", "))));
        let message = format!("there is no robot `{name}`");
        return Err(Error::said(Code::TellUnknownObject, message, help));
    }
    Ok(names.join(", ").as_str().into())
}

/// That there is no such thing, and what may be meant.
fn unknown(what: &str, name: &str, names: impl Iterator<Item = String>) -> Error {
    let names: Vec<String> = names.collect();
    let help = did_you_mean(name, names.iter().map(String::as_str));
    let help = help.or_else(|| Some(format!("say a {what}'s name, or a point as x,y")));
    Error::said(Code::TellUnknownObject, format!("there is no {what} `{name}`"), help)
}

/// The type of what rules concluded of a property so far.
fn concluded(tx: &mut Tx<'_>, class: &str, property: &str) -> Result<Option<Type>> {
    let class = class.to_lowercase();
    let table = tx.read_table("derivations")?;
    let column = |name: &str| table.column(name).map(|column| &column.values);
    let (Some(classes), Some(properties), Some(values)) =
        (column("class"), column("property"), column("value"))
    else {
        return Ok(None);
    };
    let (class, property) = (Cell::from(class.as_str()), Cell::from(property));
    let is_meant = |row: &usize| classes[*row] == class && properties[*row] == property;
    let found = (0..values.len()).find(|row| is_meant(row) && values[*row] != Cell::Null);
    Ok(found.and_then(|row| match values[row] {
        Cell::Text(_) => Some(Type::Text),
        Cell::Real(_) => Some(Type::Number),
        // truth values are whole numbers there, numbers are not
        Cell::Integer(_) => Some(Type::Truth),
        Cell::Null | Cell::Blob(_) => None,
    }))
}

fn nearest(at: Point, [x0, y0, x1, y1]: [f64; 4]) -> Point {
    at.nearest_on(Point::new(x0, y0), Point::new(x1, y1))
}

/// The segment of the door at a point: the nearest one, of equals the first.
fn door_at(tx: &mut Tx<'_>, at: Point) -> Result<[f64; 4]> {
    let mut best = nearest_door(tx.doors_near([at.x, at.y], REACH)?, at);
    if best.is_none_or(|(distance, ..)| distance > REACH) {
        // only to say how far the nearest one is
        best = nearest_door(tx.doors()?, at);
    }
    match best {
        Some((distance, _, segment)) if distance <= REACH => Ok(segment),
        Some((distance, door, _)) => {
            let at = format!("{},{}", number(at.x), number(at.y));
            let message = format!(
                "no door is within {REACH} m of {at}: the nearest, door {door}, is {} m away",
                number(distance)
            );
            Err(Error::said(
                Code::TellNoDoor,
                message,
                Some("name a door, or say a point nearer to it".to_owned()),
            ))
        }
        None => Err(Error::said(
            Code::TellNoDoor,
            "the site has no door",
            Some("run `adit build` first".to_owned()),
        )),
    }
}

/// Of doors, not of changes of shape, the nearest to a point: its distance, number and segment.
fn nearest_door(doors: Vec<Door>, at: Point) -> Option<(f64, i64, [f64; 4])> {
    let doors = doors.into_iter().filter(|door| door.kind == DoorKind::Door);
    let measured = doors.map(|door| (nearest(at, door.segment).distance(at), door.door, door.segment));
    measured.reduce(|best, next| if next.0 < best.0 { next } else { best })
}

fn door(tx: &mut Tx<'_>, name: &str) -> Result<Object> {
    let number = name.parse().ok().filter(|number: &i64| number.to_string() == name);
    let found = match number {
        Some(number) => tx.door(number)?,
        None => None,
    };
    let Some(door) = found else {
        let help = match tx.doors()?.len() {
            0 => "run `adit build` first".to_owned(),
            1 => "there is one door, door 1; or say a point as x,y".to_owned(),
            all => format!("there are {all} doors, numbered from 1; or say a point as x,y"),
        };
        return Err(Error::said(Code::TellUnknownObject, format!("there is no door `{name}`"), Some(help)));
    };
    if door.kind != DoorKind::Door {
        let message = format!("door {name} is a change of shape, not a place that can be found again");
        let help = "tell about a room, or about a state in ROBOTS".to_owned();
        return Err(Error::said(Code::TellChange, message, Some(help)));
    }
    let [x0, y0, x1, y1] = door.segment;
    Ok(Object::Point([f64::midpoint(x0, x1), f64::midpoint(y0, y1)], Some(door.segment)))
}

fn room(tx: &mut Tx<'_>, name: &str) -> Result<Object> {
    let Some(room) = tx.room_named(name)? else {
        let rooms = tx.rooms()?;
        let help = did_you_mean(name, rooms.iter().map(|room| room.name.as_str()));
        let help = help.or_else(|| Some("say a room's name, or a point as x,y".to_owned()));
        return Err(Error::said(Code::TellUnknownObject, format!("there is no room `{name}`"), help));
    };
    let spoilt = |what| {
        let help = "run `adit build`, which cuts the rooms anew".to_owned();
        Error::said(Code::FactsProperty, format!("the outline of room {name} {what}"), Some(help))
    };
    let centre = outline_of(&room).map_err(spoilt)?.centre();
    Ok(Object::Point([centre.x, centre.y], None))
}

/// The whole key of an object that has a name of its own.
fn key(tx: &mut Tx<'_>, class: &str, schema: &Schema, told: &Told, text: &str) -> Result<String> {
    let parts = schema.key_of(class).unwrap_or_default();
    let table = match told.classes.get(class) {
        Some(table) => table.clone(),
        None => kept(tx, &class.to_lowercase())?,
    };
    let is_counted = parts.iter().any(|part| schema.kind(class, part) == Some(Type::Number));
    if parts.is_empty() || (is_counted && !told.classes.contains_key(class)) {
        let message =
            format!("objects of {class} are numbered anew by each build: nothing can be told about one");
        return Err(Error::said(Code::TellNumbered, message, None));
    }
    let keys = classes::keys(&table, parts);
    // the robot may be left out, as in `adit tune`
    let short =
        |key: &&String| parts[0] == "robot" && key.split_once('/').is_some_and(|(_, rest)| rest == text);
    let meant: Vec<&String> = match keys.iter().find(|key| *key == text) {
        Some(key) => vec![key],
        None => keys.iter().filter(short).collect(),
    };
    match meant.as_slice() {
        [key] => Ok((*key).clone()),
        [] => {
            let short = keys.iter().filter(|_| parts[0] == "robot").filter_map(|key| key.split_once('/'));
            let names = short.map(|(_, rest)| rest).chain(keys.iter().map(String::as_str));
            let help = did_you_mean(text, names);
            Err(Error::said(Code::TellUnknownObject, format!("{class} has no object `{text}`"), help))
        }
        [one, other, ..] => {
            let message = format!("`{text}` may be {one} or {other} of {class}");
            Err(Error::said(Code::TellUnknownObject, message, Some("give the whole key".to_owned())))
        }
    }
}

/// What a planner gave of a class, as the last build kept it.
fn kept(tx: &mut Tx<'_>, table: &str) -> Result<adit_planners::facts::Table> {
    if tx.user_tables()?.iter().any(|known| known.name == table) {
        return crate::knowledge::tables::read(&tx.read_table(table)?);
    }
    Ok(adit_planners::facts::Table::default())
}
