//! `adit plan`: the planners of worlds of their own.

use std::path::Path;
use std::sync::Arc;

use adit_db::plan::Plan;
use adit_db::{Store, Tx};
use adit_engine::RuleBase;
use adit_planners::geometry::Point;

use super::args::PlanArgs;
use super::output::{json, line, remark};
use super::picture;
use crate::draw::{ChannelPanel, render_channels, render_floor};
use crate::error::{Code, Error, Result};
use crate::navigation::floor::Floor;
use crate::navigation::keep::record;
use crate::plan::assembly::Assembly;
use crate::plan::corridor::Corridor;
use crate::plan::{Asked, Steps, Task, Turns, World};
use crate::site::whole::Whole;
use crate::words::number::number;

/// Plans, and prints, keeps or draws what came of it; `false` where there is no path.
pub fn run(args: &PlanArgs) -> Result<bool> {
    if let Some(output) = &args.output {
        picture::check(output)?;
    }
    let world = World::read_one(&args.world, args.learning.scenario.as_deref())?;
    if !matches!(world.task, Task::Cell(_)) {
        two_ends(args)?;
    }
    let (rules, name, remarks) = world.rules(args.rules.as_deref())?;
    let name = name.as_str();
    for text in &remarks {
        remark(text);
    }
    let steps = || Steps::new(&rules).map_err(Error::of(Code::PlanRules));
    match &world.task {
        Task::Assembly(assembly) => assemble(args, &world, name, assembly, &mut steps()?),
        Task::SolidAssembly(assembly) => assemble(args, &world, name, assembly, &mut steps()?),
        Task::Corridor(corridor) => {
            let turns = Turns::new(&rules);
            let mut turns = turns.map_err(Error::of(Code::PlanRules))?;
            drive(args, &world, name, &between(args, corridor)?, &mut turns)
        }
        Task::FloorPlan(floor) => walk(args, &world.name, name, floor, &rules),
        Task::Cell(cell) => super::cell::run(args, cell, &rules),
    }
}

/// Refuses ends and settings that only a cell has.
fn two_ends(args: &PlanArgs) -> Result<()> {
    let learning = &args.learning;
    if let Some(one) = args.more.first() {
        let message = format!("`{one}` is one too many: this world takes START and GOAL");
        return Err(Error::said(Code::PlanEnds, message, None));
    }
    if args.start.is_some() != args.goal.is_some() {
        return Err(Error::said(Code::PlanEnds, "START needs a GOAL", None));
    }
    let of_cells = [
        (learning.tasks > 0, "--tasks"),
        (!learning.teach.is_empty(), "--teach"),
        (learning.from.is_some(), "--from"),
        (learning.strategy.is_some(), "--strategy"),
    ];
    match of_cells.into_iter().find(|(is_given, _)| *is_given) {
        Some((_, flag)) => {
            Err(Error::said(Code::PlanNoCell, format!("{flag} is for worlds with [cell]"), None))
        }
        None => Ok(()),
    }
}

fn walk(
    args: &PlanArgs,
    world: &str,
    rules_name: &str,
    floor: &Floor,
    rules: &Arc<RuleBase>,
) -> Result<bool> {
    let (Some(start), Some(goal)) = (&args.start, &args.goal) else {
        let help = format!("places: {}", floor.names().join(", "));
        return Err(Error::said(Code::PlanEnds, "a floor plan needs START and GOAL", Some(help)));
    };
    let mut judge = floor.judge(rules)?;
    let walked = floor.plan(floor.point(start)?, floor.point(goal)?, &mut judge)?;
    if args.json {
        json(&walked.json())?;
    } else {
        walked.lines().iter().for_each(|text| line(text));
    }
    if let Some(path) = &args.db {
        let record = record(world, rules_name, floor, &mut judge, &walked);
        keep(path, |tx| tx.keep_floor_plan(&record))?;
    }
    if let Some(output) = &args.output {
        let path = walked.tight.as_ref().ok();
        let title = match path {
            Some(path) => format!("{world}: {start} to {goal}, {} m", number(path.length)),
            None => format!("{world}: no path from {start} to {goal}"),
        };
        picture::save(render_floor(&title, &floor.plan, &floor.network, path), output, picture::WIDTH)?;
    }
    Ok(walked.is_path())
}

/// The corridor with the ends of the command line.
fn between(args: &PlanArgs, corridor: &Corridor) -> Result<Corridor> {
    let point = |text: &String| {
        let wrong =
            || Error::said(Code::PlanPoint, format!("`{text}` is no point; expected `x,y` in metres"), None);
        let numbers: Option<Vec<f64>> = text.split(',').map(|part| part.trim().parse().ok()).collect();
        match numbers.as_deref() {
            Some([x, y]) if x.is_finite() && y.is_finite() => Ok(Point::new(*x, *y)),
            _ => Err(wrong()),
        }
    };
    match (&args.start, &args.goal) {
        (Some(start), Some(goal)) => {
            Ok(Corridor { start: point(start)?, goal: point(goal)?, ..corridor.clone() })
        }
        _ => Ok(corridor.clone()),
    }
}

