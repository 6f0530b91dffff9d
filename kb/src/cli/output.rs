//! How answers are printed: tables for people, JSON for programs; data on standard output, the rest on standard
//! error. A closed pipe ends the printing quietly.

use std::io::{ErrorKind, IsTerminal, Write, stderr, stdout};
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::Duration;

use comfy_table::{ContentArrangement, Table, presets};
use serde::Serialize;

use crate::error::problem::Problem;
use crate::error::{Code, Error, Finding, Result};

/// Whether some of the answer could not be written, to a full disk for one.
static LOST: AtomicBool = AtomicBool::new(false);

/// Whether some of the answer could not be written; a pipe that its reader closed does not count.
pub fn is_lost() -> bool {
    LOST.load(Ordering::Relaxed)
}

pub fn line(text: &str) {
    if let Err(error) = writeln!(stdout(), "{text}")
        && error.kind() != ErrorKind::BrokenPipe
        && !LOST.swap(true, Ordering::Relaxed)
    {
        remark(&format!("cannot write the answer: {error}"));
    }
}

pub fn remark(text: &str) {
    writeln!(stderr(), "{text}").ok();
}

pub fn json(value: &(impl Serialize + ?Sized)) -> Result<()> {
    let text = serde_json::to_string_pretty(value).map_err(Error::of(Code::OutputJson))?;
    line(&text);
    Ok(())
}

/// Prints an answer as JSON, or for people.
pub fn either<T: Serialize + ?Sized>(as_json: bool, answer: &T, show: impl FnOnce(&T)) -> Result<()> {
    if as_json {
        return json(answer);
    }
    show(answer);
    Ok(())
}

pub fn table(head: &[&str], rows: impl IntoIterator<Item = Vec<String>>) {
    let mut table = Table::new();
    table.load_style(presets::NOTHING).set_content_arrangement(ContentArrangement::Disabled);
    table.set_header(head);
    for row in rows {
        table.add_row(row);
    }
    for text in table.lines() {
        line(text.trim_end());
    }
}

/// Prints what went wrong, each problem with its place.
pub fn problems(problems: &[Finding]) {
    let handler = miette::GraphicalReportHandler::new_themed(theme()).with_width(100);
    for problem in problems {
        let mut text = String::new();
        if handler.render_report(&mut text, problem.diagnostic()).is_err() {
            text = problem.to_string();
        }
        remark(text.trim_end());
    }
}

/// Problems for programs: see [`Problem`].
pub fn as_json(problems: &[Finding]) -> serde_json::Value {
    serde_json::json!(Problem::all(problems))
}

fn theme() -> miette::GraphicalTheme {
    let coloured = stderr().is_terminal() && std::env::var_os("NO_COLOR").is_none();
    if coloured { miette::GraphicalTheme::unicode() } else { miette::GraphicalTheme::unicode_nocolor() }
}

pub use crate::words::number::number;

/// [`number`], or nothing.
pub fn maybe(value: Option<f64>) -> String {
    value.map_or(String::new(), number)
}

/// The program as it was called, for commands that are printed: where `cargo run` starts it there is none on the path.
pub fn program() -> String {
    let called = std::env::args_os().next().map(PathBuf::from).unwrap_or_default();
    if called.components().count() > 1 { quoted(&called) } else { "adit".to_owned() }
}

/// A path as a shell takes it.
pub fn quoted(path: &Path) -> String {
    let text = path.display().to_string();
    let is_plain = |c: char| c.is_alphanumeric() || "-_./:,=+@%".contains(c);
    if !text.is_empty() && text.chars().all(is_plain) {
        text
    } else {
        format!("'{}'", text.replace('\'', r"'\''"))
    }
}

/// A time as people read it.
pub fn time(took: Duration) -> String {
    let seconds = took.as_secs_f64();
    if seconds < 1.0 { format!("{:.1} ms", seconds * 1e3) } else { format!("{seconds:.2} s") }
}
