//! What rules said of objects, kept for those that are alike to them.
//!
//! A robot asks about hundreds of walls after each scan, most of which rules cannot tell from one before: they compare its
//! distance with a number, say, and do not look at its length.

use std::collections::HashMap;

use adit_engine::{Consultation, Grain};

use super::{Of, Property};

/// After so many objects it is looked whether it was worth it.
const TRIAL: u32 = 256;

/// No more answers are kept than that; then it begins anew.
const MOST: usize = 4096;

/// Longer texts are not told apart here: their objects are asked about.
const LONGEST: usize = 15;

/// What was said of objects with facts of one kind.
#[derive(Debug)]
pub struct Memory<F, A> {
    /// Truths, and numbers with those that they are compared with: all of them make one word of the key.
    coarse: Vec<(Of<F>, Vec<f64>)>,
    /// What else rules look at.
    whole: Vec<Of<F>>,
    answers: HashMap<Box<[u64]>, A, ahash::RandomState>,
    /// What the object that was asked about last looks like.
    key: Vec<u64>,
    asked: u32,
    known: u32,
}

impl<F, A: Copy> Memory<F, A> {
    /// For objects with these properties, which are the inputs of a consultation; `None` where rules look at others, too.
    pub fn of(
        consultation: &Consultation,
        properties: impl IntoIterator<Item = Property<F>>,
    ) -> Option<Self> {
        let (mut coarse, mut whole, mut words) = (Vec::new(), Vec::new(), 1_u64);
        for ((_, of), grain) in properties.into_iter().zip(consultation.grains()?) {
            let numbers = match (&of, grain) {
                (_, Grain::Nothing) => continue,
                (Of::Truth(_), _) => Some(Vec::new()),
                (Of::Number(_) | Of::Perhaps(_), Grain::Among(numbers)) => Some(numbers.clone()),
                _ => None,
            };
            let more = numbers.as_ref().and_then(|numbers| words.checked_mul(classes(numbers)));
            match (numbers, more) {
                (Some(numbers), Some(more)) => {
                    words = more;
                    coarse.push((of, numbers));
                }
                _ => whole.push(of),
            }
        }
        Some(Self { coarse, whole, answers: HashMap::default(), key: Vec::new(), asked: 0, known: 0 })
    }

    /// What was said of an object like this one.
    pub fn recall(&mut self, facts: &F) -> Option<A> {
        self.key.clear();
        let word =
            |word, (of, numbers): &(Of<F>, Vec<f64>)| word * classes(numbers) + class(of, numbers, facts);
        self.key.push(self.coarse.iter().fold(0, word));
        for of in &self.whole {
            match of {
                // to the bit: one divided by minus zero is not what it is by zero
                Of::Number(of) => self.key.push(of(facts).to_bits()),
                Of::Perhaps(of) => self.key.push(of(facts).unwrap_or(f64::NAN).to_bits()),
                Of::Truth(of) => self.key.push(of(facts).into()),
                Of::Text(of) => match of(facts) {
                    None => self.key.extend([0, 0]),
                    Some(text) if text.len() <= LONGEST => self.key.extend(words(text)),
                    Some(_) => {
                        self.key.clear();
                        return None;
                    }
                },
            }
        }
        self.asked += 1;
        let known = self.answers.get(self.key.as_slice()).copied();
        self.known += u32::from(known.is_some());
        known
    }

    /// Keeps what was said of the object that was not known.
    pub fn keep(&mut self, answer: A) {
        if self.key.is_empty() {
            return;
        }
        if self.answers.len() >= MOST {
            self.answers.clear();
        }
        self.answers.insert(self.key.as_slice().into(), answer);
    }

    /// Whether it takes less time without: fewer than half of the objects were like one before.
    pub const fn is_idle(&mut self) -> bool {
        if self.asked < TRIAL {
            return false;
        }
        let is_idle = self.known < self.asked / 2;
        (self.asked, self.known) = (0, 0);
        is_idle
    }
}

/// How many classes there are of what is compared with these numbers: between them, on them, and unknown.
const fn classes(numbers: &[f64]) -> u64 {
    2 * numbers.len() as u64 + 2
}

fn class<F>(of: &Of<F>, numbers: &[f64], facts: &F) -> u64 {
    let number = match of {
        Of::Truth(of) => return of(facts).into(),
        Of::Number(of) => of(facts),
        Of::Perhaps(of) => of(facts).unwrap_or(f64::NAN),
        Of::Text(_) => f64::NAN,
    };
    if number.is_nan() {
        return classes(numbers) - 1;
    }
    numbers.iter().map(|known| u64::from(number > *known) + u64::from(number >= *known)).sum()
}

/// A short text and its length, which is none of a text that is not known.
fn words(text: &str) -> [u64; 2] {
    let mut bytes = [0; 16];
    bytes[..text.len()].copy_from_slice(text.as_bytes());
    let both = u128::from_le_bytes(bytes) | (text.len() as u128 + 1) << 120;
    [both as u64, (both >> 64) as u64]
}

#[cfg(test)]
mod tests {
    use std::sync::Arc;

    use adit_engine::{RuleBase, SourceFile};

    use super::super::Class;
    use super::*;

    type Facts = (f64, Option<f64>, &'static str, bool);

    const PROPERTIES: [Property<Facts>; 4] = [
        ("far", Of::Number(|of| of.0)),
        ("size", Of::Perhaps(|of| of.1)),
        ("name", Of::Text(|of| Some(of.2))),
        ("is_new", Of::Truth(|of| of.3)),
    ];

    fn memory(rule: &str) -> Option<Memory<Facts, u8>> {
        let source = SourceFile::new("of.rhai", format!("rule \"of\" each o in OF {rule}"));
        let rules = Arc::new(RuleBase::compile(&[source]).unwrap());
        Memory::of(&Class::new("OF", PROPERTIES, &["said"]).consultation(&rules).unwrap(), PROPERTIES)
    }

    #[test]
    fn what_was_said_is_known_of_those_that_are_alike_to_rules_alone() {
        let mut known = memory("then { o.said = o.far < 3 || o.size > 2 && o.name == \"a\"; }").unwrap();
        let one = (2.0, None, "a", true);
        assert_eq!(known.recall(&one), None);
        known.keep(1);
        assert_eq!(
            [(2.5, None, "a", false), (-1.0, None, "a", true)].map(|of| known.recall(&of)),
            [Some(1); 2]
        );
        let others = [
            (3.0, None, "a", true),
            (f64::NAN, None, "a", true),
            (2.0, Some(1.0), "a", true),
            (2.0, None, "", true),
        ];
        assert_eq!(others.map(|of| known.recall(&of)), [None; 4]);
        // too long to be told apart
        let long = (2.0, None, "a name of many letters", true);
        assert_eq!(known.recall(&long), None);
        known.keep(2);
        assert_eq!(known.recall(&long), None);
        assert_eq!(known.recall(&one), Some(1));
    }

    #[test]
    fn who_sees_hardly_any_alike_gives_up_and_of_other_objects_nothing_is_known() {
        let mut known = memory("then { o.said = 2 * o.far; }").unwrap();
        for far in 0..TRIAL {
            assert!(!known.is_idle());
            assert_eq!(known.recall(&(far.into(), None, "", false)), None);
            known.keep(0);
        }
        assert!(known.is_idle());
        assert!(memory("some p in OTHERS where p.far < o.far then { o.said = 1; }").is_none());
    }
}
