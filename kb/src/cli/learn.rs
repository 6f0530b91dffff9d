//! `adit simulate --learn` and `--drive`: a robot that learns a building, and one that is driven by hand in it.

use std::io::Read;
use std::path::Path;

use adit_db::Store;
use adit_db::learned::Learned as Record;
use adit_planners::geometry::Segment;
use adit_planners::navigation::learn::Exploration;
use adit_planners::navigation::{Outfit, drive as drive_by};
use adit_planners::pose::Pose;
use serde_json::json;

use super::args::{SimulateArgs, heading};
use super::output::{either, json as print, line, remark, table};
use crate::error::{Code, Error, Result};
use crate::navigation::drive::parse;
use crate::navigation::floor::Floor;
use crate::navigation::judge::RuleJudge;
use crate::navigation::keep;
use crate::navigation::learning::{Row, START_SIGMA_M, explore, known};
use crate::navigation::missions::{ended, ending, refuse};
use crate::plan::course::Asked;
use crate::site::whole::{self, Whole};
use crate::words::number::number;

/// Learns a world, keeps and prints what came of it; `false` where that is not as it should be.
pub fn run(
    args: &SimulateArgs,
    start: &str,
    (floor, rules): (&Floor, &str),
    asked: &Asked<'_>,
) -> Result<bool> {
    let world = floor.plan.name.as_str();
    let start = Pose { at: floor.point(start)?, heading: heading(args.heading)? };
    if !floor.plan.is_free(start.at) {
        let message = format!(
            "no robot can begin at ({:?}, {:?}): that is outside of the plan, or in a wall",
            start.at.x, start.at.y
        );
        return Err(Error::said(Code::SimulateImpossible, message, None));
    }
    let towards = args.towards.as_ref().map(|towards| floor.point(towards)).transpose()?;
    let exploration = Exploration { start, towards, seed: args.seed };
    let mut made = None;
    let film = args.film.as_ref().map(|_| &mut made);
    let mut guide = RuleJudge::of_mission(asked, &floor.told)?;
    let (row, record) = explore((world, rules), floor, &mut guide, &exploration, film)?;
    if let (Some(file), Some(made)) = (&args.film, &made) {
        whole::write(file, made.svg(args.speed).as_bytes())?;
        remark(&format!("{}: how it was learned", file.display()));
    }
    if let Some(db) = &args.db {
        let mut made = Whole::default();
        made.database(db);
        let named = Store::open_for_worlds(db)?.snapshot(|tx| tx.learned(world))?;
        if let Some(named) = named.filter(|learned| !learned.places.is_empty()) {
            let names: Vec<&str> = named.places.iter().map(|(name, _)| name.as_str()).collect();
            let message = "places that were named in what was learned before are gone";
            remark(&format!("{}: {message}: {}", db.display(), names.join(", ")));
        }
        keep_learned(db, &record, floor, asked)?;
        made.keep();
    } else {
        remark("nothing of what was learned is kept without --keep or --db");
    }
    either(args.json, &row, show)?;
    Ok(row.is_right())
}

/// Keeps what was learned, and the network of places over it.
fn keep_learned(db: &Path, record: &Record, floor: &Floor, asked: &Asked<'_>) -> Result<()> {
    let known = known(record, floor)?;
    let mut judge = RuleJudge::of_mission(asked, &known.told)?;
    let network = keep::record(&record.learned, &record.rules, &known, &mut judge);
    refuse(judge.trouble())?;
    Store::open_for_worlds(db)?.transaction(|tx| {
        tx.keep_learned(record)?;
        tx.keep_floor_plan(&network)
    })?;
    Ok(())
}

fn show(row: &Row) {
    let of = |[median, most, worst]: [f64; 3]| format!("{median:.3}, {most:.3}, {worst:.3}");
    let percent = |share: f64| format!("{:.1} %", 100.0 * share);
    let rows = [
        ("ending", row.ending.to_owned()),
        ("metres driven", number(row.length)),
        ("seconds", format!("{:.0}", row.seconds)),
        ("looks around", row.looks.to_string()),
        ("touches", row.touches.to_string()),
        ("worst error of position", format!("{:.3}", row.worst_error)),
        ("free space learned", percent(row.share)),
        ("square metres beyond walls", format!("{:.3}", row.outside_area)),
        ("deepest beyond walls", format!("{:.3}", row.outside)),
        ("learned walls off true ones", of(row.walls_off)),
        ("true walls off learned ones", of(row.walls_missed)),
        ("walls", row.walls.to_string()),
        ("regions", row.regions.to_string()),
    ];
    table(&["", ""], rows.map(|(what, value)| vec![what.to_owned(), value]));
    if row.collided {
        line("COLLIDED");
    }
}

/// Drives by hand in a learned building, and keeps the places that are named; `false` where an order could not be done.
pub fn drive(
    args: &SimulateArgs,
    script: &Path,
    (mut stored, truth, learned): (Record, &Floor, &Floor),
    asked: &Asked<'_>,
) -> Result<bool> {
    let text = if script == Path::new("-") {
        let mut text = String::new();
        std::io::stdin().read_to_string(&mut text).map(|_| text)
    } else {
        std::fs::read_to_string(script)
    };
    let text = text.map_err(|error| Error::io("read", script, &error))?;
    let name = script.display().to_string();
    let script = parse(&name, &text, [learned, truth])?;
    let walls: Vec<Segment> = truth.plan.barriers().into_iter().map(Segment::from).collect();
    let outfit = Outfit { start_sigma_m: START_SIGMA_M, ..truth.driving.outfit(truth.network.disc.radius) };
    let mut judge = RuleJudge::of_mission(asked, &learned.told)?;
    let building = learned.building();
    let from = (script.start, args.seed);
    let driven = drive_by(&script.orders, from, &walls, &building, &outfit, &mut judge, |_| {})
        .map_err(Error::of(Code::SimulateImpossible))?;
    refuse(judge.trouble())?;
    for place in &driven.places {
        stored.places.retain(|(name, _)| *name != place.name);
        stored.places.push((place.name.clone(), [place.at.x, place.at.y]));
    }
    if let Some(db) = args.learned_in.as_ref().filter(|_| !driven.places.is_empty()) {
        keep_learned(db, &stored, truth, asked)?;
    }
    let in_vain = driven.in_vain.map(|(index, how)| (script.lines[index], ending(how)));
    let pose = |pose: &Pose| [pose.at.x, pose.at.y, pose.heading.to_degrees()];
    if args.json {
        let places: Vec<_> = driven
            .places
            .iter()
            .map(|place| json!({"place": place.name, "at": [place.at.x, place.at.y]}))
            .collect();
        print(&json!({
            "estimate": pose(&driven.estimate), "truth": pose(&driven.truth), "length": driven.path_m,
            "touches": driven.touches, "places": places,
            "in_vain": in_vain.map(|(line, ending)| json!({"line": line, "ending": ending})),
        }))?;
    } else {
        for place in &driven.places {
            line(&format!("place {} at ({}, {})", place.name, number(place.at.x), number(place.at.y)));
        }
        let [x, y, heading] = pose(&driven.estimate);
        line(&format!(
            "{} m driven, {} touches; at ({}, {}), heading {}",
            number(driven.path_m),
            driven.touches,
            number(x),
            number(y),
            number(heading)
        ));
        if let Some((number, ending)) = in_vain {
            let how = ended(ending);
            line(&format!("{name}:{number}: the robot {how}; the orders after it were not followed"));
        }
    }
    Ok(in_vain.is_none())
}
