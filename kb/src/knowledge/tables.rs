//! Tables of the database as classes, and planners' classes as tables.

use std::hash::{Hash, Hasher};

use adit_db::load::Load;
use adit_db::measure::Measure;
use adit_db::place::Place;
use adit_db::relation::{Relation, RelationColumn};
use adit_db::robot::{Change, State};
use adit_db::{Cell, Tx};
use adit_planners::facts::{Column, Facts, Table};
use siphasher::sip::SipHasher13;

use crate::error::{Code, Error, Result};

/// The states of the robots as a class.
pub fn robots(states: &[State]) -> Table {
    Table::default()
        .with("robot", states.iter().map(|row| row.robot.clone()).collect::<Column>())
        .with("state", states.iter().map(|row| row.state.clone()).collect::<Column>())
        .with("action", states.iter().map(|row| row.action.clone()).collect::<Column>())
        .with("height", states.iter().map(|row| row.height).collect::<Column>())
        .with("width", states.iter().map(|row| row.width).collect::<Column>())
        .with("length", states.iter().map(|row| row.length).collect::<Column>())
        .with("hardness", states.iter().map(|row| row.hardness).collect::<Column>())
        .with("position", states.iter().map(|row| row.position as f64).collect::<Column>())
        .with("speed", states.iter().map(|row| row.speed).collect::<Column>())
        .with("power", states.iter().map(|row| row.power).collect::<Column>())
}

/// The costs of changing shape as a class.
pub fn changes(changes: &[Change]) -> Table {
    Table::default()
        .with("robot", changes.iter().map(|row| row.robot.clone()).collect::<Column>())
        .with("from_state", changes.iter().map(|row| row.from_state.clone()).collect::<Column>())
        .with("to_state", changes.iter().map(|row| row.to_state.clone()).collect::<Column>())
        .with("hardness", changes.iter().map(|row| row.hardness).collect::<Column>())
        .with("seconds", changes.iter().map(|row| row.seconds).collect::<Column>())
        .with("joules", changes.iter().map(|row| row.joules).collect::<Column>())
}

/// What adds up along routes, as a class.
pub fn measures(measures: &[Measure]) -> Table {
    Table::default()
        .with("measure", measures.iter().map(|row| row.measure.clone()).collect::<Column>())
        .with("unit", measures.iter().map(|row| row.unit.clone()).collect::<Column>())
}

/// The places as a class.
pub fn places(places: &[Place]) -> Table {
    Table::default()
        .with("place", places.iter().map(|row| row.place.clone()).collect::<Column>())
        .with("x", places.iter().map(|row| row.x).collect::<Column>())
        .with("y", places.iter().map(|row| row.y).collect::<Column>())
}

/// The class HOURS of a site where nothing has hours.
fn hours() -> Table {
    Table::default().with("name", Column::Text(Vec::new())).with("open", Column::Truth(Vec::new()))
}

/// What the robots can carry as a class.
pub fn loads(loads: &[Load]) -> Table {
    Table::default()
        .with("robot", loads.iter().map(|row| row.robot.clone()).collect::<Column>())
        .with("load", loads.iter().map(|row| row.load.clone()).collect::<Column>())
        .with("height", loads.iter().map(|row| row.height).collect::<Column>())
        .with("width", loads.iter().map(|row| row.width).collect::<Column>())
        .with("carried", loads.iter().map(|row| row.carried).collect::<Column>())
}

/// The classes that every site tells, of one that was never built: without objects.
pub fn unbuilt() -> Facts {
    Facts::from([
        ("ROBOTS".to_owned(), robots(&[])),
        ("CHANGES".to_owned(), changes(&[])),
        ("HOURS".to_owned(), hours()),
        ("LOADS".to_owned(), loads(&[])),
        ("MEASURES".to_owned(), measures(&[])),
    ])
}

/// A table or view of the site's own as a class: a column holds numbers or texts; one that is declared BOOLEAN
/// holds truth values.
pub fn read(relation: &Relation) -> Result<Table> {
    let mut table = Table::default();
    for column in &relation.columns {
        table.columns.push((column.name.clone(), values(&relation.name, column)?));
    }
    Ok(table)
}

/// A truth value as people write it.
pub fn truth_of(text: &str) -> Option<bool> {
    match text.to_lowercase().as_str() {
        "true" | "yes" | "1" => Some(true),
        "false" | "no" | "0" => Some(false),
        _ => None,
    }
}

/// The keys of a table's rows as edits name them: the values of the primary key, joined by `/`. A table without one has
/// rows that nobody can name.
pub fn keys(relation: &Relation) -> Vec<String> {
    let mut parts: Vec<&RelationColumn> = relation.columns.iter().filter(|column| column.key > 0).collect();
    parts.sort_by_key(|column| column.key);
    let rows = parts.first().map_or(0, |column| column.values.len());
    let key =
        |row: usize| parts.iter().map(|part| part.values[row].to_string()).collect::<Vec<_>>().join("/");
    (0..rows).map(key).collect()
}

/// Names what a table holds, so that whoever edits it from a file can say which rows they saw.
pub fn version(columns: &[RelationColumn]) -> String {
    let mut hasher = SipHasher13::new();
    for column in columns {
        (&column.name, column.values.len()).hash(&mut hasher);
        for cell in &column.values {
            std::mem::discriminant(cell).hash(&mut hasher);
            match cell {
                Cell::Null => {}
                Cell::Integer(value) => value.hash(&mut hasher),
                Cell::Real(value) => value.to_bits().hash(&mut hasher),
                Cell::Text(text) => text.hash(&mut hasher),
                Cell::Blob(bytes) => bytes.hash(&mut hasher),
            }
        }
    }
    format!("{:016x}", hasher.finish())
}

