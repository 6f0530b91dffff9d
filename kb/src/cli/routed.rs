//! `adit simulate` on a site whose rooms are cut by state: a robot that changes its shape drives the site's own routes.

use std::sync::Arc;

use adit_engine::RuleBase;
use adit_planners::geometry::Point;
use adit_planners::navigation::Mission;
use adit_planners::simulator::Film;

use super::args::{SimulateArgs, heading};
use super::kept::{Kept, Of};
use super::missions::{are_right, filmed, show};
use super::output::{either, remark};
use crate::edit::Errand;
use crate::error::{Code, Error, Result};
use crate::live::Live;
use crate::navigation::ground::Ground;
use crate::navigation::missions::Row;
use crate::navigation::routed::Missions;
use crate::navigation::together::Together;
use crate::plan::rules::{Kind, load_over};
use crate::site::base::Base;
use crate::site::whole;
use crate::words::progress::Bar;

/// Drives missions and prints a row each; `false` where one ended otherwise than it should.
pub fn run(args: &SimulateArgs, mut live: Live) -> Result<bool> {
    check(args)?;
    let setting = Setting::new(&live, args.robot.as_deref(), args.tell)?;
    let mut on = setting.missions(&mut live, args.tell);
    if let Some(output) = &args.curve {
        let drives = |far_m, seeds, first| on.tours(far_m, seeds, first);
        super::curve::run(args, (&setting.name, output), drives)?;
        return Ok(true);
    }
    if let Some(robots) = args.robots {
        return together(args, usize::from(robots), &setting, &mut on);
    }
    let missions = missions(args, &on)?;
    let wanted = filmed(args, &missions)?.is_some();
    let mut kept = Kept::open(setting.of(), args.db.as_deref(), args.keep)?;
    let bar = Bar::new("missions", missions.len() as u64);
    let (mut rows, mut said, mut film): (Vec<Row>, Vec<String>, Option<Film>) = Default::default();
    for (index, mission) in missions.iter().enumerate() {
        let is_filmed = wanted && index + 1 == args.mission;
        let (journal, told) = on.run((kept.before + index + 1, mission), is_filmed.then_some(&mut film))?;
        said.extend(told);
        rows.push(kept.keep(on.live, "simulated mission", journal)?);
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
    Ok(are_right(&rows))
}

/// Has several robots drive at once, and prints a row for each errand; `false` where one ended otherwise than it should.
fn together(args: &SimulateArgs, robots: usize, setting: &Setting, on: &mut Missions<'_>) -> Result<bool> {
    let mut kept = Kept::open(setting.of(), args.db.as_deref(), args.keep)?;
    let seconds = f64::from(args.minutes) * 60.0;
    let what = Together { robots, seconds, doors: args.doors.into(), seed: args.seed, before: kept.before };
    let (mut rows, mut said): (Vec<Row>, Vec<String>) = Default::default();
    let bar = Bar::new("minutes", args.minutes.into());
    let done = |on: &mut Missions<'_>, journal, told| {
        said.extend(told);
        rows.push(kept.keep(on.live, "simulated mission", journal)?);
        Ok(())
    };
    on.together(&what, done, || bar.step())?;
    drop(bar);
    either(args.json, &rows[..], show)?;
    for text in &said {
        remark(text);
    }
    Ok(are_right(&rows))
}

/// What missions need of a site that is cut into rooms.
pub(super) struct Setting {
    pub ground: Ground,
    rules: Arc<RuleBase>,
    /// The rule bases, one a line, the lowest first.
    bases: String,
    pub name: String,
}

impl Setting {
    /// A site as it is now, for one of its robots; `tells` where it is to be told what the robot meets.
    pub fn new(live: &Live, robot: Option<&str>, tells: bool) -> Result<Self> {
        if tells {
            live.site().needs_folder()?;
        }
        let ground = Ground::of(&live.fork(), robot)?;
        let (rules, bases, remarks) = load_over(Kind::Navigation, &live.site().site().folder)?;
        for finding in &remarks {
            remark(&finding.to_string());
        }
        let bases = bases.iter().map(Base::name).collect::<Vec<_>>().join("\n");
        Ok(Self { ground, rules, bases, name: live.site().site().name.clone() })
    }

    /// Of whom missions are kept.
    pub fn of(&self) -> Of<'_> {
        Of { world: &self.name, bases: &self.bases, states: &self.ground.states, robot: &self.ground.robot }
    }

    pub fn missions<'l>(&'l self, live: &'l mut Live, tells: bool) -> Missions<'l> {
        Missions::new(live, (&self.ground, &self.rules), tells)
    }
}

/// The missions that are drawn, or the one from START to GOAL.
fn missions(args: &SimulateArgs, on: &Missions<'_>) -> Result<Vec<Mission>> {
    let (Some(start), Some(goal)) = (&args.start, &args.goal) else {
        return on.drawn(args.missions as usize, (args.seed, args.kidnap));
    };
    let heading = heading(args.heading)?;
    let ends = [point(on.live, start)?, point(on.live, goal)?];
    // where the robot does not fit at one of the ends there is nothing to drive; without a way between them it finds that out itself
    on.live.fork().route_after(&[], &Errand::default(), (start, goal), &on.ground.robot)?;
    Ok((0..u64::from(args.missions))
        .map(|number| on.between(ends, heading, args.seed.wrapping_add(number)))
        .collect())
}

/// A place by its name, or a point `x,y`.
pub(super) fn point(live: &Live, name: &str) -> Result<Point> {
    let view = live.view();
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
    let asked =
        [("--learn", args.learn.is_some()), ("--learned", args.learned), ("--drive", args.drive.is_some())];
    let Some((flag, _)) = asked.into_iter().find(|(_, is_asked)| *is_asked) else { return Ok(()) };
    let message = format!(
        "{flag} is for maps with `[floor_plan]`; this site is cut into rooms, whose routes are driven"
    );
    Err(Error::said(Code::SimulateNoFloorPlan, message, None))
}
