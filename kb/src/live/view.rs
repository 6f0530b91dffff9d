//! What questions are answered from: the site as it was after some edit, which no later edit changes.

use std::sync::{Arc, Weak};

use adit_db::place::Place;
use adit_planners::geometry::Rect;
use adit_planners::world::World;

use super::memory::Memory;
use crate::answer::{self, Answer};
use crate::error::{Code, Error, Result};
use crate::graph::SiteGraph;
use crate::graph::gauge::Gauge;
use crate::graph::pairs::{self, Known, PlaceCosts};
use crate::knowledge::inputs::Inputs;
use crate::knowledge::{KnowledgeBase, tolerance};
use crate::state::Courses;

/// The site at one moment. A copy costs nothing, and may be asked from any thread while edits go on.
#[derive(Clone)]
pub struct View {
    site: Arc<KnowledgeBase>,
    inputs: Arc<Inputs>,
    world: Arc<World>,
    graph: Arc<SiteGraph>,
    courses: Option<Arc<Courses>>,
    gauge: Arc<Gauge>,
    robots: Arc<[String]>,
    layout: Arc<str>,
    generation: u64,
    routes_due: bool,
    known: Arc<Known>,
    within: Option<f64>,
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
        let are_courses = match (&self.courses, &view.courses) {
            (Some(one), Some(other)) => one.as_ptr() == Arc::as_ptr(other),
            (None, None) => true,
            _ => false,
        };
        are_courses
            && self.inputs.as_ptr() == Arc::as_ptr(&view.inputs)
            && self.world.as_ptr() == Arc::as_ptr(&view.world)
            && self.graph.as_ptr() == Arc::as_ptr(&view.graph)
            && self.gauge.as_ptr() == Arc::as_ptr(&view.gauge)
            && self.robots == view.robots
    }
}

impl View {
    /// What its routes follow from.
    pub fn ways(&self) -> Ways {
        Ways {
            inputs: Arc::downgrade(&self.inputs),
            world: Arc::downgrade(&self.world),
            graph: Arc::downgrade(&self.graph),
            courses: self.courses.as_ref().map(Arc::downgrade),
            gauge: Arc::downgrade(&self.gauge),
            robots: Arc::clone(&self.robots),
        }
    }

    pub(super) fn of(memory: &Memory) -> Self {
        Self {
            site: Arc::clone(&memory.state.site),
            inputs: Arc::clone(&memory.state.inputs),
            world: Arc::clone(&memory.state.world),
            graph: Arc::clone(memory.state.graph()),
            courses: memory.state.courses.clone(),
            gauge: Arc::clone(&memory.state.gauge),
            robots: memory.state.robots().into(),
            layout: memory.layout(),
            generation: memory.state.generation,
            routes_due: memory.routes_due,
            known: Arc::clone(&memory.state.known),
            within: None,
        }
    }

    /// Moves a start or goal at which nothing fits by up to so many metres, to the nearest point.
    pub fn within(mut self, metres: Option<f64>) -> Result<Self> {
        self.within = tolerance(metres)?;
        Ok(self)
    }

    /// The route of least hardness to the one of several goals that costs least. Nothing is read but memory.
    pub fn route(&self, start: &str, goals: &[String], robot: Option<&str>) -> Result<Answer> {
        let robot = answer::pick(&self.robots, robot)?;
        if let Some(courses) = &self.courses {
            self.site.site().moves_ends(self.within)?;
            return Ok(Answer::by(courses, (start, goals), &robot, self.generation));
        }
        let blank = Answer::blank(&robot, start, goals, self.generation);
        self.basis().search(goals, blank)
    }

    /// What [`route`](Self::route) answers, as JSON, in microseconds; `None` where there is no route, or rooms weigh metres.
    pub(crate) fn quick_route(
        &self,
        start: &str,
        goals: &[String],
        robot: Option<&str>,
    ) -> Result<Option<Vec<u8>>> {
        if self.courses.is_some() {
            return Ok(None);
        }
        let robot = answer::pick(&self.robots, robot)?;
        let blank = Answer::blank(&robot, start, goals, self.generation);
        self.basis().quick(goals, blank)
    }

    fn basis(&self) -> answer::Basis<'_> {
        answer::Basis {
            graph: &self.graph,
            rules: &self.inputs.rule_names,
            ground: answer::Ground::Known(&self.world, &self.gauge),
            within: self.within,
            ends_in: [None; 2],
            start_facing: None,
        }
    }

    /// The places, by name.
    pub(crate) fn places(&self) -> impl Iterator<Item = Place> {
        let of_course = self.courses.iter().flat_map(|courses| courses.ends());
        self.graph.places.clone().into_iter().chain(of_course)
    }

    /// What holds all of the map, metres; of a map that is not cut into rooms all that routes lead over.
    pub(crate) fn bounds(&self) -> Rect {
        let Some(courses) = &self.courses else { return self.world.bounds };
        let outermost = courses.outermost();
        if outermost.is_empty() { self.world.bounds } else { Rect::around(outermost) }
    }

    /// A map that is not cut into rooms as an SVG text, with a route where one is asked for.
    pub(crate) fn picture(&self, route: Option<(&str, &str)>, robot: Option<&str>) -> Result<String> {
        let Some(courses) = &self.courses else {
            let message =
                "this map is cut into rooms: `/api/map` has what is drawn of it, and `adit draw` draws it";
            return Err(Error::said(Code::CourseUnfit, message, None));
        };
        let Some((start, goal)) = route else { return courses.picture("", None) };
        let robot = answer::pick(&self.robots, robot)?;
        courses.picture("", Some([robot.as_str(), start, goal]))
    }

    /// What routes between places cost, by robot, start and goal; those that there are. `None` where it is broken off.
    ///
    /// # Arguments
    /// `goes_on` is asked before the routes of a few starts are found.
    pub fn place_costs(&self, goes_on: impl Fn() -> bool) -> Option<PlaceCosts> {
        if let Some(courses) = &self.courses {
            return Some(courses.place_costs());
        }
        let (graph, all) = (&*self.graph, pairs::starts(&self.graph, &self.robots));
        let rows = self.known.rows((graph, &self.gauge), &self.robots, &all, goes_on);
        (rows.len() == all.len()).then(|| pairs::costs(graph, &self.robots, &rows))
    }

    /// The site's files.
    pub fn site(&self) -> &KnowledgeBase {
        &self.site
    }

    /// The map with what lies over it.
    pub(crate) fn world(&self) -> &World {
        &self.world
    }

    /// Rooms, doors and places.
    pub(crate) fn graph(&self) -> &SiteGraph {
        &self.graph
    }

    /// The robots, in the order of their names.
    pub fn robots(&self) -> &[String] {
        &self.robots
    }

    /// Number of the knowledge base's state.
    pub fn generation(&self) -> u64 {
        self.generation
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
