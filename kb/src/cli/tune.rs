//! `adit tune`, `adit history` and `adit undo`.

use adit_db::Store;
use clap::Args;

use super::args::{SiteArgs, author};
use super::build::{changes, notes, open};
use super::output::{json, line, table};
use crate::edit::{Edit, changed, subject};
use crate::error::{Code, Error, Result};
use crate::knowledge::KnowledgeBase;
use crate::words::progress::Spinner;

#[derive(Args, Debug)]
pub struct TuneArgs {
    #[command(flatten)]
    pub site: SiteArgs,
    /// The table: robots, changes, or one of the site's own
    pub table: String,
    /// Key of the row; parts joined by `/` (`SQUAT`, `robot/SQUAT`, `robot/STAND/SQUAT`)
    pub key: String,
    /// The column, then its new value; with --add, `column=value` for each column
    #[arg(allow_negative_numbers = true)]
    pub cells: Vec<String>,
    /// Show what would change and change nothing
    #[arg(long)]
    pub dry_run: bool,
    /// Add a row
    #[arg(long, conflicts_with = "remove")]
    pub add: bool,
    /// Remove the row
    #[arg(long)]
    pub remove: bool,
    /// Why, for the history
    #[arg(long, value_name = "TEXT")]
    pub why: Option<String>,
}

#[derive(Args, Debug)]
pub struct HistoryArgs {
    #[command(flatten)]
    pub site: SiteArgs,
    /// How many edits, the latest first
    #[arg(long, default_value_t = 50)]
    pub limit: u32,
}

#[derive(Args, Debug)]
pub struct UndoArgs {
    #[command(flatten)]
    pub site: SiteArgs,
    /// Number of the edit in the history; the latest one without it
    pub edit: Option<i64>,
}

pub fn tune(args: &TuneArgs) -> Result<()> {
    let edit = edit_of(args)?;
    apply(&open(&args.site)?, &edit, args.why.as_deref(), (args.dry_run, args.site.json))
}

pub fn undo(args: &UndoArgs) -> Result<()> {
    let why = args.edit.map_or("undo".to_owned(), |edit| format!("undo {edit}"));
    apply(&open(&args.site)?, &Edit::Undo(args.edit), Some(&why), (false, args.site.json))
}

fn edit_of(args: &TuneArgs) -> Result<Edit> {
    let (table, key) = (args.table.clone(), args.key.clone());
    if args.remove {
        return Ok(Edit::Remove(table, key));
    }
    if args.add {
        let pair = |cell: &String| {
            cell.split_once('=')
                .map(|(column, value)| (column.to_owned(), value.to_owned()))
                .ok_or_else(|| Error::said(Code::EditUsage, format!("`{cell}` is not column=value"), None))
        };
        return Ok(Edit::Add(table, key, args.cells.iter().map(pair).collect::<Result<_>>()?));
    }
    match args.cells.as_slice() {
        [column, value] => Ok(Edit::Set(table, key, column.clone(), value.clone())),
        _ => Err(Error::said(
            Code::EditUsage,
            "a cell is TABLE KEY COLUMN VALUE",
            Some("adit tune my-site robots SQUAT hardness 3".to_owned()),
        )),
    }
}

/// Carries out an edit, or only shows what it would change, and prints that.
pub fn apply(
    knowledge: &KnowledgeBase,
    edit: &Edit,
    why: Option<&str>,
    (rehearse, as_json): (bool, bool),
) -> Result<()> {
    let author = author(why.unwrap_or_default());
    let (done, report) = {
        let spinner = Spinner::new();
        knowledge.edit(edit, &author, rehearse, &spinner)?
    };
    if as_json {
        let mut value = report.json();
        value["edit"] = serde_json::json!(done);
        value["dry_run"] = rehearse.into();
        notes(&report);
        return json(&value);
    }
    let doing = if rehearse { "would be: " } else { "" };
    let said = with_its_place(edit.words(&done), &report.closings);
    line(&format!("{doing}{said}"));
    changes(&said, &report);
    Ok(())
}

/// What an edit did; of what it closes or opens with where that is, as the report says it.
fn with_its_place(words: String, closings: &[String]) -> String {
    let of = |closing: &String| {
        let (name, _) = closing.split_once(" at (")?;
        let rest = words.strip_prefix(name)?.strip_prefix(" is ")?;
        let (place, state) = closing.rsplit_once(" is ")?;
        let is_it = rest.strip_prefix(state).is_some_and(|more| more.is_empty() || more.starts_with(' '));
        is_it.then(|| format!("{place} is {rest}"))
    };
    closings.iter().find_map(of).unwrap_or(words)
}

pub fn history(args: &HistoryArgs) -> Result<()> {
    let knowledge = open(&args.site)?;
    let edits = Store::open_read_only(knowledge.database())?.snapshot(|tx| tx.history(args.limit))?;
    if args.site.json {
        return json(&edits);
    }
    let rows = edits.iter().map(|edit| {
        let undone = edit.undone.map_or(String::new(), |by| format!("undone by {by}"));
        vec![
            edit.id.to_string(),
            edit.at.clone(),
            edit.who.clone(),
            subject(edit),
            changed(edit),
            edit.why.clone(),
            undone,
        ]
    });
    table(&["edit", "at", "who", "what", "change", "why", ""], rows);
    Ok(())
}
