//! `adit tuning`.

use adit_db::Store;
use clap::Args;

use super::args::SiteArgs;
use super::build::open;
use super::output::{json, line, maybe, table};
use super::tune::apply;
use crate::edit::Edit;
use crate::error::{Code, Error, Result};
use crate::knowledge::KnowledgeBase;
use crate::preview::compare::BASE;
use crate::words::suggest::did_you_mean;

#[derive(Args, Debug)]
#[command(after_help = "adit tuning SITE                                  lists the tunings\n\
adit tuning SITE NAME                             shows one\n\
adit tuning SITE NAME set TABLE KEY COLUMN VALUE  a cell that counts while it is on\n\
adit tuning SITE NAME unset TABLE KEY COLUMN      takes the cell out\n\
adit tuning SITE NAME on | off | preview          switches it, or shows what that would change\n\
adit tuning SITE compare A B                      routes between places, side by side; `base` is none")]
pub struct TuningArgs {
    #[command(flatten)]
    pub site: SiteArgs,
    /// The tuning, and what to do with it
    #[arg(allow_negative_numbers = true)]
    pub words: Vec<String>,
    /// Why, for the history
    #[arg(long, value_name = "TEXT")]
    pub why: Option<String>,
}

const ACTIONS: [&str; 5] = ["set", "unset", "on", "off", "preview"];

/// Lists, changes, switches, previews or compares named tunings.
pub fn run(args: &TuningArgs) -> Result<()> {
    let knowledge = open(&args.site)?;
    let words: Vec<&str> = args.words.iter().map(String::as_str).collect();
    let owned = |text: &&str| (*text).to_owned();
    let (edit, rehearse) = match words.as_slice() {
        [] => return list(&knowledge, None, args.site.json),
        ["compare", one, other] => return compare(&knowledge, (one, other), args.site.json),
        ["compare", ..] => return Err(usage("compare takes two tunings, or one and `base`", None)),
        [BASE, ..] => return Err(usage("`base` stands for no tuning, and cannot be one", None)),
        [name] => return list(&knowledge, Some(name), args.site.json),
        [name, "set", table, key, column, value] => {
            (Edit::SetInTuning(owned(name), [table, key, column, value].map(owned)), false)
        }
        [name, "unset", table, key, column] => {
            (Edit::UnsetInTuning(owned(name), [table, key, column].map(owned)), false)
        }
        [name, "on"] => (Edit::Switch(owned(name), true), false),
        [name, "off"] => (Edit::Switch(owned(name), false), false),
        [name, "preview"] => (Edit::Switch(owned(name), !is_on(&knowledge, name)?), true),
        [_, action, ..] if ACTIONS.contains(action) => {
            return Err(usage(&format!("`{action}` takes other words"), None));
        }
        [_, action, ..] => {
            return Err(usage(
                &format!("`{action}` is nothing to do with a tuning"),
                did_you_mean(action, ACTIONS.into_iter()),
            ));
        }
    };
    apply(&knowledge, &edit, args.why.as_deref(), (rehearse, args.site.json))
}

fn usage(message: &str, help: Option<String>) -> Error {
    let help = help.unwrap_or_else(|| {
        "adit tuning SITE [NAME [set TABLE KEY COLUMN VALUE | unset TABLE KEY COLUMN | on | off | preview]]".to_owned()
    });
    Error::said(Code::TuningUsage, message, Some(help))
}

fn is_on(knowledge: &KnowledgeBase, name: &str) -> Result<bool> {
    let active = Store::open_read_only(knowledge.database())?.snapshot(|tx| tx.active_tunings())?;
    Ok(active.iter().any(|active| active == name))
}

/// Prints the cells of all tunings, or of one.
fn list(knowledge: &KnowledgeBase, name: Option<&str>, as_json: bool) -> Result<()> {
    let (active, cells) = Store::open_read_only(knowledge.database())?.snapshot(|tx| -> Result<_> {
        if let Some(name) = name {
            crate::edit::known_tuning(tx, name)?;
        }
        Ok((tx.active_tunings()?, tx.tuning_cells()?))
    })?;
    let cells: Vec<_> =
        cells.into_iter().filter(|cell| name.is_none_or(|name| cell.tuning == name)).collect();
    if as_json {
        return json(&serde_json::json!({"active": active, "cells": cells}));
    }
    if cells.is_empty() {
        line("there is no tuning; `adit tuning SITE NAME set TABLE KEY COLUMN VALUE` starts one");
        return Ok(());
    }
    let rows = cells.into_iter().map(|cell| {
        let state = if active.contains(&cell.tuning) { "on" } else { "off" };
        let place = format!("{}.{}.{}", cell.table, cell.key, cell.column);
        vec![cell.tuning, state.to_owned(), place, cell.value.to_string()]
    });
    table(&["tuning", "", "cell", "value"], rows);
    Ok(())
}

fn compare(knowledge: &KnowledgeBase, (one, other): (&str, &str), as_json: bool) -> Result<()> {
    let routes = knowledge.compare(one, other)?;
    if as_json {
        return json(&serde_json::json!({"one": one, "other": other, "routes": routes}));
    }
    let several = routes.iter().any(|route| route.robot != routes[0].robot);
    let rows = routes.iter().map(|route| {
        let cost = |cost: Option<f64>| cost.map_or("no route".to_owned(), |cost| maybe(Some(cost)));
        let more = match (route.one, route.other) {
            (Some(one), Some(other)) if one != 0.0 => format!("{:+.1} %", (other / one - 1.0) * 100.0),
            _ => String::new(),
        };
        let whose = if several { format!("{}: ", route.robot) } else { String::new() };
        vec![format!("{whose}{} to {}", route.start, route.goal), cost(route.one), cost(route.other), more]
    });
    table(&["route", one, other, ""], rows);
    Ok(())
}
