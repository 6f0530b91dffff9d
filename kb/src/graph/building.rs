//! The building's own nouns: its spaces and the doorways between them, with what rules say of them.

use adit_db::Tx;
use adit_db::layer::AreaOutline;
use adit_db::space::{Doorway, Space};
use adit_db::told::Standing;
use adit_planners::geometry::{Point, Rect, Segment, polygon};

use super::one_way::OneWay;
use crate::error::Result;

use crate::knowledge::told::{Closable, Fact, Line};

/// So far beside a doorway it is looked at which space lies there, metres.
const OFF_M: [f64; 4] = [0.1, 0.2, 0.4, 0.8];

/// Spaces and doorways, by number from 1.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Building {
    pub spaces: Vec<Space>,
    pub doorways: Vec<Doorway>,
    /// What is told to be closed for some robots only, or where no doorway is found.
    pub lines: Vec<Line>,
    /// Areas that one goes through in one direction, by name.
    pub one_ways: Vec<OneWay>,
}

impl Building {
    /// As the last build kept it.
    pub fn read(tx: &mut Tx<'_>) -> Result<Self> {
        let (mut lines, doorways, outlines) = (Vec::new(), tx.doorways()?, tx.area_outlines()?);
        let corners = |row: &AreaOutline| -> Option<Vec<Point>> {
            let corners: Vec<[f64; 2]> = serde_json::from_str(&row.outline).ok()?;
            Some(corners.into_iter().map(|[x, y]| Point::new(x, y)).collect())
        };
        let areas = |name: &str| outlines.iter().find(|row| row.area == name).and_then(corners);
        let closable = Closable { doorways: &doorways, areas: &areas };
        let standings = tx.standings()?;
        for row in tx.facts_told()? {
            let is_own = |standing: &&Standing| standing.told == row.id && standing.state == "attached";
            if let Some(standing) = standings.iter().find(is_own) {
                lines.extend(Fact::of(&row)?.lines(&standing.keys, closable));
            }
        }
        let one_ways = outlines.iter().filter_map(|row| {
            Some(OneWay { area: row.area.clone(), heading: row.heading?, corners: corners(row)? })
        });
        let one_ways = one_ways.collect();
        Ok(Self { spaces: tx.spaces()?, doorways, lines, one_ways })
    }

    /// What people call a space, by its number.
    pub fn space(&self, number: i64) -> Option<String> {
        let place = self.spaces.binary_search_by_key(&number, |space| space.space).ok()?;
        let name = self.spaces[place].name.clone();
        Some(name.unwrap_or_else(|| format!("space {number}")))
    }

    /// The doorway between two spaces, by their numbers, that is nearest to a point.
    pub fn doorway(&self, one: i64, other: i64, at: Point) -> Option<&Doorway> {
        let between = (one.min(other), one.max(other));
        let joins = |doorway: &&Doorway| (doorway.space1, doorway.space2) == between && one != other;
        let off = |doorway: &Doorway| (doorway.x - at.x).powi(2) + (doorway.y - at.y).powi(2);
        let doorways = self.doorways.iter().filter(joins);
        doorways.reduce(|best, next| if off(next) < off(best) { next } else { best })
    }

    /// What people call a doorway.
    pub fn name(doorway: &Doorway) -> String {
        doorway.name.clone().unwrap_or_else(|| format!("doorway {}", doorway.doorway))
    }

    /// That a doorway is closed, from where, and which spaces it is between.
    pub fn why_closed(&self, number: i64) -> String {
        match self.doorways.iter().find(|doorway| doorway.doorway == number) {
            Some(doorway) => format!("{} is {}", self.place_of(doorway), self.standing_of(doorway)),
            None => format!("doorway {number} is closed"),
        }
    }

    /// Whether a doorway is open or closed, as it goes on from `is`.
    fn standing_of(&self, doorway: &Doorway) -> String {
        match &doorway.closed_from {
            _ if doorway.closed == Some(true) => "closed".to_owned(),
            None => "open".to_owned(),
            Some(from) if self.one_way(doorway).is_some() => format!("closed from {from}"),
            Some(from) => format!("closed both ways: `{from}` does not lie on one side of it"),
        }
    }

    /// That a fact closes a boundary, and to whom.
    pub fn why_told_closed(&self, line: &Line) -> String {
        let (place, whom) = (self.place_of_line(line), line.whom.words());
        match line.fact {
            Some(fact) => format!("{place} is told to be closed{whom} (fact {fact})"),
            None => format!("{place} is closed{whom}, as was asked"),
        }
    }

    fn place_of_line(&self, Line { segment, area, .. }: &Line) -> String {
        if let Some(area) = area {
            return format!("the area `{area}`");
        }
        let [x0, y0, x1, y1] = *segment;
        let place = self.doorway_at(*segment).map(|doorway| self.place_of(doorway));
        let (x, y) = (f64::midpoint(x0, x1), f64::midpoint(y0, y1));
        place.unwrap_or_else(|| format!("({x:.2}, {y:.2}), from ({x0:.2}, {y0:.2}) to ({x1:.2}, {y1:.2}),"))
    }