fn drive(
    args: &PlanArgs,
    world: &World,
    rules: &str,
    corridor: &Corridor,
    turns: &mut Turns,
) -> Result<bool> {
    let mut plans = Plans::default();
    for corridor in gaps(args, corridor, Corridor::with_gap)? {
        let answer = corridor.explained(turns, None);
        if let Ok(driven) = &answer.path {
            let gap = corridor.wanted.gap.to_string();
            plans.panels.push(ChannelPanel::drive(&gap, &corridor.corridors, corridor.robot, &driven.drive));
        }
        plans.record = Some(answer.record(&world.name, rules, &corridor));
        let (json, lines) = (|| answer.json(args.explain), || answer.lines(args.explain));
        plans.say(args, answer.path.is_ok(), json, lines);
    }
    plans.finish(args, &world.name)
}

fn assemble<const D: usize>(
    args: &PlanArgs,
    world: &World,
    rules: &str,
    assembly: &Assembly<D>,
    steps: &mut Steps,
) -> Result<bool> {
    let mut plans = Plans::default();
    for assembly in gaps(args, assembly, Assembly::with_gap)? {
        let answer = assembly.explained(steps);
        if let Ok(path) = &answer.path {
            let gap = assembly.wanted.gap.to_string();
            // In three dimensions from the front and from above.
            let views: &[(&str, [usize; 2])] = if D == 2 {
                &[("", [0, 1])]
            } else {
                &[(", from the front", [0, 2]), (", from above", [0, 1])]
            };
            plans.panels.extend(views.iter().map(|(view, axes)| {
                ChannelPanel::assembly(&format!("{gap}{view}"), &assembly.geometry, path, *axes)
            }));
        }
        plans.record = Some(answer.record(&world.name, rules, &assembly));
        let (json, lines) =
            (|| answer.json(&assembly, args.explain), || answer.lines(&assembly, args.explain));
        plans.say(args, answer.path.is_ok(), json, lines);
    }
    plans.finish(args, &world.name)
}

/// The world as it is, or once for each gap that the command line asks for.
fn gaps<W: Clone, const N: usize>(
    args: &PlanArgs,
    world: &W,
    with: impl Fn(&W, Asked<N>) -> W,
) -> Result<Vec<W>> {
    let gap = |text: &String| {
        let gap = Asked::parse(text).map_err(Error::of(Code::PlanGap))?;
        Ok(with(world, gap))
    };
    if args.gap.is_empty() { Ok(vec![world.clone()]) } else { args.gap.iter().map(gap).collect() }
}

/// Writes to a database, and makes none where that fails.
fn keep(path: &Path, work: impl FnOnce(&mut Tx<'_>) -> adit_db::Result<()>) -> Result<()> {
    let mut made = Whole::default();
    made.database(path);
    Store::open_for_worlds(path)?.transaction(work)?;
    made.keep();
    Ok(())
}

/// What came of a world, once for each gap.
#[derive(Default)]
struct Plans {
    failed: bool,
    answers: Vec<serde_json::Value>,
    record: Option<Plan>,
    panels: Vec<ChannelPanel>,
}

impl Plans {
    fn say(
        &mut self,
        args: &PlanArgs,
        is_path: bool,
        json: impl Fn() -> serde_json::Value,
        lines: impl Fn() -> Vec<String>,
    ) {
        self.failed |= !is_path;
        if args.json {
            self.answers.push(json());
        } else {
            for text in lines() {
                line(&text);
            }
        }
    }

    /// Keeps the last plan, draws all of them, and prints them where JSON is wanted; `false` where one has no path.
    fn finish(mut self, args: &PlanArgs, name: &str) -> Result<bool> {
        if let (Some(path), Some(record)) = (&args.db, &self.record) {
            keep(path, |tx| tx.keep_plan(record))?;
        }
        match (&args.output, self.panels.as_slice()) {
            (None, _) => {}
            (Some(output), []) => remark(&format!("{} is not drawn: there is no path", output.display())),
            (Some(output), panels) => {
                picture::save(render_channels(name, panels), output, picture::WIDTH)?;
            }
        }
        match self.answers.len() {
            0 => {}
            1 => json(&self.answers.remove(0))?,
            _ => json(&self.answers)?,
        }
        Ok(!self.failed)
    }
}
