//! `adit export`: what others read of a site, a layer for geographic programs or its lane graph for fleets.

use std::any::Any;
use std::path::PathBuf;

use adit_planners::lanes::Format;
use clap::Args;

use super::args::SiteArgs;
use super::build::open;
use super::layer;
use super::output::{json, line, remark};
use crate::answer::pick;
use crate::error::{Code, Error, Result};
use crate::live::Live;
use crate::plan::course::Pathfinder;
use crate::plan::lanes::course::LanesOf;
use crate::plan::lanes::export::export;
use crate::site::whole;

#[derive(Args, Debug)]
pub struct ExportArgs {
    #[command(flatten)]
    pub site: SiteArgs,
    /// A layer: rooms, spaces, doorways, areas, routes, drawn, or one that you put into the database; without, the lane graph
    pub layer: Option<String>,
    /// The file: of a layer .geojson or .json; of a lane graph .yaml (Open-RMF), .geojson (Nav2) or .lif.json (LIF)
    #[arg(long, value_name = "FILE")]
    pub to: PathBuf,
    /// The vehicle type whose lanes are written, where the site has several (LIF has them all)
    #[arg(long, conflicts_with = "layer")]
    pub robot: Option<String>,
}

pub fn run(args: &ExportArgs) -> Result<()> {
    args.layer.as_ref().map_or_else(|| lanes(args), |name| layer::run(&args.site, name, &args.to))
}

fn lanes(args: &ExportArgs) -> Result<()> {
    let Some(format) = Format::of(&args.to) else {
        let message = format!("{} is neither .yaml, .geojson nor .lif.json", args.to.display());
        return Err(Error::said(Code::ExportFormat, message, None));
    };
    let live = Live::open(open(&args.site)?)?;
    let course = live.site().course().map(|course| &**course as &dyn Any);
    let Some(lanes) = course.and_then(|course| course.downcast_ref::<LanesOf>()) else {
        let message = format!("the map of {} is no lane graph", live.site().site().name);
        let help = "say a layer, as `adit export SITE rooms --to rooms.geojson`".to_owned();
        return Err(Error::said(Code::CourseUnfit, message, Some(help)));
    };
    live.site().spare_own(&args.to)?;
    let routes = lanes.routes(&live.asked())?;
    let robot = match (format, &args.robot) {
        (Format::Lif, None) => None,
        (_, robot) => Some(pick(&routes.robots(), robot.as_deref())?),
    };
    let exported = export(&routes, format, robot.as_deref())?;
    whole::write(&args.to, exported.text.as_bytes())?;
    if args.site.json {
        return json(&serde_json::json!({
            "file": args.to, "format": format.words(), "bytes": exported.text.len(), "notes": exported.notes,
        }));
    }
    line(&format!("{}: {}", args.to.display(), format.words()));
    for note in &exported.notes {
        remark(note);
    }
    Ok(())
}
