//! What concluded values rest on, as the database keeps it: the number of the rule, and of the facts that it chose.

use std::collections::BTreeMap;
use std::sync::Arc;

use adit_db::conclusion::Witness;
use adit_engine::{Grounds, KnowledgeBase as Inference, RuleBase};

/// The number of the rule behind a value, and that of the witness, where the rule chose something.
pub type Reason = (Option<i64>, Option<i64>);

/// Numbers for facts that rules chose. Facts keep the number that they have; new ones come after all that there were.
#[derive(Clone, Debug, Default)]
pub struct Numbering {
    /// Shared, since there may be a witness a door and most edits add none.
    known: Arc<BTreeMap<String, i64>>,
    new: BTreeMap<String, i64>,
    next: i64,
}

impl Numbering {
    /// Numbers that are taken.
    pub fn new(witnesses: &[Witness]) -> Self {
        let known = witnesses.iter().map(|witness| (witness.facts.clone(), witness.witness)).collect();
        let next = witnesses.iter().map(|witness| witness.witness).max().unwrap_or(0) + 1;
        Self { known: Arc::new(known), new: BTreeMap::new(), next }
    }

    fn number(&mut self, facts: String) -> i64 {
        if let Some(number) = self.known.get(&facts) {
            return *number;
        }
        let next = &mut self.next;
        *self.new.entry(facts).or_insert_with(|| {
            *next += 1;
            *next - 1
        })
    }

    /// The witnesses whose number is wanted, by number.
    pub fn witnesses(&self, is_wanted: impl Fn(i64) -> bool) -> Vec<Witness> {
        let wanted = self.known.iter().chain(&self.new).filter(|(_, number)| is_wanted(**number));
        let mut witnesses: Vec<Witness> =
            wanted.map(|(facts, number)| Witness { witness: *number, facts: facts.clone() }).collect();
        witnesses.sort_by_key(|witness| witness.witness);
        witnesses
    }

    /// Whether facts were numbered since it was made.
    pub fn has_new(&self) -> bool {
        !self.new.is_empty()
    }
}

/// Finds reasons and numbers them.
pub struct Reasons<'a> {
    knowledge: &'a Inference,
    rules: &'a RuleBase,
    numbering: &'a mut Numbering,
}

impl<'a> Reasons<'a> {
    /// Of what these rules concluded.
    pub fn new(knowledge: &'a Inference, rules: &'a RuleBase, numbering: &'a mut Numbering) -> Self {
        Self { knowledge, rules, numbering }
    }

    /// The reasons for a property of all objects; none where no rule concludes it.
    pub fn of(&mut self, class: &str, property: &str) -> Vec<Reason> {
        let rows: Vec<u32> = (0..self.knowledge.len(class).unwrap_or(0) as u32).collect();
        self.of_rows(class, property, &rows)
    }

    /// The reasons for a property of the objects in these rows.
    pub fn of_rows(&mut self, class: &str, property: &str, rows: &[u32]) -> Vec<Reason> {
        let revisions = self.revisions(class, property);
        let mut seen: BTreeMap<Grounds, Option<i64>> = BTreeMap::new();
        let found = self.knowledge.grounds(class, property, rows);
        let mut reasons = Vec::with_capacity(rows.len());
        for (row, grounds) in rows.iter().zip(found) {
            let Some(grounds) = grounds else {
                // A value that was told, and that rules revised: it rests on the last of them.
                reasons.push(revisions.get(row).map_or((None, None), |by| self.revision(by)));
                continue;
            };
            let rule = Some(grounds.rule as i64 + 1);
            let revised_by = revisions.get(row);
            let witness = match seen.get(&grounds) {
                Some(witness) if revised_by.is_none() => *witness,
                _ => {
                    let facts = self.facts(&grounds, revised_by);
                    let witness = facts.map(|facts| self.numbering.number(facts));
                    if revised_by.is_none() {
                        seen.insert(grounds, witness);
                    }
                    witness
                }
            };
            reasons.push((rule, witness));
        }
        reasons
    }

    fn revision(&mut self, revised_by: &[&str]) -> Reason {
        let last = self.rules.rules().iter().position(|rule| Some(&rule.name()) == revised_by.last());
        let facts = serde_json::json!({ "revised by": revised_by }).to_string();
        (last.map(|index| index as i64 + 1), Some(self.numbering.number(facts)))
    }

    /// The rules that revise a property, by the row that they revise.
    fn revisions(&self, class: &str, property: &str) -> BTreeMap<u32, Vec<&'a str>> {
        let mut revisions: BTreeMap<u32, Vec<&str>> = BTreeMap::new();
        for (rule, rows) in self.knowledge.revised(self.rules, class, property) {
            for row in rows {
                let by = revisions.entry(row).or_default();
                if by.last() != Some(&rule.name()) {
                    by.push(rule.name());
                }
            }
        }
        revisions
    }

    /// What a rule chose for an object, and which rules revised the value after it. The object itself is the first
    /// witness: the row says that already.
    fn facts(&self, grounds: &Grounds, revised_by: Option<&Vec<&str>>) -> Option<String> {
        let variables = self.rules.rules().get(grounds.rule)?.variables().skip(1);
        let mut chosen: serde_json::Map<String, serde_json::Value> = variables
            .zip(&grounds.witnesses)
            .filter_map(|((variable, class), row)| {
                let key = self.knowledge.key(class, (*row)? as usize)?;
                Some((variable.to_owned(), format!("{class} {key}").into()))
            })
            .collect();
        if let Some(rules) = revised_by {
            chosen.insert("revised by".to_owned(), serde_json::json!(rules));
        }
        (!chosen.is_empty()).then(|| serde_json::Value::Object(chosen).to_string())
    }
}
