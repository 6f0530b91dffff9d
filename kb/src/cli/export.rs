//! `adit export`: the lanes of a site as a file that others read.

use std::any::Any;
use std::path::PathBuf;

use adit_planners::lanes::Format;
use clap::Args;

use super::args::SiteArgs;
use super::build::open;
use super::output::{json, line, remark};
use crate::answer::pick;
use crate::error::{Code, Error, Result};
use crate::lanes::course::LanesOf;
use crate::lanes::export::export;
use crate::live::Live;
use crate::plan::course::Pathfinder;
use crate::site::whole;

#[derive(Args, Debug)]
pub struct ExportArgs {
    #[command(flatten)]
    pub site: SiteArgs,
    /// The file: .yaml is a navigation graph of Open-RMF, .geojson a route graph of Nav2, .lif.json VDMA's LIF
    #[arg(long, value_name = "FILE")]
    pub to: PathBuf,
    /// The vehicle type whose lanes are written, where the site has several (LIF has them all)
    #[arg(long)]
    pub robot: Option<String>,
}

pub fn run(args: &ExportArgs) -> Result<()> {
    let Some(format) = Format::of(&args.to) else {
        let message = format!("{} is neither .yaml, .geojson nor .lif.json", args.to.display());
        return Err(Error::said(Code::ExportFormat, message, None));
    };
    let live = Live::open(open(&args.site)?)?;
    let course = live.site().course().map(|course| &**course as &dyn Any);
    let Some(lanes) = course.and_then(|course| course.downcast_ref::<LanesOf>()) else {
        let message =
            format!("the map of {} is no lane graph, and nothing else is exported", live.site().site().name);
        return Err(Error::said(Code::CourseUnfit, message, None));
    };
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
