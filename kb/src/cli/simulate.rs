//! `adit simulate`: missions of a simulated robot on a floor plan.

use std::any::Any;
use std::path::Path;

use adit_db::Store;
use adit_planners::geometry::Point;
use adit_planners::navigation::Mission;
use adit_planners::pose::Pose;

use super::args::{SimulateArgs, SiteArgs, heading};
use super::build::open;
use super::missions::{are_right, filmed, last_mission, show};
use super::output::{either, remark};
use super::picture::extension;
use crate::answer::pick;
use crate::error::{Code, Error, Result};
use crate::knowledge::KnowledgeBase;
use crate::live::Live;
use crate::navigation::course::{FloorOf, OfRobot};
use crate::navigation::floor::Floor;
use crate::navigation::journal::record;
use crate::navigation::judge::Judges;
use crate::navigation::learning;
use crate::navigation::missions::{Row, Stage, drawn, journalled, noted, refuse, run as run_all};
use crate::navigation::reporting::{Reporting, Reports};
use crate::navigation::tours::drive;
use crate::site::base::Base;
use crate::site::whole::{self, Whole};
use crate::words::progress::Bar;

/// Runs missions and prints a row each; `false` where one ended otherwise than it should.
pub fn run(args: &SimulateArgs) -> Result<bool> {
    check_film(args)?;
    let site = SiteArgs { site: args.site.clone(), db: None, rules: args.rules.clone(), json: args.json };
    let live = Live::open(open(&site)?)?;
    let args = &in_own(args, live.site())?;
    if live.site().course().is_none() {
        return super::routed::run(args, live);
    }
    if args.robots.is_some() {
        let message = "--robots is for sites whose rooms are cut by state; on a floor plan one robot drives";
        return Err(Error::said(Code::SimulateNoFloorPlan, message, None));
    }
    if args.tell {
        return told(args, live);
    }
    let asked = live.asked();
    let (robot, floor) = &of_robot(&live, args.robot.as_deref())?;
    let (world, rules) = (&floor.plan.name, rules_of(live.site()));
    if let Some(output) = &args.curve {
        let judges = Judges::new(&asked, &floor.told)?;
        let drives = |far_m, seeds, first| drive(floor, &judges, far_m, seeds, first);
        super::curve::run(args, (world, output), drives)?;
        return Ok(true);
    }
    if let Some(start) = &args.learn {
        return super::learn::run(args, start, (floor, &rules), &asked);
    }
    let learned = if args.learned { Some(learned(args, world, floor)?) } else { None };
    if let Some(script) = &args.drive {
        return match learned {
            Some((stored, known)) => super::learn::drive(args, script, (stored, floor, &known), &asked),
            None => Err(Error::said(Code::SimulateDrive, "--drive goes with --learned and --db", None)),
        };
    }
    let known = learned.as_ref().map_or(floor, |(_, known)| known);
    let judges = Judges::new(&asked, &known.told)?;
    let stage = match &learned {
        Some((_, known)) => Stage::learned(floor, known, learning::START_SIGMA_M, &judges)?,
        None => Stage::new(floor, &judges)?,
    };
    let missions = missions(args, floor, known)?;
    let filmed = filmed(args, &missions)?;
    let rows = if let Some(db) = &args.db {
        kept((world, &rules, robot), &stage, &judges, &missions, (db, args.keep))?
    } else {
        let bar = Bar::new("missions", missions.len() as u64);
        run_all(&stage, &judges, &missions, || bar.step())?
    };
    if let (Some(film), Some(mission)) = (&args.film, filmed) {
        let mut made = None;
        journalled(&stage, &judges, (args.mission, mission), Some(&mut made))?;
        if let Some(made) = made {
            whole::write(film, made.svg(args.speed).as_bytes())?;
            remark(&format!("{}: mission {}", film.display(), args.mission));
        }
    }
    either(args.json, &rows[..], show)?;
    Ok(are_right(&rows))
}

