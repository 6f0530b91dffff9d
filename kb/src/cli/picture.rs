//! `adit draw`.

use std::collections::BTreeSet;
use std::fs;

use super::DrawArgs;
use super::build::open;
use super::output::{json, line};
use crate::draw::{Layers, Style, render_png, render_svg};
use crate::error::{Error, Result};
use crate::scene::main_state;

/// Draws a site into a file.
pub fn run(args: &DrawArgs) -> Result<()> {
    let extension = args.output.extension().and_then(|e| e.to_str()).unwrap_or_default().to_lowercase();
    if !["svg", "png"].contains(&extension.as_str()) {
        let message = format!("{} is neither .svg nor .png", args.output.display());
        return Err(Error::said("draw/format", message, None));
    }
    let mut layers = layers(args)?;
    let knowledge = open(&args.site)?;
    let route = args.route.as_ref().and_then(|ends| Some((ends.first()?.as_str(), ends.get(1)?.as_str())));
    let scene = knowledge.scene(route, args.robot.as_deref())?;
    if let Some(state) = &layers.state {
        let states: BTreeSet<&str> = scene.rooms.iter().filter_map(|room| room.state.as_deref()).collect();
        if !states.contains(state.as_str()) {
            let help = if states.is_empty() {
                "rooms are not by state in this site".to_owned()
            } else {
                format!("states with rooms: {}", states.into_iter().collect::<Vec<_>>().join(", "))
            };
            let message = format!("there is no room of a state `{state}` to draw");
            return Err(Error::said("draw/unknown-state", message, Some(help)));
        }
    }
    if layers.state.is_none() {
        layers.state = scene.route.as_ref().and_then(main_state);
    }
    let svg = render_svg(&scene, &layers, &Style::default());
    let bytes = if extension == "png" {
        render_png(&svg, args.width).map_err(|error| Error::said("draw/png", error.to_string(), None))?
    } else {
        svg.into_bytes()
    };
    fs::write(&args.output, &bytes).map_err(|error| Error::io("write", &args.output, &error))?;
    if args.site.json {
        return json(&serde_json::json!({"file": args.output, "bytes": bytes.len()}));
    }
    line(&format!("{}: {} rooms, {} doors", args.output.display(), scene.rooms.len(), scene.doors.len()));
    Ok(())
}

fn layers(args: &DrawArgs) -> Result<Layers> {
    let mut layers = if args.layer.is_empty() {
        Layers::default()
    } else {
        args.layer.join(",").parse().map_err(|error: crate::draw::UnknownLayer| {
            Error::said("draw/unknown-layer", error.to_string(), None)
        })?
    };
    layers.state.clone_from(&args.state);
    Ok(layers)
}
