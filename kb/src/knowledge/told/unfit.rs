//! Facts whose values their properties cannot hold.

use adit_engine::Schema;

use super::kinds::fixed;
use super::{Fact, Told, Unfit};

impl Unfit {
    /// That it counts for nothing, and why.
    pub fn said(&self) -> String {
        let Fact { class, property, .. } = &self.fact;
        let (name, holds, value) = (self.fact.name(), self.holds.plural(), &self.fact.value);
        format!("{name} counts for nothing: {class}.{property} holds {holds}, and `{value}` is none")
    }
}

impl Told {
    /// Sets aside facts with values that their properties cannot hold, as far as `schema` says.
    pub fn set_unfit_aside(&mut self, schema: &Schema) {
        let holds = |fact: &Fact| {
            fixed(&fact.class, &fact.property).or_else(|| schema.kind(&fact.class, &fact.property))
        };
        let facts = std::mem::take(&mut self.facts);
        for fact in facts {
            match holds(&fact).filter(|kind| *kind != fact.kind()) {
                Some(holds) => self.unfit.push(Unfit { fact, holds }),
                None => self.facts.push(fact),
            }
        }
    }
}
