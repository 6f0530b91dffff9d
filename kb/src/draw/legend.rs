//! The side panel: the route's runs, the actions, the scale of hardness, the marks.

use super::frame::Block;
use super::layers::Layer;
use super::palette::{BRIDGE, CLOSED, GREY, INK, ROUTE, Scale};
use super::panel::Panel;
use super::scene::{Route, Scene};
use super::sheet::{Sheet, cross, line};
use super::{named, route, text};

/// Runs that are listed with their rooms and doors.
const WITH_PLACES: usize = 12;
/// Runs that are listed at all.
const LISTED: usize = 36;

pub(super) fn legend(panel: &mut Panel, sheet: &Sheet) {
    if let Some(found) = sheet.scene.route.as_ref().filter(|_| sheet.layers.has(Layer::Route)) {
        steps(panel, sheet, found);
    }
    if sheet.layers.has(Layer::Rooms) || !sheet.runs.is_empty() {
        actions(panel, sheet);
    }
    let doors = sheet.layers.has(Layer::Doors) || sheet.layers.has(Layer::Weighted);
    if let Some(scale) = sheet.scale.as_ref().filter(|_| doors && !sheet.view.doors.is_empty()) {
        hardness(panel, scale);
    }
    marks(panel, sheet);
}

fn steps(panel: &mut Panel, sheet: &Sheet, found: &Route) {
    let unit = panel.font / 13.0;
    let indent = 26.0 * unit;
    panel.heading(&format!("{} to {}", found.start.name, found.goal.name), &text::figure(found.cost));
    for (i, run) in sheet.runs.iter().take(LISTED).enumerate() {
        let action = run.action.as_deref();
        let words = format!("{}   {} m", action.unwrap_or("-"), text::figure(run.metres));
        panel.line(indent, &words, &text::figure(run.hardness), |svg, (x, y)| {
            let colour = sheet.palette.colour(action);
            route::badge(svg, (x + 9.0 * unit, y), 8.5 * unit, colour, &(i + 1).to_string());
        });
        if sheet.runs.len() <= WITH_PLACES && !run.places.is_empty() {
            panel.remark(indent, &places(&run.places));
        }
    }
    if sheet.runs.len() > LISTED {
        let more = sheet.runs.len() - LISTED;
        let changes = if more == 1 { "change" } else { "changes" };
        panel.remark(indent, &format!("and {more} more {changes} of action"));
    }
    panel.gap();
}

/// `room f, door 7, room d`; a long list by its ends and what lies between.
fn places(places: &[String]) -> String {
    match places {
        [first, second, .., last] if places.len() > 5 => {
            format!("{first}, {second}, {} more, {last}", places.len() - 3)
        }
        _ => places.join(", "),
    }
}

fn actions(panel: &mut Panel, sheet: &Sheet) {
    if sheet.palette.actions().is_empty() {
        return;
    }
    panel.heading("Actions", "");
    let indent = 44.0 * panel.font / 13.0;
    for action in sheet.palette.actions() {
        let figure = hardness_of(sheet.scene, action).map(|h| format!("{} a metre", text::figure(h)));
        panel.line(indent, action, &figure.unwrap_or_default(), |svg, (x, y)| {
            let (from, to) = ((x, y), (x + indent * 0.8, y));
            let name = Some(action.as_str());
            line(svg, from, to, ROUTE, 5.6, "");
            line(svg, from, to, sheet.palette.colour(name), 3.0, sheet.palette.dash(name));
        });
    }
    for action in sheet.palette.closed() {
        panel.line(indent, action, "", |svg, (x, y)| {
            line(svg, (x, y), (x + indent * 0.8, y), CLOSED, 5.6, "");
        });
    }
    if let Some(state) = &sheet.view.state {
        panel.remark(0.0, &format!("rooms of {state}; of other states those on the route"));
    }
    panel.gap();
}

/// What a metre of the action costs, where all rooms say the same.
fn hardness_of(scene: &Scene, action: &str) -> Option<f64> {
    let mut found = scene.rooms.iter().filter(|r| r.action.as_deref() == Some(action)).map(|r| r.hardness);
    let first = found.next()??;
    found.all(|other| other == Some(first)).then_some(first)
}

fn hardness(panel: &mut Panel, scale: &Scale) {
    panel.heading("Hardness of a door", "");
    let indent = 44.0 * panel.font / 13.0;
    let mut least = scale.least;
    for (class, &limit) in scale.limits.iter().enumerate() {
        let words = if scale.limits.len() == 1 {
            text::figure(limit)
        } else {
            format!("{} to {}", text::figure(least), text::figure(limit))
        };
        panel.line(indent, &words, "", |svg, (x, y)| {
            line(svg, (x, y), (x + indent * 0.8, y), Scale::colour(class), Scale::width(class), "");
        });
        least = limit;
    }
    panel.gap();
}

fn marks(panel: &mut Panel, sheet: &Sheet) {
    let indent = 44.0 * panel.font / 13.0;
    let reach = indent * 0.4;
    let doors =
        sheet.layers.has(Layer::Doors) || sheet.layers.has(Layer::Weighted) || sheet.layers.has(Layer::Graph);
    if doors && sheet.view.doors.iter().any(|&i| !sheet.scene.doors[i].passable) {
        panel.line(indent, "no state passes", "", |svg, (x, y)| {
            line(svg, (x, y), (x + 2.0 * reach, y), CLOSED, 2.0, "3 3");
            cross(svg, (x + reach, y), 5.0);
        });
    }
    if doors && sheet.view.doors.iter().any(|&i| sheet.scene.doors[i].one_way) {
        panel.line(indent, "one way", "", |svg, (x, y)| {
            super::doors::triangle(svg, (x + reach, y), (1.0, 0.0), 6.0, INK);
        });
    }
    if sheet.runs.iter().any(|run| run.changed) {
        panel.line(indent, "change of shape", "", |svg, (x, y)| {
            route::diamond(svg, (x + reach, y), 6.5, "#ffffff");
        });
    }
    if sheet.layers.has(Layer::Map) && !sheet.scene.bridges.is_empty() {
        panel.line(indent, "passage of limited height", "", |svg, (x, y)| {
            svg.element("rect")
                .block(&Block { x, y: y - 6.0, w: 2.0 * reach, h: 12.0 })
                .attr("fill", "url(#bridge)")
                .attr("fill-opacity", "0.55")
                .attr("stroke", BRIDGE)
                .attr("stroke-dasharray", "6 2")
                .end();
        });
    }
    if sheet.layers.has(Layer::Map) {
        named::legend(panel, sheet);
    }
    if sheet.layers.has(Layer::Primes) && sheet.scene.prime_areas.iter().any(|area| area.open == Some(false))
    {
        panel.line(indent, "hard prime area", "", |svg, (x, y)| {
            line(svg, (x, y), (x + 2.0 * reach, y), GREY, 2.0, "8 4");
        });
    }
}
