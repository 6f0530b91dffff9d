//! What questions are answered from: the site as it was after some edit, which no later edit changes.

use std::sync::{Arc, Weak};

use adit_db::place::Place;
use adit_planners::geometry::Rect;
use adit_planners::world::World;

use super::memory::Memory;
use crate::answer::{self, Answer, Moment};
use crate::error::{Code, Error, Result};
use crate::graph::SiteGraph;
use crate::graph::gauge::Gauge;
use crate::graph::pairs::{self, Known, PlaceCosts};
use crate::knowledge::KnowledgeBase;
use crate::knowledge::inputs::Inputs;
use crate::state::Courses;

/// The site at one moment. A copy costs nothing, and may be asked from any thread while edits go on.
#[derive(Clone)]
pub struct View {
    moment: Moment,
    layout: Arc<str>,
    routes_due: bool,
    known: Arc<Known>,
}

/// What the routes of a moment follow from, held without keeping it: graphs that nobody reads any more are written to again.
#[derive(Clone, Debug)]
pub struct Ways {
    inputs: Weak<Inputs>,
    world: Weak<World>,
    graph: Weak<SiteGraph>,
    courses: Option<Weak<Courses>>,
    gauge: Weak<Gauge>,
    robots: Arc<[String]>,
}

impl Ways {
    /// Whether the same questions have the same routes at another moment, for nothing that they follow from was touched.
    pub fn are_those_of(&self, view: &View) -> bool {
        // an address is not given out anew as long as somebody knows it weakly
        let are_courses = match (&self.courses, &view.moment.courses) {
            (Some(one), Some(other)) => one.as_ptr() == Arc::as_ptr(other),
            (None, None) => true,
            _ => false,
        };
        are_courses
            && self.inputs.as_ptr() == Arc::as_ptr(&view.moment.inputs)
            && self.world.as_ptr() == Arc::as_ptr(&view.moment.world)
            && self.graph.as_ptr() == Arc::as_ptr(&view.moment.graph)
            && self.gauge.as_ptr() == Arc::as_ptr(&view.moment.gauge)
            && self.robots == view.moment.robots
    }
}

impl View {
    /// What its routes follow from.
    pub fn ways(&self) -> Ways {
        Ways {
            inputs: Arc::downgrade(&self.moment.inputs),
            world: Arc::downgrade(&self.moment.world),
            graph: Arc::downgrade(&self.moment.graph),
            courses: self.moment.courses.as_ref().map(Arc::downgrade),
            gauge: Arc::downgrade(&self.moment.gauge),
            robots: Arc::clone(&self.moment.robots),
        }
    }

    pub(super) fn of(memory: &Memory) -> Self {
        Self {
            moment: memory.state.moment(),
            layout: memory.layout(),
            routes_due: memory.routes_due,
            known: Arc::clone(&memory.state.known),
        }
    }

    /// Moves a start or goal at which nothing fits by up to so many metres, to the nearest point.
    pub fn within(mut self, metres: Option<f64>) -> Result<Self> {
        self.moment = self.moment.within(metres)?;
        Ok(self)
    }

    /// The route of least hardness to the one of several goals that costs least. Nothing is read but memory.
    pub fn route(&self, start: &str, goals: &[String], robot: Option<&str>) -> Result<Answer> {
        self.moment.route(start, goals, robot)
    }

    /// What [`route`](Self::route) answers, as JSON, in microseconds; `None` where there is no route, or rooms weigh metres.
    pub(crate) fn quick_route(
        &self,
        start: &str,
        goals: &[String],
        robot: Option<&str>,
    ) -> Result<Option<Vec<u8>>> {
        self.moment.quick_route(start, goals, robot)
    }

    /// The places, by name.
    pub(crate) fn places(&self) -> impl Iterator<Item = Place> {
        let of_course = self.moment.courses.iter().flat_map(|courses| courses.ends());
        self.moment.graph.places.clone().into_iter().chain(of_course)
    }

    /// What holds all of the map, metres; of a map that is not cut into rooms all that routes lead over.
    pub(crate) fn bounds(&self) -> Rect {
        let Some(courses) = &self.moment.courses else { return self.moment.world.bounds };
        let outermost = courses.outermost();
        if outermost.is_empty() { self.moment.world.bounds } else { Rect::around(outermost) }
    }

    /// A map that is not cut into rooms as an SVG text, with a route where one is asked for.
    pub(crate) fn picture(&self, route: Option<(&str, &str)>, robot: Option<&str>) -> Result<String> {
        let Some(courses) = &self.moment.courses else {
            let message =
                "this map is cut into rooms: `/api/map` has what is drawn of it, and `adit draw` draws it";
            return Err(Error::said(Code::CourseUnfit, message, None));
        };
        let Some((start, goal)) = route else { return courses.picture("", None) };
        let robot = answer::pick(&self.moment.robots, robot)?;
        courses.picture("", Some([robot.as_str(), start, goal]))
    }

    /// What routes between places cost, by robot, start and goal; those that there are. `None` where it is broken off.
    ///
    /// # Arguments
    /// `goes_on` is asked before the routes of a few starts are found.
    pub fn place_costs(&self, goes_on: impl Fn() -> bool) -> Option<PlaceCosts> {
        if let Some(courses) = &self.moment.courses {
            return Some(courses.place_costs());
        }
        let (graph, all) = (&*self.moment.graph, pairs::starts(&self.moment.graph, &self.moment.robots));
        let rows = self.known.rows((graph, &self.moment.gauge), &self.moment.robots, &all, goes_on);
        (rows.len() == all.len()).then(|| pairs::costs(graph, &self.moment.robots, &rows))
    }

    /// The site's files.
    pub fn site(&self) -> &KnowledgeBase {
        &self.moment.site
    }

    /// The map with what lies over it.
    pub(crate) fn world(&self) -> &World {
        &self.moment.world
    }

    /// Rooms, doors and places.
    pub(crate) fn graph(&self) -> &SiteGraph {
        &self.moment.graph
    }

    /// The robots, in the order of their names.
    pub fn robots(&self) -> &[String] {
        &self.moment.robots
    }

    /// Number of the knowledge base's state.
    pub fn generation(&self) -> u64 {
        self.moment.generation
    }

    /// Names the cut of the floor: while it is the same, numbers of rooms and doors mean what they meant.
    pub fn layout(&self) -> &str {
        &self.layout
    }

    /// Whether kept routes have yet to follow the last edits.
    pub fn routes_due(&self) -> bool {
        self.routes_due
    }
}
