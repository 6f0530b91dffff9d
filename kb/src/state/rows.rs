//! What planners assert of rooms, doors and areas, as rows of the database, and back.

use std::borrow::Cow;

use adit_db::Derived;
use adit_db::area::Area;
use adit_db::layer::AreaOutline;
use adit_db::place::Place;
use adit_db::room::Room;
use adit_db::schema::{Column, Kind, Part, Row, Value};
use adit_engine::Class;
use adit_planners::facts::{self, Table};
use adit_planners::world::World;
use rayon::prelude::*;

use crate::error::{Code, Error, Result};
use crate::graph::{Building, outline_of};

/// The columns of a class, by name, each a problem of its own where it is missing.
struct Columns<'a> {
    class: &'static str,
    table: &'a Table,
}

impl<'a> Columns<'a> {
    fn numbers(&self, property: &str) -> Result<&'a [Option<f64>]> {
        self.table.numbers(property).map_err(|what| self.missing(&what))
    }

    fn texts(&self, property: &str) -> Result<&'a [Option<String>]> {
        self.table.texts(property).map_err(|what| self.missing(&what))
    }

    fn truths(&self, property: &str) -> Result<&'a [Option<bool>]> {
        self.table.truths(property).map_err(|what| self.missing(&what))
    }

    /// The numbers of four properties, row by row.
    fn quads(&self, properties: [&str; 4]) -> Result<Vec<[f64; 4]>> {
        let columns = [
            self.numbers(properties[0])?,
            self.numbers(properties[1])?,
            self.numbers(properties[2])?,
            self.numbers(properties[3])?,
        ];
        let row = |index: usize| columns.map(|column| column[index].unwrap_or(f64::NAN));
        Ok((0..self.table.len()).map(row).collect())
    }

    fn missing(&self, what: &str) -> Error {
        Error::said(Code::FactsProperty, format!("class {}: {what}", self.class), None)
    }
}

fn key(value: Option<f64>) -> i64 {
    value.unwrap_or(0.0) as i64
}

/// Rooms or doors as the inference holds them, without what rules say.
pub fn class<R: Row>(name: &str, rows: &[R]) -> Class {
    let number = |value| match value {
        Value::Integer(integer) => Some(integer as f64),
        Value::Real(real) => Some(real),
        _ => None,
    };
    let text = |value| if let Value::Text(text) = value { Some(text) } else { None };
    let truth = |value| if let Value::Truth(truth) = value { Some(truth) } else { None };
    let with = |class: Class, column: &Column<R>| {
        let values = rows.iter().map(column.get);
        match column.kind {
            Kind::Integer | Kind::Real => class.numbers(column.name, values.map(number)),
            Kind::Text => class.texts(column.name, values.map(text)),
            Kind::Truth => class.truths(column.name, values.map(truth)),
        }
    };
    R::columns_of(Part::Cut).fold(Class::new(name, &[R::COLUMNS[0].name]), with)
}

/// Rooms as rows, without what rules say; a planner that knows of no outlines makes rectangles, and of no discs,
/// berths or spaces none.
pub fn rooms(table: &Table) -> Result<Vec<Room>> {
    let bare = [
        ("outline", facts::Column::Text(vec![None; table.len()])),
        ("radius", facts::Column::Number(vec![None; table.len()])),
        ("berth", facts::Column::Number(vec![None; table.len()])),
        ("berth_cost", facts::Column::Number(vec![None; table.len()])),
        ("space", facts::Column::Number(vec![None; table.len()])),
    ];
    let mut table = Cow::Borrowed(table);
    for (property, column) in bare {
        if table.column(property).is_none() {
            table = Cow::Owned(table.into_owned().with(property, column));
        }
    }
    let rooms: Vec<Room> = of_table("ROOMS", &table)?;
    let wrong = |(row, room): (usize, &Room)| Some((row, outline_of(room).err()?));
    match rooms.par_iter().enumerate().find_map_first(wrong) {
        None => Ok(rooms),
        Some((row, what)) => {
            let message = format!("class ROOMS: `outline` of object {} {what}", row + 1);
            Err(Error::said(Code::FactsProperty, message, None))
        }
    }
}

