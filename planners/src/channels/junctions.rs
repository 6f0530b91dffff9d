//! Junctions as facts: where channels meet.

use super::assembly::Cuboid;
use super::corridor::Corridors;
use crate::facts::{Column, Facts, Table};
use crate::geometry::Rect;
use crate::planner::{Planner, PlannerError, Signature};
use crate::world::World;

const NAME: &str = "junctions";
const CHANNELS: &str = "CHANNELS";

/// The junctions of the corridors that a class CHANNELS has (Lee, section 5).
pub struct CorridorJunctions;

/// The junctions of the channels through which a part leaves another one, of each with the next (Lee, section 2), in `D`
/// dimensions.
pub struct PartJunctions<const D: usize>;

/// What is needed of channels, and given of junctions, where these are their sides.
fn signature(sides: &[String]) -> Signature {
    let of = |class: &str, first: &[&str]| -> Vec<String> {
        let first = first.iter().map(|name| format!("{class}.{name}"));
        first.chain(sides.iter().map(|side| format!("{class}.{side}"))).collect()
    };
    Signature {
        needs: of(CHANNELS, &["channel"]),
        gives: of("JUNCTIONS", &["junction", "channel1", "channel2"]),
    }
}

/// Each side of all channels, or an error that names what is not known.
fn sides(known: &Facts, names: &[String]) -> Result<Vec<Vec<f64>>, PlannerError> {
    let wrong =
        |what: String| PlannerError::Fact { planner: NAME.to_owned(), class: CHANNELS.to_owned(), what };
    let empty = Table::default();
    let table = known.get(CHANNELS).unwrap_or(&empty);
    let side = |name: &String| -> Result<Vec<f64>, PlannerError> {
        let values = table.numbers(name).map_err(wrong)?;
        let value = |(row, value): (usize, &Option<f64>)| {
            // they are numbered 1, 2, ...
            value.ok_or_else(|| wrong(format!("channel {} has no `{name}`, expected a number", row + 1)))
        };
        values.iter().enumerate().map(value).collect()
    };
    names.iter().map(side).collect()
}

/// A junction: the numbers of its channels, and its sides.
type Junction = ([usize; 2], Vec<f64>);

fn facts(junctions: &[Junction], names: &[String]) -> Facts {
    let numbers = |of: &dyn Fn(usize, &Junction) -> f64| -> Column {
        junctions.iter().enumerate().map(|(place, junction)| of(place, junction)).collect()
    };
    let mut table = Table::default()
        .with("junction", numbers(&|place, _| (place + 1) as f64))
        .with("channel1", numbers(&|_, (channels, _)| channels[0] as f64))
        .with("channel2", numbers(&|_, (channels, _)| channels[1] as f64));
    for (side, name) in names.iter().enumerate() {
        table = table.with(name, numbers(&|_, (_, sides)| sides[side]));
    }
    Facts::from([("JUNCTIONS".to_owned(), table)])
}

fn flat() -> Vec<String> {
    ["x0", "y0", "x1", "y1"].map(str::to_owned).into()
}

impl Planner for CorridorJunctions {
    fn name(&self) -> &'static str {
        NAME
    }

    fn signature(&self) -> Signature {
        signature(&flat())
    }

    fn facts(&self, _: &World, known: &Facts) -> Result<Facts, PlannerError> {
        let sides = sides(known, &flat())?;
        let rect =
            |row: usize| Rect { x0: sides[0][row], y0: sides[1][row], x1: sides[2][row], y1: sides[3][row] };
        let rects: Vec<Rect> = (0..sides[0].len()).map(rect).collect();
        let corridors = Corridors::new(&rects)
            .map_err(|error| PlannerError::World { planner: NAME.to_owned(), what: error.to_string() })?;
        let junctions: Vec<Junction> = corridors
            .junctions()
            .iter()
            .map(|junction| {
                let Rect { x0, y0, x1, y1 } = junction.rect;
                let mut channels = [junction.lying, junction.upright];
                channels.sort_unstable();
                (channels, vec![x0, y0, x1, y1])
            })
            .collect();
        Ok(facts(&junctions, &flat()))
    }
}

/// The names of the properties that hold the least and the greatest coordinates.
fn named<const D: usize>() -> Vec<String> {
    let axes: &[&str] = if D == 2 { &["x", "z"] } else { &["x", "y", "z"] };
    let side = |side: &'static str| axes.iter().map(move |axis| format!("{axis}{side}"));
    side("0").chain(side("1")).collect()
}

impl<const D: usize> Planner for PartJunctions<D> {
    fn name(&self) -> &'static str {
        NAME
    }

    fn signature(&self) -> Signature {
        signature(&named::<D>())
    }

    fn facts(&self, _: &World, known: &Facts) -> Result<Facts, PlannerError> {
        let names = named::<D>();
        let sides = sides(known, &names)?;
        let corner = |row: usize, from: usize| std::array::from_fn(|axis| sides[from + axis][row]);
        let boxes: Vec<Cuboid<D>> =
            (0..sides[0].len()).map(|row| Cuboid::new(corner(row, 0), corner(row, D))).collect();
        let shared = (1..).zip(boxes.windows(2)).filter_map(|(number, pair)| {
            let shared = pair[0].intersection(&pair[1])?;
            Some(([number, number + 1], [shared.min, shared.max].concat()))
        });
        Ok(facts(&shared.collect::<Vec<_>>(), &names))
    }
}
