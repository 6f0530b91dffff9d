//! A site: a folder with `site.toml`, which names its map, robot table and rule base.

pub(crate) mod alone;
pub(crate) mod base;
pub(crate) mod calm;
pub(crate) mod clock;
pub(crate) mod driving;
pub(crate) mod figures;
pub(crate) mod hours;
pub(crate) mod journal;
pub(crate) mod lint;
pub(crate) mod lock;
pub(crate) mod over;
pub(crate) mod robots;
pub(crate) mod rules;
pub(crate) mod shared;
pub(crate) mod sheet;
pub(crate) mod shipped;
pub(crate) mod states;
pub(crate) mod tables;
pub(crate) mod whole;

use std::fs;
use std::hash::{Hash, Hasher};
use std::path::{Path, PathBuf};

use adit_planners::geometry::Rect;
use adit_planners::lanes::is_lane_graph;
use adit_planners::read::{
    AreaFile, Code, Document, Fields, MapReport, MapSettings, Overlay, Problem, Unknown, nearest, read_map,
    read_world,
};
use adit_planners::world::{Place, World};
use jiff::tz::TimeZone;
use toml::de::DeValue;

use crate::error::{self, Error, Result};
use crate::site::base::Base;
use crate::site::driving::Driving;
use crate::site::tables::TableFile;
use crate::words::suggest::did_you_mean;
use siphasher::sip::SipHasher13;

/// How a map is cut into rooms.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default)]
pub enum Rooms {
    /// A layer of rooms for each state in which a robot can move.
    #[default]
    ByState,
    /// The paper's greedy choice among prime areas.
    Paper,
    /// As few rectangles as possible.
    Minimum,
    /// There is no map: tables and rules alone.
    Nothing,
}

impl Rooms {
    /// The names in `site.toml`.
    pub const NAMES: [(&'static str, Self); 4] = [
        ("by-state", Self::ByState),
        ("paper", Self::Paper),
        ("minimum", Self::Minimum),
        ("none", Self::Nothing),
    ];

    /// The name in `site.toml`.
    pub fn name(self) -> &'static str {
        Self::NAMES.iter().find(|(_, mode)| *mode == self).map_or("by-state", |(name, _)| name)
    }

    /// The shipped rule base that goes with it.
    pub fn rule_base(self) -> Option<&'static str> {
        match self {
            Self::ByState => Some("rooms/by-state"),
            Self::Paper | Self::Minimum => Some("rooms/paper"),
            Self::Nothing => None,
        }
    }
}

#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Starts {
    All,
    Named(Vec<String>),
}

/// What `site.toml` says.
#[derive(Clone, Debug)]
pub struct Site {
    pub folder: PathBuf,
    pub name: String,
    pub map: PathBuf,
    /// The file that seeds the robot table.
    pub robots: PathBuf,
    /// The rule bases that count, the lowest first.
    pub rules: Vec<Base>,
    /// How the map is cut into rooms.
    pub rooms: Rooms,
    /// What the map is, where it is not cut into rooms.
    pub layout: Option<Layout>,
    /// From where routes are kept; `None`: not said.
    pub starts: Option<Starts>,
    /// When what is open, as the file says.
    pub hours: Vec<adit_db::hours::Hours>,
    /// In which time zone times are read; UTC where the file names none.
    pub zone: Option<TimeZone>,
    settings: MapSettings,
    overlay: Overlay,
    areas: Vec<AreaFile>,
    /// How its robots drive, where the file says it.
    driving: Option<Driving>,
    text: String,
}

/// What a map is that is not cut into rooms: the table that its file has, or a lane graph of others.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Layout {
    /// Channels through which a robot drives.
    Corridor,
    /// Channels through which a part leaves another one.
    Assembly,
    /// Walls, between which a robot walks from region to region.
    FloorPlan,
    /// Objects, among which an arm or a disc moves from goal to goal.
    Cell,
    /// Nodes and lanes, on which fleets drive.
    Lanes,
}

