//! The command line `adit`: its verbs, and what they print.

mod build;
mod cell;
mod curve;
mod demo;
mod doctor;
mod experiment;
mod firm;
mod fit;
mod learn;
mod new;
mod output;
mod picture;
mod plan;
mod route;
mod serve;
mod simulate;
mod sql;
mod tell;
mod test;
mod tune;
mod tuning;
mod watch;
mod why;

use std::path::PathBuf;
use std::process::ExitCode;

use clap::{Args, Parser, Subcommand};

/// A rule engine and knowledge base that tells a mobile robot which way to go and how to move.
#[derive(Parser, Debug)]
#[command(name = "adit", version, arg_required_else_help = true, max_term_width = 110)]
pub struct Cli {
    /// What to do.
    #[command(subcommand)]
    pub verb: Verb,
}

/// The verbs.
#[derive(Subcommand, Debug)]
pub enum Verb {
    /// Build the bundled examples, show rooms, routes and a picture, and say what to try next
    Demo(DemoArgs),
    /// Start a site: map, robot table, a copy of the rule base to edit
    New(NewArgs),
    /// Map, facts, rules, routes: into the site's database
    Build(BuildArgs),
    /// The action sequence from START to GOAL: a place, a room, or `x,y` in metres
    Route(RouteArgs),
    /// Edit one cell of a table as a transaction, and show what changes
    Tune(TuneArgs),
    /// Tell a fact about one object, with an end if it has one; list and retract what was told
    Tell(TellArgs),
    /// Named sets of edits: list, set, switch on and off, preview, compare
    Tuning(TuningArgs),
    /// Lint rules, tables and map without building
    Check(CheckArgs),
    /// Run the tests of the site's rules
    Test(TestArgs),
    /// Check, test and build on each save of a rule, the map or a table, until Ctrl-C
    Watch(WatchArgs),
    /// Why something is as it is: the rule and the facts behind it
    Why(WhyArgs),
    /// Why the route does not lead through a room or door: what that would cost, and what rules rejected there
    WhyNot(WhyNotArgs),
    /// How firm a route is: how far each hardness may change before another way is the best
    Firm(FirmArgs),
    /// The hardness that fits best what robots measured on their way
    Fit(FitArgs),
    /// A read-only SQL query on the site, or a small shell without QUERY
    Sql(SqlArgs),
    /// Draw the map with rooms, doors, hardness and a route, as SVG or PNG
    Draw(DrawArgs),
    /// The way of a part, a robot through corridors or over a floor plan, or of one that learns in a cell: a world of its own
    Plan(PlanArgs),
    /// Missions of a simulated robot on a floor plan, with obstacles that it does not know
    Simulate(SimulateArgs),
    /// A scenario of a robot that learns, over many seeds: what each strategy of repair costs (CSV, picture)
    Experiment(ExperimentArgs),
    /// Who changed what, when and why
    History(HistoryArgs),
    /// Take back the last edit, or edit N of the history
    Undo(UndoArgs),
    /// Serve the site: HTTP, live events, and the page where experts tune it
    Serve(ServeArgs),
    /// Who may do what by HTTP: add, list and remove tokens
    Token(TokenArgs),
    /// Integrity, versions, backup
    Doctor(DoctorArgs),
}

/// What every verb on a site takes.
#[derive(Args, Debug, Clone)]
pub struct SiteArgs {
    /// Folder of the site
    pub site: PathBuf,
    /// The database, instead of `site.db` in the site's folder
    #[arg(long, value_name = "FILE")]
    pub db: Option<PathBuf>,
    /// Folder of *.rhai files, instead of the site's own or the shipped ones
    #[arg(long, value_name = "DIR")]
    pub rules: Option<PathBuf>,
    /// Print the result as JSON
    #[arg(long)]
    pub json: bool,
}

/// `adit demo`.
#[derive(Args, Debug)]
pub struct DemoArgs {
    /// Where the example sites and pictures are written
    #[arg(long, value_name = "DIR", default_value = "adit-demo")]
    pub out: PathBuf,
    /// Print the result as JSON
    #[arg(long)]
    pub json: bool,
}

