//! What a rule base says that nothing will ever read, and what stands in tables that no rule will ever choose: mostly
//! a slip of the pen.

use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};
use std::sync::Arc;

use adit_engine::{Dominated, Instead, Misspelt, PropertyName, Replaced, Rule, RuleBase, Standing, Unmet};
use adit_planners::facts::Facts;
use adit_planners::overlays::{AREAS, only_of_site, own};
use adit_planners::planner::Planner;
use adit_planners::read::ZONE_ID;
use adit_planners::world::{Area, World};
use miette::NamedSource;

use crate::error::{Code, Finding};
use crate::site::Site;
use crate::site::base::{self, Base};
use crate::site::rules;
use crate::words::number::counted;
use crate::words::suggest::did_you_mean;

/// Properties that routes and pictures read.
const READ_BY_ROUTES: [&str; 13] = [
    "ROOMS.hardness",
    "ROOMS.action",
    "ROOMS.passable",
    "DOORS.hardness",
    "DOORS.action",
    "DOORS.passable",
    "SPACES.name",
    "SPACES.kind",
    "SPACES.closed",
    "DOORWAYS.name",
    "DOORWAYS.closed",
    "DOORWAYS.closed_from",
    "AREAS.heading",
];

/// Every property that is set and never read, in the order of the rules. Without a map all that is concluded is for people
/// to read.
/// `asked` are the properties that add up along routes; where the map is not cut into rooms those, too, that its planner asks
/// for, and what is said of other classes is for people.
pub fn unread(
    site: &Site,
    rules: &RuleBase,
    planners: &[Arc<dyn Planner>],
    asked: &[String],
) -> Vec<Finding> {
    if !site.has_rooms() {
        let is_asked =
            |name: &str| asked.iter().any(|asked| asked.split('.').next() == name.split('.').next());
        let for_people = rules.rules().iter().flat_map(Rule::sets).map(ToString::to_string);
        let for_people = for_people.filter(|name| !is_asked(name));
        return unread_but(rules, asked.iter().cloned().chain(for_people), |_| true);
    }
    let needs = planners.iter().flat_map(|planner| planner.signature().needs);
    let needs = needs.map(|need| need.trim_end_matches('?').to_owned());
    let read = READ_BY_ROUTES.map(str::to_owned).into_iter().chain(needs).chain(asked.iter().cloned());
    unread_but(rules, read, |_| true)
}

