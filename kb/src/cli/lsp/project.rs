//! The folder that a file belongs to: its rule files with what they name, and what is wrong with all of it.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use super::mirror::Mirror;
use super::vocabulary::Vocabulary;
use crate::error::{Error, Finding, Problem};
use crate::knowledge::KnowledgeBase;
use crate::site::base::{self, Base, TESTS};
use crate::site::rules;

/// The file that makes a folder a site.
const SITE: &str = "site.toml";

/// What files are judged together.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Project {
    Site(PathBuf),
    /// A rule base that is no part of a site.
    Rules(PathBuf),
}

/// What came of a look at a project.
pub struct Checked {
    /// By file; what has no place in a file is said of `site.toml`, or of the folder's first file.
    pub problems: BTreeMap<PathBuf, Vec<Problem>>,
    /// Where the site could be looked into.
    pub vocabulary: Option<Vocabulary>,
}

impl Project {
    /// The project of a file: the site that it lies in, or the rule base.
    pub fn of(file: &Path) -> Option<Self> {
        let site = file.ancestors().skip(1).find(|folder| folder.join(SITE).is_file());
        if let Some(site) = site.or_else(|| file.parent().filter(|_| file.ends_with(SITE))) {
            return Some(Self::Site(site.to_owned()));
        }
        let folder = file.parent()?;
        let kind = file.extension()?.to_str()?;
        match kind {
            "rhai" => Some(Self::Rules(folder.to_owned())),
            "toml" if folder.ends_with(TESTS) => Some(Self::Rules(folder.parent()?.to_owned())),
            _ => None,
        }
    }

    pub fn folder(&self) -> &Path {
        match self {
            Self::Site(folder) | Self::Rules(folder) => folder,
        }
    }

    /// The rule bases that count, the lowest first, as they are saved.
    pub fn bases(&self) -> Vec<Base> {
        match self {
            // where site.toml is what is being written, its own rules are all that is known
            Self::Site(folder) => KnowledgeBase::open(folder)
                .map_or_else(|_| vec![Base::Folder(folder.join("rules"))], |site| site.rule_bases()),
            Self::Rules(folder) => vec![Base::Folder(folder.clone())],
        }
    }

    /// Looks at the project as it would be with the drafts saved.
    pub fn check(&self, drafts: &BTreeMap<PathBuf, String>) -> Checked {
        let mirror = match Mirror::new(self.folder(), drafts) {
            Ok(mirror) => mirror,
            Err(error) => {
                let wrong = Error::io("mirror", self.folder(), &error);
                return Checked { problems: self.placed(None, wrong.problems()), vocabulary: None };
            }
        };
        let (found, vocabulary) = match self {
            Self::Site(folder) => site(&mirror.at(folder)),
            Self::Rules(folder) => {
                let alone = rules::load_bases(&[Base::Folder(mirror.at(folder))]);
                (alone.err().map_or_else(Vec::new, Error::into_problems), None)
            }
        };
        Checked { problems: self.placed(Some(&mirror), &found), vocabulary }
    }

    fn placed(&self, mirror: Option<&Mirror>, found: &[Finding]) -> BTreeMap<PathBuf, Vec<Problem>> {
        let mut placed: BTreeMap<PathBuf, Vec<Problem>> = BTreeMap::new();
        for mut problem in Problem::all(found) {
            if let Some(mirror) = mirror {
                problem.message = mirror.said(&problem.message);
                problem.help = problem.help.map(|help| mirror.said(&help));
            }
            let file = problem.file.as_ref().map(PathBuf::from).filter(|file| file.is_absolute());
            let file = file.map(|file| mirror.map_or_else(|| file.clone(), |mirror| mirror.back(&file)));
            placed.entry(file.unwrap_or_else(|| self.whole())).or_default().push(problem);
        }
        placed
    }

    /// The file that stands for all of them.
    fn whole(&self) -> PathBuf {
        match self {
            Self::Site(folder) => folder.join(SITE),
            Self::Rules(folder) => base::files(folder).into_iter().next().unwrap_or_else(|| folder.clone()),
        }
    }
}

fn site(folder: &Path) -> (Vec<Finding>, Option<Vocabulary>) {
    let opened = KnowledgeBase::open(folder);
    match opened.as_ref().map(|site| site.examine(KnowledgeBase::classes)) {
        Ok(Ok((found, schema))) => (found, Some(Vocabulary::new(schema))),
        Ok(Err(error)) => {
            // what was built before says what there is, while a file is half written
            let built = opened.ok().filter(|site| site.database().exists());
            let schema = built.and_then(|site| site.classes().ok());
            (error.into_problems(), schema.map(Vocabulary::new))
        }
        Err(_) => (opened.err().map_or_else(Vec::new, Error::into_problems), None),
    }
}
