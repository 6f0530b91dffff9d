//! Why there is no route, in a sentence that names what would have to be otherwise.

use adit_db::door::Door;
use adit_planners::geometry::Point;
use adit_planners::layers::{Headroom, headroom, narrowest};
use adit_planners::routes::{Blockage, Goal, RoomIndex, Shut, Start, blockage};
use adit_planners::world::World;

use super::Answer;
use super::basis::Basis;
use super::ends::Ends;
use crate::error::{Code, Error, Nearest, Result};
use crate::graph::gauge::Size;
use crate::graph::{Closer, End, Rules, SiteGraph, is_weighed, why_one_way};
use crate::words::number::number;

/// How many shut doors are described.
const DESCRIBED: usize = 3;

impl Basis<'_> {
    /// Why no route joins the ends.
    pub(super) fn no_route(&self, ends: &Ends, answer: &Answer) -> Result<String> {
        let (graph, robot) = (self.graph, answer.robot.as_str());
        let [start, goal] = [&ends.start.rooms, &ends.goals[0].rooms];
        for (what, end, rooms) in [("start", &ends.named[0], start), ("goal", &ends.named[1], goal)] {
            if rooms.is_empty() {
                let nearest = answer.nearest.as_ref().filter(|nearest| nearest.end == what);
                return self.not_entered(what, end, robot, nearest);
            }
        }
        match blockage(graph.graph(), &ends.start, &ends.goals[0]) {
            Blockage::Shut(doors) => Ok(self.all_shut(&doors)),
            Blockage::Apart => {
                let (world, gauge) = self.ground.get()?;
                let to = ends.goals[0].at.unwrap_or_else(|| graph.point(&ends.named[1]));
                // as large as this errand's load makes them
                let of = gauge.sizes().iter().filter(|((of, _), size)| of == robot && size.width > 0.0);
                let states: Vec<(&str, Size)> =
                    of.map(|((_, state), size)| (state.as_str(), *size)).collect();
                apart(world, (ends.start.at, to), &states)
            }
        }
    }

    /// What would have to open for a way to lead from a start to a goal; `None` where nothing can, or nothing has to.
    pub fn why_shut(&self, start: &Start, goal: &Goal) -> Option<String> {
        match blockage(self.graph.graph(), start, goal) {
            Blockage::Shut(doors) if !doors.is_empty() => Some(self.all_shut(&doors)),
            _ => None,
        }
    }

    fn all_shut(&self, doors: &[Shut]) -> String {
        let mut shut: Vec<String> = Vec::new();
        for why in doors.iter().take(DESCRIBED).filter_map(|of| self.shut(*of)) {
            if !shut.contains(&why) {
                shut.push(why);
            }
        }
        let more = doors.len().saturating_sub(DESCRIBED);
        let more = if more > 0 {
            format!("; and {more} more {}", if more == 1 { "door" } else { "doors" })
        } else {
            String::new()
        };
        format!("{}{more}", shut.join("; "))
    }

    /// What lets nobody through, and why.
    fn shut(&self, of: Shut) -> Option<String> {
        let graph = self.graph;
        let door = match of {
            Shut::Door(door) => graph.door(i64::from(door))?,
            Shut::Room(room) => return Some(not_entered(graph, room, self.rules)),
            Shut::Closed(boundary) => match graph.closer(boundary) {
                Closer::Door(door) => door,
                Closer::Doorway(doorway) => return Some(graph.building.why_closed(doorway)),
                Closer::Line(line) => {
                    return Some(graph.building.why_told_closed(&graph.building.lines[line]));
                }
                Closer::OneWay(area) => return Some(why_one_way(&graph.building.one_ways[area])),
            },
        };
        Some(shut(graph, &graph[door], self.rules))
    }

    /// Why no way leads from or to an end, whatever its other end is.
    fn not_entered(&self, what: &str, end: &End, robot: &str, nearest: Option<&Nearest>) -> Result<String> {
        let (graph, at) = (self.graph, self.graph.point(end));
        let beside = |words: &str| {
            nearest.map_or_else(String::new, |nearest| format!("; the nearest point {words} is {nearest}"))
        };
        let mut rooms = graph.graph().room_indices();
        if let Some(room) = rooms.find(|&room| !is_weighed(&graph[room]) && graph.holds(room, end)) {
            let why = not_entered(graph, room, self.rules);
            return Ok(format!("the {what}: {why}{}", beside("from which ways lead on")));
        }
        let place = format!("the {what} ({:.2}, {:.2})", at.x, at.y);
        let states = self.gauge()?.map_or_else(Vec::new, |gauge| graph.states_at(gauge, at, Some(robot)));
        Ok(match states.as_slice() {
            [] => {
                let beside = beside("at which one fits");
                format!("no state of the robot fits at {place}{beside}")
            }
            states => {
                let (states, beside) = (states.join(", "), beside("from which ways lead on"));
                format!(
                    "{states} fits at {place}, but is shut in there: no straight way as wide as the robot leads to its rooms{beside}"
                )
            }
        })
    }
}

