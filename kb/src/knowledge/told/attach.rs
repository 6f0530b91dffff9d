//! Which objects a fact is about, after each build anew: by name, or by what lies at its point.

use std::collections::{BTreeMap, BTreeSet};
use std::sync::Arc;

use adit_engine::{KnowledgeBase as Inference, Type, Value};
use adit_planners::geometry::{Point, Rect, Segment, polygon};
use adit_planners::rooms::outline;

use super::{Fact, Object};

/// How far from its point a fact about a door still finds the door, metres.
pub const REACH: f64 = 0.5;

/// Two segments have one direction where the angle between them is at most this, as its cosine: 20 degrees.
const SAME_DIRECTION: f64 = 0.94;

/// The objects that facts are about.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Attached {
    keys: BTreeMap<i64, Vec<String>>,
    /// Of each property of each object, the fact that counts.
    cells: BTreeMap<(String, usize, String), Fact>,
}

impl Attached {
    /// Notes that a fact is about the object in a row.
    pub fn add(&mut self, fact: &Fact, row: usize, key: Option<String>) {
        self.keys.entry(fact.id).or_default().extend(key);
        if fact.is_for_some() {
            return;
        }
        let cell = (fact.class.clone(), row, fact.property.clone());
        self.cells.insert(cell, fact.clone());
    }

    /// Takes in what was found of another class.
    pub fn join(&mut self, other: Self) {
        self.keys.extend(other.keys);
        self.cells.extend(other.cells);
    }

    /// Keys of the objects that a fact is about.
    pub fn keys(&self, fact: i64) -> Vec<String> {
        self.keys.get(&fact).cloned().unwrap_or_default()
    }

    /// Which properties are told, and of which type: class, property, type.
    pub fn properties(&self) -> BTreeSet<(&str, &str, Type)> {
        let cells = self.cells.iter();
        cells.map(|((class, _, property), fact)| (class.as_str(), property.as_str(), fact.kind())).collect()
    }

    /// What is told of each property of each object: class, row, property.
    pub fn cells(&self) -> &BTreeMap<(String, usize, String), Fact> {
        &self.cells
    }
}

impl Object {
    /// Where the object of a class with a key lies, so that it is found again when it has another number; `None` of classes whose
    /// objects have names of their own, and of changes of shape.
    pub fn placed(knowledge: &Inference, class: &str, key: &str) -> Option<Self> {
        let row = knowledge.row(class, key)?;
        let number = |property: &str| match knowledge.value_at(class, row, property) {
            Some(Value::Number(number)) => Some(number),
            _ => None,
        };
        let text = |property: &str| match knowledge.value_at(class, row, property) {
            Some(Value::Text(text)) => Some(text),
            _ => None,
        };
        let ends = || Some([number("x0")?, number("y0")?, number("x1")?, number("y1")?]);
        match class {
            "DOORS" | "DOORWAYS" if text("kind").is_none_or(|kind| &*kind == "door") => {
                let [x0, y0, x1, y1] = ends()?;
                Some(Self::Point([f64::midpoint(x0, x1), f64::midpoint(y0, y1)], Some([x0, y0, x1, y1])))
            }
            "ROOMS" => {
                let [x0, y0, x1, y1] = ends()?;
                let outline = outline::read(text("outline").as_deref(), Rect::new(x0, y0, x1, y1)).ok()?;
                let centre = outline.centre();
                Some(Self::Point([centre.x, centre.y], None))
            }
            "SPACES" => Some(Self::Point([number("x")?, number("y")?], None)),
            _ => None,
        }
    }
}

impl Fact {
    /// The rows of the objects that a fact is about, ascending.
    ///
    /// A name means the object with that key, or the doorway or space that is called so. A point alone means the nearest doorway;
    /// of other classes every object with a rectangle, or an outline, that holds the
    /// point; of those of one layer (robot, state and facing) the first one. A door is found by its segment: [`is_same_door`].
    pub fn rows(&self, knowledge: &Inference) -> Vec<usize> {
        match &self.object {
            Object::Key(key) => {
                let row = knowledge.row(&self.class, key).or_else(|| called(knowledge, &self.class, key));
                row.into_iter().collect()
            }
            Object::Point([x, y], Some(segment)) => {
                doors_like(knowledge, &self.class, Point::new(*x, *y), *segment)
            }
            Object::Point([x, y], None) if self.class == "DOORWAYS" => {
                nearest(knowledge, &self.class, Point::new(*x, *y)).into_iter().collect()
            }
            Object::Point([x, y], None) => holding(knowledge, &self.class, Point::new(*x, *y)),
        }
    }
}

/// The object that the map calls so, or the doorway or space of a number: `doorway 3`.
fn called(knowledge: &Inference, class: &str, name: &str) -> Option<usize> {
    let kind = match class {
        "DOORWAYS" => "doorway",
        "SPACES" => "space",
        _ => return None,
    };
    let names = knowledge.texts(class, "called").unwrap_or_default();
    let by_map = names.iter().position(|called| called.as_deref() == Some(name));
    by_map.or_else(|| knowledge.row(class, name.strip_prefix(kind)?.trim()))
}

/// The object whose segment is nearest to a point that is said alone.
fn nearest(knowledge: &Inference, class: &str, at: Point) -> Option<usize> {
    let far = |[x0, y0, x1, y1]: [f64; 4]| Segment::new(Point::new(x0, y0), Point::new(x1, y1)).distance(at);
    let rows = rects(knowledge, class)?.into_iter().map(far).enumerate();
    let near = rows.filter(|(_, metres)| *metres <= REACH);
    near.min_by(|one, other| one.1.total_cmp(&other.1)).map(|(row, _)| row)
}

