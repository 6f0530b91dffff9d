//! `robots.toml`: the states of each robot, what it costs to change from one to another, and what the robots can carry. It seeds the tables once;
//! from then on the database is what counts.

mod loads;
mod names;

use std::fs;
use std::path::Path;

use adit_db::Tx;
use adit_db::load::Load;
use adit_db::robot::{Change, State};
use adit_planners::read::{Code, Document, Fields, Problem};

pub use names::ONLY_ROBOT;
use names::{Named, name, robot};

use crate::error::{self, Error, Result};
use crate::site::not_negative;
use crate::words::suggest::did_you_mean;

#[derive(Clone, Debug, Default, PartialEq)]
pub struct RobotFile {
    /// States, in the order that breaks ties.
    pub robots: Vec<State>,
    pub changes: Vec<Change>,
    pub loads: Vec<Load>,
}

impl RobotFile {
    pub fn read(path: &Path) -> Result<Self> {
        let text = fs::read_to_string(path).map_err(|error| Error::io("read", path, &error))?;
        Self::parse(&path.display().to_string(), &text)
    }

    /// Reads a text; `name` is how messages call it.
    pub fn parse(name: &str, text: &str) -> Result<Self> {
        let document = Document::parse(name, text).map_err(|error| Error::all(error.problems))?;
        let fields = document.fields("robots.toml");
        let mut problems = Vec::new();
        fields.refuse_unknown(&["robots", "changes", "loads"], &mut problems);
        let (robots, named) = robots(&fields, &mut problems);
        let changes = changes(&fields, &named, &mut problems);
        let loads = loads::loads(&fields, &named, &mut problems);
        let file = Self { robots, changes, loads };
        if !problems.is_empty() {
            return Err(Error::all(problems));
        }
        if file.robots.is_empty() {
            return Err(Error::said(
                error::Code::RobotsEmpty,
                format!("{name} has no state of a robot"),
                Some(EXAMPLE.to_owned()),
            ));
        }
        Ok(file)
    }

    /// Fills the robot tables the first time, or when asked; otherwise says where file and tables differ.
    ///
    /// # Arguments
    /// `path` is the file, for the notes.
    pub fn seed_tables(&self, tx: &mut Tx<'_>, path: &Path, again: bool) -> Result<Vec<String>> {
        let (states, changes, loads) = (tx.states()?, tx.changes()?, tx.loads()?);
        let is_first = states.is_empty();
        let what = if is_first { None } else { self.differences(&states, &changes, &loads) };
        if is_first || again {
            tx.seed(&self.robots, &self.changes)?;
            tx.replace_loads(&self.loads)?;
        }
        let file = path.display();
        if is_first && tx.site_value("generation")?.is_some() {
            return Ok(vec![format!(
                "the table robots was empty: robots, changes and loads are as {file} has them again"
            )]);
        }
        let note = |what| {
            if again {
                format!("the tables are as {file} has them again; they differed in {what}")
            } else {
                format!(
                    "{file} differs from the database in {what}; the database counts (--reseed takes the file)"
                )
            }
        };
        Ok(what.map(note).into_iter().collect())
    }

    /// The states that the file and the table have otherwise.
    fn differences(&self, states: &[State], changes: &[Change], loads: &[Load]) -> Option<String> {
        let same = |a: &State, b: &State| a.robot == b.robot && a.state == b.state;
        let differs = |row: &State| match states.iter().find(|known| same(known, row)) {
            Some(known) => State { position: row.position, ..known.clone() } != *row,
            None => true,
        };
        let changed = self.robots.iter().filter(|row| differs(row));
        let gone = states.iter().filter(|row| !self.robots.iter().any(|other| same(other, row)));
        let named: Vec<&str> = changed.chain(gone).map(|row| row.state.as_str()).collect();
        let mut by_key = self.changes.clone();
        by_key.sort_by(|a, b| {
            (&a.robot, &a.from_state, &a.to_state).cmp(&(&b.robot, &b.from_state, &b.to_state))
        });
        let mut loads_by_key = self.loads.clone();
        loads_by_key.sort_by(|a, b| (&a.robot, &a.load).cmp(&(&b.robot, &b.load)));
        match (named.is_empty(), by_key == changes, loads_by_key == loads) {
            (true, true, true) => None,
            (true, true, false) => Some("loads".to_owned()),
            (true, false, _) => Some("changes of shape".to_owned()),
            (false, _, _) => Some(named.join(", ")),
        }
    }
}

