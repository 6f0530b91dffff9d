//! Rule files compiled into one rule base.

use std::collections::{BTreeMap, BTreeSet};
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::atomic::{AtomicU64, Ordering};
use std::thread;

use rhai::Position;

use crate::declared::Declarations;
use crate::declared::build::{against_rules, declarations};
use crate::diagnostic::{Code, Diagnostic, Diagnostics, Severity};
use crate::lint::lint;
use crate::order::{Step, order};
use crate::rule::{Action, Operator, PropertyName, Rule};
use crate::script::desugar::desugar;
use crate::script::interpreter::{function_names, reader};
use crate::script::limits::STACK_BYTES;
use crate::script::read::{Draft, read, version};
use crate::script::resolve::resolve;
use crate::script::source::SourceFile;

/// The rules of a site: read, ordered, and free of errors that can be seen without objects.
#[derive(Clone, Debug, Default)]
pub struct RuleBase {
    pub(crate) id: u64,
    pub(crate) rules: Vec<Rule>,
    pub(crate) order: Vec<Step>,
    pub(crate) declared: Declarations,
    pub(crate) warnings: Vec<Diagnostic>,
}

/// How many rule bases were compiled: the next one's number.
static COMPILED: AtomicU64 = AtomicU64::new(1);

impl RuleBase {
    /// Reads rule files. All files are reported; after an error of syntax a file is read on from its next item, for
    /// more such errors only.
    pub fn compile(files: &[SourceFile]) -> Result<Self, Diagnostics> {
        let outcome = on_deep_stack(|| catch_unwind(AssertUnwindSafe(|| read_all(files))).ok());
        let Some((mut rules, declared, mut problems)) = outcome else {
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
        Ok(Self { id: COMPILED.fetch_add(1, Ordering::Relaxed), rules, order, declared, warnings })
    }

    pub fn rules(&self) -> &[Rule] {
        &self.rules
    }

    pub const fn declared(&self) -> &Declarations {
        &self.declared
    }

    /// The properties that are hypotheses: true if one rule proves them, false if all refute them.
    pub fn hypotheses(&self) -> BTreeSet<PropertyName> {
        self.rules.iter().filter_map(Rule::hypothesis).collect()
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

/// Reads all files, then looks up what the rules of each name: a declaration counts in all of them.
fn read_all(files: &[SourceFile]) -> (Vec<Rule>, Declarations, Vec<Diagnostic>) {
    let known = function_names();
    let mut problems = vec![];
    let (mut drafts, mut classes, mut properties) = (vec![], vec![], vec![]);
    for file in files {
        let read = read(file, reader());
        drafts.push(read.drafts);
        classes.extend(read.classes);
        properties.extend(read.properties);
        problems.push(read.problems);
    }
    let mut wrong = vec![];
    let declared = declarations(classes, properties, known, &mut wrong);
    let mut rules = vec![];
    for (drafts, problems) in drafts.into_iter().zip(&mut problems) {
        for Draft { mut rule, text, outside } in drafts {
            let used = desugar(&mut rule, &declared, problems);
            let shared = resolve(&mut rule, known, problems);
            let outside = shared.then_some(&*outside);
            let parts = std::iter::once(text.as_str()).chain(outside).chain(used.iter().map(String::as_str));
            rule.version = version(parts);
            rules.push(rule);
        }
    }
    (rules, declared, problems.into_iter().flatten().chain(wrong).collect())
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
