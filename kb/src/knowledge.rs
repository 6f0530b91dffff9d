//! The knowledge base of one site: planners are registered, the site is built, tables are edited, and each
//! time everything that follows is derived by the same path, in one transaction.

pub(crate) mod classes;
pub(crate) mod generation;
pub(crate) mod inputs;
pub mod laid;
mod reseed;
pub(crate) mod tables;
pub(crate) mod told;
pub(crate) mod tunings;

use std::path::{Path, PathBuf};
use std::sync::{Arc, OnceLock};
use std::time::Duration;

use adit_db::history::Author;
use adit_db::load::Load;
use adit_db::measure::Measure;
use adit_db::place::Place;
use adit_db::robot::State;
use adit_db::{Store, Tx};
use adit_engine::{Limits, RuleBase, RuleTests, Schema, TestOutcome, Type};
use adit_planners::bridges::Bridges;
use adit_planners::facts::{Column, Facts, Table};
use adit_planners::layers::RoomsByState;
use adit_planners::minimum::MinimumRooms;
use adit_planners::overlays::{Overlays, RoomsInOverlays};
use adit_planners::planner::{Planner, PlannerError, Signature};
use adit_planners::prime_areas::PrimeAreas;
use adit_planners::rooms::PaperRooms;
use adit_planners::spaces::SpacesAndDoorways;
use adit_planners::world::World;
use jiff::Timestamp;
use jiff::tz::TimeZone;
use tempfile::TempDir;

use crate::error::{Code, Error, Finding, Result};
use crate::knowledge::inputs::Inputs;
use crate::knowledge::laid::Laid;
use crate::knowledge::reseed::Reseed;
use crate::knowledge::told::{Fact, NOBODY, Told};
use crate::knowledge::tunings::RowKeys;
use crate::plan;
use crate::plan::consult::Class;
use crate::plan::course::Course;
use crate::plan::legs;
use crate::site::alone;
use crate::site::base::{self, Base};
use crate::site::clock::{Clock, Dial, stored};
use crate::site::hours::Opening;
use crate::site::journal;
use crate::site::lint;
use crate::site::over;
use crate::site::rules::{self, Drafts, Rules};
use crate::site::states;
use crate::site::tables::{self as files, TableFile};
use crate::site::{Rooms, Site};
use crate::words::number::number;
use crate::words::progress::Progress;

/// How long the tests of rules may take that are only tried: somebody waits at the page, and where rules are saved
/// everybody's edits wait.
const TRIAL: Duration = Duration::from_secs(10);

/// Under which key the database says what the map is, where it is not cut into rooms.
pub(crate) const LAYOUT: &str = "layout";

/// Under which key the database says of which map alone it is.
const ALONE: &str = "alone";

/// The places of a map that is not cut into rooms, as a class.
const PLACES: &str = "PLACES";

/// A start or goal is moved by at most so many metres: who allows more does not mean the point.
const MOST_M: f64 = 100.0;

/// [`Overlays`] of a site, whose map is read for it when somebody asks what it gives before anybody has read it.
struct OverlaysOf {
    site: Site,
    read: OnceLock<Overlays>,
}

impl OverlaysOf {
    /// Of a map that cannot be read nothing is said.
    fn overlays(&self) -> &Overlays {
        self.read.get_or_init(|| {
            self.site.world().map_or_else(|_| Overlays::default(), |world| Overlays::of(&world))
        })
    }

    fn know(&self, world: &World) {
        self.read.get_or_init(|| Overlays::of(world));
    }
}

impl Planner for OverlaysOf {
    fn name(&self) -> &'static str {
        "overlays"
    }

    fn signature(&self) -> Signature {
        self.overlays().signature()
    }

    fn facts(&self, world: &World, known: &Facts) -> std::result::Result<Facts, PlannerError> {
        self.overlays().facts(world, known)
    }
}

/// What the tests of a rule base gave.
pub struct Tested {
    /// The state of the knowledge base that the site is in; 0 where it was never built.
    pub generation: u64,
    /// One for each test, in the order of the files.
    pub outcomes: Vec<TestOutcome>,
    /// What the tests of the rule bases beneath gave: they need not hold.
    pub beneath: Vec<Beneath>,
}

