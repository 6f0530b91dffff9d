//! What robots report to be blocked, and what people lay over the map, is in the next answer.

use adit_tests::TestSite;
use adit_tests::service::Service;
use serde_json::{Value, json};

fn route(service: &Service, robot: &str, ends: [&str; 2]) -> Value {
    let [start, goal] = ends;
    service.ask("GET", &format!("/api/route?start={start}&goal={goal}&robot={robot}"), None).1
}

#[test]
fn a_robot_that_is_blocked_is_sent_elsewhere_and_others_are_not() {
    let site = TestSite::example("depot").built();
    let service = Service::start(&site);
    let robots = site.sqlite3("SELECT DISTINCT robot FROM robots ORDER BY robot");
    let places = site.sqlite3("SELECT place FROM places ORDER BY place");
    let ends = [places[0].as_str(), places[1].as_str()];
    let all = || robots.iter().map(|robot| route(&service, robot, ends)).collect::<Vec<_>>();
    let before = all();
    let points = before[0]["waypoints"].as_array().unwrap();
    let at = |point: &Value| [point["x"].as_f64().unwrap(), point["y"].as_f64().unwrap()];
    let ([x, y], [u, v]) = (at(&points[0]), at(&points[1]));
    let heading = (v - y).atan2(u - x).to_degrees();
    let (x, y) = (x.midpoint(u), y.midpoint(v));
    let blocked = json!({"x": x, "y": y, "heading": heading, "only": [robots[0]], "for_seconds": 3600, "why": "a crate"});
    let (status, edited) = service.ask("POST", "/api/blocked", Some(&blocked));
    assert_eq!(status, 200, "{edited}");
    let after = all();
    assert_ne!(after[0]["waypoints"], before[0]["waypoints"]);
    for (after, before) in after[1..].iter().zip(&before[1..]) {
        assert_eq!((&after["cost"], &after["waypoints"]), (&before["cost"], &before["waypoints"]));
    }
    let mut unknown = blocked;
    unknown["only"] = json!(["nobody"]);
    let (status, refused) = service.ask("POST", "/api/blocked", Some(&unknown));
    assert_eq!((status, &refused["error"]["code"]), (404, &json!("tell/unknown-object")), "{refused}");
}

#[test]
fn what_is_laid_over_the_map_is_in_the_next_route_and_on_the_map_until_it_is_lifted() {
    let files = "map = \"map.toml\"\nrobots = \"robots.toml\"\n";
    let site = TestSite::example("starter").with("site.toml", files).built();
    let service = Service::start(&site);
    let cost = || route(&service, "robot", ["home", "window"])["cost"].clone();
    let areas = || service.ask("GET", "/api/map", None).1["areas"].as_array().unwrap().len();
    let (free, known) = (cost(), areas());
    let area = json!({"name": "wet floor", "corners": [[6.5, 0.1], [9, 0.1], [9, 7.9], [6.5, 7.9]],
        "properties": {"kind": "wet", "hardness_factor": 3}, "for_seconds": 3600, "why": "rain"});
    let (status, edited) = service.ask("POST", "/api/areas", Some(&area));
    assert_eq!(status, 200, "{edited}");
    assert!(cost().as_f64() > free.as_f64());
    assert_eq!(areas(), known + 1);
    let laid = &service.ask("GET", "/api/areas", None).1["laid"][0];
    assert_eq!(
        (&laid["name"], &laid["kind"], &laid["why"]),
        (&json!("wet floor"), &json!("wet"), &json!("rain"))
    );
    assert_eq!(laid["corners"][1], json!([9.0, 0.1]));
    let (status, refused) = service.ask("POST", "/api/areas", Some(&area));
    assert_eq!((status, &refused["error"]["code"]), (409, &json!("laid/taken")), "{refused}");
    let shelf =
        json!({"kind": "lay", "what": "obstacle", "name": "shelf", "corners": [[6.2, 2.5], [6.4, 4.5]]});
    let preview = service
        .ask("POST", "/api/preview", Some(&json!({"edits": [shelf], "start": "home", "goal": "window"})))
        .1;
    assert_eq!(preview["route"]["cost"], Value::Null, "{preview}");
    assert_eq!(service.ask("DELETE", "/api/areas/wet%20floor?why=dry", None).0, 200);
    assert_eq!((cost(), areas()), (free, known));
    assert_eq!(service.ask("DELETE", "/api/areas/wet%20floor", None).0, 404);
}

#[test]
fn what_has_ended_by_itself_gives_its_name_free() {
    let files = "map = \"map.toml\"\nrobots = \"robots.toml\"\n";
    let site = TestSite::example("starter").with("site.toml", files).built();
    let service = Service::start(&site);
    let pallets = |seconds: u32, left: f64| {
        let corners = json!([[left, 0.5], [left + 0.5, 1.0]]);
        let pallets =
            json!({"name": "pallets", "what": "obstacle", "corners": corners, "for_seconds": seconds});
        service.ask("POST", "/api/areas", Some(&pallets))
    };
    assert_eq!(pallets(1, 7.0).0, 200);
    std::thread::sleep(std::time::Duration::from_millis(1_100));
    let (status, again) = pallets(3_600, 8.0);
    assert_eq!(status, 200, "{again}");
    let (status, refused) = pallets(3_600, 8.0);
    assert_eq!((status, &refused["error"]["code"]), (409, &json!("laid/taken")), "{refused}");
    assert_eq!(site.sqlite3("SELECT json_extract(outline, '$[0][0]') FROM laid"), ["8.0"]);
    let (status, undone) = service.ask("POST", "/api/edits", Some(&json!({"edit": {"kind": "undo"}})));
    assert_eq!(status, 200, "{undone}");
    assert_eq!(site.sqlite3("SELECT json_extract(outline, '$[0][0]') FROM laid"), ["7.0"]);
}

#[test]
fn what_stands_against_an_edit_is_said() {
    let files = "map = \"map.toml\"\nrobots = \"robots.toml\"\n";
    let site = TestSite::example("starter").with("site.toml", files).built();
    let service = Service::start(&site);
    let said = |edit: &Value| {
        let (status, edited) = service.ask("POST", "/api/edits", Some(&json!({ "edit": edit })));
        assert_eq!(status, 200, "{edited}");
        edited["remarks"].clone()
    };
    let close = |seconds: u32| json!({"kind": "close", "what": "doorway 1", "for_seconds": seconds});
    assert_eq!(said(&close(7200)), json!([]));
    let shorter = said(&close(3600));
    assert!(
        shorter[0].as_str().unwrap().starts_with("doorway 1 stays closed after that: fact 1"),
        "{shorter}"
    );
    // of edits that are made together, too
    let both = json!({"kind": "together", "edits": [close(60), close(30)]});
    assert_eq!(said(&both).as_array().map(Vec::len), Some(2));
    let keep_out = json!({"kind": "lay", "what": "area", "name": "stairs", "corners": [[5, 2], [7, 6]],
        "properties": {"kind": "keep-out"}});
    assert_eq!(said(&keep_out), json!([]));
    let shut = said(&json!({"kind": "open", "what": "stairs"}));
    assert!(shut[0].as_str().unwrap().starts_with("stairs stays shut all the same"), "{shut}");
}
