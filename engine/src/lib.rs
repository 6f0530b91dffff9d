//! An expert-system shell: classes of objects, rules in scripts, inference and explanation.

mod check;
mod class;
mod column;
mod conclusions;
mod diagnostic;
mod knowledge;
mod machine;
mod order;
mod plan;
mod rule;
mod rule_base;
mod schema;
mod script;
mod suggest;
mod symbols;
mod value;

pub use class::{Class, ClassError};
pub use conclusions::{
    Conclusions, Conflict, Gap, Justification, Justifications, LeftOut, Origin, Reason, Revision, Support,
    Waiting, Witness,
};
pub use diagnostic::{Code, Diagnostic, Diagnostics, Severity};
pub use knowledge::KnowledgeBase;
pub use rule::{Operator, PropertyName, Rule};
pub use rule_base::RuleBase;
pub use schema::Schema;
pub use script::interpreter::Limits;
pub use script::source::{MAX_FILE_BYTES, SourceFile};
pub use value::{Type, Value};