impl Layout {
    const TABLES: [(&'static str, Self); 4] = [
        ("corridor", Self::Corridor),
        ("assembly", Self::Assembly),
        ("floor_plan", Self::FloorPlan),
        ("cell", Self::Cell),
    ];

    /// What the map in a file is; `None` where it is cut into rooms, or cannot be read.
    pub fn of(map: &Path) -> Option<Self> {
        if map.extension().is_none_or(|extension| extension != "toml") {
            return is_lane_graph(map).then_some(Self::Lanes);
        }
        let text = fs::read_to_string(map).ok()?;
        let document = Document::parse("map", &text).ok()?;
        let fields = document.fields("the map");
        Self::TABLES.into_iter().find(|(table, _)| fields.get(table).is_some()).map(|(_, layout)| layout)
    }

    /// Refuses a map that has one of the tables by a misspelt name: it would be read as one that is cut into rooms.
    pub fn refuse_slips(map: &Path) -> Result<()> {
        if map.extension().is_none_or(|extension| extension != "toml") || Self::of(map).is_some() {
            return Ok(());
        }
        let Ok(text) = fs::read_to_string(map) else { return Ok(()) };
        let name = map.display().to_string();
        let Ok(document) = Document::parse(&name, &text) else { return Ok(()) };
        let fields = document.fields("the map");
        let tables = Self::TABLES.map(|(table, _)| table);
        for (key, _) in fields.table {
            let Some(meant) = nearest(key.get_ref(), &tables) else { continue };
            let message = format!("`{}` is no table of a map", key.get_ref());
            let problem = fields.text.problem(Code::UnknownKey, &key.span(), message);
            return Err(Error::all([problem.with_help(format!("did you mean `[{meant}]`?"))]));
        }
        Ok(())
    }

    /// The file that a map of walls names, where it has them in a file of their own.
    pub fn beside(map: &Path) -> Option<PathBuf> {
        let text = fs::read_to_string(map).ok()?;
        let document = Document::parse("map", &text).ok()?;
        let whole = document.fields("the map");
        let fields = whole.table("floor_plan", "[floor_plan]", &mut Vec::new())?;
        let file = ["file", "map"].into_iter().find(|key| fields.get(key).is_some())?;
        Some(map.with_file_name(fields.string(file, &mut Vec::new())?.value))
    }

    /// The rule bases that lie beneath the site's own, the lowest first: those that the map's file names, or the shipped one.
    fn rule_bases(self, map: &Path) -> Vec<Base> {
        let text = fs::read_to_string(map).unwrap_or_default();
        let named = Document::parse("map", &text).ok().and_then(|document| {
            let fields = document.fields("the map");
            fields.get("rules")?;
            Some(fields.string("rules", &mut Vec::new())?.value)
        });
        let names = match named.as_deref() {
            None | Some("corrected" | "navigation" | "adapt") => vec![self.rule_base()],
            Some("printed") => vec![self.rule_base(), "channels/printed"],
            Some(folder) => vec![folder],
        };
        let beside = map.parent().unwrap_or(Path::new(""));
        names.into_iter().map(|name| Base::named(name, beside)).collect()
    }

    /// The shipped rule base that goes with it.
    pub const fn rule_base(self) -> &'static str {
        match self {
            Self::Corridor | Self::Assembly => "channels/corrected",
            Self::FloorPlan => "navigation",
            Self::Cell => "adapt",
            Self::Lanes => "lanes",
        }
    }
}

/// What a site is called that gives itself no name: as its folder is.
fn name_of(folder: &Path) -> String {
    let whole = folder.canonicalize().unwrap_or_else(|_| folder.to_owned());
    whole.file_name().map_or_else(|| folder.display().to_string(), |name| name.to_string_lossy().into_owned())
}

/// The keys of a site whose map is not cut into rooms.
const KEYS_WITHOUT_ROOMS: [&str; 7] = ["name", "map", "rules", "starts", "hours", "timezone", "place"];

/// The keys of a site without a map.
const KEYS_WITHOUT_MAP: [&str; 5] = ["name", "rules", "rooms", "hours", "timezone"];

