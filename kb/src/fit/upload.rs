//! Traversals as people bring them: rows of JSON or CSV, checked before any is kept.

use std::collections::BTreeMap;

use adit_db::robot::State;
use adit_db::traversal::Traversal;
use serde::{Deserialize, Serialize};

use crate::error::{Code, Error, Result};
use crate::words::suggest::did_you_mean;

/// A traversal to be added.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, utoipa::ToSchema)]
#[serde(deny_unknown_fields)]
pub struct Row {
    /// The mission that it is a part of; its rows share one `measured`.
    #[serde(default)]
    pub mission: Option<String>,
    /// Whose; may be left out where there is one robot.
    #[serde(default)]
    pub robot: Option<String>,
    /// The state that was driven in; or else the action.
    #[serde(default)]
    pub state: Option<String>,
    /// The action, where one state alone has it.
    #[serde(default)]
    pub action: Option<String>,
    /// Metres.
    pub distance: f64,
    /// What was measured, of the whole mission where there is one.
    pub measured: f64,
    /// What `measured` is; may be left out where it is said for all rows.
    #[serde(default)]
    pub measure: Option<String>,
}

const COLUMNS: [&str; 7] = ["mission", "robot", "state", "action", "distance", "measured", "measure"];

fn refused(row: usize, what: impl std::fmt::Display, help: Option<String>) -> Error {
    Error::said(Code::FitRow, format!("row {row}: {what}; nothing was added"), help)
}

/// The rows of a CSV text: a line with the names of the columns, then a line a row.
pub fn rows_of_csv(text: &str) -> Result<Vec<Row>> {
    let mut lines = lines(text).into_iter();
    let names = lines.next().unwrap_or_default();
    let names: Vec<String> = names.iter().map(|name| name.trim().to_lowercase()).collect();
    for name in &names {
        if !COLUMNS.contains(&name.as_str()) {
            let help = did_you_mean(name, COLUMNS.into_iter())
                .unwrap_or_else(|| format!("columns are {}", COLUMNS.join(", ")));
            return Err(Error::said(
                Code::FitColumn,
                format!("the first line names a column `{name}`"),
                Some(help),
            ));
        }
    }
    for name in ["distance", "measured"] {
        if !names.iter().any(|known| known == name) {
            let help = format!("columns are {}", COLUMNS.join(", "));
            return Err(Error::said(
                Code::FitColumn,
                format!("the first line names no column `{name}`"),
                Some(help),
            ));
        }
    }
    let mut rows = Vec::new();
    for (number, cells) in (1..).zip(lines) {
        if cells.len() != names.len() {
            return Err(refused(number, format!("{} values under {} names", cells.len(), names.len()), None));
        }
        let mut row = Row::default();
        for (name, value) in names.iter().zip(cells) {
            let value = value.trim().to_owned();
            let text = Some(value.clone()).filter(|value| !value.is_empty());
            let read = || {
                value
                    .parse::<f64>()
                    .map_err(|_| refused(number, format!("{name} is `{value}`, and must be a number"), None))
            };
            match name.as_str() {
                "mission" => row.mission = text,
                "robot" => row.robot = text,
                "state" => row.state = text,
                "action" => row.action = text,
                "measure" => row.measure = text,
                "distance" => row.distance = read()?,
                _ => row.measured = read()?,
            }
        }
        rows.push(row);
    }
    Ok(rows)
}

/// Lines of cells (RFC 4180), separated by commas, or by semicolons where the first line has them; empty lines are left
/// out.
fn lines(text: &str) -> Vec<Vec<String>> {
    let text = text.trim_start_matches('\u{feff}');
    let first = text.lines().next().unwrap_or_default();
    let separator = if first.contains(';') && !first.contains(',') { b';' } else { b',' };
    let mut reader = csv::ReaderBuilder::new();
    let reader = reader.delimiter(separator).has_headers(false).flexible(true).trim(csv::Trim::All);
    // a text is read whole and is in UTF-8, so that nothing can fail
    let lines = reader.from_reader(text.as_bytes()).into_records().map_while(std::result::Result::ok);
    let cells = |line: csv::StringRecord| line.iter().map(str::to_owned).collect::<Vec<_>>();
    lines.map(cells).filter(|line| line.iter().any(|cell| !cell.is_empty())).collect()
}

