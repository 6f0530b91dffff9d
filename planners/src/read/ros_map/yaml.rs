//! The YAML file of a ROS map: `image`, `resolution`, `origin`, `negate`, thresholds and `mode`.

use std::ops::Range;

use serde::Deserialize;
use serde_saphyr::Spanned;

use super::super::diagnostic::{Code, MapErrors, Problem, Text};
use super::super::fields::{LARGEST, Located, in_words, reckoned, span_in};
use super::super::occupancy::Cell;
use super::super::suggest::nearest;
use crate::pose::Pose;

/// How the brightness of a pixel is read.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Mode {
    /// Wall, free or unknown by the two thresholds; alpha counts as a fourth channel of brightness.
    Trinary,
    /// As [`Self::Trinary`] without alpha in the brightness; pixels that are not opaque are unknown. What ROS
    /// scales between the thresholds is neither surely free nor surely a wall: unknown.
    Scale,
    /// The brightness 0 to 100 is the occupancy in percent, put to the same thresholds; above 100 is unknown.
    /// `negate` has no effect.
    Raw,
}

/// A pixel of the map's image, 8 bits a channel.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Pixel {
    /// Mean of red, green and blue, 0 to 255.
    pub(crate) colour: f64,
    /// Opaque is 255; `None` where the image has no alpha.
    pub(crate) alpha: Option<u8>,
}

/// The content of the file, checked.
#[derive(Clone, Debug)]
pub(crate) struct MapFile {
    /// Path of the image, as written.
    pub image: String,
    /// Side of a pixel, metres.
    pub resolution: f64,
    /// Pose of the image's lower left corner.
    pub origin: Pose,
    /// Whether white is a wall.
    pub negate: bool,
    /// Above this occupancy (0 to 1) a pixel is a wall.
    pub occupied_thresh: f64,
    /// Below this occupancy (0 to 1) a pixel is free.
    pub free_thresh: f64,
    pub mode: Mode,
    pub(crate) image_span: Range<usize>,
}

impl MapFile {
    /// What nav2's map server makes of a pixel.
    pub(crate) fn classify(&self, pixel: Pixel) -> Cell {
        let shade = match (self.mode, pixel.alpha) {
            (Mode::Trinary, Some(alpha)) => (3.0 * pixel.colour + f64::from(alpha)) / 4.0 / 255.0,
            _ => pixel.colour / 255.0,
        };
        let opaque = pixel.alpha.is_none_or(|alpha| alpha == 255);
        let occupied = match self.mode {
            Mode::Raw => (shade * 255.0).round() / 100.0,
            _ if self.negate => shade,
            _ => 1.0 - shade,
        };
        if self.mode == Mode::Scale && !opaque || self.mode == Mode::Raw && occupied > 1.0 {
            Cell::Unknown
        } else if occupied > self.occupied_thresh {
            Cell::Wall
        } else if occupied < self.free_thresh {
            Cell::Free
        } else {
            Cell::Unknown
        }
    }
}

impl MapFile {
    /// What nav2's map server tells of a pixel whose grid it publishes: occupancy in percent; `None` for unknown.
    pub(crate) fn percent(&self, pixel: Pixel) -> Option<u8> {
        let opaque = pixel.alpha.is_none_or(|alpha| alpha == 255);
        match (self.mode, self.classify(pixel)) {
            (Mode::Raw, _) => (pixel.colour <= 100.0).then(|| pixel.colour.round() as u8),
            (_, Cell::Wall) => Some(100),
            (_, Cell::Free) => Some(0),
            (Mode::Scale, Cell::Unknown) if opaque => {
                let shade = pixel.colour / 255.0;
                let occupied = if self.negate { shade } else { 1.0 - shade };
                let range = self.occupied_thresh - self.free_thresh;
                let share = if range > 0.0 { (occupied - self.free_thresh) / range } else { 1.0 };
                Some((share * 100.0).round() as u8)
            }
            _ => None,
        }
    }
}