const KEYS: [&str; 14] = [
    "name",
    "map",
    "robots",
    "rules",
    "rooms",
    "starts",
    "unknown",
    "speck_area",
    "grid",
    "clearance",
    "hours",
    "timezone",
    driving::NAVIGATION,
    driving::SENSORS,
];

impl Site {
    /// The folder of a site's own rules.
    pub const RULES: &str = "rules";

    /// Reads `site.toml` of a folder.
    pub fn open(folder: &Path) -> Result<Self> {
        let file = folder.join("site.toml");
        let text = fs::read_to_string(&file).map_err(|error| no_site(folder, &file, &error))?;
        let name = file.display().to_string();
        if text.trim().is_empty() {
            // an editor empties a file before it writes it, and without a site's areas robots go where they must not
            let help =
                "it names the map, the robots and what lies over the map; one line does: name = \"my site\"";
            let message = format!("{name} is empty");
            return Err(Error::said(crate::error::Code::SiteMissing, message, Some(help.to_owned())));
        }
        let document = Document::parse(&name, &text).map_err(|error| Error::all(error.problems))?;
        let fields = document.fields("site.toml");
        let mut problems = Vec::new();
        let path =
            |value: Option<String>, default: &str| folder.join(value.unwrap_or_else(|| default.to_owned()));
        let mut rooms = rooms(&fields, &mut problems);
        let map = path(optional_text(&fields, "map", &mut problems), "map.toml");
        let layout = if rooms == Rooms::Nothing { None } else { Layout::of(&map) };
        if rooms != Rooms::Nothing {
            Layout::refuse_slips(&map)?;
        }
        if rooms == Rooms::Nothing {
            fields.refuse_unknown(&KEYS_WITHOUT_MAP, &mut problems);
        } else if layout.is_some() {
            fields.refuse_unknown(&KEYS_WITHOUT_ROOMS, &mut problems);
            rooms = Rooms::Nothing;
        } else {
            fields.refuse_unknown(&[&KEYS[..], &AreaFile::KEYS, &Overlay::KEYS].concat(), &mut problems);
        }
        let named = |names: Vec<String>| names.iter().map(|name| Base::named(name, folder)).collect();
        let beneath = match (named_rules(&fields, &mut problems), layout) {
            (Some(names), _) => named(names),
            (None, Some(layout)) => layout.rule_bases(&map),
            (None, None) => named(rooms.rule_base().map(str::to_owned).into_iter().collect()),
        };
        let site = Self {
            folder: folder.to_owned(),
            name: optional_text(&fields, "name", &mut problems).unwrap_or_else(|| name_of(folder)),
            map,
            robots: path(optional_text(&fields, "robots", &mut problems), "robots.toml"),
            rules: with_own(folder, beneath),
            rooms,
            layout,
            starts: starts(&fields, &mut problems),
            hours: hours::read(&fields, &mut problems),
            zone: zone(&fields, &mut problems),
            settings: settings(&fields, &mut problems),
            overlay: Overlay::from_fields(&fields, &mut problems),
            areas: AreaFile::from_fields(&fields, folder, &mut problems),
            driving: driving(&fields, &mut problems),
            text: text.clone(),
        };
        site.check_clearance(&fields, &mut problems);
        if problems.is_empty() { Ok(site) } else { Err(Error::all(problems)) }
    }

    /// Refuses a clearance that no room would keep.
    fn check_clearance(&self, fields: &Fields<'_, '_>, problems: &mut Vec<Problem>) {
        if self.rooms == Rooms::ByState || self.settings.clearance <= 0.0 {
            return;
        }
        if let Some(value) = fields.get("clearance") {
            let message = format!("`clearance` is not kept where `rooms` is \"{}\"", self.rooms.name());
            let problem = fields.text.problem(Code::Impossible, &value.span(), message);
            problems
                .push(problem.with_help("make the states wider in robots.toml, or cut rooms \"by-state\""));
        }
    }

    /// The database, unless the user names another one.
    pub fn database(&self) -> PathBuf {
        self.folder.join("site.db")
    }

