//! The command line `adit`: its verbs, and what they print.

mod build;
mod demo;
mod doctor;
mod new;
mod output;
mod picture;
mod route;
mod sql;
mod test;
mod tune;
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
    /// A read-only SQL query on the site, or a small shell without QUERY
    Sql(SqlArgs),
    /// Draw the map with rooms, doors, hardness and a route, as SVG or PNG
    Draw(DrawArgs),
    /// Who changed what, when and why
    History(HistoryArgs),
    /// Take back the last edit, or edit N of the history
    Undo(UndoArgs),
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
    /// What: `door 7`, `room d`, `doors.7`, `doors.7.hardness`
    pub what: String,
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
        Verb::Route(args) => route::run(args).map(|outcome| match outcome {
            route::Outcome::Found => 0,
            route::Outcome::NoRoute => 1,
            route::Outcome::Unknown => 2,
        }),
        Verb::Tune(args) => tune::tune(args).map(|()| 0),
        Verb::Check(args) => doctor::check(args).map(|sound| u8::from(!sound)),
        Verb::Test(args) => test::run(args).map(|passed| u8::from(!passed)),
        Verb::Watch(args) => watch::run(args).map(|()| 0),
        Verb::Why(args) => why::why(args).map(|()| 0),
        Verb::WhyNot(args) => why::why_not(args).map(|()| 0),
        Verb::Sql(args) => sql::run(args).map(|well| if well { 0 } else { 2 }),
        Verb::Draw(args) => picture::run(args).map(|()| 0),
        Verb::History(args) => tune::history(args).map(|()| 0),
        Verb::Undo(args) => tune::undo(args).map(|()| 0),
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
            // no route, or a check that failed, is no unusable input
            let is_finding = |problem: &miette::Report| {
                let code = problem.code().map(|code| code.to_string());
                matches!(code.as_deref(), Some("draw/no-route" | "test/failed"))
            };
            ExitCode::from(if error.problems().iter().all(is_finding) { 1 } else { 2 })
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
            Self::Check(args) => args.site.json,
            Self::Test(args) => args.site.json,
            Self::Watch(args) => args.site.json,
            Self::Why(args) => args.site.json,
            Self::WhyNot(args) => args.site.json,
            Self::Sql(args) => args.site.json,
            Self::Draw(args) => args.site.json,
            Self::History(args) => args.site.json,
            Self::Undo(args) => args.site.json,
            Self::Doctor(args) => args.site.json,
        }
    }
}
