//! Where a route that is asked for starts and leads to; where nothing fits there, the nearest point instead.

use std::collections::BTreeSet;

use adit_db::room::Room;
use adit_planners::routes::{Goal, RoomIndex, Start};

use super::basis::Basis;
use super::{Answer, Status};
use crate::error::{Code, Error, Finding, Nearest, Result};
use crate::graph::End;
use crate::words::number::number;
use crate::words::suggest::{did_you_mean, listed};

/// Start and goals of a question.
pub(crate) struct Ends {
    /// As they were named, the start first.
    pub named: Vec<End>,
    pub start: Start,
    pub goals: Vec<Goal>,
    /// What was taken instead of which end, by index in `named`.
    pub taken: Vec<(usize, Nearest)>,
}

/// Facings that differ by less are one, degrees.
const SAME_FACING: f64 = 1e-6;

impl Basis<'_> {
    /// What start and goals are; where one is nothing, the answer says so.
    pub(super) fn ends(&self, names: &[String], answer: &mut Answer) -> Result<Option<Ends>> {
        let graph = self.graph;
        let mut named = Vec::with_capacity(names.len() + 1);
        for (index, name) in std::iter::once(&answer.start).chain(names).enumerate() {
            let Some(end) = graph.end(name) else {
                let (message, help) = graph.no_end(name);
                let help = help.map_or(String::new(), |help| format!("; {help}"));
                answer.reason = Some(message + help.as_str());
                answer.status = if index == 0 { Status::UnknownStart } else { Status::UnknownGoal };
                return Ok(None);
            };
            named.push(end);
        }
        let (mut goals, mut taken) = (Vec::with_capacity(named.len()), Vec::new());
        let mut unfit = Vec::new();
        for (index, end) in named.iter().enumerate() {
            let (mut goal, instead) = self.entered(end, index, answer)?;
            if let Some(facing) = self.start_facing.filter(|_| index == 0) {
                let is_there = |room: RoomIndex| {
                    self.graph[room].facing.is_some_and(|of| (of - facing).abs() < SAME_FACING)
                };
                goal.rooms.retain(|entry| is_there(entry.room));
            }
            if let Some(state) = self.ends_in[usize::from(index > 0)] {
                unfit.extend(self.keep_state(state, &mut goal, (end, index), &answer.robot)?);
            }
            goals.push(goal);
            taken.extend(instead.map(|instead| (index, instead)));
        }
        let is_start = |(index, _): &&(usize, String)| *index == 0;
        let no_goal = || unfit.first().filter(|_| unfit.len() == names.len());
        if let Some((_, reason)) = unfit.iter().find(is_start).or_else(no_goal) {
            (answer.status, answer.reason) = (Status::NoRoute, Some(reason.clone()));
            return Ok(None);
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
        let is_space = matches!(end, End::Space(_));
        let is_near =
            |nearest: &Nearest| is_space || self.within.is_some_and(|within| nearest.metres <= within);
        if let Some(instead) = nearest.as_ref().filter(|nearest| is_near(nearest)) {
            return Ok((graph.goal(gauge, &End::Point(instead.at()), robot), nearest));
        }
        if let Some((code, message)) = refused {
            let help = nearest
                .as_ref()
                .map(|nearest| format!("the nearest point at which the robot fits is {nearest}"));
            return Err(Error::all([Finding::said(code, message, help).instead(nearest)]));
        }
        answer.nearest = answer.nearest.take().or(nearest);
        Ok((Goal { rooms: Vec::new(), at: Some(at) }, None))
    }

    /// Leaves the rooms of one state to an end; where that does not fit there and another one does, its number, and that in
    /// words.
    fn keep_state(
        &self,
        state: &str,
        goal: &mut Goal,
        (end, index): (&End, usize),
        robot: &str,
    ) -> Result<Option<(usize, String)>> {
        let graph = self.graph;
        if graph.rooms.iter().all(|room| state_of(room, robot) != Some(state)) {
            let known = graph.rooms.iter().filter_map(|room| state_of(room, robot)).collect::<BTreeSet<_>>();
            let known = || known.iter().copied();
            let help = did_you_mean(state, known()).or_else(|| listed("states", known()));
            let message = format!("`{robot}` has no rooms in a state `{state}`");
            return Err(Error::said(Code::RouteUnknownState, message, help));
        }
        let others = goal.rooms.iter().filter_map(|entry| state_of(&graph[entry.room], robot));
        let others = others.map(str::to_owned).collect::<BTreeSet<_>>();
        goal.rooms.retain(|entry| state_of(&graph[entry.room], robot) == Some(state));
        if !goal.rooms.is_empty() || others.is_empty() {
            return Ok(None);
        }
        let (what, at) = (if index == 0 { "start" } else { "goal" }, graph.point(end));
        let others = others.into_iter().collect::<Vec<_>>().join(", ");
        let reason = format!(
            "{state} does not fit at the {what} ({:.2}, {:.2}), from which ways lead on for {others}",
            at.x, at.y
        );
        Ok(Some((index, reason)))
    }

    /// Why nobody can be at a point, whatever the size; of places the map's reader makes sure.
    fn refused(&self, end: &End) -> Result<Option<(Code, String)>> {
        let End::Point(point) = end else { return Ok(None) };
        let named = format!("{},{}", point.x, point.y);
        let (world, gauge) = self.ground.get()?;
        if !world.bounds.contains(*point) {
            let b = world.bounds;
            let map = {
                let [x0, y0, x1, y1] = [b.x0, b.y0, b.x1, b.y1].map(number);
                format!("the map goes from {x0},{y0} to {x1},{y1}")
            };
            return Ok(Some((Code::RouteOutside, format!("{named} is outside of the map: {map}"))));
        }
        let is_solid = gauge.is_solid(world, *point);
        Ok(is_solid.then(|| (Code::RouteSolid, format!("{named} is inside an obstacle"))))
    }
}

/// Of which state of a robot a room is one.
fn state_of<'r>(room: &'r Room, robot: &str) -> Option<&'r str> {
    let layer = room.layer.as_ref().filter(|(of, _)| of == robot);
    layer.map(|(_, state)| state.as_str())
}
