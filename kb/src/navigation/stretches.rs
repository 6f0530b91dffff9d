//! A path over a floor plan as rows: its stretches through regions and doorways, and where it bends.

use std::collections::BTreeMap;
use std::sync::Arc;

use adit_db::route::{Step, Waypoint};
use adit_planners::floor_plan::clear::wall_distance;
use adit_planners::floor_plan::{Network, Path, Spot};
use adit_planners::geometry::{Point, Segment};

/// What rules say of a way.
pub struct OfWay {
    pub weight: f64,
    /// Metres.
    pub length: f64,
    pub action: Option<Arc<str>>,
    pub rule: Option<String>,
}

/// Two ends of a way, in their order.
pub fn sorted(one: Spot, other: Spot) -> (Spot, Spot) {
    if one <= other { (one, other) } else { (other, one) }
}

/// A path as rows: a step for each region and each doorway that it passes, a waypoint where it bends. A step weighs its
/// metres, and what rules say of the way besides.
pub fn rows(
    network: &Network,
    barriers: &[[Point; 2]],
    path: &Path,
    said: &BTreeMap<(Spot, Spot), OfWay>,
) -> (Vec<Step>, Vec<Waypoint>) {
    let mut points = Vec::new();
    let mut distance = 0.0;
    for (place, at) in path.points.iter().enumerate() {
        let from = place.checked_sub(1).map(|before| path.points[before]);
        distance += from.map_or(0.0, |from| from.distance(*at));
        points.push(Waypoint {
            waypoint: place as i64 + 1,
            x: at.x,
            y: at.y,
            heading: from.and_then(|from| heading(from, *at)),
            clearance: from.map(|from| wall_distance(&[from, *at], barriers) - network.disc.radius),
            distance: Some(distance),
            cost: distance,
            ..Waypoint::default()
        });
    }
    let (mut steps, mut cost): (Vec<Step>, f64) = (Vec::new(), 0.0);
    let mut push =
        |kind: &str, place: String, (ends, metres): ((Spot, Spot), f64), [from, to]: [Point; 2]| {
            let of_way = said.get(&ends);
            // what is more than its metres is kept whole when a way is pulled tight, what is less goes with them
            let hardness = of_way.map_or(metres, |of_way| {
                let more = of_way.weight - of_way.length;
                if more >= 0.0 { metres + more } else { metres * of_way.weight / of_way.length }
            });
            cost += hardness;
            steps.push(Step {
                step: steps.len() as i64 + 1,
                kind: kind.to_owned(),
                place,
                action: of_way.and_then(|of_way| of_way.action.as_deref()).map(str::to_owned),
                hardness: Some(hardness),
                cost,
                x: Some(to.x),
                y: Some(to.y),
                heading: heading(from, to),
                rule: of_way.and_then(|of_way| of_way.rule.clone()),
                ..Step::default()
            });
        };
    // where the path crosses each doorway: how far along, and the point
    let mut rest = path.points.clone();
    let mut last = Spot::Start;
    let (mut so_far, mut along) = (0.0, Vec::new());
    for pair in path.adits.windows(2) {
        let (here, there) = (&network.adits[pair[0]], &network.adits[pair[1]]);
        if here.doorway != there.doorway || here.twin != pair[1] {
            continue;
        }
        let doorway = &network.regions.doorways[here.doorway];
        let (metres, at, after) = split(&rest, Segment::new(doorway.from, doorway.to));
        let [one, other] = [pair[0], pair[1]].map(Spot::Adit);
        so_far += metres;
        along.extend([so_far, so_far]);
        push("region", format!("region {}", here.region), (sorted(last, one), metres), at);
        push("doorway", format!("doorway {}", here.doorway), (sorted(one, other), 0.0), at);
        (rest, last) = (after, Spot::Adit(pair[1]));
    }
    let to = *rest.last().unwrap_or(&rest[0]);
    let from = rest.iter().rev().nth(1).copied().unwrap_or(to);
    let metres: f64 = rest.windows(2).map(|pair| pair[0].distance(pair[1])).sum();
    let region =
        network.region_of(to).map_or("the goal's region".to_owned(), |region| format!("region {region}"));
    along.push(so_far + metres);
    push("region", region, (sorted(last, Spot::Goal), metres), [from, to]);
    weigh_points(&mut points, &steps, &along);
    (steps, points)
}

/// What a way costs up to each point: evenly along each step, which ends so many metres `along` it.
fn weigh_points(points: &mut [Waypoint], steps: &[Step], along: &[f64]) {
    for point in points {
        let at = point.distance.unwrap_or_default();
        let step = along.iter().position(|end| at <= *end + 1e-9).unwrap_or(steps.len().saturating_sub(1));
        let (begin, before) = match step.checked_sub(1) {
            Some(before) => (along[before], steps[before].cost),
            None => (0.0, 0.0),
        };
        let (end, cost) = (along[step], steps[step].cost);
        let share = if end > begin { ((at - begin) / (end - begin)).clamp(0.0, 1.0) } else { 1.0 };
        point.cost = before + share * (cost - before);
    }
}

/// A polyline up to where it first crosses a segment: the metres, the corner before that point with it, and the rest from
/// there.
fn split(points: &[Point], across: Segment) -> (f64, [Point; 2], Vec<Point>) {
    let mut metres = 0.0;
    for (place, pair) in points.windows(2).enumerate() {
        let leg = Segment::new(pair[0], pair[1]);
        if let Some(at) = leg.crossing(&across) {
            let rest = [&[at], &points[place + 1..]].concat();
            return (metres + pair[0].distance(at), [pair[0], at], rest);
        }
        metres += leg.length();
    }
    let last = *points.last().unwrap_or(&points[0]);
    (metres, [last, last], vec![last])
}

fn heading(from: Point, to: Point) -> Option<f64> {
    (from.distance(to) > 0.0).then(|| (to.y - from.y).atan2(to.x - from.x).to_degrees())
}