/// What the tests of a rule base gave over which another one lies.
pub struct Beneath {
    /// Its name, or folder.
    pub base: String,
    pub outcomes: Vec<TestOutcome>,
    /// Why its tests cannot be run any more.
    pub trouble: Option<Error>,
}

/// So many tests beneath that do not hold are named.
const NAMED: usize = 3;

impl Beneath {
    /// The tests that do not hold with the rules above them, in sentences.
    pub(crate) fn findings(&self) -> Vec<Finding> {
        let base = &self.base;
        let failed = self.outcomes.iter().filter(|outcome| !outcome.passed).map(|outcome| {
            let (test, file, line) = (&outcome.test, &outcome.file, outcome.line);
            Finding::note(format!(
                "with these rules the test \"{test}\" of {base} ({file}, line {line}) does not hold"
            ))
        });
        let failed = failed.collect::<Vec<_>>();
        let more = failed.len().saturating_sub(NAMED);
        let more = match more {
            0 => None,
            1 => Some(Finding::note(format!("nor does one more test of {base}"))),
            more => Some(Finding::note(format!("nor do {more} more tests of {base}"))),
        };
        let trouble = self.trouble.iter().flat_map(Error::problems);
        let trouble = trouble.map(|problem| {
            Finding::note(format!("with these rules the tests of {base} cannot be run: {problem}"))
        });
        failed.into_iter().take(NAMED).chain(more).chain(trouble).collect()
    }
}

/// A site with its planners, ready to be built and edited.
#[derive(Clone)]
pub struct KnowledgeBase {
    site: Site,
    planners: Vec<Arc<dyn Planner>>,
    course: Option<Arc<dyn Course>>,
    overlays: Arc<OverlaysOf>,
    database: PathBuf,
    pub(crate) rules: Option<PathBuf>,
    /// What stands in place of the user's own rule files.
    drafts: Arc<Drafts>,
    /// Who takes the tables from their files again.
    pub(crate) reseed: Option<Reseed>,
    at: Option<Timestamp>,
    pub(crate) dial: Dial,
    pub(crate) within: Option<f64>,
    /// The file and the folder of a map that is a site alone.
    alone: Option<(PathBuf, Arc<TempDir>)>,
}

impl KnowledgeBase {
    /// Opens a site's folder, or the file of a map that is no more than that, and registers the planners that its mode of rooms
    /// asks for. What is kept of a map alone goes with the last copy of this, but where it has a database of its own.
    pub fn open(path: &Path) -> Result<Self> {
        if !path.is_file() {
            return Self::of_folder(path);
        }
        let folder = Arc::new(alone::folder(path)?);
        let knowledge = Self::of_folder(folder.path())?;
        // the file is all that can be edited
        Ok(Self { alone: Some((path.to_owned(), folder)), ..knowledge.reseeding(Self::nobody(), &[]) })
    }

    fn of_folder(folder: &Path) -> Result<Self> {
        let site = Site::open(folder)?;
        let database = site.database();
        let mode = site.rooms;
        let overlays = Arc::new(OverlaysOf { site: site.clone(), read: OnceLock::new() });
        let planners: Vec<Arc<dyn Planner>> =
            if site.has_rooms() { vec![overlays.clone()] } else { Vec::new() };
        // a map that cannot be read keeps nobody from the history; whoever needs it says what is wrong
        let course = site.layout.and_then(|_| plan::course_of(&site.map).ok());
        let mut knowledge = Self {
            site,
            planners,
            course: None,
            overlays,
            database,
            rules: None,
            drafts: Arc::default(),
            reseed: None,
            at: None,
            dial: Dial::default(),
            within: None,
            alone: None,
        };
        if let Some(course) = course {
            knowledge.register_course(course);
        }
        if mode != Rooms::Nothing {
            knowledge.register(Box::<SpacesAndDoorways>::default());
        }
        match mode {
            Rooms::Nothing => {}
            Rooms::ByState => knowledge.register(Box::new(RoomsByState::default())),
            Rooms::Paper => {
                knowledge.register(Box::new(Bridges));
                knowledge.register(Box::new(PrimeAreas));
                knowledge.register(Box::new(PaperRooms));
                knowledge.register(Box::new(RoomsInOverlays));
            }
            Rooms::Minimum => {
                knowledge.register(Box::new(Bridges));
                knowledge.register(Box::new(PrimeAreas));
                knowledge.register(Box::new(MinimumRooms));
                knowledge.register(Box::new(RoomsInOverlays));
            }
        }
        Ok(knowledge)
    }

