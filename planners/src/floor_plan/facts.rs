//! Regions, doorways and adits as facts.

use super::disc::Disc;
use super::network::Network;
use super::plan::{Drawn, FloorPlan};
use super::regions::Regions;
use crate::facts::{Column, Facts, Table};
use crate::geometry::Point;
use crate::planner::{Planner, PlannerError, Signature};
use crate::read::Code;
use crate::world::World;

/// The convex regions of a floor plan, its doorways (between two spaces, which are regions here), and the adits on either side of them where the first of the robots
/// fits (Crowley, section 4). They are numbered from 0.
pub struct RegionsAndAdits;

const NAME: &str = "regions";

fn column(table: Option<&Table>, name: &str) -> Result<Vec<f64>, String> {
    let Some(table) = table else { return Ok(Vec::new()) };
    let values = table.numbers(name)?;
    let value =
        |(row, value): (usize, &Option<f64>)| value.ok_or_else(|| format!("row {} has no `{name}`", row + 1));
    values.iter().enumerate().map(value).collect()
}

/// Corners as tables hold them: `[[x,y],…]`.
///
/// # Returns
/// An error says what is found and what is expected.
pub fn outline(text: &str) -> Result<Vec<Point>, String> {
    let corners: Vec<[f64; 2]> =
        serde_json::from_str(text).map_err(|_| format!("`{text}` is no outline, expected [[x,y],…]"))?;
    Ok(corners.into_iter().map(|[x, y]| Point::new(x, y)).collect())
}

impl Planner for RegionsAndAdits {
    fn name(&self) -> &'static str {
        NAME
    }

    fn signature(&self) -> Signature {
        Signature::new(
            &[
                "WALLS.x0",
                "WALLS.y0",
                "WALLS.x1",
                "WALLS.y1",
                "SOLIDS.outline",
                "VEHICLES.radius",
                "VEHICLES.margin",
            ],
            &[
                "REGIONS.region",
                "REGIONS.area",
                "DOORWAYS.doorway",
                "DOORWAYS.called: text",
                "DOORWAYS.space1",
                "DOORWAYS.space2",
                "DOORWAYS.x",
                "DOORWAYS.y",
                "DOORWAYS.x0",
                "DOORWAYS.y0",
                "DOORWAYS.x1",
                "DOORWAYS.y1",
                "DOORWAYS.width",
                "DOORWAYS.height",
                "DOORWAYS.closed: truth",
                "ADITS.adit",
                "ADITS.doorway",
                "ADITS.region",
                "ADITS.twin",
                "ADITS.x",
                "ADITS.y",
            ],
        )
    }

    fn facts(&self, _: &World, known: &Facts) -> Result<Facts, PlannerError> {
        let wrong = |class: &str| {
            let class = class.to_owned();
            move |what: String| PlannerError::Fact { planner: NAME.to_owned(), class, what }
        };
        let walls = |name: &str| column(known.get("WALLS"), name).map_err(wrong("WALLS"));
        let [x0, y0, x1, y1] = [walls("x0")?, walls("y0")?, walls("x1")?, walls("y1")?];
        let wall = |row: usize| [Point::new(x0[row], y0[row]), Point::new(x1[row], y1[row])];
        let outlines = match known.get("SOLIDS") {
            Some(table) => table.texts("outline").map_err(wrong("SOLIDS"))?.to_vec(),
            None => Vec::new(),
        };
        let solids = outlines.iter().flatten().map(|text| outline(text));
        let drawn = Drawn {
            name: String::new(),
            walls: (0..x0.len()).map(wall).collect(),
            solids: solids.collect::<Result<_, _>>().map_err(wrong("SOLIDS"))?,
            places: Vec::new(),
        };
        let vehicles = known.get("VEHICLES");
        let radius = column(vehicles, "radius").map_err(wrong("VEHICLES"))?.first().copied();
        let margins =
            vehicles.map(|vehicles| vehicles.numbers("margin")).transpose().map_err(wrong("VEHICLES"))?;
        let margin = margins.and_then(|margins| *margins.first()?);
        let no_plan = |errors: crate::read::MapErrors| {
            let what = errors.problems.iter().map(|problem| problem.message.clone());
            PlannerError::World { planner: NAME.to_owned(), what: what.collect::<Vec<_>>().join("; ") }
        };
        let plan = FloorPlan::new(drawn).map_err(no_plan)?;
        let disc = Disc { radius: radius.unwrap_or_default(), margin: margin.unwrap_or_default() };
        let network = match Network::new(&plan, disc) {
            Ok(network) => network,
            // a robot that fits through no doorway has no adits
            Err(errors) if errors.problems.iter().all(|problem| problem.code == Code::RobotTooWide) => {
                Network { regions: Regions::of(&plan), ..Network::none(disc) }
            }
            Err(errors) => return Err(no_plan(errors)),
        };
        Ok(tables(&network))
    }
}

fn tables(network: &Network) -> Facts {
    let numbers = |values: &mut dyn Iterator<Item = f64>| values.collect::<Column>();
    let numbered = |count: usize| (0..count).map(|number| number as f64).collect::<Column>();
    let (regions, doorways, adits) = (&network.regions.regions, &network.regions.doorways, &network.adits);
    let of_doorways = |of: fn(&super::Doorway) -> f64| numbers(&mut doorways.iter().map(of));
    let of_adits = |of: fn(&super::Adit) -> f64| numbers(&mut adits.iter().map(of));
    let regions = Table::default()
        .with("region", numbered(regions.len()))
        .with("area", numbers(&mut regions.iter().map(|region| region.area)));
    let doorways = Table::default()
        .with("doorway", numbered(doorways.len()))
        .with("called", doorways.iter().map(|_| None::<String>).collect::<Column>())
        .with("space1", of_doorways(|doorway| doorway.regions[0].min(doorway.regions[1]) as f64))
        .with("space2", of_doorways(|doorway| doorway.regions[0].max(doorway.regions[1]) as f64))
        .with("x", of_doorways(|doorway| doorway.middle().x))
        .with("y", of_doorways(|doorway| doorway.middle().y))
        .with("x0", of_doorways(|doorway| doorway.from.x))
        .with("y0", of_doorways(|doorway| doorway.from.y))
        .with("x1", of_doorways(|doorway| doorway.to.x))
        .with("y1", of_doorways(|doorway| doorway.to.y))
        .with("width", of_doorways(super::Doorway::width))
        .with("height", doorways.iter().map(|_| None::<f64>).collect::<Column>())
        .with("closed", Column::Truth(vec![None; doorways.len()]));
    let adits = Table::default()
        .with("adit", numbered(adits.len()))
        .with("doorway", of_adits(|adit| adit.doorway as f64))
        .with("region", of_adits(|adit| adit.region as f64))
        .with("twin", of_adits(|adit| adit.twin as f64))
        .with("x", of_adits(|adit| adit.at.x))
        .with("y", of_adits(|adit| adit.at.y));
    Facts::from([
        ("REGIONS".to_owned(), regions),
        ("DOORWAYS".to_owned(), doorways),
        ("ADITS".to_owned(), adits),
    ])
}
