//! `adit check` and `adit doctor`.

use std::path::PathBuf;

use adit_db::Store;
use clap::Args;

use super::args::SiteArgs;
use super::build::{open, unbuilt};
use super::output::{as_json, json, line, problems};
use crate::error::{Code, Finding, Result};
use crate::knowledge::KnowledgeBase;
use crate::plan::rules::{Kind, load_over};
use crate::site::Rooms;
use crate::site::base::Base;
use crate::site::driving::NAVIGATION;
use crate::words::number::counted;

#[derive(Args, Debug)]
pub struct DoctorArgs {
    #[command(flatten)]
    pub site: SiteArgs,
    /// Write a copy of the database to this file
    #[arg(long, value_name = "FILE")]
    pub backup: Option<PathBuf>,
}

/// Lints rules, tables and map; `false` where something is wrong.
pub fn check(args: &SiteArgs) -> Result<bool> {
    let mut what = "rules, tables and map";
    let checked = unbuilt(args).and_then(|knowledge| {
        if !knowledge.site().has_rooms() {
            what = "rules and tables";
        }
        let mut found = knowledge.check()?;
        found.extend(of_missions(&knowledge)?);
        Ok(found)
    });
    let (found, sound) = match checked {
        Ok(found) => {
            let sound =
                found.iter().all(|problem| problem.diagnostic().severity() == Some(miette::Severity::Advice));
            (found, sound)
        }
        Err(error) => (error.into_problems(), false),
    };
    if args.json {
        json(&as_json(&found))?;
    } else {
        problems(&found);
        if sound {
            line(&format!("{what} are in order"));
        } else if args.site.join("site.toml").exists() {
            line(if found.iter().any(Finding::is_error) {
                "something is wrong; the site is as it was"
            } else {
                "it can be built, but something looks wrong; the site is as it was"
            });
        }
    }
    Ok(sound)
}

/// What is to be said of the rules in the folder `navigation`, by which robots of a site that is cut by state drive.
fn of_missions(knowledge: &KnowledgeBase) -> Result<Vec<Finding>> {
    let site = knowledge.site();
    if site.rooms == Rooms::ByState {
        let (_, _, remarks) = load_over(Kind::Navigation, &site.folder)?;
        return Ok(remarks);
    }
    let folder = site.folder.join(NAVIGATION);
    let is_rule_base = knowledge.rule_bases().contains(&Base::Folder(folder.clone()));
    if !folder.is_dir() || is_rule_base {
        return Ok(Vec::new());
    }
    let message = format!("{} is not read: no robot drives missions by it here", folder.display());
    let help = "it lies over the rules of missions where rooms are cut by state; `rules` in site.toml names folders of rules";
    Ok(vec![Finding::warning(Code::RuleNotRead, message, Some(help.to_owned()))])
}

/// Examines the database; `false` where it is damaged.
pub fn doctor(args: &DoctorArgs) -> Result<bool> {
    let knowledge = open(&args.site)?;
    let mut store = Store::open_read_only(knowledge.database())?;
    let health = store.doctor()?;
    if let Some(file) = &args.backup {
        store.backup(file)?;
    }
    let lost = knowledge.lost()?;
    if args.site.json {
        let mut value = serde_json::json!(health);
        value["lost"] = lost.into();
        json(&value)?;
        return Ok(health.is_sound());
    }
    line(&format!(
        "adit {}, SQLite {}, schema {}, journal {}",
        env!("CARGO_PKG_VERSION"),
        health.sqlite,
        health.schema,
        health.journal
    ));
    for (table, rows) in &health.rows {
        line(&format!("  {table}: {}", counted(usize::try_from(*rows).unwrap_or(usize::MAX), "row")));
    }
    for mark in &health.stale {
        line(&format!("  edited since the last build: {} {}", mark.table, mark.key));
    }
    for lost in &lost {
        line(&format!("  {lost}"));
    }
    for damage in health.damages.iter().chain(&health.dangling) {
        line(&format!("  damage: {damage}"));
    }
    line(if health.is_sound() {
        "the database is sound"
    } else {
        "the database is damaged: go back to a backup"
    });
    if let Some(file) = &args.backup {
        line(&format!("a copy is in {}", file.display()));
    }
    Ok(health.is_sound())
}
