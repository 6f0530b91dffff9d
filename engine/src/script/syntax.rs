//! The grammar of items, as rhai's custom syntax asks for it: token by token.

mod declare;
mod quantifier;
mod shape;
mod table;
mod word;

use rhai::{Dynamic, Engine};

use crate::suggest::nearest;
pub(crate) use quantifier::Quantifier;
use shape::{At, Next, Tabling, found, wrong};
pub(crate) use shape::{Shape, Slot};
pub(crate) use word::{Word, start_file, starts_item};

pub(crate) fn register(engine: &mut Engine) {
    for word in Word::ALL {
        engine.register_custom_syntax_with_state_raw(
            word.key(),
            move |_, ahead, state| {
                let mut shape = state.clone().try_cast::<Shape>().unwrap_or(Shape {
                    slots: vec![],
                    at: At::Name,
                    item: word,
                    clause: None,
                    needs_have: false,
                    keyed: false,
                });
                let next = shape.next(ahead);
                *state = Dynamic::from(shape);
                next
            },
            true,
            |_, _, _| Err("a rule is declared, not run".into()),
        );
    }
    word::register(engine);
}

impl Shape {
    fn next(&mut self, ahead: &str) -> Next {
        // The next item's word, where one begins.
        let keyed = Word::ALL.into_iter().find(|word| word.key() == ahead);
        self.keyed = keyed.is_some();
        let ahead = match keyed {
            Some(word) => word.as_str(),
            None => ahead,
        };
        // What is no token comes as the reader's complaint about it.
        if let Some(letter) = ahead.strip_prefix("Unexpected ") {
            let letter = letter.trim_matches('\'');
            return wrong(format!(
                "`{letter}` cannot stand here: names have letters a to z, digits and _ only"
            ));
        }
        if ahead.contains("not terminated") {
            return wrong("this text is not closed by a double quote on its line".into());
        }
        match self.at {
            At::Name if matches!(self.item, Word::Class | Word::Property) => self.declared_name(),
            At::Name => {
                let at = match self.item {
                    Word::Table => At::Tabling(Tabling::Hit),
                    Word::Without => At::End,
                    _ => At::Clause,
                };
                self.input(Slot::Name(self.item), at, "$string$")
            }
            At::Declaring(at) => self.declaring(at, ahead),
            At::Tabling(at) => self.tabling(at, ahead),
            At::Clause if ahead == "priority" && self.may_have_priority() => {
                self.word("priority", At::Priority)
            }
            At::Clause if ahead == "priority" && self.item == Word::Revise && self.clause.is_none() => {
                wrong("a revision has a level, not a priority: `level 3` at its end".into())
            }
            At::Clause => self.clause(ahead),
            At::Priority => self.input(Slot::Priority, At::Clause, "$expr$"),
            At::Number(quantifier) => self.input(Slot::Number, At::Of(quantifier), "$ident$"),
            At::Of(quantifier) if ahead == "of" => self.word("of", At::Variable(quantifier)),
            At::Of(quantifier) => wrong(format!(
                "`of` and a variable belong here, as in `{} n of door in DOORS`, not {}",
                quantifier.word(),
                found(ahead)
            )),
            At::Variable(quantifier) => self.input(Slot::Variable(quantifier), At::In, "$ident$"),
            At::In if ahead == "in" => self.word("in", At::Class),
            At::In => wrong(format!("`in` and a class belong here, not `{ahead}`")),
            At::Class => {
                let options = At::Options { by: false, condition: false };
                self.input(Slot::Class, options, "$ident$")
            }
            At::Options { by, condition } => self.options(ahead, by, condition),
            At::By => self.input(Slot::By, At::Options { by: true, condition: false }, "$expr$"),
            At::Where => self.input(Slot::Where, At::Options { by: true, condition: true }, "$expr$"),
            At::Have => self.input(Slot::Have, At::Options { by: true, condition: true }, "$expr$"),
            At::Then => self.input(Slot::Then, At::AfterThen, "$block$"),
            At::Hypothesis => self.input(Slot::Hypothesis, At::AfterHypothesis, "$expr$"),
            At::AfterHypothesis if ahead == "then" => self.word("then", At::Then),
            At::AfterThen if ahead == "else" && self.item == Word::On => {
                wrong("an `on` has no `else`: another `on` with `none` says what to do instead".into())
            }
            At::AfterThen if ahead == "else" => self.word("else", At::Else),
            At::Else => self.input(Slot::Else, At::End, "$block$"),
            At::Target => self.input(Slot::Target, At::TargetBy, "$expr$"),
            At::TargetBy if ahead == "by" => self.word("by", At::Operator),
            At::TargetBy => wrong(format!("`by` and an operator belong here, not `{ahead}`")),
            At::Operator => match ahead {
                "*" | "+" | "-" => self.input(Slot::Operator, At::Amount, "$symbol$"),
                "max" | "min" => self.input(Slot::Operator, At::Amount, "$ident$"),
                "/" => {
                    wrong("a revision goes by *, +, -, max or min: `by * 0.5` in place of `by / 2`".into())
                }
                _ => wrong(format!("a revision goes by *, +, -, max or min, not `{ahead}`")),
            },
            At::Amount => self.input(Slot::Amount, At::AfterAmount, "$expr$"),
            At::AfterAmount if ahead == "level" => self.word("level", At::Level),
            At::Level => self.input(Slot::Level, At::End, "$int$"),
            At::AfterHypothesis | At::AfterThen | At::AfterAmount | At::End => self.next_item(ahead),
            At::Done => Ok(None),
        }
    }

