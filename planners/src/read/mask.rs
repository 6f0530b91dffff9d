//! Masks as Nav2's costmap filters read them, as areas: an image beside the map's says where no robot goes, or how fast. What
//! counts is where a pixel lies in the world: a mask may have another origin, resolution and yaw than the map.

mod shapes;

use std::fs;
use std::ops::Range;
use std::path::{Path, PathBuf};

use super::diagnostic::{Code, MapErrors, Problem, Text};
use super::fields::{Fields, Located};
use super::image::read_image;
use super::overlay::Overlay;
use super::ros_map::{frame, yaml};
use super::suggest::nearest;
use crate::geometry::Point;
use crate::pose::Frame;
use crate::world::{Area, Property, Shape, World};

/// An entry `[[mask]]` of `site.toml`.
#[derive(Clone, Debug)]
pub struct Mask {
    file: PathBuf,
    /// What its areas are called, with a number each.
    name: String,
    meaning: Meaning,
    text: Text,
    span: Range<usize>,
}

/// What the pixels of a mask say.
#[derive(Clone, Debug)]
enum Meaning {
    /// Where they are full, no robot goes.
    Keepout,
    /// How fast robots go: `base + multiplier * percent`, where that is not 0.
    Speed { base: f64, multiplier: f64, property: &'static str },
}

const KEYS: [&str; 6] = ["file", "name", "kind", "base", "multiplier", "unit"];
const KINDS: [&str; 2] = ["keepout", "speed"];
/// Units of a speed, and the property of an area that holds it.
const UNITS: [(&str, &str); 2] = [("percent", "speed_percent"), ("m/s", "speed_limit")];

impl Mask {
    /// Reads the entries `[[mask]]`; files are relative to `folder`.
    pub(super) fn from_fields(
        fields: &Fields<'_, '_>,
        folder: &Path,
        problems: &mut Vec<Problem>,
    ) -> Vec<Self> {
        let mut masks = Vec::new();
        for item in fields.tables("mask", "[[mask]]", problems) {
            item.refuse_unknown(&KEYS, problems);
            let (file, kind) = (item.string("file", problems), item.string("kind", problems));
            let (Some(file), Some(kind)) = (file, kind) else { continue };
            let Some(meaning) = Meaning::of(&item, &kind, problems) else { continue };
            let path = folder.join(&file.value);
            let name = match item.get("name") {
                Some(_) => item.string("name", problems).map(|name| name.value),
                None => path.file_stem().map(|stem| stem.to_string_lossy().into_owned()),
            };
            let name = name.unwrap_or_else(|| kind.value.clone());
            masks.push(Self { file: path, name, meaning, text: item.text.clone(), span: file.span });
        }
        masks
    }

    /// The file that says how the image is meant.
    pub(super) fn file(&self) -> &Path {
        &self.file
    }

    /// That file, and the image that it names.
    pub(super) fn files(&self) -> Vec<PathBuf> {
        let text = fs::read_to_string(&self.file).unwrap_or_default();
        let image = yaml::parse(&Text::new("mask", &text), &text).ok();
        let image = image.map(|file| self.file.with_file_name(file.image));
        [self.file.clone()].into_iter().chain(image).collect()
    }

