//! What is closed and opened again by the name that people have for it: a doorway, a named door, an area, a space, or the
//! place at which a robot was blocked. Each becomes a fact, or takes facts back.

mod lanes;
mod one_side;

use std::collections::BTreeSet;

use adit_db::Tx;
use adit_db::edit::Edited;
use adit_db::history::Author;
use adit_db::space::Doorway;
use adit_db::told::Told as Row;
use adit_engine::RuleBase;
use adit_planners::facts::Column;
use adit_planners::geometry::tolerance::SNAP_M;
use adit_planners::geometry::{Point, Rect};

use super::place;
use super::tell::Tell;
use crate::error::{Code, Error, Result};
use crate::graph::{Building, Named};
use crate::knowledge::tables;
use crate::knowledge::told::closing::{CLOSED, CLOSED_FROM, CLOSED_TO, OPEN_TO};
use crate::knowledge::{KnowledgeBase, LAYOUT};
use crate::plan::course::numbered;
use crate::words::number::number;
use crate::words::suggest::{did_you_mean, listed};
use lanes::NEAR_M;

/// What a channel is called, before its number.
const CHANNEL: &str = "channel";

/// Something that is closed, as it is said.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Close {
    /// A name; or a point `x,y`, with the heading of a robot that was blocked there: `x,y@90`.
    pub what: String,
    /// When it ends, as [`KnowledgeBase::moment`] reads times.
    pub until: Option<String>,
    /// The robots that are kept out; all where none is said.
    pub only: Vec<String>,
    /// The robots that come through all the same; `only` says nothing then.
    pub except: Vec<String>,
    /// The space from which nobody passes it, though one still comes back; it is a doorway then.
    pub from: Option<String>,
}

impl Close {
    /// The fact that says it; nothing that has no doorway is closed.
    pub(super) fn fact(&self, tx: &mut Tx<'_>) -> Result<Tell> {
        let tell = self.told(tx)?;
        refuse_doorless(tx, &tell)?;
        Ok(tell)
    }

    fn told(&self, tx: &mut Tx<'_>) -> Result<Tell> {
        let what = self.what.trim();
        let (class, object) =
            if tx.site_value(LAYOUT)?.is_some() { of_map(tx, what)? } else { named(tx, what)? };
        if let Some(from) = &self.from {
            return self.closing_one_side(tx, (class, object), from);
        }
        let (property, value) = match (self.only.as_slice(), self.except.as_slice()) {
            ([], []) => (CLOSED, "true".to_owned()),
            (only, []) => (CLOSED_TO, only.join(", ")),
            ([], except) => (OPEN_TO, except.join(", ")),
            _ => {
                let message = "it is closed to `only` some robots, or to all `except` some, not both";
                return Err(Error::said(Code::TellUsage, message, None));
            }
        };
        if property != CLOSED && tx.site_value(LAYOUT)?.is_some() {
            let message = format!("`{what}` is closed to everybody, or to nobody");
            let classes = match class {
                "CHANNELS" => "PASSAGES",
                "DOORWAYS" => "WAYS",
                _ => "TRAVELS",
            };
            let help = format!("which robots are kept out is for a rule of {classes} to say");
            return Err(Error::said(Code::TellUsage, message, Some(help)));
        }
        Ok(Tell {
            class: class.to_owned(),
            object,
            property: property.to_owned(),
            value,
            until: self.until.clone(),
            new_property: false,
        })
    }
}

/// Refuses a space that nobody comes into through a doorway: nothing of it would be closed.
fn refuse_doorless(tx: &mut Tx<'_>, tell: &Tell) -> Result<()> {
    let name = tell.object.as_str();
    if tell.class != "SPACES" {
        return Ok(());
    }
    let building = Building::read(tx)?;
    let Some(space) = building.space_named(name).map(|space| space.space) else { return Ok(()) };
    if building.doorways.iter().any(|of| of.space1 == space || of.space2 == space) {
        return Ok(());
    }
    let message = format!("`{name}` has no doorway that could be closed");
    let help = "lay an area over the part of it that is to be kept clear".to_owned();
    Err(Error::said(Code::TellUsage, message, Some(help)))
}