const KEYS: [&str; 7] = ["image", "resolution", "origin", "negate", "occupied_thresh", "free_thresh", "mode"];

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Written {
    image: Spanned<String>,
    resolution: Spanned<f64>,
    origin: Spanned<Vec<f64>>,
    negate: Option<Spanned<Negate>>,
    occupied_thresh: Spanned<f64>,
    free_thresh: Spanned<f64>,
    mode: Option<Spanned<String>>,
}

/// ROS writes 0 or 1, people true or false.
#[derive(Clone, Copy, Deserialize)]
#[serde(untagged, expecting = "`negate` must be 0 or 1")]
enum Negate {
    Number(i64),
    Truth(bool),
}

pub(crate) fn parse(source: &Text, text: &str) -> Result<MapFile, MapErrors> {
    let written: Written = serde_saphyr::from_str(text).map_err(|error| explain((source, text), &error))?;
    let mut problems = Vec::new();
    let image = Located::from(&written.image);
    if image.value.trim().is_empty() {
        problems.push(source.problem(Code::ImageMissing, &image.span, "`image` is empty"));
    }
    let resolution = positive(source, "resolution", &Located::from(&written.resolution), &mut problems);
    let origin = origin(source, &Located::from(&written.origin), &mut problems);
    let occupied = Located::from(&written.occupied_thresh);
    let free = Located::from(&written.free_thresh);
    check_thresholds(source, &occupied, &free, &mut problems);
    let mode = written.mode.as_ref().map(Located::from);
    let mode = mode.map_or(Some(Mode::Trinary), |mode| parse_mode(source, &mode, &mut problems));
    let negate = written.negate.as_ref().map(Located::from);
    let is_negated = negate.is_some_and(|negate| match negate.value {
        Negate::Truth(truth) => truth,
        Negate::Number(number) => {
            if ![0, 1].contains(&number) {
                let message = format!("`negate` must be 0 or 1, found {number}");
                problems.push(source.problem(Code::WrongType, &negate.span, message));
            }
            number == 1
        }
    });
    match (resolution, origin, mode) {
        (Some(resolution), Some(origin), Some(mode)) if problems.is_empty() => Ok(MapFile {
            image: image.value,
            resolution,
            origin,
            negate: is_negated,
            occupied_thresh: occupied.value,
            free_thresh: free.value,
            mode,
            image_span: image.span,
        }),
        _ => Err(MapErrors { problems }),
    }
}

fn explain((source, text): (&Text, &str), error: &serde_saphyr::Error) -> Problem {
    let error = error.without_snippet();
    let span = error.location().map_or(0..0, |location| span_in(text, location));
    match error {
        serde_saphyr::Error::SerdeUnknownField { field, .. } => {
            let help = match nearest(field, &KEYS) {
                Some(meant) => format!("did you mean `{meant}`?"),
                None => format!("known keys: {}", KEYS.join(", ")),
            };
            let message = format!("`{field}` is not a key of a ROS map");
            source.problem(Code::UnknownKey, &span, message).with_help(help)
        }
        serde_saphyr::Error::SerdeMissingField { field, .. } => {
            source.problem(Code::MissingKey, &(0..0), format!("a ROS map needs a `{field}`"))
        }
        other => {
            let message = format!("not the YAML file of a ROS map: {}", in_words(other));
            source.problem(Code::Syntax, &span, message)
        }
    }
}

fn positive(source: &Text, key: &str, number: &Located<f64>, problems: &mut Vec<Problem>) -> Option<f64> {
    let code = if number.value.is_nan() || number.value > LARGEST {
        Code::NotFinite
    } else if reckoned(number.value) <= 0.0 {
        Code::NotPositive
    } else {
        return Some(number.value);
    };
    let message = format!(
        "`{key}` is {} and must be a finite number of metres above 0, at most {LARGEST:e}",
        number.value
    );
    problems.push(source.problem(code, &number.span, message));
    None
}