    /// Adds a planner. What it gives, rules use by name.
    pub fn register(&mut self, planner: Box<dyn Planner>) {
        self.planners.push(planner.into());
    }

    /// Gives the planner of a map that is not cut into rooms. What it gives rules use by name, and it asks them on its way.
    pub fn register_course(&mut self, course: Box<dyn Course>) {
        let course: Arc<dyn Course> = course.into();
        self.planners.extend(course.planner());
        self.course = Some(course);
    }

    /// The classes of objects that rules are asked about one at a time, where the map is not cut into rooms.
    pub(crate) fn asks(&self) -> Vec<Class> {
        self.course.iter().flat_map(|course| course.asks().into_iter().chain([legs::class()])).collect()
    }

    /// The properties that the planner of a map that is not cut into rooms asks rules for, and what adds up along routes.
    pub(crate) fn asked(&self) -> Result<Vec<String>> {
        let of = |class: Class| class.asked.iter().map(move |property| format!("{}.{property}", class.name));
        let mut asked: Vec<String> = self.asks().into_iter().flat_map(of).collect();
        let classes: &[&str] = match (&self.course, self.site.has_rooms()) {
            (Some(_), _) => &[legs::class().name],
            (None, true) => &["ROOMS", "DOORS"],
            (None, false) => return Ok(asked),
        };
        for Measure { measure, .. } in self.measures()? {
            asked.extend(classes.iter().map(|class| format!("{class}.{measure}")));
        }
        Ok(asked)
    }

    /// What adds up along routes besides hardness; of a site that was never built, what every site begins with.
    pub fn measures(&self) -> Result<Vec<Measure>> {
        let read = |tx: &mut Tx<'_>| tx.measures();
        // a database of an older version has none of its own
        let kept = Store::open_read_only(&self.database).and_then(|mut store| store.snapshot(read));
        if self.database.exists()
            && let Ok(measures) = kept
        {
            return Ok(measures);
        }
        let folder = tempfile::tempdir().map_err(|error| Error::io("make", &std::env::temp_dir(), &error))?;
        Ok(Store::open_or_create(folder.path().join("new.db"))?.snapshot(read)?)
    }

    /// Says what is wrong with a map that is not cut into rooms, where it could not be read.
    fn needs_course(&self) -> Result<()> {
        if self.site.layout.is_some() && self.course.is_none() {
            plan::course_of(&self.site.map)?;
        }
        Ok(())
    }

    pub(crate) fn course(&self) -> Option<&Arc<dyn Course>> {
        self.course.as_ref()
    }

    /// The tables that the map's file fills, or `site.toml`.
    pub(crate) fn tables_of_map(&self) -> Vec<TableFile> {
        let of_map = self.course.as_ref().map_or_else(Vec::new, |course| course.tables());
        of_map.into_iter().chain(self.site.tables_within()).collect()
    }

    /// What vehicles can carry, as the map's file says.
    pub(crate) fn loads_of_map(&self) -> Vec<Load> {
        self.course.as_ref().map_or_else(Vec::new, |course| course.loads())
    }

    /// The places that the map's file and `site.toml` name, where the map is not cut into rooms.
    pub(crate) fn places_of_map(&self) -> Option<Vec<Place>> {
        let course = self.course.as_ref()?;
        let of_site =
            self.site.places().map(|place| Place { place: place.name.clone(), x: place.at.x, y: place.at.y });
        let mut places = course.places();
        places.retain(|place| self.site.places().all(|of_site| of_site.name != place.place));
        places.extend(of_site);
        Some(places)
    }

