//! The rule bases of worlds, and what their rules may speak of.

use std::path::Path;
use std::sync::Arc;

use adit_engine::{RuleBase, Schema, Severity, Type};

use super::consult::Class;
use crate::error::{Code, Error, Finding, Result};
use crate::site::base::Base;
use crate::site::lint;
use crate::site::rules::{self, Rules};

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    /// Parts and corridors: the paper's tables as they are meant, and as they are printed.
    Channels,
    Navigation,
    Adapt,
}

impl Kind {
    /// The shipped rule bases, the one that counts by default first.
    pub const fn shipped(self) -> &'static [&'static str] {
        match self {
            Self::Channels => &["corrected", "printed"],
            Self::Navigation => &["navigation"],
            Self::Adapt => &["adapt"],
        }
    }

    /// The classes of objects that its rules are asked about.
    pub fn classes(self) -> Vec<Class> {
        match self {
            Self::Channels => [super::steps::class()].into_iter().chain(super::turns::classes()).collect(),
            Self::Navigation => crate::navigation::judge::classes().into(),
            Self::Adapt => crate::adapt::classes().into(),
        }
    }

    /// The properties that are read by others than rules.
    fn asked(self) -> impl Iterator<Item = String> {
        let named =
            |class: Class| class.asked.iter().map(move |property| format!("{}.{property}", class.name));
        self.classes().into_iter().flat_map(named)
    }

    /// The rule bases of a name, the lowest first; `None` where none is shipped under it.
    fn bases(self, name: &str) -> Option<Vec<Base>> {
        let folders: &[&str] = match (self, name) {
            (Self::Channels, "corrected") => &["channels/corrected"],
            (Self::Channels, "printed") => &["channels/corrected", "channels/printed"],
            (Self::Navigation, "navigation") => &["navigation"],
            (Self::Adapt, "adapt") => &["adapt"],
            _ => return None,
        };
        Some(folders.iter().map(|folder| Base::Shipped((*folder).to_owned())).collect())
    }

    /// The classes and properties that rules may name.
    pub fn schema(self) -> Schema {
        let add = |schema: Schema, class: Class| schema.class(class.name, &class.told);
        let schema = self.classes().into_iter().fold(Schema::default(), add);
        // what sites know besides
        match self {
            Self::Channels => schema,
            Self::Navigation => {
                let doorways = [("doorway", Type::Number), ("called", Type::Text), ("closed", Type::Truth)];
                schema.class("DOORWAYS", &doorways)
            }
            Self::Adapt => schema.class("GOALS", &[("goal", Type::Text)]),
        }
    }
}

/// Reads a rule base: a shipped one by its name, else a folder. One that cannot be right, or fails a test beside it, is
/// refused.
///
/// # Returns
/// The rules, and what is not wrong but worth a look, as text.
pub fn load(kind: Kind, name: &str, beside: &Path) -> Result<(Arc<RuleBase>, Vec<String>)> {
    let is_shipped = kind.shipped().contains(&name);
    let (base, mut remarks) = vetted(kind, found(kind, name, beside)?, is_shipped, None)?;
    // the shipped ones are as they are meant
    if !is_shipped {
        remarks.extend(lint::not_read(&beside.join(name)));
    }
    Ok((base, remarks.iter().map(ToString::to_string).collect()))
}

/// Reads the shipped rule base of a kind, with the folder of its name beside it over it, where there is one.
///
/// # Returns
/// The rules, which bases they are of, the lowest first, and what is not wrong but worth a look.
pub fn load_over(kind: Kind, beside: &Path) -> Result<(Arc<RuleBase>, Vec<Base>, Vec<Finding>)> {
    let name = kind.shipped()[0];
    let folder = beside.join(name);
    let mut bases = kind.bases(name).unwrap_or_default();
    let is_own = folder.is_dir();
    if is_own {
        bases.push(Base::Folder(folder.clone()));
    }
    let (base, mut remarks) =
        vetted(kind, rules::load_bases(&bases)?, !is_own, Some(&format!("rules/{name}/")))?;
    if is_own {
        remarks.extend(lint::not_read(&folder));
    }
    Ok((base, bases, remarks))
}

/// Refuses rules that cannot be right, or fail a test beside them.
///
/// # Arguments
/// `shipped_in` is where shipped rules lie that others lie over.
fn vetted(
    kind: Kind,
    rules: Rules,
    is_shipped: bool,
    shipped_in: Option<&str>,
) -> Result<(Arc<RuleBase>, Vec<Finding>)> {
    let schema = &kind.schema();
    let Rules { base, tests, .. } = rules;
    let (errors, warnings): (Vec<_>, Vec<_>) =
        base.check(schema).into_iter().partition(|found| found.severity == Severity::Error);
    if !errors.is_empty() {
        return Err(Error::all(errors));
    }
    // of the shipped ones sites carry them out
    let is_own = |file: &str| shipped_in.is_none_or(|shipped| !file.starts_with(shipped));
    let idle = lint::not_carried_out(&base, "worlds", Finding::said, is_own);
    if !idle.is_empty() && !is_shipped {
        return Err(Error::all(idle));
    }
    let outcomes = tests.run(&base, schema).map_err(|wrong| Error::all(wrong.0))?;
    let failures: Vec<_> =
        outcomes.into_iter().flat_map(|outcome| outcome.failures).map(|failure| failure.diagnostic).collect();
    if !failures.is_empty() {
        return Err(Error::all(failures));
    }
    let remarks = if is_shipped {
        Vec::new()
    } else {
        let unread = lint::unread_but(&base, kind.asked(), is_own);
        let warnings = warnings.into_iter().filter(|warning| is_own(&warning.file)).map(Finding::from);
        warnings.chain(unread).collect()
    };
    Ok((Arc::new(base), remarks))
}

/// Reads a rule base that was in use already, whatever it speaks of.
pub(crate) fn found(kind: Kind, name: &str, beside: &Path) -> Result<Rules> {
    if let Some(bases) = kind.bases(name) {
        return rules::load_bases(&bases);
    }
    let folder = beside.join(name);
    if folder.is_dir() {
        return rules::load_bases(&[Base::Folder(folder)]);
    }
    let message = format!("there is no rule base `{name}`: {} is no folder", folder.display());
    let help =
        format!("the shipped ones are `{}`; anything else is a folder", kind.shipped().join("` and `"));
    Err(Error::said(Code::PlanNoRules, message, Some(help)))
}
