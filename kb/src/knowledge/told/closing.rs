//! Facts that close something: for everybody, or for some robots only.

use adit_db::space::Doorway;
use adit_engine::Value;
use adit_planners::geometry::{Point, Segment, polygon};

use super::{Fact, Object};

/// That everybody is kept out, or nobody.
pub const CLOSED: &str = "closed";

/// The robots that are kept out, and no others.
pub const CLOSED_TO: &str = "closed_to";

/// The robots that come through, and no others.
pub const OPEN_TO: &str = "open_to";

/// The space from which nobody passes.
pub const CLOSED_FROM: &str = "closed_from";

/// What people can close for some robots only.
const FOR_SOME: [&str; 4] = ["DOORWAYS", "SPACES", "NAMED_DOORS", "AREAS"];

/// What a fact may close: the doorways, and the corners of the areas, by name.
#[derive(Clone, Copy)]
pub struct Closable<'a> {
    pub doorways: &'a [Doorway],
    pub areas: &'a dyn Fn(&str) -> Option<Vec<Point>>,
}

/// Who is kept out.
#[derive(Clone, Debug, PartialEq)]
pub enum Whom {
    All,
    Only(Vec<String>),
    Except(Vec<String>),
}

/// A boundary that a fact closes, with which no rule has anything to do.
#[derive(Clone, Debug, PartialEq)]
pub struct Line {
    /// The fact, by number; none of what an errand alone keeps away from.
    pub fact: Option<i64>,
    /// From x0, y0 to x1, y1.
    pub segment: [f64; 4],
    pub whom: Whom,
    /// The area of which it is a side: who is inside comes out, to the left of the segment.
    pub area: Option<String>,
}

impl Whom {
    pub fn holds_for(&self, robot: &str) -> bool {
        match self {
            Self::All => true,
            Self::Only(robots) => robots.iter().any(|of| of == robot),
            Self::Except(robots) => robots.iter().all(|of| of != robot),
        }
    }

    /// As it goes on from `closed`: ` to cart and walker`.
    pub fn words(&self) -> String {
        match self {
            Self::All => String::new(),
            Self::Only(robots) => format!(" to {}", robots.join(" and ")),
            Self::Except(robots) => format!(" to all but {}", robots.join(" and ")),
        }
    }
}

/// The names of a list.
pub fn names(list: &str) -> Vec<String> {
    list.split(',').map(str::trim).filter(|name| !name.is_empty()).map(str::to_owned).collect()
}

/// Whether the property of a class lists robots.
pub fn lists_robots(class: &str, property: &str) -> bool {
    FOR_SOME.contains(&class) && [CLOSED_TO, OPEN_TO].contains(&property)
}

impl Fact {
    /// Whether it holds for some robots only. Rules, which speak of all, are not told: several such facts hold side by side.
    pub fn is_for_some(&self) -> bool {
        lists_robots(&self.class, &self.property)
    }

    /// Whom it keeps out of what it is about; `None` where it closes nothing. What is closed from one side of a doorway that is
    /// there no more is closed from both.
    pub fn keeps_out(&self) -> Option<Whom> {
        match (self.property.as_str(), &self.value) {
            (CLOSED, Value::Truth(true)) | (CLOSED_FROM, Value::Text(_)) => Some(Whom::All),
            (CLOSED_TO, Value::Text(list)) if self.is_for_some() => Some(Whom::Only(names(list))),
            (OPEN_TO, Value::Text(list)) if self.is_for_some() => Some(Whom::Except(names(list))),
            _ => None,
        }
    }

    /// The segment that it closes, whatever doorway is found there now.
    pub fn closes(&self) -> Option<[f64; 4]> {
        let Object::Point(_, Some(segment)) = &self.object else { return None };
        (self.class == "DOORWAYS" && self.keeps_out().is_some()).then_some(*segment)
    }

    /// The boundaries that it closes, where that is not for rules to say.
    ///
    /// # Arguments
    /// `keys` are those of the objects that it is about.
    pub fn lines(&self, keys: &[String], Closable { doorways, areas }: Closable<'_>) -> Vec<Line> {
        let Some(whom) = self.keeps_out() else { return Vec::new() };
        let line = |segment: [f64; 4]| Line { fact: self.number(), segment, whom: whom.clone(), area: None };
        if keys.is_empty() {
            return self.closes().map(line).into_iter().collect();
        }
        if whom == Whom::All {
            return Vec::new();
        }
        if self.class == "AREAS" {
            let outlines = keys.iter().filter_map(|area| Some((area, areas(area)?)));
            let sides = |(area, corners): (&String, Vec<Point>)| -> Vec<Line> {
                let is_left_inside =
                    polygon::sides(&corners).map(|side| side.a.cross(side.b)).sum::<f64>() > 0.0;
                let outwards = |side: Segment| if is_left_inside { side.reversed() } else { side };
                let of = |side: Segment| {
                    let Segment { a, b } = outwards(side);
                    Line { area: Some(area.clone()), ..line([a.x, a.y, b.x, b.y]) }
                };
                polygon::sides(&corners).map(of).collect()
            };
            return outlines.flat_map(sides).collect();
        }
        let is_key = |key: &str| keys.iter().any(|of| of == key);
        let is_meant = |doorway: &&Doorway| match self.class.as_str() {
            "SPACES" => [doorway.space1, doorway.space2].iter().any(|space| is_key(&space.to_string())),
            "NAMED_DOORS" => doorway.called.as_deref().is_some_and(is_key),
            _ => is_key(&doorway.doorway.to_string()),
        };
        let meant = doorways.iter().filter(is_meant);
        meant.map(|doorway| line([doorway.x0, doorway.y0, doorway.x1, doorway.y1])).collect()
    }
}