fn origin(source: &Text, origin: &Located<Vec<f64>>, problems: &mut Vec<Problem>) -> Option<Pose> {
    let problem = match origin.value[..] {
        [x, y, yaw] if [x, y, yaw].iter().all(|v| v.abs() <= LARGEST) => {
            return Some(Pose::new(reckoned(x), reckoned(y), reckoned(yaw)));
        }
        [_, _, _] => source.problem(
            Code::NotFinite,
            &origin.span,
            format!("`origin` must be finite numbers up to {LARGEST:e}"),
        ),
        _ => {
            let message = format!("`origin` has {} entries and needs three: x, y, yaw", origin.value.len());
            source.problem(Code::WrongType, &origin.span, message)
        }
    };
    problems.push(problem);
    None
}

fn check_thresholds(
    source: &Text,
    occupied: &Located<f64>,
    free: &Located<f64>,
    problems: &mut Vec<Problem>,
) {
    let before = problems.len();
    for (key, threshold) in [("occupied_thresh", occupied), ("free_thresh", free)] {
        if !(0.0..=1.0).contains(&threshold.value) {
            let message = format!("`{key}` is {} and must lie between 0 and 1", threshold.value);
            problems.push(source.problem(Code::Thresholds, &threshold.span, message));
        }
    }
    if problems.len() == before && free.value > occupied.value {
        let message = format!(
            "`free_thresh` ({}) is above `occupied_thresh` ({}): a pixel would be both",
            free.value, occupied.value
        );
        problems.push(source.problem(Code::Thresholds, &free.span, message));
    }
}

fn parse_mode(source: &Text, mode: &Located<String>, problems: &mut Vec<Problem>) -> Option<Mode> {
    match mode.value.as_str() {
        "trinary" => Some(Mode::Trinary),
        "scale" => Some(Mode::Scale),
        "raw" => Some(Mode::Raw),
        other => {
            let message = format!("`{other}` is not a mode");
            let help = "known modes: trinary, scale, raw";
            problems.push(source.problem(Code::Mode, &mode.span, message).with_help(help));
            None
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn file(mode: Mode, negate: bool) -> MapFile {
        MapFile {
            image: "map.pgm".into(),
            resolution: 0.05,
            origin: Pose::default(),
            negate,
            occupied_thresh: 0.65,
            free_thresh: 0.196,
            mode,
            image_span: 0..0,
        }
    }

    fn grey(colour: f64) -> Pixel {
        Pixel { colour, alpha: None }
    }

    #[test]
    fn trinary_has_walls_free_space_and_the_unknown_grey_of_map_saver() {
        let file = file(Mode::Trinary, false);
        assert_eq!(file.classify(grey(0.0)), Cell::Wall);
        assert_eq!(file.classify(grey(254.0)), Cell::Free);
        assert_eq!(file.classify(grey(205.0)), Cell::Unknown);
    }

    #[test]
    fn negate_turns_black_into_free() {
        let file = file(Mode::Trinary, true);
        assert_eq!(file.classify(grey(0.0)), Cell::Free);
        assert_eq!(file.classify(grey(254.0)), Cell::Wall);
    }

    #[test]
    fn alpha_is_brightness_in_trinary_and_certainty_in_scale() {
        let clear_black = Pixel { colour: 0.0, alpha: Some(0) };
        let opaque_black = Pixel { colour: 0.0, alpha: Some(255) };
        let clear_white = Pixel { colour: 255.0, alpha: Some(0) };
        assert_eq!(file(Mode::Trinary, false).classify(clear_black), Cell::Wall);
        assert_eq!(file(Mode::Trinary, false).classify(opaque_black), Cell::Wall);
        assert_eq!(file(Mode::Trinary, false).classify(clear_white), Cell::Unknown);
        assert_eq!(file(Mode::Scale, false).classify(clear_black), Cell::Unknown);
        assert_eq!(file(Mode::Scale, false).classify(opaque_black), Cell::Wall);
        assert_eq!(file(Mode::Scale, false).classify(grey(128.0)), Cell::Unknown);
    }

    #[test]
    fn raw_is_percent() {
        for negate in [false, true] {
            let file = file(Mode::Raw, negate);
            assert_eq!(file.classify(grey(0.0)), Cell::Free);
            assert_eq!(file.classify(grey(50.0)), Cell::Unknown);
            assert_eq!(file.classify(grey(100.0)), Cell::Wall);
            assert_eq!(file.classify(grey(255.0)), Cell::Unknown);
        }
    }
}
