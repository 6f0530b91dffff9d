//! The number of the knowledge base's state, which stands on every answer and grows with every change that took.

use std::hash::{Hash, Hasher};
use std::path::Path;

use adit_db::Tx;
use adit_engine::RuleBase;
use adit_planners::world::World;
use siphasher::sip::SipHasher13;

use crate::error::Result;
use crate::knowledge::tables::content;
use crate::knowledge::told::Told;
use crate::site::Site;

/// The number of the state that the database is in; 0 where it was never built.
pub fn read(tx: &mut Tx<'_>) -> Result<u64> {
    Ok(tx.site_value("generation")?.and_then(|text| text.parse().ok()).unwrap_or(0))
}

/// Gives the database a new number, unless what was derived is the `same` as before, rests on an equal basis, and nothing
/// was edited: programs that hold the site look at its tables again where the number is another one, though nothing
/// follows from what was edited.
pub fn renew(tx: &mut Tx<'_>, same: bool, basis: &str) -> Result<u64> {
    let newest = tx.history(1)?.first().map_or(0, |entry| entry.id);
    let basis = format!("{basis}{AFTER}{newest}");
    let same = same && tx.site_value("basis")?.as_deref() == Some(&basis);
    let generation = read(tx)? + u64::from(!same);
    tx.set_site_value("basis", Some(&basis))?;
    tx.set_site_value("generation", Some(&generation.to_string()))?;
    Ok(generation)
}

/// Parts a basis from the newest edit that was made on it.
const AFTER: char = '-';

/// Whether what is in the database was derived from this basis.
pub fn rests_on(tx: &mut Tx<'_>, basis: &str) -> Result<bool> {
    let kept = tx.site_value("basis")?;
    Ok(kept.is_some_and(|kept| kept.split(AFTER).next() == Some(basis)))
}

/// What a derivation starts from besides the tables: the costly part, for many edits.
#[derive(Clone)]
pub struct Basis(SipHasher13);

impl Basis {
    /// Of a site as its files are now.
    pub fn new(site: &Site, world: &World, rules: &RuleBase) -> Self {
        let mut hasher = SipHasher13::new();
        (env!("CARGO_PKG_VERSION"), site.texts(), world.fingerprint()).hash(&mut hasher);
        for rule in rules.rules() {
            // the same site in another folder is the same
            let file = Path::new(rule.file());
            let file = file.strip_prefix(&site.folder).unwrap_or(file);
            (rule.name(), rule.version(), file, rule.line()).hash(&mut hasher);
        }
        Self(hasher)
    }

    /// The whole basis, with what is told.
    pub fn with(&self, told: &Told) -> String {
        let mut hasher = self.0;
        for (class, table) in &told.classes {
            (class, content(std::slice::from_ref(table))).hash(&mut hasher);
        }
        told.hash(&mut hasher);
        format!("{:016x}", hasher.finish())
    }
}
