//! A planner of one's own: crowds gather around kiosks and fill the floor up to the nearest wall. It asserts
//! the class CROWDS; a rule of the site says what a crowd does to a door. `adit-example-planner SITE` builds with it.

use adit::{KnowledgeBase, Silent};
use adit_planners::facts::{Column, Facts, Table};
use adit_planners::geometry::Point;
use adit_planners::planner::{Planner, PlannerError, Signature};
use adit_planners::world::World;

struct Crowds;

impl Planner for Crowds {
    fn name(&self) -> &'static str {
        "crowds around kiosks"
    }

    fn signature(&self) -> Signature {
        Signature::new(&[], &["CROWDS.kiosk: text", "CROWDS.x", "CROWDS.y", "CROWDS.radius"])
    }

    fn facts(&self, world: &World, _known: &Facts) -> Result<Facts, PlannerError> {
        let kiosks = || world.places.iter().filter(|place| place.name.starts_with("kiosk"));
        let table = Table::default()
            .with("kiosk", kiosks().map(|place| place.name.clone()).collect::<Column>())
            .with("x", kiosks().map(|place| place.at.x).collect::<Column>())
            .with("y", kiosks().map(|place| place.at.y).collect::<Column>())
            .with("radius", kiosks().map(|place| to_nearest_wall(world, place.at)).collect::<Column>());
        Ok(Facts::from([("CROWDS".to_owned(), table)]))
    }
}

/// Metres from a point to the nearest obstacle or to the edge of the map.
fn to_nearest_wall(world: &World, at: Point) -> f64 {
    let edge = world.bounds;
    let to_edge = [at.x - edge.x0, edge.x1 - at.x, at.y - edge.y0, edge.y1 - at.y];
    let walls = world.obstacles.iter().map(|wall| wall.shape.enclosing_rect().nearest_to(at).distance(at));
    walls.chain(to_edge).fold(f64::INFINITY, f64::min)
}

fn main() -> anyhow::Result<()> {
    let folder =
        std::env::args().nth(1).ok_or_else(|| anyhow::anyhow!("usage: adit-example-planner SITE"))?;
    let mut knowledge = KnowledgeBase::open(folder.as_ref())?;
    knowledge.register(Box::new(Crowds));
    let report = knowledge.build(&Silent)?;
    anyhow::ensure!(report.doors.total > 0, "no doors were made");
    Ok(())
}
