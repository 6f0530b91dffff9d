#![doc = include_str!("../REFERENCE.md")]

/// The examples of the README run.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;

/// The way into the language of rules, in Markdown, for programs that show it.
pub const GUIDE: &str = include_str!("../README.md");
/// All functions that rules may call, in Markdown, for programs that show them.
pub const FUNCTIONS: &str = include_str!("../FUNCTIONS.md");

mod agenda;
mod changes;
mod check;
mod class;
mod column;
mod conclusions;
mod declared;
mod diagnostic;
mod knowledge;
mod lint;
mod machine;
mod order;
mod plan;
mod reactions;
mod rejection;
mod rule;
mod rule_base;
mod rule_test;
mod schema;
mod script;
mod suggest;
mod symbols;
mod table;
mod told;
mod value;
mod zero;

pub use changes::{Changes, ClassChanges};
pub use class::{Class, ClassError};
pub use conclusions::{
    Conclusions, Conflict, Gap, Grounds, Justification, Justifications, LeftOut, Origin, Reason, Revision,
    Support, Waiting, Witness,
};
pub use declared::{Declarations, Source};
pub use diagnostic::{Code, Diagnostic, Diagnostics, Severity};
pub use knowledge::KnowledgeBase;
pub use knowledge::ask::{Answer, Question};
pub use knowledge::consultation::explain::{Considered, Miss};
pub use knowledge::consultation::{Consultation, Datum, Grain};
pub use knowledge::dominated::Dominated;
pub use knowledge::facts::FactError;
pub use knowledge::misspelt::Misspelt;
pub use knowledge::unmet::Unmet;
pub use reactions::{Activation, CarriedOut, Firing, Reactions, Told};
pub use rejection::{Rejected, Rejection, WhyNot};
pub use rule::{Operator, PropertyName, Rule};
pub use rule_base::{Instead, Replaced, RuleBase, Standing};
pub use rule_test::{RuleTests, TestFailure, TestOutcome};
pub use schema::Schema;
pub use script::limits::Limits;
pub use script::source::{MAX_FILE_BYTES, SourceFile};
pub use table::grid::{Amiss, Grid, GridRow};
pub use value::{Type, Value};