const EXAMPLE: &str = "it needs at least one entry:\n[[robots]]\nstate = \"DRIVE\"\naction = \"DRIVE\"\n\
                       height = 1.2\nwidth = 0.6\nhardness = 1.0";

fn robots(fields: &Fields<'_, '_>, problems: &mut Vec<Problem>) -> (Vec<State>, Named) {
    let (mut rows, mut named): (Vec<State>, Named) = Default::default();
    for entry in fields.tables("robots", "[[robots]]", problems) {
        let known = ["robot", "state", "action", "height", "width", "length", "hardness", "speed", "power"];
        entry.refuse_unknown(&known, problems);
        let robot = robot(&entry, problems);
        let (state, action) = (name(&entry, "state", problems), name(&entry, "action", problems));
        named.add(&robot, state.as_ref().map(|state| state.value.as_str()));
        let sizes = ["height", "width", "hardness"].map(|key| not_negative(&entry, key, problems));
        let length = entry.get("length").is_some().then(|| entry.positive("length", problems));
        let speed = entry.get("speed").is_some().then(|| entry.positive("speed", problems));
        let power = perhaps(&entry, "power", problems);
        let (Some(state), Some(action), [Some(height), Some(width), Some(hardness)]) = (state, action, sizes)
        else {
            continue;
        };
        if rows.iter().any(|row| row.robot == robot && row.state == state.value) {
            let message = format!("state `{}` of robot `{robot}` stands here twice", state.value);
            problems.push(entry.text.problem(Code::DuplicatePlace, &state.span, message));
            continue;
        }
        let begun = rows.iter().any(|row| row.robot == robot);
        if begun && rows.last().is_some_and(|last| last.robot != robot) {
            let message =
                format!("robot `{robot}` stands here twice: its states stand above another robot's");
            let help = "give the second robot a name of its own, or move its states to the others";
            problems.push(
                entry.text.problem(Code::DuplicatePlace, &entry.span, message).with_help(help.to_owned()),
            );
        }
        let position = rows.iter().filter(|row| row.robot == robot).count() as i64 + 1;
        let (state, action) = (state.value, action.value);
        let [length, speed] = [length, speed].map(|number| number.flatten().map(|number| number.value));
        rows.push(State { robot, state, action, height, width, length, hardness, position, speed, power });
    }
    (rows, named)
}

fn changes(fields: &Fields<'_, '_>, named: &Named, problems: &mut Vec<Problem>) -> Vec<Change> {
    let mut rows: Vec<Change> = Vec::new();
    for entry in fields.tables("changes", "[[changes]]", problems) {
        entry.refuse_unknown(&["robot", "from_state", "to_state", "hardness", "seconds", "joules"], problems);
        let robot = robot(&entry, problems);
        let from = name(&entry, "from_state", problems);
        let to = name(&entry, "to_state", problems);
        for state in [&from, &to].into_iter().flatten().filter(|state| !named.has_state(&robot, &state.value))
        {
            let message = format!("`{}` is not a state of robot `{robot}`", state.value);
            let problem = entry.text.problem(Code::WrongType, &state.span, message);
            let meant = did_you_mean(&state.value, named.of(&robot).flatten());
            problems.push(match meant {
                Some(help) => problem.with_help(help),
                None => problem,
            });
        }
        if let (Some(from), Some(to), Some(hardness)) = (from, to, not_negative(&entry, "hardness", problems))
        {
            let [seconds, joules] = ["seconds", "joules"].map(|key| perhaps(&entry, key, problems));
            let (from_state, to_state) = (from.value, to.value);
            let row = Change { robot, from_state, to_state, hardness, seconds, joules };
            if rows.iter().any(|known| key(known) == key(&row)) {
                let message = format!("the change {} stands here twice", key(&row));
                problems.push(entry.text.problem(Code::DuplicatePlace, &entry.span, message));
                continue;
            }
            rows.push(row);
        }
    }
    rows
}

/// A number that need not be there.
fn perhaps(entry: &Fields<'_, '_>, key: &str, problems: &mut Vec<Problem>) -> Option<f64> {
    entry.get(key).is_some().then(|| not_negative(entry, key, problems)).flatten()
}

/// The row's key as people write it; names with a `/` may make two of them equal.
fn key(change: &Change) -> String {
    format!("{}/{}/{}", change.robot, change.from_state, change.to_state)
}
