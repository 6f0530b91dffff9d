//! Routes as they are found in memory, with what is said of them.

use adit_planners::routes::Way;

use super::basis::Basis;
use super::ends::Ends;
use super::{Answer, Status, json, steps};
use crate::error::{Code, Error, Result};

/// A way that was found.
struct Found {
    /// To which goal, by index.
    goal: usize,
    way: Way,
    /// Whether it leads to a point, not to anywhere in a room.
    is_to_point: bool,
}

impl Basis<'_> {
    /// The route to the one of the goals that costs least, into the answer.
    pub fn search(&self, names: &[String], answer: Answer) -> Result<Answer> {
        let (mut answer, ends) = self.found(names, answer)?;
        if let (Status::NoRoute, Some(ends)) = (answer.status, ends) {
            answer.reason = Some(self.no_route(&ends, &answer)?);
        }
        Ok(answer)
    }

    /// The same, without a reason where there is none, which takes much longer to find; and the ends, where they are on the map.
    pub fn found(&self, names: &[String], mut answer: Answer) -> Result<(Answer, Option<Ends>)> {
        let Some(ends) = self.ends(names, &mut answer)? else { return Ok((answer, None)) };
        let found = self.find(&ends)?;
        let is_of_answer =
            |index: usize| found.as_ref().is_none_or(|found| index == 0 || index == found.goal + 1);
        let taken = ends.taken.iter().filter(|(index, _)| is_of_answer(*index));
        answer.taken = taken.map(|(_, instead)| instead.clone()).collect();
        if let Some(found) = found {
            answer.goal.clone_from(&names[found.goal]);
            answer.nearest = None;
            self.along(&found.way, found.is_to_point, &mut answer)?;
        } else {
            answer.status = Status::NoRoute;
        }
        Ok((answer, Some(ends)))
    }

    /// What [`search`](Self::search) finds, as JSON, in microseconds; `None` where there is no route, an end was moved, or the
    /// site's graph is not [prepared](crate::graph::SiteGraph::prepare).
    pub fn quick(&self, names: &[String], mut answer: Answer) -> Result<Option<Vec<u8>>> {
        let Some(texts) = self.graph.texts() else { return Ok(None) };
        let Some(ends) = self.ends(names, &mut answer)?.filter(|ends| ends.taken.is_empty()) else {
            return Ok(None);
        };
        let Some(found) = self.find(&ends)? else { return Ok(None) };
        answer.goal.clone_from(&names[found.goal]);
        let text = json::write(&answer, (self.graph, texts, self.rules), &found.way);
        text.map(Some).map_err(Error::of(Code::RouteJson))
    }

    /// The way to the one of the goals that costs least.
    fn find(&self, ends: &Ends) -> Result<Option<Found>> {
        let Some((goal, way)) = self.graph.graph().way(&ends.start, &ends.goals) else { return Ok(None) };
        let straight = match self.gauge()? {
            Some(gauge) => self.graph.straight(gauge, &ends.start, &ends.goals[goal]),
            None => None,
        };
        let way = straight.filter(|straight| straight.cost < way.cost).unwrap_or(way);
        Ok(Some(Found { goal, way, is_to_point: ends.goals[goal].at.is_some() }))
    }

    /// A way as an answer; where it does not lead to a point, nothing is walked in the last room.
    pub fn along(&self, way: &Way, is_to_point: bool, answer: &mut Answer) -> Result<()> {
        let Self { graph, rules, .. } = self;
        answer.steps = steps::steps(graph, rules, way, is_to_point);
        let gauge = self.gauge()?;
        answer.waypoints = steps::waypoints(graph, way, gauge);
        answer.cost = Some(way.cost);
        answer.distance = gauge.map(|_| way.length());
        answer.measures = answer.at_the_end();
        answer.status = Status::of(way);
        Ok(())
    }
}

impl Status {
    /// What a way makes of the question.
    pub(super) fn of(way: &Way) -> Self {
        if way.legs.iter().all(|leg| leg.door.is_none()) { Self::SameRoom } else { Self::Ok }
    }
}
