//! What a rule base says that nothing will ever read, and what stands in tables that no rule will ever choose: mostly
//! a slip of the pen.

use std::collections::{BTreeMap, BTreeSet};
use std::fmt;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use adit_engine::{Dominated, RuleBase};
use adit_planners::planner::Planner;
use adit_planners::world::World;
use miette::{Diagnostic, LabeledSpan, NamedSource, Severity, SourceCode, SourceSpan};

use crate::site::Site;
use crate::site::rules;
use crate::words::suggest::did_you_mean;

/// Properties that routes and pictures read.
const READ_BY_ROUTES: [&str; 6] =
    ["ROOMS.hardness", "ROOMS.action", "ROOMS.passable", "DOORS.hardness", "DOORS.action", "DOORS.passable"];

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
fn unread(rules: &RuleBase, planners: &[Arc<dyn Planner>]) -> Vec<Unread> {
    let needs = planners.iter().flat_map(|planner| planner.signature().needs);
    unread_but(rules, READ_BY_ROUTES.map(str::to_owned).into_iter().chain(needs))
}

/// As [`unread`], where these properties are read by others than rules.
pub fn unread_but(rules: &RuleBase, asked: impl IntoIterator<Item = String>) -> Vec<Unread> {
    let mut read: BTreeSet<String> = asked.into_iter().collect();
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

/// What of a site's rules will do nothing: as problems, in the order in which they are told.
pub fn ignored(
    site: &Site,
    instead: Option<&Path>,
    rules: &RuleBase,
    planners: &[Arc<dyn Planner>],
) -> Vec<miette::Report> {
    let mut found: Vec<miette::Report> =
        unread(rules, planners).into_iter().map(miette::Report::new).collect();
    found.extend(not_carried_out(rules, "sites", Severity::Warning).into_iter().map(miette::Report::new));
    found.extend(not_read(rules::folder(site, instead)).into_iter().map(miette::Report::new));
    if instead.is_none() {
        found.extend(idle_folder(site).map(miette::Report::new));
    }
    found
}

/// Named areas or doors of the world of which no rule speaks, in sentences: they change nothing.
pub fn unheard(rules: &RuleBase, world: &World) -> Vec<String> {
    let heard = |class: &str| rules.rules().iter().any(|rule| rule.classes().any(|name| name == class));
    let areas = (world.areas.len(), "named areas", ["AREAS", "AREA_ROOMS"]);
    let doors = (world.named_doors.len(), "named doors", ["NAMED_DOORS", "DOOR_ROOMS"]);
    let unheard = [areas, doors]
        .into_iter()
        .filter(|(count, _, classes)| *count > 0 && !classes.iter().any(|class| heard(class)));
    unheard
        .map(|(count, what, [_, rooms])| {
            format!("the site has {count} {what}, and no rule reads {rooms}: they change nothing")
        })
        .collect()
}

/// A rule that waits in vain: what it would do is carried out by nobody yet.
#[derive(Debug, thiserror::Error)]
#[error(
    "rule \"{rule}\" ({file}, line {line}) reacts, and {whose} do not carry out reactions yet: it does nothing"
)]
pub struct NotCarriedOut {
    rule: String,
    file: String,
    line: usize,
    whose: &'static str,
    severity: Severity,
    text: NamedSource<String>,
    name: SourceSpan,
}

impl Diagnostic for NotCarriedOut {
    fn code<'a>(&'a self) -> Option<Box<dyn fmt::Display + 'a>> {
        Some(Box::new("rule/not-carried-out"))
    }

    fn severity(&self) -> Option<Severity> {
        Some(self.severity)
    }

    fn help<'a>(&'a self) -> Option<Box<dyn fmt::Display + 'a>> {
        Some(Box::new(
            "say it with `rule`, or carry it out in a program by KnowledgeBase::react of adit-engine",
        ))
    }

    fn source_code(&self) -> Option<&dyn SourceCode> {
        Some(&self.text)
    }

    fn labels(&self) -> Option<Box<dyn Iterator<Item = LabeledSpan> + '_>> {
        Some(Box::new(std::iter::once(LabeledSpan::new_with_span(None, self.name))))
    }
}

