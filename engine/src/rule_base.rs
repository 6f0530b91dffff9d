//! Rule files compiled into one rule base.

use std::collections::{BTreeMap, BTreeSet};
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::atomic::{AtomicU64, Ordering};
use std::thread;

use rhai::Position;

use crate::declared::Declarations;
use crate::declared::build::{against_rules, declarations};
use crate::diagnostic::{Code, Diagnostic, Diagnostics, Severity};
use crate::lint::{lint, outvoted};
use crate::order::{Step, order};
use crate::rule::{Action, Operator, PropertyName, Rule};
use crate::script::desugar::desugar;
use crate::script::interpreter::{function_names, reader};
use crate::script::limits::STACK_BYTES;
use crate::script::over;
use crate::script::read::{Draft, Read, read, version};
use crate::script::resolve::resolve;
use crate::script::source::SourceFile;
use crate::told::NamesTold;

/// The rules of a site: read, ordered, and free of errors that can be seen without objects.
#[derive(Clone, Debug, Default)]
pub struct RuleBase {
    pub(crate) id: u64,
    pub(crate) rules: Vec<Rule>,
    pub(crate) order: Vec<Step>,
    pub(crate) declared: Declarations,
    pub(crate) warnings: Vec<Diagnostic>,
    pub(crate) replaced: Vec<Replaced>,
}

/// A rule of a base beneath that does not count, since one above says otherwise.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Replaced {
    /// Its name.
    pub rule: String,
    pub beneath: Standing,
    /// The rule of the same name that counts instead.
    pub by: Instead,
}

/// What stands in place of a rule beneath.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Instead {
    Rule(Standing),
    /// Nothing: a base above goes without it, and says so here.
    Without {
        file: String,
        line: usize,
    },
}

/// Where a rule stands, and which of its versions.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Standing {
    pub file: String,
    pub line: usize,
    pub version: String,
}

impl Standing {
    fn of(rule: &Rule) -> Self {
        Self { file: rule.file().to_owned(), line: rule.line, version: rule.version.clone() }
    }
}

/// How many rule bases were compiled: the next one's number.
static COMPILED: AtomicU64 = AtomicU64::new(1);

impl RuleBase {
    /// Reads rule files. All files are reported; after an error of syntax a file is read on from its next item, for
    /// more such errors only.
    pub fn compile(files: &[SourceFile]) -> Result<Self, Diagnostics> {
        Self::compile_over(&[files])
    }

    /// As [`compile`](Self::compile), of rule bases that lie over each other, the lowest first. A rule or class of one
    /// replaces those of its name beneath, and what is declared of a property replaces what is declared of it beneath;
    /// `without "a rule"` takes one away.
    pub fn compile_over(bases: &[&[SourceFile]]) -> Result<Self, Diagnostics> {
        let files = bases.concat();
        let outcome = on_deep_stack(|| catch_unwind(AssertUnwindSafe(|| read_all(bases))).ok());
        let Some(All { mut rules, declared, mut problems, replaced }) = outcome else {
            let place = files.first().map(|file| file.place(Position::START));
            let message = "reading the rule files failed inside the engine";
            return Err(Diagnostics(
                place.map(|place| Diagnostic::error(Code::Panic, &place, message)).into_iter().collect(),
            ));
        };
        problems.extend(duplicates(&rules));
        problems.extend(operators(&rules));
        problems.extend(hypotheses(&rules));
        problems.extend(against_rules(&declared, &rules));
        problems.extend(lint(&rules));
        let (mut problems, warnings): (Vec<_>, Vec<_>) =
            problems.into_iter().partition(|found| found.severity == Severity::Error);
        if !problems.is_empty() {
            // As the author reads; stable, so that what is said of one place keeps its order.
            let number = |file: &str| files.iter().position(|source| source.name() == file);
            problems.sort_by_key(|problem| (number(&problem.file), problem.span.0));
            return Err(Diagnostics(problems));
        }
        rules.extend(defaults(&declared));
        let order = order(&rules, &declared).map_err(Diagnostics)?;
        let id = COMPILED.fetch_add(1, Ordering::Relaxed);
        Ok(Self { id, rules, order, declared, warnings, replaced })
    }

