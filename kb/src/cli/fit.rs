//! `adit fit`.

use std::fs;

use adit_db::history::Author;

use super::FitArgs;
use super::build::open;
use super::output::{json, line, table};
use crate::error::{Error, Result};
use crate::fit::{Fit, Scale, rows_of_csv};
use crate::words::number::number;

/// Adds or clears traversals, and prints the hardness that fits them best.
pub fn run(args: &FitArgs) -> Result<()> {
    let knowledge = open(&args.site)?;
    if args.clear {
        let gone = knowledge.clear_traversals()?;
        if !args.site.json {
            line(&format!("{gone} traversals are gone"));
        }
    }
    if let Some(file) = &args.add {
        let text = fs::read_to_string(file).map_err(|error| Error::io("read", file, &error))?;
        let who = std::env::var("USER").or_else(|_| std::env::var("LOGNAME"));
        let author = Author { who: who.unwrap_or_else(|_| "cli".to_owned()), why: String::new() };
        let added = knowledge.add_traversals(&rows_of_csv(&text)?, args.measure.as_deref(), &author)?;
        if !args.site.json {
            line(&format!("{} traversals are added, {} in all", added.added, added.total));
        }
    }
    let scale = match &args.reference {
        Some(state) => Scale::Reference(state),
        None if args.per_metre => Scale::Measure,
        None => Scale::MostDriven,
    };
    let fit = knowledge.fit(args.robot.as_deref(), args.measure.as_deref(), scale)?;
    if args.site.json {
        return json(&fit);
    }
    print(&fit);
    Ok(())
}

fn print(fit: &Fit) {
    let maybe = |value: Option<f64>| value.map_or_else(|| "?".to_owned(), number);
    let rows = fit.cells.iter().map(|cell| {
        let interval = match (cell.low, cell.high) {
            (Some(low), Some(high)) => format!("{} .. {}", number(low), number(high)),
            _ => "?".to_owned(),
        };
        let name = format!("{}.{}.{}", cell.table, cell.key, cell.column);
        vec![name, number(cell.present), maybe(cell.proposed), interval, cell.observations.to_string()]
    });
    table(&["cell", "is", "fits best", "95 %", "observations"], rows);
    match &fit.reference {
        Some(state) => line(&format!("{state} keeps its hardness, and the others are in proportion to it")),
        None => line("hardness is the measure a metre"),
    }
    for note in &fit.notes {
        line(note);
    }
}
