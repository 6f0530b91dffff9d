//! Robots where they are: they say it, and people who look on see it, with the way that each follows.

use adit_tests::service::Service;
use serde_json::{Value, json};

use crate::requests::follow;
use crate::suite::{served, within_a_second};

fn say(service: &Service, robots: &Value) -> (u16, Value) {
    service.ask("POST", "/api/whereabouts", Some(&json!({"robots": robots})))
}

fn robots(service: &Service) -> Vec<Value> {
    let (status, answer) = service.ask("GET", "/api/whereabouts", None);
    assert_eq!(status, 200, "{answer}");
    answer["robots"].as_array().unwrap().clone()
}

#[test]
fn a_robot_that_says_where_it_is_is_seen_there_with_its_way_and_what_it_was_told() {
    let (_site, service) = served("clinic");
    assert_eq!(robots(&service), Vec::<Value>::new());
    let cart = json!({"name": "cart-1", "x": 20.0, "y": 8.0, "heading": 90.0, "robot": "robot", "state": "STAND", "doing": "drives"});
    let (status, heard) = say(&service, &json!([cart]));
    assert_eq!((status, &heard["robots"]), (200, &json!(1)), "{heard}");
    let seen = &robots(&service)[0];
    for (part, is) in cart.as_object().unwrap() {
        assert_eq!(&seen[part], is, "{part}");
    }
    assert_eq!((&seen["space"], &seen["way"]), (&json!("corridor 15"), &Value::Null));
    assert!(seen["seconds"].as_f64().unwrap() < 5.0);

    let mut follower = service.follow("start=20,8&goal=ward%2012&name=cart-1");
    let first = follower.next("route");
    let before = generation(&service);
    let (_, ward) =
        service.ask("POST", "/api/edits", Some(&json!({"edit": {"kind": "close", "what": "ward 12"}})));
    assert!(ward["generation"].as_u64().unwrap() > before);
    let none = follower.next("route");
    let seen = &robots(&service)[0];
    let way = &seen["way"];
    assert_eq!((&seen["x"], &way["goal"], &way["cost"]), (&json!(20.0), &json!("ward 12"), &Value::Null));
    assert_eq!(way["reason"], none["route"]["reason"]);
    let told: Vec<&Value> = way["told"].as_array().unwrap().iter().map(|word| &word["words"]).collect();
    assert_eq!(told, [&first["words"], &none["words"]], "the newest last");
    service.ask("POST", "/api/edits", Some(&json!({"edit": {"kind": "open", "what": "ward 12"}})));
    let again = follower.next("route");
    let way = &robots(&service)[0]["way"];
    assert_eq!(way["cost"], again["route"]["cost"]);
    assert_eq!(way["points"][0], json!([20.0, 8.0]));
    // where it is changes nothing else
    let before = generation(&service);
    say(&service, &json!([{"name": "cart-1", "x": 21.0, "y": 8.0}]));
    assert_eq!(generation(&service), before);
    assert_eq!(robots(&service)[0]["x"], 21.0);
    drop(follower);
    within_a_second(|| robots(&service)[0]["way"].is_null());
    let (status, _) = service.ask("DELETE", "/api/whereabouts/cart-1", None);
    assert_eq!((status, robots(&service)), (200, Vec::new()));
}

fn generation(service: &Service) -> u64 {
    service.ask("GET", "/api/site", None).1["generation"].as_u64().unwrap()
}

#[test]
fn who_only_follows_a_route_is_seen_where_the_way_begins_and_then_where_it_says_to_be() {
    let (_site, service) = served("clinic");
    let mut nameless = service.follow(follow::WAY);
    let mut named = service.follow("start=20,8&goal=ward%2012&name=anna");
    let (first, _) = (nameless.next("route"), named.next("route"));
    let seen = robots(&service);
    let names: Vec<&Value> = seen.iter().map(|robot| &robot["name"]).collect();
    assert_eq!(names, [&json!("anna"), &Value::Null], "those without a name last");
    assert_eq!((&seen[1]["space"], &seen[1]["who"]), (&json!("dock"), &Value::Null));
    let path = format!("/api/route/follow/{}", first["follower"].as_str().unwrap());
    let (status, _) = service.ask("POST", &path, Some(&json!({"x": 20.0, "y": 8.0})));
    assert_eq!(status, 200);
    assert_eq!(robots(&service)[1]["x"], 20.0);
    let text = serde_json::to_string(&robots(&service)).unwrap();
    assert!(
        !text.contains(first["follower"].as_str().unwrap()),
        "whoever knows that name may move the follower"
    );
}

#[test]
fn what_cannot_be_is_refused_and_nothing_of_it_is_taken_up() {
    let (_site, service) = served("clinic");
    let good = json!({"name": "a", "x": 1.0, "y": 2.0});
    for (bad, code, words) in [
        (
            json!({"name": " ", "x": 1.0, "y": 2.0}),
            "service/question",
            "`name` of a robot has 1 to 200 characters",
        ),
        (json!({"name": "b\nc", "x": 1.0, "y": 2.0}), "service/question", "stands on one line"),
        (
            json!({"name": "b", "x": 1.0, "y": 2.0, "doing": "x".repeat(300)}),
            "service/question",
            "`doing` of a robot",
        ),
        (
            json!({"name": "b", "x": 1.0, "y": 2.0, "robot": "robto"}),
            "route/unknown-robot",
            "there is no robot `robto`",
        ),
        (good.clone(), "service/question", "`a` is said to be at two places at once"),
        (json!({"name": "b", "x": 1.0}), "service/body", "missing field `y`"),
        (json!({"name": "b", "x": 1.0, "y": 2.0, "z": 3.0}), "service/body", "unknown field `z`"),
    ] {
        let (status, refused) = say(&service, &json!([good, bad]));
        assert!((400..500).contains(&status), "{refused}");
        assert_eq!(refused["error"]["code"], code, "{refused}");
        let message = refused["error"]["message"].as_str().unwrap();
        assert!(message.contains(words), "{message}");
        assert_eq!(robots(&service), Vec::<Value>::new());
    }
    let many: Vec<Value> = (0..1_001).map(|n| json!({"name": format!("r{n}"), "x": 1.0, "y": 2.0})).collect();
    let (status, refused) = say(&service, &json!(many));
    assert_eq!((status, &refused["error"]["code"]), (400, &json!("service/question")), "{refused}");
    let (status, refused) = service.ask("DELETE", "/api/whereabouts/nobody", None);
    assert_eq!((status, &refused["error"]["code"]), (404, &json!("whereabouts/unknown")));
    // nobody is told of a route that is asked for once
    let (status, refused) = service.ask("GET", "/api/route?start=dock&goal=bath&name=a", None);
    assert_eq!((status, &refused["error"]["code"]), (400, &json!("service/question")), "{refused}");
}