    /// Keeps the database in another file than `site.db` of the site's folder.
    #[must_use]
    pub fn with_database(mut self, file: Option<&Path>) -> Self {
        if let Some(file) = file {
            file.clone_into(&mut self.database);
        }
        self
    }

    /// Takes the rules from another folder than the site's.
    #[must_use]
    pub fn with_rules(mut self, folder: Option<&Path>) -> Self {
        self.rules = folder.map(Path::to_owned);
        self
    }

    /// Asks about another moment than the present: facts that end and opening hours are told as they are then.
    ///
    /// # Arguments
    /// `time` is written as [`moment`](Self::moment) reads it.
    pub fn at(mut self, time: Option<&str>) -> Result<Self> {
        self.at = time.map(|time| self.moment(time)).transpose()?;
        Ok(self)
    }

    /// Moves a start or goal at which nothing fits by up to so many metres, to the nearest point.
    pub fn within(mut self, metres: Option<f64>) -> Result<Self> {
        self.within = tolerance(metres)?;
        Ok(self)
    }

    /// A time as people write it: `2026-11-21T18:00` of the site's time zone, `2026-11-21` (its begin), `18:00` (the
    /// next one), `2h` or `3 days` (from now), or an instant with its offset (`2026-11-21T18:00:00Z`).
    pub fn moment(&self, text: &str) -> Result<Timestamp> {
        self.clock().parse(text)
    }

    pub(crate) fn clock(&self) -> Clock {
        Clock::new(self.at.or_else(|| self.dial.read()), self.site.zone.as_ref().unwrap_or(&TimeZone::UTC))
    }

    pub(crate) const fn is_map_alone(&self) -> bool {
        self.alone.is_some()
    }

    /// Refuses what a map alone cannot keep.
    pub(crate) fn needs_folder(&self) -> Result<()> {
        let Some((file, _)) = &self.alone else { return Ok(()) };
        let file = file.display();
        let message = format!("{file} is a map alone, which keeps no edits");
        let help = format!("edit the file, or `adit new DIR --map {file}` makes a site of it");
        Err(Error::said(Code::SiteMapAlone, message, Some(help)))
    }

    /// What a map alone is called in its database.
    fn called_alone(&self) -> Option<String> {
        let (file, _) = self.alone.as_ref()?;
        Some(file.file_name().unwrap_or_default().to_string_lossy().into_owned())
    }

    /// Refuses the database of another site, or of another map alone: its tables and its history would become this one's.
    ///
    /// `site.db` of the site's own folder is its own, whatever the site was called when it was built.
    pub(crate) fn refuse_anothers(&self, tx: &mut Tx<'_>) -> Result<()> {
        let called = self.called_alone();
        if called.is_none() && self.database == self.site.database() {
            return Ok(());
        }
        let Some(name) = tx.site_value("name")? else { return Ok(()) };
        let alone = tx.site_value(ALONE)?;
        if alone == called && (called.is_some() || name == self.site.name) {
            return Ok(());
        }
        let (database, this) = (self.database.display(), called.as_ref().unwrap_or(&self.site.name));
        let message = format!("{database} is the database of {name}, which {this} would be filled into");
        let help = match &called {
            None if alone.is_none() => {
                format!(
                    "name a file of its own; if {name} is what this site was called, say so in site.toml: name = \"{name}\""
                )
            }
            _ => "name a file of its own".to_owned(),
        };
        Err(Error::said(Code::DatabaseAnothers, message, Some(help)))
    }

    pub(crate) fn asks_about_another_moment(&self) -> bool {
        self.at.is_some()
    }

    /// The next build takes tables from their files again, those that are named or else all; what it replaces is in the history,
    /// as an edit of this author.
    #[must_use]
    pub fn reseeding(mut self, author: Author, tables: &[String]) -> Self {
        self.reseed = Some(Reseed { author, tables: tables.to_vec() });
        self
    }

