//! Which classes, properties, functions and words there are, and what the manual says of each.

use std::collections::BTreeMap;
use std::sync::OnceLock;

use adit_engine::{Schema, Type};

use crate::site::shipped;

/// The classes that rules see, with the types of their properties where somebody says them.
#[derive(Clone, Debug, Default)]
pub struct Vocabulary {
    schema: Schema,
}

impl Vocabulary {
    pub fn new(schema: Schema) -> Self {
        Self { schema }
    }

    /// All classes: those that are given, and those that the manual describes.
    pub fn classes(&self) -> Vec<&str> {
        let mut found: Vec<&str> = self.schema.classes().collect();
        if found.is_empty() {
            found.extend(manual().classes.keys().map(String::as_str));
        }
        found
    }

    /// The properties of a class that are given, with their types.
    pub fn given<'v>(&'v self, class: &'v str) -> impl Iterator<Item = (&'v str, Option<Type>)> {
        self.schema.properties(class).map(move |property| (property, self.schema.kind(class, property)))
    }

    pub fn is_given(&self, class: &str, property: &str) -> bool {
        self.schema.kind(class, property).is_some()
    }

    pub fn kind(&self, class: &str, property: &str) -> Option<Type> {
        self.schema.kind(class, property)
    }
}

/// How a type is called.
pub fn called(kind: Type) -> &'static str {
    match kind {
        Type::Number => "a number",
        Type::Text => "a text",
        Type::Truth => "true or false",
    }
}

/// What the manual and the guide of the engine say.
#[derive(Default)]
pub struct Manual {
    /// By class, then property; of the class itself by the empty one.
    classes: BTreeMap<String, BTreeMap<String, String>>,
    /// Words of the language, with what each is for and an example.
    words: BTreeMap<String, (String, String)>,
    /// What each function gives.
    functions: BTreeMap<String, String>,
}

/// The manual's page of what rules see, and the engine's of the language and its functions, as tables.
pub fn manual() -> &'static Manual {
    static MANUAL: OnceLock<Manual> = OnceLock::new();
    MANUAL.get_or_init(|| {
        let mut manual = Manual::default();
        manual.read_classes(&shipped::page("what-rules-see.md"));
        manual.read_words(adit_engine::GUIDE);
        manual.read_functions(adit_engine::FUNCTIONS);
        manual
    })
}

impl Manual {
    pub fn of_class(&self, class: &str) -> Option<&str> {
        self.of(class, "")
    }

    pub fn of(&self, class: &str, property: &str) -> Option<&str> {
        self.classes.get(class)?.get(property).map(String::as_str)
    }

    /// What a word of the language is for, with an example.
    pub fn of_word(&self, word: &str) -> Option<(&str, &str)> {
        self.words.get(word).map(|(what, example)| (what.as_str(), example.as_str()))
    }

    pub fn words(&self) -> impl Iterator<Item = &str> {
        self.words.keys().map(String::as_str)
    }

    /// What a function gives.
    pub fn of_function(&self, name: &str) -> Option<&str> {
        self.functions.get(name).map(String::as_str)
    }

    pub fn functions(&self) -> impl Iterator<Item = (&str, &str)> {
        self.functions.iter().map(|(name, what)| (name.as_str(), what.as_str()))
    }

    fn read_functions(&mut self, page: &str) {
        for line in page.lines() {
            let cells = cells(line);
            let [names, what, ..] = &cells[..] else { continue };
            let is_word = |name: &String| name.starts_with(|letter: char| letter.is_alphabetic());
            self.functions.extend(coded(names).into_iter().filter(is_word).map(|name| (name, what.clone())));
        }
    }

    /// Tables whose head names classes, and whose rows name properties in their first cell.
    fn read_classes(&mut self, page: &str) {
        let mut head: Vec<String> = Vec::new();
        for line in page.lines() {
            let cells = cells(line);
            let [names, what, ..] = &cells[..] else {
                head.clear();
                continue;
            };
            let named = coded(names);
            if head.is_empty() {
                head = named;
                for class in &head {
                    self.classes.entry(class.clone()).or_default().insert(String::new(), what.clone());
                }
                continue;
            }
            for (class, property) in head.iter().flat_map(|class| named.iter().map(move |name| (class, name)))
            {
                self.classes.entry(class.clone()).or_default().insert(property.clone(), what.clone());
            }
        }
    }

    /// Tables of forms and of clauses: the first word of the first cell, what it is for, how it looks.
    fn read_words(&mut self, page: &str) {
        let part = page.split("## What rules look like").nth(1).unwrap_or_default();
        let part = part.split("\n## ").next().unwrap_or_default();
        for line in part.lines() {
            let cells = cells(line);
            let [form, second, third, ..] = &cells[..] else { continue };
            let forms = coded(form);
            let is_clause = forms.iter().any(|form| form.contains(" in CLASS"));
            for form in &forms {
                let Some(word) = form.split([' ', '.']).next().filter(|word| !word.is_empty()) else {
                    continue;
                };
                let (what, example) = if is_clause {
                    (format!("met {second}; gives {third}"), forms.first().cloned().unwrap_or_default())
                } else {
                    (second.clone(), coded(third).first().cloned().unwrap_or_default())
                };
                self.words.entry(word.to_owned()).or_insert((what, example));
            }
        }
    }
}

/// The cells of a row of a table; of the line below a table's head, and of any other line, none.
fn cells(line: &str) -> Vec<String> {
    let Some(inside) = line.trim().strip_prefix('|').and_then(|line| line.strip_suffix('|')) else {
        return Vec::new();
    };
    if inside.chars().all(|letter| "-|: ".contains(letter)) {
        // it goes on with the table that began above it
        return vec![String::new(), String::new()];
    }
    inside.split(" | ").map(|cell| cell.trim().to_owned()).collect()
}

/// What stands in backticks.
fn coded(cell: &str) -> Vec<String> {
    cell.split('`').skip(1).step_by(2).map(str::to_owned).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_manual_says_what_classes_properties_and_words_are() {
        let manual = manual();
        assert!(manual.of("ROOMS", "berth").is_some_and(|what| what.contains("outline")), "ROOMS.berth");
        assert!(manual.of("DOORWAYS", "width").is_some(), "DOORWAYS.width");
        assert!(manual.of_class("SPACES").is_some(), "SPACES");
        for word in
            ["rule", "revise", "on", "each", "least", "most", "none", "count", "hypothesis", "priority"]
        {
            let said = manual.of_word(word);
            assert!(said.is_some_and(|(what, example)| !what.is_empty() && !example.is_empty()), "{word}");
        }
        assert_eq!(
            manual.of_word("table"),
            Some(("a decision table", "")),
            "its example is longer than a line"
        );
        assert_eq!(
            manual.of_function("known"),
            Some("whether a property has a value; the value that is none")
        );
    }
}