/// The arguments with the site's own database, where what comes of it is kept there, or what was learned stands there.
fn in_own(args: &SimulateArgs, site: &KnowledgeBase) -> Result<SimulateArgs> {
    if args.keep {
        site.needs_folder()?;
    }
    let own = site.database().to_owned();
    let db = if args.keep { Some(own.clone()) } else { args.db.clone() };
    let learned_in = db.clone().or_else(|| (args.learned && !site.is_map_alone()).then_some(own));
    Ok(SimulateArgs { db, learned_in, ..args.clone() })
}

/// Runs missions one after the other, and tells the site what the robot meets.
fn told(args: &SimulateArgs, mut live: Live) -> Result<bool> {
    live.site().needs_folder()?;
    let (robot, floor) = of_robot(&live, args.robot.as_deref())?;
    let rules = rules_of(live.site());
    let missions = missions(args, &floor, &floor)?;
    let mut store = args.db.as_ref().map(Store::open_for_worlds).transpose()?;
    let before = match &mut store {
        Some(store) if args.keep => store.snapshot(|tx| last_mission(tx, &floor.plan.name))?,
        _ => 0,
    };
    let bar = Bar::new("missions", missions.len() as u64);
    let (mut rows, mut said) = (Vec::with_capacity(missions.len()), Vec::new());
    for mission in (before + 1..).zip(&missions) {
        let (_, floor) = of_robot(&live, Some(&robot))?;
        let stage = Stage::new(&floor, &Judges::new(&live.asked(), &floor.told)?)?;
        let reports = Reports::default();
        let plan = |live: &Live, robot: &str| Ok(of_robot(live, Some(robot))?.1);
        let mut judge = Reporting::new(&mut live, &reports, plan, (&robot, mission.0))?;
        let (row, entries, decided_by) =
            noted(&stage, &mut judge, mission, |entry| reports.hear(entry), None)?;
        refuse(judge.trouble())?;
        said.append(&mut judge.said);
        if let Some(store) = &mut store {
            let record = record((&floor.plan.name, &rules, &robot), &row, &[], &entries, decided_by);
            store.transaction(|tx| tx.keep_mission(&record))?;
        }
        rows.push(row);
        bar.step();
    }
    drop(bar);
    either(args.json, &rows[..], show)?;
    for text in &said {
        remark(text);
    }
    Ok(are_right(&rows))
}

/// The robot that is asked for, and its floor plan.
pub(super) fn of_robot(live: &Live, robot: Option<&str>) -> Result<(String, Floor)> {
    let course = live.site().course().map(|course| &**course as &dyn Any);
    let Some(map) = course.and_then(|course| course.downcast_ref::<FloorOf>()) else {
        let message = format!(
            "the map of {} has no [floor_plan]: there is nothing to simulate",
            live.site().site().name
        );
        return Err(Error::said(Code::SimulateNoFloorPlan, message, None));
    };
    let floors = map.floors(&live.asked())?;
    let robots: Vec<String> = floors.iter().map(|of| of.robot.clone()).collect();
    let robot = pick(&robots, robot)?;
    match floors.into_iter().find(|of| of.robot == robot) {
        Some(OfRobot { floor, unfit: None, .. }) => Ok((robot, floor)),
        Some(OfRobot { unfit: Some(unfit), .. }) => Err(Error::said(Code::SimulateImpossible, unfit, None)),
        None => Err(Error::said(Code::SimulateImpossible, "there is no robot", None)),
    }
}

/// The rule bases of a site, one a line, the lowest first: missions keep by which rules they were done.
pub(super) fn rules_of(site: &KnowledgeBase) -> String {
    site.rule_bases().iter().map(Base::name).collect::<Vec<_>>().join("\n")
}