fn rects(knowledge: &Inference, class: &str) -> Option<Vec<[f64; 4]>> {
    let [x0, y0, x1, y1] = ["x0", "y0", "x1", "y1"].map(|side| knowledge.numbers(class, side));
    let (x0, y0, x1, y1) = (x0?, y0?, x1?, y1?);
    let side = |side: Option<f64>| side.unwrap_or(f64::NAN);
    Some((0..x0.len()).map(|row| [side(x0[row]), side(y0[row]), side(x1[row]), side(y1[row])]).collect())
}

fn holding(knowledge: &Inference, class: &str, at: Point) -> Vec<usize> {
    let Some(rects) = rects(knowledge, class) else { return in_rings(knowledge, class, at) };
    let mut layers = Vec::new();
    let mut found = Vec::new();
    for (row, [x0, y0, x1, y1]) in rects.into_iter().enumerate() {
        let bounds = Rect::new(x0, y0, x1, y1);
        if !bounds.contains(at) {
            continue;
        }
        let text = match knowledge.value_at(class, row, "outline") {
            Some(Value::Text(text)) => Some(text),
            _ => None,
        };
        if !outline::read(text.as_deref(), bounds).is_ok_and(|outline| outline.contains(at)) {
            continue;
        }
        let layer = ["robot", "state", "facing"].map(|part| knowledge.value_at(class, row, part));
        if !layers.contains(&layer) {
            layers.push(layer);
            found.push(row);
        }
    }
    found
}

/// The objects whose outlines, of several rings each, hold a point.
fn in_rings(knowledge: &Inference, class: &str, at: Point) -> Vec<usize> {
    let outlines = knowledge.texts(class, "outline").unwrap_or_default();
    let holds = |outline: &Option<Arc<str>>| {
        let rings: Vec<Vec<[f64; 2]>> = outline.as_ref().and_then(|text| serde_json::from_str(text).ok())?;
        let sides = rings.iter().flat_map(|ring| {
            let corners: Vec<Point> = ring.iter().map(|[x, y]| Point::new(*x, *y)).collect();
            polygon::sides(&corners).collect::<Vec<_>>()
        });
        Some(polygon::encloses(sides, at))
    };
    (0..outlines.len()).filter(|row| holds(&outlines[*row]) == Some(true)).collect()
}

fn doors_like(knowledge: &Inference, class: &str, at: Point, told: [f64; 4]) -> Vec<usize> {
    let is_door = |row: usize| match knowledge.value_at(class, row, "kind") {
        Some(Value::Text(kind)) => &*kind == "door",
        _ => true,
    };
    let segments = rects(knowledge, class).unwrap_or_default();
    let alike = segments.into_iter().enumerate().filter(|(_, found)| is_same_door(at, told, *found));
    alike.map(|(row, _)| row).filter(|row| is_door(*row)).collect()
}

/// Whether a door's segment is where a door was told about: it passes within [`REACH`] of the point, has the same
/// direction, shares at least half of the shorter of both lengths, and is not more than a metre longer than twice what
/// it was (the wall is gone where it is).
pub fn is_same_door(at: Point, told: [f64; 4], found: [f64; 4]) -> bool {
    let ends = |[x0, y0, x1, y1]: [f64; 4]| (Point::new(x0, y0), Point::new(x1, y1));
    let ((a, b), (c, d)) = (ends(told), ends(found));
    let (length, other) = (a.distance(b), c.distance(d));
    if length == 0.0 || other == 0.0 || other.is_nan() {
        return false;
    }
    let (ux, uy) = ((b.x - a.x) / length, (b.y - a.y) / length);
    let cosine = ((d.x - c.x) * ux + (d.y - c.y) * uy) / other;
    if cosine.abs() < SAME_DIRECTION || at.nearest_on(c, d).distance(at) > REACH {
        return false;
    }
    let along = |p: Point| (p.x - a.x) * ux + (p.y - a.y) * uy;
    let (low, high) = (along(c).min(along(d)), along(c).max(along(d)));
    let shared = high.min(length) - low.max(0.0);
    shared >= 0.5 * length.min(other) && other <= 2.0 * length + 1.0
}

#[cfg(test)]
mod tests {
    use super::*;

    const TOLD: [f64; 4] = [5.0, 2.0, 5.0, 2.6];

    fn is_found(found: [f64; 4]) -> bool {
        is_same_door(Point::new(5.0, 2.3), TOLD, found)
    }

    #[test]
    fn the_door_of_another_state_is_the_same_door() {
        assert!(is_found([5.2, 2.2, 5.2, 2.4]), "of a wider state, in front of the wall");
        assert!(is_found([4.8, 1.9, 4.8, 2.7]), "of a slimmer state, behind it");
        assert!(is_found([5.0, 2.6, 5.0, 2.0]), "drawn the other way");
    }

    #[test]
    fn what_lies_elsewhere_or_goes_elsewhere_is_another_door() {
        assert!(!is_found([5.6, 2.0, 5.6, 2.6]), "farther than the reach");
        assert!(!is_found([4.7, 2.3, 5.3, 2.3]), "across it");
        assert!(!is_found([5.0, 2.5, 5.0, 3.1]), "beside it: a sixth is shared");
        assert!(!is_found([5.0, 0.0, 5.0, 9.0]), "the wall is gone");
    }
}
