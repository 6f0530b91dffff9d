//! What a command does with a site: it is opened, one thing is done, and all of it is kept or nothing.

use std::cell::OnceCell;
use std::path::Path;
use std::sync::Arc;

use adit_db::conclusion::Rule as Built;
use adit_db::history::Author;
use adit_db::load::Load;
use adit_db::place::Place;
use adit_db::route::Route;
use adit_db::{Store, Tx};
use adit_engine::{Rule, RuleBase, Schema};

use super::memory::Memory;
use super::report::{Report, unfit_places};
use super::reseeded::Held;
use crate::answer::{Answer, Basis, Ground, Status, pick_robot};
use crate::edit::{Done, Edit, Errand};
use crate::error::{Code, Error, Finding, Result};
use crate::graph::gauge::sizes_of;
use crate::graph::{Rules, SiteGraph};
use crate::knowledge::generation;
use crate::knowledge::inputs::Inputs;
use crate::knowledge::laid::Laid;
use crate::knowledge::{Beneath, KnowledgeBase, LAYOUT};
use crate::site::journal::Journal;
use crate::site::robots::RobotFile;
use crate::site::{lint, over, rules, states, tables};
use crate::words::progress::{Progress, Silent};

impl KnowledgeBase {
    /// Map, facts, rules, routes: into the site's database, all or nothing.
    pub fn build(&self, progress: &dyn Progress) -> Result<Report> {
        self.build_at(self.database(), progress)
    }

    fn build_at(&self, database: &Path, progress: &dyn Progress) -> Result<Report> {
        let inputs = self.inputs(progress)?;
        let fresh = !database.exists();
        let outcome = Store::open_or_create(database)
            .map_err(Error::from)
            .and_then(|mut store| self.shared().build_in(&mut store, &inputs, progress));
        if outcome.is_err() && fresh && is_unbuilt(database) {
            // a first build that failed leaves no empty database behind; nothing of the user's is in it
            std::fs::remove_file(database).ok();
        }
        if outcome.is_ok() && !database.exists() {
            let message = format!("{} was removed by someone while it was built", database.display());
            return Err(Error::said(Code::Database, message, Some("build again".to_owned())));
        }
        Ok(outcome?.1)
    }

    /// Seeds the tables, where they are empty, and derives everything from them, in one transaction.
    pub(crate) fn build_in(
        self: &Arc<Self>,
        store: &mut Store,
        inputs: &Arc<Inputs>,
        progress: &dyn Progress,
    ) -> Result<(Memory, Report)> {
        let site = self.site();
        let again = |table: &str| self.reseed.as_ref().is_some_and(|reseed| reseed.takes(table));
        let seed = if site.has_rooms() { Some(RobotFile::read(&site.robots)?) } else { None };
        let mut tables = self.tables_of_map();
        tables.extend(tables::read(&site.tables())?);
        let (places, loads) = (self.places_of_map(), self.loads_of_map());
        let built = store.transaction(|tx| {
            self.refuse_anothers(tx)?;
            let own = tables.iter().map(|table| table.name.as_str());
            let seeded = ["changes", "loads", "robots", "places"].into_iter().chain(own).collect::<Vec<_>>();
            if let Some(reseed) = &self.reseed {
                let of_robots = seed.iter().flat_map(|_| ["robots", "changes", "loads"]);
                let of_map = (!loads.is_empty()).then_some("loads").into_iter();
                let of_map = of_map.chain(places.is_some().then_some("places"));
                let own = tables.iter().map(|table| table.name.as_str());
                reseed.check(&of_robots.chain(of_map).chain(own).collect::<Vec<_>>())?;
            }
            // a map that is a site alone has nothing that anybody edited
            let is_built = tx.site_value("generation")?.is_some();
            let replacing = self.reseed.as_ref().filter(|_| is_built && !self.is_map_alone());
            let held = replacing
                .map(|reseed| Held::of(tx, &seeded).map(|held| (held, &reseed.author)))
                .transpose()?;
            // states, changes and loads stand in one file
            let states = ["robots", "changes", "loads"].into_iter().any(again);
            let notes = seed.map(|seed| seed.seed_tables(tx, &site.robots, states)).transpose()?;
            let mut notes = notes.unwrap_or_default();
            for table in &tables {
                notes.extend(table.seed(tx, again(&table.name))?);
            }
            notes.extend(seed_loads(tx, &loads, again("loads"))?);
            notes.extend(self.course().iter().flat_map(|course| course.notes()));
            if let Some(places) = &places {
                notes.extend(seed_places(tx, places, again("places"))?);
            }
            let replaced = held.map(|(held, author)| held.record(tx, author)).transpose()?;
            let (memory, mut report) = Memory::build(tx, self, inputs, progress)?;
            report.notes.extend(notes);
            report.notes.extend(tables::with_commas(&site.tables()));
            report.notes.extend(replaced.unwrap_or_default());
            // an edit says it of what it changes, a build of all
            for note in unfit_places(&memory.state) {
                if !report.notes.contains(&note) {
                    report.notes.push(note);
                }
            }
            Ok((memory, report))
        });
        built.map_err(|error: Error| {
            let is_of_type = |problem: &&Finding| problem.code() == Some(Code::Rule(adit_engine::Code::Type));
            let texts: Vec<String> =
                error.problems().iter().filter(is_of_type).filter_map(Finding::text).collect();
            let is_meant = |column: &str| texts.iter().any(|text| text.contains(&format!(".{column}")));
            let mixed = if texts.is_empty() { Vec::new() } else { tables::mixed(&site.tables(), is_meant) };
            Error::all(error.into_problems().into_iter().chain(mixed))
        })
    }

