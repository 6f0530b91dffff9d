//! What concluded values rest on, as the database keeps it: the number of the rule, and of the facts that it chose.

use std::collections::BTreeMap;

use adit_engine::{Grounds, KnowledgeBase as Inference, RuleBase};
use sha2::{Digest, Sha256};

/// The number of the rule behind a value, and that of the witness, where the rule chose something.
pub type Reason = (Option<i64>, Option<i64>);

/// The number of facts that a rule chose: of equal facts the same one, whatever the site went through before, so that a
/// database tells nothing of the order of edits. The first 63 bits of SHA-256: of a million facts two share a number in one
/// site of eighteen million.
fn number(facts: &str) -> i64 {
    let hash = Sha256::digest(facts.as_bytes());
    let first = hash.first_chunk::<8>().copied().unwrap_or_default();
    (u64::from_be_bytes(first) >> 1) as i64
}

/// Facts that rules chose, by number.
#[derive(Debug, Default)]
pub struct Facts(BTreeMap<i64, String>);

impl Facts {
    fn number(&mut self, facts: String) -> i64 {
        let number = number(&facts);
        self.0.insert(number, facts);
        number
    }
}

/// Finds reasons, and keeps the facts behind those that were asked for.
pub struct Reasons<'a> {
    knowledge: &'a Inference,
    rules: &'a RuleBase,
    facts: BTreeMap<i64, String>,
}

impl<'a> Reasons<'a> {
    /// Of what these rules concluded.
    pub fn new(knowledge: &'a Inference, rules: &'a RuleBase) -> Self {
        Self { knowledge, rules, facts: BTreeMap::new() }
    }

    /// The facts that rules chose, by number, as far as they were asked for.
    pub fn into_facts(self) -> BTreeMap<i64, String> {
        self.facts
    }

    /// Keeps facts that were found.
    pub fn keep(&mut self, facts: Facts) {
        self.facts.extend(facts.0);
    }

    /// The reasons for a property of the objects in these rows, and the facts that they name.
    pub fn of_rows(&self, class: &str, property: &str, rows: &[u32]) -> (Vec<Reason>, Facts) {
        let mut found = Facts::default();
        let revisions = self.revisions(class, property);
        let (different, places) = self.knowledge.grounds(class, property, rows);
        let mut seen: Vec<Option<Option<i64>>> = vec![None; different.len()];
        let mut reasons = Vec::with_capacity(rows.len());
        for (row, place) in rows.iter().zip(places) {
            let Some(place) = place else {
                // A value that was told, and that rules revised: it rests on the last of them.
                reasons.push(revisions.get(row).map_or((None, None), |by| self.revision(by, &mut found)));
                continue;
            };
            let grounds = &different[place];
            let revised_by = revisions.get(row);
            let witness = match seen[place] {
                Some(witness) if revised_by.is_none() => witness,
                _ => {
                    let witness = self.facts(grounds, revised_by).map(|facts| found.number(facts));
                    if revised_by.is_none() {
                        seen[place] = Some(witness);
                    }
                    witness
                }
            };
            reasons.push((Some(grounds.rule as i64 + 1), witness));
        }
        (reasons, found)
    }

    fn revision(&self, revised_by: &[&str], found: &mut Facts) -> Reason {
        let last = self.rules.rules().iter().position(|rule| Some(&rule.name()) == revised_by.last());
        let facts = serde_json::json!({ "revised by": revised_by }).to_string();
        (last.map(|index| index as i64 + 1), Some(found.number(facts)))
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
