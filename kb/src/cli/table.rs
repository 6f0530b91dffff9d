//! `adit table`: a table as a file.

use std::path::PathBuf;

use adit_db::Store;
use clap::Args;

use super::args::SiteArgs;
use super::build::open;
use super::output::{json, line};
use super::tune::apply;
use crate::edit::Edit;
use crate::error::Result;
use crate::site::sheet::{self, Sheet};
use crate::site::whole;
use crate::words::number::counted;

#[derive(Args, Debug)]
pub struct TableArgs {
    #[command(flatten)]
    pub site: SiteArgs,
    /// The table; without --to or --from it is printed as CSV
    pub table: String,
    /// Write it to a file: .csv or .xlsx
    #[arg(long, value_name = "FILE", conflicts_with = "from")]
    pub to: Option<PathBuf>,
    /// Make its rows those of a file (.csv or .xlsx), as one edit; columns that the file has not stay as they are
    #[arg(long, value_name = "FILE")]
    pub from: Option<PathBuf>,
    /// Only show what would change
    #[arg(long, requires = "from")]
    pub dry_run: bool,
    /// Why, for the history
    #[arg(long, value_name = "TEXT", requires = "from")]
    pub why: Option<String>,
}

pub fn run(args: &TableArgs) -> Result<()> {
    args.to.iter().try_for_each(|file| sheet::check(file))?;
    let knowledge = open(&args.site)?;
    if let Some(file) = &args.from {
        let edit = Edit::Table(args.table.clone(), Sheet::read(file)?, None);
        return apply(&knowledge, &edit, args.why.as_deref(), (args.dry_run, args.site.json));
    }
    let mut store = Store::open_read_only(knowledge.database())?;
    let table = store.snapshot(|tx| tx.read_table(&args.table))?;
    let rows = table.columns.first().map_or(0, |column| column.values.len());
    let Some(file) = &args.to else {
        line(sheet::text(&table)?.trim_end());
        return Ok(());
    };
    // a table may be written into the file from which it comes
    let is_its_own = file.file_stem().is_some_and(|stem| stem.eq_ignore_ascii_case(&args.table));
    if !is_its_own {
        knowledge.spare_own(file)?;
    }
    whole::write(file, &sheet::written(file, &table)?)?;
    if args.site.json {
        return json(&serde_json::json!({"file": file, "rows": rows}));
    }
    line(&format!("{}: {} of {}", file.display(), counted(rows, "row"), args.table));
    Ok(())
}
