//! Figures of a planner that users may change, read from the table of the site that keeps them.

use adit_planners::figures::Figure;
use adit_planners::simulator;

use super::course::{Asked, ObjectsOf};
use crate::error::{Code, Error, Result};
use crate::site::driving::Driving;

/// Takes those that the table has; a row that was taken away leaves the default.
pub fn read<S>(table: ObjectsOf<'_>, figures: &[Figure<S>], settings: &mut S) -> Result<()> {
    for row in table.rows() {
        let name = table.text(row, "figure").unwrap_or_default();
        let Some(figure) = figures.iter().find(|figure| figure.name == name) else {
            let known: Vec<&str> = figures.iter().map(|figure| figure.name).collect();
            return Err(table.wrong(row, "figure", &format!("one of {}", known.join(", ")), Some(&name)));
        };
        let value = table.needed(row, "value")?;
        if let Some(must) = figure.range.refuses(value) {
            let expected = must.strip_prefix("must be ").unwrap_or("0 or more");
            return Err(table.wrong(row, "value", expected, Some(&value.to_string())));
        }
        (figure.set)(settings, value);
    }
    Ok(())
}

/// How a robot drives by the tables of the site; as it was where there are none.
pub fn driving(asked: &Asked<'_>, mut driving: Driving) -> Result<Driving> {
    read(asked.objects("NAVIGATION"), &driving.navigator(), &mut driving.navigation)?;
    read(asked.objects("SENSORS"), simulator::Settings::FIGURES, &mut driving.sensors)?;
    match driving.too_many_at_once() {
        Some(wrong) => Err(Error::said(Code::CourseTable, wrong, None)),
        None => Ok(driving),
    }
}
