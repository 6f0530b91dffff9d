//! `adit build`, and what it and `tune` print of a report.

use adit_db::Cell;
use clap::Args;

use super::args::{SiteArgs, author};
use super::output::{json, line, maybe, number, remark, time};
use crate::error::Result;
use crate::knowledge::KnowledgeBase;
use crate::live::report::{Change, Concluded, Remeasured, Report, RouteChange};
use crate::site::robots::ONLY_ROBOT;
use crate::words::number::counted;
use crate::words::progress::{Silent, Spinner};

#[derive(Args, Debug)]
pub struct BuildArgs {
    #[command(flatten)]
    pub site: SiteArgs,
    /// Take tables from their files again, instead of the database's: all of them, or these alone
    #[arg(long, value_name = "TABLES", num_args = 0.., value_delimiter = ',', require_equals = true)]
    pub reseed: Option<Vec<String>>,
    /// As if it were this time: `2026-11-21T18:00`, `18:00`, `2h`
    #[arg(long, value_name = "TIME")]
    pub at: Option<String>,
}

/// Opens a site as the arguments say. A map alone is built.
pub fn open(args: &SiteArgs) -> Result<KnowledgeBase> {
    let knowledge = unbuilt(args)?;
    if knowledge.is_map_alone() {
        notes(&knowledge.build(&Silent)?);
    }
    Ok(knowledge)
}

/// Opens a site as the arguments say, built or not.
pub fn unbuilt(args: &SiteArgs) -> Result<KnowledgeBase> {
    let knowledge = KnowledgeBase::open(&args.site)?;
    Ok(knowledge.with_database(args.db.as_deref()).with_rules(args.rules.as_deref()))
}

/// Where nothing has a name.
const NOTHING_KEPT: &str = "no routes are kept: `[[place]]` in site.toml names the points that matter";

pub fn run(args: &BuildArgs) -> Result<()> {
    let knowledge = unbuilt(&args.site)?.at(args.at.as_deref())?;
    let knowledge = match &args.reseed {
        Some(tables) if !knowledge.is_map_alone() => {
            knowledge.reseeding(author("tables as their files have them"), tables)
        }
        _ => knowledge,
    };
    let report = {
        let spinner = Spinner::new();
        knowledge.build(&spinner)?
    };
    if args.site.json {
        notes(&report);
        return json(&report.json());
    }
    show(&knowledge, &report);
    Ok(())
}

pub fn show(knowledge: &KnowledgeBase, report: &Report) {
    let (name, values, generation) = (&knowledge.site().name, report.concluded, report.generation);
    if let Some(map) = &report.course {
        let starts = counted(report.routes.starts, "start");
        line(&format!("{name}: {map}, routes from {starts} (generation {generation})"));
        reacted(report);
        return notes(report);
    }
    if !knowledge.site().has_rooms() {
        line(&format!("{name}: {} concluded (generation {generation})", counted(values, "value")));
        reacted(report);
        return notes(report);
    }
    let routes = &report.routes;
    line(&format!(
        "{name}: {}, {}, cut into {}, {}; routes from {} (generation {generation})",
        counted(report.spaces, "space"),
        counted(report.doorways, "doorway"),
        counted(report.rooms.total, "room"),
        counted(report.doors.total, "door"),
        counted(routes.starts, "start"),
    ));
    if routes.starts == 0 {
        remark(&format!("note: {NOTHING_KEPT}"));
    }
    free_space(report);
    let stages: Vec<String> = report
        .stages
        .iter()
        .map(|stage| {
            format!("{} {}", stage.name, if stage.kept { "kept".to_owned() } else { time(stage.took) })
        })
        .collect();
    line(&format!("  {}", stages.join(", ")));
    reacted(report);
    notes(report);
}

/// What the way in which the map is read cost or gave, where it did.
fn free_space(report: &Report) {
    let map = &report.map;
    let mut parts = Vec::new();
    for (what, area) in [
        ("unknown", map.unknown),
        ("specks", map.specks),
        ("walls made straight", map.straightened),
        ("clearance", map.clearance),
    ] {
        if area.abs() >= 0.005 {
            let verb = if area > 0.0 { "gave" } else { "cost" };
            parts.push(format!("{what} {verb} {} m²", number(area.abs())));
        }
    }
    if map.unknown_in_file > 0.0 && map.unknown == 0.0 {
        parts.push(format!("{} m² are unknown and count as wall", number(map.unknown_in_file)));
    }
    let more = if parts.is_empty() { String::new() } else { format!(": {}", parts.join(", ")) };
    line(&format!("  free space {} m²{more}", number(map.free)));
}

