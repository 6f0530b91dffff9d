//! `adit new`: a site to begin with.

mod questions;
mod robots;

use std::fs;
use std::path::{Path, PathBuf};

use adit_planners::read::{MapSettings, read_map};
use clap::Args;

use super::output::{json, line, program, quoted};
use crate::error::{Code, Error, Result};
use crate::plan::course_of;
use crate::site::shipped::{self, SITES};
use crate::site::whole::Whole;
use crate::site::{Layout, Rooms, Site};

#[derive(Args, Clone, Debug)]
pub struct NewArgs {
    /// The folder to make; the present one without
    pub dir: Option<PathBuf>,
    /// A map to copy into it: a TOML map, a ROS map.yaml with its image, or a lane graph of Open-RMF, Nav2 or LIF
    #[arg(long, value_name = "FILE")]
    pub map: Option<PathBuf>,
    /// A robot to begin with, of the size that such machines have: cart, forklift, humanoid, quadruped; several may be said
    #[arg(long, value_name = "ROBOT")]
    pub robot: Vec<String>,
    /// How the map is cut into rooms
    #[arg(long, value_name = "MODE", default_value = "by-state", value_parser = ["by-state", "paper", "minimum"])]
    pub rooms: String,
    /// Without a map: tables and rules alone, with an example of them
    #[arg(long, conflicts_with_all = ["map", "rooms", "robot"])]
    pub no_map: bool,
    /// Print the result as JSON
    #[arg(long)]
    pub json: bool,
}

/// Starts a site. Where that fails nothing of it is left.
pub fn run(args: &NewArgs) -> Result<()> {
    let args = &args.asked()?;
    let dir = args.dir.as_deref().unwrap_or(Path::new("."));
    if dir.join("site.toml").exists() {
        let message = format!("{} is a site already", dir.display());
        let help = format!("`adit build {}` builds it; another folder starts another one", dir.display());
        return Err(Error::said(Code::SiteExists, message, Some(help)));
    }
    if args.no_map {
        return without_map(args, dir);
    }
    if let Some((map, layout)) = args.map.as_ref().and_then(|map| Some((map, Layout::of(map)?))) {
        if !args.robot.is_empty() {
            let message = format!(
                "{} says itself which robots there are; --robot is for maps that are cut into rooms",
                map.display()
            );
            return Err(Error::said(Code::SiteUnknownRobot, message, None));
        }
        return without_rooms((args, dir), map, layout);
    }
    let robots = robots::text(&args.robot)?;
    let mode =
        Rooms::NAMES.iter().find(|(name, _)| *name == args.rooms).map_or(Rooms::default(), |(_, mode)| *mode);
    if let Some(map) = &args.map {
        // what is wrong with it is said where the user has it
        Layout::refuse_slips(map)?;
        read_map(map, &MapSettings::default()).map_err(|errors| Error::all(errors.problems))?;
    }
    let mut made = Whole::default();
    made.folder(dir)?;
    let map = if let Some(map) = &args.map {
        copy_map(map, dir, &mut made)?
    } else {
        made.file(&dir.join("map.toml"), robots::map(&args.robot))?;
        "map.toml".to_owned()
    };
    let rules = dir.join(Site::RULES);
    made.folder(&rules.join("tests"))?;
    let beneath = mode.rule_base().unwrap_or_default();
    made.file(&rules.join("own.rhai"), own_rules(beneath))?;
    made.file(&dir.join("robots.toml"), robots)?;
    made.file(&dir.join("site.toml"), site_text(dir, &map, mode))?;
    Site::open(dir)?.measured_world()?;
    made.keep();
    if args.json {
        return json(&serde_json::json!({"site": dir, "map": map, "rooms": mode.name()}));
    }
    line(&format!("{} is a site now:", dir.display()));
    line("  site.toml    what it is made of; places, bridges and obstacles may be laid over the map here");
    line(&format!(
        "  robots.toml  {}: its states, with height and width in metres, hardness per metre, action",
        if args.robot.is_empty() { robots::FIRST.to_owned() } else { args.robot.join(", ") }
    ));
    line(&format!("  rules/       your own rules, over those that the program carries ({beneath})"));
    line(&format!("next: {} build {}", program(), quoted(dir)));
    Ok(())
}

/// Starts a site of tables and rules alone: a copy of the shop that the program carries.
fn without_map(args: &NewArgs, dir: &Path) -> Result<()> {
    let mut made = Whole::default();
    for folder in ["", "tables", "rules", "rules/tests"] {
        let from = if folder.is_empty() { "shop".to_owned() } else { format!("shop/{folder}") };
        shipped::make(SITES, &from, &dir.join(folder), &mut made)?;
    }
    Site::open(dir)?;
    made.keep();
    if args.json {
        return json(&serde_json::json!({"site": dir, "map": null, "rooms": Rooms::Nothing.name()}));
    }
    line(&format!("{} is a site now, without a map:", dir.display()));
    line("  tables/      one file a table, NAME.csv: each seeds its table once");
    line("  rules/       what is concluded of them, with its tests");
    line(&format!("next: {} build {}", program(), quoted(dir)));
    Ok(())
}

