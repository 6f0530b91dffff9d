//! Sizes of a picture.

/// Sizes in the picture's own unit (a CSS pixel; the PNG has the width that is asked for).
#[derive(Clone, Debug, PartialEq)]
pub struct Style {
    /// Longest side of the map. `None`: 1000, and more where many rooms are drawn.
    pub map_px: Option<f64>,
    /// Size of the text at the side.
    pub font_px: f64,
}

impl Default for Style {
    fn default() -> Self {
        Self { map_px: None, font_px: 13.0 }
    }
}

impl Style {
    /// The longest side of a map with so many rooms: their names stay readable up to some thousands.
    pub(super) fn longest_side(&self, rooms: usize) -> f64 {
        match self.map_px {
            Some(px) if px.is_finite() => px.clamp(100.0, 20_000.0),
            _ => 1000.0 * (rooms as f64 / 250.0).sqrt().clamp(1.0, 2.6),
        }
    }
}
