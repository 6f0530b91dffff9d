//! Where a site's rules and their tests come from: rule bases that lie over each other, shipped ones and folders of the user's.

use std::collections::BTreeMap;
use std::fmt::Write;
use std::path::{Path, PathBuf};

use adit_engine::{RuleBase, RuleTests, SourceFile};
use sha2::{Digest, Sha256};

use crate::error::{Code, Error, Result};
use crate::site::Site;
use crate::site::base::{Base, not_read, without_mark};

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

/// Texts that stand in place of those of files of the user's own rules and tests, by names as `doors.rhai` and
/// `tests/doors.toml`; without a text a file is gone.
pub type Drafts = BTreeMap<String, Option<String>>;

/// The longest rule file, bytes.
const LONGEST: usize = 1 << 20;

/// Names a text, so that whoever saves one can say which one was read.
pub fn version(text: &str) -> String {
    Sha256::digest(text.as_bytes())[..8].iter().fold(String::new(), |mut name, byte| {
        write!(name, "{byte:02x}").ok();
        name
    })
}

/// The text of a file as rules are read; `None` where there is no file.
pub fn text(path: &Path) -> Result<Option<String>> {
    match std::fs::read_to_string(path) {
        Ok(text) => Ok(Some(without_mark(text))),
        Err(error) if error.kind() == std::io::ErrorKind::NotFound => Ok(None),
        Err(error) => Err(Error::io("read", path, &error)),
    }
}

/// Only files of the rule base itself, by plain names, and none that is too long.
pub fn check(file: &str, text: Option<&str>) -> Result<()> {
    let name = file.strip_prefix("tests/").unwrap_or(file);
    let extension = if name.len() < file.len() { ".toml" } else { ".rhai" };
    let is_plain = |c: char| c.is_alphanumeric() || ['-', '_', '.', ' '].contains(&c);
    let stem = name.strip_suffix(extension).unwrap_or_default();
    if stem.is_empty() || stem.starts_with(['.', ' ']) || !stem.chars().all(is_plain) || name.len() >= 100 {
        let message = "a rule file is called NAME.rhai, and a test of rules tests/NAME.toml";
        return Err(Error::said(Code::RulesName, message, None));
    }
    if text.is_some_and(|text| text.len() > LONGEST) {
        let message = format!("a rule file may have {LONGEST} bytes");
        return Err(Error::said(Code::RulesTooLong, message, None));
    }
    Ok(())
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

/// Reads and compiles the rules that are in force, with drafts in place of the user's own files, and reads their tests.
pub fn load(site: &Site, instead: Option<&Path>, drafts: &Drafts) -> Result<Rules> {
    let mut bases = bases(site, instead);
    if drafts.is_empty() {
        return compile(&sources(&bases)?);
    }
    let folder = own(site, instead);
    let own = Base::Folder(folder.clone());
    let is_there = folder.exists();
    bases.retain(|base| *base != own || is_there);
    if is_there && bases.last() != Some(&own) {
        bases.push(own.clone());
    }
    let mut sources = read(&bases)?;
    if bases.last() != Some(&own) {
        sources.push(Sources { base: own, rules: Vec::new(), tests: Vec::new() });
    }
    if let Some(top) = sources.last_mut() {
        for (file, text) in drafts {
            let files = if file.starts_with("tests/") { &mut top.tests } else { &mut top.rules };
            let name = folder.join(file).display().to_string();
            files.retain(|source| source.name() != name);
            files.extend(text.as_ref().map(|text| SourceFile::new(name, text.as_str())));
            files.sort_by(|one, other| one.name().cmp(other.name()));
        }
    }
    has_a_rule(&sources)?;
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
    let sources = read(bases)?;
    has_a_rule(&sources)?;
    Ok(sources)
}

fn read(bases: &[Base]) -> Result<Vec<Sources>> {
    let of = |base: &Base| Ok(Sources { base: base.clone(), rules: base.rules()?, tests: base.tests()? });
    bases.iter().map(of).collect()
}

fn has_a_rule(sources: &[Sources]) -> Result<()> {
    let lowest = sources.first().filter(|lowest| lowest.rules.is_empty());
    lowest.and_then(|lowest| lowest.base.folder()).map_or(Ok(()), |folder| Err(without_a_rule(folder)))
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
