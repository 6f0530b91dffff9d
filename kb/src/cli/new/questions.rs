//! What `adit new` asks a person who said nothing: each question has an answer that Enter gives.

use std::io::{BufRead, IsTerminal, stdin};
use std::path::PathBuf;

use super::super::output::{line, problems};
use super::{NewArgs, robots};
use crate::error::{Error, Result};

impl NewArgs {
    /// What is missing, asked; taken as it is where nobody can answer, or all is said.
    pub(super) fn asked(&self) -> Result<Self> {
        let is_said = self.map.is_some() || self.no_map || !self.robot.is_empty() || self.json;
        let mut args = self.clone();
        if is_said || !stdin().is_terminal() {
            args.dir = args.dir.or_else(|| Some(PathBuf::from(".")));
            return Ok(args);
        }
        if args.dir.is_none() {
            args.dir = Some(answer("Folder of the site", "my-site", |text| Ok(PathBuf::from(text)))?);
        }
        args.map =
            answer("Map: a TOML map or a ROS map.yaml", "none: a small floor to begin with", |text| {
                let file = PathBuf::from(text);
                if text.starts_with("none") {
                    return Ok(None);
                }
                std::fs::metadata(&file).map_err(|error| Error::io("read", &file, &error))?;
                Ok(Some(file))
            })?;
        args.robot = answer(&format!("Robot ({})", robots::names().join(", ")), robots::FIRST, |text| {
            let named: Vec<String> =
                text.split([',', ' ']).filter(|part| !part.is_empty()).map(str::to_owned).collect();
            robots::text(&named).map(|_| named)
        })?;
        Ok(args)
    }
}

/// Asks until there is an answer that can be taken.
fn answer<T>(question: &str, usual: &str, taken: impl Fn(&str) -> Result<T>) -> Result<T> {
    loop {
        line(&format!("{question} [{usual}]: "));
        let mut text = String::new();
        let read = stdin()
            .lock()
            .read_line(&mut text)
            .map_err(|error| Error::io("read", "standard input".as_ref(), &error))?;
        let said = text.trim();
        match taken(if said.is_empty() { usual } else { said }) {
            Ok(taken) => return Ok(taken),
            // nobody answers any more
            Err(error) if read == 0 => return Err(error),
            Err(error) => problems(error.problems()),
        }
    }
}