    /// What is closed now and was not before, or no longer is, in sentences.
    pub fn turned(&self, before: &Self) -> Vec<String> {
        let is_same = |one: &Doorway, other: &Doorway| {
            ends_of(one).map(f64::to_bits) == ends_of(other).map(f64::to_bits)
        };
        let doorways = self.doorways.iter().filter_map(|now| {
            let was = before.doorways.iter().find(|was| is_same(was, now));
            let was = was.map_or_else(|| "open".to_owned(), |was| before.standing_of(was));
            let is = self.standing_of(now);
            (is != was).then(|| format!("{} is {is}", self.place_of(now)))
        });
        let differ = |some: &Self, others: &Self| -> Vec<Line> {
            let known = |line: &Line| {
                others.lines.iter().any(|other| {
                    (other.segment.map(f64::to_bits), &other.whom)
                        == (line.segment.map(f64::to_bits), &line.whom)
                })
            };
            some.lines.iter().filter(|line| !known(line)).cloned().collect()
        };
        let said =
            |line: Line, is: &str| format!("{} is {is}{}", self.place_of_line(&line), line.whom.words());
        let closed = differ(self, before).into_iter().map(|line| said(line, "closed"));
        let opened = differ(before, self).into_iter().map(|line| said(line, "no longer closed"));
        let one_ways = self.one_ways.iter().filter(|now| {
            before.one_ways.iter().all(|was| (&was.area, was.heading) != (&now.area, now.heading))
        });
        let one_ways = one_ways.map(why_one_way);
        let free = before.one_ways.iter().filter(|was| self.one_ways.iter().all(|now| now.area != was.area));
        let free = free.map(|was| format!("the area `{}` is passed in any direction", was.area));
        // each side of an area is a line
        let mut said: Vec<String> =
            doorways.chain(closed).chain(opened).chain(one_ways).chain(free).collect();
        said.dedup();
        said
    }

    /// What a doorway is called, where it is, and between which spaces.
    fn place_of(&self, doorway: &Doorway) -> String {
        let (name, x, y) = (Self::name(doorway), doorway.x, doorway.y);
        match [doorway.space1, doorway.space2].map(|space| self.space(space)) {
            [Some(one), Some(other)] => format!("{name} at ({x:.2}, {y:.2}), between {one} and {other},"),
            _ => format!("{name} at ({x:.2}, {y:.2})"),
        }
    }

    /// The doorway of this name: what rules call it, or `doorway 3`.
    pub fn doorway_named(&self, name: &str) -> Option<&Doorway> {
        let is_meant =
            |doorway: &&Doorway| Self::name(doorway) == name || is_numbered(name, "doorway", doorway.doorway);
        self.doorways.iter().find(is_meant)
    }

    /// The doorway with these ends.
    pub fn doorway_at(&self, ends: [f64; 4]) -> Option<&Doorway> {
        let ends = ends.map(f64::to_bits);
        self.doorways.iter().find(|doorway| ends_of(doorway).map(f64::to_bits) == ends)
    }

    /// The space of this name: what rules call it, or its number behind what it is: `corridor 15`, `space 15`. By those it is found
    /// again when the map calls it otherwise.
    pub fn space_named(&self, name: &str) -> Option<&Space> {
        let is_of_map = |space: &&Space| space.called.as_deref() == Some(name);
        let is_called = |space: &&Space| self.space(space.space).as_deref() == Some(name);
        let is_numbered = |space: &&Space| {
            let kinds = [Some("space"), space.kind.as_deref()];
            kinds.into_iter().flatten().any(|kind| is_numbered(name, kind, space.space))
        };
        let find = |is_meant: &dyn Fn(&&Space) -> bool| self.spaces.iter().find(is_meant);
        find(&is_of_map).or_else(|| find(&is_called)).or_else(|| find(&is_numbered))
    }

    /// What people call an object of a class with a number: a space or a doorway.
    pub fn called(&self, class: &str, key: &str) -> Option<String> {
        let number: i64 = key.parse().ok()?;
        match class {
            "SPACES" => self.space(number),
            "DOORWAYS" => self.doorways.iter().find(|doorway| doorway.doorway == number).map(Self::name),
            _ => None,
        }
    }

    /// What people call spaces and doorways.
    pub fn names(&self) -> impl Iterator<Item = String> {
        let spaces = self.spaces.iter().filter_map(|space| self.space(space.space));
        spaces.chain(self.doorways.iter().map(Self::name))
    }

    /// Where a doorway lies.
    pub fn segment(doorway: &Doorway) -> Segment {
        Segment::new(Point::new(doorway.x0, doorway.y0), Point::new(doorway.x1, doorway.y1))
    }

    /// The doorways that nobody passes, or nobody from one side.
    pub fn closed(&self) -> impl Iterator<Item = &Doorway> {
        self.doorways.iter().filter(|doorway| doorway.closed == Some(true) || doorway.closed_from.is_some())
    }