    /// Edits a table and derives what follows, in one transaction; with `rehearse` all of it is taken back.
    pub fn edit(
        &self,
        edit: &Edit,
        author: &Author,
        rehearse: bool,
        progress: &dyn Progress,
    ) -> Result<(Done, Report)> {
        if !rehearse {
            self.needs_folder()?;
        }
        let mut store = Store::open(self.database())?;
        let site = self.drafting(store.snapshot(|tx| edit.files(tx))?).shared();
        let inputs = site.inputs(progress)?;
        let work = |tx: &mut Tx<'_>| -> Result<(Done, Report)> {
            let built = if edit.files(tx)?.is_empty() { tx.rules()? } else { Vec::new() };
            let (done, mut report) = Memory::edit(tx, &site, &inputs, (edit, author), progress)?;
            report.notes.extend(not_built(&built, &inputs.rules, "what follows from them is included"));
            report.notes.extend(edit.remarks(tx, &site, &done)?);
            Ok((done, report))
        };
        if rehearse {
            return store.rehearse(work);
        }
        let (outcome, journal) = store.transaction(|tx| -> Result<_> {
            let since = tx.history(1)?.first().map_or(0, |entry| entry.id);
            let outcome = work(tx)?;
            Ok((outcome, Journal::begin(tx, self.database(), &self.rule_folder(), since)?))
        })?;
        Journal::finish(journal);
        Ok(outcome)
    }

    /// Problems of the rules, the tables and the map. What only a build can find is found by one that is thrown
    /// away; the site's database is not touched.
    pub fn check(&self) -> Result<Vec<Finding>> {
        self.examine(|_| Ok(())).map(|(problems, ())| problems)
    }

    /// As [`check`](Self::check), with what is to be known of the site as it was built and thrown away.
    pub(crate) fn examine<T>(&self, look: impl FnOnce(&Self) -> Result<T>) -> Result<(Vec<Finding>, T)> {
        let rules = self.rule_base()?;
        let mut problems =
            lint::ignored(self.site(), self.rules.as_deref(), &rules, self.planners(), &self.asked()?);
        let folder = tempfile::tempdir().map_err(|error| Error::io("make", &std::env::temp_dir(), &error))?;
        let scratch = folder.path().join("check.db");
        let mut changed = lint::replaced(&rules);
        if self.database().exists() {
            let mut store = Store::open_read_only(self.database())?;
            changed.extend(over::changed_beneath(&rules, &store.snapshot(over::kept)?));
            store.backup(&scratch)?;
        }
        let report = self.build_at(&scratch, &Silent)?;
        problems.extend(lint::misspelt(&report.misspelt));
        problems.extend(lint::unmet(&report.unmet));
        let said: Vec<String> = problems.iter().map(ToString::to_string).collect();
        problems.extend(changed);
        let is_endless = report.failed.iter().any(|problem| problem.code == adit_engine::Code::Loop);
        let failed: Vec<String> = report.failed.iter().map(|problem| problem.message.clone()).collect();
        problems.extend(report.failed.into_iter().map(|problem| Finding::from(problem.warning())));
        let is_said =
            |note: &String| said.contains(note) || failed.iter().any(|of| note.starts_with(of.as_str()));
        let notes = report.notes.into_iter().filter(|note| !is_said(note));
        problems.extend(notes.map(Finding::note));
        let help = "tell it again where it now is, or take it back with `adit tell SITE --retract ID`";
        let lost = |lost| Finding::warning(Code::TellLost, lost, Some(help.to_owned()));
        problems.extend(report.lost.into_iter().map(lost));
        let gap = |gap| Finding::warning(Code::Rule(adit_engine::Code::Gap), gap, None);
        problems.extend(report.gaps.into_iter().map(gap));
        problems.extend(lint::never_chosen(&report.dominated));
        let built = self.clone().with_database(Some(&scratch));
        let told = Store::open_read_only(&scratch)?.snapshot(|tx| built.told(tx, &rules))?;
        problems.extend(lint::doubtful(self.site(), self.rules.as_deref(), &rules, &told.classes));
        // each of them would come to no end as well
        if !is_endless {
            problems.extend(built.test()?.beneath.iter().flat_map(Beneath::findings));
        }
        Ok((problems, look(&built)?))
    }

    /// The classes and properties that rules may name, of a site that was built.
    ///
    /// Where the rules that are in force cannot be read, what the lowest of them leaves is taken.
    pub(crate) fn classes(&self) -> Result<Schema> {
        let lowest = |_| {
            let bases = rules::bases(self.site(), self.rules.as_deref());
            rules::load_bases(&bases[..1.min(bases.len())]).map(|rules| rules.base)
        };
        let rules = self.rule_base().or_else(lowest)?;
        let mut store = Store::open_read_only(self.database())?;
        store.snapshot(|tx| Ok(self.schema(&self.told(tx, &rules)?)))
    }

    /// The route of least hardness between two places, rooms or points (`x,y`).
    ///
    /// As [`route_to_nearest`](Self::route_to_nearest), with one goal.
    pub fn route(&self, start: &str, goal: &str, robot: Option<&str>) -> Result<Answer> {
        self.route_to_nearest(start, &[goal.to_owned()], robot)
    }

    /// The route to the one of several goals that costs least; the answer's `goal` says which.
    ///
    /// Where tables, `site.toml` or the map were edited since the last build, or the time is over up to which it holds,
    /// everything is derived again first. Asked about [another moment](KnowledgeBase::at), it answers for that one, and
    /// leaves the site as it is.
    pub fn route_to_nearest(&self, start: &str, goals: &[String], robot: Option<&str>) -> Result<Answer> {
        if !self.site().has_rooms() && self.site().layout.is_none() {
            self.site().needs_rooms()?;
        }
        self.site().moves_ends(self.within)?;
        if self.asks_about_another_moment() {
            return self.rehearsed(|_, _| Ok(()), |tx| self.answer(tx, (start, goals), robot, [None; 2]));
        }
        self.fresh()?.snapshot(|tx| self.answer(tx, (start, goals), robot, [None; 2]))
    }

    /// A map that is not cut into rooms as an SVG text, with a route where one is asked for; and what there is of what.
    pub(crate) fn course_picture(
        &self,
        route: Option<(&str, &str)>,
        robot: Option<&str>,
    ) -> Result<(String, String)> {
        let inputs = self.inputs(&Silent)?;
        let memory = self.fresh()?.snapshot(|tx| Memory::open(tx, &self.shared(), &inputs))?;
        let courses = memory.and_then(|memory| memory.state.courses);
        let courses = courses.ok_or_else(|| {
            Error::said(
                Code::LiveStale,
                "the site's rules, tables or files were changed since it was built",
                None,
            )
        })?;
        let name = &self.site().name;
        let Some((start, goal)) = route else { return Ok((courses.picture(name, None)?, courses.summary())) };
        let robot = crate::answer::pick(&courses.robots(), robot)?;
        if let Some(reason) = courses.find(&robot, start, goal)?.row.reason {
            let message = format!("no route from {start} to {goal}: {reason}");
            return Err(Error::said(Code::DrawNoRoute, message, None));
        }
        Ok((courses.picture(name, Some([robot.as_str(), start, goal]))?, courses.summary()))
    }

    /// As [`route_to_nearest`](Self::route_to_nearest), for an errand; the site is left as it is.
    pub fn route_on_errand(
        &self,
        errand: &Errand,
        (start, goals): (&str, &[String]),
        robot: Option<&str>,
    ) -> Result<Answer> {
        self.site().needs_rooms()?;
        // names are those of the last build
        drop(self.fresh()?);
        let then = self.clone().at(errand.at.as_deref())?;
        let tell = |tx: &mut Tx<'_>, rules: &RuleBase| errand.tell(tx, (&then, rules), robot);
        let answer = then.rehearsed(tell, |tx| then.answer(tx, (start, goals), robot, errand.ends_in()))?;
        Ok(errand.explained(answer))
    }

    /// A word about rules that were edited since the last build, by which routes are found.
    pub fn rules_not_built(&self) -> Result<Option<String>> {
        let built = Store::open_read_only(self.database())?.snapshot(|tx| tx.rules())?;
        Ok(match self.rule_base() {
            Ok(rules) => not_built(&built, &rules, "a route is by those, until `adit build` takes these"),
            Err(_) => Some(
                "the rules are wrong as they are, as `adit check` says; a route is by those of the last build".to_owned(),
            ),
        })
    }

    /// Does `work` on what would be derived now, after something is told, and takes all of it back.
    fn rehearsed<T>(
        &self,
        tell: impl FnOnce(&mut Tx<'_>, &RuleBase) -> Result<()>,
        work: impl FnOnce(&mut Tx<'_>) -> Result<T>,
    ) -> Result<T> {
        let inputs = self.inputs(&crate::words::progress::Silent)?;
        Store::open(self.database())?.rehearse(|tx| {
            tell(tx, &inputs.rules)?;
            Memory::build(tx, &self.shared(), &inputs, &crate::words::progress::Silent)?;
            work(tx)
        })
    }

    /// The database for reading. Where tables, `site.toml` or the map were edited since the last build, everything is
    /// derived again first.
    pub(crate) fn fresh(&self) -> Result<Store> {
        let mut store = Store::open_read_only(self.database())?;
        let texts = self.site().texts().to_string();
        let is_old = |tx: &mut Tx<'_>| -> Result<bool> {
            // a first build that was killed leaves tables, and nothing in them
            let is_unbuilt = generation::read(tx)? == 0;
            Ok(is_unbuilt || tx.is_stale()? || tx.site_value("texts")?.is_some_and(|built| built != texts))
        };
        if store.snapshot(is_old)? {
            drop(store);
            self.build(&crate::words::progress::Silent)?;
            store = Store::open_read_only(self.database())?;
        }
        Ok(store)
    }

    fn answer(
        &self,
        tx: &mut Tx<'_>,
        (start, goals): (&str, &[String]),
        robot: Option<&str>,
        ends_in: [Option<&str>; 2],
    ) -> Result<Answer> {
        if self.course().is_some() {
            let robots = tx.course_robots()?;
            if let Ok(robot) = crate::answer::pick(&robots, robot)
                && let Some(route) = kept(tx, &robot, start, goals)?
            {
                let mut answer = Answer::blank(&robot, start, goals, generation::read(tx)?);
                (answer.cost, answer.distance) = (route.cost, route.distance);
                answer.steps = tx.action_sequence(&robot, start, &route.goal)?;
                answer.waypoints = tx.waypoints(&robot, start, &route.goal)?;
                answer.measures = answer.at_the_end();
                answer.remarks = tx.course_remarks(&robot, start, &route.goal)?;
                answer.goal = route.goal;
                return Ok(answer);
            }
            let inputs = self.inputs(&Silent)?;
            let memory = Memory::open(tx, &self.shared(), &inputs)?;
            let memory = memory.ok_or_else(|| {
                Error::said(
                    Code::LiveStale,
                    "the site's rules, tables or files were changed since it was built",
                    Some("`adit build` says whether something is wrong with them".to_owned()),
                )
            })?;
            return memory.state.route(start, goals, robot);
        }
        let robot = pick_robot(tx, robot)?;
        let mut answer = Answer::blank(&robot, start, goals, generation::read(tx)?);
        let kept = if ends_in == [None; 2] { kept(tx, &robot, start, goals)? } else { None };
        if let Some(route) = kept {
            answer.status = if route.status == "ok" { Status::Ok } else { Status::SameRoom };
            (answer.cost, answer.distance) = (route.cost, route.distance);
            answer.steps = tx.action_sequence(&robot, start, &route.goal)?;
            answer.waypoints = tx.waypoints(&robot, start, &route.goal)?;
            answer.measures = answer.at_the_end();
            answer.goal = route.goal;
            return Ok(answer);
        }
        let graph = SiteGraph::read(tx)?;
        let rules: Rules = tx.rules()?.into_iter().map(|rule| (rule.rule, rule.name)).collect();
        let sizes = sizes_of(&states::in_force(tx)?);
        let ground = Ground::Later(self.site(), Laid::read(tx, &self.clock())?, sizes, OnceCell::new());
        let basis =
            Basis { graph: &graph, rules: &rules, ground, within: self.within, ends_in, start_facing: None };
        let answer = basis.search(goals, answer);
        // nobody waits until all of it is given back
        rayon::spawn(|| drop(graph));
        answer
    }
}

