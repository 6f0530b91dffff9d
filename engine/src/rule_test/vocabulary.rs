//! The classes and properties that tests may speak of, and their types.

use std::collections::{BTreeMap, BTreeSet};

use super::read::{Fact, Object, Objects, Step, TestFile};
use super::toml_text::Located;
use crate::class::Class;
use crate::diagnostic::{Code, Diagnostic};
use crate::rule::PropertyName;
use crate::rule_base::RuleBase;
use crate::schema::Schema;
use crate::suggest::nearest;
use crate::value::{Type, Value};

/// What the host's schema, the rules and all tests together know.
pub(super) struct Vocabulary<'s> {
    schema: &'s Schema,
    /// Classes that rules name, with the properties that they read or set.
    of_rules: BTreeMap<&'s str, BTreeSet<&'s str>>,
    /// Types of properties, told in the schema or seen in a test.
    kinds: BTreeMap<String, BTreeMap<String, Type>>,
    problems: Vec<Diagnostic>,
}

impl<'s> Vocabulary<'s> {
    pub(super) fn new(
        files: &[TestFile],
        rules: &'s RuleBase,
        schema: &'s Schema,
    ) -> Result<Self, Vec<Diagnostic>> {
        let mut of_rules: BTreeMap<&str, BTreeSet<&str>> = BTreeMap::new();
        for rule in rules.rules() {
            for class in rule.classes() {
                of_rules.entry(class).or_default();
            }
            for PropertyName { class, property } in rule.reads().chain(rule.sets()) {
                of_rules.entry(class).or_default().insert(property);
            }
        }
        let kinds = schema.classes().map(|class| {
            let kind = |property: &str| Some((property.to_owned(), schema.kind(class, property)?));
            (class.to_owned(), schema.properties(class).filter_map(kind).collect())
        });
        let mut new = Self { schema, of_rules, kinds: kinds.collect(), problems: vec![] };
        for file in files {
            new.learn(file);
        }
        if new.problems.is_empty() { Ok(new) } else { Err(new.problems) }
    }

    /// The classes that a test gives, and the others that are known, empty.
    pub(super) fn classes(&self, file: &TestFile, given: &[Objects]) -> Vec<Class> {
        let none = vec![];
        let of = |class: &str| {
            let given = given.iter().find(|objects| objects.class.value == class);
            given.map_or(&none, |objects| &objects.objects)
        };
        self.kinds.keys().map(|class| self.class(file, class, of(class))).collect()
    }

    /// A class with every property that is known of it; of the key what there is (all of it where there are objects).
    fn class(&self, file: &TestFile, name: &str, objects: &[Object]) -> Class {
        let there = |part: &&str| self.kinds[name].contains_key(*part);
        let key: Vec<&str> = self.key(file, name).iter().map(String::as_str).filter(there).collect();
        let mut class = Class::new(name, &key);
        for (property, kind) in &self.kinds[name] {
            let cells = objects.iter().map(|object| cell(object, property));
            class = class.values(property, *kind, cells);
        }
        for (property, means) in self.schema.nulls(name) {
            if self.kinds[name].contains_key(property) {
                class = class.null_means(property, means.clone());
            }
        }
        class
    }

    fn key<'f>(&'f self, file: &'f TestFile, class: &str) -> &'f [String] {
        let own = file.keys.get(class).map(|key| key.value.as_slice());
        own.or_else(|| self.schema.key_of(class)).unwrap_or_default()
    }

    /// Learns the types of what a file's tests give, and looks at every name.
    fn learn(&mut self, file: &TestFile) {
        for (class, key) in &file.keys {
            self.class_is_known(file, &Located { value: class.clone(), span: key.span.clone() });
        }
        for test in &file.tests {
            let added = test.steps.iter().flat_map(|step| &step.add);
            for objects in test.given.iter().chain(added) {
                self.learn_objects(file, objects);
            }
            for Step { tell, remove, expected, .. } in &test.steps {
                for fact in tell.iter().chain(expected) {
                    self.learn_fact(file, fact);
                }
                for (class, _) in remove {
                    self.class_is_known(file, class);
                }
            }
        }
    }

    fn learn_fact(&mut self, file: &TestFile, Fact { class, property, .. }: &Fact) {
        if self.class_is_known(file, class) {
            self.property_is_known(file, &class.value, property);
        }
    }

    fn learn_objects(&mut self, file: &TestFile, Objects { class, objects }: &Objects) {
        if !self.class_is_known(file, class) {
            return;
        }
        self.kinds.entry(class.value.clone()).or_default();
        let key: Vec<String> = self.key(file, &class.value).to_vec();
        for object in objects {
            for (property, value) in &object.cells {
                if self.property_is_known(file, &class.value, property) {
                    self.learn_value(file, &class.value, &property.value, value);
                }
            }
            let known = |part: &&String| {
                object.cells.iter().any(|(name, cell)| name.value == **part && cell.value.is_some())
            };
            if let Some(missing) = key.iter().find(|part| !known(part)) {
                let message = format!("an object of {} needs its key `{missing}`", class.value);
                self.problems.push(at(file, Code::TestSyntax, &object.place, message));
            }
        }
    }

    fn learn_value(&mut self, file: &TestFile, class: &str, property: &str, value: &Located<Option<Value>>) {
        let Some(kind) = value.value.as_ref().map(Value::kind) else { return };
        let properties = self.kinds.entry(class.to_owned()).or_default();
        let holds = *properties.entry(property.to_owned()).or_insert(kind);
        if holds != kind {
            let message = format!("{class}.{property} holds {}, and this is none", holds.plural());
            self.problems.push(at(file, Code::Type, value, message));
        }
    }

    fn class_is_known(&mut self, file: &TestFile, class: &Located<String>) -> bool {
        let name = class.value.as_str();
        let known = self.schema.has(name) || self.of_rules.contains_key(name);
        if !known {
            let names = self.schema.classes().chain(self.of_rules.keys().copied());
            let meant = nearest(name, names);
            let problem = at(file, Code::UnknownClass, class, format!("no rule speaks of a class {name}"));
            self.problems.push(problem.did_you_mean(meant));
        }
        known
    }

    /// A class that the schema does not know may have properties that no rule reads, but none that looks misspelt.
    fn property_is_known(&mut self, file: &TestFile, class: &str, property: &Located<String>) -> bool {
        let name = property.value.as_str();
        let of_rules = self.of_rules.get(class);
        let known = self.schema.kind(class, name).is_some()
            || of_rules.is_some_and(|names| names.contains(name))
            || self.key(file, class).iter().any(|part| part == name);
        if known {
            return true;
        }
        let names = of_rules.into_iter().flatten().copied();
        let meant = nearest(name, self.schema.properties(class).chain(names));
        if meant.is_none() && !self.schema.has(class) {
            return true;
        }
        let message = format!("class {class} has no property `{name}`, and no rule sets or reads one");
        let problem = at(file, Code::UnknownProperty, property, message).did_you_mean(meant);
        self.problems.push(problem);
        false
    }
}

fn at<T>(file: &TestFile, code: Code, what: &Located<T>, message: String) -> Diagnostic {
    Diagnostic::error(code, &file.source.place_of(&what.span), message)
}

fn cell(object: &Object, property: &str) -> Option<Value> {
    object.cells.iter().find(|(name, _)| name.value == property)?.1.value.clone()
}
