//! A floor plan as a site: the tables that its file fills (Crowley).

use std::collections::BTreeMap;
use std::path::PathBuf;
use std::sync::{Arc, Mutex};

use adit_db::Cell;
use adit_db::place::Place;
use adit_engine::Schema;
use adit_planners::facts::Facts;
use adit_planners::floor_plan::{Disc, Drawn, FloorPlan, Network, RegionsAndAdits, outline};
use adit_planners::geometry::Point;
use adit_planners::planner::Planner;
use adit_planners::read::{Code as MapCode, Problem};
use adit_planners::world;

use super::floor::Floor;
use super::judge::RuleJudge;
use super::told::{Mark, Told, kind_of};
use super::walks::{Walker, Walkers};
use crate::error::{Error, Result};
use crate::plan::consult::Class;
use crate::plan::course::{Asked, Course, Pathfinder, no_map};
use crate::plan::figures;
use crate::plan::rules::Kind;
use crate::site::driving::Driving;
use crate::site::tables::TableFile;

const WALLS: [(&str, &str); 5] =
    [("wall", "INTEGER"), ("x0", "REAL"), ("y0", "REAL"), ("x1", "REAL"), ("y1", "REAL")];
const SOLIDS: [(&str, &str); 2] = [("solid", "INTEGER"), ("outline", "TEXT")];
const VEHICLES: [(&str, &str); 3] = [("robot", "TEXT"), ("radius", "REAL"), ("margin", "REAL")];
const MARKS: [(&str, &str); 6] = [
    ("mark", "INTEGER"),
    ("what", "TEXT"),
    ("x", "REAL"),
    ("y", "REAL"),
    ("property", "TEXT"),
    ("value", "TEXT"),
];

/// What the robot is called.
const ROBOT: &str = "robot";

/// A floor plan as its file has it.
#[derive(Debug)]
pub struct FloorOf {
    pub file: PathBuf,
    pub floor: Floor,
}

impl Course for FloorOf {
    fn name(&self) -> &'static str {
        "floor plan"
    }

    fn tables(&self) -> Vec<TableFile> {
        let Floor { plan, network, told, .. } = &self.floor;
        let number = |place: usize| Cell::Integer(place as i64 + 1);
        let walls = plan.walls().iter().enumerate().map(|(place, [a, b])| {
            vec![number(place), Cell::Real(a.x), Cell::Real(a.y), Cell::Real(b.x), Cell::Real(b.y)]
        });
        let solids = plan.solids().iter().enumerate().map(|(place, corners)| {
            let corners: Vec<[f64; 2]> = corners.iter().map(|at| [at.x, at.y]).collect();
            vec![number(place), Cell::from(serde_json::json!(corners).to_string().as_str())]
        });
        let Disc { radius, margin } = network.disc;
        let vehicle = vec![Cell::from(ROBOT), Cell::Real(radius), Cell::Real(margin)];
        let marks = told.marks().iter().enumerate().map(|(place, mark)| {
            vec![
                number(place),
                Cell::from(mark.what.as_str()),
                Cell::Real(mark.at.x),
                Cell::Real(mark.at.y),
                Cell::from(mark.property.as_str()),
                Cell::from(mark.value.as_str()),
            ]
        });
        let own = vec![
            TableFile::of_map(&self.file, "walls", (&WALLS, 1), walls.collect()),
            TableFile::of_map(&self.file, "solids", (&SOLIDS, 1), solids.collect()),
            TableFile::of_map(&self.file, "vehicles", (&VEHICLES, 1), vec![vehicle]),
            TableFile::of_map(&self.file, "marks", (&MARKS, 1), marks.collect()),
        ];
        own.into_iter().chain(self.floor.driving.tables(&self.file)).collect()
    }

    fn places(&self) -> Vec<Place> {
        let place = |place: &world::Place| Place { place: place.name.clone(), x: place.at.x, y: place.at.y };
        self.floor.plan.places().iter().map(place).collect()
    }

    fn planner(&self) -> Option<Arc<dyn Planner>> {
        Some(Arc::new(RegionsAndAdits))
    }

    fn asks(&self) -> Vec<Class> {
        Kind::Navigation.classes()
    }

    fn declare(&self, schema: &mut Schema, told: &Facts) {
        let marks = told.get("MARKS");
        let texts = |name: &str| marks.and_then(|marks| marks.texts(name).ok()).unwrap_or_default();
        for (property, value) in texts("property").iter().zip(texts("value")) {
            let (Some(property), Some(value)) = (property, value) else { continue };
            if schema.kind("WAYS", property).is_none() {
                schema.add("WAYS", property, kind_of(value));
            }
        }
    }

    fn pathfinder(&self, asked: &Asked<'_>) -> Result<Box<dyn Pathfinder>> {
        let floors = self.floors(asked)?;
        let places = floors.iter().flat_map(|of| of.floor.plan.places());
        let places: BTreeMap<String, Point> = places.map(|place| (place.name.clone(), place.at)).collect();
        let walker = |OfRobot { robot, floor, unfit }| -> Result<Walker> {
            let judge = Mutex::new(RuleJudge::of_routes(asked, &floor.told)?);
            Ok(Walker { robot, floor, unfit, judge })
        };
        let walkers = floors.into_iter().map(walker).collect::<Result<Vec<_>>>()?;
        Ok(Box::new(Walkers { places, walkers }))
    }
}

