//! `adit tune`, `adit history` and `adit undo`.

use adit_db::Store;
use adit_db::history::Author;

use super::build::{changes, notes, open};
use super::output::{json, line, table};
use super::{HistoryArgs, TuneArgs, UndoArgs};
use crate::edit::Edit;
use crate::error::{Code, Error, Result};
use crate::knowledge::KnowledgeBase;
use crate::words::progress::Spinner;

/// `adit tune`.
pub fn tune(args: &TuneArgs) -> Result<()> {
    let edit = edit_of(args)?;
    apply(&open(&args.site)?, &edit, args.why.as_deref(), (args.dry_run, args.site.json))
}

/// `adit undo`.
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
    let who =
        std::env::var("USER").or_else(|_| std::env::var("LOGNAME")).unwrap_or_else(|_| "cli".to_owned());
    let author = Author { who, why: why.unwrap_or_default().to_owned() };
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
    match edit {
        Edit::Tell(_) => line(&format!("{doing}fact {} is told", done.key)),
        Edit::Retract(_) => line(&format!("{doing}fact {} is taken back", done.key)),
        Edit::Switch(tuning, on) => {
            line(&format!("{doing}tuning {tuning} is {}", if *on { "on" } else { "off" }));
        }
        _ => line(&format!("{doing}{}: {} → {}", done.key, done.old, done.new)),
    }
    changes(&report);
    Ok(())
}

/// `adit history`.
pub fn history(args: &HistoryArgs) -> Result<()> {
    let knowledge = open(&args.site)?;
    let edits = Store::open_read_only(knowledge.database())?.snapshot(|tx| tx.history(args.limit))?;
    if args.site.json {
        return json(&edits);
    }
    let rows = edits.iter().map(|edit| {
        let column = edit.column.as_ref().map_or(String::new(), |column| format!(".{column}"));
        let undone = edit.undone.map_or(String::new(), |by| format!("undone by {by}"));
        vec![
            edit.id.to_string(),
            edit.at.clone(),
            edit.who.clone(),
            format!("{}.{}{column}", edit.table, edit.key),
            format!("{} → {}", edit.old, edit.new),
            edit.why.clone(),
            undone,
        ]
    });
    table(&["edit", "at", "who", "what", "change", "why", ""], rows);
    Ok(())
}
