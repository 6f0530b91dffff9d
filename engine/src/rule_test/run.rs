//! One test on a knowledge base of its own.

use super::outcome::{TestFailure, TestOutcome};
use super::read::{Fact, Object, Objects, Step, Test, TestFile};
use super::toml_text::Located;
use super::vocabulary::Vocabulary;
use crate::conclusions::Conclusions;
use crate::diagnostic::{Code, Diagnostic, Severity};
use crate::knowledge::KnowledgeBase;
use crate::rule::PropertyName;
use crate::rule_base::RuleBase;
use crate::script::limits::Limits;
use crate::value::Value;

struct Run<'t> {
    file: &'t TestFile,
    test: &'t Test,
    rules: &'t RuleBase,
    knowledge: KnowledgeBase,
    step: usize,
    failures: Vec<TestFailure>,
}

pub(super) fn run(
    file: &TestFile,
    test: &Test,
    rules: &RuleBase,
    (vocabulary, limits): (&Vocabulary<'_>, Limits),
) -> TestOutcome {
    let knowledge = KnowledgeBase::with_limits(limits);
    let mut run = Run { file, test, rules, knowledge, step: 0, failures: vec![] };
    for class in vocabulary.classes(file, &test.given) {
        if let Err(error) = run.knowledge.assert(class) {
            run.fail(&test.name, &format!("what is given cannot be: {error}"));
        }
    }
    for (number, step) in test.steps.iter().enumerate() {
        run.step = number;
        run.edit(step);
        let reactions = run.knowledge.react(rules);
        let conclusions = run.knowledge.conclude(rules);
        let problems = reactions.diagnostics.iter().chain(&conclusions.diagnostics);
        for problem in problems.filter(|problem| problem.severity == Severity::Error) {
            let what = format!("{} ({}, line {})", problem.message, problem.file, problem.line);
            run.fail(&test.name, &what);
        }
        for fact in &step.expected {
            run.compare(fact, &conclusions);
        }
    }
    let place = file.source.place_of(&test.name.span);
    TestOutcome {
        test: test.name.value.clone(),
        file: file.source.name().to_owned(),
        line: place.line,
        passed: run.failures.is_empty(),
        failures: run.failures,
    }
}

impl Run<'_> {
    fn edit(&mut self, step: &Step) {
        for Fact { class, key, property, value } in &step.tell {
            let told = self.knowledge.tell(&class.value, &key.value, &property.value, value.value.clone());
            if let Err(error) = told {
                self.fail(value, &error.to_string());
            }
        }
        for Objects { class, objects } in &step.add {
            for Object { cells, place } in objects {
                let known = cells
                    .iter()
                    .filter_map(|(property, cell)| Some((property.value.as_str(), cell.value.clone()?)));
                let object: Vec<(&str, Value)> = known.collect();
                if let Err(error) = self.knowledge.add(&class.value, &object) {
                    self.fail(place, &error.to_string());
                }
            }
        }
        for (class, key) in &step.remove {
            if let Err(error) = self.knowledge.remove(&class.value, &key.value) {
                self.fail(key, &error.to_string());
            }
        }
    }

    fn compare(&mut self, fact: &Fact, conclusions: &Conclusions) {
        let Fact { class, key, property, value: Located { value: expected, span } } = fact;
        let found = self.knowledge.value(&class.value, &key.value, &property.value);
        if is_as_expected(expected.as_ref(), found.as_ref(), self.test.tolerance) {
            return;
        }
        // "1.5" and 1.5 are not the same
        let is_told_apart = found
            .as_ref()
            .zip(expected.as_ref())
            .is_some_and(|(found, expected)| found.to_string() == expected.to_string());
        let word = |value: &Option<Value>| match value {
            Some(Value::Text(text)) if is_told_apart => format!("\"{text}\""),
            value => value.as_ref().map_or("unknown".to_owned(), Value::to_string),
        };
        let message = format!(
            "test \"{}\": {} {} {} is {} and should be {}{}",
            self.test.name.value,
            class.value,
            key.value,
            property.value,
            word(&found),
            word(expected),
            self.after()
        );
        let why = self.why(fact, found.is_some(), conclusions);
        let place = self.file.source.place_of(span);
        let diagnostic = Diagnostic::error(Code::TestFailed, &place, message)
            .label(format!("is {}", word(&found)))
            .help(why.clone());
        self.failures.push(TestFailure {
            step: self.step,
            class: class.value.clone(),
            key: key.value.clone(),
            property: property.value.clone(),
            expected: expected.clone(),
            found,
            why,
            diagnostic,
        });
    }

    fn why(&self, fact: &Fact, known: bool, conclusions: &Conclusions) -> String {
        let (class, key, property) = (&fact.class.value, &fact.key.value, &fact.property.value);
        if self.knowledge.row(class, key).is_none() {
            return format!("there is no object {key} of class {class}");
        }
        if known && let Some(why) = self.knowledge.why(self.rules, class, key, property) {
            return why.to_string();
        }
        let name = PropertyName::new(class, property);
        let conflict =
            conclusions.conflicts.iter().find(|conflict| conflict.property == name && conflict.key == *key);
        if let Some(conflict) = conflict {
            let said: Vec<String> =
                conflict.values.iter().map(|(rule, value)| format!("\"{rule}\" says {value}")).collect();
            return format!("rules disagree: {}", said.join(", "));
        }
        let sets = |rule: &str| {
            self.rules
                .rules()
                .iter()
                .any(|known| known.name() == rule && known.sets().any(|set| *set == name))
        };
        let waiting = conclusions.waiting.iter().find(|waiting| sets(&waiting.rule));
        if let Some(waiting) = waiting {
            return format!("rule \"{}\" waits for {}", waiting.rule, waiting.needs.join(", "));
        }
        let gap = conclusions.gaps.iter().find(|gap| gap.property == name);
        let reasons: Vec<String> =
            gap.iter().flat_map(|gap| &gap.reasons).map(|(reason, _)| reason.to_string()).collect();
        if reasons.is_empty() { "no rule sets it".to_owned() } else { reasons.join("; or ") }
    }

    /// Something other than a value that is wrong.
    fn fail<T>(&mut self, at: &Located<T>, what: &str) {
        let message = format!("test \"{}\": {what}{}", self.test.name.value, self.after());
        let place = self.file.source.place_of(&at.span);
        self.failures.push(TestFailure {
            step: self.step,
            class: String::new(),
            key: String::new(),
            property: String::new(),
            expected: None,
            found: None,
            why: String::new(),
            diagnostic: Diagnostic::error(Code::TestFailed, &place, message),
        });
    }

    fn after(&self) -> String {
        if self.step == 0 { String::new() } else { format!(", after edit {}", self.step) }
    }
}

#[allow(clippy::float_cmp)] // infinite numbers have no distance
fn is_as_expected(expected: Option<&Value>, found: Option<&Value>, tolerance: f64) -> bool {
    match (expected, found) {
        (Some(Value::Number(expected)), Some(Value::Number(found))) => {
            expected == found || (expected - found).abs() <= tolerance
        }
        _ => expected == found,
    }
}
