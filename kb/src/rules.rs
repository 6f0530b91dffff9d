//! Where a site's rule base and its tests come from: a folder that the user names, the site's own, or the shipped one.

use std::fs;
use std::path::{Path, PathBuf};

use adit_engine::{RuleBase, RuleTests, SourceFile};

use crate::error::{Error, Result};
use crate::shipped;
use crate::site::Site;

/// The folder of a rule base's tests, inside its own.
pub const TESTS: &str = "tests";

/// A rule base with the tests that lie beside it.
pub struct Rules {
    /// The rules, compiled.
    pub base: RuleBase,
    /// The tests, read.
    pub tests: RuleTests,
}

/// Reads and compiles the rule base that is in force, and reads its tests.
pub fn load(site: &Site, instead: Option<&Path>) -> Result<Rules> {
    let (rules, tests) = if let Some(folder) = folder(site, instead) {
        let tests = folder.join(TESTS);
        let tests = if tests.is_dir() { folder_files(&tests, "toml")? } else { Vec::new() };
        (folder_files(folder, "rhai")?, tests)
    } else {
        let base = site.rooms.rule_base();
        (shipped_files(base, ".rhai"), shipped_files(&format!("{base}/{TESTS}"), ".toml"))
    };
    match (RuleBase::compile(&rules), RuleTests::read(&tests)) {
        (Ok(base), Ok(tests)) => Ok(Rules { base, tests }),
        (base, tests) => {
            let problems = base.err().into_iter().chain(tests.err()).flat_map(|problems| problems.0);
            Err(Error::all(problems))
        }
    }
}

/// The folder of the user's that the rule base is read from; `None` where it is the shipped one.
pub fn folder<'a>(site: &'a Site, instead: Option<&'a Path>) -> Option<&'a Path> {
    instead.or(site.rules.as_deref())
}

/// The files of a rule base in a folder of the user's, and of its tests.
pub fn files(folder: &Path) -> Vec<PathBuf> {
    let of = |folder: &Path, extension| listed(folder, extension).unwrap_or_default();
    [of(folder, "rhai"), of(&folder.join(TESTS), "toml")].concat()
}

fn shipped_files(folder: &str, extension: &str) -> Vec<SourceFile> {
    let files = shipped::files::<shipped::Rules>(folder).into_iter();
    let named = |(name, text)| SourceFile::new(format!("rules/{folder}/{name}"), text);
    files.filter(|(name, _)| name.ends_with(extension)).map(named).collect()
}

fn listed(folder: &Path, extension: &str) -> Result<Vec<PathBuf>> {
    let entries = fs::read_dir(folder).map_err(|error| Error::io("read the rule base", folder, &error))?;
    let mut paths: Vec<PathBuf> = Vec::new();
    for entry in entries {
        let path = entry.map_err(|error| Error::io("read the rule base", folder, &error))?.path();
        if path.extension().is_some_and(|found| found == extension) {
            paths.push(path);
        }
    }
    paths.sort();
    Ok(paths)
}

fn folder_files(folder: &Path, extension: &str) -> Result<Vec<SourceFile>> {
    let read = |path: PathBuf| match fs::read_to_string(&path) {
        Ok(text) => {
            // editors of Windows begin a file with a byte order mark, which is no part of its text
            let text = text.strip_prefix('\u{feff}').unwrap_or(&text);
            Ok(SourceFile::new(path.display().to_string(), text))
        }
        Err(error) => Err(Error::io("read", &path, &error)),
    };
    listed(folder, extension)?.into_iter().map(read).collect()
}