/// What vehicles can carry on a map, the first time or when asked.
fn seed_loads(tx: &mut Tx<'_>, loads: &[Load], again: bool) -> Result<Option<String>> {
    if loads.is_empty() {
        return Ok(None);
    }
    let (kept, is_first) = (tx.loads()?, tx.site_value(LAYOUT)?.is_none());
    if again || is_first {
        tx.replace_loads(loads)?;
    }
    let is_kept = |load: &Load| kept.iter().any(|of| (&of.robot, &of.load) == (&load.robot, &load.load));
    let note = if again {
        "the table loads is as the file has it again; it named other loads"
    } else {
        "the file names other loads than the table loads; the database counts (--reseed takes the file)"
    };
    Ok((!is_first && !loads.iter().all(is_kept)).then(|| note.to_owned()))
}

/// Fills the places of a map that is not cut into rooms the first time, or when asked; says where file and table differed.
fn seed_places(tx: &mut Tx<'_>, places: &[Place], again: bool) -> Result<Option<String>> {
    let kept = tx.places()?;
    // what a build has signed was filled before, and whoever took all places away meant it
    let is_first = tx.site_value(LAYOUT)?.is_none();
    if again || is_first {
        tx.replace_places(places)?;
    }
    let mut sorted = places.to_vec();
    sorted.sort_by(|one, other| one.place.cmp(&other.place));
    let note = if again {
        "the table places is as the files have it again; it named other places"
    } else {
        "the files name other places than the table places; the database counts (--reseed takes the files)"
    };
    Ok((!is_first && kept != sorted).then(|| note.to_owned()))
}

