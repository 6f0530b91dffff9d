//! `adit fit`.

use std::fs;
use std::path::PathBuf;

use clap::Args;

use super::args::{SiteArgs, author};
use super::build::open;
use super::output::{either, line, remark, table};
use crate::error::{Error, Result};
use crate::fit::{Fit, Scale, rows_of_csv};
use crate::words::number::number;

#[derive(Args, Debug)]
pub struct FitArgs {
    #[command(flatten)]
    pub site: SiteArgs,
    /// Add the traversals of a CSV file with the columns distance and measured, state or action, and perhaps mission,
    /// robot and measure: all of them or none
    #[arg(long, value_name = "FILE")]
    pub add: Option<PathBuf>,
    /// Remove all traversals first
    #[arg(long)]
    pub clear: bool,
    /// What was measured: seconds, joules, ...
    #[arg(long)]
    pub measure: Option<String>,
    /// The state that keeps its hardness; otherwise the one with the most metres
    #[arg(long, value_name = "STATE", conflicts_with = "per_metre")]
    pub reference: Option<String>,
    /// Take the measure a metre as hardness, and keep none
    #[arg(long)]
    pub per_metre: bool,
    /// Which robot, where the site has several
    #[arg(long)]
    pub robot: Option<String>,
}

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
        let added = knowledge.add_traversals(&rows_of_csv(&text)?, args.measure.as_deref(), &author(""))?;
        if !args.site.json {
            line(&format!("{} traversals are added, {} in all", added.added, added.total));
        }
        if added.again == added.added && added.again > 1 {
            remark(
                "note: each of them was there already, and counts twice now; `--clear --add FILE` has those of a file alone",
            );
        }
    }
    let scale = match &args.reference {
        Some(state) => Scale::Reference(state),
        None if args.per_metre => Scale::Measure,
        None => Scale::MostDriven,
    };
    let fit = knowledge.fit(args.robot.as_deref(), args.measure.as_deref(), scale)?;
    either(args.site.json, &fit, print)
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
    if fit.cells.is_empty() {
        fit.notes.iter().for_each(|note| line(note));
        return;
    }
    table(&["cell", "is", "fits best", "95 %", "observations"], rows);
    match &fit.reference {
        Some(state) => line(&format!("{state} keeps its hardness, and the others are in proportion to it")),
        None => line("hardness is what was measured, per metre"),
    }
    for note in &fit.notes {
        line(note);
    }
}