/// Takes back all facts that close something; where none does, tells that it is not closed.
pub(super) fn open(
    tx: &mut Tx<'_>,
    (site, rules): (&KnowledgeBase, &RuleBase),
    what: &str,
    author: &Author,
) -> Result<Edited> {
    let tell = Close { what: what.to_owned(), ..Close::default() }.told(tx)?;
    let row = tell.row(tx, site, rules, author)?;
    let told = tx.facts_told()?;
    let mut facts: Vec<&Row> = told.iter().filter(|fact| is_about(fact, &tell.class, &row)).collect();
    if let Some(doorway) = as_doorway(tx, &tell)? {
        let row = doorway.row(tx, site, rules, author)?;
        facts.extend(told.iter().filter(|fact| is_about(fact, &doorway.class, &row)));
    }
    let is_told = facts.iter().any(|fact| opens(fact));
    facts.retain(|fact| !opens(fact));
    let mut is_open = || -> Result<bool> {
        Ok(match tell.class.as_str() {
            "DOORWAYS" => !is_shut(tx, what, &row)?,
            "NAMED_DOORS" => {
                Building::read(tx)?.doorway_named(&tell.object).is_some() && !is_shut(tx, &tell.object, &row)?
            }
            "SPACES" => {
                let building = Building::read(tx)?;
                building.space_named(&tell.object).is_some_and(|space| space.closed != Some(true))
            }
            _ => false,
        })
    };
    if facts.is_empty() && (is_told || is_open()?) {
        let message = format!("`{what}` is open already");
        return Err(Error::said(Code::TellUsage, message, None));
    }
    let mut last = None;
    for fact in facts {
        last = Some(tx.remove_row("told", &fact.id.to_string(), author)?);
    }
    if let Some(entry) = last {
        return Ok(entry);
    }
    let tell = Tell { value: "false".to_owned(), ..tell };
    let row = tell.row(tx, site, rules, author)?;
    Ok(tx.add_row("told", &row, author)?)
}

/// Whether a fact says that something is not closed.
fn opens(fact: &Row) -> bool {
    fact.property == CLOSED && fact.value == adit_db::Cell::Integer(0)
}

/// A word about a place by whose name a space was closed that is called otherwise, or about what a point means on a map that is
/// not cut into rooms.
pub(super) fn by_place(tx: &mut Tx<'_>, what: &str) -> Result<Option<String>> {
    let is_point = place::split(what).is_some();
    if tx.site_value(LAYOUT)?.is_some() {
        let meant = if is_point { of_map(tx, what.trim()).ok() } else { None };
        return Ok(meant.map(|(class, key)| {
            let of_map = match class {
                "LANES" => format!("lane {key}"),
                "CHANNELS" => format!("{CHANNEL} {key}"),
                _ => key,
            };
            format!("{what} is at {of_map}, and that is closed")
        }));
    }
    if is_point {
        return Ok(None);
    }
    let (what, building) = (what.trim(), Building::read(tx)?);
    let Ok((class, name)) = named(tx, what) else { return Ok(None) };
    let is_other = class == "SPACES" && name != what && building.space_named(what).is_none();
    Ok(is_other.then(|| format!("{what} is a place in {name}, and all of that is closed")))
}

/// A word about what was closed, and is passed all the same: the doorways of a space of which it is told that they are open.
pub(super) fn open_all_the_same(tx: &mut Tx<'_>, what: &str, fact: &str) -> Result<Option<String>> {
    let told = tx.facts_told()?;
    let is_space = |fact: &&Row| fact.class == "SPACES" && fact.property == CLOSED;
    let Some(closing) = told.iter().find(|other| other.id.to_string() == fact).filter(is_space) else {
        return Ok(None);
    };
    let building = Building::read(tx)?;
    let at = closing.at.map(|[x, y]| Point::new(x, y));
    let space = building.space_named(what.trim()).or_else(|| at.and_then(|at| building.space_at(at)));
    let Some(space) = space.map(|space| space.space) else { return Ok(None) };
    let of_space = building.doorways.iter().filter(|of| of.space1 == space || of.space2 == space);
    let is_told_open = |doorway: &&Doorway| {
        let middle = Building::segment(doorway).middle();
        let is_at = |[x, y]: [f64; 2]| Point::new(x, y).distance(middle) <= SNAP_M;
        doorway.closed != Some(true)
            && told.iter().any(|fact| fact.class == "DOORWAYS" && opens(fact) && fact.at.is_some_and(is_at))
    };
    let open: Vec<String> = of_space.filter(is_told_open).map(Building::name).collect();
    Ok((!open.is_empty()).then(|| {
        let all = open.join(", ");
        let (was, stays) = if open.len() == 1 { ("was", "stays") } else { ("were", "stay") };
        format!("{all} {was} declared open and {stays} open: to close {what} there, too, close {all}")
    }))
}

