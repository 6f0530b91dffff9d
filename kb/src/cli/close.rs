//! `adit close` and `adit open`.

use clap::Args;

use super::args::SiteArgs;
use super::build;
use super::tune::apply;
use crate::edit::{Close, Edit};
use crate::error::Result;

#[derive(Args, Debug)]
pub struct CloseArgs {
    #[command(flatten)]
    pub site: SiteArgs,
    /// A doorway, a space, an area or a named door by its name, or a lane, node, lift or channel; a point `x,y`, or `x,y@90` where
    /// a robot was blocked
    #[arg(allow_hyphen_values = true)]
    pub what: String,
    /// The robot that is kept out, and no other one; may be said again
    #[arg(long, value_name = "ROBOT", conflicts_with = "except")]
    pub only: Vec<String>,
    /// The robot that comes through all the same; may be said again
    #[arg(long, value_name = "ROBOT")]
    pub except: Vec<String>,
    /// The space from which nobody passes the doorway any more; the other way it stays open
    #[arg(long, value_name = "SPACE", conflicts_with_all = ["only", "except"])]
    pub from: Option<String>,
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
pub struct OpenArgs {
    #[command(flatten)]
    pub site: SiteArgs,
    /// What was closed, as it was said
    #[arg(allow_hyphen_values = true)]
    pub what: String,
    /// Why, for the history
    #[arg(long, value_name = "TEXT")]
    pub why: Option<String>,
    /// Show what would change and change nothing
    #[arg(long)]
    pub dry_run: bool,
}

/// Lets nobody pass, or nobody who comes from one side.
pub fn close(args: &CloseArgs) -> Result<()> {
    let (only, except) = (args.only.clone(), args.except.clone());
    let (what, until, from) = (args.what.clone(), args.until.clone(), args.from.clone());
    let edit = Edit::Close(Close { what, until, only, except, from });
    apply(&build::open(&args.site)?, &edit, args.why.as_deref(), (args.dry_run, args.site.json))
}

/// Lets everybody pass again.
pub fn open(args: &OpenArgs) -> Result<()> {
    let edit = Edit::Open(args.what.clone());
    apply(&build::open(&args.site)?, &edit, args.why.as_deref(), (args.dry_run, args.site.json))
}