/// Rooms or doors as rows, without what rules say.
pub fn of_table<R: Row>(class: &'static str, table: &Table) -> Result<Vec<R>> {
    let mut rows = vec![R::default(); table.len()];
    let (first, rest) = rows.split_at_mut(CHUNK.min(table.len()));
    let part = |(number, rows): (usize, &mut [R])| fill(class, table, (number + 1) * CHUNK, rows);
    let (first, rest) = rayon::join(
        || fill(class, table, 0, first),
        || rest.par_chunks_mut(CHUNK).enumerate().map(part).collect::<Vec<_>>(),
    );
    first?;
    rest.into_iter().collect::<Result<()>>()?;
    Ok(rows)
}

/// So many rows are made one after the other, beside others.
const CHUNK: usize = 8_192;

/// Puts what stands in a table from a row on into rows.
fn fill<R: Row>(class: &'static str, table: &Table, from: usize, rows: &mut [R]) -> Result<()> {
    let columns = Columns { class, table };
    let to = from + rows.len();
    for column in R::columns_of(Part::Cut) {
        let is_whole = column.kind == Kind::Integer;
        let number = |number| if is_whole { Value::Integer(number as i64) } else { Value::Real(number) };
        let property = column.name;
        match column.kind {
            Kind::Integer | Kind::Real => {
                put(rows, column, &columns.numbers(property)?[from..to], |v| number(*v))
            }
            Kind::Text => put(rows, column, &columns.texts(property)?[from..to], |v| Value::Text(v)),
            Kind::Truth => put(rows, column, &columns.truths(property)?[from..to], |v| Value::Truth(*v)),
        }
        .map_err(|row| {
            columns.missing(&format!("object {} has no `{property}`, or one that cannot be", from + row))
        })?;
    }
    Ok(())
}

/// Puts values into a column of rows; an error is the number of the row, from 1, that cannot take its value.
fn put<'v, R, T>(
    rows: &mut [R],
    column: &Column<R>,
    values: &'v [Option<T>],
    lent: impl Fn(&'v T) -> Value<'v>,
) -> std::result::Result<(), usize> {
    let mut pairs = rows.iter_mut().zip(values);
    let refused =
        pairs.position(|(row, value)| !(column.put)(row, value.as_ref().map_or(Value::Null, &lent)));
    refused.map_or(Ok(()), |row| Err(row + 1))
}

/// Prime areas as rows, without what rules say.
pub fn areas(table: &Table) -> Result<Vec<Area>> {
    let columns = Columns { class: "PRIME_AREAS", table };
    let keys = columns.numbers("area")?;
    let strips = columns.quads(["left_first", "left_last", "right_first", "right_last"])?;
    let row = |index: usize| Area {
        area: key(keys[index]),
        x: (strips[index][0] as i64, strips[index][1] as i64),
        y: (strips[index][2] as i64, strips[index][3] as i64),
        open: Derived::default(),
    };
    Ok((0..table.len()).map(row).collect())
}

/// The edges of the strips along x and along y, ascending.
pub fn strip_edges(table: &Table) -> Result<[Vec<f64>; 2]> {
    let columns = Columns { class: "STRIPS", table };
    let axes = columns.texts("axis")?;
    let (lows, highs) = (columns.numbers("low")?, columns.numbers("high")?);
    Ok(["x", "y"].map(|axis| {
        let mut edges: Vec<f64> = Vec::new();
        for index in (0..table.len()).filter(|&index| axes[index].as_deref() == Some(axis)) {
            if edges.is_empty() {
                edges.extend(lows[index]);
            }
            edges.extend(highs[index]);
        }
        edges
    }))
}

/// The map's places as rows.
pub fn places(world: &World) -> Vec<Place> {
    let mut places: Vec<Place> = world
        .places
        .iter()
        .map(|place| Place { place: place.name.clone(), x: place.at.x, y: place.at.y })
        .collect();
    places.sort_by(|a, b| a.place.cmp(&b.place));
    places
}

/// The areas of the map, and those that lie over it, as rows.
pub fn area_outlines(world: &World, building: &Building) -> Vec<AreaOutline> {
    let row = |area: &adit_planners::world::Area| {
        let corners: Vec<[f64; 2]> =
            area.shape.corners().into_iter().map(|corner| [corner.x, corner.y]).collect();
        let outline = serde_json::json!(corners).to_string();
        let one_way = building.one_ways.iter().find(|one_way| one_way.area == area.name);
        let heading = one_way.map(|one_way| one_way.heading);
        AreaOutline { area: area.name.clone(), kind: area.kind.clone(), outline, heading }
    };
    let mut rows: Vec<AreaOutline> = world.areas.iter().map(row).collect();
    rows.sort_by(|a, b| a.area.cmp(&b.area));
    rows
}
