//! One rule base among those that lie over each other: where it is, and which files are its own.

use std::fs;
use std::path::{Path, PathBuf};

use adit_engine::SourceFile;

use crate::error::{Error, Result};
use crate::site::shipped;

/// The folder of a rule base's tests, inside its own.
pub const TESTS: &str = "tests";

/// A rule base among those that lie over each other.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Base {
    /// One that the program carries, by its folder in `rules/`.
    Shipped(String),
    Folder(PathBuf),
}

impl Base {
    /// What a text means, beside a folder: a folder there, else a rule base that the program carries.
    pub fn named(name: &str, beside: &Path) -> Self {
        let folder = beside.join(name);
        let is_shipped = || !shipped_files(name, ".rhai").is_empty();
        if !folder.exists() && is_shipped() { Self::Shipped(name.to_owned()) } else { Self::Folder(folder) }
    }

    /// As people call it.
    pub fn name(&self) -> String {
        match self {
            Self::Shipped(name) => name.clone(),
            Self::Folder(folder) => folder.display().to_string(),
        }
    }

    pub fn folder(&self) -> Option<&Path> {
        match self {
            Self::Shipped(_) => None,
            Self::Folder(folder) => Some(folder),
        }
    }

    pub fn rules(&self) -> Result<Vec<SourceFile>> {
        match self {
            Self::Shipped(name) => Ok(shipped_files(name, ".rhai")),
            Self::Folder(folder) => folder_files(folder, "rhai"),
        }
    }

    pub fn tests(&self) -> Result<Vec<SourceFile>> {
        match self {
            Self::Shipped(name) => Ok(shipped_files(&format!("{name}/{TESTS}"), ".toml")),
            Self::Folder(folder) => {
                let tests = folder.join(TESTS);
                if tests.is_dir() { folder_files(&tests, "toml") } else { Ok(Vec::new()) }
            }
        }
    }
}

/// The files of a rule base in a folder of the user's, and of its tests.
pub fn files(folder: &Path) -> Vec<PathBuf> {
    let of = |folder: &Path, extension| listed(folder, extension).unwrap_or_default();
    [of(folder, "rhai"), of(&folder.join(TESTS), "toml")].concat()
}

/// Files in and below a folder of rules that look like rules or tests of rules, and are not read, with what would have
/// them read.
pub fn not_read(folder: &Path) -> Vec<(PathBuf, &'static str)> {
    let mut found = Vec::new();
    look(folder, Path::new(""), &mut found);
    found.sort();
    found
}

fn look(folder: &Path, below: &Path, found: &mut Vec<(PathBuf, &'static str)>) {
    let in_tests = below == Path::new(TESTS);
    for entry in fs::read_dir(folder.join(below)).into_iter().flatten().flatten() {
        let name = entry.file_name().to_string_lossy().into_owned();
        let (path, small) = (entry.path(), name.to_lowercase());
        let is_called = |ending: &str| path.extension().is_some_and(|found| found == ending);
        // what programs keep for themselves: an editor's copies, the files of a system
        if name.starts_with('.') || name.ends_with('~') {
            continue;
        }
        if entry.file_type().is_ok_and(|kind| kind.is_dir()) {
            look(folder, &below.join(&name), found);
        } else if small.contains(".rhai") && !(below == Path::new("") && is_called("rhai")) {
            found.push((path, "rule files are called NAME.rhai, and lie in the folder of the rules itself"));
        } else if small.contains(".toml") && !(in_tests && is_called("toml")) && has_tests(&path) {
            found.push((
                path,
                "tests of rules are called NAME.toml, and lie in the folder `tests` beside the rules",
            ));
        }
    }
}

fn has_tests(file: &Path) -> bool {
    fs::read_to_string(file).is_ok_and(|text| text.contains("[[test]]"))
}

fn shipped_files(folder: &str, extension: &str) -> Vec<SourceFile> {
    let files = shipped::files(shipped::RULES, folder).into_iter();
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

/// Editors of Windows begin a file with a byte order mark, which is no part of its text.
pub fn without_mark(text: String) -> String {
    text.strip_prefix('\u{feff}').map(str::to_owned).unwrap_or(text)
}

fn folder_files(folder: &Path, extension: &str) -> Result<Vec<SourceFile>> {
    let read = |path: PathBuf| match fs::read_to_string(&path) {
        Ok(text) => Ok(SourceFile::new(path.display().to_string(), without_mark(text))),
        Err(error) => Err(Error::io("read", &path, &error)),
    };
    listed(folder, extension)?.into_iter().map(read).collect()
}
