//! The floor: walls, rooms and doors, and what rules say of them.

use axum::Json;
use axum::http::header;
use axum::response::{IntoResponse, Response};
use serde::{Deserialize, Serialize};
use utoipa::ToSchema;

use super::extract::{Asked, Site};
use crate::error::{Code, Error};
use crate::graph::{Building, SiteGraph};
use crate::live::View;
use crate::serve::fault::Answered;
use adit_db::door::{Door, DoorKind};
use adit_db::space::{Doorway, Space};
use adit_planners::geometry::Convex;
use adit_planners::read::read_scan;
use adit_planners::world::{Shape, World};

#[derive(Serialize, ToSchema)]
pub struct MapAnswer {
    /// Names this cut of the floor.
    layout: String,
    generation: u64,
    /// The map's edges: x0, y0, x1, y1.
    pub(super) bounds: [f64; 4],
    /// Where `/api/scan` lies, x0, y0, x1, y1; null where the map is no image.
    scan: Option<[f64; 4]>,
    /// Everything solid: polygons as x, y, x, y, …
    pub(super) walls: Vec<Vec<f64>>,
    bridges: Vec<BridgeOf>,
    areas: Vec<AreaOf>,
    named_doors: Vec<NamedDoorOf>,
    places: Vec<PlaceOf>,
    /// The rooms of the building as people see them, the same for all robots.
    spaces: Vec<SpaceOf>,
    /// The openings between spaces.
    doorways: Vec<DoorwayOf>,
    /// The layers of robots' states; none in the paper's modes.
    layers: Vec<LayerOf>,
    /// Rooms, by number.
    pub(super) rooms: Vec<RoomOf>,
    /// Doors, by number.
    pub(super) doors: Vec<DoorOf>,
}

#[derive(Serialize, ToSchema)]
struct BridgeOf {
    rect: [f64; 4],
    height: f64,
}

#[derive(Serialize, ToSchema)]
struct AreaOf {
    name: String,
    kind: Option<String>,
    polygon: Vec<f64>,
}

#[derive(Serialize, ToSchema)]
struct NamedDoorOf {
    name: String,
    from: [f64; 2],
    to: [f64; 2],
}

#[derive(Serialize, ToSchema)]
struct PlaceOf {
    place: String,
    x: f64,
    y: f64,
}

#[derive(Serialize, ToSchema)]
struct SpaceOf {
    space: i64,
    /// Rings of corners as x, y, x, y, …, the outer one first.
    rings: Vec<Vec<f64>>,
    /// Square metres.
    area: f64,
    /// Where it is widest.
    at: [f64; 2],
}

#[derive(Serialize, ToSchema)]
struct DoorwayOf {
    doorway: i64,
    /// The numbers of the spaces that it is between.
    spaces: [i64; 2],
    /// From x0, y0 to x1, y1.
    segment: [f64; 4],
    /// Metres.
    width: f64,
    /// Of the lowest bridge over it, metres; null: unlimited.
    height: Option<f64>,
}

#[derive(Serialize, ToSchema, PartialEq)]
struct LayerOf {
    robot: String,
    state: String,
    /// For bodies longer than wide: which way they lie, degrees.
    facing: Option<f64>,
}

#[derive(Serialize, ToSchema)]
pub(super) struct RoomOf {
    pub(super) room: i64,
    pub(super) name: String,
    /// Index among the layers.
    pub(super) layer: Option<usize>,
    /// The least rectangle about it: x0, y0, x1, y1.
    pub(super) rect: [f64; 4],
    /// Its corners counterclockwise, as x, y, x, y, …; absent where it is that rectangle.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) outline: Option<Vec<f64>>,
    /// Metres; null: unlimited.
    height: Option<f64>,
}

#[derive(Serialize, ToSchema)]
pub(super) struct DoorOf {
    pub(super) door: i64,
    /// door or change (of shape).
    kind: &'static str,
    pub(super) room1: i64,
    room2: i64,
    /// Where it is crossed, from x0, y0 to x1, y1; of a change the least rectangle about its area.
    pub(super) segment: [f64; 4],
    one_way: bool,
}

/// The floor: walls, rooms and doors.
#[utoipa::path(get, path = "/api/map", tag = "map", responses((status = 200, body = MapAnswer)))]
pub async fn map(site: Site) -> Answered<Response> {
    let seen = site.view.load_full();
    site.at_length(move || Ok(Json(MapAnswer::of(&seen.view, true)).into_response())).await
}

/// Doors in their order, those at which a robot changes its shape where `with_changes`.
fn doors(graph: &SiteGraph, with_changes: bool) -> impl Iterator<Item = &Door> {
    graph.doors.iter().filter(move |door| with_changes || is_door(door))
}

fn is_door(door: &Door) -> bool {
    matches!(door.kind, DoorKind::Door)
}