/// The rules that react.
///
/// # Arguments
/// `whose` are the rules, in a word: "sites".
pub fn not_carried_out(rules: &RuleBase, whose: &'static str, severity: Severity) -> Vec<NotCarriedOut> {
    let reacts = rules.rules().iter().filter(|rule| rule.reacts());
    let found = reacts.map(|rule| {
        let (file, name) = rule.place();
        NotCarriedOut {
            rule: rule.name().to_owned(),
            file: rule.file().to_owned(),
            line: rule.line(),
            whose,
            severity,
            text: NamedSource::new(file.name(), file.text().to_owned()),
            name: name.into(),
        }
    });
    found.collect()
}

/// A file among the rules that looks like one of them and is not read.
#[derive(Debug, thiserror::Error, Diagnostic)]
#[error("{} is not read: {why}", file.display())]
#[diagnostic(
    code("rule/not-read"),
    severity(warning),
    help("move it or rename it; a name that ends in ~ is left alone")
)]
pub struct NotRead {
    file: PathBuf,
    why: &'static str,
}

/// A folder of rules beside the one that counts.
#[derive(Debug, thiserror::Error, Diagnostic)]
#[error("the rules in {} do not count: site.toml names {}", idle.display(), named.display())]
#[diagnostic(
    code("rule/not-read"),
    severity(warning),
    help("move the folder away, or take the line `rules = …` out of site.toml: then it counts")
)]
pub struct IdleFolder {
    idle: PathBuf,
    named: PathBuf,
}

/// The files among the rules that look like some and are not read.
pub fn not_read(folder: Option<&Path>) -> Vec<NotRead> {
    let found = folder.map(rules::not_read).unwrap_or_default();
    found.into_iter().map(|(file, why)| NotRead { file, why }).collect()
}

/// The folder `rules` of a site that names another one.
fn idle_folder(site: &Site) -> Option<IdleFolder> {
    let (idle, named) = (site.idle_rules.clone()?, site.rules.clone()?);
    Some(IdleFolder { idle, named })
}

/// A row of a table that a rule can never choose.
#[derive(Debug, thiserror::Error, Diagnostic)]
#[error(
    "{class} {key} can never be {} in rule \"{rule}\": {by} comes before it, and fits wherever it fits",
    listed(variables)
)]
#[diagnostic(
    code("rule/never-chosen"),
    severity(warning),
    help("one of the two is out of place: make {key} better or easier to fit, or {by} worse")
)]
pub struct NeverChosen {
    rule: String,
    class: String,
    key: String,
    by: String,
    variables: Vec<String>,
}

fn listed(variables: &[String]) -> String {
    let quoted: Vec<String> = variables.iter().map(|variable| format!("`{variable}`")).collect();
    match quoted.split_last() {
        Some((last, before)) if !before.is_empty() => format!("{} or {last}", before.join(", ")),
        _ => quoted.concat(),
    }
}

/// One warning for each object and rule, though several of its clauses may never choose it.
pub fn never_chosen(dominated: &[Dominated]) -> Vec<NeverChosen> {
    let mut places = BTreeMap::new();
    let mut found: Vec<NeverChosen> = Vec::new();
    for Dominated { rule, variable, class, key, by } in dominated {
        let place = *places.entry((rule, class, key, by)).or_insert(found.len());
        match found.get_mut(place) {
            Some(said) => said.variables.push(variable.clone()),
            None => found.push(NeverChosen {
                rule: rule.clone(),
                class: class.clone(),
                key: key.clone(),
                by: by.clone(),
                variables: vec![variable.clone()],
            }),
        }
    }
    found
}
