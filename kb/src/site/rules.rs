//! Where a site's rules and their tests come from: rule bases that lie over each other, shipped ones and folders of the user's.

use std::path::{Path, PathBuf};

use adit_engine::{RuleBase, RuleTests, SourceFile};

use crate::error::{Code, Error, Result};
use crate::site::Site;
use crate::site::base::{Base, not_read};

/// Rules with the tests that lie beside them.
pub struct Rules {
    pub base: RuleBase,
    /// The tests of the uppermost base: rules that fail one of them are refused.
    pub tests: RuleTests,
    /// The tests of the bases beneath, with their names: what a base above changes on purpose they need not like.
    pub beneath: Vec<(String, RuleTests)>,
}

/// The files of one base.
pub struct Sources {
    pub base: Base,
    pub rules: Vec<SourceFile>,
    pub tests: Vec<SourceFile>,
}

/// The rule bases that count, the lowest first.
pub fn bases(site: &Site, instead: Option<&Path>) -> Vec<Base> {
    instead.map_or_else(|| site.rules.clone(), |folder| vec![Base::Folder(folder.to_owned())])
}

/// The folder in which the user's own rules are written: the uppermost one, or the one that would be.
pub fn own(site: &Site, instead: Option<&Path>) -> PathBuf {
    let bases = bases(site, instead);
    let folder = bases.last().and_then(Base::folder);
    folder.map_or_else(|| site.folder.join(Site::RULES), Path::to_owned)
}

/// Reads and compiles the rules that are in force, and reads their tests.
pub fn load(site: &Site, instead: Option<&Path>) -> Result<Rules> {
    compile(&sources(&bases(site, instead))?)
}

/// As [`load`], with another text in one file of the user's own rules, or without the file.
pub fn load_with(site: &Site, instead: Option<&Path>, (file, text): (&str, Option<&str>)) -> Result<Rules> {
    let (mut bases, folder) = (bases(site, instead), own(site, instead));
    let own = Base::Folder(folder.clone());
    if folder.exists() && bases.last() != Some(&own) {
        bases.push(own.clone());
    }
    let mut sources = sources(&bases)?;
    if bases.last() != Some(&own) {
        sources.push(Sources { base: own, rules: Vec::new(), tests: Vec::new() });
    }
    if let Some(top) = sources.last_mut() {
        let files = if file.starts_with("tests/") { &mut top.tests } else { &mut top.rules };
        let name = folder.join(file).display().to_string();
        let place = files.iter().position(|source| source.name() == name);
        match (place, text) {
            (Some(place), Some(text)) => files[place] = SourceFile::new(name, text),
            (Some(place), None) => drop(files.remove(place)),
            (None, Some(text)) => {
                files.push(SourceFile::new(name, text));
                files.sort_by(|one, other| one.name().cmp(other.name()));
            }
            (None, None) => {}
        }
    }
    compile(&sources)
}

/// Reads and compiles rule bases that lie over each other.
pub fn load_bases(bases: &[Base]) -> Result<Rules> {
    compile(&sources(bases)?)
}

fn compile(sources: &[Sources]) -> Result<Rules> {
    let bases: Vec<&[SourceFile]> = sources.iter().map(|base| base.rules.as_slice()).collect();
    let tests = |base: &Sources| RuleTests::read(&base.tests).map(|tests| (base.base.name(), tests));
    let tests: std::result::Result<Vec<_>, _> = sources.iter().map(tests).collect();
    match (RuleBase::compile_over(&bases), tests) {
        (Ok(base), Ok(mut beneath)) => {
            let tests = beneath.pop().map_or_else(RuleTests::default, |(_, tests)| tests);
            Ok(Rules { base, tests, beneath })
        }
        (base, tests) => {
            let problems = base.err().into_iter().chain(tests.err()).flat_map(|problems| problems.0);
            Err(Error::all(problems))
        }
    }
}

/// The files of rule bases, read; the lowest has a rule.
pub fn sources(bases: &[Base]) -> Result<Vec<Sources>> {
    let read = |(place, base): (usize, &Base)| {
        let (rules, tests) = (base.rules()?, base.tests()?);
        match base.folder().filter(|_| place == 0 && rules.is_empty()) {
            Some(folder) => Err(without_a_rule(folder)),
            None => Ok(Sources { base: base.clone(), rules, tests }),
        }
    };
    bases.iter().enumerate().map(read).collect()
}

fn without_a_rule(folder: &Path) -> Error {
    let message = format!("there is no rule in {}: it has no file NAME.rhai", folder.display());
    let near = not_read(folder).into_iter().next();
    let help = match near {
        Some((file, why)) => format!("{} is not read: {why}", file.display()),
        None => "without the folder the shipped rules count; one that lies over them may be empty".to_owned(),
    };
    Error::said(Code::RulesNone, message, Some(help))
}
