//! All rule files that count together, and all places where a name stands in them.

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::{Path, PathBuf};

use super::occurrences::{Classes, Item, Named, Names, Occurrence, names};
use super::project::Project;
use super::test_names;
use crate::site::base::{self, Base};

/// A rule file, or one of tests of rules.
pub struct File {
    pub path: PathBuf,
    pub text: String,
    /// Whether it is the user's: a file that the program carries cannot be written.
    pub is_own: bool,
    pub names: Names,
}

pub struct Library {
    pub files: Vec<File>,
    pub classes: Classes,
}

impl Library {
    /// Reads the rule bases of a project, with drafts in place of what is saved.
    ///
    /// # Arguments
    /// `shipped` is a folder into which the files that the program carries are written, so that an editor can show them.
    pub fn read(project: &Project, drafts: &BTreeMap<PathBuf, String>, shipped: &Path) -> Self {
        let mut texts: BTreeMap<PathBuf, (String, bool)> = BTreeMap::new();
        let mut folders = BTreeSet::from([project.folder().join("rules")]);
        for base in project.bases() {
            match &base {
                Base::Folder(folder) => {
                    folders.insert(folder.clone());
                }
                Base::Shipped(_) => texts.extend(carried(&base, shipped)),
            }
        }
        for folder in &folders {
            let saved = base::files(folder).into_iter();
            texts.extend(
                saved.filter_map(|path| Some((path.clone(), (fs::read_to_string(&path).ok()?, true)))),
            );
            let of_it = drafts.iter().filter(|(path, _)| is_in(path, folder));
            texts.extend(of_it.map(|(path, text)| (path.clone(), (text.clone(), true))));
        }
        let mut classes = Classes::default();
        let is_rules = |path: &Path| path.extension().is_some_and(|kind| kind == "rhai");
        for (_, (text, _)) in texts.iter().filter(|(path, _)| is_rules(path)) {
            classes.learn(text);
        }
        let file = |(path, (text, is_own)): (PathBuf, (String, bool))| {
            let found = if is_rules(&path) { names(&text, &classes) } else { test_names::names(&text) };
            File { path, text, is_own, names: found }
        };
        let files = texts.into_iter().map(file).collect();
        Self { files, classes }
    }

    pub fn file(&self, path: &Path) -> Option<&File> {
        self.files.iter().find(|file| file.path == path)
    }

    /// What stands at a byte of a file: the narrowest name that does.
    pub fn at(&self, path: &Path, byte: usize) -> Option<(&File, &Occurrence)> {
        let file = self.file(path)?;
        let touching =
            file.names.occurrences.iter().filter(|found| found.span.start <= byte && byte <= found.span.end);
        touching.min_by_key(|found| found.span.len()).map(|found| (file, found))
    }

    /// All places of a name that stands in a file.
    pub fn all<'l>(
        &'l self,
        named: &'l Named,
        of: &'l Path,
    ) -> impl Iterator<Item = (&'l File, &'l Occurrence)> {
        let is_local = matches!(named, Named::Variable(..) | Named::Own(_));
        let files = self.files.iter().filter(move |file| !is_local || file.path == of);
        files.flat_map(move |file| {
            file.names
                .occurrences
                .iter()
                .filter(move |found| found.named == *named)
                .map(move |found| (file, found))
        })
    }

    /// The item that a byte of a file lies in.
    pub fn item(&self, path: &Path, byte: usize) -> Option<&Item> {
        self.file(path)?.names.items.iter().rfind(|item| item.span.start <= byte && byte <= item.span.end)
    }

    /// The properties of a class that rules set or read, and whether they set them.
    pub fn properties(&self, class: &str) -> BTreeMap<&str, bool> {
        use super::occurrences::Role;
        let mut found = BTreeMap::new();
        for occurrence in self.files.iter().flat_map(|file| &file.names.occurrences) {
            if let Named::Property(of, property) = &occurrence.named
                && of == class
            {
                *found.entry(property.as_str()).or_default() |= occurrence.role == Role::Set;
            }
        }
        found
    }

    /// The rules that set a property, with their files.
    pub fn setting<'l>(&'l self, property: &'l Named) -> Vec<(&'l File, &'l Item)> {
        use super::occurrences::Role;
        let mut found: Vec<(&File, &Item)> = Vec::new();
        for file in &self.files {
            let sets = file
                .names
                .occurrences
                .iter()
                .filter(|found| found.named == *property && found.role == Role::Set);
            for set in sets {
                if let Some(item) = file.names.items.iter().rfind(|item| item.span.contains(&set.span.start))
                    && !found.iter().any(|(_, known)| std::ptr::eq(*known, item))
                {
                    found.push((file, item));
                }
            }
        }
        found
    }
}

/// Whether a file is one of a rule base's, or of its tests.
fn is_in(path: &Path, folder: &Path) -> bool {
    let kind = path.extension().and_then(|kind| kind.to_str());
    let is_test = || path.parent() == Some(&folder.join(base::TESTS));
    kind == Some("rhai") && path.parent() == Some(folder) || kind == Some("toml") && is_test()
}

fn carried(base: &Base, into: &Path) -> Vec<(PathBuf, (String, bool))> {
    let files = base.rules().unwrap_or_default().into_iter();
    files.map(|source| (into.join(source.name()), (source.text().to_owned(), false))).collect()
}
