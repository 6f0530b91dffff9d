//! Files beside the map that a site takes areas from: masks of Nav2, zone sets of VDA 5050.

use std::fs;
use std::hash::{Hash, Hasher};
use std::path::{Path, PathBuf};

use super::diagnostic::{MapErrors, Problem};
use super::fields::Fields;
use super::mask::Mask;
use super::zone_set::ZoneSet;
use crate::world::World;

/// A file of areas that `site.toml` names.
#[derive(Clone, Debug)]
pub enum AreaFile {
    Mask(Mask),
    ZoneSet(ZoneSet),
}

impl AreaFile {
    /// The keys that they take from a document.
    pub const KEYS: [&'static str; 2] = ["mask", "zone_set"];

    /// Reads the entries `[[mask]]` and `[[zone_set]]`; files are relative to `folder`.
    pub fn from_fields(fields: &Fields<'_, '_>, folder: &Path, problems: &mut Vec<Problem>) -> Vec<Self> {
        let masks = Mask::from_fields(fields, folder, problems).into_iter().map(Self::Mask);
        let mut all: Vec<Self> = masks.collect();
        all.extend(ZoneSet::from_fields(fields, folder, problems).into_iter().map(Self::ZoneSet));
        all
    }

    /// All files that it is made of.
    pub fn files(&self) -> Vec<PathBuf> {
        match self {
            Self::Mask(mask) => mask.files(),
            Self::ZoneSet(set) => vec![set.file().to_owned()],
        }
    }

    /// Hashes the text in which it stands; of a mask without its image.
    pub fn hash_text(&self, hasher: &mut impl Hasher) {
        let file = match self {
            Self::Mask(mask) => mask.file(),
            Self::ZoneSet(set) => set.file(),
        };
        fs::read(file).unwrap_or_default().hash(hasher);
    }

    /// Lays its areas over a world, and gives notes.
    pub fn lay_over(&self, world: &mut World) -> Result<Vec<Problem>, MapErrors> {
        match self {
            Self::Mask(mask) => mask.lay_over(world),
            Self::ZoneSet(set) => set.lay_over(world),
        }
    }
}