/// What the expert should know.
pub fn notes(report: &Report) {
    for note in report.notes.iter().chain(&report.lost).chain(&report.gaps) {
        remark(&format!("note: {note}"));
    }
}

/// What rules that react told.
fn reacted(report: &Report) {
    for said in report.reacted.iter().take(LISTED) {
        line(said);
    }
    if report.reacted.len() > LISTED {
        line(&format!("and {} more that rules told; `adit history` has all", report.reacted.len() - LISTED));
    }
}

/// What rules say otherwise of other things than rooms and doors.
fn conclusions(report: &Report) {
    let said = |cell: &Cell| match cell {
        Cell::Null => "nothing".to_owned(),
        // of what rules conclude, truth values alone are kept as whole numbers
        Cell::Integer(truth) => if *truth == 0 { "no" } else { "yes" }.to_owned(),
        Cell::Real(value) => number(*value),
        other => other.to_string(),
    };
    // that doorways are closed is said as such
    let is_said = |of: &&Concluded| {
        of.what.starts_with("doorways ") && of.property == "closed" && !report.closings.is_empty()
    };
    let listed: Vec<&Concluded> = report.conclusions.iter().filter(|of| !is_said(of)).collect();
    for Concluded { what, property, old, new } in listed.iter().take(LISTED) {
        line(&format!("{what}: {property} {} → {}", said(old), said(new)));
    }
    if listed.len() > LISTED {
        line(&format!("and {} more", listed.len() - LISTED));
    }
    let has_rooms = report.rooms.total > 0 || report.cut_anew;
    if report.conclusions.is_empty() && !has_rooms && report.course.is_none() {
        line("no rule concludes anything else than before");
    }
}

/// How many rooms and doors are listed one by one.
const LISTED: usize = 10;

/// What became otherwise, but for closings that were said already.
pub fn changes(said: &str, report: &Report) {
    reacted(report);
    conclusions(report);
    if report.rooms.total == 0 && !report.cut_anew && report.course.is_none() {
        return notes(report);
    }
    if report.course.is_some() {
        // there are no rooms that could change
    } else if report.cut_anew && report.rooms.total == 0 {
        line("no room is left: no state fits anywhere on the map");
    } else if report.cut_anew {
        line(&format!(
            "the rooms were cut anew: {}, {}",
            counted(report.rooms.total, "room"),
            counted(report.doors.total, "door")
        ));
    } else if report.rooms.changed + report.doors.changed > 0 || report.closings.is_empty() {
        let both = [(report.rooms.changed, "room"), (report.doors.changed, "door")];
        let changed: Vec<String> = both
            .into_iter()
            .filter(|(count, _)| *count > 0)
            .map(|(count, what)| counted(count, what))
            .collect();
        match &changed[..] {
            [] if report.measures.is_empty() => line("no room or door changed"),
            [] => {}
            some => line(&format!("{} changed", some.join(" and "))),
        }
        for change in report.changes.iter().take(LISTED) {
            line(&format!("  {}: {}", change.what, turned(change)));
        }
        if report.changes.len() > LISTED {
            line(&format!("  and {} more", report.changes.len() - LISTED));
        }
    }
    for (measure, Remeasured { rooms, doors }) in &report.measures {
        let of = match (rooms, doors) {
            (_, 0) => format!("in {}", counted(*rooms, "room")),
            (0, _) => format!("at {}", counted(*doors, "door")),
            _ => format!("in {} and at {}", counted(*rooms, "room"), counted(*doors, "door")),
        };
        line(&format!("{measure} changed {of}; `adit route` adds them up"));
    }
    let is_new = |closing: &&String| !said.starts_with(closing.as_str());
    let closings: Vec<&String> = report.closings.iter().filter(is_new).collect();
    for closing in closings.iter().take(LISTED) {
        line(closing);
    }
    if closings.len() > LISTED {
        line(&format!("and {} more", closings.len() - LISTED));
    }
    line(&of_routes(report));
    let several = report.robots > 1
        || report.routes.changes.iter().any(|change| change.robot != report.routes.changes[0].robot)
        || report.course.is_some() && report.routes.changes.iter().any(|change| change.robot != ONLY_ROBOT);
    for change in report.routes.changes.iter().take(LISTED) {
        let are_both = change.old.is_some() && change.new.is_some();
        let way = if are_both && change.other_way == Some(true) { ", another way" } else { "" };
        let whose = if several { format!(" ({})", change.robot) } else { String::new() };
        let cost = |cost: Option<f64>| cost.map_or("no route".to_owned(), number);
        let (old, new) = (cost(change.old), cost(change.new));
        if report.course.is_some() && is_driven_otherwise(change) {
            line(&format!("  {} to {}{whose}: {old}, driven otherwise", change.start, change.goal));
            continue;
        }
        line(&format!("  {} to {}{whose}: {old} → {new}{way}", change.start, change.goal));
    }
    if report.routes.changes.len() > LISTED {
        line(&format!("  and {} more between places", report.routes.changes.len() - LISTED));
    }
    let (routes, places) = (&report.routes, report.routes.changes.len());
    let counted = routes.shorter + routes.longer + routes.lost + routes.found;
    if !routes.between_places && places > 0 && counted > places {
        line(&format!("  and {} more to rooms", counted - places));
    }
    notes(report);
}