    /// The folder of tables that seed the site's own.
    pub fn tables(&self) -> PathBuf {
        self.folder.join("tables")
    }

    /// The tables that `site.toml` fills.
    pub fn tables_within(&self) -> Vec<TableFile> {
        let file = self.folder.join("site.toml");
        self.driving.iter().flat_map(|driving| driving.tables(&file)).collect()
    }

    /// Whether there is a map that is cut into rooms, and so states of robots.
    pub fn has_rooms(&self) -> bool {
        self.rooms != Rooms::Nothing
    }

    /// From where routes over rooms are kept; `None`: not said.
    pub fn starts_in_rooms(&self) -> Option<&Starts> {
        self.starts.as_ref().filter(|_| self.has_rooms())
    }

    /// The places that `site.toml` names.
    pub fn places(&self) -> impl Iterator<Item = &Place> {
        self.overlay.places()
    }

    /// Refuses what needs rooms where there are none.
    pub fn needs_rooms(&self) -> Result<()> {
        if self.has_rooms() {
            return Ok(());
        }
        if self.layout.is_some() {
            let message = format!("the map of {} is not cut into rooms, as this needs it to be", self.name);
            let help = "`route`, `why`, `why-not`, `tune` and SQL work on every kind of map".to_owned();
            return Err(Error::said(error::Code::CourseUnfit, message, Some(help)));
        }
        let message = format!("{} has no map: it has tables and rules, and no rooms or routes", self.name);
        let help =
            "site.toml says `rooms = \"none\"`; what rules conclude is in the view `conclusions`".to_owned();
        Err(Error::said(error::Code::SiteNoMap, message, Some(help)))
    }

    /// Refuses to move an end of a route over a map that is not cut into rooms.
    pub fn moves_ends(&self, within: Option<f64>) -> Result<()> {
        if within.is_none() || self.has_rooms() {
            return Ok(());
        }
        let message =
            format!("ends of routes are not moved on the map of {}: it is not cut into rooms", self.name);
        Err(Error::said(error::Code::CourseUnfit, message, Some("leave `within` out".to_owned())))
    }

    /// The files that it is made of, besides its rules: `site.toml` first.
    pub fn files(&self) -> Vec<PathBuf> {
        let mut files = vec![self.folder.join("site.toml")];
        files.extend(tables::files(&self.tables()));
        files.extend(self.layout.map(|_| self.map.clone()));
        files.extend(self.layout.and_then(|_| Layout::beside(&self.map)));
        if !self.has_rooms() {
            return files;
        }
        files.extend([self.map.clone(), self.robots.clone()]);
        let is_text = self.map.is_file() && self.map.extension().is_none_or(|extension| extension != "toml");
        if is_text && let Ok(text) = fs::read_to_string(&self.map) {
            let image = text.lines().find_map(|line| line.strip_prefix("image:"));
            let image = image.map(|image| image.trim().trim_matches(['"', '\'']));
            files.extend(image.map(|image| self.map.with_file_name(image)));
        }
        files.extend(self.areas.iter().flat_map(AreaFile::files));
        files
    }

    /// A number that changes with the texts of `site.toml` and of the map's own file (not of its image).
    pub fn texts(&self) -> u64 {
        let map = if self.map.is_file() { fs::read(&self.map).unwrap_or_default() } else { Vec::new() };
        let mut hasher = SipHasher13::new();
        (&self.text, map).hash(&mut hasher);
        for areas in &self.areas {
            areas.hash_text(&mut hasher);
        }
        hasher.finish()
    }

    /// The site that a map is the map of: the one in its folder, if it names it.
    pub fn of_map(map: &Path) -> Result<Option<Self>> {
        let folder = map.parent().unwrap_or(Path::new(""));
        if !folder.join("site.toml").is_file() {
            return Ok(None);
        }
        let site = Self::open(folder)?;
        let is_same = fs::canonicalize(&site.map).ok() == fs::canonicalize(map).ok();
        Ok(is_same.then_some(site))
    }