impl MapAnswer {
    /// What is seen, with the doors at which a robot changes its shape or without them.
    pub(super) fn of(view: &View, with_changes: bool) -> Self {
        let (graph, world) = (view.graph(), view.world());
        let (layers, rooms) = rooms(graph);
        let b = view.bounds();
        Self {
            layout: view.layout().to_owned(),
            generation: view.generation(),
            bounds: [b.x0, b.y0, b.x1, b.y1],
            scan: world.occupancy.as_ref().map(|scanned| rect(&scanned.bounds())),
            walls: walls(world),
            bridges: world
                .bridges
                .iter()
                .map(|bridge| BridgeOf { rect: rect(&bridge.rect), height: bridge.height })
                .collect(),
            areas: world
                .areas
                .iter()
                .map(|area| AreaOf {
                    name: area.name.clone(),
                    kind: area.kind.clone(),
                    polygon: corners(&area.shape),
                })
                .collect(),
            named_doors: world
                .named_doors
                .iter()
                .map(|door| NamedDoorOf {
                    name: door.name.clone(),
                    from: [door.from.x, door.from.y],
                    to: [door.to.x, door.to.y],
                })
                .collect(),
            places: view
                .places()
                .map(|place| PlaceOf { place: place.place.clone(), x: place.x, y: place.y })
                .collect(),
            spaces: graph.building.spaces.iter().map(space).collect(),
            doorways: graph.building.doorways.iter().map(doorway).collect(),
            layers,
            rooms,
            doors: doors(graph, with_changes)
                .map(|door| DoorOf {
                    door: door.door,
                    kind: if is_door(door) { "door" } else { "change" },
                    room1: door.side1.room,
                    room2: door.side2.room,
                    segment: door.segment,
                    one_way: door.one_way,
                })
                .collect(),
        }
    }
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Drawn {
    start: Option<String>,
    goal: Option<String>,
    robot: Option<String>,
}

/// A map that is not cut into rooms as a picture, SVG, with the route between two ends where both are said.
#[utoipa::path(get, path = "/api/picture", tag = "map",
    params(("start" = Option<String>, Query, description = "A place or `x,y`"), ("goal" = Option<String>, Query, description = "A place or `x,y`"),
           ("robot" = Option<String>, Query, description = "Whose route; may be left out where there is one robot")),
    responses((status = 200, body = String, content_type = "image/svg+xml")))]
pub async fn picture(site: Site, Asked(asked): Asked<Drawn>) -> Answered<Response> {
    let seen = site.view.load_full();
    let ends = asked.start.zip(asked.goal);
    let svg = site.at_length(move || {
        let ends = ends.as_ref().map(|(start, goal)| (start.as_str(), goal.as_str()));
        seen.view.picture(ends, asked.robot.as_deref())
    });
    let svg = svg.await?;
    Ok(([(header::CONTENT_TYPE, "image/svg+xml")], svg).into_response())
}

/// The longer side of a scan that is sent, pixels.
const SCAN: usize = 4_096;

/// What a scanner saw, where the map is an image: PNG, in grey, from edge to edge of the map, of at most 4,096 pixels a side.
#[utoipa::path(get, path = "/api/scan", tag = "map",
    responses((status = 200, body = Vec<u8>, content_type = "image/png")))]
pub async fn scan(site: Site) -> Answered<Response> {
    let seen = site.view.load_full();
    let png = site.at_length(move || {
        let map = &seen.view.site().site().map;
        let drawn = || Error::said(Code::ServiceUnknown, "the map is drawn: nothing was scanned", None);
        read_scan(map, SCAN).map_err(|errors| Error::all(errors.problems))?.ok_or_else(drawn)
    });
    Ok(([(header::CONTENT_TYPE, "image/png")], png.await?).into_response())
}

fn space(space: &Space) -> SpaceOf {
    let rings: Vec<Vec<[f64; 2]>> = serde_json::from_str(&space.outline).unwrap_or_default();
    let rings = rings.into_iter().map(|ring| ring.into_iter().flatten().collect());
    SpaceOf { space: space.space, rings: rings.collect(), area: space.area, at: [space.x, space.y] }
}

fn doorway(doorway: &Doorway) -> DoorwayOf {
    DoorwayOf {
        doorway: doorway.doorway,
        spaces: [doorway.space1, doorway.space2],
        segment: [doorway.x0, doorway.y0, doorway.x1, doorway.y1],
        width: doorway.width,
        height: doorway.height,
    }
}

fn rooms(graph: &SiteGraph) -> (Vec<LayerOf>, Vec<RoomOf>) {
    let mut layers: Vec<LayerOf> = Vec::new();
    let mut rooms = Vec::with_capacity(graph.rooms.len());
    for (index, room) in graph.graph().room_indices().zip(&graph.rooms) {
        let layer = room.layer.as_ref().map(|(robot, state)| {
            // rooms of a layer come one after the other, so the last is mostly it
            let of = LayerOf { robot: robot.clone(), state: state.clone(), facing: room.facing };
            layers.iter().rposition(|known| *known == of).unwrap_or_else(|| {
                layers.push(of);
                layers.len() - 1
            })
        });
        rooms.push(RoomOf {
            room: room.room,
            name: room.name.clone(),
            layer,
            rect: room.rect,
            outline: outline(graph.outline(index)),
            height: room.height,
        });
    }
    (layers, rooms)
}

