//! Lee's Table 2 as the tests steer by it: corrected, and as the paper prints it.

use adit_planners::channels::corridor::{Axis, Extreme, Offset, Part, Steer, StepFacts, Turn};
use adit_planners::geometry::{Point, Rect};

use Extreme::{Max, Min};
use Turn::{Left, Right};

pub const fn plus(part: Part) -> Offset {
    Offset { is_negative: false, part }
}

pub const fn minus(part: Part) -> Offset {
    Offset { is_negative: true, part }
}

pub fn point((x, y): (f64, f64)) -> Point {
    Point::new(x, y)
}

pub fn rect([x0, y0, x1, y1]: [f64; 4]) -> Rect {
    Rect::new(x0, y0, x1, y1)
}

/// Which of the eight rules fires; `None` where the robot is level with the junction, or the next one is.
pub fn rule(facts: &StepFacts) -> Option<u32> {
    let (at, from, to) = (facts.rect.centre(), facts.present, facts.next);
    let (travel, then) = match facts.entering {
        Axis::Y => (at.y - from.y, to.x - at.x),
        Axis::X => (at.x - from.x, to.y - at.y),
    };
    let first = if facts.entering == Axis::Y { 1 } else { 5 };
    (travel != 0.0 && then != 0.0).then(|| first + u32::from(travel < 0.0) + 2 * u32::from(then < 0.0))
}

/// Table 2 as it is right.
pub fn corrected(facts: &StepFacts, gap: f64) -> Result<Steer, String> {
    let rule = rule(facts).ok_or("no rule fires")?;
    let (corner, turn, x, y) = match rule {
        1 => ((Max, Min), Right, minus(Part::Cos), plus(Part::Sin)),
        2 => ((Max, Max), Left, minus(Part::Cos), minus(Part::Sin)),
        3 => ((Min, Min), Left, plus(Part::Cos), plus(Part::Sin)),
        4 => ((Min, Max), Right, plus(Part::Cos), minus(Part::Sin)),
        5 => ((Min, Max), Left, plus(Part::Sin), minus(Part::Cos)),
        6 => ((Max, Max), Right, minus(Part::Sin), minus(Part::Cos)),
        7 => ((Min, Min), Right, plus(Part::Sin), plus(Part::Cos)),
        _ => ((Max, Min), Left, minus(Part::Sin), plus(Part::Cos)),
    };
    let measured_along = facts.entering.across();
    Ok(Steer { rule: Some(rule), corner, turn, gap, arriving: (x, y), measured_along })
}

/// Table 2 with the offsets that the paper prints, by its equations 5.5, slip and all.
pub fn as_printed(facts: &StepFacts, gap: f64) -> Result<Steer, String> {
    let steer = corrected(facts, gap)?;
    let (x, y) = match steer.rule {
        Some(1 | 6) => (minus(Part::Cos), plus(Part::Sin)),
        Some(2 | 5) => (plus(Part::Cos), minus(Part::Cos)),
        Some(3 | 8) => (minus(Part::Cos), minus(Part::Cos)),
        _ => (plus(Part::Cos), plus(Part::Sin)),
    };
    Ok(Steer { arriving: (x, y), ..steer })
}
