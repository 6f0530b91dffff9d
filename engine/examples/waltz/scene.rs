//! A scene of solids, as lines; and whether its edges are labelled right.

use std::collections::BTreeMap;

use adit_engine::{Class, ClassError, Diagnostics, KnowledgeBase, Limits, RuleBase, SourceFile, Value};

pub type Line = [i32; 4];

/// What junctions can mean: labels of their arms, counter-clockwise. An arrow and a tee begin with the arm that
/// has the others on its left.
pub const MEANINGS: [(&str, [&str; 3]); 18] = [
    ("L", ["<", ">", ""]),
    ("L", [">", "<", ""]),
    ("L", ["+", "<", ""]),
    ("L", [">", "+", ""]),
    ("L", ["-", ">", ""]),
    ("L", ["<", "-", ""]),
    ("arrow", ["<", "+", ">"]),
    ("arrow", ["-", "+", "-"]),
    ("arrow", ["+", "-", "+"]),
    ("fork", ["+", "+", "+"]),
    ("fork", ["-", "-", "-"]),
    ("fork", [">", "<", "-"]),
    ("fork", ["<", "-", ">"]),
    ("fork", ["-", ">", "<"]),
    ("tee", [">", "+", "<"]),
    ("tee", [">", "-", "<"]),
    ("tee", [">", ">", "<"]),
    ("tee", [">", "<", "<"]),
];

/// Front, depth and back edges of a stair of one step.
const STEP: [Line; 15] = [
    [0, 0, 80, 0],
    [80, 0, 80, 40],
    [80, 40, 40, 40],
    [40, 40, 40, 80],
    [40, 80, 0, 80],
    [0, 80, 0, 0],
    [80, 0, 100, 20],
    [80, 40, 100, 60],
    [40, 40, 60, 60],
    [40, 80, 60, 100],
    [0, 80, 20, 100],
    [100, 20, 100, 60],
    [100, 60, 60, 60],
    [60, 60, 60, 100],
    [60, 100, 20, 100],
];

/// A cube of which the left lower corner is hidden: its first two lines begin at what hides it.
const CUBE: [Line; 9] = [
    [10, 0, 40, 0],
    [0, 40, 0, 35],
    [40, 0, 40, 40],
    [40, 40, 0, 40],
    [0, 40, 20, 60],
    [20, 60, 60, 60],
    [60, 60, 40, 40],
    [60, 60, 60, 20],
    [60, 20, 40, 0],
];

/// The lines of a scene: a stair with some cubes in a row behind it, 15 lines and 11 for each cube.
pub fn scene(cubes: usize) -> Vec<Line> {
    let mut lines = STEP.to_vec();
    for cube in 0..cubes as i32 {
        let (x, y) = (90 + 50 * cube, 25 + 25 * cube);
        for [x1, y1, _, _] in &CUBE[..2] {
            // Where a hidden line comes out, it ends on a line of the front.
            let (x1, y1) = if *y1 == 0 { (x + x1, y) } else { (x, y + 35) };
            cut(&mut lines, x1, y1);
        }
        lines.extend(CUBE.map(|[x1, y1, x2, y2]| [x1 + x, y1 + y, x2 + x, y2 + y]));
    }
    lines
}

/// Cuts the line that goes through a point.
fn cut(lines: &mut Vec<Line>, x: i32, y: i32) {
    let through = |&[x1, y1, x2, y2]: &Line| {
        (x2 - x1) * (y - y1) == (y2 - y1) * (x - x1)
            && (x1.min(x2)..=x1.max(x2)).contains(&x)
            && (y1.min(y2)..=y1.max(y2)).contains(&y)
    };
    if let Some(at) = lines.iter().position(through) {
        let [x1, y1, x2, y2] = lines[at];
        lines[at] = [x1, y1, x, y];
        lines.push([x, y, x2, y2]);
    }
}

pub fn rules() -> Result<RuleBase, Diagnostics> {
    RuleBase::compile(&[SourceFile::new("waltz.rhai", include_str!("waltz.rhai"))])
}

/// So many copies of a drawing, one beside the other.
pub fn picture(lines: &[Line], copies: usize, limits: Limits) -> Result<KnowledgeBase, ClassError> {
    let number = |number: i32| Some(f64::from(number));
    let all: Vec<(usize, Line)> = (0..copies)
        .flat_map(|copy| {
            let x = 500 * copy as i32;
            lines.iter().map(move |&[x1, y1, x2, y2]| (copy, [x1 + x, y1, x2 + x, y2]))
        })
        .collect();
    let mut base = KnowledgeBase::with_limits(limits);
    let mut class =
        Class::new("LINES", &[]).numbers("drawing", all.iter().map(|(copy, _)| Some(*copy as f64)));
    for (nth, name) in ["x1", "y1", "x2", "y2"].into_iter().enumerate() {
        class = class.numbers(name, all.iter().map(|(_, line)| number(line[nth])));
    }
    base.assert(class)?;
    base.assert(Class::new("DRAWINGS", &[]).numbers("drawing", (0..copies).map(|copy| Some(copy as f64))))?;
    let mut class = Class::new("MEANINGS", &[]).texts("kind", MEANINGS.map(|(kind, _)| Some(kind)));
    class = class.numbers("number", (0..MEANINGS.len()).map(|number| Some(number as f64)));
    for (nth, name) in ["a", "b", "c"].into_iter().enumerate() {
        class = class.texts(name, MEANINGS.map(|(_, labels)| Some(labels[nth])));
    }
    base.assert(class)?;
    base.assert(Class::new("PICTURE", &[]).texts("doing", [Some("edges")]))?;
    Ok(base)
}

/// The label of each edge, by its two points.
pub type Labels = BTreeMap<((i32, i32), (i32, i32)), String>;

/// The labels that the rules gave; edges without one are left out.
pub fn labels(base: &KnowledgeBase) -> Labels {
    let edges = base.len("EDGES").unwrap_or(0);
    let value = |row: usize, property: &str| base.value("EDGES", &(row + 1).to_string(), property);
    let number = |row: usize, property: &str| match value(row, property) {
        Some(Value::Number(number)) => Some(number as i32),
        _ => None,
    };
    let labelled = |row: usize| {
        let from = (number(row, "x")?, number(row, "y")?);
        let to = (from.0 + number(row, "dx")?, from.1 + number(row, "dy")?);
        Some(((from, to), value(row, "label")?.to_string()))
    };
    (0..edges).filter_map(labelled).collect()
}
