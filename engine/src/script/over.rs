//! Rule bases over each other: what one says stands in place of what those beneath say under the same name.

use std::collections::{BTreeMap, BTreeSet};

use super::read::{Draft, Read};
use crate::diagnostic::{Code, Diagnostic};
use crate::suggest::nearest;

/// A rule that does not count.
pub(crate) struct Covered {
    pub(crate) draft: Draft,
    /// File and line that say to go without it; `None`: a rule of its name stands above it.
    pub(crate) without: Option<(String, usize)>,
}

/// Takes from each base what those above it replace or go without.
///
/// # Arguments
/// `bases` are the files of each, the lowest first.
///
/// # Returns
/// The rules that were taken, in their order.
pub(crate) fn lay(bases: &mut [Vec<Read>], problems: &mut Vec<Diagnostic>) -> Vec<Covered> {
    let names_of = |base: &Vec<Read>| -> Vec<String> {
        base.iter().flat_map(|read| &read.drafts).map(|draft| draft.rule.name.clone()).collect()
    };
    let all: Vec<Vec<String>> = bases.iter().map(names_of).collect();
    let mut taken = vec![];
    for above in (0..bases.len()).rev() {
        let known = || all[..above].iter().flatten();
        let (beneath, above) = bases.split_at_mut(above);
        let above = &above[0];
        let mut names: BTreeMap<String, Option<(String, usize)>> =
            above.iter().flat_map(|read| &read.drafts).map(|draft| (draft.rule.name.clone(), None)).collect();
        for without in above.iter().flat_map(|read| &read.withouts) {
            let place = without.file.source.place(without.position);
            if known().any(|name| *name == without.name) {
                let said = (without.file.source.name().to_owned(), place.line);
                names.entry(without.name.clone()).or_insert(Some(said));
            } else {
                let meant = nearest(&without.name, known().map(String::as_str));
                let message = format!("no rule beneath is called \"{}\"", without.name);
                problems.push(Diagnostic::error(Code::UnknownRule, &place, message).did_you_mean(meant));
            }
        }
        let classes: BTreeSet<&str> =
            above.iter().flat_map(|read| &read.classes).map(|class| class.name.as_str()).collect();
        for read in beneath.iter_mut().flatten() {
            let (gone, kept) = std::mem::take(&mut read.drafts)
                .into_iter()
                .partition(|draft| names.contains_key(&draft.rule.name));
            read.drafts = kept;
            taken.extend(gone.into_iter().map(|draft: Draft| {
                let without = names.get(&draft.rule.name).cloned().flatten();
                Covered { draft, without }
            }));
            read.classes.retain(|class| !classes.contains(class.name.as_str()));
            for lower in &mut read.properties {
                let same = above
                    .iter()
                    .flat_map(|read| &read.properties)
                    .filter(|upper| (&upper.class, &upper.property) == (&lower.class, &lower.property));
                for upper in same {
                    if upper.link.is_some() {
                        lower.link = None;
                    }
                    if !upper.sources.is_empty() {
                        lower.sources.clear();
                        lower.default = None;
                    }
                }
            }
        }
    }
    taken
}
