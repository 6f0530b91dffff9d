//! The picture as a specification. Set `ADIT_PICTURES` to a folder to keep the pictures, and look at them.

mod channels;
mod example;
mod figures;
mod floor;
mod labels;
mod limits;
mod sites;

use super::{Layers, Scene, Style, render_png, render_svg};

/// The picture, written to the folder that `ADIT_PICTURES` names.
fn picture(name: &str, scene: &Scene, layers: &str) -> String {
    let layers: Layers = layers.parse().expect("a test names layers that there are");
    let svg = render_svg(scene, &layers, &Style::default());
    keep(name, &svg);
    svg
}

/// Writes the picture to the folder that `ADIT_PICTURES` names, if it names one.
fn keep(name: &str, svg: &str) {
    if let Some(folder) = std::env::var_os("ADIT_PICTURES") {
        let path = std::path::Path::new(&folder).join(name);
        std::fs::write(path.with_extension("svg"), svg).expect("the folder takes files");
        let png = render_png(svg, 1400).expect("our SVG renders");
        std::fs::write(path.with_extension("png"), png).expect("the folder takes files");
    }
}

const ALL: &str = "rooms,doors,route,legend";
