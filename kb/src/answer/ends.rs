//! Where a route that is asked for starts and leads to; where nothing fits there, the nearest point instead.

use adit_planners::routes::{Goal, Start};

use super::basis::Basis;
use super::{Answer, Status};
use crate::error::{Code, Error, Finding, Nearest, Result};
use crate::graph::End;
use crate::words::suggest::did_you_mean;

/// Start and goals of a question.
pub(super) struct Ends {
    /// As they were named, the start first.
    pub named: Vec<End>,
    pub start: Start,
    pub goals: Vec<Goal>,
    /// What was taken instead of which end, by index in `named`.
    pub taken: Vec<(usize, Nearest)>,
}

impl Basis<'_> {
    /// What start and goals are; where one is nothing, the answer says so.
    pub(super) fn ends(&self, names: &[String], answer: &mut Answer) -> Result<Option<Ends>> {
        let graph = self.graph;
        let mut named = Vec::with_capacity(names.len() + 1);
        for (index, name) in std::iter::once(&answer.start).chain(names).enumerate() {
            let Some(end) = graph.end(name) else {
                let meant =
                    did_you_mean(name, graph.names()).map_or(String::new(), |help| format!("; {help}"));
                answer.reason = Some(format!("`{name}` is no place, no room and no point `x,y`{meant}"));
                answer.status = if index == 0 { Status::UnknownStart } else { Status::UnknownGoal };
                return Ok(None);
            };
            named.push(end);
        }
        let (mut goals, mut taken) = (Vec::with_capacity(named.len()), Vec::new());
        for (index, end) in named.iter().enumerate() {
            let (goal, instead) = self.entered(end, index, answer)?;
            goals.push(goal);
            taken.extend(instead.map(|instead| (index, instead)));
        }
        let first = goals.remove(0);
        let start = Start { rooms: first.rooms, at: first.at.unwrap_or_else(|| graph.point(&named[0])) };
        Ok(Some(Ends { named, start, goals, taken }))
    }

    /// The rooms of an end; with what was taken instead, where nothing fits there and the nearest point is near enough.
    fn entered(&self, end: &End, index: usize, answer: &mut Answer) -> Result<(Goal, Option<Nearest>)> {
        let (graph, gauge, robot) = (self.graph, self.gauge()?, Some(answer.robot.as_str()));
        let refused = self.refused(end)?;
        if refused.is_none() {
            let goal = graph.goal(gauge, end, robot);
            if !goal.rooms.is_empty() || goal.at.is_none() {
                return Ok((goal, None));
            }
        }
        let at = graph.point(end);
        let nearest = graph.nearest(gauge, at, robot).map(|(to, state)| Nearest {
            end: if index == 0 { "start" } else { "goal" },
            x: to.x,
            y: to.y,
            metres: to.distance(at),
            state: state.map(str::to_owned),
        });
        let is_near = |nearest: &Nearest| self.within.is_some_and(|within| nearest.metres <= within);
        if let Some(instead) = nearest.as_ref().filter(|nearest| is_near(nearest)) {
            return Ok((graph.goal(gauge, &End::Point(instead.at()), robot), nearest));
        }
        if let Some((code, message)) = refused {
            let help =
                nearest.as_ref().map(|nearest| format!("the nearest point at which it fits is {nearest}"));
            return Err(Error::all([Finding::said(code, message, help).instead(nearest)]));
        }
        answer.nearest = answer.nearest.take().or(nearest);
        Ok((Goal { rooms: Vec::new(), at: Some(at) }, None))
    }

    /// Why nobody can be at a point, whatever the size; of places the map's reader makes sure.
    fn refused(&self, end: &End) -> Result<Option<(Code, String)>> {
        let End::Point(point) = end else { return Ok(None) };
        let named = format!("{},{}", point.x, point.y);
        let (world, gauge) = self.ground.get()?;
        if !world.bounds.contains(*point) {
            let b = world.bounds;
            let map = format!("the map goes from {},{} to {},{}", b.x0, b.y0, b.x1, b.y1);
            return Ok(Some((Code::RouteOutside, format!("{named} is outside of the map: {map}"))));
        }
        let is_solid = gauge.is_solid(world, *point);
        Ok(is_solid.then(|| (Code::RouteSolid, format!("{named} is inside an obstacle"))))
    }
}