    /// Who edits what is taken back again.
    pub(crate) fn nobody() -> Author {
        Author { who: NOBODY.to_owned(), why: String::new() }
    }

    pub(crate) fn planners(&self) -> &[Arc<dyn Planner>] {
        &self.planners
    }

    pub fn site(&self) -> &Site {
        &self.site
    }

    pub fn database(&self) -> &Path {
        &self.database
    }

    /// The rule bases that count, the lowest first.
    pub(crate) fn rule_bases(&self) -> Vec<Base> {
        rules::bases(&self.site, self.rules.as_deref())
    }

    /// The rules that count, compiled.
    pub(crate) fn rule_base(&self) -> Result<RuleBase> {
        Ok(self.load_rules()?.base)
    }

    /// The rules that count with the tests beside them.
    pub(crate) fn load_rules(&self) -> Result<Rules> {
        journal::recover(&self.database)?;
        rules::load(&self.site, self.rules.as_deref(), &self.drafts)
    }

    /// With drafts in place of the user's own rule files.
    pub(crate) fn drafting(&self, drafts: Drafts) -> Self {
        Self { drafts: Arc::new(drafts), ..self.clone() }
    }

    /// As it is once its drafts are files.
    pub(crate) fn with_drafts_saved(&self) -> Self {
        let mut saved = Self { drafts: Arc::default(), ..self.clone() };
        let own = Base::Folder(self.rule_folder());
        if self.rules.is_none() && self.rule_folder().exists() && saved.site.rules.last() != Some(&own) {
            saved.site.rules.push(own);
        }
        saved
    }

    /// The folder in which the user's own rules are written; it may be still to be made.
    pub fn rule_folder(&self) -> PathBuf {
        rules::own(&self.site, self.rules.as_deref())
    }

    /// What the rules would be worth if files of theirs held other texts; nothing is saved.
    ///
    /// # Arguments
    /// Files are called by their names in the folder of the rules, as `doors.rhai` or `tests/doors.toml`; one without a text
    /// would be gone.
    pub fn try_rules(&self, drafts: Drafts) -> Result<Tested> {
        let drafted = self.drafting(drafts);
        let Rules { base, tests, .. } = drafted.load_rules()?;
        let mut store = Store::open_read_only(&self.database)?;
        let (told, generation) =
            store.snapshot(|tx| -> Result<_> { Ok((self.told(tx, &base)?, generation::read(tx)?)) })?;
        Ok(Tested { generation, outcomes: drafted.trial(&base, &tests, &told)?, beneath: Vec::new() })
    }

    /// Runs tests of rules for which somebody waits.
    pub(crate) fn trial(&self, base: &RuleBase, tests: &RuleTests, told: &Told) -> Result<Vec<TestOutcome>> {
        let limits = Limits { inference: TRIAL, rule: TRIAL, ..Limits::default() };
        self.run_tests(base, tests, told, limits)
    }

    /// The files that a build reads, `site.toml` first.
    pub fn files(&self) -> Vec<PathBuf> {
        let mut files = self.site.files();
        files.extend(self.rule_bases().iter().filter_map(Base::folder).flat_map(base::files));
        files
    }

    /// Refuses to write what is made of the site into one of the files that it is made of.
    pub fn spare_own(&self, to: &Path) -> Result<()> {
        let Ok(place) = to.canonicalize() else { return Ok(()) };
        let is_it = |own: &PathBuf| own.canonicalize().is_ok_and(|own| own == place);
        if !self.files().iter().chain([&self.database]).any(is_it) {
            return Ok(());
        }
        let message = format!("{} is a file of which the site is made: it would be lost", to.display());
        Err(Error::said(Code::FileOwn, message, Some("name another file".to_owned())))
    }

    pub(crate) fn inputs(&self, progress: &dyn Progress) -> Result<Arc<Inputs>> {
        progress.stage("map");
        self.needs_course()?;
        let know = |world: &World| self.overlays.know(world);
        let rules = self.load_rules()?;
        Ok(Arc::new(Inputs::read(
            &self.site,
            rules,
            self.rules.as_deref(),
            (&self.planners, &self.asked()?),
            know,
        )?))
    }

