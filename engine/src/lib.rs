//! An expert-system shell: classes of objects, rules in scripts, inference and explanation.
//!
//! A host asserts classes of objects ([`Class`], [`KnowledgeBase::assert`]), compiles rule files
//! ([`RuleBase::compile`]), lets the rules conclude ([`KnowledgeBase::conclude`]), reads values back, and asks why
//! ([`KnowledgeBase::why`]), or why not ([`KnowledgeBase::why_not`]). Tests of rules are data ([`RuleTests`]).
//!
//! ```
//! use adit_engine::{Class, KnowledgeBase, RuleBase, SourceFile, Value};
//!
//! let rules = RuleBase::compile(&[SourceFile::new("garden.rhai", r#"
//!     rule "who waters"
//!         each  plant  in PLANTS where plant.days_dry > 2
//!         least person in PEOPLE by busy where person.can_carry >= plant.litres
//!         then { plant.waterer = person.name; }
//! "#)])?;
//! let mut garden = KnowledgeBase::new();
//! garden.assert(
//!     Class::new("PLANTS", &["pot"])
//!         .texts("pot", [Some("fern")])
//!         .numbers("days_dry", [Some(3.0)])
//!         .numbers("litres", [Some(0.5)]),
//! )?;
//! garden.assert(
//!     Class::new("PEOPLE", &["name"])
//!         .texts("name", [Some("Ann"), Some("Bob")])
//!         .numbers("busy", [Some(7.0), Some(9.0)])
//!         .numbers("can_carry", [Some(0.2), Some(5.0)]),
//! )?;
//! garden.conclude(&rules);
//! assert_eq!(garden.value("PLANTS", "fern", "waterer"), Some(Value::from("Bob")));
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! # Rules
//!
//! ```text
//! rule "NAME" [priority N]
//!     each  x in CLASS [where CONDITION]           for every object that passes
//!     least y in CLASS by NUMBER [where CONDITION] the one with the least value (most: the greatest)
//!     some  z in CLASS [where CONDITION]           the first that passes
//!     none  w in CLASS [where CONDITION]           only if there is no such object
//!     all   v in CLASS [where CONDITION] have CONDITION   only if all that pass the first pass the second
//!     count N of u in CLASS [where CONDITION]      N is how many pass
//!     sum   N of u in CLASS by NUMBER [where CONDITION]   N is the sum over those that pass
//!     [hypothesis x.property]                      `then` may be left out after it
//!     then { x.property = VALUE; ... }
//!     [else { ... }]
//!
//! revise "NAME"
//!     clauses as above
//!     set x.property by OPERATOR NUMBER [level N]  * + - max min; the level is 0 if not given
//!
//! table "NAME" HIT [priority N]                    unique, any, first, priority [VALUES], collect sum|min|max|count
//!     clauses as above
//!     given [ VALUE, ... ]
//!     set   [ x.property, ... ]
//!     rows  [ [ CELL, ..., VALUE, ... ], ... ]     3, "z", any, ["a", "b"], not("z"), below(3), between(1, 3), ...
//!
//! class LOW_DOORS of DOORS where CONDITION         the objects of DOORS that pass; a class may be of such a class
//! property DOORS.width from table, rule, default 2, ask "How wide is door {door}?"
//! property DOORS.room names ROOMS[.key]            then `door.room.height` reads through it
//! ```
//!
//! The first clause is an `each` (or `some`); the others follow in any order and may speak of the variables before
//! them. In `by`, a bare name is a property of the variable just bound. Files may also hold functions (`fn`) and
//! constants (`const`). Where one follows an item that does not end in `}`, a `;` belongs between. The words that
//! rhai reserves (`is`, `default`, `case`, ...) cannot name properties or variables.
//!
//! - A **rule concludes**. It is pure, and the order of rules and of rows never counts, but for ties. A property
//!   has one value: two rules, or two bindings of one rule, that say different things make a [`Conflict`], and the
//!   value is unknown. The greatest `priority` with a known value is heard. Within one action a later assignment
//!   replaces an earlier one. A told value stands before a concluded one.
//! - **Rules are ordered** by what they read and set. Rules that need each other's conclusions are refused, and the
//!   cycle is named.
//! - **`least`** takes the least value and its object; of equal ones the first row. Objects whose value is unknown
//!   are left out and counted ([`LeftOut`]).
//! - **`count`** and **`sum`** give a number to the clauses after them and to the action, 0 where nothing passes.
//!   It is unknown where an unknown leaves open whether an object passes, or what it adds; `all` is not met then,
//!   unless other objects decide.
//! - **`hypothesis`** is a property of the first clause's object: true where all clauses are met, false where one
//!   is not, unknown where that is undecided. Several rules may prove one hypothesis: it is true if one proves it,
//!   false if all refute it. Nothing else sets it.
//! - A **table** concludes like a rule. Of its rows count: of `unique` and `any` the one that matches, of `first`
//!   the first, of `priority` the one whose first output ranks first, of `collect` all together. `between(a, b)`
//!   and `a..b` are from a up to, but not, b. What is unknown makes the outputs unknown, unless no row that could
//!   match looks at it. Rows of `unique` that overlap and rows of `any` that overlap and differ are errors; rows
//!   never reached, and inputs without a row, are warnings with an example.
//! - A **class by condition** may stand wherever a class stands. Bare names in its condition are properties of the
//!   object. What is declared of its properties counts before what is declared of the class that it is of.
//! - **Sources** are asked in their order. A default looks at told properties only.
//! - A **link** that names no object makes unknown what is read through it, and never fails a rule. A `where` may
//!   read through the link of its own object in `each` only.
//! - **`else`** runs once for each binding of the clauses before for which a `least`, `most` or `some` finds no
//!   object, a `none` finds one, or an `all` is not met. It may use the variables bound before that clause;
//!   properties of the others are unknown. An `each` that finds nothing, and a `where` of an `each` that fails, do
//!   not lead to `else`.
//! - **`revise`** changes a number, told or concluded. Each level starts from what the level below gave, and within a
//!   `revise` the property that it sets is read as the level below left it; everyone else reads the last level. A
//!   level has one operator (`+` and `-` are one). `each` contributes for every binding, `some` once; contributions
//!   are folded in the order of rule names and keys, so equal facts give equal bits. An unknown amount makes the
//!   value unknown.
//! - **Unknown** is a third truth value (Kleene 1952), and goes through arithmetic and comparison. `where` needs
//!   true. NaN is unknown; infinity is a number. `known(x)`, `unknown(x)` and `x ?? y` look at it. After an `if`
//!   whose condition is unknown, all that either branch sets is unknown.
//! - **Numbers** are 64-bit floats: `1 / 2` is a half. `+` joins texts with texts and numbers.
//!
//! Arithmetic, comparison, logic, `if`, `let`, `min max abs sqrt floor ceil round hypot`, joining of texts and
//! `x in [...]` are compiled to loops over columns, and equations between properties use an index. All else (other
//! functions, `switch`, loops) runs in the interpreter with the same meaning, some microseconds a binding; a function of
//! something unknown is unknown.
//!
//! # Messages
//!
//! What is wrong with rule files comes as [`Diagnostics`], up to 20 errors of syntax a file; [`RuleBase::check`]
//! adds what the classes show, and warnings: rows of tables that never count, inputs without a row, conditions that
//! nothing can pass, what is named and never used. Each has a code, a place and mostly a help; as JSON too.
//!
//! # Reactions
//!
//! ```text
//! on "NAME" [priority N]
//!     clauses as above
//!     then { tell("CLASS", #{ property: value, ... }); x.property = VALUE; forget(x); }
//! ```
//!
//! A rule concludes, and what it concludes goes when its reasons go. An `on` **tells**: new objects, values, objects
//! that are gone. What it told stays until it is told otherwise. [`KnowledgeBase::react`] makes everything right that
//! follows from what was told, carries out the first activation of the agenda, makes everything right again, and so on
//! until none waits. An **activation** is a rule with the objects that its clauses bind.
//!
//! ```
//! use adit_engine::{Class, KnowledgeBase, RuleBase, SourceFile, Value};
//!
//! let rules = RuleBase::compile(&[SourceFile::new("gate.rhai", r#"
//!     on "a coin opens the gate"
//!         each coin in COINS
//!         each gate in GATES where gate.gate == coin.gate && gate.state == "locked"
//!         then { gate.state = "open"; forget(coin); }
//! "#)])?;
//! let mut base = KnowledgeBase::new();
//! base.assert(Class::new("GATES", &["gate"]).texts("gate", [Some("north")]).texts("state", [Some("locked")]))?;
//! base.assert(Class::new("COINS", &[]).texts("gate", [Some("north"), Some("north")]))?;
//! let run = base.react(&rules);
//! assert_eq!(run.firings.len(), 1);
//! assert_eq!((base.value("GATES", "north", "state"), base.len("COINS")), (Some(Value::from("open")), Some(1)));
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! - The **order** is the same whatever the history: the greatest priority first, then the rules in the order of the
//!   files, then the rows of the objects in the order of the clauses. [`KnowledgeBase::agenda`] shows it.
//! - An activation that was carried out **comes again** only when a property that the rule reads of one of its objects
//!   has another value, told or concluded, or when its clauses stopped being met and are met again. That holds for
//!   what the rule changes itself: a rule that reads what it sets goes on until its condition is false.
//! - A body runs in the interpreter, with loops, `if` and the functions of its file (which may `tell` too). A property
//!   that is unknown is `()` there, and `x.p = ()` takes back what was told. It is done **whole or not at all**: values
//!   first, then what is forgotten, then new objects. If it fails, nothing of it is told, and it is not tried again.
//! - What is told stands before what is concluded. A class that only `tell` makes has no key: its objects are called by
//!   their rows, from 1. Names that are told may be new; one that looks like a slip is reported by
//!   [`RuleBase::check`].
//! - A run that does not end, takes too long or has too many matches is **taken back whole**, and the rules that kept
//!   firing are named (`rule/loop`).
//! - [`Reactions::log`] is what was told; [`KnowledgeBase::replay`] tells it again. Each firing makes the next
//!   [`generation`](KnowledgeBase::generation).
//!
//! # Limits
//!
//! | | |
//! |---|---|
//! | rule file | 1,000,000 bytes, 128 functions, expressions nested 64 deep (32 in functions) |
//! | rule | 32 clauses, 20 million firings, [`Limits::rule`] of time |
//! | run of reactions | [`Limits::firings`] (10,000), [`Limits::matches`] (1,000,000) kept, [`Limits::reactions`] of time |
//! | interpreted part | 1,000,000 steps with its closures, 32 calls deep, 256 variables |
//! | values in it | text of 64 KiB, array of 10,000, map of 1,000: measured before a function makes them |
//! | inference, all tests of a rule base | [`Limits::inference`] of time; [`Limits::until`] for several together |
//! | never | `eval`, `import`, `sleep`, `curry`, printing |

/// The examples of the README run.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;

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
pub use knowledge::consultation::{Consultation, Datum};
pub use knowledge::dominated::Dominated;
pub use knowledge::facts::FactError;
pub use reactions::{Activation, Firing, Reactions, Told};
pub use rejection::{Rejected, Rejection, WhyNot};
pub use rule::{Operator, PropertyName, Rule};
pub use rule_base::RuleBase;
pub use rule_test::{RuleTests, TestFailure, TestOutcome};
pub use schema::Schema;
pub use script::limits::Limits;
pub use script::source::{MAX_FILE_BYTES, SourceFile};
pub use value::{Type, Value};
