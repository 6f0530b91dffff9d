//! A route over doors as JSON, put together from what is written of its rooms and doors already.

use adit_db::measure::Measures;
use adit_planners::routes::{Leg, Way};
use serde_json::{Result, to_writer};

use super::taken::{Taken, Taking};
use super::{Answer, Status};
use crate::graph::heading;
use crate::graph::{Rules, SiteGraph, Texts};

/// About so many bytes are said of a leg.
const LEG: usize = 700;

/// The answer with this way, as serde writes it.
///
/// # Arguments
/// `answer` says who asked for what; `site` is the graph, what is written of it, and the names of rules.
pub(super) fn write(answer: &Answer, site: (&SiteGraph, &Texts, &Rules), way: &Way) -> Result<Vec<u8>> {
    let mut out = Vec::with_capacity(300 + way.legs.len() * LEG);
    for (name, value) in [
        (r#"{"status":"#, serde_json::to_string(&Status::of(way))?),
        (r#","robot":"#, serde_json::to_string(&answer.robot)?),
        (r#","start":"#, serde_json::to_string(&answer.start)?),
        (r#","goal":"#, serde_json::to_string(&answer.goal)?),
        (r#","generation":"#, answer.generation.to_string()),
        (r#","cost":"#, serde_json::to_string(&way.cost)?),
    ] {
        out.extend_from_slice(name.as_bytes());
        out.extend_from_slice(value.as_bytes());
    }
    let legs = Legs::new(site, way)?;
    out.extend_from_slice(legs.takes.last().map_or(&[], |takes| &takes.so_far));
    out.extend_from_slice(br#","steps":["#);
    legs.steps(&mut out)?;
    out.extend_from_slice(br#"],"waypoints":["#);
    legs.waypoints(&mut out)?;
    out.extend_from_slice(b"]}");
    Ok(out)
}

struct Legs<'a> {
    site: (&'a SiteGraph, &'a Texts, &'a Rules),
    way: &'a Way,
    /// For each leg its heading and its cost, one behind the other, as they are written.
    numbers: Vec<u8>,
    /// Where each leg's heading and cost end.
    ends: Vec<[usize; 2]>,
    /// What each leg takes, as it is written.
    takes: Vec<Takes>,
    /// What is said of that at the start.
    at_start: Vec<u8>,
}

/// What a leg takes of measures, each with the comma and the name before it; empty where nothing is known.
#[derive(Default)]
struct Takes {
    room: Vec<u8>,
    door: Vec<u8>,
    so_far: Vec<u8>,
}

impl<'a> Legs<'a> {
    fn new(site: (&'a SiteGraph, &'a Texts, &'a Rules), way: &'a Way) -> Result<Self> {
        let mut numbers = Vec::with_capacity(way.legs.len() * 24);
        let mut ends = Vec::with_capacity(way.legs.len());
        for leg in &way.legs {
            to_writer(&mut numbers, &heading(leg.from, leg.to))?;
            let heading_ends = numbers.len();
            to_writer(&mut numbers, &leg.cost)?;
            ends.push([heading_ends, numbers.len()]);
        }
        let mut taken = Taken::new(site.0, way);
        let at_start = written(&taken.at_start())?;
        let take = |leg| {
            let Taking { room, door, so_far } = taken.follow(leg);
            let (room, door) = (written(&room)?, written(&door.unwrap_or_default())?);
            Ok(Takes { room, door, so_far: written(&so_far)? })
        };
        let takes = way.legs.iter().map(take).collect::<Result<_>>()?;
        Ok(Self { site, way, numbers, ends, takes, at_start })
    }

    fn heading(&self, leg: usize) -> &[u8] {
        let begins = if leg == 0 { 0 } else { self.ends[leg - 1][1] };
        &self.numbers[begins..self.ends[leg][0]]
    }

    fn cost(&self, leg: usize) -> &[u8] {
        &self.numbers[self.ends[leg][0]..self.ends[leg][1]]
    }

    /// What was spent before a leg.
    fn cost_before(&self, leg: usize) -> &[u8] {
        if leg == 0 { b"0.0" } else { self.cost(leg - 1) }
    }

    fn steps(&self, out: &mut Vec<u8>) -> Result<()> {
        let (graph, texts, rules) = self.site;
        let mut number = 1_usize;
        for (index, leg) in self.way.legs.iter().enumerate() {
            let room = texts.room(graph, rules, leg.room)?;
            let door = leg.door.map(|door| texts.door(graph, rules, door)).transpose()?;
            let mut step = |text: &[u8], cost: &[u8], rule: &[u8], takes: &[u8]| -> Result<()> {
                out.extend_from_slice(if number == 1 { br#"{"step":"#.as_slice() } else { br#",{"step":"# });
                to_writer(&mut *out, &number)?;
                out.extend_from_slice(text);
                out.extend_from_slice(cost);
                match door {
                    Some(door) => out.extend_from_slice(door.point()),
                    None => put_point(out, leg)?,
                }
                out.extend_from_slice(self.heading(index));
                out.extend_from_slice(rule);
                out.extend_from_slice(takes);
                out.push(b'}');
                number += 1;
                Ok(())
            };
            let takes = &self.takes[index];
            step(room.step(), self.cost_before(index), room.rule(), &takes.room)?;
            if let Some(door) = door {
                step(door.step(), self.cost(index), door.rule(), &takes.door)?;
            }
        }
        Ok(())
    }

    fn waypoints(&self, out: &mut Vec<u8>) -> Result<()> {
        let (graph, texts, rules) = self.site;
        for (index, leg) in self.way.legs.iter().enumerate() {
            let room = texts.room(graph, rules, leg.room)?;
            if index == 0 {
                out.extend_from_slice(br#"{"waypoint":1"#);
                put_point(out, &Leg { to: leg.from, ..*leg })?;
                out.extend_from_slice(b"null");
                out.extend_from_slice(room.point());
                out.extend_from_slice(b"0.0");
                out.extend_from_slice(&self.at_start);
                out.push(b'}');
            }
            out.extend_from_slice(br#",{"waypoint":"#);
            to_writer(&mut *out, &(index + 2))?;
            match leg.door {
                Some(door) => out.extend_from_slice(texts.door(graph, rules, door)?.point()),
                None => put_point(out, leg)?,
            }
            out.extend_from_slice(self.heading(index));
            out.extend_from_slice(room.point());
            out.extend_from_slice(self.cost(index));
            out.extend_from_slice(&self.takes[index].so_far);
            out.push(b'}');
        }
        Ok(())
    }
}

fn written(measures: &Measures) -> Result<Vec<u8>> {
    if measures.is_empty() {
        return Ok(Vec::new());
    }
    let mut text = br#","measures":"#.to_vec();
    to_writer(&mut text, measures)?;
    Ok(text)
}

/// Where a leg ends, up to the heading.
fn put_point(out: &mut Vec<u8>, leg: &Leg) -> Result<()> {
    out.extend_from_slice(br#","x":"#);
    to_writer(&mut *out, &leg.to.x)?;
    out.extend_from_slice(br#","y":"#);
    to_writer(&mut *out, &leg.to.y)?;
    out.extend_from_slice(br#","heading":"#);
    Ok(())
}

#[cfg(test)]
mod tests;
