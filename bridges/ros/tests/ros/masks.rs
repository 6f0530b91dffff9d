//! Grids: the site's map, and keepout masks both ways.

use adit_tests::within;
use serde_json::{Value, json};

use crate::floor::{Client, Floor, is_outside, points, pose};

const GRID: &str = "nav_msgs/msg/OccupancyGrid";

/// A mask of ten-centimetre cells over the middle of the clinic, from 30,5 on, full in a rectangle.
fn mask(full: Option<[usize; 4]>) -> Value {
    let (width, height) = (60, 80);
    let is_full = |x: usize, y: usize| {
        full.is_some_and(|[x0, y0, x1, y1]| (x0..x1).contains(&x) && (y0..y1).contains(&y))
    };
    let data: Vec<i8> =
        (0..width * height).map(|cell| if is_full(cell % width, cell / width) { 100 } else { 0 }).collect();
    json!({"header": {"frame_id": "map"}, "data": data,
        "info": {"resolution": 0.1, "width": width, "height": height, "origin": {"position": {"x": 30.0, "y": 5.0}, "orientation": {"w": 1.0}}}})
}

/// How many cells of a grid that came have this value, as the client writes it.
fn count(message: &Value, value: i64) -> u64 {
    let runs = message["data"].as_array().unwrap();
    runs.iter().filter(|run| run[0] == value).map(|run| run[1].as_u64().unwrap()).sum()
}

#[test]
fn a_keepout_mask_closes_a_doorway_until_it_is_another_one() {
    if is_outside("masks::a_keepout_mask_closes_a_doorway_until_it_is_another_one") {
        return;
    }
    let floor = Floor::start("clinic", &[]);
    let mut client = Client::start("masks");
    client.latched("hear", "/adit/keepout_mask", GRID, &json!({}));
    let first = client.until("a mask", |said| said["topic"] == "/adit/keepout_mask");
    assert_eq!(count(&first["message"], 100), 0);

    let request = json!({"start": pose(4.7, 1.5), "goal": pose(53.8, 14.0)});
    let before = points(&client.plan(&request));
    assert!(before.iter().any(|[x, y]| (33.0..33.4).contains(x) && (8.6..9.5).contains(y)), "{before:?}");

    // doorway 18 is from 33.2,8.7 to 33.2,9.4
    client.latched("publish", "/keepout_filter_mask", GRID, &mask(Some([30, 36, 34, 45])));
    floor.says("the keepout mask is 1 areas of the site: 1 new, 0 taken back");
    let round = points(&client.plan(&request));
    assert!(!round.is_empty());
    assert!(round.iter().all(|[x, y]| !((33.0..33.4).contains(x) && (8.6..9.5).contains(y))), "{round:?}");

    // what is not to be entered is published, whoever said so: 0.4 by 0.9 metres in cells of five centimetres
    let said = client.until("a mask", |said| said["topic"] == "/adit/keepout_mask");
    assert_eq!(count(&said["message"], 100), 8 * 18);

    // the next mask no longer has it
    client.latched("publish", "/keepout_filter_mask", GRID, &mask(None));
    floor.says("the keepout mask is 0 areas of the site: 0 new, 1 taken back");
    assert_eq!(points(&client.plan(&request)), before);
    let areas = floor.service.ask("GET", "/api/areas", None).1;
    assert_eq!(areas["laid"], json!([]));
}

#[test]
fn who_comes_late_hears_the_map_all_the_same() {
    if is_outside("masks::who_comes_late_hears_the_map_all_the_same") {
        return;
    }
    let floor = Floor::start("clinic", &["--resolution", "0.1"]);
    within("the map is there", || floor.service.ask("GET", "/api/map", None).1["walls"].as_array().cloned());
    std::thread::sleep(std::time::Duration::from_secs(2));
    let mut client = Client::start("late");
    client.latched("hear", "/map", GRID, &json!({}));
    let map = client.until("the map", |said| said["topic"] == "/map")["message"].clone();
    assert_eq!([&map["info"]["width"], &map["info"]["height"]], [600, 400]);
    let answer = floor.service.ask("GET", "/api/map", None).1;
    let area = |wall: &Value| {
        let flat: Vec<f64> = wall.as_array().unwrap().iter().map(|v| v.as_f64().unwrap()).collect();
        let at: Vec<&[f64]> = flat.chunks(2).collect();
        let sides = at.iter().zip(at.iter().cycle().skip(1));
        sides.map(|(a, b)| a[0] * b[1] - b[0] * a[1]).sum::<f64>().abs() / 2.0
    };
    let walls: f64 = answer["walls"].as_array().unwrap().iter().map(area).sum();
    let drawn = count(&map, 100) as f64 * 0.01;
    assert!((drawn - walls).abs() < 0.02 * walls, "{drawn} m² are drawn of {walls} m² of walls");
}
