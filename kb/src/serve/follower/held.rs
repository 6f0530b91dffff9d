//! The route that a follower holds.

use std::sync::Arc;

use adit_planners::geometry::{Point, Segment};

use crate::answer::{Answer, Status};
use crate::error::problem::Problem;
use crate::graph::Building;
use crate::live::{View, Ways};
use crate::serve::question::Question;

/// A route, and what was closed when it was found.
pub struct Held {
    pub answer: Arc<Answer>,
    /// Where something is closed to its robot, and the sentence that says so.
    pub closed: Vec<(Segment, String)>,
    ways: Ways,
}

impl Held {
    pub fn of(answer: Answer, view: &View) -> Self {
        let building = &view.graph().building;
        let doorways = building
            .closed()
            .map(|doorway| (Building::segment(doorway), building.why_closed(doorway.doorway)));
        let lines = building.lines.iter().filter(|line| line.whom.holds_for(&answer.robot)).map(|line| {
            let [x0, y0, x1, y1] = line.segment;
            (Segment::new(Point::new(x0, y0), Point::new(x1, y1)), building.why_told_closed(line))
        });
        Self { closed: doorways.chain(lines).collect(), answer: Arc::new(answer), ways: view.ways() }
    }

    /// The same route, of the site as it now is; `None` where it might be another one.
    pub fn kept(&self, view: &View) -> Option<Self> {
        self.ways.are_those_of(view).then(|| Self {
            answer: Arc::new(Answer { generation: view.generation(), ..(*self.answer).clone() }),
            closed: self.closed.clone(),
            ways: self.ways.clone(),
        })
    }

    /// The route from the same place as the site now is. Where its ends are none any more, that is why there is no way.
    pub fn renewed(&self, question: &Question, view: &View) -> Self {
        let Answer { start, robot, .. } = &*self.answer;
        let found = view.clone().within(question.within);
        let found = found.and_then(|view| view.route(start, &question.goals, Some(robot)));
        let answer = found.unwrap_or_else(|error| {
            let why = Problem::all(error.problems()).into_iter().next();
            let (reason, nearest) = why.map_or((None, None), |why| (Some(why.message), why.nearest));
            let blank = Answer::blank(robot, start, &question.goals, view.generation());
            Answer { status: Status::NoRoute, reason, nearest, ..blank }
        });
        Self::of(answer, view)
    }

    /// Whether it is the same route, whatever became of the rest of the site.
    pub fn is_same(&self, now: &Self) -> bool {
        Answer { generation: now.answer.generation, ..(*self.answer).clone() } == *now.answer
    }

    /// Whether its way passes a segment.
    pub fn passes(&self, segment: &Segment) -> bool {
        let point = |index: usize| {
            let at = &self.answer.waypoints[index];
            Point::new(at.x, at.y)
        };
        (1..self.answer.waypoints.len())
            .any(|index| Segment::new(point(index - 1), point(index)).gap(segment) < 1e-6)
    }
}