    /// Where an item does not end in a block, rhai would ask for a semicolon before the next item; so the next
    /// item is read as part of the same expression.
    fn next_item(&mut self, ahead: &str) -> Next {
        let in_block = matches!(self.slots.last(), Some(Slot::Then | Slot::Else));
        match Word::of(ahead).filter(|_| !in_block) {
            Some(word) => {
                self.item = word;
                self.clause = None;
                self.word(if self.keyed { word.key() } else { word.as_str() }, At::Name)
            }
            None if ahead == ";" && !in_block => self.word(";", At::Done),
            None if !in_block && matches!(ahead, "fn" | "const" | "private") => {
                wrong(format!("a `;` belongs before `{ahead}` here"))
            }
            None => Ok(None),
        }
    }

    fn may_have_priority(&self) -> bool {
        self.clause.is_none()
            && self.item != Word::Revise
            && matches!(self.slots.last(), Some(Slot::Name(_) | Slot::Hit | Slot::HitValues | Slot::HitFold))
    }

    fn options(&mut self, ahead: &str, by: bool, condition: bool) -> Next {
        let ranked = self.clause.is_some_and(Quantifier::ranks);
        match ahead {
            "have" if self.needs_have => {
                self.needs_have = false;
                self.word("have", At::Have)
            }
            "by" if ranked && !by => self.word("by", At::By),
            "where" if ranked && !by && self.clause == Some(Quantifier::Sum) => {
                wrong("what to add up belongs before `where`, as in `by weight where ...`".into())
            }
            "where" if ranked && !by => {
                wrong("what to compare belongs before `where`, as in `by hardness where ...`".into())
            }
            "where" if !condition => self.word("where", At::Where),
            _ if ranked && !by && self.clause == Some(Quantifier::Sum) => {
                wrong("`sum` needs `by` and what to add up, as in `by weight`".into())
            }
            _ if ranked && !by => {
                wrong("`least` and `most` need `by` and what to compare, as in `by hardness`".into())
            }
            _ if self.needs_have => {
                let example = "`all door in DOORS have door.closed`";
                wrong(format!("`all` needs `have` and what must be true of each, as in {example}"))
            }
            _ => self.clause(ahead),
        }
    }

    fn clause(&mut self, ahead: &str) -> Next {
        if let Some(quantifier) = Quantifier::of(ahead) {
            if self.clause.is_none() && !matches!(quantifier, Quantifier::Each | Quantifier::Some) {
                return wrong(format!("the first clause says `each`, not `{ahead}`"));
            }
            self.clause = Some(quantifier);
            self.needs_have = quantifier == Quantifier::All;
            let at = if quantifier.counts() { At::Number(quantifier) } else { At::Variable(quantifier) };
            return self.word(quantifier.word(), at);
        }
        let (end, at) = match self.item {
            Word::Revise => ("set", At::Target),
            Word::Table => ("given", At::Tabling(Tabling::Given)),
            _ => ("then", At::Then),
        };
        if ahead == end && self.clause.is_some() {
            return self.word(end, at);
        }
        if ahead == "hypothesis" && self.clause.is_some() && self.item == Word::Rule {
            return self.word("hypothesis", At::Hypothesis);
        }
        if self.clause.is_none() {
            let meant = elsewhere(ahead, end).map_or_else(String::new, |meant| format!(": {meant}"));
            return wrong(format!("`each`, a variable, `in` and a class belong here, not `{ahead}`{meant}"));
        }
        let words = [
            "each",
            "least",
            "most",
            "some",
            "none",
            "count",
            "sum",
            "all",
            "where",
            "by",
            "hypothesis",
            end,
        ];
        let meant = nearest(ahead, words).map_or_else(
            || elsewhere(ahead, end).map_or_else(String::new, |meant| format!(": {meant}")),
            |word| format!("; did you mean `{word}`?"),
        );
        wrong(format!("another clause or `{end}` belongs here, not {}{meant}", found(ahead)))
    }
}

/// What is meant by a word or sign that other languages have where a rule has none.
fn elsewhere(ahead: &str, end: &str) -> Option<String> {
    Some(match ahead {
        "=" => "two values are compared by `==`".to_owned(),
        "and" => "conditions are joined by `&&`".to_owned(),
        "or" => "conditions are joined by `||`".to_owned(),
        "if" | "when" => "a condition begins with `where`".to_owned(),
        "," | ";" => "clauses follow each other without a sign".to_owned(),
        "exists" | "any" => "that there is one says `some`".to_owned(),
        "every" | "forall" => {
            "that it holds of each says `all`, and what the rule is about `each`".to_owned()
        }
        "not" => "that there is none says `none`, and a condition `!`".to_owned(),
        "{" | "=>" | "->" | "set" if end == "then" => "what the rule does begins with `then`".to_owned(),
        _ => return None,
    })
}