    /// Lays over its map what `site.toml` says, and gives notes.
    pub fn lay_over(&self, map: &mut World) -> Result<Vec<Problem>> {
        let mut notes = self.overlay.clone().lay_over(map).map_err(|errors| Error::all(errors.problems))?;
        for areas in &self.areas {
            notes.extend(areas.lay_over(map).map_err(|errors| Error::all(errors.problems))?);
        }
        Ok(notes)
    }

    /// Reads the map and lays over it what `site.toml` says.
    pub fn world(&self) -> Result<World> {
        if !self.has_rooms() {
            return Ok(World::empty(Rect::new(0.0, 0.0, 1.0, 1.0)));
        }
        let read = read_world(&self.map, &self.settings);
        let (mut world, _) = read.map_err(|errors| Error::all(errors.problems))?;
        self.lay_over(&mut world)?;
        Ok(world)
    }

    /// As [`world`](Self::world), with what it cost or gave of free space to read it so, and notes.
    pub fn measured_world(&self) -> Result<(World, MapReport, Vec<Problem>)> {
        if !self.has_rooms() {
            return Ok((self.world()?, MapReport::default(), Vec::new()));
        }
        let (mut world, report) =
            read_map(&self.map, &self.settings).map_err(|errors| Error::all(errors.problems))?;
        let mut notes = report.notes.clone();
        notes.extend(self.lay_over(&mut world)?);
        Ok((world, report, notes))
    }
}

fn no_site(folder: &Path, file: &Path, error: &std::io::Error) -> Error {
    if error.kind() != std::io::ErrorKind::NotFound {
        return Error::io("read", file, error);
    }
    if folder.to_string_lossy().starts_with("postgres") && folder.to_string_lossy().contains("://") {
        let message =
            "a site in PostgreSQL is asked and edited through a service (`adit serve FOLDER --database URL`)";
        let help = "`adit copy URL FOLDER` brings it into a folder, for commands";
        return Error::said(error::Code::SiteMissing, message, Some(help.to_owned()));
    }
    if !folder.exists() {
        let message = format!("there is no folder and no file {}", folder.display());
        let help = match folder.extension() {
            Some(_) => "say where the map's file is".to_owned(),
            None => format!("`adit new {}` starts a site", folder.display()),
        };
        return Error::said(error::Code::SiteMissing, message, Some(help));
    }
    Error::said(
        error::Code::SiteMissing,
        format!("{} is not a site: it has no site.toml", folder.display()),
        Some(format!("`adit new {}` starts one", folder.display())),
    )
}

/// These rule bases with the site's folder `rules` over them, which always counts.
fn with_own(folder: &Path, mut bases: Vec<Base>) -> Vec<Base> {
    let own = folder.join(Site::RULES);
    let is_own = |base: &Base| {
        let same = |one: &Path| fs::canonicalize(one).ok() == fs::canonicalize(&own).ok();
        base.folder().is_some_and(|folder| folder == own || same(folder))
    };
    // a link that leads nowhere is there as well: it is read, and the error says so
    if fs::symlink_metadata(&own).is_ok() && !bases.iter().any(is_own) {
        bases.push(Base::Folder(own));
    }
    bases
}

fn named_rules(fields: &Fields<'_, '_>, problems: &mut Vec<Problem>) -> Option<Vec<String>> {
    let value = fields.get("rules")?;
    let found = match value.get_ref() {
        DeValue::String(name) => Some(vec![name.to_string()]),
        _ => texts(value).filter(|names| !names.is_empty()),
    };
    if found.is_none() {
        let message = "`rules` must be a rule base or a list of some, the lowest first";
        let help = "a folder, or one that the program carries, like \"rooms/by-state\"; the site's folder `rules` lies over them";
        problems.push(fields.text.problem(Code::WrongType, &value.span(), message).with_help(help));
    }
    found
}

/// A list of texts.
fn texts(value: &toml::Spanned<DeValue<'_>>) -> Option<Vec<String>> {
    let DeValue::Array(entries) = value.get_ref() else { return None };
    let text = |entry: &toml::Spanned<DeValue<'_>>| match entry.get_ref() {
        DeValue::String(text) => Some(text.to_string()),
        _ => None,
    };
    entries.iter().map(text).collect()
}

