//! `adit simulate` on a site whose rooms are cut by state: a robot that changes its shape drives the site's own routes.

use adit_db::Store;
use adit_planners::geometry::Point;
use adit_planners::navigation::Mission;
use adit_planners::simulator::Film;

use super::args::{SimulateArgs, heading};
use super::missions::{filmed, last_mission, show};
use super::output::{either, remark};
use crate::error::{Code, Error, Result};
use crate::fit::Row as Traversal;
use crate::live::Live;
use crate::navigation::ground::Ground;
use crate::navigation::journal::record;
use crate::navigation::missions::Row;
use crate::navigation::routed::Missions;
use crate::plan::rules::{Kind, load_over};
use crate::site::base::Base;
use crate::site::whole;
use crate::words::progress::Bar;

/// Drives missions and prints a row each; `false` where one ended otherwise than it should.
pub fn run(args: &SimulateArgs, mut live: Live) -> Result<bool> {
    check(args)?;
    if args.tell {
        live.site().needs_folder()?;
    }
    let ground = Ground::of(&live.fork(), args.robot.as_deref())?;
    let (rules, bases, remarks) = load_over(Kind::Navigation, &live.site().site().folder)?;
    for text in &remarks {
        remark(text);
    }
    let bases = bases.iter().map(Base::name).collect::<Vec<_>>().join("\n");
    let name = live.site().site().name.clone();
    let mut on = Missions { live: &mut live, ground: &ground, rules: &rules, tells: args.tell };
    let missions = missions(args, &on)?;
    let wanted = filmed(args, &missions)?.is_some();
    let mut store = args.db.as_ref().map(Store::open_for_worlds).transpose()?;
    let before = match &mut store {
        Some(store) => store.snapshot(|tx| last_mission(tx, &name))?,
        None => 0,
    };
    let bar = Bar::new("missions", missions.len() as u64);
    let (mut rows, mut said, mut film): (Vec<Row>, Vec<String>, Option<Film>) = Default::default();
    for (index, mission) in missions.iter().enumerate() {
        let is_filmed = wanted && index + 1 == args.mission;
        let ((row, entries, decided), told) =
            on.run((before + index + 1, mission), is_filmed.then_some(&mut film))?;
        said.extend(told);
        if let Some(store) = &mut store {
            let record = record((&name, &bases), &row, &ground.states, &entries, decided);
            store.transaction(|tx| tx.keep_mission(&record))?;
        }
        // who is not kept has no number of its own, by which what was measured is told apart
        if args.keep {
            let author = adit_db::history::Author { who: ground.robot.clone(), why: String::new() };
            on.live.site().add_traversals(
                &traversals(&name, &ground.robot, &row),
                Some("seconds"),
                &author,
            )?;
        }
        rows.push(row);
        bar.step();
    }
    drop(bar);
    if let (Some(path), Some(film)) = (&args.film, film) {
        whole::write(path, film.svg(args.speed).as_bytes())?;
        remark(&format!("{}: mission {}", path.display(), args.mission));
    }
    either(args.json, &rows[..], show)?;
    for text in &said {
        remark(text);
    }
    Ok(rows.iter().all(|row| row.right != Some(false) && !row.collided))
}

/// What the robot measured on its way, as `adit fit` reads it.
fn traversals(site: &str, robot: &str, row: &Row) -> Vec<Traversal> {
    let of_state = |(state, metres): (&String, &f64)| Traversal {
        mission: Some(format!("simulated mission {} of {site}", row.mission)),
        robot: Some(robot.to_owned()),
        state: Some(state.clone()),
        distance: *metres,
        measured: row.seconds,
        ..Traversal::default()
    };
    row.by_state.iter().map(of_state).collect()
}

/// The missions that are drawn, or the one from START to GOAL.
fn missions(args: &SimulateArgs, on: &Missions<'_>) -> Result<Vec<Mission>> {
    let (Some(start), Some(goal)) = (&args.start, &args.goal) else {
        return on.drawn(args.missions as usize, args.seed);
    };
    let heading = heading(args)?;
    let ends = [point(on, start)?, point(on, goal)?];
    Ok((0..u64::from(args.missions))
        .map(|number| on.between(ends, heading, args.seed.wrapping_add(number)))
        .collect())
}

/// A place by its name, or a point `x,y`.
fn point(on: &Missions<'_>, name: &str) -> Result<Point> {
    let view = on.live.view();
    let graph = view.graph();
    let end = graph.end(name).ok_or_else(|| {
        let help =
            crate::words::suggest::did_you_mean(name, graph.places.iter().map(|place| place.place.as_str()));
        Error::said(
            Code::PlanUnknownPlace,
            format!("`{name}` is no place of the site, and no point `x,y`"),
            help,
        )
    })?;
    Ok(graph.point(&end))
}

/// Refuses what is for maps of walls alone.
fn check(args: &SimulateArgs) -> Result<()> {
    let asked = [
        ("--learn", args.learn.is_some()),
        ("--learned", args.learned),
        ("--drive", args.drive.is_some()),
        ("--curve", args.curve.is_some()),
    ];
    let Some((flag, _)) = asked.into_iter().find(|(_, is_asked)| *is_asked) else { return Ok(()) };
    let message = format!(
        "{flag} is for maps with `[floor_plan]`; this site is cut into rooms, whose routes are driven"
    );
    Err(Error::said(Code::SimulateNoFloorPlan, message, None))
}
