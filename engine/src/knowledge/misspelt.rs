//! Texts that rules ask for and no object has, though one has nearly the same.

use std::collections::{BTreeMap, BTreeSet};
use std::fmt;

use super::KnowledgeBase;
use crate::column::Column;
use crate::rule::PropertyName;
use crate::rule_base::RuleBase;
use crate::suggest::nearest;
use crate::symbols::Symbol;
use crate::told::NamesTold;

/// A text that a rule asks for, as it stands there, with what was probably meant.
#[derive(Clone, Debug, PartialEq, Eq, serde::Serialize)]
pub struct Misspelt {
    pub rule: String,
    pub file: String,
    /// The line of the rule's name, from 1.
    pub line: usize,
    pub property: String,
    pub text: String,
    pub meant: String,
}

/// One sentence, as in: `rule "low" (low.rhai, line 1) asks for state "SQAT", which there is not: did you mean "SQUAT"?`.
impl fmt::Display for Misspelt {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { rule, file, line, property, text, meant } = self;
        write!(
            out,
            "rule \"{rule}\" ({file}, line {line}) asks for {property} \"{text}\", which there is not: did you mean \"{meant}\"?"
        )
    }
}

impl KnowledgeBase {
    /// The texts with which rules compare a property and that none so called holds, in whatever class (a room is of a state as a
    /// robot is), where one of those that are held is but a slip of the pen away. Properties that rules themselves give or tell
    /// are left out, since they may hold anything tomorrow.
    pub fn misspelt(&self, rules: &RuleBase) -> Vec<Misspelt> {
        let told = NamesTold::of(&rules.rules);
        let given: BTreeSet<&PropertyName> =
            rules.concluded().into_iter().chain(told.properties.keys()).collect();
        let mut held: BTreeMap<String, BTreeSet<Symbol>> = BTreeMap::new();
        let mut found = vec![];
        let symbols = self.symbols.read();
        for rule in &rules.rules {
            for (name, text) in rule.compared_texts() {
                if given.contains(&name) {
                    continue;
                }
                let property = name.property;
                let held =
                    held.entry(property.clone()).or_insert_with_key(|property| self.held_texts(property));
                if symbols.find(&text).is_some_and(|symbol| held.contains(&symbol)) {
                    continue;
                }
                let texts = held.iter().filter_map(|&symbol| symbols.text(symbol)).map(|text| &**text);
                if let Some(meant) = nearest(&text, texts) {
                    let (rule, file, line) = (rule.name.clone(), rule.file().to_owned(), rule.line());
                    found.push(Misspelt { rule, file, line, property, meant: meant.to_owned(), text });
                }
            }
        }
        found
    }

    /// What is told of properties of this name.
    fn held_texts(&self, property: &str) -> BTreeSet<Symbol> {
        let mut texts = BTreeSet::new();
        for table in self.held.values().map(|held| &held.table) {
            let columns = table.names.iter().zip(&table.columns).filter(|(name, _)| *name == property);
            for (_, column) in columns {
                if let Column::Texts(symbols) = &**column {
                    texts.extend(symbols.iter().filter(|&&symbol| symbol != Symbol::UNKNOWN));
                }
            }
        }
        texts
    }
}