/// `adit new`.
#[derive(Args, Debug)]
pub struct NewArgs {
    /// The folder to make
    pub dir: PathBuf,
    /// A map to copy into it: a TOML map, or a ROS map.yaml with its image
    #[arg(long, value_name = "FILE")]
    pub map: Option<PathBuf>,
    /// How the map is cut into rooms
    #[arg(long, value_name = "MODE", default_value = "by-state", value_parser = ["by-state", "paper", "minimum"])]
    pub rooms: String,
    /// Print the result as JSON
    #[arg(long)]
    pub json: bool,
}

/// `adit build`.
#[derive(Args, Debug)]
pub struct BuildArgs {
    /// The site
    #[command(flatten)]
    pub site: SiteArgs,
    /// Take the robot table from the file again, instead of the database's
    #[arg(long)]
    pub reseed: bool,
    /// As if it were this time: `2026-11-21T18:00`, `18:00`, `2h`
    #[arg(long, value_name = "TIME")]
    pub at: Option<String>,
}

/// `adit route`.
#[derive(Args, Debug)]
pub struct RouteArgs {
    /// The site
    #[command(flatten)]
    pub site: SiteArgs,
    /// A place, a room or `x,y`
    #[arg(allow_hyphen_values = true)]
    pub start: String,
    /// A place, a room or `x,y`
    #[arg(allow_hyphen_values = true)]
    pub goal: String,
    /// Another goal, as often as you like; the route leads to the one that costs least
    #[arg(long = "or", value_name = "GOAL", allow_hyphen_values = true)]
    pub others: Vec<String>,
    /// Which robot, where the site has several
    #[arg(long)]
    pub robot: Option<String>,
    /// Print every step, not only where the action changes
    #[arg(long)]
    pub steps: bool,
    /// The route as it would be at this time: `2026-11-21T18:00`, `18:00`, `2h`
    #[arg(long, value_name = "TIME")]
    pub at: Option<String>,
}

/// `adit tune`.
#[derive(Args, Debug)]
pub struct TuneArgs {
    /// The site
    #[command(flatten)]
    pub site: SiteArgs,
    /// The table: robots, changes, or one of the site's own
    pub table: String,
    /// Key of the row; parts joined by `/` (`SQUAT`, `robot/SQUAT`, `robot/STAND/SQUAT`)
    pub key: String,
    /// The column, then its new value; with --add, `column=value` for each column
    #[arg(allow_negative_numbers = true)]
    pub cells: Vec<String>,
    /// Show what would change and change nothing
    #[arg(long)]
    pub dry_run: bool,
    /// Add a row
    #[arg(long, conflicts_with = "remove")]
    pub add: bool,
    /// Remove the row
    #[arg(long)]
    pub remove: bool,
    /// Why, for the history
    #[arg(long, value_name = "TEXT")]
    pub why: Option<String>,
}

/// `adit tell`.
#[derive(Args, Debug)]
pub struct TellArgs {
    /// The site
    #[command(flatten)]
    pub site: SiteArgs,
    /// The class: DOORS, ROOMS, ROBOTS, or any that rules read
    pub class: Option<String>,
    /// The object: its name, a point `x,y`, `door 7` or `room d`
    #[arg(allow_hyphen_values = true)]
    pub object: Option<String>,
    /// The property
    pub property: Option<String>,
    /// The value: a number, a text, `true` or `false`
    #[arg(allow_hyphen_values = true)]
    pub value: Option<String>,
    /// When it ends: `2026-11-21T18:00`, `18:00` (the next one), `2h`
    #[arg(long, value_name = "TIME")]
    pub until: Option<String>,
    /// Why, for the history
    #[arg(long, value_name = "TEXT")]
    pub why: Option<String>,
    /// Show what would change and change nothing
    #[arg(long)]
    pub dry_run: bool,
    /// Tell a property that no rule reads yet
    #[arg(long)]
    pub new: bool,
    /// Show what is told
    #[arg(long, conflicts_with_all = ["class", "retract"])]
    pub list: bool,
    /// Take a fact back, by its number in the list
    #[arg(long, value_name = "ID", conflicts_with = "class")]
    pub retract: Option<i64>,
    /// As if it were this time
    #[arg(long, value_name = "TIME")]
    pub at: Option<String>,
}