/// Whether no build has ever come to its end in the database, nor is at work there now.
fn is_unbuilt(database: &Path) -> bool {
    if std::fs::metadata(database).is_ok_and(|file| file.len() == 0) {
        return true;
    }
    let signed = |tx: &mut Tx<'_>| tx.site_value("generation");
    Store::open(database).and_then(|mut store| store.transaction(signed)).is_ok_and(|g| g.is_none())
}

/// The kept route that costs least, if routes to all of the goals are kept.
fn kept(tx: &mut Tx<'_>, robot: &str, start: &str, goals: &[String]) -> Result<Option<Route>> {
    let mut best: Option<Route> = None;
    for goal in goals {
        let Some(route) = tx.route(robot, start, goal)? else { return Ok(None) };
        match route.status.as_str() {
            "ok" | "same_room" => {}
            "no_route" if goals.len() > 1 => continue,
            _ => return Ok(None),
        }
        if best.as_ref().is_none_or(|best| route.cost < best.cost) {
            best = Some(route);
        }
    }
    Ok(best)
}

/// So many rules are named that differ from those of the last build.
const NAMED: usize = 3;

/// A word about rules that differ from those with which the site was built, and what becomes of them.
fn not_built(built: &[Built], rules: &RuleBase, then: &str) -> Option<String> {
    let is_built =
        |rule: &&Rule| built.iter().any(|of| of.name == rule.name() && of.version == rule.version());
    let other = rules.rules().iter().filter(|rule| !is_built(rule));
    let mut named: Vec<String> =
        other.map(|rule| format!("\"{}\" ({}, line {})", rule.name(), rule.file(), rule.line())).collect();
    let is_gone = |of: &&Built| !rules.rules().iter().any(|rule| rule.name() == of.name);
    named.extend(built.iter().filter(is_gone).map(|of| format!("\"{}\", which is gone", of.name)));
    if built.is_empty() || named.is_empty() {
        return None;
    }
    let more = named.len().saturating_sub(NAMED);
    named.truncate(NAMED);
    named.extend((more > 0).then(|| format!("and {more} more")));
    let named = named.join(", ");
    Some(format!("rules differ from those of the last build; {then}: {named}"))
}