/// Everything solid, but what stands beyond the map's edges.
fn walls(world: &World) -> Vec<Vec<f64>> {
    let cells = world.occupancy.iter().flat_map(|cells| cells.rectangles());
    let shapes = world.obstacles.iter().map(|obstacle| corners(&obstacle.shape));
    cells.map(|cell| corners(&Shape::Rect(cell))).chain(shapes).collect()
}

fn corners(shape: &Shape) -> Vec<f64> {
    match shape {
        Shape::Rect(r) => vec![r.x0, r.y0, r.x1, r.y0, r.x1, r.y1, r.x0, r.y1],
        Shape::Polygon(corners) => corners.iter().flat_map(|corner| [corner.x, corner.y]).collect(),
    }
}

fn outline(of: &Convex) -> Option<Vec<f64>> {
    of.rect().is_none().then(|| of.corners().flat_map(|corner| [corner.x, corner.y]).collect())
}

fn rect(r: &adit_planners::geometry::Rect) -> [f64; 4] {
    [r.x0, r.y0, r.x1, r.y1]
}

/// What rules say of rooms and doors, in the order of `/api/map`.
#[derive(Serialize, ToSchema)]
pub struct WeightsAnswer {
    /// The cut of the floor that it is about.
    layout: String,
    generation: u64,
    rooms: Weights,
    doors: Weights,
    spaces: Nouns,
    doorways: Nouns,
    /// What is closed to some robots only, or where no doorway is.
    closings: Vec<ClosingOf>,
}

/// What rules call things of the building, by index.
#[derive(Serialize, ToSchema)]
struct Nouns {
    /// As people call it.
    name: Vec<String>,
    /// Whether nobody passes it; of a space, whether nobody comes in or out.
    closed: Vec<bool>,
    /// The space from which alone nobody passes a doorway; null: it is the same both ways.
    closed_from: Vec<Option<String>>,
}

#[derive(Serialize, ToSchema)]
struct ClosingOf {
    /// From x0, y0 to x1, y1.
    segment: [f64; 4],
    /// In a sentence, with the number of the fact that tells it.
    why: String,
}

/// Values by index; null: unknown.
#[derive(Serialize, ToSchema)]
struct Weights {
    /// Hardness; of rooms by the metre.
    hardness: Vec<Option<f64>>,
    /// What to do.
    action: Vec<Option<String>>,
    /// Whether it is passed.
    passable: Vec<Option<bool>>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Weighed {
    changes: Option<bool>,
}

/// What rules say of rooms and doors, in the order of `/api/map`.
#[utoipa::path(get, path = "/api/weights", tag = "map",
    params(("changes" = Option<bool>, Query, description = "false: without the doors at which a robot changes its shape, as `/api/floor` has them")),
    responses((status = 200, body = WeightsAnswer)))]
pub async fn weights(site: Site, Asked(asked): Asked<Weighed>) -> Json<WeightsAnswer> {
    let seen = site.view.load();
    let graph = seen.view.graph();
    let (rooms, building) = (&graph.rooms, &graph.building);
    let doors: Vec<&Door> = doors(graph, asked.changes != Some(false)).collect();
    Json(WeightsAnswer {
        layout: seen.view.layout().to_owned(),
        generation: seen.view.generation(),
        rooms: Weights {
            hardness: rooms.iter().map(|room| room.hardness.value).collect(),
            action: rooms.iter().map(|room| room.action.value.clone()).collect(),
            passable: rooms.iter().map(|room| room.passable.value).collect(),
        },
        doors: Weights {
            hardness: doors.iter().map(|door| door.hardness.value).collect(),
            action: doors.iter().map(|door| door.action.value.clone()).collect(),
            passable: doors.iter().map(|door| door.passable.value).collect(),
        },
        spaces: Nouns {
            name: building.spaces.iter().filter_map(|space| building.space(space.space)).collect(),
            closed: building.spaces.iter().map(|space| space.closed == Some(true)).collect(),
            closed_from: vec![None; building.spaces.len()],
        },
        doorways: Nouns {
            name: building.doorways.iter().map(Building::name).collect(),
            closed: building.doorways.iter().map(|doorway| doorway.closed == Some(true)).collect(),
            closed_from: building.doorways.iter().map(|doorway| doorway.closed_from.clone()).collect(),
        },
        closings: building
            .lines
            .iter()
            .map(|line| ClosingOf { segment: line.segment, why: building.why_told_closed(line) })
            .collect(),
    })
}