/// `adit tuning`.
#[derive(Args, Debug)]
#[command(after_help = "adit tuning SITE                                  lists the tunings\n\
adit tuning SITE NAME                             shows one\n\
adit tuning SITE NAME set TABLE KEY COLUMN VALUE  a cell that counts while it is on\n\
adit tuning SITE NAME unset TABLE KEY COLUMN      takes the cell out\n\
adit tuning SITE NAME on | off | preview          switches it, or shows what that would change\n\
adit tuning SITE compare A B                      routes between places, side by side; `base` is none")]
pub struct TuningArgs {
    /// The site
    #[command(flatten)]
    pub site: SiteArgs,
    /// The tuning, and what to do with it
    #[arg(allow_negative_numbers = true)]
    pub words: Vec<String>,
    /// Why, for the history
    #[arg(long, value_name = "TEXT")]
    pub why: Option<String>,
}

/// `adit check`.
#[derive(Args, Debug)]
pub struct CheckArgs {
    /// The site
    #[command(flatten)]
    pub site: SiteArgs,
}

/// `adit test`.
#[derive(Args, Debug)]
pub struct TestArgs {
    /// The site
    #[command(flatten)]
    pub site: SiteArgs,
}

/// `adit watch`.
#[derive(Args, Debug)]
pub struct WatchArgs {
    /// The site
    #[command(flatten)]
    pub site: SiteArgs,
}

/// `adit why`.
#[derive(Args, Debug)]
pub struct WhyArgs {
    /// The site
    #[command(flatten)]
    pub site: SiteArgs,
    /// What: `door 7`, `room d`, `doors.7`, `doors.7.hardness`; of a database of `adit simulate --db` instead of a site the
    /// number of a mission: why the robot stopped
    pub what: String,
    /// Of a mission: ask about what the robot did at this time instead of about its last stop
    #[arg(long, value_name = "SECONDS", allow_hyphen_values = true)]
    pub at: Option<f64>,
    /// Of a mission: the name of its world, where the database has several
    #[arg(long, value_name = "NAME")]
    pub world: Option<String>,
}

/// `adit why-not`.
#[derive(Args, Debug)]
pub struct WhyNotArgs {
    /// The site
    #[command(flatten)]
    pub site: SiteArgs,
    /// A place, a room or `x,y`
    #[arg(allow_hyphen_values = true)]
    pub start: String,
    /// A place, a room or `x,y`
    #[arg(allow_hyphen_values = true)]
    pub goal: String,
    /// The room or door: `room d`, `door 7`
    #[arg(long, value_name = "WHAT")]
    pub through: String,
    /// Which robot, where the site has several
    #[arg(long)]
    pub robot: Option<String>,
}

/// `adit firm`.
#[derive(Args, Debug)]
pub struct FirmArgs {
    /// The site
    #[command(flatten)]
    pub site: SiteArgs,
    /// A place, a room or `x,y`
    #[arg(allow_hyphen_values = true)]
    pub start: String,
    /// A place, a room or `x,y`
    #[arg(allow_hyphen_values = true)]
    pub goal: String,
    /// Which robot, where the site has several
    #[arg(long)]
    pub robot: Option<String>,
}

/// `adit fit`.
#[derive(Args, Debug)]
pub struct FitArgs {
    /// The site
    #[command(flatten)]
    pub site: SiteArgs,
    /// Add the traversals of a CSV file with the columns distance and measured, state or action, and perhaps mission,
    /// robot and measure: all of them or none
    #[arg(long, value_name = "FILE")]
    pub add: Option<PathBuf>,
    /// Remove all traversals first
    #[arg(long)]
    pub clear: bool,
    /// What was measured: seconds, joules, ...
    #[arg(long)]
    pub measure: Option<String>,
    /// The state that keeps its hardness; otherwise the one with the most metres
    #[arg(long, value_name = "STATE", conflicts_with = "per_metre")]
    pub reference: Option<String>,
    /// Take the measure a metre as hardness, and keep none
    #[arg(long)]
    pub per_metre: bool,
    /// Which robot, where the site has several
    #[arg(long)]
    pub robot: Option<String>,
}

