//! What holds for one errand only: what is avoided, what is carried, and when. The site stays as it is.

use adit_tests::TestSite;
use adit_tests::service::Service;
use serde_json::{Value, json};

use super::served;

const WAY: &str = "start=dock&goal=ward%2012";

fn asked(service: &Service, question: &str) -> Value {
    let (status, answer) = service.ask("GET", &format!("/api/route?{question}"), None);
    assert_eq!(status, 200, "{answer}");
    answer
}

/// A route, whatever state of the site it rests on.
fn way(answer: &Value) -> [&Value; 4] {
    ["status", "cost", "steps", "waypoints"].map(|part| &answer[part])
}

fn edit(service: &Service, edit: &Value) {
    let (status, answer) = service.ask("POST", "/api/edits", Some(&json!({"edit": edit})));
    assert_eq!(status, 200, "{answer}");
}

#[test]
fn what_one_errand_avoids_is_closed_to_it_and_open_to_everybody_else() {
    let (site, service) = served("clinic");
    let before = asked(&service, WAY);
    let doorways = before["steps"].as_array().unwrap().iter().filter_map(|step| step["doorway"].as_str());
    // the first and the last are the only ones of their rooms
    let doorway = doorways.clone().nth(1).unwrap();
    for (what, status) in
        [(doorway, "ok"), ("lobby", "ok"), ("ward 12", "no_route"), ("corridor 15", "no_route")]
    {
        let generation = asked(&service, WAY)["generation"].clone();
        let avoided = asked(&service, &format!("{WAY}&avoid={}", what.replace(' ', "%20")));
        assert_eq!((&avoided["generation"], &avoided["status"]), (&generation, &json!(status)), "{what}");
        assert_eq!(way(&asked(&service, WAY)), way(&before), "nothing of it is kept");
        edit(&service, &json!({"kind": "close", "what": what}));
        assert_eq!(way(&avoided), way(&asked(&service, WAY)), "{what} is avoided as it is closed");
        edit(&service, &json!({"kind": "undo"}));
    }
    let all = format!("{WAY}&avoid={}&avoid=ward%2012", doorway.replace(' ', "%20"));
    assert_eq!(asked(&service, &all)["status"], "no_route");
    let (status, refused) = service.ask("GET", &format!("/api/route?{WAY}&avoid=triagge"), None);
    assert_eq!((status, &refused["error"]["help"]), (404, &json!("did you mean `triage`?")), "{refused}");
    let none = site.adit("route", &["dock", "ward 12", "--avoid", "ward 12"]).expecting(1).stdout;
    assert!(none.contains("and ward 12, is closed (this errand keeps away from `ward 12`)"), "{none}");
    let way = site.adit("route", &["dock", "ward 12", "--avoid", doorway, "--json"]).expecting(0).json();
    assert!(way["cost"].as_f64() > before["cost"].as_f64());
    site.adit("route", &["dock", "ward 12", "--avoid", "triagge"]).expecting(2).complains(&["`triage`?"]);
    assert!(site.sqlite3("SELECT * FROM told").is_empty());
}

#[test]
fn a_kind_of_area_is_avoided_by_its_name() {
    let site = TestSite::example("starter");
    let area = "[[area]]\nname = \"east\"\nkind = \"wet\"\nrect = [6.5, 0.0, 12.0, 8.0]\n";
    site.write("site.toml", format!("map = \"map.toml\"\nrobots = \"robots.toml\"\n{area}"));
    let site = site.built();
    let service = Service::start(&site);
    assert_eq!(asked(&service, "start=home&goal=11,2")["status"], "ok");
    for what in ["wet", "east"] {
        assert_eq!(asked(&service, &format!("start=home&goal=11,2&avoid={what}"))["status"], "no_route");
        site.adit("route", &["home", "11,2", "--avoid", what]).expect_status(1);
    }
    site.adit("route", &["home", "11,2"]).expect_status(0);
}

