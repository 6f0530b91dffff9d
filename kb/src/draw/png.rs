//! From SVG to PNG, with the font that the program carries: the same picture on every machine.

use std::sync::Arc;

use resvg::tiny_skia::{Pixmap, Transform};
use resvg::usvg::{Options, Tree, fontdb::Database};

/// Wider or higher pictures are refused, pixels.
const LONGEST_SIDE: u32 = 20_000;
/// Larger pictures are refused, pixels: their memory is four times as many bytes.
const LARGEST_AREA: u64 = 200_000_000;

#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum PngError {
    #[error("the picture cannot be read: {0}")]
    Svg(String),
    /// The size asked for is none, or too large.
    #[error(
        "a picture of {width} x {height} pixels cannot be made; sides go from 1 to {LONGEST_SIDE}, \
         areas to {LARGEST_AREA}"
    )]
    Size {
        /// Width asked for, pixels.
        width: u32,
        /// Height that follows from it, pixels.
        height: u32,
    },
    /// The pixels could not be written.
    #[error("the picture cannot be written as PNG: {0}")]
    Encode(String),
}

/// The SVG as a PNG of so many pixels' width. No font of the machine is used.
pub fn render_png(svg: &str, width_px: u32) -> Result<Vec<u8>, PngError> {
    let tree = parse(svg)?;
    let scale = width_px as f32 / tree.size().width();
    let height = (tree.size().height() * scale).round().max(1.0) as u32;
    let refused = PngError::Size { width: width_px, height };
    let area = u64::from(width_px) * u64::from(height);
    if width_px > LONGEST_SIDE || height > LONGEST_SIDE || area > LARGEST_AREA {
        return Err(refused);
    }
    let mut pixels = Pixmap::new(width_px, height).ok_or(refused)?;
    resvg::render(&tree, Transform::from_scale(scale, scale), &mut pixels.as_mut());
    pixels.encode_png().map_err(|error| PngError::Encode(error.to_string()))
}

/// The SVG as the renderer understands it.
pub(super) fn parse(svg: &str) -> Result<Tree, PngError> {
    let mut fonts = Database::new();
    fonts.load_font_data(epaint_default_fonts::UBUNTU_LIGHT.to_vec());
    fonts.load_font_data(epaint_default_fonts::HACK_REGULAR.to_vec());
    fonts.set_sans_serif_family("Ubuntu");
    let options = Options { fontdb: Arc::new(fonts), font_family: "Ubuntu".to_owned(), ..Options::default() };
    Tree::from_str(svg, &options).map_err(|error| PngError::Svg(error.to_string()))
}
