//! Live events.

use adit_tests::TestSite;
use adit_tests::service::Service;
use serde_json::json;

use super::hardness;

#[test]
fn subscribers_hear_what_changed_and_which_routes() {
    let site = TestSite::example("clinic").built();
    let service = Service::start(&site);
    let mut events = service.events();
    let hello = events.next("hello");
    let (_, state) = service.ask("GET", "/api/site", None);
    assert_eq!((&hello["generation"], &hello["layout"]), (&state["generation"], &state["layout"]));
    // the pipe in the corridor costs more to pass
    let (status, edited) = service.ask("POST", "/api/edits", Some(&hardness("SQUAT", 4.5)));
    assert_eq!(status, 200, "{edited}");
    let changed = events.next("changed");
    assert_eq!((&changed["generation"], &changed["rooms"]), (&edited["generation"], &edited["rooms"]));
    assert_eq!(changed["what"], "robots.robot/SQUAT.hardness: 4 → 4.5");
    let routes = events.next("routes");
    let is_dearer = |route: &serde_json::Value| route["new"].as_f64() > route["old"].as_f64();
    let changed = routes["changed"].as_array().unwrap();
    assert!(changed.iter().all(is_dearer) && !changed.is_empty(), "{routes}");
    assert_eq!(routes["generation"], edited["generation"]);
}

#[test]
fn more_subscribers_than_there_are_places_are_told_to_come_back() {
    let site = TestSite::example("paper").built();
    let service = Service::start_with(&site, &["--listen", "127.0.0.1:0", "--subscribers", "2"]);
    let mut places: Vec<_> = (0..2).map(|_| service.events()).collect();
    for events in &mut places {
        events.next("hello");
    }
    let (status, refused) = service.ask("GET", "/api/events", None);
    assert_eq!((status, &refused["error"]["code"]), (503, &json!("service/busy")));
    drop(places);
    super::within_a_second(|| {
        // a place is free again once the service notices that its reader is gone
        service.ask("POST", "/api/edits", Some(&hardness("SQUAT", 3.0)));
        service.ask("POST", "/api/edits", Some(&hardness("SQUAT", 4.0)));
        let mut head = [0; 12];
        let mut stream = std::net::TcpStream::connect(&service.address).unwrap();
        std::io::Write::write_all(
            &mut stream,
            format!("GET /api/events HTTP/1.1\r\nHost: {}\r\n\r\n", service.address).as_bytes(),
        )
        .unwrap();
        std::io::Read::read_exact(&mut stream, &mut head).unwrap();
        &head[9..] == b"200"
    });
}