/// What became of the routes that are kept, in a sentence.
fn of_routes(report: &Report) -> String {
    let routes = &report.routes;
    let starts = counted(routes.starts, "start");
    let Some(rerouted) = routes.rerouted else {
        // over other maps they were not compared
        let is_same = routes.changes.is_empty() && report.course.is_none();
        let same = if is_same { "; between places none costs anything else" } else { "" };
        return format!("routes from {starts} were made anew{same}");
    };
    if routes.starts == 0 {
        return NOTHING_KEPT.to_owned();
    }
    let is_otherwise = |change: &&RouteChange| report.course.is_some() && is_driven_otherwise(change);
    let otherwise = routes.changes.iter().filter(is_otherwise).count();
    let among = if routes.between_places { "between places".to_owned() } else { format!("from {starts}") };
    let kinds = [
        (routes.shorter, "costs less", "cost less"),
        (routes.longer, "costs more", "cost more"),
        (rerouted, "leads another way", "lead another way"),
        (routes.lost, "is lost", "are lost"),
        (routes.found, "is possible again", "are possible again"),
        (otherwise, "is driven otherwise", "are driven otherwise"),
    ];
    let said = kinds.iter().filter(|(count, ..)| *count > 0);
    let said: Vec<String> =
        said.map(|(count, one, more)| format!("{count} {}", if *count == 1 { one } else { more })).collect();
    match said.as_slice() {
        [] if routes.between_places => {
            "no route between places costs anything else or leads another way".to_owned()
        }
        [] => "no route costs anything else or leads another way".to_owned(),
        [only] => format!("of the routes {among}, {only}"),
        [first @ .., last] => format!("of the routes {among}, {} and {last}", first.join(", ")),
    }
}

/// What of a room or door is otherwise: its hardness, its action, whether it lets through.
fn turned(change: &Change) -> String {
    let mut parts = Vec::new();
    let state = |passable: Option<bool>| match passable {
        Some(true) => "open",
        Some(false) => "closed",
        None => "undecided",
    };
    if change.old_passable != change.new_passable {
        parts.push(format!("{} → {}", state(change.old_passable), state(change.new_passable)));
    }
    let (old, new) = (maybe(change.old), maybe(change.new));
    if old != new || parts.is_empty() && change.old_action == change.new_action {
        parts.push(format!("{old} → {new}"));
    }
    if change.old_action != change.new_action {
        let [old, new] =
            [&change.old_action, &change.new_action].map(|of| of.as_deref().unwrap_or("no action"));
        parts.push(format!("{old} → {new}"));
    }
    parts.join(", ")
}

/// Whether a route costs what it did and leads where it did, by other points.
fn is_driven_otherwise(change: &RouteChange) -> bool {
    change.other_way != Some(true) && change.old.map(number) == change.new.map(number)
}
