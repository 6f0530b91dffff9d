//! Draws a floor plan with its regions, doorways and adits for a disc of 0.25 m, and the tight path between its first
//! and its last place: `cargo run -p adit-planners --example floor_plan_svg -- plan.json out.svg`.

use std::fmt::Write as _;
use std::path::Path;

use adit_planners::floor_plan::{Disc, FloorPlan, Network, Rule, read_floor_plan};
use adit_planners::geometry::Point;

const SCALE: f64 = 40.0;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let [plan, out] = arguments.as_slice() else {
        return Err("usage: floor_plan_svg PLAN.json OUT.svg".into());
    };
    let plan = read_floor_plan(Path::new(plan))?;
    let network = Network::new(&plan, Disc { radius: 0.25, margin: 0.0 })?;
    std::fs::write(out, draw(&plan, &network))?;
    Ok(())
}

fn draw(plan: &FloorPlan, network: &Network) -> String {
    let regions = &network.regions;
    let ends = || plan.walls().iter().flatten().chain(plan.solids().iter().flatten());
    let least = ends().fold(Point::new(f64::MAX, f64::MAX), |m, p| Point::new(m.x.min(p.x), m.y.min(p.y)));
    let most = ends().fold(Point::new(f64::MIN, f64::MIN), |m, p| Point::new(m.x.max(p.x), m.y.max(p.y)));
    let at = |p: Point| format!("{:.1},{:.1}", (p.x - least.x + 0.5) * SCALE, (most.y - p.y + 0.5) * SCALE);
    let ring = |corners: &[Point]| corners.iter().map(|&p| at(p)).collect::<Vec<_>>().join(" ");
    let (width, height) = ((most.x - least.x + 1.0) * SCALE, (most.y - least.y + 1.0) * SCALE);
    let mut svg = format!("<svg xmlns='http://www.w3.org/2000/svg' width='{width:.0}' height='{height:.0}'>");
    svg.push_str("<rect width='100%' height='100%' fill='white'/>");
    for (number, region) in regions.regions.iter().enumerate() {
        let hue = number * 137 % 360;
        let corners = ring(&region.outline);
        let _ = write!(svg, "<polygon points='{corners}' fill='hsl({hue},60%,80%)' stroke='none'/>");
    }
    let line = |[a, b]: [Point; 2], style: &str| format!("<polyline points='{} {}' {style}/>", at(a), at(b));
    for doorway in &regions.doorways {
        svg.push_str(&line([doorway.from, doorway.to], "stroke='grey' stroke-dasharray='4 3'"));
    }
    for solid in plan.solids() {
        let _ = write!(svg, "<polygon points='{}' fill='#444'/>", ring(solid));
    }
    for &wall in plan.walls() {
        svg.push_str(&line(wall, "stroke='black' stroke-width='3'"));
    }
    for way in &network.ways {
        let _ = write!(svg, "<polyline points='{}' fill='none' stroke='#aaa'/>", ring(&way.points));
    }
    for adit in &network.adits {
        let _ = write!(svg, "<circle cx='{}' r='4' fill='#06c'/>", at(adit.at).replace(',', "' cy='"));
    }
    if let [first, .., last] = plan.places()
        && let Ok(path) = network.path(first.at, last.at, Rule::Tight, |way| Some(way.length))
    {
        let style = "fill='none' stroke='#c00' stroke-width='4' stroke-linejoin='round'";
        let _ = write!(svg, "<polyline points='{}' {style}/>", ring(&path.points));
    }
    svg.push_str("</svg>");
    svg
}