/// Starts a site whose map is not cut into rooms: corridors, a part in another one, a lane graph.
fn without_rooms((args, dir): (&NewArgs, &Path), map: &Path, layout: Layout) -> Result<()> {
    // what is wrong with it is said where the user has it
    let course = course_of(map)?;
    let mut made = Whole::default();
    made.folder(dir)?;
    let name = copy_map(map, dir, &mut made)?;
    if let Some(beside) = Layout::beside(map) {
        copy_map(&beside, dir, &mut made)?;
    }
    let rules = dir.join(Site::RULES);
    made.folder(&rules.join("tests"))?;
    made.file(&rules.join("own.rhai"), own_rules(layout.rule_base()))?;
    made.file(&dir.join("site.toml"), text_without_rooms(dir, &name, layout))?;
    Site::open(dir)?;
    made.keep();
    if args.json {
        return json(&serde_json::json!({"site": dir, "map": name, "rooms": null, "layout": course.name()}));
    }
    let mut tables: Vec<String> = course.tables().into_iter().map(|table| table.name).collect();
    tables.extend((!course.places().is_empty()).then(|| "places".to_owned()));
    line(&format!("{} is a site now ({}):", dir.display(), course.name()));
    line(&format!("  {name}  fills the tables {} once; from then on they are the map", tables.join(", ")));
    line(&format!("  rules/  your own rules, over those that the program carries ({})", layout.rule_base()));
    line(&format!("next: {} build {}", program(), quoted(dir)));
    Ok(())
}

fn text_without_rooms(folder: &Path, map: &str, layout: Layout) -> String {
    let name = folder.file_name().map_or("site".to_owned(), |name| name.to_string_lossy().into_owned());
    let [name, map] = [name.as_str(), map].map(toml::Value::from);
    let base = layout.rule_base();
    let mut text = format!(
        r#"name = {name}
map  = {map}                # fills tables once; from then on `adit tune` changes them
# rules = "{base}"  # what lies beneath the folder rules; a folder, or a list of some; "rules": nothing does
"#
    );
    if matches!(layout, Layout::Corridor | Layout::FloorPlan | Layout::Lanes) {
        text.push_str(
            r#"# starts = ["dock"]      # from where routes are kept; every place without this line
# [[place]]                # in the map's coordinates
# name = "dock"
# at   = [1.0, 2.0]
"#,
        );
    }
    text
}

/// A map of the user's, with its image where it has one, under its own name.
fn copy_map(map: &Path, into: &Path, made: &mut Whole) -> Result<String> {
    let name = map.file_name().map(PathBuf::from).ok_or_else(|| {
        Error::said(
            Code::Map(adit_planners::read::Code::Unreadable),
            format!("{} is no file", map.display()),
            None,
        )
    })?;
    let text = fs::read_to_string(map).map_err(|error| Error::io("read", map, &error))?;
    let is_toml = name.extension().is_some_and(|extension| extension == "toml");
    let image = text
        .lines()
        .find_map(|line| line.strip_prefix("image:"))
        .map(|image| image.trim().trim_matches(['"', '\'']));
    if let Some(image) = image.filter(|_| !is_toml) {
        let from = map.parent().unwrap_or(Path::new("")).join(image);
        let file = Path::new(image).file_name().map(PathBuf::from).unwrap_or_default();
        let pixels = fs::read(&from).map_err(|error| Error::io("read", &from, &error))?;
        made.file(&into.join(&file), pixels)?;
        let renamed = text.replacen(image, &file.display().to_string(), 1);
        made.file(&into.join(&name), renamed)?;
    } else {
        made.file(&into.join(&name), text)?;
    }
    Ok(name.display().to_string())
}

/// The file in which a site's own rules begin.
fn own_rules(base: &str) -> String {
    format!(
        r#"// The rules of this site. They lie over those that the program carries: {base}.
// A rule here replaces the one of the same name there, and any other is added; `without "a rule"` takes one away.
// `adit rules SITE` lists what counts, `adit rules SITE "a rule"` prints one to begin with, `adit check SITE` says what is
// replaced. Tests of these rules lie in rules/tests/*.toml.
"#
    )
}

fn site_text(folder: &Path, map: &str, mode: Rooms) -> String {
    let name = folder.file_name().map_or("site".to_owned(), |name| name.to_string_lossy().into_owned());
    let [name, map] = [name.as_str(), map].map(toml::Value::from);
    format!(
        r#"name   = {name}
map    = {map}
robots = "robots.toml"     # seeds the table once; from then on `adit tune` changes it
rooms  = "{}"        # or "paper", "minimum"
# rules = "rooms/by-state" # what lies beneath the folder rules; a folder, or a list of some; "rules": nothing does
# starts = ["dock"]        # from where routes are kept; every place without this line

# For images:
# unknown    = "wall"      # or "free": what nobody has seen
# speck_area = 0.0         # square metres: smaller blobs of wall are noise; without it those that chance strewed (salt)
# grid       = 0.05        # metres: side of a cell of the rooms by state
# clearance  = 0.0         # metres kept free around every state

# Laid over any map, in its coordinates:
# [[place]]
# name = "dock"
# at   = [1.0, 2.0]
# [[bridge]]
# rect   = [3.0, 0.0, 4.0, 5.0]
# height = 1.3
# [[obstacle]]
# rect = [6.0, 0.0, 6.5, 2.0]
# [[area]]                  # rooms are cut along it; all its keys are for rules
# name = "stairs"
# kind = "keep-out"         # not entered
# rect = [2.0, 6.0, 5.0, 7.0]
# [[door]]                  # across an opening, from post to post
# name   = "ward door"
# from   = [5.0, 2.0]
# to     = [5.0, 3.0]
# closed = true
"#,
        mode.name()
    )
}