/// A word about what was opened, and is shut all the same: by hours, by what it is, or by another closing.
pub(super) fn shut_all_the_same(tx: &mut Tx<'_>, what: &str) -> Result<Option<String>> {
    if tx.site_value(LAYOUT)?.is_some() || place::split(what).is_some() {
        return Ok(None);
    }
    let what = what.trim();
    // what was made with it may have taken the name away
    let Ok((class, object)) = named(tx, what) else { return Ok(None) };
    let building = Building::read(tx)?;
    let is_doorway_shut = |name: &str| {
        building
            .doorway_named(name)
            .is_some_and(|doorway| doorway.closed == Some(true) || doorway.closed_from.is_some())
    };
    let witness = match class {
        "DOORWAYS" | "NAMED_DOORS" => is_doorway_shut(&object).then(|| object.clone()),
        "SPACES" => {
            let space = building.space_named(&object).filter(|space| space.closed == Some(true));
            space.map(|_| object.clone())
        }
        _ => room_shut_in(tx, &object)?,
    };
    Ok(witness.map(|witness| format!("{what} stays shut all the same: ask why about {witness:?}")))
}

/// A word about what has opening hours, and was told to be open whatever they say.
pub(super) fn whatever_the_hours(
    tx: &mut Tx<'_>,
    site: &KnowledgeBase,
    what: &str,
    fact: &str,
) -> Result<Option<String>> {
    let told = tx.facts_told()?;
    if !told.iter().any(|row| row.id.to_string() == fact && opens(row)) {
        return Ok(None);
    }
    let mut hours = site.site().hours.clone();
    hours.extend(tx.hours()?);
    let building = Building::read(tx)?;
    let what = what.trim();
    let door = building.doorway_named(what).map(Building::name);
    let is_it = |name: &str| name == what || door.as_deref() == Some(name);
    Ok(hours.iter().any(|of| is_it(&of.name)).then(|| {
        format!(
            "{what} is open from now on whatever its opening hours say; once fact {fact} is taken back, or this is undone, \
             they count again"
        )
    }))
}

/// A room of an area, where none of them is entered.
fn room_shut_in(tx: &mut Tx<'_>, area: &str) -> Result<Option<String>> {
    let table = tables::kept(tx, "area_rooms")?;
    let (Some(Column::Text(areas)), Some(Column::Number(numbers))) =
        (table.column("area"), table.column("room"))
    else {
        return Ok(None);
    };
    let inside = areas.iter().zip(numbers).filter(|(of, _)| of.as_deref() == Some(area));
    let inside: Vec<i64> = inside.filter_map(|(_, number)| Some((*number)? as i64)).collect();
    let mut rooms = tx.rooms()?;
    rooms.retain(|room| inside.contains(&room.room));
    let is_shut = !rooms.is_empty() && rooms.iter().all(|room| room.passable.value != Some(true));
    Ok(rooms.first().filter(|_| is_shut).map(|room| format!("room {}", room.name)))
}

/// A word about what is closed for longer than the fact says that was told last, or was closed already, since another one closes
/// it, too.
pub(super) fn for_longer(tx: &mut Tx<'_>, what: &str, fact: &str) -> Result<Option<String>> {
    let told = tx.facts_told()?;
    let Some(last) = told.iter().find(|other| other.id.to_string() == fact) else { return Ok(None) };
    let closes_it = |other: &&Row| {
        other.property == CLOSED
            && other.value == adit_db::Cell::Integer(1)
            && (&other.class, &other.key, other.at, other.segment)
                == (&last.class, &last.key, last.at, last.segment)
    };
    let endless = |other: &&Row| (other.until.is_none(), other.until.clone());
    let Some(end) = &last.until else {
        let is_another = |other: &&Row| other.id != last.id && other.until.is_none();
        let other = told.iter().filter(closes_it).find(is_another).filter(|_| last.property == CLOSED);
        return Ok(other.map(|other| {
            format!(
                "{what} was closed already, by fact {}: it stays closed when this one is taken back",
                other.id
            )
        }));
    };
    let longest = told.iter().filter(closes_it).max_by_key(endless).filter(|other| other.id != last.id);
    Ok(longest.filter(|other| other.until.as_ref().is_none_or(|until| until > end)).map(|other| {
        let until = other.until.as_ref().map_or_else(
            || "keeps it closed indefinitely".to_owned(),
            |until| format!("keeps it closed until {until}"),
        );
        format!("{what} stays closed after that: fact {} {until}", other.id)
    }))
}

