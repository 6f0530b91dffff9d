//! A floor plan: its regions, the doorways between them, the adits on either side, places, and a path.

use adit_planners::floor_plan::{FloorPlan, Network, Path};
use adit_planners::geometry::{Point, Rect};

use super::frame::{At, Block, Frame};
use super::labels::{Face, Labels};
use super::palette::{BRIDGE, CLOSED, GREY, INK, ROUTE};
use super::sheet::{line, metres};
use super::svg::{self, Svg};
use super::{MARGIN, page, text};

const LONGEST: f64 = 900.0;
/// Above the plan, for its title; and below, for what signs mean.
const TITLE: f64 = 34.0;
const BELOW: f64 = 34.0;
/// Neighbours differ in these.
const TINTS: [&str; 6] = ["#dce9f5", "#fbeed5", "#e2f0dd", "#f6e0e0", "#e8e3f3", "#e4efee"];

/// The floor plan with the network of a robot, the doorways that are closed, and the path, as a standalone SVG text.
pub fn render_floor(
    title: &str,
    plan: &FloorPlan,
    network: &Network,
    is_closed: impl Fn(usize) -> bool,
    path: Option<&Path>,
) -> String {
    let frame = Frame::new(bounds(network), LONGEST, MARGIN, MARGIN + TITLE);
    let mut svg = Svg::default();
    let mut labels = Labels::default();
    svg.group("regions", |svg| regions(svg, &frame, network));
    svg.group("solids", |svg| solids(svg, &frame, plan));
    svg.group("doorways", |svg| {
        for (number, doorway) in network.regions.doorways.iter().enumerate() {
            let (colour, width, dashes) =
                if is_closed(number) { (CLOSED, 6.0, "") } else { (BRIDGE, 2.0, "5 3") };
            line(svg, frame.at(doorway.from), frame.at(doorway.to), colour, width, dashes);
        }
    });
    svg.group("walls", |svg| {
        for [a, b] in plan.walls() {
            line(svg, frame.at(*a), frame.at(*b), INK, 2.4, "");
        }
    });
    svg.group("adits", |svg| {
        for (number, adit) in network.adits.iter().enumerate() {
            if number < adit.twin {
                line(svg, frame.at(adit.at), frame.at(network.adits[adit.twin].at), GREY, 1.0, "");
            }
        }
        for adit in &network.adits {
            dot(svg, frame.at(adit.at), 3.2, GREY, "#ffffff");
        }
    });
    if let Some(path) = path {
        svg.group("path", |svg| way(svg, &frame, path));
    }
    svg.group("places", |svg| places(svg, &frame, plan, path, &mut labels));
    numbers(&frame, network, &mut labels);
    svg.append(&labels.finish());
    let (right, below) = (frame.map.x + frame.map.w + MARGIN, frame.map.y + frame.map.h);
    let right = right.max(text::width(LEGEND, 13.0) + 2.0 * MARGIN);
    page(title, (right, below + BELOW), |page| {
        page.words((MARGIN, MARGIN + 14.0), 18.0, INK, &text::fit(title, 18.0, right - 2.0 * MARGIN));
        page.append(&svg);
        metres(page, &frame);
        page.words((MARGIN, below + 22.0), 13.0, GREY, LEGEND);
    })
}

/// Smaller regions have no number in the picture.
const LEAST: f64 = 700.0;

const LEGEND: &str = "grey numbers: regions; brown dashes and numbers: doorways (closed: a thick grey line); rings: adits, joined to their twins; dots: places; thick line: the path";

/// Of the free space: what is solid may reach far beyond it.
fn bounds(network: &Network) -> Rect {
    let ends = network.regions.regions.iter().flat_map(|region| &region.outline);
    Rect::around(ends.copied())
}

/// Cut off where nothing is free any more.
fn solids(svg: &mut Svg, frame: &Frame, plan: &FloorPlan) {
    if plan.solids().is_empty() {
        return;
    }
    svg.element("clipPath").attr("id", "within").children(|svg| {
        svg.element("rect").block(&frame.map).end();
    });
    svg.element("g").attr("clip-path", "url(#within)").children(|svg| {
        for solid in plan.solids() {
            area(svg, frame, solid, CLOSED, ("", 0.0));
        }
    });
}

