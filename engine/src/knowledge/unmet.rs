//! Cells that name an object of another class, as a rule base declares it, where there is no such object.

use std::collections::BTreeSet;
use std::fmt;
use std::sync::Arc;

use super::KnowledgeBase;
use crate::column::Column;
use crate::rule_base::RuleBase;
use crate::suggest::nearest;
use crate::symbols::Symbol;

/// A cell that names nothing, with what was probably meant.
#[derive(Clone, Debug, PartialEq, Eq, serde::Serialize)]
pub struct Unmet {
    pub class: String,
    /// The object's key.
    pub key: String,
    pub property: String,
    pub text: String,
    /// The class in which it is looked for.
    pub of: String,
    pub meant: Option<String>,
}

/// One sentence, as in: `ORDERS 2 has customer "Brunno", and CUSTOMERS has no such row: did you mean "Bruno"?`.
impl fmt::Display for Unmet {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { class, key, property, text, of, meant } = self;
        write!(out, "{class} {key} has {property} \"{text}\", and {of} has no such row")?;
        meant.as_ref().map_or(Ok(()), |meant| write!(out, ": did you mean \"{meant}\"?"))
    }
}

impl KnowledgeBase {
    /// The cells that are told and name an object of another class (`property ORDERS.customer names CUSTOMERS`) that is not
    /// there. Classes with a condition are not looked at: who is of them follows from rules.
    pub fn unmet(&self, rules: &RuleBase) -> Vec<Unmet> {
        let symbols = self.symbols.read();
        let mut found = vec![];
        for (name, link) in &rules.declared.links {
            let (Some(from), Some(to)) = (self.held.get(&name.class), self.held.get(&link.class)) else {
                continue;
            };
            let (from, to) = (&from.table, &to.table);
            let key = match (&link.key, &*to.key) {
                (Some((property, _)), _) => to.names.iter().position(|name| name == property),
                (None, &[key]) => Some(key),
                (None, _) => None,
            };
            let Some(Column::Texts(known)) = key.and_then(|key| to.columns.get(key)).map(Arc::as_ref) else {
                continue;
            };
            let column = from.names.iter().position(|of| *of == name.property);
            let Some(Column::Texts(named)) =
                column.and_then(|column| from.columns.get(column)).map(Arc::as_ref)
            else {
                continue;
            };
            let known: BTreeSet<Symbol> = known.iter().copied().collect();
            let is_unmet = |symbol: &Symbol| *symbol != Symbol::UNKNOWN && !known.contains(symbol);
            for (row, &symbol) in named.iter().enumerate().filter(|(_, symbol)| is_unmet(symbol)) {
                let Some(text) = symbols.text(symbol).map(|text| text.to_string()) else { continue };
                let texts = known.iter().filter_map(|&symbol| symbols.text(symbol)).map(|text| &**text);
                let meant = nearest(&text, texts).map(str::to_owned);
                let (class, property) = (name.class.clone(), name.property.clone());
                let key = from.key_text(row, &symbols);
                found.push(Unmet { class, key, property, text, of: link.class.clone(), meant });
            }
        }
        found
    }
}
