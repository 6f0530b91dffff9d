//! What a rule base says that nothing will ever read: mostly a slip of the pen.

use std::collections::BTreeSet;
use std::fmt;

use adit_engine::RuleBase;
use adit_planners::planner::Planner;
use miette::{Diagnostic, Severity};

use crate::suggest::did_you_mean;

/// Properties that routes and pictures read.
const READ_BY_ROUTES: [&str; 5] =
    ["ROOMS.hardness", "ROOMS.action", "DOORS.hardness", "DOORS.action", "DOORS.passable"];

/// A property that is set and never read.
#[derive(Debug, thiserror::Error)]
#[error("rule \"{rule}\" ({file}, line {line}) sets {property}, which no rule, planner or route reads")]
pub struct Unread {
    rule: String,
    file: String,
    line: usize,
    property: String,
    help: Option<String>,
}

impl Diagnostic for Unread {
    fn code<'a>(&'a self) -> Option<Box<dyn fmt::Display + 'a>> {
        Some(Box::new("rule/unread-property"))
    }

    fn severity(&self) -> Option<Severity> {
        Some(Severity::Warning)
    }

    fn help<'a>(&'a self) -> Option<Box<dyn fmt::Display + 'a>> {
        self.help.as_ref().map(|help| Box::new(help) as _)
    }
}

/// Every property that is set and never read, in the order of the rules.
pub fn unread(rules: &RuleBase, planners: &[Box<dyn Planner>]) -> Vec<Unread> {
    let mut read: BTreeSet<String> = READ_BY_ROUTES.map(str::to_owned).into();
    read.extend(planners.iter().flat_map(|planner| planner.signature().needs));
    for rule in rules.rules() {
        read.extend(
            rule.reads().filter(|name| !rule.sets().any(|set| set == *name)).map(ToString::to_string),
        );
    }
    let mut found = Vec::new();
    for rule in rules.rules() {
        for property in rule.sets().map(ToString::to_string).filter(|property| !read.contains(property)) {
            found.push(Unread {
                rule: rule.name().to_owned(),
                file: rule.file().to_owned(),
                line: rule.line(),
                help: did_you_mean(&property, read.iter().map(String::as_str)),
                property,
            });
        }
    }
    found
}
