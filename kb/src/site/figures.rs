//! Figures of a planner that users may change: read from a file, and the table of the site that keeps them.

use std::path::Path;

use adit_db::Cell;
use adit_planners::figures::Figure;
use adit_planners::read::{Code, Fields, Problem};

use super::tables::TableFile;

const COLUMNS: [(&str, &str); 4] =
    [("figure", "TEXT"), ("value", "REAL"), ("unit", "TEXT"), ("meaning", "TEXT")];

/// Reads those that a table of a file names.
pub fn figures<S>(
    table: &Fields<'_, '_>,
    figures: &[Figure<S>],
    settings: &mut S,
    problems: &mut Vec<Problem>,
) {
    table.refuse_unknown(&figures.iter().map(|figure| figure.name).collect::<Vec<_>>(), problems);
    for figure in figures.iter().filter(|figure| table.get(figure.name).is_some()) {
        let Some(number) = table.number(figure.name, problems) else { continue };
        match figure.range.refuses(number.value) {
            None => (figure.set)(settings, number.value),
            Some(must) => {
                let message = format!("`{}` is {} and {must}", figure.name, number.value);
                problems.push(table.text.problem(Code::NotPositive, &number.span, message));
            }
        }
    }
}

/// The table that keeps them.
pub fn table<S>(file: &Path, name: &str, figures: &[Figure<S>], settings: &S) -> TableFile {
    let row = |figure: &Figure<S>| {
        let [name, unit, meaning] = [figure.name, figure.unit, figure.meaning].map(Cell::from);
        vec![name, Cell::Real((figure.of)(settings)), unit, meaning]
    };
    TableFile::of_map(file, name, (&COLUMNS, 1), figures.iter().map(row).collect())
}