    /// Where a doorway that is closed from one side lies, with that side to its left. `None` where it is closed to everybody,
    /// as it is, too, if the space from which it is closed does not lie on one side of it, and the other space on the other.
    pub fn one_way(&self, doorway: &Doorway) -> Option<Segment> {
        let from = doorway.closed_from.as_deref().filter(|_| doorway.closed != Some(true))?;
        let from = self.space_named(from).filter(|space| joins(doorway, space))?.space;
        let other = if doorway.space1 == from { doorway.space2 } else { doorway.space1 };
        let [from, other] = [self.sides_of(from)?, self.sides_of(other)?];
        let segment = Self::segment(doorway);
        let (middle, across) = (segment.middle(), segment.direction().perpendicular());
        // outlines may keep off a doorway's line by some cells
        OFF_M.into_iter().find_map(|off| {
            let [left, right] = [off, -off].map(|off| {
                let holds =
                    |space: &[Segment]| polygon::encloses(space.iter().copied(), middle + across * off);
                [holds(&from), holds(&other)]
            });
            match (left, right) {
                ([true, false], [false, true]) => Some(segment),
                ([false, true], [true, false]) => Some(segment.reversed()),
                _ => None,
            }
        })
    }

    /// The space that holds a point.
    pub fn space_at(&self, at: Point) -> Option<&Space> {
        self.spaces_at(&[at])[0]
    }

    /// The space that holds each of some points.
    pub fn spaces_at(&self, points: &[Point]) -> Vec<Option<&Space>> {
        let mut found = vec![None; points.len()];
        let mut missing: Vec<usize> = (0..points.len()).collect();
        for space in &self.spaces {
            if missing.is_empty() {
                break;
            }
            let Some(sides) = self.sides_of(space.space) else { continue };
            let bounds = Rect::around(sides.iter().map(|side| side.a));
            missing.retain(|&index| {
                let point = points[index];
                let holds = bounds.contains(point) && polygon::encloses(sides.iter().copied(), point);
                if holds {
                    found[index] = Some(space);
                }
                !holds
            });
        }
        found
    }

    /// The sides of a space's outline.
    fn sides_of(&self, number: i64) -> Option<Vec<Segment>> {
        let place = self.spaces.binary_search_by_key(&number, |space| space.space).ok()?;
        let rings: Vec<Vec<[f64; 2]>> = serde_json::from_str(&self.spaces[place].outline).ok()?;
        let sides = |ring: Vec<[f64; 2]>| {
            let corners: Vec<Point> = ring.into_iter().map(|[x, y]| Point::new(x, y)).collect();
            polygon::sides(&corners).collect::<Vec<_>>()
        };
        Some(rings.into_iter().flat_map(sides).collect())
    }
}

/// That an area is passed in one direction.
pub fn why_one_way(OneWay { area, heading, .. }: &OneWay) -> String {
    format!("the area `{area}` is passed in one direction only, towards {heading} degrees")
}

/// Whether a space lies beside a doorway that leads into another one.
fn joins(doorway: &Doorway, space: &Space) -> bool {
    doorway.space1 != doorway.space2 && [doorway.space1, doorway.space2].contains(&space.space)
}

/// From x0, y0 to x1, y1.
fn ends_of(doorway: &Doorway) -> [f64; 4] {
    [doorway.x0, doorway.y0, doorway.x1, doorway.y1]
}

/// Whether a name is that of a kind with a number.
fn is_numbered(name: &str, kind: &str, number: i64) -> bool {
    name.strip_prefix(kind).is_some_and(|rest| rest.trim() == number.to_string())
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A doorway at x = 4, closed from the hall, which lies west of it, and the ward from `x0` to `x1`.
    fn floor([x0, x1]: [f64; 2]) -> Building {
        let space = |number, name: &str, [x0, x1]: [f64; 2]| Space {
            space: number,
            name: Some(name.to_owned()),
            outline: format!("[[[{x0},0],[{x1},0],[{x1},6],[{x0},6]]]"),
            ..Space::default()
        };
        let ends = Doorway { x0: 4.0, y0: 2.0, x1: 4.0, y1: 3.0, ..Doorway::default() };
        let closed_from = Some("hall".to_owned());
        let doorway = Doorway { doorway: 1, space1: 1, space2: 2, closed_from, ..ends };
        let spaces = vec![space(1, "hall", [0.0, 4.0]), space(2, "ward", [x0, x1])];
        Building { spaces, doorways: vec![doorway], ..Building::default() }
    }

    #[test]
    fn what_is_closed_from_one_side_has_that_side_to_its_left() {
        let building = floor([4.0, 9.0]);
        let segment = building.one_way(&building.doorways[0]).expect("its sides are told apart");
        assert!(segment.direction().y > 0.0, "west is to the left of who looks north");
        assert!(building.why_closed(1).ends_with("is closed from hall"), "{}", building.why_closed(1));
    }

    #[test]
    fn a_doorway_whose_sides_cannot_be_told_apart_is_closed_both_ways_and_says_so() {
        let building = floor([1.0, 4.0]);
        assert_eq!(building.one_way(&building.doorways[0]), None);
        let why = building.why_closed(1);
        assert!(why.ends_with("is closed both ways: `hall` does not lie on one side of it"), "{why}");
    }
}
