//! What a robot's plan is answered with, as JSON and as text.

use adit_db::plan::{Channel, Corner, Junction, PathStep, Plan};
use adit_planners::channels::corridor::{Primitive, TurnMade};
use adit_planners::geometry::{Point, Rect};
use serde_json::{Value, json};

use super::corridor::{Corridor, Driven};
use super::said::Answer;
use crate::words::number::number;

impl Answer<Driven> {
    /// As JSON; headings in degrees, counter-clockwise from the x axis.
    pub fn json(&self, explained: bool) -> Value {
        self.as_json(explained, json_of)
    }

    pub fn lines(&self, explained: bool) -> Vec<String> {
        self.as_lines(explained, lines_of)
    }

    pub fn record(&self, plan: &str, rules: &str, world: &Corridor) -> Plan {
        let corridors = &world.corridors;
        let mut record = Plan {
            plan: plan.to_owned(),
            kind: "corridor".to_owned(),
            rules: rules.to_owned(),
            ..Plan::default()
        };
        for (number, rect) in (1..).zip(corridors.channels()) {
            let axis = corridors.axis(number).map_or_else(String::new, |axis| axis.to_string());
            record.channels.push(Channel { axis, extent: extent(rect) });
        }
        let drive = self.path.as_ref().ok().map(|driven| &driven.drive);
        for (number, junction) in (1..).zip(corridors.junctions()) {
            let mut channels = [junction.lying as i64, junction.upright as i64];
            channels.sort_unstable();
            record.junctions.push(Junction { channels, extent: extent(&junction.rect) });
            let turned: Vec<Point> = drive
                .iter()
                .flat_map(|drive| &drive.turns)
                .filter(|turn| turn.facts.junction == number)
                .map(|turn| turn.corner)
                .collect();
            record.corners.extend(corners(&junction.rect).map(|(corner, point)| Corner {
                junction: number as i64,
                corner: corner.to_owned(),
                at: at(point),
                turned: turned.contains(&point),
            }));
        }
        self.add_to(&mut record, |driven| (driven.drive.length, driven.drive.min_clearance, steps(driven)));
        record
    }
}

fn json_of(driven: &Driven) -> Value {
    let turn_of = |junction: usize| driven.drive.turns.iter().find(|turn| turn.facts.junction == junction);
    let primitives: Vec<Value> = driven
            .drive
            .primitives
            .iter()
            .map(|primitive| match *primitive {
                Primitive::Line { a, b, from_heading, to_heading, clearance } => json!({
                    "kind": "line", "a": at(a), "b": at(b), "from_heading": from_heading.to_degrees(),
                    "heading": to_heading.to_degrees(), "clearance": clearance,
                }),
                Primitive::Arc { junction, centre, radius, turn, a, b, from_heading, to_heading, clearance } => json!({
                    "kind": "arc", "centre": at(centre), "radius": radius, "turn": turn.name(), "a": at(a), "b": at(b),
                    "junction": junction, "rule": turn_of(junction).and_then(|turn| turn.steer.rule),
                    "from_heading": from_heading.to_degrees(), "heading": to_heading.to_degrees(),
                    "clearance": clearance,
                }),
            })
            .collect();
    let turns: Vec<Value> = driven.drive.turns.iter().map(turn).collect();
    json!({
        "status": "ok",
        "primitives": primitives,
        "length": driven.drive.length,
        "min_clearance": driven.drive.min_clearance,
        "turns": turns,
        "channels": driven.channels,
        "weight": driven.weight,
        "remarks": driven.remarks,
    })
}

fn lines_of(driven: &Driven) -> Vec<String> {
    let mut lines = Vec::new();
    let channels: Vec<String> = driven.channels.iter().map(ToString::to_string).collect();
    lines.push(format!("through channels {}", channels.join(", ")));
    lines.extend(driven.drive.primitives.iter().map(|primitive| text(primitive, &driven.drive.turns)));
    lines.push(format!(
        "length {}, least clearance {}",
        number(driven.drive.length),
        number(driven.drive.min_clearance)
    ));
    lines.extend(driven.remarks.iter().map(|remark| format!("note: {remark}")));

    lines
}

fn turn(turn: &TurnMade) -> Value {
    json!({
        "junction": turn.facts.junction,
        "rule": turn.steer.rule,
        "corner": at(turn.corner),
        "turn": turn.steer.turn.name(),
        "gap": turn.steer.gap,
        "safest": turn.facts.safest,
        "theta": turn.theta.to_degrees(),
        "arriving": at(turn.arriving),
        "leaving": at(turn.leaving),
    })
}

fn text(primitive: &Primitive, turns: &[TurnMade]) -> String {
    match *primitive {
        Primitive::Line { b, to_heading, clearance, .. } => format!(
            "  line to {}, heading {} (clearance {})",
            point(b),
            number(to_heading.to_degrees()),
            number(clearance)
        ),
        Primitive::Arc { junction, centre, radius, turn, b, clearance, .. } => {
            let rule = turns.iter().find(|turn| turn.facts.junction == junction);
            let rule =
                rule.and_then(|turn| turn.steer.rule).map_or(String::new(), |rule| format!(", rule {rule}"));
            format!(
                "  {turn} round {} to {} (junction {junction}{rule}; radius {}, clearance {})",
                point(centre),
                point(b),
                number(radius),
                number(clearance)
            )
        }
    }
}

fn steps(driven: &Driven) -> Vec<PathStep> {
    let mut steps = Vec::new();
    for primitive in &driven.drive.primitives {
        let (kind, junction, a, b, circle, turn, headings) = match *primitive {
            Primitive::Line { a, b, from_heading, to_heading, .. } => {
                ("line", None, a, b, None, None, (from_heading, to_heading))
            }
            Primitive::Arc { junction, centre, radius, turn, a, b, from_heading, to_heading, .. } => {
                let circle = Some((at(centre), radius));
                ("arc", Some(junction), a, b, circle, Some(turn.name()), (from_heading, to_heading))
            }
        };
        let rule = driven.drive.turns.iter().find(|turn| Some(turn.facts.junction) == junction);
        let clearance = primitive.clearance();
        let step = PathStep {
            kind,
            state: None,
            junction: junction.map(|junction| junction as i64),
            rule: rule.and_then(|turn| turn.steer.rule).map(f64::from),
            at: [Some(b.x), Some(b.y), None],
            circle,
            turn,
            heading: Some(headings.1.to_degrees()),
            length: primitive.length(),
            clearance,
        };
        if steps.is_empty() {
            steps.push(PathStep {
                kind: "start",
                at: [Some(a.x), Some(a.y), None],
                heading: Some(headings.0.to_degrees()),
                length: 0.0,
                ..step.clone()
            });
        }
        steps.push(step);
    }
    steps
}

fn corners(rect: &Rect) -> [(&'static str, Point); 4] {
    [
        ("min,min", Point::new(rect.x0, rect.y0)),
        ("min,max", Point::new(rect.x0, rect.y1)),
        ("max,min", Point::new(rect.x1, rect.y0)),
        ("max,max", Point::new(rect.x1, rect.y1)),
    ]
}

const fn extent(rect: &Rect) -> [Option<f64>; 6] {
    [Some(rect.x0), Some(rect.y0), None, Some(rect.x1), Some(rect.y1), None]
}

const fn at(point: Point) -> [f64; 2] {
    [point.x, point.y]
}

fn point(point: Point) -> String {
    format!("({}, {})", number(point.x), number(point.y))
}
