//! Over which version of a rule the user's own was written. It is kept in the database, so that whoever gets better rules
//! from beneath hears where an own one still stands in their place.

use std::collections::BTreeMap;

use adit_db::Tx;
use adit_engine::{Instead, Replaced, RuleBase};

use crate::error::{Code, Finding, Result};
use crate::site::lint::{place, standing};

/// Before the names of rules, in the table `site`.
const KEY: &str = "rule over: ";

/// Which version of a rule stands over which one beneath.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Over {
    own: String,
    beneath: String,
}

impl Over {
    fn of(replaced: &Replaced) -> Self {
        let own = match &replaced.by {
            Instead::Rule(by) => &by.version,
            Instead::Without { .. } => "without",
        };
        Self { own: own.to_owned(), beneath: replaced.beneath.version.clone() }
    }
}

/// What is kept, by the names of rules.
pub fn kept(tx: &mut Tx<'_>) -> Result<BTreeMap<String, Over>> {
    let read = |(key, value): (String, String)| {
        let (own, beneath) = value.split_once(' ')?;
        Some((key[KEY.len()..].to_owned(), Over { own: own.to_owned(), beneath: beneath.to_owned() }))
    };
    Ok(tx.site_values(KEY)?.into_iter().filter_map(read).collect())
}

/// Keeps what is new: a rule that was there already goes on standing over the version that it was written over.
pub fn keep(tx: &mut Tx<'_>, rules: &RuleBase) -> Result<()> {
    let kept = kept(tx)?;
    let now: BTreeMap<&String, Over> =
        rules.replaced().iter().map(|replaced| (&replaced.rule, Over::of(replaced))).collect();
    for gone in kept.keys().filter(|rule| !now.contains_key(rule)) {
        tx.set_site_value(&format!("{KEY}{gone}"), None)?;
    }
    for (rule, over) in now {
        if kept.get(rule).is_none_or(|known| known.own != over.own) {
            tx.set_site_value(&format!("{KEY}{rule}"), Some(&format!("{} {}", over.own, over.beneath)))?;
        }
    }
    Ok(())
}

/// The rules beneath that were changed since the ones in their place were written.
pub fn changed_beneath(rules: &RuleBase, kept: &BTreeMap<String, Over>) -> Vec<Finding> {
    let changed = rules.replaced().iter().filter_map(|replaced| {
        let (now, was) = (Over::of(replaced), kept.get(&replaced.rule)?);
        let is_changed = now.own == was.own && now.beneath != was.beneath;
        is_changed.then(|| {
            let message = format!(
                "rule \"{}\" ({}) was changed since {} was written: it was version {}, and is {} now",
                replaced.rule,
                standing(&replaced.beneath),
                place(&replaced.by),
                was.beneath,
                now.beneath
            );
            let help =
                "read both: yours goes on counting; with any change of yours this is not said any more";
            Finding::warning(Code::RuleChangedBeneath, message, Some(help.to_owned()))
        })
    });
    changed.collect()
}
