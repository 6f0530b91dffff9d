//! What several verbs take.

use std::path::PathBuf;

use clap::Args;

use crate::error::{Code, Error, Result};

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

/// Where to go on a site, and who goes.
#[derive(Args, Debug)]
pub struct WayArgs {
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

/// The heading at the start, radians.
pub fn heading(args: &SimulateArgs) -> Result<f64> {
    if (-360.0..=360.0).contains(&args.heading) {
        return Ok(args.heading.to_radians());
    }
    let message = format!("--heading {:?} is no heading; expected degrees from -360 to 360", args.heading);
    Err(Error::said(Code::SimulateHeading, message, None))
}