/// `adit sql`.
#[derive(Args, Debug)]
pub struct SqlArgs {
    /// The site
    #[command(flatten)]
    pub site: SiteArgs,
    /// One SQL statement; without it, statements are read from standard input
    pub query: Option<String>,
    /// At most so many rows of an answer; that there are more is said
    #[arg(long, value_name = "ROWS", default_value_t = 1_000)]
    pub limit: usize,
}

/// `adit draw`.
#[derive(Args, Debug)]
pub struct DrawArgs {
    /// The site
    #[command(flatten)]
    pub site: SiteArgs,
    /// The picture: .svg or .png
    #[arg(short, long, value_name = "FILE")]
    pub output: PathBuf,
    /// What to draw, by commas: strips, primes, rooms, graph, weighted (the paper's Figures 4 to 9)
    #[arg(long, value_delimiter = ',', value_name = "LAYERS")]
    pub layer: Vec<String>,
    /// Draw the route from START to GOAL
    #[arg(long, num_args = 2, value_names = ["START", "GOAL"], allow_hyphen_values = true)]
    pub route: Option<Vec<String>>,
    /// The state whose layer of rooms is drawn, where rooms are by state
    #[arg(long)]
    pub state: Option<String>,
    /// Which robot, where the site has several
    #[arg(long)]
    pub robot: Option<String>,
    /// Width of a PNG in pixels
    #[arg(long, default_value_t = 1600, value_parser = clap::value_parser!(u32).range(64..=16384))]
    pub width: u32,
}

/// `adit plan`.
#[derive(Args, Debug)]
pub struct PlanArgs {
    /// The world: a TOML file with `[assembly]`, `[corridor]`, `[floor_plan]` or `[cell]`, or a scenario (.json)
    pub world: PathBuf,
    /// Where to start instead of where the world says, `x,y` in metres (corridors, floor plans); in a cell, the first goal
    #[arg(allow_hyphen_values = true)]
    pub start: Option<String>,
    /// Where to go, likewise; in a cell, the second goal
    #[arg(allow_hyphen_values = true)]
    pub goal: Option<String>,
    /// In a cell, the goals after that
    #[arg(value_name = "GOAL")]
    pub more: Vec<String>,
    /// What is for cells only
    #[command(flatten)]
    pub learning: LearningArgs,
    /// The rule base instead of the world's: `corrected`, `printed` or a folder
    #[arg(long, value_name = "RULES")]
    pub rules: Option<String>,
    /// The gap instead of the world's: metres, `x/z` for one an axis, `safest` or `rules`; several give a plan each
    #[arg(long, value_name = "GAPS", value_delimiter = ',')]
    pub gap: Vec<String>,
    /// Say at each junction which rule spoke, and why the others did not
    #[arg(long)]
    pub explain: bool,
    /// Keep facts, path and what rules said in this database
    #[arg(long, value_name = "FILE")]
    pub db: Option<PathBuf>,
    /// Draw it: .svg or .png; several gaps stand side by side
    #[arg(short, long, value_name = "FILE")]
    pub output: Option<PathBuf>,
    /// Print the result as JSON
    #[arg(long)]
    pub json: bool,
}