/// Whether a fact closes or opens what a row of facts is about.
fn is_about(fact: &Row, class: &str, row: &[(&str, adit_db::Cell)]) -> bool {
    let value = |name: &str| row.iter().find(|(column, _)| *column == name).map(|(_, cell)| cell.clone());
    let is_same = |name: &str, of: Option<f64>| match value(name) {
        Some(adit_db::Cell::Real(real)) => of.is_some_and(|of| (of - real).abs() < 1e-6),
        _ => of.is_none(),
    };
    let ends = fact.segment.map_or([None; 4], |segment| segment.map(Some));
    fact.class == class
        && [CLOSED, CLOSED_TO, OPEN_TO, CLOSED_FROM].contains(&fact.property.as_str())
        && fact.key.as_deref().map(adit_db::Cell::from) == value("key")
        && is_same("x0", ends[0])
        && is_same("y0", ends[1])
        && is_same("x1", ends[2])
        && is_same("y1", ends[3])
        && (fact.segment.is_some()
            || is_same("x", fact.at.map(|at| at[0])) && is_same("y", fact.at.map(|at| at[1])))
}

/// The same, told of the doorway that a named door is.
fn as_doorway(tx: &mut Tx<'_>, tell: &Tell) -> Result<Option<Tell>> {
    let is_doorway = tell.class == "NAMED_DOORS" && Building::read(tx)?.doorway_named(&tell.object).is_some();
    Ok(is_doorway.then(|| Tell { class: "DOORWAYS".to_owned(), ..tell.clone() }))
}

/// Whether a doorway is closed, by whatever: that of a name, or the one about whose middle a fact is told.
fn is_shut(tx: &mut Tx<'_>, what: &str, row: &[(&str, adit_db::Cell)]) -> Result<bool> {
    let building = Building::read(tx)?;
    let real = |name: &str| match row.iter().find(|(column, _)| *column == name) {
        Some((_, adit_db::Cell::Real(value))) => Some(*value),
        _ => None,
    };
    let middle = real("x").zip(real("y")).map(|(x, y)| Point::new(x, y));
    let is_meant = |doorway: &&Doorway| {
        middle.is_some_and(|middle| Building::segment(doorway).middle().distance(middle) <= SNAP_M)
    };
    let doorway = building.doorway_named(what.trim()).or_else(|| building.doorways.iter().find(is_meant));
    Ok(doorway.is_some_and(|doorway| doorway.closed == Some(true) || doorway.closed_from.is_some()))
}

/// What people have a name for, with its class. A doorway in which a named door stands is that door, whatever it is called.
fn named(tx: &mut Tx<'_>, what: &str) -> Result<(&'static str, String)> {
    if place::split(what).is_some() {
        return Ok(("DOORWAYS", what.to_owned()));
    }
    let building = Building::read(tx)?;
    let named = Named {
        areas: names(tx, "areas", "area")?,
        doors: names(tx, "named_doors", "door")?,
        building: &building,
    };
    let door = building.doorway_named(what).map(Building::name);
    let door = door.filter(|door| named.class_of(door) == Some("NAMED_DOORS"));
    let name = door.as_deref().unwrap_or(what);
    if let Some(class) = named.class_of(name) {
        return Ok((class, name.to_owned()));
    }
    // a space with two places has the name of neither, and people mean it by either
    if let Some(space) = space_about(tx, what, &building)? {
        return Ok(("SPACES", space));
    }
    let known: BTreeSet<String> = named.names().collect();
    let help = did_you_mean(what, known.iter().map(String::as_str));
    let is_heading = what.split_once('@').is_some_and(|(at, _)| place::split(at).is_some());
    let help = is_heading
        .then(|| "behind the @ stands where the robot was heading, in degrees: x,y@90".to_owned())
        .or(help)
        .or_else(|| listed("there", known.iter().map(String::as_str)))
        .or_else(|| Some("say a doorway, a space, an area, a named door, or a point as x,y".to_owned()));
    Err(Error::said(
        Code::TellUnknownObject,
        format!("the site has nothing called `{what}` that could be closed"),
        help,
    ))
}

/// The space in which a place lies.
fn space_about(tx: &mut Tx<'_>, place: &str, building: &Building) -> Result<Option<String>> {
    let ends = tx.places()?;
    let Some(at) = ends.iter().find(|of| of.place == place).map(|of| Point::new(of.x, of.y)) else {
        return Ok(None);
    };
    Ok(building.space_at(at).and_then(|space| building.space(space.space)))
}