    /// For what holds on to it while others go on.
    pub(crate) fn shared(&self) -> Arc<Self> {
        Arc::new(self.clone())
    }

    /// The states of a robot as they count: with the named tunings that are on, and the sizes that rules made of those in the
    /// table.
    pub fn states(&self, robot: &str) -> Result<Vec<State>> {
        let mut states = Store::open_read_only(&self.database)?.snapshot(states::in_force)?;
        states.retain(|state| state.robot == robot);
        Ok(states)
    }

    /// The map, with what the site and people lay over it.
    pub(crate) fn world(&self, tx: &mut Tx<'_>) -> Result<World> {
        let world = self.site.world()?;
        let laid = Laid::read(tx, &self.clock())?;
        Ok(if laid.is_empty() { world } else { laid.over(&world).0 })
    }

    /// Classes that are told: the tables of the robots, of the map, and those of the site's own that rules name.
    pub(crate) fn told(&self, tx: &mut Tx<'_>, rules: &RuleBase) -> Result<Told> {
        self.needs_course()?;
        let classes = Facts::from([
            ("ROBOTS".to_owned(), tables::robots(&tx.states()?)),
            ("CHANGES".to_owned(), tables::changes(&tx.changes()?)),
            ("LOADS".to_owned(), tables::loads(&tx.loads()?)),
            ("MEASURES".to_owned(), tables::measures(&tx.measures()?)),
        ]);
        let mut told = Told { classes, ..Told::default() };
        let keys = |table: &Table, parts: &[&str]| {
            classes::keys(table, &parts.iter().map(ToString::to_string).collect::<Vec<_>>())
        };
        let mut row_keys = RowKeys::new();
        for (class, table) in &told.classes {
            row_keys.insert(class.clone(), keys(table, classes::key_of(class)));
        }
        let planned = self.planned_classes();
        let of_map: Vec<String> = self.tables_of_map().into_iter().map(|of| of.name).collect();
        if self.course.is_some() {
            let places = tables::places(&tx.places()?);
            row_keys.insert(PLACES.to_owned(), keys(&places, &["place"]));
            told.classes.insert(PLACES.to_owned(), places);
        }
        for table in tx.user_tables()? {
            let class = table.name.to_uppercase();
            let named = of_map.contains(&table.name)
                || rules.rules().iter().any(|rule| rule.classes().any(|name| name == class));
            if named && !planned.contains(&class) {
                let relation = tx.read_table(&table.name)?;
                let read = tables::read(&relation)?;
                row_keys.insert(class.clone(), tables::keys(&relation));
                if tables::is_numbered(&relation) {
                    told.numbered.insert(class.clone());
                }
                told.classes.insert(class, read);
            }
        }
        told.keys = row_keys;
        told.notes = tunings::lay_over(&mut told.classes, &told.keys, &tunings::in_force(tx)?)?;
        self.tell_by_the_clock(tx, &mut told)?;
        if !told.facts.is_empty() {
            told.set_unfit_aside(&self.schema(&told));
        }
        Ok(told)
    }

    /// What holds at the moment only: opening hours, and facts that end.
    fn tell_by_the_clock(&self, tx: &mut Tx<'_>, told: &mut Told) -> Result<()> {
        let clock = &self.clock();
        let mut hours = self.site.hours.clone();
        hours.extend(tx.hours()?);
        let opening = Opening::new(&hours)?;
        told.classes.insert("HOURS".to_owned(), opening.class(clock));
        if self.site.zone.is_none() && !hours.is_empty() {
            told.notes.push("opening hours are read in UTC, since site.toml names no `timezone`".to_owned());
        }
        let now = stored(clock.now());
        let mut ends = Vec::from_iter(opening.next_change(clock).map(stored));
        for row in tx.facts_told()? {
            match &row.until {
                Some(until) if *until <= now => told.expired.push(row.id),
                until => {
                    ends.extend(until.clone());
                    told.facts.push(Fact::of(&row)?);
                }
            }
        }
        let laid = tx.laid()?.into_iter();
        ends.extend(laid.filter_map(|row| row.until).filter(|until| *until > now));
        told.laid = Laid::read(tx, clock)?;
        told.valid_until = ends.into_iter().min();
        told.valid_from = clock.is_ahead().then_some(now);
        Ok(())
    }