/// Why no route enters a room.
fn not_entered(graph: &SiteGraph, room: RoomIndex, rules: &Rules) -> String {
    let Point { x, y } = graph.outline(room).centre();
    let room = &graph[room];
    let place = format!("room {} at ({x:.2}, {y:.2})", room.name);
    match (room.passable.value, room.passable.rule.and_then(|rule| rules.get(&rule))) {
        (Some(false), Some(rule)) => format!("{place} is not entered (rule \"{rule}\")"),
        (Some(false), None) => format!("{place} is told not to be entered"),
        (None, _) => format!("whether {place} is entered is unknown: no rule says so, or rules disagree"),
        (Some(true), _) => format!("{place} has no hardness: no rule gives it one, or rules disagree"),
    }
}

/// A door that lets no state through, and what would fit.
fn shut(graph: &SiteGraph, door: &Door, rules: &Rules) -> String {
    let least = |values: [Option<f64>; 3]| values.into_iter().flatten().fold(f64::INFINITY, f64::min);
    let width = least([Some(door.width), door.side1.width, door.side2.width]);
    let height = least([door.side1.height, door.side2.height, None]);
    let needed = if height.is_finite() {
        let (height, width) = (number(height), number(width));
        format!("a state lower than {height} m and narrower than {width} m would be needed")
    } else {
        format!("a state narrower than {} m would be needed", number(width))
    };
    let mut sides = [door.side1.room, door.side2.room].into_iter().filter_map(|key| graph.room(key));
    if let Some(room) = sides.find(|&room| !is_weighed(&graph[room])) {
        return not_entered(graph, room, rules);
    }
    let rule = door.passable.rule.and_then(|rule| rules.get(&rule));
    let [x, y] = door.at;
    let place = format!("door {} at ({x:.2}, {y:.2})", door.door);
    match (door.passable.value, rule) {
        (Some(false), Some(rule)) => format!("{place} lets no state through (rule \"{rule}\"): {needed}"),
        (Some(false), None) => {
            format!("{place} is told to let nobody through, whatever its size")
        }
        _ => format!("{place} has no hardness: no rule gives it one, or rules disagree"),
    }
}

/// Two points that no doors join: how wide and how high the best way is.
///
/// # Arguments
/// `states` are those that move.
fn apart(world: &World, (from, to): (Point, Point), states: &[(&str, Size)]) -> Result<String> {
    let slimmest = states.iter().map(|(_, size)| size.width).fold(f64::INFINITY, f64::min);
    let native = world.occupancy.as_ref().map(|cells| cells.resolution);
    let step = world.grid.or(native).unwrap_or(slimmest / 7.0);
    let width = narrowest(world, from, to, step);
    let Some(way) = width.filter(|way| way.width > slimmest) else {
        return Ok(match width {
            Some(way) => format!(
                "the widest way is {} m wide at ({:.2}, {:.2}), and the slimmest state needs more than {slimmest} m",
                number(way.width),
                way.at.x,
                way.at.y
            ),
            None => "walls part start and goal: there is no way of any width".to_owned(),
        });
    };
    let high = headroom(world, from, to, slimmest, step).map_err(Error::of(Code::RouteReason))?;
    Ok(match high {
        Headroom::Limited { height, at } => {
            let lower = states.iter().filter(|(_, size)| size.height < height);
            let lower: Vec<&str> = lower.map(|(state, _)| *state).collect();
            let who = if lower.is_empty() {
                "no state is".to_owned()
            } else {
                format!("only {} is", lower.join(", "))
            };
            format!(
                "every way leads under a bridge of {height} m at ({:.2}, {:.2}): {who} lower, and the widest way is {} m wide",
                at.x,
                at.y,
                number(way.width)
            )
        }
        _ => format!(
            "the widest way is {} m wide at ({:.2}, {:.2}), and the slimmest state needs {slimmest} m: rules do not let that \
             state move, or change into it",
            number(way.width),
            way.at.x,
            way.at.y
        ),
    })
}