/// Refuses a film that cannot be made.
fn check_film(args: &SimulateArgs) -> Result<()> {
    let Some(film) = &args.film else { return Ok(()) };
    if extension(film) != "svg" {
        let message = format!("{} is no .svg; a film is an SVG that plays", film.display());
        return Err(Error::said(Code::SimulateFilm, message, None));
    }
    if !(args.speed.is_finite() && args.speed > 0.0) {
        let message =
            format!("a film cannot play {} times as fast as time; expected more than 0", args.speed);
        return Err(Error::said(Code::SimulateSpeed, message, None));
    }
    Ok(())
}

/// Runs missions one after the other, each kept with its journal.
fn kept(
    (world, rules, robot): (&str, &str, &str),
    stage: &Stage<'_>,
    judges: &Judges,
    missions: &[Mission],
    (db, goes_on): (&Path, bool),
) -> Result<Vec<Row>> {
    let mut made = Whole::default();
    made.database(db);
    let mut store = Store::open_for_worlds(db)?;
    let last = store.snapshot(|tx| last_mission(tx, world))?;
    // on a site they go on being numbered
    let before = if goes_on { last } else { 0 };
    let written_anew = last.min(missions.len());
    if written_anew > 0 && !goes_on {
        let what = format!("missions of {world} from an earlier run are written anew, 1 to {written_anew}");
        remark(&format!("{}: {what}", db.display()));
    }
    let bar = Bar::new("missions", missions.len() as u64);
    let mut rows = Vec::with_capacity(missions.len());
    for (index, mission) in missions.iter().enumerate() {
        let (row, entries, decided_by) = journalled(stage, judges, (before + index + 1, mission), None)?;
        let record = record((world, rules, robot), &row, &[], &entries, decided_by);
        store.transaction(|tx| tx.keep_mission(&record))?;
        // what was kept stays, whatever comes of the next one
        std::mem::take(&mut made).keep();
        rows.push(row);
        bar.step();
    }
    Ok(rows)
}

/// What was learned of the world, from the database.
fn learned(args: &SimulateArgs, world: &str, floor: &Floor) -> Result<(adit_db::learned::Learned, Floor)> {
    let Some(db) = &args.learned_in else {
        return Err(Error::said(
            Code::SimulateLearned,
            "--learned goes with --db: the building stands there",
            None,
        ));
    };
    let stored = Store::open(db)?.transaction(|tx| tx.learned(world))?;
    let Some(stored) = stored else {
        let message = format!("{} has no building that was learned of the world `{world}`", db.display());
        let help = "learn it first: `adit simulate WORLD --learn START --keep`, or with --db FILE instead"
            .to_owned();
        return Err(Error::said(Code::SimulateNotLearned, message, Some(help)));
    };
    let known = learning::known(&stored, floor)?;
    Ok((stored, known))
}

/// The missions that are drawn, or the one from START to GOAL: places as the robot knows them, else as the world has them.
fn missions(args: &SimulateArgs, floor: &Floor, known: &Floor) -> Result<Vec<Mission>> {
    let (Some(start), Some(goal)) = (&args.start, &args.goal) else {
        return drawn(floor, args.missions as usize, (args.seed, args.kidnap));
    };
    let point = |text: &str| known.point(text).or_else(|_| floor.point(text));
    let (start, goal) = (point(start)?, point(goal)?);
    may_begin(floor, start)?;
    let heading = heading(args.heading)?;
    let mission = |seed| Mission::between(Pose { at: start, heading }, goal, seed);
    Ok((0..u64::from(args.missions)).map(|number| mission(args.seed.wrapping_add(number))).collect())
}

/// Refuses a start that is none.
pub(super) fn may_begin(floor: &Floor, start: Point) -> Result<()> {
    if floor.plan.is_free(start) {
        return Ok(());
    }
    let message = format!(
        "no robot can begin at ({:?}, {:?}): that is outside of the plan, or in a wall",
        start.x, start.y
    );
    Err(Error::said(Code::SimulateImpossible, message, None))
}