#[test]
fn an_errand_later_is_led_as_it_is_then() {
    let (_site, service) = served("clinic");
    let before = asked(&service, WAY);
    edit(&service, &json!({"kind": "close", "what": "ward 12", "until": "2h"}));
    assert_eq!(asked(&service, WAY)["status"], "no_route");
    assert_eq!(way(&asked(&service, &format!("{WAY}&at=3h"))), way(&before));
    assert_eq!(asked(&service, &format!("{WAY}&at=1h"))["status"], "no_route");
    let (status, refused) = service.ask("GET", &format!("/api/route?{WAY}&at=soon"), None);
    assert_eq!(status, 400, "{refused}");
    // which moment that is, is said; one that is over is none
    let remarks = asked(&service, &format!("{WAY}&at=2099-11-21T18:00:00+01:00"))["remarks"].clone();
    assert!(remarks[0].as_str().unwrap().starts_with("as it is at 2099-11-21T17:00:00Z"), "{remarks}");
    for at in ["-2h", "2020-01-01"] {
        let (status, refused) = service.ask("GET", &format!("/api/route?{WAY}&at={at}"), None);
        assert_eq!((status, &refused["error"]["code"]), (400, &json!("route/past")), "{refused}");
    }
    let (status, refused) = service.ask("GET", &format!("/api/route?{WAY}&start=lobby"), None);
    assert_eq!(status, 400, "{refused}");
    assert!(refused.to_string().contains("one `start`, and this question says it twice"), "{refused}");
}

#[test]
fn a_list_of_robots_without_one_closes_to_nobody() {
    let (site, service) = served("depot");
    for list in ["only", "except"] {
        let blocked = json!({"x": 8.0, "y": 6.0, "heading": 0.0, list: []});
        let edit = json!({"edit": {"kind": "close", "what": "8,6@0", list: []}});
        for (route, body) in [("/api/blocked", blocked), ("/api/edits", edit)] {
            let (status, refused) = service.ask("POST", route, Some(&body));
            assert_eq!(status, 422, "{refused}");
            assert!(refused.to_string().contains("the name of one robot at least"), "{refused}");
        }
    }
    assert_eq!(site.sqlite3("SELECT count(*) FROM told"), ["0"]);
    let (status, refused) = service.ask("DELETE", "/api/facts/1?reason=x", None);
    assert_eq!(status, 400, "{refused}");
}

#[test]
fn what_is_carried_on_one_errand_closes_what_it_does_not_fit_through() {
    let (site, service) = served("depot");
    let way = "start=dock&goal=gate&robot=cart";
    let before = asked(&service, way);
    let loaded = asked(&service, &format!("{way}&load=crate"));
    assert_eq!(loaded["status"], "no_route");
    assert!(loaded["reason"].as_str().unwrap().contains("1.6 m"), "{loaded}");
    assert_eq!(asked(&service, way), before, "it is off again");
    let (status, refused) = service.ask("GET", &format!("/api/route?{way}&load=piano"), None);
    assert!((400..500).contains(&status) && refused.to_string().contains("piano"), "{refused}");
    let cli = ["dock", "gate", "--robot", "cart", "--load", "crate"];
    assert!(site.adit("route", &cli).expecting(1).stdout.contains("1.6 m"));
    assert_eq!(site.sqlite3("SELECT max(carried) FROM loads"), ["0"]);
}

#[test]
fn a_robot_starts_and_arrives_in_the_states_that_are_said() {
    let (site, service) = served("clinic");
    let before = asked(&service, WAY);
    let states = |answer: &Value| {
        let points = answer["waypoints"].as_array().unwrap();
        [&points[0], &points[points.len() - 1]].map(|point| point["state"].as_str().unwrap().to_owned())
    };
    let [start, goal] = states(&before);
    let all = site.sqlite3("SELECT DISTINCT state FROM rooms WHERE x0 < 2 AND x1 > 2 AND y0 < 2 AND y1 > 2");
    let other = all.iter().find(|state| **state != start).unwrap();
    let answer = asked(&service, &format!("{WAY}&start_state={other}"));
    assert_eq!(states(&answer), [other.clone(), goal.clone()]);
    assert!(answer["cost"].as_f64() > before["cost"].as_f64());
    let both = asked(&service, &format!("{WAY}&start_state={other}&goal_state={other}"));
    assert_eq!(states(&both), [other.clone(), other.clone()]);
    let said = ["dock", "ward 12", "--start-state", other, "--goal-state", other, "--json"];
    let cli = site.adit("route", &said).expecting(0).json();
    assert_eq!((states(&cli), &cli["cost"]), (states(&both), &both["cost"]));
    let same = asked(&service, &format!("{WAY}&start_state={start}&goal_state={goal}"));
    assert_eq!(way(&same), way(&before));
    let (status, refused) = service.ask("GET", &format!("/api/route?{WAY}&goal_state=FLY"), None);
    assert_eq!((status, &refused["error"]["code"]), (404, &json!("route/unknown-state")));
}