fn optional_text(fields: &Fields<'_, '_>, key: &str, problems: &mut Vec<Problem>) -> Option<String> {
    fields.get(key)?;
    fields.string(key, problems).map(|text| text.value)
}

fn rooms(fields: &Fields<'_, '_>, problems: &mut Vec<Problem>) -> Rooms {
    let names = Rooms::NAMES.map(|(name, _)| name);
    choice(fields, "rooms", &names, problems).map_or(Rooms::default(), |index| Rooms::NAMES[index].1)
}

/// The index of a text among those it may be.
fn choice(fields: &Fields<'_, '_>, key: &str, names: &[&str], problems: &mut Vec<Problem>) -> Option<usize> {
    fields.get(key)?;
    let text = fields.string(key, problems)?;
    let found = names.iter().position(|name| *name == text.value);
    if found.is_none() {
        let message = format!("`{key}` is `{}` and must be one of {}", text.value, names.join(", "));
        problems.push(fields.text.problem(Code::WrongType, &text.span, message));
    }
    found
}

fn zone(fields: &Fields<'_, '_>, problems: &mut Vec<Problem>) -> Option<TimeZone> {
    fields.get("timezone")?;
    let name = fields.string("timezone", problems)?;
    TimeZone::get(&name.value)
        .map_err(|_| {
            let known: Vec<String> = jiff::tz::db().available().map(|zone| zone.to_string()).collect();
            let help = did_you_mean(&name.value, known.iter().map(String::as_str));
            let message = format!("there is no time zone `{}`", name.value);
            let problem = fields.text.problem(Code::WrongType, &name.span, message);
            problems
                .push(problem.with_help(help.unwrap_or_else(|| "write one like Europe/Berlin".to_owned())));
        })
        .ok()
}

fn starts(fields: &Fields<'_, '_>, problems: &mut Vec<Problem>) -> Option<Starts> {
    let value = fields.get("starts")?;
    let found = match value.get_ref() {
        DeValue::String(all) if all == "all" => Some(Starts::All),
        _ => texts(value).map(Starts::Named),
    };
    if found.is_none() {
        let message = "`starts` must be \"all\" or a list of places and rooms";
        problems.push(fields.text.problem(Code::WrongType, &value.span(), message));
    }
    found
}

/// A number from 0 on.
pub(crate) fn not_negative(fields: &Fields<'_, '_>, key: &str, problems: &mut Vec<Problem>) -> Option<f64> {
    let number = fields.number(key, problems)?;
    if number.value >= 0.0 {
        return Some(number.value);
    }
    let message = format!("`{key}` is {} and must not be negative", number.value);
    problems.push(fields.text.problem(Code::NotPositive, &number.span, message));
    None
}

/// `[navigation]` and `[sensors]`: how robots drive on a site that is cut into rooms.
fn driving(fields: &Fields<'_, '_>, problems: &mut Vec<Problem>) -> Option<Driving> {
    let is_said = [driving::NAVIGATION, driving::SENSORS].iter().any(|table| fields.get(table).is_some());
    is_said.then(|| Driving::of_rooms().read(fields, ["[navigation]", "[sensors]"], problems))
}

fn settings(fields: &Fields<'_, '_>, problems: &mut Vec<Problem>) -> MapSettings {
    let mut settings = MapSettings::default();
    if let Some(index) = choice(fields, "unknown", &["wall", "free"], problems) {
        settings.unknown = [Unknown::Wall, Unknown::Free][index];
    }
    if fields.get("grid").is_some() {
        settings.grid = fields.positive("grid", problems).map(|grid| grid.value);
    }
    if fields.get("speck_area").is_some() {
        settings.speck_area = not_negative(fields, "speck_area", problems);
    }
    if fields.get("clearance").is_some() {
        settings.clearance = not_negative(fields, "clearance", problems).unwrap_or(settings.clearance);
    }
    settings
}
