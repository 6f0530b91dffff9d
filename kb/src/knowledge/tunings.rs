//! Named tunings: cells that count instead of the tables' own while their tuning is on.

use std::collections::BTreeMap;

use adit_db::tuning::TuningCell;
use adit_db::{Cell, Tx};
use adit_planners::facts::{Column, Facts};

use crate::error::{Code, Error, Result};

/// The keys of a class's rows, as people write them, by class.
pub type RowKeys = BTreeMap<String, Vec<String>>;

/// The cells of the tunings that are on. Two that say different things of one cell are an error.
pub fn in_force(tx: &mut Tx<'_>) -> Result<Vec<TuningCell>> {
    let active = tx.active_tunings()?;
    if active.is_empty() {
        return Ok(Vec::new());
    }
    let mut found: BTreeMap<(String, String, String), TuningCell> = BTreeMap::new();
    for cell in tx.tuning_cells()?.into_iter().filter(|cell| active.contains(&cell.tuning)) {
        let place = (cell.table.clone(), cell.key.clone(), cell.column.clone());
        match found.get(&place) {
            Some(other) if other.value != cell.value => return Err(conflict(other, &cell)),
            Some(_) => {}
            None => {
                found.insert(place, cell);
            }
        }
    }
    Ok(found.into_values().collect())
}

fn conflict(one: &TuningCell, other: &TuningCell) -> Error {
    let message = format!(
        "the tunings `{}` and `{}` are both on and set {}.{}.{} to {} and {}",
        one.tuning, other.tuning, one.table, one.key, one.column, one.value, other.value
    );
    let help = format!("switch one of them off: `adit tuning SITE {} off`", one.tuning);
    Error::said(Code::TuningConflict, message, Some(help))
}

/// Lays the cells over the tables as they are told.
///
/// # Returns
/// A note for each cell whose row or column is not there, unless no rule asks for its table.
pub fn lay_over(classes: &mut Facts, keys: &RowKeys, cells: &[TuningCell]) -> Result<Vec<String>> {
    let mut notes = Vec::new();
    for cell in cells {
        let class = cell.table.to_uppercase();
        let (Some(table), Some(keys)) = (classes.get_mut(&class), keys.get(&class)) else { continue };
        let row = keys.iter().position(|key| *key == cell.key);
        let column = table.columns.iter_mut().find(|(name, _)| *name == cell.column);
        if let (Some(row), Some((_, column))) = (row, column) {
            set(column, row, cell)?;
            continue;
        }
        let ending = format!("/{}", cell.key);
        let meant = keys.iter().find(|key| key.ends_with(&ending));
        let help = meant.map_or(String::new(), |key| format!(" (a key is whole: `{key}`)"));
        notes.push(format!(
            "the tuning `{}` sets {}.{}.{}, which is not there: it counts for nothing{help}",
            cell.tuning, cell.table, cell.key, cell.column
        ));
    }
    Ok(notes)
}

fn set(column: &mut Column, row: usize, cell: &TuningCell) -> Result<()> {
    let number = match &cell.value {
        Cell::Integer(value) => Some(*value as f64),
        Cell::Real(value) => Some(*value),
        _ => None,
    };
    match (column, &cell.value) {
        (Column::Number(values), Cell::Null) => values[row] = None,
        (Column::Text(values), Cell::Null) => values[row] = None,
        (Column::Truth(values), Cell::Null) => values[row] = None,
        (Column::Number(values), _) if number.is_some() => values[row] = number,
        (Column::Truth(values), Cell::Integer(value)) => values[row] = Some(*value != 0),
        (Column::Text(values), Cell::Text(text)) => values[row] = Some(text.clone()),
        (column, value) => {
            let holds = match column {
                Column::Number(_) => "numbers",
                Column::Text(_) => "texts",
                Column::Truth(_) => "truth values",
            };
            let place = format!("{}.{}.{}", cell.table, cell.key, cell.column);
            let message =
                format!("the tuning `{}` sets {place} to {value}, and it holds {holds}", cell.tuning);
            return Err(Error::said(Code::TuningType, message, None));
        }
    }
    Ok(())
}
