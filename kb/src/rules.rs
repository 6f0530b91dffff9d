//! Where a site's rule base comes from: a folder that the user names, the site's own, or the shipped one.

use std::fs;
use std::path::{Path, PathBuf};

use adit_engine::{RuleBase, SourceFile};

use crate::error::{Error, Result};
use crate::shipped;
use crate::site::Site;

/// Reads and compiles the rule base that is in force.
pub fn load(site: &Site, instead: Option<&Path>) -> Result<RuleBase> {
    let files = match instead.or(site.rules.as_deref()) {
        Some(folder) => folder_files(folder)?,
        None => shipped_files(site.rooms.rule_base()),
    };
    RuleBase::compile(&files).map_err(|problems| Error::all(problems.0))
}

fn shipped_files(base: &str) -> Vec<SourceFile> {
    let named = |(name, text)| SourceFile::new(format!("rules/{base}/{name}"), text);
    shipped::files::<shipped::Rules>(base).into_iter().map(named).collect()
}

fn folder_files(folder: &Path) -> Result<Vec<SourceFile>> {
    let entries = fs::read_dir(folder).map_err(|error| Error::io("read the rule base", folder, &error))?;
    let mut paths: Vec<PathBuf> = Vec::new();
    for entry in entries {
        let path = entry.map_err(|error| Error::io("read the rule base", folder, &error))?.path();
        if path.extension().is_some_and(|extension| extension == "rhai") {
            paths.push(path);
        }
    }
    paths.sort();
    let read = |path: PathBuf| match fs::read_to_string(&path) {
        Ok(text) => {
            // editors of Windows begin a file with a byte order mark, which is no part of its text
            let text = text.strip_prefix('\u{feff}').unwrap_or(&text);
            Ok(SourceFile::new(path.display().to_string(), text))
        }
        Err(error) => Err(Error::io("read", &path, &error)),
    };
    paths.into_iter().map(read).collect()
}