/// What `adit plan` takes for a robot that learns in a cell.
#[derive(Args, Debug)]
pub struct LearningArgs {
    /// After the goals, so many tasks with goals by chance (cells)
    #[arg(long, value_name = "N", default_value_t = 0, value_parser = clap::value_parser!(u32).range(0..=1_000_000))]
    pub tasks: u32,
    /// Of chance (cells); a database goes on with the seed that it was begun with
    #[arg(long, default_value_t = 1)]
    pub seed: u64,
    /// A path that is tried before any other is looked for, `[[a, b], ...]` (cells)
    #[arg(long, value_name = "PATH.json")]
    pub teach: Vec<PathBuf>,
    /// Begin with a copy of the experience of another cell (cells)
    #[arg(long, value_name = "CELL", requires = "db")]
    pub from: Option<String>,
    /// The database of that other cell, if not the same
    #[arg(long, value_name = "FILE", requires = "from")]
    pub from_db: Option<PathBuf>,
    /// What becomes of experience after a change, whatever rules say (cells)
    #[arg(long, value_parser = ["a0", "a1", "a2", "a3"])]
    pub strategy: Option<String>,
    /// Which scenario of a file with several (cells)
    #[arg(long, value_name = "NAME")]
    pub scenario: Option<String>,
}

/// `adit experiment`.
#[derive(Args, Debug)]
pub struct ExperimentArgs {
    /// A scenario, or several (.json)
    pub scenario: PathBuf,
    /// How often each scenario is run
    #[arg(long, value_name = "N", default_value_t = 100, value_parser = clap::value_parser!(u32).range(1..=1_000_000))]
    pub runs: u32,
    /// Of chance: the first run has this seed, each next one the next
    #[arg(long, default_value_t = 1)]
    pub seed: u64,
    /// What is compared, by commas
    #[arg(long, value_delimiter = ',', value_name = "STRATEGIES", default_value = "a0,a1,a2,a3,solve",
          value_parser = ["a0", "a1", "a2", "a3", "solve"])]
    pub strategy: Vec<String>,
    /// Only the scenario of this name
    #[arg(long, value_name = "NAME")]
    pub only: Option<String>,
    /// The rule base: `adapt` or a folder
    #[arg(long, value_name = "RULES", default_value = "adapt")]
    pub rules: String,
    /// Write a row for each scenario, strategy and task
    #[arg(long, value_name = "FILE")]
    pub csv: Option<PathBuf>,
    /// Draw the curves (the paper's Figure 5): .svg or .png
    #[arg(long, value_name = "FILE")]
    pub picture: Option<PathBuf>,
    /// Print the rows as JSON
    #[arg(long)]
    pub json: bool,
}

/// `adit simulate`.
#[derive(Args, Debug)]
pub struct SimulateArgs {
    /// The world: a TOML file with `[floor_plan]`
    pub world: PathBuf,
    /// Where to start, a place or `x,y`; without START and GOAL missions with obstacles are drawn by chance
    #[arg(allow_hyphen_values = true, requires = "goal")]
    pub start: Option<String>,
    /// Where to go, likewise
    #[arg(allow_hyphen_values = true)]
    pub goal: Option<String>,
    /// Where the robot looks at first, in degrees
    #[arg(long, default_value_t = 0.0, allow_hyphen_values = true)]
    pub heading: f64,
    /// How many missions
    #[arg(long, value_name = "N", default_value_t = 1, value_parser = clap::value_parser!(u32).range(1..=1_000_000))]
    pub missions: u32,
    /// Of chance; the same seed gives the same missions
    #[arg(long, default_value_t = 1)]
    pub seed: u64,
    /// The rule base instead of the world's: `navigation` or a folder
    #[arg(long, value_name = "RULES")]
    pub rules: Option<String>,
    /// Keep each mission with its journal in this database
    #[arg(long, value_name = "FILE")]
    pub db: Option<PathBuf>,
    /// Instead of missions, learn the building, of which the robot knows nothing but where it starts, a place or `x,y`;
    /// with --db what was learned is kept
    #[arg(long, value_name = "START", allow_hyphen_values = true, conflicts_with_all = ["start", "curve", "learned", "drive"])]
    pub learn: Option<String>,
    /// The direction of exploration that the user points out: towards a place or `x,y`
    #[arg(long, value_name = "WHERE", allow_hyphen_values = true, requires = "learn")]
    pub towards: Option<String>,
    /// The robot knows of the building what was learned of it and stands in --db
    #[arg(long, requires = "db", conflicts_with = "curve")]
    pub learned: bool,
    /// Instead of missions, drive by hand in the learned building: a file of orders, or `-` for standard input
    #[arg(long, value_name = "FILE", requires = "learned", conflicts_with_all = ["start", "film"])]
    pub drive: Option<PathBuf>,
    /// Instead of missions, drive from stop to stop, and draw how wrong the estimated pose is over the distance, with the
    /// walls known and with a model built on the way: .svg or .png; --missions says how many drives of each
    #[arg(long, value_name = "FILE", conflicts_with_all = ["start", "db", "film"])]
    pub curve: Option<PathBuf>,
    /// How far such a drive goes
    #[arg(long, value_name = "METRES", default_value_t = 200.0)]
    pub metres: f64,
    /// Make a film of a mission: an animated SVG
    #[arg(long, value_name = "FILE")]
    pub film: Option<PathBuf>,
    /// Which mission is filmed
    #[arg(long, value_name = "NUMBER", default_value_t = 1)]
    pub mission: usize,
    /// How many times as fast as time the film plays
    #[arg(long, value_name = "TIMES", default_value_t = 8.0)]
    pub speed: f64,
    /// Print a row a mission as JSON
    #[arg(long)]
    pub json: bool,
}