    /// Facts that the last build could not attach to anything, in sentences.
    pub fn lost(&self) -> Result<Vec<String>> {
        let (rows, standings) = Store::open_read_only(&self.database)?
            .snapshot(|tx| -> Result<_> { Ok((tx.facts_told()?, tx.standings()?)) })?;
        let is_lost =
            |id: i64| standings.iter().any(|standing| standing.told == id && standing.state == "lost");
        let facts = rows.iter().filter(|row| is_lost(row.id)).map(Fact::of).collect::<Result<Vec<_>>>()?;
        Ok(facts.iter().map(Fact::lost).collect())
    }

    pub(crate) fn planned_classes(&self) -> Vec<String> {
        let gives = self.planners.iter().flat_map(|planner| planner.signature().gives);
        let mut classes: Vec<String> = gives.map(|given| classes::split(&given).0.to_owned()).collect();
        classes.dedup();
        classes
    }

    pub(crate) fn schema(&self, told: &Told) -> Schema {
        let mut schema = Schema::default();
        for (class, table) in &told.classes {
            schema = schema.class(class, &[]);
            for (property, column) in &table.columns {
                let kind = match column {
                    Column::Number(_) => Type::Number,
                    Column::Text(_) => Type::Text,
                    Column::Truth(_) => Type::Truth,
                };
                schema.add(class, property, kind);
            }
            classes::declare_key(&mut schema, class, table.columns.first().map(|(name, _)| name.as_str()));
        }
        for planner in &self.planners {
            classes::declare(&mut schema, &planner.signature().gives);
        }
        classes::declare(&mut schema, &classes::ROUTES_GIVE.map(str::to_owned));
        for asked in self.asks() {
            schema = schema.class(asked.name, &asked.told);
        }
        if let Some(course) = &self.course {
            course.declare(&mut schema, &told.classes);
        }
        told.declare(&mut schema);
        schema
    }

    /// Refuses rules with names or types that cannot be right, and rules that fail a test beside them.
    pub(crate) fn vet(&self, rules: &RuleBase, tests: &RuleTests, told: &Told) -> Result<()> {
        let failures: Vec<_> = self
            .run_tests(rules, tests, told, Limits::default())?
            .into_iter()
            .flat_map(|outcome| outcome.failures)
            .collect();
        if failures.is_empty() {
            return Ok(());
        }
        // what a rule sets and nothing reads is often why
        let failures = failures.into_iter().map(|failure| Finding::from(failure.diagnostic));
        Err(Error::all(failures.chain(lint::unread(&self.site, rules, &self.planners, &self.asked()?))))
    }

    /// Refuses rules that speak of what there is not; what there is.
    pub(crate) fn spoken(&self, rules: &RuleBase, told: &Told) -> Result<Schema> {
        let schema = self.schema(told);
        let problems = rules.check(&schema);
        let errors: Vec<_> =
            problems.into_iter().filter(|problem| problem.severity == adit_engine::Severity::Error).collect();
        if errors.is_empty() { Ok(schema) } else { Err(Error::all(errors)) }
    }

    /// Runs tests; all of them together may take what one inference may.
    fn run_tests(
        &self,
        rules: &RuleBase,
        tests: &RuleTests,
        told: &Told,
        limits: Limits,
    ) -> Result<Vec<TestOutcome>> {
        let mut schema = self.spoken(rules, told)?;
        // the rows of what rules tell objects of are numbered, in a test as in the database
        for class in rules.tells() {
            if schema.key_of(class).is_some_and(|key| key == ["row"]) {
                schema.set_key(class, &[]);
            }
        }
        let mut given = self.planned_classes();
        given.extend(tables::unbuilt().into_keys().chain([classes::ROUTES.to_owned()]));
        let asked: Vec<&str> = self.asks().into_iter().map(|class| class.name).collect();
        let amiss = lint::reactions(rules, &given, classes::ROUTES, &asked);
        if !amiss.is_empty() {
            return Err(Error::all(amiss));
        }
        tests.run_within(rules, &schema, limits).map_err(|problems| Error::all(problems.0))
    }