fn regions(svg: &mut Svg, frame: &Frame, network: &Network) {
    let mut tints: Vec<usize> = Vec::new();
    for (number, region) in network.regions.regions.iter().enumerate() {
        let beside = network.regions.doorways.iter().filter_map(|doorway| match doorway.regions {
            [a, b] if a == number => tints.get(b),
            [a, b] if b == number => tints.get(a),
            _ => None,
        });
        let taken: Vec<usize> = beside.copied().collect();
        let begin = number % TINTS.len();
        let order = (0..TINTS.len()).map(|step| (begin + step) % TINTS.len());
        let tint = order.clone().find(|tint| !taken.contains(tint)).unwrap_or(begin);
        tints.push(tint);
        area(svg, frame, &region.outline, TINTS[tint], ("#ffffff", 1.0));
    }
}

fn area(svg: &mut Svg, frame: &Frame, corners: &[Point], fill: &str, (stroke, width): (&str, f64)) {
    let mut path = String::new();
    svg::through(&mut path, corners.iter().map(|corner| frame.at(*corner)));
    path.push('Z');
    let element = svg.element("path").attr("d", &path).attr("fill", fill);
    if stroke.is_empty() {
        element.end();
    } else {
        element.attr("stroke", stroke).num("stroke-width", width).end();
    }
}

fn way(svg: &mut Svg, frame: &Frame, path: &Path) {
    let points: Vec<String> = path
        .points
        .iter()
        .map(|point| {
            let (x, y) = frame.at(*point);
            format!("{},{}", svg::number(x), svg::number(y))
        })
        .collect();
    svg.element("polyline")
        .attr("points", &points.join(" "))
        .attr("fill", "none")
        .attr("stroke", ROUTE)
        .attr("stroke-linejoin", "round")
        .num("stroke-width", 4.0)
        .end();
    if let [first, .., last] = path.points.as_slice() {
        dot(svg, frame.at(*first), 6.0, ROUTE, "#ffffff");
        dot(svg, frame.at(*last), 6.0, ROUTE, ROUTE);
    }
}

fn places(svg: &mut Svg, frame: &Frame, plan: &FloorPlan, path: Option<&Path>, labels: &mut Labels) {
    let steps = path.map_or(&[][..], |path| &path.points);
    for pair in steps.windows(2) {
        labels.take_line(frame.at(pair[0]), frame.at(pair[1]), 8.0, 8.0);
    }
    let face = Face { size: 14.0, colour: INK, strong: true, chip: false };
    for place in plan.places() {
        let (x, y) = frame.at(place.at);
        dot(svg, (x, y), 3.5, INK, INK);
        labels.take(Block::about(x, y, 8.0, 8.0));
        let half = text::width(&place.name, face.size) / 2.0 + 10.0;
        let about = [(x, y - 14.0), (x, y + 14.0), (x + half, y), (x - half, y)];
        labels.place(&place.name, face, &frame.map, about);
    }
}

/// The numbers of doorways and regions, by which people and rules know them.
fn numbers(frame: &Frame, network: &Network, labels: &mut Labels) {
    let face = Face { size: 12.0, colour: GREY, strong: false, chip: false };
    for adit in &network.adits {
        let (x, y) = frame.at(adit.at);
        labels.take(Block::about(x, y, 9.0, 9.0));
    }
    let of_doorways = Face { size: 11.0, colour: BRIDGE, strong: true, chip: false };
    for (number, doorway) in network.regions.doorways.iter().enumerate() {
        let (x, y) = frame.at(doorway.middle());
        let about = [
            (x + 11.0, y - 9.0),
            (x - 11.0, y + 9.0),
            (x - 11.0, y - 9.0),
            (x + 11.0, y + 9.0),
            (x, y - 18.0),
        ];
        labels.place(&number.to_string(), of_doorways, &frame.map, about);
    }
    let is_large = |area: f64| area * frame.scale * frame.scale > LEAST;
    let regions = network.regions.regions.iter().enumerate();
    for (number, region) in regions.filter(|(_, region)| is_large(region.area)) {
        let count = region.outline.len().max(1) as f64;
        let sum = region.outline.iter().fold((0.0, 0.0), |(x, y), p| (x + p.x, y + p.y));
        let (x, y) = frame.at(Point::new(sum.0 / count, sum.1 / count));
        let about = [(x, y), (x, y - 16.0), (x, y + 16.0), (x - 20.0, y), (x + 20.0, y)];
        labels.place(&number.to_string(), face, &frame.map, about);
    }
}

fn dot(svg: &mut Svg, (x, y): At, radius: f64, stroke: &str, fill: &str) {
    svg.element("circle")
        .nums([("cx", x), ("cy", y), ("r", radius), ("stroke-width", 1.6)])
        .attr("stroke", stroke)
        .attr("fill", fill)
        .end();
}