/// `adit history`.
#[derive(Args, Debug)]
pub struct HistoryArgs {
    /// The site
    #[command(flatten)]
    pub site: SiteArgs,
    /// How many edits, the latest first
    #[arg(long, default_value_t = 50)]
    pub limit: u32,
}

/// `adit undo`.
#[derive(Args, Debug)]
pub struct UndoArgs {
    /// The site
    #[command(flatten)]
    pub site: SiteArgs,
    /// Number of the edit in the history; the latest one without it
    pub edit: Option<i64>,
}

/// `adit serve`.
#[derive(Args, Debug)]
pub struct ServeArgs {
    /// The site
    #[command(flatten)]
    pub site: SiteArgs,
    /// Where to listen; port 0 takes any free one. To be reached from elsewhere the site needs tokens
    #[arg(long, value_name = "ADDRESS", default_value = "127.0.0.1:7373")]
    pub listen: std::net::SocketAddr,
    /// A name besides `localhost` and the address itself by which browsers may call the service
    #[arg(long = "host", value_name = "NAME")]
    pub hosts: Vec<String>,
    /// Seconds that one SQL query may take
    #[arg(long, value_name = "SECONDS", default_value_t = 1.0, value_parser = seconds)]
    pub sql_seconds: f64,
    /// Rows that one SQL query may give
    #[arg(long, value_name = "ROWS", default_value_t = 100_000)]
    pub sql_rows: usize,
    /// Seconds that an answer may take; an edit that has begun by then is waited for
    #[arg(long, value_name = "SECONDS", default_value_t = 60.0, value_parser = seconds)]
    pub answer_seconds: f64,
    /// Requests that are worked on at once; more are told to come back
    #[arg(long, value_name = "N", default_value_t = 1_024)]
    pub requests: usize,
    /// Streams of events that are open at once
    #[arg(long, value_name = "N", default_value_t = 256)]
    pub subscribers: usize,
}

/// A time of more than nothing and less than an hour.
fn seconds(text: &str) -> Result<f64, String> {
    let seconds: f64 = text.parse().map_err(|_| format!("`{text}` is no number"))?;
    if seconds > 0.0 && seconds < 3600.0 { Ok(seconds) } else { Err("between 0 and 3600 seconds".to_owned()) }
}

/// `adit token`.
#[derive(Args, Debug)]
pub struct TokenArgs {
    /// Folder of the site
    pub site: PathBuf,
    /// What to do
    #[command(subcommand)]
    pub verb: TokenVerb,
    /// Print the list as JSON
    #[arg(long)]
    pub json: bool,
}

/// What to do with tokens.
#[derive(Subcommand, Debug)]
pub enum TokenVerb {
    /// Make a token; it is printed this once
    Add {
        /// Who holds it: edits are kept under this name
        name: String,
        /// What the holder may do, besides reading; may stand several times
        #[arg(long = "role", value_enum, default_values = ["read"])]
        roles: Vec<crate::serve::role::Role>,
    },
    /// Who has a token, and what it allows
    List,
    /// Make a token void
    Remove {
        /// Who holds it
        name: String,
    },
}