/// Whether SQLite numbers the rows of a table: its key is a whole number, which comes first.
pub fn is_numbered(relation: &Relation) -> bool {
    let is_key = |column: &RelationColumn| column.key > 0;
    let first = relation.columns.first().is_some_and(|first| is_key(first) && first.declared == "INTEGER");
    first && relation.columns.iter().filter(|column| is_key(column)).count() == 1
}

fn values(table: &str, column: &RelationColumn) -> Result<Column> {
    let declared = column.declared.as_str();
    let is_other = |found: &str, expected: &str| {
        let message =
            format!("column `{}` of table `{table}` holds `{found}`, expected {expected}", column.name);
        Error::said(Code::TableMixed, message, None)
    };
    if declared.contains("BOOL") {
        let truth = |cell: &Cell| match cell {
            Cell::Integer(value) => Ok(Some(*value != 0)),
            Cell::Null => Ok(None),
            other => {
                let text = other.to_string();
                truth_of(&text).map(Some).ok_or_else(|| is_other(&text, "true or false"))
            }
        };
        return Ok(Column::Truth(column.values.iter().map(truth).collect::<Result<_>>()?));
    }
    if ["REAL", "INTEGER"].contains(&declared)
        && let Some(text) = column.values.iter().find(|cell| matches!(cell, Cell::Text(_)))
    {
        return Err(is_other(&text.to_string(), "numbers"));
    }
    let texts = column.values.iter().filter(|cell| matches!(cell, Cell::Text(_))).count();
    let numbers =
        column.values.iter().filter(|cell| matches!(cell, Cell::Integer(_) | Cell::Real(_))).count();
    if texts > 0 && numbers > 0 {
        let message =
            format!("column `{}` of table `{table}` holds {texts} texts and {numbers} numbers", column.name);
        return Err(Error::said(Code::TableMixed, message, Some("a rule needs one or the other".to_owned())));
    }
    let is_text = texts > 0 || (numbers == 0 && (declared.contains("CHAR") || declared.contains("TEXT")));
    let text = |cell: &Cell| match cell {
        Cell::Text(text) => Some(text.clone()),
        _ => None,
    };
    let number = |cell: &Cell| match cell {
        Cell::Integer(value) => Some(*value as f64),
        Cell::Real(value) => Some(*value),
        _ => None,
    };
    Ok(if is_text {
        column.values.iter().map(text).collect()
    } else {
        column.values.iter().map(number).collect()
    })
}

/// What a planner gave and is kept under this name; nothing where there is no such table, or it is no planner's.
pub fn kept(tx: &mut Tx<'_>, name: &str) -> Result<Table> {
    let is_kept = tx.site_value(&mark(name))?.is_some();
    if is_kept && tx.user_tables()?.iter().any(|known| known.name == name) {
        return read(&tx.read_table(name)?);
    }
    Ok(Table::default())
}

/// The site's value that says that a table is a planner's.
fn mark(name: &str) -> String {
    format!("class.{name}")
}

/// Keeps what a planner gave as a table of the database, in place of what it gave before.
pub fn keep(tx: &mut Tx<'_>, name: &str, table: &Table) -> Result<()> {
    let mark = mark(name);
    let taken = tx.user_tables()?.iter().any(|known| known.name == name);
    if taken && tx.site_value(&mark)?.is_none() {
        let message = format!(
            "a planner gives the class {}, and the site has a table `{name}` of its own",
            name.to_uppercase()
        );
        return Err(Error::said(Code::TableTaken, message, Some("rename one of them".to_owned())));
    }
    if taken && kept(tx, name).is_ok_and(|kept| kept == *table) {
        return Ok(());
    }
    let columns: Vec<(&str, &str)> = table
        .columns
        .iter()
        .map(|(property, column)| {
            let declared = match column {
                Column::Number(_) => "REAL",
                Column::Text(_) => "TEXT",
                Column::Truth(_) => "BOOLEAN",
            };
            (property.as_str(), declared)
        })
        .collect();
    let rows =
        (0..table.len()).map(|row| table.columns.iter().map(|(_, column)| cell(column, row)).collect());
    tx.replace_user_table(name, &columns, &[], rows)?;
    tx.set_site_value(&mark, Some("planner"))?;
    Ok(())
}

/// One value of a column, as SQL holds it.
pub fn cell(column: &Column, row: usize) -> Cell {
    match column {
        Column::Number(values) => values[row].map_or(Cell::Null, Cell::Real),
        Column::Text(values) => values[row].clone().map_or(Cell::Null, Cell::Text),
        Column::Truth(values) => values[row].map_or(Cell::Null, |truth| Cell::Integer(truth.into())),
    }
}

/// A number that stands for the content of tables: equal content, equal number. Negative zero counts as zero, as it
/// does in a database.
pub fn content<'t>(tables: impl IntoIterator<Item = &'t Table>) -> u64 {
    let mut hasher = SipHasher13::new();
    for table in tables {
        hash_table(table, &mut hasher);
    }
    hasher.finish()
}

pub fn hash_table(table: &Table, hasher: &mut impl Hasher) {
    for (property, column) in &table.columns {
        property.hash(hasher);
        match column {
            Column::Number(values) => values.iter().for_each(|v| v.map(|v| (v + 0.0).to_bits()).hash(hasher)),
            Column::Text(values) => values.hash(hasher),
            Column::Truth(values) => values.hash(hasher),
        }
    }
}