/// Of a map that is not cut into rooms, what can be closed, with its class: a lane, a channel, a doorway, ...; or the one at a
/// point, along the heading where one is said.
fn of_map(tx: &mut Tx<'_>, what: &str) -> Result<(&'static str, String)> {
    let (channels, building) = (channels(tx)?, Building::read(tx)?);
    let (lanes, of_lanes) = (lanes::names(tx)?, lanes::meant(tx, what)?);
    if let Some(meant) = of_lanes {
        return Ok(meant);
    }
    let point = place::split(what);
    if let Some(number) =
        numbered(what, CHANNEL).filter(|number| channels.iter().any(|(known, _)| known == number))
    {
        return Ok(("CHANNELS", number.to_string()));
    }
    if building.doorway_named(what).is_some() {
        return Ok(("DOORWAYS", what.to_owned()));
    }
    if let Some((at, heading)) = point {
        if let Some(lane) = lanes::at(tx, what, (at, heading))? {
            return Ok(lane);
        }
        let far = |doorway: &&Doorway| Building::segment(doorway).distance(at);
        let near = building.doorways.iter().min_by(|one, other| far(one).total_cmp(&far(other)));
        if let Some(doorway) = near.filter(|doorway| far(doorway) <= NEAR_M) {
            return Ok(("DOORWAYS", Building::name(doorway)));
        }
        let along = |rect: &Rect| {
            heading.map(f64::to_radians).is_none_or(|heading| {
                (heading.cos().abs() >= heading.sin().abs()) == (rect.dx() >= rect.dy())
            })
        };
        let here: Vec<_> = channels.iter().filter(|(_, rect)| rect.contains(at)).collect();
        let meant: Vec<_> = here.iter().filter(|(_, rect)| here.len() == 1 || along(rect)).collect();
        if let [(number, _)] = meant[..] {
            return Ok(("CHANNELS", number.to_string()));
        }
        if !here.is_empty() {
            let numbers: Vec<String> = here.iter().map(|(number, _)| format!("channel {number}")).collect();
            let message = format!("{what} lies in {}", numbers.join(" and in "));
            let help = "say which, or the heading as well: x,y@90".to_owned();
            return Err(Error::said(Code::TellUnknownObject, message, Some(help)));
        }
    }
    let mut known: Vec<String> = channels.iter().map(|(number, _)| format!("channel {number}")).collect();
    known.extend(building.doorways.iter().map(Building::name));
    known.extend(lanes);
    // of several graphs a lane is called by its graph and number
    let ending = what.rsplit_once(' ').map(|(_, key)| format!(":{key}"));
    let of_graphs = known.iter().filter(|name| ending.as_ref().is_some_and(|ending| name.ends_with(ending)));
    let of_graphs: Vec<String> = of_graphs.map(|name| format!("`{name}`")).collect();
    let meant = (!of_graphs.is_empty())
        .then(|| format!("did you mean {}?", of_graphs.join(" or ")))
        .or_else(|| did_you_mean(what, known.iter().map(String::as_str)));
    let help = match (meant, known.first()) {
        (Some(help), _) => help,
        (None, Some(first)) => format!("what can be closed here has a name like `{first}`"),
        (None, None) => "nothing of this map can be closed".to_owned(),
    };
    let message = match point {
        Some((at, _)) => {
            let (x, y) = (number(at.x), number(at.y));
            format!("nothing that could be closed is within {NEAR_M} m of {x},{y}")
        }
        None => format!("the site has nothing called `{what}` that could be closed"),
    };
    Err(Error::said(Code::TellUnknownObject, message, Some(help)))
}

/// The channels that can be closed, by number; none of a map that has no such.
fn channels(tx: &mut Tx<'_>) -> Result<Vec<(usize, Rect)>> {
    if !tx.user_tables()?.iter().any(|table| table.name == "channels") {
        return Ok(Vec::new());
    }
    let relation = tx.read_table("channels")?;
    let (Some(_), Some(numbers)) = (relation.column(CLOSED), relation.column(CHANNEL)) else {
        return Ok(Vec::new());
    };
    let real = |name: &str, row: usize| match relation.value(name, row) {
        Some(adit_db::Cell::Real(value)) => Some(*value),
        Some(adit_db::Cell::Integer(value)) => Some(*value as f64),
        _ => None,
    };
    let channel = |(row, number): (usize, &adit_db::Cell)| {
        let adit_db::Cell::Integer(number) = number else { return None };
        let side = |name| real(name, row);
        let rect = Rect { x0: side("x0")?, y0: side("y0")?, x1: side("x1")?, y1: side("y1")? };
        Some((*number as usize, rect))
    };
    Ok(numbers.values.iter().enumerate().filter_map(channel).collect())
}

/// The names of what planners gave of a class.
fn names(tx: &mut Tx<'_>, table: &str, key: &str) -> Result<Vec<String>> {
    Ok(match tables::kept(tx, table)?.column(key) {
        Some(Column::Text(names)) => names.iter().flatten().cloned().collect(),
        _ => Vec::new(),
    })
}