    /// Runs the tests of the rule base that is in force; nothing is changed.
    pub fn test(&self) -> Result<Tested> {
        let Rules { base, tests, beneath } = self.load_rules()?;
        let (told, generation) = if self.database.exists() {
            let mut store = Store::open_read_only(&self.database)?;
            store.snapshot(|tx| -> Result<_> { Ok((self.told(tx, &base)?, generation::read(tx)?)) })?
        } else {
            self.needs_course()?;
            let of_map = self.tables_of_map().into_iter().chain(files::read(&self.site.tables())?);
            let mut classes = tables::unbuilt();
            classes.extend(of_map.map(|table| (table.name.to_uppercase(), table.class())));
            (Told { classes, ..Told::default() }, 0)
        };
        let limits = Limits::default();
        let outcomes = self.run_tests(&base, &tests, &told, limits)?;
        let beneath = beneath.into_iter().map(|(name, tests)| {
            let (outcomes, trouble) = match self.run_tests(&base, &tests, &told, limits) {
                Ok(outcomes) => (outcomes, None),
                Err(trouble) => (Vec::new(), Some(trouble)),
            };
            Beneath { base: name, outcomes, trouble }
        });
        Ok(Tested { generation, outcomes, beneath: beneath.collect() })
    }

    pub(crate) fn robots(&self, tx: &mut Tx<'_>) -> Result<Vec<String>> {
        let mut robots: Vec<String> = tx.states()?.into_iter().map(|state| state.robot).collect();
        robots.dedup();
        if robots.len() > 1 && self.site.rooms != Rooms::ByState {
            let named = robots.join(", ");
            let message = format!(
                "rooms = \"{}\" weighs doors for one robot, and this site has {named}",
                self.site.rooms.name()
            );
            return Err(Error::said(Code::SiteRobots, message, Some("use rooms = \"by-state\"".to_owned())));
        }
        Ok(robots)
    }

    /// Says what the database now stands for.
    pub(crate) fn sign(&self, tx: &mut Tx<'_>, rules: &RuleBase) -> Result<()> {
        tx.set_site_value("texts", Some(&self.site.texts().to_string()))?;
        tx.set_site_value("name", Some(&self.site.name))?;
        tx.set_site_value(ALONE, self.called_alone().as_deref())?;
        tx.set_site_value("rooms", Some(self.site.rooms.name()))?;
        tx.set_site_value(LAYOUT, self.course.as_ref().map(|course| course.name()))?;
        let own: Vec<String> = tx.user_tables()?.into_iter().map(|table| table.name).collect();
        let of_map: Vec<String> = self.tables_of_map().into_iter().map(|of| of.name).collect();
        let read = |table: &&String| {
            let class = table.to_uppercase();
            of_map.contains(table)
                || rules.rules().iter().any(|rule| rule.classes().any(|name| name == class))
        };
        let watched: Vec<&str> = own.iter().filter(read).map(String::as_str).collect();
        tx.watch_tables(&watched)?;
        over::keep(tx, rules)?;
        tx.mark_fresh()?;
        Ok(())
    }
}

/// How far a start or goal may be moved to where something fits, metres.
pub(crate) fn tolerance(metres: Option<f64>) -> Result<Option<f64>> {
    match metres {
        Some(metres) if !(0.0..=MOST_M).contains(&metres) => {
            let metres = number(metres);
            let message = format!(
                "a start or goal may be moved within 0 to {} metres, and not within {metres}",
                number(MOST_M)
            );
            Err(Error::said(Code::RouteWithin, message, None))
        }
        _ => Ok(metres),
    }
}