    /// The classes of which rules that react tell new objects, in order.
    pub fn tells(&self) -> impl Iterator<Item = &str> {
        NamesTold::of(&self.rules).classes.into_keys()
    }

    pub fn rules(&self) -> &[Rule] {
        &self.rules
    }

    /// The rules of bases beneath that do not count, in their order.
    pub fn replaced(&self) -> &[Replaced] {
        &self.replaced
    }

    pub const fn declared(&self) -> &Declarations {
        &self.declared
    }

    /// The properties that are hypotheses: true if one rule proves them, false if all refute them.
    pub fn hypotheses(&self) -> BTreeSet<PropertyName> {
        self.rules.iter().filter_map(Rule::hypothesis).collect()
    }

    /// What may be meant otherwise than it stands: rows of tables that never count, inputs for which there is none.
    pub fn warnings(&self) -> &[Diagnostic] {
        &self.warnings
    }

    /// The rules that give a property which every object is told.
    pub fn outvoted(&self, is_told: impl Fn(&PropertyName) -> bool) -> Vec<Diagnostic> {
        outvoted::lint(&self.rules, &self.declared, is_told)
    }

    pub fn concluded(&self) -> BTreeSet<&PropertyName> {
        self.rules.iter().flat_map(|rule| rule.sets.keys()).collect()
    }

    /// Whether a rule or a default gives a property its values; a revision only changes what there is.
    pub fn gives(&self, class: &str, property: &str) -> bool {
        let name = PropertyName::new(class, property);
        self.rules.iter().any(|rule| rule.level().is_none() && rule.sets.contains_key(&name))
    }
}

/// A declared default is heard after every rule, that of the most special class first.
fn defaults(declared: &Declarations) -> Vec<Rule> {
    let mut rules = vec![];
    for (name, declarations) in &declared.properties {
        for (rank, declaration) in (0..).zip(declarations.iter().rev()) {
            let Action::Default { value: Some(_), position, .. } = declaration.rule.action else { continue };
            let mut rule = declaration.rule.clone();
            rule.priority = i64::MIN + rank;
            rule.sets.insert(name.clone(), position);
            let sources = declaration.sources.iter().map(|source| format!("{source:?}"));
            let signature: Vec<String> = sources.chain([format!("{:?}", rule.action)]).collect();
            rule.version = version(signature.iter().map(String::as_str));
            rules.push(rule);
        }
    }
    rules
}

/// Runs on a thread with a stack for the deepest rule that is allowed.
pub(crate) fn on_deep_stack<T: Send>(work: impl FnOnce() -> T + Send) -> T {
    thread::scope(|scope| {
        let thread = thread::Builder::new().name("rules".into()).stack_size(STACK_BYTES);
        let running = thread.spawn_scoped(scope, work).expect("the system has room for one thread more");
        running.join().unwrap_or_else(|panic| std::panic::resume_unwind(panic))
    })
}

struct All {
    rules: Vec<Rule>,
    declared: Declarations,
    problems: Vec<Diagnostic>,
    replaced: Vec<Replaced>,
}

