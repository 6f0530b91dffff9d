//! The tables that people tune, and named tunings.

use std::collections::BTreeMap;
use std::path::PathBuf;

use adit_db::relation::{Form, Reference, Relation, RelationColumn};
use adit_db::{Cell, Tx};
use axum::Json;
use axum::http::header;
use axum::response::{IntoResponse, Response};
use serde::Serialize;
use utoipa::ToSchema;

use super::extract::{Named, Site};
use crate::edit;
use crate::error::{Code, Error, Result};
use crate::knowledge::{LAYOUT, generation};
use crate::knowledge::{tables, tunings};
use crate::serve::fault::{Answered, Fault};
use crate::site::sheet;
use crate::words::suggest::did_you_mean;

#[derive(Serialize, ToSchema)]
pub struct TablesAnswer {
    generation: u64,
    /// The tables: the robots' first.
    tables: Vec<TableOf>,
}

#[derive(Serialize, ToSchema)]
struct TableOf {
    table: String,
    columns: Vec<ColumnOf>,
    /// Names what it holds, for the edit `take`.
    version: String,
    /// The rows' keys, as edits name them.
    keys: Vec<String>,
    /// A value for each column.
    #[schema(value_type = Vec<Vec<serde_json::Value>>)]
    rows: Vec<Vec<serde_json::Value>>,
    /// Cells that a tuning which is on sets otherwise.
    overridden: Vec<Overridden>,
    /// What rules conclude of the rows.
    concluded: Vec<ConcludedOf>,
    /// Columns that name rows of other tables, which such rows go with.
    refers: Vec<Reference>,
}

#[derive(Serialize, ToSchema)]
struct ConcludedOf {
    property: String,
    /// A value for each row; null: unknown.
    #[schema(value_type = Vec<serde_json::Value>)]
    values: Vec<serde_json::Value>,
}

#[derive(Serialize, ToSchema)]
struct ColumnOf {
    name: String,
    /// number, truth or text.
    kind: &'static str,
    /// Whether it is a part of the key.
    key: bool,
    /// Its unit, where it has one.
    unit: Option<&'static str>,
    /// Whether it needs a value.
    required: bool,
}

#[derive(Serialize, ToSchema)]
struct Overridden {
    key: String,
    column: String,
    #[schema(value_type = serde_json::Value)]
    value: Cell,
    tuning: String,
}

/// The tables that people tune: robots, changes, loads, hours, and the site's own.
#[utoipa::path(get, path = "/api/tables", tag = "tables", responses((status = 200, body = TablesAnswer)))]
pub async fn tables(site: Site) -> Answered<Json<TablesAnswer>> {
    site.read(read_all).await.map(Json)
}

fn read_all(tx: &mut Tx<'_>) -> Result<TablesAnswer> {
    let names = tuned(tx)?;
    let in_force = tunings::in_force(tx)?;
    let derivations = tx.read_table("derivations")?;
    let mut tables = Vec::new();
    for name in names {
        let relation = tx.read_table(&name)?;
        // a table without a key has no rows that an edit could name
        if !relation.columns.iter().any(|column| column.key > 0) {
            continue;
        }
        let overridden = in_force.iter().filter(|cell| cell.table == name).map(|cell| Overridden {
            key: cell.key.clone(),
            column: cell.column.clone(),
            value: cell.value.clone(),
            tuning: cell.tuning.clone(),
        });
        let mut table = table(&relation, overridden.collect());
        table.concluded = concluded(&derivations, &table);
        table.refers = tx.references(&name)?;
        tables.push(table);
    }
    Ok(TablesAnswer { generation: generation::read(tx)?, tables })
}

/// The tables that people tune, by name.
fn tuned(tx: &mut Tx<'_>) -> Result<Vec<String>> {
    let own = tx.user_tables()?.into_iter().filter(|table| table.form == Form::Table);
    let has_places = tx.site_value(LAYOUT)?.is_some() && !tx.places()?.is_empty();
    let of_map = has_places.then(|| "places".to_owned());
    let names = edit::TUNABLE.iter().map(ToString::to_string).chain(of_map);
    Ok(names.chain(own.map(|table| table.name)).collect())
}

/// One of these tables as a file: `robots.csv`, `robots.xlsx`. What is in it is taken back with the edit `take`.
#[utoipa::path(get, path = "/api/tables/{file}", tag = "tables",
    params(("file" = String, Path, description = "The table, and what the file is to be: `robots.csv`, `robots.xlsx`")),
    responses((status = 200, content((String = "text/csv"), (Vec<u8> = "application/vnd.openxmlformats-officedocument.spreadsheetml.sheet")))))]
pub async fn file(site: Site, Named(file): Named<String>) -> Answered<Response> {
    let (name, kind) = if let Some(name) = file.strip_suffix(".csv") {
        (name.to_owned(), "text/csv; charset=utf-8")
    } else if let Some(name) = file.strip_suffix(".xlsx") {
        (name.to_owned(), "application/vnd.openxmlformats-officedocument.spreadsheetml.sheet")
    } else {
        return Err(Fault::new(Code::TableFile, format!("{file} is neither .csv nor .xlsx")));
    };
    let path = PathBuf::from(&file);
    let written = site.read(move |tx| {
        let names = tuned(tx)?;
        if !names.contains(&name) {
            let help = did_you_mean(&name, names.iter().map(String::as_str));
            return Err(Error::said(Code::EditUnknownTable, format!("there is no table `{name}`"), help));
        }
        sheet::written(&path, &tx.read_table(&name)?)
    });
    let headers = [
        (header::CONTENT_TYPE, kind.to_owned()),
        (header::CONTENT_DISPOSITION, format!("attachment; filename=\"{file}\"")),
    ];
    Ok((headers, written.await?).into_response())
}

