//! A site of a test, built and asked by the library.

use std::path::Path;

use adit::{KnowledgeBase, Silent, Status};
use adit_planners::geometry::{Point, Rect};
use adit_planners::world::World;

use super::body::Body;
use super::driven::Driven;
use super::plan::Plan;
use crate::TestSite;

/// A built site.
pub struct Built {
    folder: TestSite,
    knowledge: KnowledgeBase,
    body: Body,
    /// The world as the site reads it.
    pub world: World,
    /// Areas in which a metre weighs so many times as much.
    pub areas: Vec<(Rect, f64)>,
}

impl Built {
    /// A floor plan with a robot; `grid` is the side of the layers' cells, metres.
    #[track_caller]
    pub fn of_plan(plan: &Plan, body: &Body, grid: f64) -> Self {
        let folder = TestSite::empty().with("map.toml", &plan.to_toml());
        let built = Self::of(folder, &format!("map = \"map.toml\"\ngrid = {grid:?}\n"), body);
        Self { areas: plan.areas.clone(), ..built }
    }

    /// The same with named places, from which routes are kept.
    #[track_caller]
    pub fn of_plan_and_places(plan: &Plan, body: &Body, grid: f64, places: &[(&str, Point)]) -> Self {
        let folder = TestSite::empty().with("map.toml", &plan.to_toml());
        let place = |(name, at): &(&str, Point)| {
            format!("[[place]]\nname = \"{name}\"\nat = [{:?}, {:?}]\n", at.x, at.y)
        };
        let places: String = places.iter().map(place).collect();
        Self::of(folder, &format!("map = \"map.toml\"\ngrid = {grid:?}\n{places}"), body)
    }

    /// Somebody's map with a robot, its cells those of the image.
    #[track_caller]
    pub fn of_map(map: &Path, body: &Body) -> Self {
        Self::of(TestSite::empty(), &format!("map = \"{}\"\n", map.display()), body)
    }

    /// The same by the shipped rules: ways keep off walls where that costs little.
    #[track_caller]
    pub fn of_map_off_walls(map: &Path, body: &Body) -> Self {
        Self::build(Self::folder_of(TestSite::empty(), &format!("map = \"{}\"\n", map.display()), body), body)
    }

    /// How near routes come to the best way is judged of the tightest.
    #[track_caller]
    fn of(folder: TestSite, settings: &str, body: &Body) -> Self {
        Self::build(Self::folder_of(folder, settings, body).without_berth(), body)
    }

    fn folder_of(folder: TestSite, settings: &str, body: &Body) -> TestSite {
        folder
            .with("robots.toml", &body.to_toml())
            .with("site.toml", &format!("name = \"a test\"\nrobots = \"robots.toml\"\n{settings}"))
    }

    #[track_caller]
    fn build(folder: TestSite, body: &Body) -> Self {
        let knowledge = KnowledgeBase::open(folder.path()).expect("a site");
        knowledge.build(&Silent).unwrap_or_else(|error| panic!("{error:?}\n{}", folder.path().display()));
        let world = knowledge.site().world().expect("the map is readable");
        Self { folder, knowledge, body: body.clone(), world, areas: Vec::new() }
    }

    /// The site's folder.
    pub fn folder(&self) -> &TestSite {
        &self.folder
    }

    /// The robot.
    pub fn body(&self) -> &Body {
        &self.body
    }

    /// The route between two points; `None` where there is none.
    #[track_caller]
    pub fn route(&self, start: Point, goal: Point) -> Option<Driven> {
        let name = |p: Point| format!("{:?},{:?}", p.x, p.y);
        self.route_by_name(&name(start), &name(goal), start)
    }

    /// The route between two places, or points as `x,y`; the start is at `at`. `None` where there is none.
    #[track_caller]
    pub fn route_by_name(&self, start: &str, goal: &str, at: Point) -> Option<Driven> {
        let answer = self.knowledge.route(start, goal, None).expect("an answer");
        match answer.status {
            Status::Ok | Status::SameRoom => {
                let json = serde_json::to_value(&answer).expect("an answer is JSON");
                Some(Driven::read(&json, at, &self.body))
            }
            _ => None,
        }
    }
}