/// Reads all files, then looks up what the rules of each name: a declaration counts in all of them.
fn read_all(bases: &[&[SourceFile]]) -> All {
    let known = function_names();
    let read_base = |files: &&[SourceFile]| files.iter().map(|file| read(file, reader())).collect();
    let mut bases: Vec<Vec<Read>> = bases.iter().map(read_base).collect();
    let mut wrong = vec![];
    let covered = over::lay(&mut bases, &mut wrong);
    let (mut problems, mut classes, mut properties) = (vec![], vec![], vec![]);
    for read in bases.iter_mut().flatten() {
        problems.append(&mut read.problems);
        classes.append(&mut read.classes);
        properties.append(&mut read.properties);
    }
    let declared = declarations(classes, properties, known, &mut wrong);
    let finished = |Draft { mut rule, text, outside }: Draft, problems: &mut Vec<Diagnostic>| {
        let used = desugar(&mut rule, &declared, problems);
        let shared = resolve(&mut rule, known, problems);
        let outside = shared.then_some(&*outside);
        let parts = std::iter::once(text.as_str()).chain(outside).chain(used.iter().map(String::as_str));
        rule.version = version(parts);
        rule.text = text.as_str().into();
        rule
    };
    let drafts = bases.into_iter().flatten().flat_map(|read| read.drafts);
    let rules: Vec<Rule> = drafts.map(|draft| finished(draft, &mut problems)).collect();
    let replaced = covered.into_iter().map(|covered| {
        // what is wrong with a rule that does not count is nobody's trouble
        let beneath = finished(covered.draft, &mut vec![]);
        let by = if let Some((file, line)) = covered.without {
            Instead::Without { file, line }
        } else {
            let above = rules.iter().find(|rule| rule.name() == beneath.name());
            Instead::Rule(Standing::of(above.unwrap_or(&beneath)))
        };
        Replaced { rule: beneath.name.clone(), beneath: Standing::of(&beneath), by }
    });
    let replaced = replaced.collect();
    problems.extend(wrong);
    All { rules, declared, problems, replaced }
}

/// The rules of a file as they stand there, as far as it can be read.
pub(crate) fn read_one(file: &SourceFile) -> Vec<Rule> {
    read(file, reader()).drafts.into_iter().map(|draft| draft.rule).collect()
}

fn duplicates(rules: &[Rule]) -> Vec<Diagnostic> {
    let mut seen: BTreeMap<&str, &Rule> = BTreeMap::new();
    let mut problems = vec![];
    for rule in rules {
        if let Some(first) = seen.get(rule.name()) {
            problems.push(
                rule.file
                    .error(
                        Code::DuplicateName,
                        rule.position,
                        format!("two rules are called \"{}\"", rule.name),
                    )
                    .label("the second")
                    .help(format!("the first is in {}, line {}", first.file(), first.line)),
            );
        } else {
            seen.insert(rule.name(), rule);
        }
    }
    problems
}

/// A hypothesis is one everywhere: its values come together by "or".
fn hypotheses(rules: &[Rule]) -> Vec<Diagnostic> {
    let provers = rules.iter().rev().filter_map(|rule| Some((rule.hypothesis()?, rule)));
    let proved: BTreeMap<PropertyName, &Rule> = provers.collect();
    let mut problems = vec![];
    for rule in rules {
        let own = rule.hypothesis();
        for (name, position) in rule.sets.iter().filter(|(name, _)| own.as_ref() != Some(name)) {
            let Some(prover) = proved.get(name) else { continue };
            let message = format!("{name} is a hypothesis of rule \"{}\", and is set here", prover.name);
            problems.push(
                rule.file
                    .error(Code::Hypothesis, *position, message)
                    .help("a property is a hypothesis of all rules that conclude it, or of none"),
            );
        }
    }
    problems
}

/// One level of revision takes one operator, or the order of the rules would matter.
fn operators(rules: &[Rule]) -> Vec<Diagnostic> {
    let mut seen: BTreeMap<(&PropertyName, i64), (Operator, &Rule)> = BTreeMap::new();
    let mut problems = vec![];
    for rule in rules {
        let Action::Revise { operator, level, position, .. } = &rule.action else { continue };
        let Some(target) = rule.sets.keys().next() else { continue };
        let (first, other) = *seen.entry((target, *level)).or_insert((*operator, rule));
        if !first.commutes_with(*operator) {
            let message = format!(
                "level {level} of {target} is revised by `{}` here and by `{}` in \"{}\"",
                operator.sign(),
                first.sign(),
                other.name
            );
            problems.push(
                rule.file
                    .error(Code::Operator, *position, message)
                    .help("give one of them another level: each level starts from what the level below gave"),
            );
        }
    }
    problems
}
