//! `adit lay` and `adit lift`.

use clap::Args;

use super::args::SiteArgs;
use super::build;
use super::tune::apply;
use crate::edit::{Edit, Lay, Thing};
use crate::error::Result;

#[derive(Args, Debug)]
pub struct LayArgs {
    #[command(flatten)]
    pub site: SiteArgs,
    /// A part of the floor of which rules speak, something that no robot comes through, a named point, something to pass
    /// under, or a doorway with a name
    #[arg(value_parser = ["area", "obstacle", "place", "bridge", "door"])]
    pub what: String,
    /// Its name
    pub name: String,
    /// Its corners in their order, metres: `"1,2 3,2 3,4"`; two are those of a rectangle or the posts of a door, and a place is one
    #[arg(value_parser = corners, allow_hyphen_values = true)]
    pub corners: Corners,
    /// What an area or a door is: `wet`, `keep-out`
    #[arg(long)]
    pub kind: Option<String>,
    /// What else is said of an area or a door, or `height=1.3` of a bridge; may be said again
    #[arg(long, value_name = "PROPERTY=VALUE", value_parser = property)]
    pub with: Vec<(String, String)>,
    /// When it ends: `2026-11-21T18:00`, `18:00` (the next one), `2h`
    #[arg(long, value_name = "TIME", visible_alias = "for")]
    pub until: Option<String>,
    /// Why, for the history
    #[arg(long, value_name = "TEXT")]
    pub why: Option<String>,
    /// Show what would change and change nothing
    #[arg(long)]
    pub dry_run: bool,
}

#[derive(Args, Debug)]
pub struct LiftArgs {
    #[command(flatten)]
    pub site: SiteArgs,
    /// The name of what was laid
    pub name: String,
    /// Why, for the history
    #[arg(long, value_name = "TEXT")]
    pub why: Option<String>,
    /// Show what would change and change nothing
    #[arg(long)]
    pub dry_run: bool,
}

/// One value of the command line.
#[derive(Clone, Debug)]
pub struct Corners(Vec<[f64; 2]>);

fn corners(text: &str) -> std::result::Result<Corners, String> {
    let number = |text: &str| text.parse().ok().filter(|metres: &f64| metres.is_finite());
    let corner = |text: &str| {
        let corner = text.split_once(',').and_then(|(x, y)| Some([number(x)?, number(y)?]));
        corner.ok_or_else(|| format!("`{text}` is no corner: say `x,y`, two numbers without a blank"))
    };
    let corners = text.split_whitespace().map(corner).collect::<std::result::Result<Vec<_>, _>>()?;
    if corners.is_empty() { Err("say where: `\"1,2 3,4\"`".to_owned()) } else { Ok(Corners(corners)) }
}

fn property(text: &str) -> std::result::Result<(String, String), String> {
    let said = text.split_once('=').map(|(name, value)| (name.trim().to_owned(), value.trim().to_owned()));
    said.ok_or_else(|| "say it as `property=value`".to_owned())
}

/// Lays something over the map.
pub fn lay(args: &LayArgs) -> Result<()> {
    let what = Thing::called(&args.what).unwrap_or_default();
    let edit = Edit::Lay(Lay {
        what,
        name: args.name.clone(),
        corners: args.corners.0.clone(),
        kind: args.kind.clone(),
        properties: args.with.clone(),
        until: args.until.clone(),
    });
    apply(&build::open(&args.site)?, &edit, args.why.as_deref(), (args.dry_run, args.site.json))
}

/// Takes away what was laid.
pub fn lift(args: &LiftArgs) -> Result<()> {
    let edit = Edit::Lift(args.name.clone());
    apply(&build::open(&args.site)?, &edit, args.why.as_deref(), (args.dry_run, args.site.json))
}