/// As [`unread`], where these properties are read by others than rules, of the rules of some files.
pub fn unread_but(
    rules: &RuleBase,
    asked: impl IntoIterator<Item = String>,
    is_looked_at: impl Fn(&str) -> bool,
) -> Vec<Finding> {
    let mut read: BTreeSet<String> = asked.into_iter().collect();
    for rule in rules.rules() {
        read.extend(
            rule.reads().filter(|name| !rule.sets().any(|set| set == *name)).map(ToString::to_string),
        );
    }
    let mut found = Vec::new();
    for rule in rules.rules().iter().filter(|rule| is_looked_at(rule.file())) {
        for property in rule.sets().map(ToString::to_string).filter(|property| !read.contains(property)) {
            let (name, file, line) = (rule.name(), rule.file(), rule.line());
            let message = format!(
                "rule \"{name}\" ({file}, line {line}) sets {property}, which no rule, planner or route reads"
            );
            let help = did_you_mean(&property, read.iter().map(String::as_str));
            found.push(Finding::warning(Code::RuleUnreadProperty, message, help));
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
    asked: &[String],
) -> Vec<Finding> {
    let mut found = unread(site, rules, planners, asked);
    let bases = rules::bases(site, instead);
    found.extend(bases.iter().filter_map(Base::folder).flat_map(not_read));
    found
}

/// What of a site's own rules never counts, and inputs for which their tables have no row. The shipped ones are looked at by
/// their own tests.
///
/// # Arguments
/// `told` are the tables as rules are told them.
pub fn doubtful(site: &Site, instead: Option<&Path>, rules: &RuleBase, told: &Facts) -> Vec<Finding> {
    let bases = rules::bases(site, instead);
    let is_own = |file: &str| {
        let folders = bases.iter().filter_map(Base::folder);
        folders.into_iter().any(|folder| Path::new(file).starts_with(folder))
    };
    let is_told = |name: &PropertyName| {
        let column = told.get(&name.class).and_then(|table| table.column(&name.property));
        column.is_some_and(|column| !column.is_empty() && column.is_whole())
    };
    let all = rules.warnings().iter().cloned().chain(rules.outvoted(is_told));
    all.filter(|warning| is_own(&warning.file)).map(Finding::from).collect()
}

/// Named areas or doors of the world of which no rule speaks, in sentences: they change nothing.
pub fn unheard(rules: &RuleBase, world: &World) -> Vec<String> {
    let heard = |class: &str| rules.rules().iter().any(|rule| rule.classes().any(|name| name == class));
    let areas = (world.areas.len(), "named area", ["AREAS", "AREA_ROOMS"]);
    let doors = (world.named_doors.len(), "named door", ["NAMED_DOORS", "DOOR_ROOMS"]);
    let unheard = [areas, doors]
        .into_iter()
        .filter(|(count, _, classes)| *count > 0 && !classes.iter().any(|class| heard(class)));
    unheard
        .map(|(count, what, [_, rooms])| {
            let change = if count == 1 { "it changes" } else { "they change" };
            format!("the site has {}, and no rule reads {rooms}: {change} nothing", counted(count, what))
        })
        .collect()
}

/// What a site says of its named areas and doors and no rule reads, in sentences: a slip of the pen, mostly.
pub fn unread_of_named(rules: &RuleBase, world: &World) -> Vec<String> {
    let read: BTreeSet<String> =
        rules.rules().iter().flat_map(Rule::reads).map(ToString::to_string).collect();
    // the maker of a file of zones knows them by it
    let is_said = |property: &str| property != ZONE_ID;
    let is_unread = |((class, property), _): &((&str, &str), Vec<&str>)| {
        is_said(property) && !read.contains(&format!("{class}.{property}"))
    };
    let sentence = |((class, property), names): ((&str, &str), Vec<&str>)| {
        let mut known: Vec<&str> = own(class).chain(["rect", "polygon", "line", "kind", "name"]).collect();
        let of_class = read.iter().filter_map(|name| name.split_once('.')).filter(|(of, _)| *of == class);
        known.extend(of_class.map(|(_, property)| property));
        let help = did_you_mean(property, known.into_iter());
        let help = help.map_or_else(String::new, |help| format!(" ({help})"));
        let whose = if class == AREAS { "area" } else { "door" };
        let more = match names.len() {
            1 => String::new(),
            count => format!(" and {} more", count - 1),
        };
        format!("no rule reads `{property}` of the {whose} `{}`{more}: it changes nothing{help}", names[0])
    };
    only_of_site(world).into_iter().filter(is_unread).map(sentence).collect()
}

/// What a floor plan says of its doorways and regions and no rule reads, in sentences.
pub fn unread_marks(rules: &RuleBase, told: &Facts) -> Vec<String> {
    let Some(marks) = told.get("MARKS") else { return Vec::new() };
    let (Ok(what), Ok(properties)) = (marks.texts("what"), marks.texts("property")) else {
        return Vec::new();
    };
    let read: BTreeSet<&str> =
        rules.rules().iter().flat_map(Rule::reads).map(|name| name.property.as_str()).collect();
    let said = what.iter().flatten().zip(properties.iter().flatten());
    let unread: BTreeSet<(&String, &String)> =
        said.filter(|(_, property)| !read.contains(property.as_str())).collect();
    let sentence = |(what, property): (&String, &String)| {
        let help = did_you_mean(property, read.iter().copied());
        let help = help.map_or_else(String::new, |help| format!(" ({help})"));
        format!("no rule reads `{property}` of a {what}: it changes nothing{help}")
    };
    unread.into_iter().map(sentence).collect()
}

/// Kinds of areas of which no rule speaks, where nothing else of the area is read: a slip of the pen, mostly. Where rules compare
/// kinds with what tables hold, nobody knows beforehand which there are.
pub fn unknown_kinds(rules: &RuleBase, world: &World) -> Vec<String> {
    let read: BTreeSet<String> =
        rules.rules().iter().flat_map(Rule::reads).map(ToString::to_string).collect();
    let of_kinds: Vec<&Rule> =
        rules.rules().iter().filter(|rule| rule.reads().any(is_kind_of_areas)).collect();
    let own = [AREAS, "AREA_ROOMS", "ROOMS", "DOORS", "SPACES", "DOORWAYS", "ROBOTS"];
    if of_kinds.is_empty() || of_kinds.iter().any(|rule| rule.classes().any(|class| !own.contains(&class))) {
        return Vec::new();
    }
    let said: BTreeSet<&str> = of_kinds
        .iter()
        .flat_map(|rule| rule.place().0.text().split(['"', '`']).skip(1).step_by(2))
        .filter(|text| !text.contains(['\n', ' ']))
        .collect();
    let is_of_use =
        |property: &String| read.contains(property) || READ_BY_ROUTES.contains(&property.as_str());
    let is_read = |area: &Area| area.further.iter().any(|(name, _)| is_of_use(&format!("{AREAS}.{name}")));
    let mut unknown: BTreeMap<&str, Vec<&str>> = BTreeMap::new();
    for area in world.areas.iter().filter(|area| !is_read(area)) {
        if let Some(kind) = area.kind.as_deref().filter(|kind| !said.contains(kind)) {
            unknown.entry(kind).or_default().push(&area.name);
        }
    }
    let sentence = |(kind, names): (&str, Vec<&str>)| {
        let more = match names.len() {
            1 => String::new(),
            count => format!(" and {} more", count - 1),
        };
        let help = did_you_mean(kind, said.iter().copied());
        let help = help.map_or_else(String::new, |help| format!(" ({help})"));
        format!(
            "no rule speaks of areas of the kind `{kind}`, as `{}`{more} is: robots pass there as elsewhere, unless asked to avoid it{help}",
            names[0]
        )
    };
    unknown.into_iter().map(sentence).collect()
}

fn is_kind_of_areas(property: &adit_engine::PropertyName) -> bool {
    property.class == AREAS && property.property == "kind"
}

/// Rules that make objects which are not for rules to make, and rules that read routes, which follow from what they conclude:
/// only rules that react may, and those that conclude something of routes alone.
///
/// # Arguments
/// `given` are the classes whose objects planners and tables give; `routes` is the class of routes; `asked` are those of
/// which rules are asked about one object at a time, which nobody else sees.
pub fn reactions(rules: &RuleBase, given: &[String], routes: &str, asked: &[&str]) -> Vec<Finding> {
    let mut found = Vec::new();
    for rule in rules.rules() {
        let Some(class) = rule.classes().find(|class| asked.contains(class)) else { continue };
        let elsewhere = rule.sets().find(|set| set.class != *class);
        let (what, help) = match elsewhere {
            _ if rule.reacts() => ("reacts to", "react to what is told, or to ROUTES"),
            Some(_) => (
                "concludes something of other objects from",
                "it may read those, and conclude something of this one",
            ),
            None => continue,
        };
        let message = format!(
            "rule \"{}\" {what} {class}, of which rules are asked about one at a time: it would never be carried out",
            rule.name()
        );
        let (text, span) = rule.place();
        let source = NamedSource::new(text.name(), text.text().to_owned());
        found.push(Finding::said(Code::RuleNotCarriedOut, message, Some(help.to_owned())).at(source, span));
    }
    for class in rules.tells().filter(|class| given.iter().any(|of| of == class)) {
        let message = format!(
            "a rule tells new objects of {class}, and which of those there are is not for rules to say"
        );
        let help = "set a property of one that is there, or tell of a class of your own".to_owned();
        found.push(Finding::said(Code::RuleNotCarriedOut, message, Some(help)));
    }
    let reads = |rule: &&Rule| rule.classes().any(|class| class == routes);
    let concludes = |rule: &&Rule| !rule.reacts() && rule.sets().any(|set| set.class != routes);
    for rule in rules.rules().iter().filter(concludes).filter(reads) {
        let (text, span) = rule.place();
        let message =
            format!("rule \"{}\" reads {routes}, which follow from what rules conclude", rule.name());
        let help = "say it with `on`: rules that react are carried out once routes are known".to_owned();
        let source = NamedSource::new(text.name(), text.text().to_owned());
        found.push(Finding::said(Code::RuleNotCarriedOut, message, Some(help)).at(source, span));
    }
    found
}

/// The rules that react: they wait in vain, since what they would do is carried out by nobody yet.
///
/// # Arguments
/// `whose` are the rules, in a word: "sites". `finding` makes a warning of it, or an error.
pub fn not_carried_out(
    rules: &RuleBase,
    whose: &str,
    finding: fn(Code, String, Option<String>) -> Finding,
    is_meant: impl Fn(&str) -> bool,
) -> Vec<Finding> {
    let reacts = rules.rules().iter().filter(|rule| rule.reacts() && is_meant(rule.file()));
    let found = reacts.map(|rule| {
        let (text, span) = rule.place();
        let message = format!(
            "rule \"{}\" ({}, line {}) reacts, and {whose} do not carry out reactions yet: it does nothing",
            rule.name(),
            rule.file(),
            rule.line()
        );
        let help = "say it with `rule`; a program of your own can carry it out, with adit-engine";
        finding(Code::RuleNotCarriedOut, message, Some(help.to_owned()))
            .at(NamedSource::new(text.name(), text.text().to_owned()), span)
    });
    found.collect()
}

/// The files among the rules that look like some and are not read.
pub fn not_read(folder: &Path) -> Vec<Finding> {
    let help = "move it or rename it; a name that ends in ~ is left alone";
    let warning = |(file, why): (PathBuf, _)| {
        let message = format!("{} is not read: {why}", file.display());
        Finding::warning(Code::RuleNotRead, message, Some(help.to_owned()))
    };
    base::not_read(folder).into_iter().map(warning).collect()
}

/// Which rules beneath are replaced or left out, in sentences; those that are replaced by the same in one.
pub fn replaced(rules: &RuleBase) -> Vec<Finding> {
    let is_same = |replaced: &&Replaced| matches!(&replaced.by, Instead::Rule(by) if by.version == replaced.beneath.version);
    let (same, others): (Vec<_>, Vec<_>) = rules.replaced().iter().partition(is_same);
    let said = others.into_iter().map(|Replaced { rule, beneath, by }| {
        let (place, beneath) = (place(by), standing(beneath));
        Finding::note(match by {
            Instead::Rule(_) => format!("rule \"{rule}\" ({place}) replaces the one beneath it ({beneath})"),
            Instead::Without { .. } => {
                format!("the rules go without \"{rule}\" ({beneath}), as {place} says")
            }
        })
    });
    let same = same.split_first().map(|(first, more)| {
        let (rule, place) = (&first.rule, place(&first.by));
        let others = match more.len() {
            0 => {
                return Finding::note(format!(
                    "\"{rule}\" ({place}) says what the rule beneath it says: without it that one counts, and so do later versions of that one"
                ));
            }
            1 => "one more".to_owned(),
            more => format!("{more} more"),
        };
        Finding::note(format!(
            "\"{rule}\" ({place}) and {others} say what the rules beneath them say: without them those count, and so do later versions of those"
        ))
    });
    said.chain(same).collect()
}

pub(super) fn standing(standing: &Standing) -> String {
    format!("{}, line {}", standing.file, standing.line)
}

pub(super) fn place(by: &Instead) -> String {
    match by {
        Instead::Rule(by) => standing(by),
        Instead::Without { file, line } => format!("{file}, line {line}"),
    }
}

fn listed(variables: &[String]) -> String {
    let quoted: Vec<String> = variables.iter().map(|variable| format!("`{variable}`")).collect();
    match quoted.split_last() {
        Some((last, before)) if !before.is_empty() => format!("{} or {last}", before.join(", ")),
        _ => quoted.concat(),
    }
}

/// The rows of tables that a rule can never choose: one warning for each row and rule, though several of its clauses may
/// never choose it.
pub fn never_chosen(dominated: &[Dominated]) -> Vec<Finding> {
    let mut places = BTreeMap::new();
    let mut found: Vec<(&Dominated, Vec<String>)> = Vec::new();
    for one in dominated {
        let place = *places.entry((&one.rule, &one.class, &one.key, &one.by)).or_insert(found.len());
        match found.get_mut(place) {
            Some((_, variables)) => variables.push(one.variable.clone()),
            None => found.push((one, vec![one.variable.clone()])),
        }
    }
    let warning = |(Dominated { rule, class, key, by, .. }, variables): (&Dominated, Vec<String>)| {
        let variables = listed(&variables);
        let message = format!(
            "{class} {key} can never be {variables} in rule \"{rule}\": {by} comes before it, and fits wherever it fits"
        );
        let help =
            format!("one of the two is out of place: make {key} better or easier to fit, or {by} worse");
        Finding::warning(Code::RuleNeverChosen, message, Some(help))
    };
    found.into_iter().map(warning).collect()
}

/// Texts that rules ask for and that were probably meant to be others.
pub fn misspelt(misspelt: &[Misspelt]) -> impl Iterator<Item = Finding> {
    misspelt.iter().map(|one| Finding::warning(Code::RuleUnknownText, one.to_string(), None))
}

/// Cells that name a row of another table, where there is none.
pub fn unmet(unmet: &[Unmet]) -> impl Iterator<Item = Finding> {
    unmet.iter().map(|one| Finding::warning(Code::TableUnknownRow, one.to_string(), None))
}
