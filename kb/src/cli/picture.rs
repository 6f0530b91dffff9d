//! `adit draw`.

use std::collections::BTreeSet;
use std::path::{Path, PathBuf};

use clap::Args;

use super::args::SiteArgs;
use super::build::open;
use super::output::{json, line};
use crate::answer::scene::main_state;
use crate::draw::{Layers, Style, UnknownLayer, render_png, render_svg};
use crate::error::{Code, Error, Result};
use crate::knowledge::KnowledgeBase;
use crate::site::whole;
use crate::words::number::counted;
use crate::words::suggest::did_you_mean;

/// Width of a PNG in pixels, unless said.
pub const WIDTH: u32 = 1600;

#[derive(Args, Debug)]
pub struct DrawArgs {
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
    #[arg(long, default_value_t = WIDTH, value_parser = clap::value_parser!(u32).range(64..=16384))]
    pub width: u32,
}

pub fn run(args: &DrawArgs) -> Result<()> {
    check(&args.output)?;
    let mut layers = layers(args)?;
    let knowledge = open(&args.site)?;
    knowledge.spare_own(&args.output)?;
    let route = args.route.as_ref().and_then(|ends| Some((ends.first()?.as_str(), ends.get(1)?.as_str())));
    if knowledge.site().layout.is_some() {
        return course(args, &knowledge, route);
    }
    knowledge.site().needs_rooms()?;
    let scene = knowledge.scene(route, args.robot.as_deref())?;
    let states: Vec<&String> = scene.rooms.iter().filter_map(|room| room.state.as_ref()).collect();
    match &layers.state {
        None => {
            let of_route = scene.route.as_ref().and_then(main_state);
            layers.state = of_route.or_else(|| states.first().map(|state| (*state).clone()));
        }
        Some(state) if !states.contains(&state) => {
            let message = format!("no state `{state}` has rooms in this site");
            let known: BTreeSet<&str> = states.iter().map(|state| state.as_str()).collect();
            let named =
                || format!("states with rooms: {}", known.iter().copied().collect::<Vec<_>>().join(", "));
            let help = did_you_mean(state, known.iter().copied()).or_else(|| (!known.is_empty()).then(named));
            return Err(Error::said(Code::DrawUnknownState, message, help));
        }
        Some(_) => {}
    }
    let svg = render_svg(&scene, &layers, &Style::default());
    let bytes = save(svg, &args.output, args.width)?;
    if args.site.json {
        return json(&serde_json::json!({"file": args.output, "bytes": bytes}));
    }
    line(&format!(
        "{}: {}, {}",
        args.output.display(),
        counted(scene.rooms.len(), "room"),
        counted(scene.doors.len(), "door")
    ));
    Ok(())
}

/// A map that is not cut into rooms.
fn course(args: &DrawArgs, knowledge: &KnowledgeBase, route: Option<(&str, &str)>) -> Result<()> {
    if !args.layer.is_empty() || args.state.is_some() {
        knowledge.site().needs_rooms()?;
    }
    let (svg, summary) = knowledge.course_picture(route, args.robot.as_deref())?;
    let bytes = save(svg, &args.output, args.width)?;
    if args.site.json {
        return json(&serde_json::json!({"file": args.output, "bytes": bytes}));
    }
    line(&format!("{}: {summary}", args.output.display()));
    Ok(())
}

/// What the name of a file ends with, in small letters, without the dot.
pub fn extension(output: &Path) -> String {
    output.extension().and_then(|extension| extension.to_str()).unwrap_or_default().to_lowercase()
}

/// Refuses a file that is no picture.
pub fn check(output: &Path) -> Result<()> {
    if ["svg", "png"].contains(&extension(output).as_str()) {
        return Ok(());
    }
    let message = format!("{} is neither .svg nor .png", output.display());
    Err(Error::said(Code::DrawFormat, message, None))
}

/// Writes a picture in the format that its file name asks for; how many bytes.
pub fn save(svg: String, output: &Path, width: u32) -> Result<usize> {
    let bytes = if extension(output) == "png" {
        render_png(&svg, width).map_err(Error::of(Code::DrawPng))?
    } else {
        svg.into_bytes()
    };
    whole::write(output, &bytes)?;
    Ok(bytes.len())
}

fn layers(args: &DrawArgs) -> Result<Layers> {
    let mut layers = if args.layer.is_empty() {
        Layers::default()
    } else {
        args.layer.join(",").parse().map_err(Error::of::<UnknownLayer>(Code::DrawUnknownLayer))?
    };
    layers.state.clone_from(&args.state);
    Ok(layers)
}