/// The plan for one robot.
pub struct OfRobot {
    pub robot: String,
    pub floor: Floor,
    /// Why it fits through no doorway.
    pub unfit: Option<String>,
}

impl FloorOf {
    /// The plan as its tables have it, for each robot.
    pub fn floors(&self, asked: &Asked<'_>) -> Result<Vec<OfRobot>> {
        let drawn = drawn(asked, &self.floor.plan.name)?;
        let plan = FloorPlan::new(drawn).map_err(|errors| Error::all(errors.problems))?;
        let vehicles = asked.objects("VEHICLES");
        let marks = marks(asked)?;
        let driving = figures::driving(asked, Driving::of_floor())?;
        let doorways = asked.objects("DOORWAYS");
        let closed: Vec<usize> = doorways.rows().filter(|row| doorways.truth(*row, "closed")).collect();
        let of_robot = |row: usize| -> Result<OfRobot> {
            let disc = Disc {
                radius: vehicles.needed(row, "radius")?,
                margin: vehicles.number(row, "margin").unwrap_or(0.0),
            };
            let is_too_wide = |problem: &Problem| problem.code == MapCode::RobotTooWide;
            let (network, unfit) = match Network::new(&plan, disc) {
                Ok(network) => (network, None),
                Err(errors) if errors.problems.iter().all(is_too_wide) => {
                    let why = errors
                        .problems
                        .into_iter()
                        .map(|problem| problem.message)
                        .collect::<Vec<_>>()
                        .join("; ");
                    (Network::none(disc), Some(why))
                }
                Err(errors) => return Err(Error::all(errors.problems)),
            };
            let told = match unfit {
                None => Told::by(&marks, &closed, &network).map_err(no_map)?,
                Some(_) => Told::default(),
            };
            let robot = vehicles.text(row, "robot").unwrap_or_default();
            let floor = Floor { plan: plan.clone(), network, driving, told };
            Ok(OfRobot { robot, floor, unfit })
        };
        vehicles.rows().map(of_robot).collect()
    }
}

/// The plan as its tables have it.
fn drawn(asked: &Asked<'_>, name: &str) -> Result<Drawn> {
    let (walls, solids, places) = (asked.objects("WALLS"), asked.objects("SOLIDS"), asked.objects("PLACES"));
    let wall = |row: usize| -> Result<[Point; 2]> {
        let at = |x, y| Ok::<_, Error>(Point::new(walls.needed(row, x)?, walls.needed(row, y)?));
        Ok([at("x0", "y0")?, at("x1", "y1")?])
    };
    let solid = |row: usize| -> Result<Vec<Point>> {
        let text = solids.text(row, "outline").unwrap_or_default();
        outline(&text).map_err(|_| solids.wrong(row, "outline", "corners as [[x,y],…]", Some(&text)))
    };
    let place = |row: usize| -> Result<world::Place> {
        let at = Point::new(places.needed(row, "x")?, places.needed(row, "y")?);
        Ok(world::Place { name: places.text(row, "place").unwrap_or_default(), at })
    };
    Ok(Drawn {
        name: name.to_owned(),
        walls: walls.rows().map(wall).collect::<Result<_>>()?,
        solids: solids.rows().map(solid).collect::<Result<_>>()?,
        places: places.rows().map(place).collect::<Result<_>>()?,
    })
}

fn marks(asked: &Asked<'_>) -> Result<Vec<Mark>> {
    let marks = asked.objects("MARKS");
    let mark = |row: usize| -> Result<Mark> {
        let what = marks.text(row, "what").unwrap_or_default();
        if !["doorway", "region"].contains(&what.as_str()) {
            return Err(marks.wrong(row, "what", "`doorway` or `region`", Some(&what)));
        }
        Ok(Mark {
            what,
            at: Point::new(marks.needed(row, "x")?, marks.needed(row, "y")?),
            property: marks.text(row, "property").unwrap_or_default(),
            value: marks.text(row, "value").unwrap_or_default(),
        })
    };
    marks.rows().map(mark).collect()
}