/// The rows as they are kept; an error names the first that cannot be.
pub(super) fn checked(
    rows: &[Row],
    measure: Option<&str>,
    states: &[State],
    before: &[Traversal],
    who: &str,
) -> Result<Vec<Traversal>> {
    if rows.is_empty() {
        let help = "a row is a stretch: its state or action, metres, and what was measured".to_owned();
        return Err(Error::said(Code::FitRow, "there is no row to add", Some(help)));
    }
    let mut totals: BTreeMap<(String, String, String), f64> = BTreeMap::new();
    for row in before {
        if let Some(mission) = &row.mission {
            totals.insert((row.robot.clone(), row.measure.clone(), mission.clone()), row.measured);
        }
    }
    let mut all = Vec::new();
    for (number, row) in (1..).zip(rows) {
        let state = state_of(number, row, states)?;
        let Some(measure) = row.measure.as_deref().or(measure).filter(|measure| !measure.trim().is_empty())
        else {
            let help = Some("seconds, joules, ...".to_owned());
            return Err(refused(number, "it does not say what was measured", help));
        };
        if !(row.distance.is_finite() && row.distance > 0.0 && row.distance <= 1e9) {
            return Err(refused(
                number,
                format!("distance is {}, and must be more than 0 and at most 1e9", row.distance),
                None,
            ));
        }
        if !(row.measured.is_finite() && (0.0..=1e12).contains(&row.measured)) {
            return Err(refused(
                number,
                format!("measured is {}, and must be from 0 to 1e12", row.measured),
                None,
            ));
        }
        let mission = row.mission.clone().filter(|mission| !mission.trim().is_empty());
        if let Some(mission) = &mission {
            let total = totals
                .entry((state.robot.clone(), measure.to_owned(), mission.clone()))
                .or_insert(row.measured);
            if total.to_bits() != row.measured.to_bits() {
                let what =
                    format!("mission `{mission}` measured {} here and {total} in another row", row.measured);
                return Err(refused(
                    number,
                    what,
                    Some("all rows of a mission share one measured total".to_owned()),
                ));
            }
        }
        all.push(Traversal {
            id: 0,
            mission,
            robot: state.robot.clone(),
            state: state.state.clone(),
            distance: row.distance,
            measured: row.measured,
            measure: measure.to_owned(),
            who: who.to_owned(),
            at: String::new(),
        });
    }
    Ok(all)
}

/// The state that a row names, by itself or by its action.
fn state_of<'s>(number: usize, row: &Row, states: &'s [State]) -> Result<&'s State> {
    let mut robots: Vec<&str> = states.iter().map(|state| &*state.robot).collect();
    robots.dedup();
    let robot = match (&row.robot, robots.as_slice()) {
        (Some(robot), _) if robots.contains(&robot.as_str()) => robot.as_str(),
        (Some(robot), _) => {
            let help = did_you_mean(robot, robots.iter().copied());
            return Err(refused(number, format!("there is no robot `{robot}`"), help));
        }
        (None, [one]) => one,
        (None, _) => {
            return Err(refused(number, format!("it does not say which robot: {}", robots.join(", ")), None));
        }
    };
    let own: Vec<&State> = states.iter().filter(|state| state.robot == robot).collect();
    match (&row.state, &row.action) {
        (Some(name), action) => {
            let found = own.iter().find(|state| state.state == *name).copied().ok_or_else(|| {
                let help = did_you_mean(name, own.iter().map(|state| &*state.state));
                refused(number, format!("{robot} has no state `{name}`"), help)
            })?;
            match action {
                Some(action) if *action != found.action => {
                    let what = format!("the action of {name} is `{}`, and not `{action}`", found.action);
                    Err(refused(number, what, Some("say the state alone, or the action alone".to_owned())))
                }
                _ => Ok(found),
            }
        }
        (None, Some(action)) => {
            let found: Vec<&&State> = own.iter().filter(|state| state.action == *action).collect();
            match found.as_slice() {
                [one] => Ok(**one),
                [] => {
                    let help = did_you_mean(action, own.iter().map(|state| &*state.action));
                    Err(refused(number, format!("no state of {robot} has the action `{action}`"), help))
                }
                several => {
                    let names: Vec<&str> = several.iter().map(|state| &*state.state).collect();
                    let what =
                        format!("the action `{action}` is that of {}: name the state", names.join(", "));
                    Err(refused(number, what, None))
                }
            }
        }
        (None, None) => Err(refused(number, "it names no state and no action", None)),
    }
}