/// `adit doctor`.
#[derive(Args, Debug)]
pub struct DoctorArgs {
    /// The site
    #[command(flatten)]
    pub site: SiteArgs,
    /// Write a copy of the database to this file
    #[arg(long, value_name = "FILE")]
    pub backup: Option<PathBuf>,
}

/// Runs a verb and prints what came of it.
///
/// # Returns
/// 0 done, 1 no route or a failed check, 2 unusable input.
pub fn run(cli: &Cli) -> ExitCode {
    let outcome = match &cli.verb {
        Verb::Demo(args) => demo::run(args).map(|()| 0),
        Verb::New(args) => new::run(args).map(|()| 0),
        Verb::Build(args) => build::run(args).map(|()| 0),
        Verb::Route(args) => route::run(args),
        Verb::Tune(args) => tune::tune(args).map(|()| 0),
        Verb::Tell(args) => tell::run(args).map(|()| 0),
        Verb::Tuning(args) => tuning::run(args).map(|()| 0),
        Verb::Check(args) => doctor::check(args).map(|sound| u8::from(!sound)),
        Verb::Test(args) => test::run(args).map(|passed| u8::from(!passed)),
        Verb::Watch(args) => watch::run(args).map(|()| 0),
        Verb::Why(args) => why::why(args).map(|()| 0),
        Verb::WhyNot(args) => why::why_not(args).map(|()| 0),
        Verb::Firm(args) => firm::run(args).map(|()| 0),
        Verb::Fit(args) => fit::run(args).map(|()| 0),
        Verb::Sql(args) => sql::run(args).map(|well| if well { 0 } else { 2 }),
        Verb::Draw(args) => picture::run(args).map(|()| 0),
        Verb::Plan(args) => plan::run(args).map(|found| u8::from(!found)),
        Verb::Simulate(args) => simulate::run(args).map(|right| u8::from(!right)),
        Verb::Experiment(args) => experiment::run(args).map(|found| u8::from(!found)),
        Verb::History(args) => tune::history(args).map(|()| 0),
        Verb::Undo(args) => tune::undo(args).map(|()| 0),
        Verb::Serve(args) => serve::run(args).map(|()| 0),
        Verb::Token(args) => serve::token(args).map(|()| 0),
        Verb::Doctor(args) => doctor::doctor(args).map(|sound| u8::from(!sound)),
    };
    match outcome {
        Ok(_) if output::is_lost() => ExitCode::from(2),
        Ok(status) => ExitCode::from(status),
        Err(error) => {
            if cli.verb.wants_json() {
                output::line(&serde_json::json!({"error": output::as_json(error.problems())}).to_string());
            }
            output::problems(error.problems());
            ExitCode::from(error.exit())
        }
    }
}

impl Verb {
    fn wants_json(&self) -> bool {
        match self {
            Self::Demo(args) => args.json,
            Self::New(args) => args.json,
            Self::Build(args) => args.site.json,
            Self::Route(args) => args.site.json,
            Self::Tune(args) => args.site.json,
            Self::Tell(args) => args.site.json,
            Self::Tuning(args) => args.site.json,
            Self::Check(args) => args.site.json,
            Self::Test(args) => args.site.json,
            Self::Watch(args) => args.site.json,
            Self::Why(args) => args.site.json,
            Self::WhyNot(args) => args.site.json,
            Self::Firm(args) => args.site.json,
            Self::Fit(args) => args.site.json,
            Self::Sql(args) => args.site.json,
            Self::Draw(args) => args.site.json,
            Self::Plan(args) => args.json,
            Self::Simulate(args) => args.json,
            Self::Experiment(args) => args.json,
            Self::History(args) => args.site.json,
            Self::Undo(args) => args.site.json,
            Self::Serve(args) => args.site.json,
            Self::Token(args) => args.json,
            Self::Doctor(args) => args.site.json,
        }
    }
}
