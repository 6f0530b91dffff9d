//! What the program carries: the shipped rule bases and the example sites.

use std::collections::BTreeSet;
use std::path::Path;

use rust_embed::RustEmbed;

use crate::error::Result;
use crate::site::whole::Whole;

/// The folder `rules/` of the repository.
#[derive(RustEmbed)]
#[folder = "$CARGO_MANIFEST_DIR/../rules"]
#[include = "*.rhai"]
#[include = "*.toml"]
pub struct Rules;

#[derive(RustEmbed)]
#[folder = "$CARGO_MANIFEST_DIR/sites"]
#[include = "*.toml"]
#[include = "*.csv"]
#[include = "*.rhai"]
pub struct Sites;

/// The pages of the manual that the program quotes.
#[derive(RustEmbed)]
#[folder = "$CARGO_MANIFEST_DIR/../manual/src"]
#[include = "what-rules-see.md"]
struct Manual;

/// The text of a page of the manual; of one that the program does not carry, none.
pub fn page(name: &str) -> String {
    Manual::get(name).map_or_else(String::new, |page| String::from_utf8_lossy(&page.data).into_owned())
}

/// Files of one folder of `E`, by name, in the order of their names.
pub fn files<E: RustEmbed>(folder: &str) -> Vec<(String, String)> {
    let mut found: Vec<_> = E::iter()
        .filter_map(|path| {
            let name = path.strip_prefix(folder)?.strip_prefix('/')?.to_owned();
            let content = E::get(&path)?;
            (!name.contains('/')).then(|| (name, String::from_utf8_lossy(&content.data).into_owned()))
        })
        .collect();
    found.sort();
    found
}

/// The folders in one folder of `E`, in the order of their names.
pub fn folders<E: RustEmbed>(folder: &str) -> Vec<String> {
    let inside = |path: &str| {
        let (first, _) = path.strip_prefix(folder)?.strip_prefix('/')?.split_once('/')?;
        Some(first.to_owned())
    };
    E::iter().filter_map(|path| inside(&path)).collect::<BTreeSet<_>>().into_iter().collect()
}

/// Makes one shipped folder in a folder of the user's. Files that are there already are an error.
pub fn make<E: RustEmbed>(folder: &str, into: &Path, made: &mut Whole) -> Result<()> {
    made.folder(into)?;
    files::<E>(folder).into_iter().try_for_each(|(name, text)| made.file(&into.join(name), text))
}
