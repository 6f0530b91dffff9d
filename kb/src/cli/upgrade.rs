//! `adit upgrade`: the sites in a database of PostgreSQL become those of this program's version.

use adit_db::postgres::{self, Place, Upgraded};
use clap::Args;
use serde_json::json;

use super::output::{self, line};
use crate::error::Result;
use crate::words::progress::{Progress, Spinner};

#[derive(Args, Debug)]
pub struct UpgradeArgs {
    /// The database: `postgres://USER@HOST/DATABASE`
    pub database: String,
    /// Print the result as JSON
    #[arg(long)]
    pub json: bool,
}

pub fn run(args: &UpgradeArgs) -> Result<()> {
    let place = Place::parse(&args.database)?;
    let spinner = Spinner::new();
    let done = postgres::upgrade(&place, |done, all, site| {
        spinner.stage(&format!("{site} ({} of {all})", done + 1));
    })?;
    drop(spinner);
    let Upgraded { version, before, sites } = done;
    if args.json {
        let (before, kept) = before.unzip();
        return output::json(&json!({"version": version, "before": before, "kept": kept, "sites": sites}));
    }
    let sites = match sites.as_slice() {
        [site] => format!("the site `{site}`"),
        sites => format!("{} sites", sites.len()),
    };
    let at = place.shown();
    let Some((before, kept)) = before else {
        line(&format!("{at} is of version {version}, as this program: nothing is to be done for {sites}"));
        return Ok(());
    };
    line(&format!("{at}: {sites} went from version {before} to {version}"));
    line(&format!(
        "what was there is kept as the schema {kept}; `DROP SCHEMA {kept} CASCADE` gives its room back"
    ));
    Ok(())
}
