//! What is said at first, at last, and to what nobody understands.

use super::exam::{Exam, Over};
use crate::navigation::body::limits::PROTOCOL;
use crate::navigation::body::message::{Answer, Order};
use crate::navigation::body::terms::{Terms, names};

/// A version that nobody speaks.
const NO_VERSION: u32 = 1_000_000;

pub fn version(exam: &mut Exam) -> Result<(), Over> {
    let hello = Order::Hello { protocol: NO_VERSION, shapes: Vec::new() };
    match exam.ask(&hello)? {
        Answer::Refused { why } => exam.say("version", !why.trim().is_empty(), format!("refused: {why}")),
        Answer::Hello(profile) => {
            exam.say("version", false, format!("it took version {NO_VERSION}"));
            // who was greeted by that will not be greeted again
            if let Ok(terms) = Terms::of(profile) {
                exam.agree(terms);
            }
        }
        other => {
            exam.say("version", false, format!("it answered with `{}`, expected `refused`", other.word()));
        }
    }
    Ok(())
}

pub fn hello(exam: &mut Exam) -> Result<(), Over> {
    let answer = exam.ask(&Order::Hello { protocol: PROTOCOL, shapes: Vec::new() });
    let terms = match answer {
        Ok(Answer::Hello(profile)) => Terms::of(profile),
        Ok(Answer::Refused { why }) => Err(format!("refused: {why}")),
        Ok(other) => Err(format!("it answered with `{}`, expected `hello`", other.word())),
        Err(Over) => Err("there was no answer that can be read".to_owned()),
    };
    match terms {
        Ok(terms) => {
            let profile = &terms.profile;
            let skirt = if profile.has_skirt { "a skirt" } else { "no skirt" };
            let seen = format!(
                "{} directions, {} m, {skirt}; shapes {}, in {}",
                profile.directions,
                profile.range_m,
                names(profile),
                profile.shape
            );
            exam.say("hello", true, seen);
            exam.agree(terms);
            Ok(())
        }
        // it was greeted by a version that nobody speaks, which is another check's to say
        Err(why) if exam.profile().is_ok() => {
            exam.say("hello", None, why);
            Ok(())
        }
        Err(why) => {
            exam.say("hello", false, why);
            Err(Over)
        }
    }
}

pub fn unknown(exam: &mut Exam) -> Result<(), Over> {
    let mut words = Vec::new();
    for text in [r#"{"type":"dance"}"#, r#"{"type":"turn"}"#, r#"{"type":"turn","by_r"#] {
        let answer = exam.ask_line(text);
        let wrong = match &answer {
            Ok(Answer::Refused { why }) if !why.trim().is_empty() => {
                words.push(why.clone());
                continue;
            }
            Ok(other) => {
                format!("{text} was answered with `{}`, expected `refused`, with words", other.word())
            }
            Err(Over) => format!("{text} was not answered, expected `refused`"),
        };
        exam.fault("unknown", wrong);
        answer?;
    }
    if exam.sense().is_err() {
        exam.fault("unknown", "nothing could be sensed after it");
        return Err(Over);
    }
    if exam.found("unknown").is_none() {
        exam.say("unknown", true, format!("refused: {}", words[0]));
    }
    Ok(())
}

pub fn bye(exam: &mut Exam) -> Result<(), Over> {
    match exam.ask(&Order::Bye {}) {
        Ok(Answer::Bye {}) => {}
        Ok(other) => {
            exam.say("bye", false, format!("it answered with `{}`, expected `bye`", other.word()));
            return Ok(());
        }
        Err(Over) => {
            exam.say("bye", false, "it was not answered");
            return Err(Over);
        }
    }
    let mut link = exam.take_link()?;
    if !link.ends() {
        exam.say("bye", false, "it said more, or did not end");
        return Ok(());
    }
    match link.status() {
        Some((false, status)) => exam.say("bye", false, format!("it ended with {status}")),
        _ => exam.say("bye", true, "it ended"),
    }
    Ok(())
}
