//! What the program carries: the shipped rule bases, the example sites, the page, and what it quotes of the manual.

use std::collections::BTreeSet;
use std::path::Path;

use crate::error::Result;
use crate::site::whole::Whole;

/// Files by their paths, in the order of these.
pub type Files = &'static [(&'static str, &'static [u8])];

// RULES, SITES, PAGE and MANUAL, made by kb/build.rs
include!(concat!(env!("OUT_DIR"), "/carried.rs"));

/// A page of the manual that the program quotes; of one that it does not carry, nothing.
pub fn page(name: &str) -> String {
    let found = MANUAL.iter().find(|(path, _)| *path == name);
    found.map_or_else(String::new, |(_, content)| String::from_utf8_lossy(content).into_owned())
}

/// Files of one folder, by name, in the order of their names.
pub fn files(carried: Files, folder: &str) -> Vec<(String, String)> {
    let inside = |path: &'static str| {
        let name = path.strip_prefix(folder)?.strip_prefix('/')?;
        (!name.contains('/')).then(|| name.to_owned())
    };
    let text = |content: &[u8]| String::from_utf8_lossy(content).into_owned();
    carried.iter().filter_map(|(path, content)| Some((inside(path)?, text(content)))).collect()
}

/// The folders in one folder, in the order of their names.
pub fn folders(carried: Files, folder: &str) -> Vec<String> {
    let inside = |path: &str| {
        let (first, _) = path.strip_prefix(folder)?.strip_prefix('/')?.split_once('/')?;
        Some(first.to_owned())
    };
    carried.iter().filter_map(|(path, _)| inside(path)).collect::<BTreeSet<_>>().into_iter().collect()
}

/// Makes one shipped folder in a folder of the user's. Files that are there already are an error.
pub fn make(carried: Files, folder: &str, into: &Path, made: &mut Whole) -> Result<()> {
    made.folder(into)?;
    files(carried, folder).into_iter().try_for_each(|(name, text)| made.file(&into.join(name), text))
}
