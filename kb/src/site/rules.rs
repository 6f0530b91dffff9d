//! Where a site's rule base and its tests come from: a folder that the user names, the site's own, or the shipped one.

use std::fs;
use std::path::{Path, PathBuf};

use adit_engine::{RuleBase, RuleTests, SourceFile};

use crate::error::{Code, Error, Result};
use crate::site::Site;
use crate::site::shipped;

/// The folder of a rule base's tests, inside its own.
pub const TESTS: &str = "tests";

/// A rule base with the tests that lie beside it.
pub struct Rules {
    pub base: RuleBase,
    pub tests: RuleTests,
}

/// Reads and compiles the rule base that is in force, and reads its tests.
pub fn load(site: &Site, instead: Option<&Path>) -> Result<Rules> {
    let Sources { rules, tests } = sources(site, instead)?;
    compile(&rules, &tests)
}

/// As [`load`], with another text in one file, or without the file.
pub fn load_with(site: &Site, instead: Option<&Path>, (file, text): (&str, Option<&str>)) -> Result<Rules> {
    let Sources { mut rules, mut tests } = sources(site, instead)?;
    let (files, name) = match file.strip_prefix("tests/") {
        Some(_) => (&mut tests, file),
        None => (&mut rules, file),
    };
    let is_it = |source: &SourceFile| Path::new(source.name()).ends_with(name);
    match (files.iter().position(is_it), text) {
        (Some(place), Some(text)) => files[place] = SourceFile::new(files[place].name(), text),
        (Some(place), None) => drop(files.remove(place)),
        (None, Some(text)) => {
            let folder = folder(site, instead).unwrap_or(Path::new(""));
            files.push(SourceFile::new(folder.join(name).display().to_string(), text));
            files.sort_by(|one, other| one.name().cmp(other.name()));
        }
        (None, None) => {}
    }
    compile(&rules, &tests)
}

/// A shipped rule base, by its folder in `rules/`.
pub fn shipped(folder: &str) -> Result<Rules> {
    compile(&shipped_files(folder, ".rhai"), &shipped_files(&format!("{folder}/{TESTS}"), ".toml"))
}

/// A rule base of the user's.
pub fn from_folder(folder: &Path) -> Result<Rules> {
    let Sources { rules, tests } = folder_sources(folder)?;
    compile(&rules, &tests)
}

fn folder_sources(folder: &Path) -> Result<Sources> {
    let tests = folder.join(TESTS);
    let tests = if tests.is_dir() { folder_files(&tests, "toml")? } else { Vec::new() };
    let rules = folder_files(folder, "rhai")?;
    if rules.is_empty() {
        let message = format!("there is no rule in {}: it has no file NAME.rhai", folder.display());
        let near = not_read(folder).into_iter().next();
        let help = match near {
            Some((file, why)) => format!("{} is not read: {why}", file.display()),
            None => "without the folder the shipped rules count; copy them into it to change them".to_owned(),
        };
        return Err(Error::said(Code::RulesNone, message, Some(help)));
    }
    Ok(Sources { rules, tests })
}

fn compile(rules: &[SourceFile], tests: &[SourceFile]) -> Result<Rules> {
    match (RuleBase::compile(rules), RuleTests::read(tests)) {
        (Ok(base), Ok(tests)) => Ok(Rules { base, tests }),
        (base, tests) => {
            let problems = base.err().into_iter().chain(tests.err()).flat_map(|problems| problems.0);
            Err(Error::all(problems))
        }
    }
}

/// The files of a rule base and of its tests.
pub struct Sources {
    pub rules: Vec<SourceFile>,
    pub tests: Vec<SourceFile>,
}

/// The files of the rule base that is in force, read.
pub fn sources(site: &Site, instead: Option<&Path>) -> Result<Sources> {
    if let Some(folder) = folder(site, instead) {
        return folder_sources(folder);
    }
    let base = site.rooms.rule_base();
    let tests = shipped_files(&format!("{base}/{TESTS}"), ".toml");
    Ok(Sources { rules: shipped_files(base, ".rhai"), tests })
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
