//! What is known of the properties that rules name.

use std::collections::BTreeMap;

use crate::plan::{Key, Kind, Kinds};
use crate::rule::PropertyName;
use crate::rule_base::RuleBase;
use crate::schema::Schema;
use crate::symbols::Lexicon;
use crate::value::Type;

/// The properties of a schema, and those that rules conclude.
pub(super) struct Declared<'s> {
    pub(super) schema: &'s Schema,
    pub(super) concluded: BTreeMap<PropertyName, Option<Type>>,
    pub(super) told: BTreeMap<PropertyName, Option<Type>>,
}

impl Declared<'_> {
    /// The types of what rules tell, as far as they can be seen.
    pub(super) fn tell_kinds(&mut self, base: &RuleBase, symbols: &Lexicon) {
        for rule in &base.rules {
            let Some(action) = rule.reaction() else { continue };
            for (name, kind, _) in crate::plan::reaction::told(rule, action, self, symbols) {
                let known = self.told.entry(name).or_default();
                *known = known.or(kind);
            }
        }
    }
}

impl Kinds for Declared<'_> {
    fn kind(&self, name: &PropertyName) -> Kind {
        match (self.schema.kind(&name.class, &name.property), self.concluded.get(name)) {
            (Some(kind), _) => Kind::Holds(Some(kind)),
            (None, Some(kind)) => Kind::Holds(*kind),
            (None, None) => self.told.get(name).map_or(Kind::Missing, |kind| Kind::Holds(*kind)),
        }
    }

    /// What an earlier rule gives, a later one has to give too.
    fn declared(&self, name: &PropertyName) -> Option<Type> {
        let earlier = || self.concluded.get(name).or_else(|| self.told.get(name)).copied().flatten();
        self.schema.kind(&name.class, &name.property).or_else(earlier)
    }

    fn key(&self, class: &str) -> Key {
        self.schema.key_of(class).map_or(Key::Unsaid, |key| Key::Properties(key.to_vec()))
    }

    fn properties(&self, class: &str) -> Vec<String> {
        let concluded = self.concluded.keys().chain(self.told.keys()).filter(|name| name.class == class);
        let concluded = concluded.map(|name| name.property.clone());
        self.schema.properties(class).map(str::to_owned).chain(concluded).collect()
    }
}