fn table(relation: &Relation, overridden: Vec<Overridden>) -> TableOf {
    let count = relation.columns.first().map_or(0, |column| column.values.len());
    let mut rows: Vec<usize> = (0..count).collect();
    // robots stand in the order that breaks ties
    if let Some(position) = relation.column("position") {
        let place = |row: &usize| match position.values[*row] {
            Cell::Integer(place) => place,
            _ => i64::MAX,
        };
        rows.sort_by_key(place);
    }
    let all_keys = tables::keys(relation);
    TableOf {
        table: relation.name.clone(),
        version: tables::version(&relation.columns),
        columns: relation.columns.iter().map(|known| column(relation, known)).collect(),
        keys: rows.iter().map(|row| all_keys[*row].clone()).collect(),
        rows: rows
            .iter()
            .map(|row| relation.columns.iter().map(|column| value(relation, column, *row)).collect())
            .collect(),
        overridden,
        concluded: Vec::new(),
        refers: Vec::new(),
    }
}

/// What the table of derivations says of the rows of another, by property.
fn concluded(derivations: &Relation, table: &TableOf) -> Vec<ConcludedOf> {
    let column = |name: &str| derivations.column(name);
    let (Some(classes), Some(keys)) = (column("class"), column("key")) else { return Vec::new() };
    let (Some(properties), Some(values)) = (column("property"), column("value")) else { return Vec::new() };
    let of = table.table.to_lowercase();
    let places: BTreeMap<&str, usize> =
        table.keys.iter().enumerate().map(|(place, key)| (key.as_str(), place)).collect();
    let mut found: BTreeMap<String, Vec<serde_json::Value>> = BTreeMap::new();
    for (row, class) in classes.values.iter().enumerate() {
        if !matches!(class, Cell::Text(class) if *class == of) {
            continue;
        }
        let Some(&place) = places.get(keys.values[row].to_string().as_str()) else { continue };
        let blank = || vec![serde_json::Value::Null; table.keys.len()];
        let known = found.entry(properties.values[row].to_string()).or_insert_with(blank);
        known[place] = match &values.values[row] {
            // of what rules conclude, truth values alone are kept as whole numbers
            Cell::Integer(truth) => (*truth != 0).into(),
            cell => serde_json::json!(cell),
        };
    }
    found.into_iter().map(|(property, values)| ConcludedOf { property, values }).collect()
}

/// Whether a column holds truth values, which SQL has as 0 and 1.
fn holds_truths(relation: &Relation, column: &RelationColumn) -> bool {
    column.declared.contains("BOOL") || (relation.name.as_str(), column.name.as_str()) == ("loads", "carried")
}

fn value(relation: &Relation, column: &RelationColumn, row: usize) -> serde_json::Value {
    match &column.values[row] {
        Cell::Integer(truth) if holds_truths(relation, column) => (*truth != 0).into(),
        cell => serde_json::json!(cell),
    }
}

fn column(relation: &Relation, column: &RelationColumn) -> ColumnOf {
    ColumnOf {
        name: column.name.clone(),
        kind: match column.declared.as_str() {
            _ if holds_truths(relation, column) => "truth",
            "REAL" | "INTEGER" => "number",
            _ => "text",
        },
        key: column.key > 0,
        unit: match column.name.as_str() {
            "height" | "width" | "length" => Some("m"),
            "speed" => Some("m/s"),
            "power" => Some("W"),
            "seconds" => Some("s"),
            "joules" => Some("J"),
            _ => None,
        },
        required: column.required,
    }
}

#[derive(Serialize, ToSchema)]
pub struct TuningsAnswer {
    tunings: Vec<TuningOf>,
}

#[derive(Serialize, ToSchema)]
struct TuningOf {
    tuning: String,
    /// Whether it counts now.
    on: bool,
    cells: Vec<adit_db::tuning::TuningCell>,
}

/// Named tunings: sets of cells that count instead of the tables' own while they are on.
#[utoipa::path(get, path = "/api/tunings", tag = "tables", responses((status = 200, body = TuningsAnswer)))]
pub async fn tunings(site: Site) -> Answered<Json<TuningsAnswer>> {
    let answer = site.read(|tx| {
        let active = tx.active_tunings()?;
        let mut tunings: Vec<TuningOf> = Vec::new();
        for cell in tx.tuning_cells()? {
            match tunings.last_mut().filter(|last| last.tuning == cell.tuning) {
                Some(last) => last.cells.push(cell),
                None => tunings.push(TuningOf {
                    tuning: cell.tuning.clone(),
                    on: active.contains(&cell.tuning),
                    cells: vec![cell],
                }),
            }
        }
        Ok(TuningsAnswer { tunings })
    });
    answer.await.map(Json)
}
