//! The cells of tables that weigh something.

use std::collections::BTreeSet;

use adit_planners::facts::Column;

use super::{Probe, Prober};
use crate::error::Result;
use crate::state::tunable::Lever;

/// So many rows of a table are looked at.
const ROWS: usize = 200;

impl Prober {
    /// The cells of the columns of a class that weigh: where a cell of a column changes by a hair, something weighs a little
    /// more or less, and no room is cut anew. Sizes do not: they let pass or not.
    pub(super) fn levers_in(&mut self, class: &str) -> Result<Vec<Lever>> {
        let mut levers = Vec::new();
        for (class, column) in self.columns().into_iter().filter(|(of, _)| of == class) {
            let all = self.cells_of(&class, &column);
            let mut weighs = false;
            for lever in &all {
                let nudge = lever.value.abs().max(1.0) / f64::from(1 << 20);
                let nudged = self.at(lever, lever.value + nudge)?;
                weighs |= matches!(&nudged, Probe::Weighs(weights) if self.present.differ_a_little(weights));
                self.restore(lever)?;
                if weighs {
                    break;
                }
            }
            if weighs {
                levers.extend(all);
            }
        }
        Ok(levers)
    }

    /// The columns with numbers of tables that people tune, as far as a rule reads them.
    pub(super) fn columns(&self) -> Vec<(String, String)> {
        let read: BTreeSet<(String, String)> = self
            .fork
            .inputs
            .rules
            .rules()
            .iter()
            .flat_map(|rule| rule.reads())
            .map(|name| (name.class.clone(), name.property.clone()))
            .collect();
        let is_number = |(class, column): &(String, String)| {
            let table = self.fork.told.classes.get(class);
            matches!(table.and_then(|table| table.column(column)), Some(Column::Number(_)))
        };
        read.into_iter().filter(is_number).collect()
    }

    /// The cells of a column that count as the table says: what a fact says instead is no cell.
    fn cells_of(&self, class: &str, column: &str) -> Vec<Lever> {
        let told = &self.fork.told;
        let keys = told.keys.get(class).map_or(&[][..], Vec::as_slice);
        let Some(Column::Number(values)) = told.classes.get(class).and_then(|table| table.column(column))
        else {
            return Vec::new();
        };
        let cell = |row: usize| {
            let value = values[row]?;
            let is_told =
                self.fork.attached.cells().contains_key(&(class.to_owned(), row, column.to_owned()));
            let key = keys.get(row).filter(|_| !is_told)?.clone();
            let mut others: Vec<f64> =
                values.iter().flatten().copied().filter(|other| other.total_cmp(&value).is_ne()).collect();
            others.sort_by(f64::total_cmp);
            others.dedup();
            Some(Lever { class: class.to_owned(), row, key, column: column.to_owned(), value, others })
        };
        (0..values.len().min(ROWS)).filter_map(cell).collect()
    }
}
