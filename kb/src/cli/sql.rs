//! `adit sql`: a read-only look into the database.

use std::io::{BufRead, IsTerminal, stdin};

use adit_db::Store;
use adit_db::cell::Cell;
use adit_db::query::{Answer, Limits};
use clap::Args;

use super::args::SiteArgs;
use super::build::open;
use super::output::{json, line, problems, remark};
use crate::error::Result;
use crate::words::cells::{object, text};

#[derive(Args, Debug)]
pub struct SqlArgs {
    #[command(flatten)]
    pub site: SiteArgs,
    /// One SQL statement; without it, statements are read from standard input
    pub query: Option<String>,
    /// At most so many rows of an answer; that there are more is said
    #[arg(long, value_name = "ROWS", default_value_t = 1_000)]
    pub limit: usize,
}

/// One query, or those of standard input, each ended by `;`.
pub fn run(args: &SqlArgs) -> Result<bool> {
    let knowledge = open(&args.site)?;
    let store = Store::open_read_only(knowledge.database())?;
    let limits = Limits { rows: args.limit, ..Limits::default() };
    if let Some(query) = &args.query {
        show(&store.query(query, &limits)?, args.site.json)?;
        return Ok(true);
    }
    if stdin().is_terminal() {
        remark(
            "SQL, ended by `;`. Tables: robots, rooms, doors, places; views: action_sequence, route, routes, conclusions",
        );
    }
    let mut statement = String::new();
    let mut all_well = true;
    for text in stdin().lock().lines().map_while(std::result::Result::ok) {
        statement.push_str(&text);
        statement.push('\n');
        if text.trim_end().ends_with(';') {
            all_well &= answer(&store, &std::mem::take(&mut statement), &limits, args.site.json);
        }
    }
    if !statement.trim().is_empty() {
        all_well &= answer(&store, &statement, &limits, args.site.json);
    }
    Ok(all_well)
}

/// Answers one statement of the shell; an error is printed and the shell goes on.
fn answer(store: &Store, statement: &str, limits: &Limits, as_json: bool) -> bool {
    let outcome = store.query(statement, limits).map_err(crate::error::Error::from);
    match outcome.and_then(|answer| show(&answer, as_json)) {
        Ok(()) => true,
        Err(error) => {
            problems(error.problems());
            false
        }
    }
}

/// Columns by `|`, as the sqlite3 shell prints them, with a head; or objects as JSON.
fn show(answer: &Answer, as_json: bool) -> Result<()> {
    if as_json {
        json(&answer.rows.iter().map(|row| object(&answer.columns, row)).collect::<Vec<_>>())?;
    } else {
        line(&answer.columns.join("|"));
        for row in &answer.rows {
            let cells: Vec<String> = row.iter().map(cell).collect();
            line(&cells.join("|"));
        }
    }
    if answer.truncated {
        remark(&format!("note: only the first {} rows are shown; --limit asks for more", answer.rows.len()));
    }
    Ok(())
}

/// As the sqlite3 shell prints it: a real number keeps its point.
fn cell(cell: &Cell) -> String {
    match cell {
        Cell::Real(value) if value.fract() == 0.0 && value.abs() < 1e15 => format!("{value:.1}"),
        other => text(other),
    }
}