    /// Lays the areas of the mask over a world, and gives notes. What is solid in the world is left to it: masks are often
    /// drawn on a copy of the map's image.
    pub(super) fn lay_over(&self, world: &mut World) -> Result<Vec<Problem>, MapErrors> {
        let name = self.file.display().to_string();
        let text = super::text_of(&self.file).map_err(|error| {
            let message = format!("the mask `{name}` cannot be read: {error}");
            self.text.problem(Code::Unreadable, &self.span, message)
        })?;
        let source = Text::new(&name, &text);
        let file = yaml::parse(&source, &text)?;
        let image = read_image(&source, &file, self.file.parent().unwrap_or(Path::new("")))?;
        let (to_ros, from_ros) = (Frame::from(&frame(file.origin)), Frame::from(&world.frame));
        let place = |column: f64, row: f64| {
            let p = file.origin.at + Point::new(column, row) * file.resolution;
            from_ros.seen(to_ros.place(p))
        };
        let percents: Vec<u8> =
            image.bottom_up().map(|pixel| self.meaning.counted(file.percent(pixel))).collect();
        let size = (image.columns, image.rows);
        let is_in = |cell: usize| {
            let centre = place((cell % size.0) as f64 + 0.5, (cell / size.0) as f64 + 0.5);
            world.bounds.contains(centre).then(|| !world.is_solid(centre))
        };
        let lies: Vec<Option<bool>> =
            (0..percents.len()).map(|cell| if percents[cell] > 0 { is_in(cell) } else { None }).collect();
        if percents.iter().any(|&percent| percent > 0) && lies.iter().all(Option::is_none) {
            let message = format!("nothing of the mask `{}` lies on the map", file.image);
            let help = "its `origin` and `resolution` say where it lies; the site's coordinates are those of the map";
            return Err(self.text.problem(Code::Outside, &self.span, message).with_help(help).into());
        }
        let mut values: Vec<u8> = percents.clone();
        values.sort_unstable();
        values.dedup();
        let mut areas = Vec::new();
        for value in values.into_iter().filter(|&value| value > 0) {
            let marked =
                (0..percents.len()).filter(|&cell| percents[cell] == value && lies[cell] == Some(true));
            for corners in shapes::of(marked, size, |cell| is_in(cell).is_some()) {
                let corners = corners.iter().map(|corner| place(corner.x, corner.y)).collect();
                areas.push(self.area(areas.len() + 1, Shape::Polygon(corners), value));
            }
        }
        Overlay::of_areas(&self.text, areas).lay_over(world)
    }

    fn area(&self, number: usize, shape: Shape, percent: u8) -> Located<Area> {
        let (kind, further) = match self.meaning {
            Meaning::Keepout => ("keep-out", Vec::new()),
            Meaning::Speed { base, multiplier, property } => {
                let speed = Property::Number(base + multiplier * f64::from(percent));
                ("speed-limit", vec![(property.to_owned(), speed)])
            }
        };
        let (name, centre) = (format!("{} {number}", self.name), shape.enclosing_rect().centre());
        let value = Area { name, kind: Some(kind.to_owned()), shape, centre, further };
        Located { value, span: self.span.clone() }
    }
}

impl Meaning {
    fn of(item: &Fields<'_, '_>, kind: &Located<String>, problems: &mut Vec<Problem>) -> Option<Self> {
        let number = |key: &str, usual: f64, problems: &mut Vec<Problem>| match item.get(key) {
            Some(_) => item.number(key, problems).map(|number| number.value),
            None => Some(usual),
        };
        match kind.value.as_str() {
            "keepout" => {
                for key in ["base", "multiplier", "unit"] {
                    if let Some(value) = item.get(key) {
                        let message = format!("`{key}` is said of a mask of kind \"speed\" only");
                        problems.push(item.text.problem(Code::UnknownKey, &value.span(), message));
                    }
                }
                Some(Self::Keepout)
            }
            "speed" => {
                let (base, multiplier) =
                    (number("base", 100.0, problems)?, number("multiplier", -1.0, problems)?);
                let unit = match item.get("unit") {
                    Some(_) => item.string("unit", problems)?,
                    None => Located { value: UNITS[0].0.to_owned(), span: 0..0 },
                };
                let known = UNITS.iter().find(|(name, _)| *name == unit.value);
                if known.is_none() {
                    let names = UNITS.map(|(name, _)| name);
                    problems.push(of_known(item, "unit", &unit, &names));
                }
                known.map(|&(_, property)| Self::Speed { base, multiplier, property })
            }
            _ => {
                problems.push(of_known(item, "kind", kind, &KINDS));
                None
            }
        }
    }

    /// The percents of a pixel, as far as they say something; else 0.
    fn counted(&self, percent: Option<u8>) -> u8 {
        match self {
            Self::Keepout => percent.filter(|&percent| percent == 100).unwrap_or(0),
            // a limit of 0 is none, as Nav2 reads it
            Self::Speed { base, multiplier, .. } => {
                percent.filter(|&percent| base + multiplier * f64::from(percent) > 0.0).unwrap_or(0)
            }
        }
    }
}

/// A value that is none of those that are known.
fn of_known(item: &Fields<'_, '_>, key: &str, found: &Located<String>, known: &[&str]) -> Problem {
    let message = format!("`{}` is no {key} of a mask", found.value);
    let help = match nearest(&found.value, known) {
        Some(meant) => format!("did you mean \"{meant}\"?"),
        None => format!("known: {}", known.join(", ")),
    };
    item.text.problem(Code::WrongType, &found.span, message).with_help(help)
}
