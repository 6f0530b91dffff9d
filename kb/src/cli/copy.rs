//! `adit copy`: a site into PostgreSQL, or out of it.

use std::path::Path;

use adit_db::Store;
use adit_db::postgres::{self, Place};
use clap::Args;
use serde_json::json;

use super::output::{self, line};
use crate::error::{Code, Error, Result};
use crate::knowledge::KnowledgeBase;
use crate::site::shared;
use crate::site::whole::Whole;
use crate::words::progress::Silent;

#[derive(Args, Debug)]
pub struct CopyArgs {
    /// Folder of the site, or `postgres://USER@HOST/DATABASE?site=NAME`
    pub from: String,
    /// The same of where it is to be: a folder that is to be made, or a database that has no site of this name
    pub to: String,
    /// Take the place of a site of this name in PostgreSQL; services on it go on with the new one
    #[arg(long)]
    pub replace: bool,
    /// Print the result as JSON
    #[arg(long)]
    pub json: bool,
}

pub fn run(args: &CopyArgs) -> Result<()> {
    let (site, words) = match (Place::is_meant(&args.from), Place::is_meant(&args.to)) {
        (false, true) => copy_in(args)?,
        (true, false) => copy_out(args)?,
        (false, false) => {
            let help = "a folder is copied by `cp -r`, while nobody serves it".to_owned();
            let message =
                "one of the two is to be a URL of PostgreSQL: `postgres://USER@HOST/DATABASE?site=NAME`";
            return Err(Error::said(Code::PostgresUrl, message, Some(help)));
        }
        (true, true) => {
            let help = "copy it into a folder first, and from there".to_owned();
            return Err(Error::said(Code::PostgresUrl, "one of the two is to be a folder", Some(help)));
        }
    };
    if args.json {
        return output::json(&json!({"site": site}));
    }
    line(&words);
    Ok(())
}

/// From a folder into PostgreSQL.
fn copy_in(args: &CopyArgs) -> Result<(String, String)> {
    let place = Place::parse(&args.to)?;
    let site = KnowledgeBase::open(Path::new(&args.from))?;
    site.needs_folder()?;
    let name = place.site_or(&last_part(&args.from));
    let files = shared::files(&site.site().folder, &site.files())?;
    if !site.database().exists() {
        site.build(&Silent)?;
    }
    let mut store = Store::open(site.database())?;
    store.copy_in(&files, (&place, &name), args.replace)?;
    let words = format!("{} is the site `{name}` in {}", args.from, place.shown());
    Ok((name, words))
}

/// Out of PostgreSQL into a folder.
fn copy_out(args: &CopyArgs) -> Result<(String, String)> {
    let (place, folder) = (Place::parse(&args.from)?, Path::new(&args.to));
    if folder.read_dir().is_ok_and(|mut entries| entries.next().is_some()) {
        let message = format!("{} is there already, and is not empty", args.to);
        return Err(Error::said(Code::SiteExists, message, None));
    }
    let name = place.site_or(&last_part(&args.to));
    let mut made = Whole::default();
    made.folder(folder)?;
    let database = folder.join("site.db");
    made.database(&database);
    let files = postgres::copy_out(&place, &name, &database)?;
    shared::write_some(folder, &files)?;
    made.keep();
    let words = format!("the site `{name}` in {} is in {}", place.shown(), args.to);
    Ok((name, words))
}

/// What a folder is called.
fn last_part(folder: &str) -> String {
    let absolute = std::path::absolute(folder).unwrap_or_default();
    absolute.file_name().unwrap_or_default().to_string_lossy().into_owned()
}
