//! Seconds and joules beside hardness: what a route takes is the sum of what its steps take, in SQL, in answers and by hand from
//! the tables; what is not known is not said; a third measure is a row and a rule.
#![allow(clippy::unwrap_used)] // in a test a failed unwrap is a failed test

use std::collections::BTreeMap;
use std::process::Command;

use adit_tests::service::Service;
use adit_tests::{Ran, TestSite, adit};
use serde_json::{Value, json};

/// Answers say measures to a millionth.
const ROUNDING: f64 = 1e-5;

const MEASURES: [&str; 2] = ["seconds", "joules"];

/// The site that `adit new` makes.
fn starter() -> TestSite {
    let site = TestSite::empty();
    let folder = site.path().join("new");
    let made = Command::new(adit()).arg("new").arg(&folder).output().unwrap();
    Ran::new(&made).expect_status(0);
    for file in ["site.toml", "map.toml", "robots.toml"] {
        site.write(file, std::fs::read(folder.join(file)).unwrap());
    }
    site.write("rules/none.rhai", "// nothing of its own\n");
    site
}

/// The cells of what a query gives, row by row; an empty cell is NULL.
fn rows(site: &TestSite, query: &str) -> Vec<Vec<String>> {
    site.sqlite3(query).iter().map(|line| line.split('|').map(str::to_owned).collect()).collect()
}

fn number(cell: &str) -> Option<f64> {
    (!cell.is_empty()).then(|| cell.parse().unwrap())
}

fn expect_close(what: &str, found: Option<f64>, wanted: Option<f64>) {
    let is_close = match (found, wanted) {
        (Some(found), Some(wanted)) => (found - wanted).abs() <= ROUNDING * wanted.abs().max(1.0),
        (None, None) => true,
        _ => false,
    };
    assert!(is_close, "{what}: {found:?}, expected {wanted:?}");
}

/// The sum, where all of it is known.
fn sum(parts: impl IntoIterator<Item = Option<f64>>) -> Option<f64> {
    parts.into_iter().sum()
}

/// What a state's metre takes, and a change from one state to another, by the tables of the robots.
struct ByHand {
    metres: BTreeMap<[String; 2], [Option<f64>; 2]>,
    changes: BTreeMap<[String; 3], [Option<f64>; 2]>,
    /// What a metre weighs in a room, by its name.
    hardness: BTreeMap<String, f64>,
}

impl ByHand {
    fn of(site: &TestSite) -> Self {
        let metres = rows(site, "SELECT robot, state, speed, power FROM robots").into_iter().map(|row| {
            let [speed, power] = [number(&row[2]), number(&row[3])];
            let taken =
                [speed.map(|speed| 1.0 / speed), speed.zip(power).map(|(speed, power)| power / speed)];
            ([row[0].clone(), row[1].clone()], taken)
        });
        let changes = rows(site, "SELECT robot, from_state, to_state, seconds, joules FROM changes");
        let changes = changes.into_iter().map(|row| {
            ([row[0].clone(), row[1].clone(), row[2].clone()], [number(&row[3]), number(&row[4])])
        });
        let hardness = rows(site, "SELECT name, hardness FROM rooms");
        let hardness = hardness.into_iter().map(|row| (row[0].clone(), row[1].parse().unwrap()));
        Self { metres: metres.collect(), changes: changes.collect(), hardness: hardness.collect() }
    }

    /// What a step takes: its metres are its hardness by that of a metre of its room.
    fn step(&self, robot: &str, before: &str, [kind, place, state, hardness]: [&str; 4]) -> [Option<f64>; 2] {
        match kind {
            "room" => {
                let metres = hardness.parse::<f64>().unwrap() / self.hardness[place];
                self.metres[&[robot.to_owned(), state.to_owned()]].map(|a_metre| Some(a_metre? * metres))
            }
            "change" => {
                let key = [robot, before, state].map(str::to_owned);
                self.changes.get(&key).copied().unwrap_or([None; 2])
            }
            _ => [Some(0.0); 2],
        }
    }
}

/// Checks all kept routes of a site between places; how many are known to take something.
fn check(site: &TestSite) -> usize {
    let by_hand = ByHand::of(site);
    let routes = rows(
        site,
        "SELECT r.robot, r.start, r.goal, r.seconds, r.joules, r.measures FROM route AS r
         JOIN ends AS a ON a.name = r.start AND a.kind = 'place' JOIN ends AS e ON e.name = r.goal AND e.kind = 'place'
         WHERE r.status = 'ok'",
    );
    assert!(!routes.is_empty());
    let mut known = 0;
    for route in &routes {
        let [robot, start, goal] = [&route[0], &route[1], &route[2]];
        let of = format!("WHERE robot = '{robot}' AND start = '{start}' AND goal = '{goal}'");
        let what = format!("{robot} from {start} to {goal}");
        let total = [number(&route[3]), number(&route[4])];
        let steps = rows(
            site,
            &format!(
                "SELECT kind, place, state, hardness, seconds, joules FROM action_sequence {of} ORDER BY step"
            ),
        );
        let (mut by_tables, mut before) = (Vec::new(), String::new());
        for step in &steps {
            let hand = by_hand.step(robot, &before, [&step[0], &step[1], &step[2], &step[3]]);
            by_tables.push(hand);
            before.clone_from(&step[2]);
        }
        let last = rows(site, &format!("SELECT seconds, joules FROM waypoints {of} ORDER BY waypoint"));
        let answer = site.adit("route", &[start, goal, "--robot", robot, "--json"]).expecting(0).json();
        for (at, measure) in MEASURES.into_iter().enumerate() {
            let what = format!("{measure} of {what}");
            let of_steps = sum(steps.iter().map(|step| number(&step[4 + at])));
            expect_close(&format!("{what}: steps"), of_steps, total[at]);
            expect_close(&format!("{what}: by hand"), sum(by_tables.iter().map(|hand| hand[at])), total[at]);
            expect_close(&format!("{what}: waypoints"), number(&last.last().unwrap()[at]), total[at]);
            if total[at].is_some() {
                expect_close(&format!("{what}: the start"), number(&last[0][at]), Some(0.0));
            }
            expect_close(&format!("{what}: answer"), answer["measures"][measure].as_f64(), total[at]);
            let json: Value = serde_json::from_str(&route[5]).unwrap_or_default();
            expect_close(&format!("{what}: measures"), json[measure].as_f64(), total[at]);
            let said =
                answer["steps"].as_array().unwrap().iter().map(|step| step["measures"][measure].as_f64());
            expect_close(&format!("{what}: steps of the answer"), sum(said), total[at]);
            known += usize::from(total[at].is_some());
        }
    }
    known
}

#[test]
fn what_a_route_takes_is_the_sum_of_its_steps_in_sql_in_answers_and_by_hand() {
    for site in [starter(), TestSite::example("clinic"), TestSite::example("depot")] {
        let site = site.built();
        assert!(check(&site) > 0, "{}: nothing is known", site.read("site.toml"));
    }
}

#[test]
fn a_route_that_is_not_kept_says_the_same() {
    let site = TestSite::example("clinic").built();
    let kept = site.adit("route", &["dock", "ward 12", "--json"]).expecting(0).json();
    let at = rows(&site, "SELECT x, y FROM places WHERE place = 'ward 12'");
    let point = format!("{},{}", at[0][0], at[0][1]);
    let found = site.adit("route", &["dock", &point, "--json"]).expecting(0).json();
    for measure in MEASURES {
        expect_close(measure, found["measures"][measure].as_f64(), kept["measures"][measure].as_f64());
        let last = |route: &Value| {
            route["waypoints"].as_array().unwrap().last().unwrap()["measures"][measure].as_f64()
        };
        expect_close(measure, last(&found), last(&kept));
    }
}

#[test]
fn what_is_not_known_is_not_said_and_is_never_0() {
    let site = TestSite::example("clinic").built();
    let said = site.adit("route", &["dock", "ward 12"]).expecting(0).stdout;
    assert!(said.contains("takes about ") && said.contains(" min ") && said.contains(" kJ"), "{said}");
    // of whoever side-steps on this way nothing is known any more
    site.outside_edit("UPDATE robots SET speed = NULL WHERE state = 'SIDE-STAND'");
    let said = site.adit("route", &["dock", "ward 12"]).expecting(0).stdout;
    assert!(!said.contains("takes about"), "{said}");
    assert_eq!(
        site.sqlite3(
            "SELECT seconds IS NULL, joules IS NULL FROM route WHERE start = 'dock' AND goal = 'ward 12'"
        ),
        ["1|1"]
    );
    assert!(check(&site) > 0, "other routes are still known");
    site.outside_edit("UPDATE robots SET power = NULL");
    let said = site.adit("route", &["dock", "lobby"]).expecting(0).stdout;
    assert!(said.contains("takes about ") && !said.contains(" kJ"), "{said}");
}

#[test]
fn tuning_a_speed_changes_what_routes_take_and_nothing_else() {
    let site = TestSite::example("clinic").built();
    let query = "SELECT round(cost, 6), round(seconds, 3) FROM route WHERE start = 'dock' AND goal = 'lobby'";
    let before = rows(&site, query);
    site.adit("tune", &["robots", "STAND", "speed", "0.4"]).expect_status(0);
    let after = rows(&site, query);
    assert_eq!(before[0][0], after[0][0]);
    assert!(number(&after[0][1]) > number(&before[0][1]), "{before:?}, {after:?}");
    site.adit("tune", &["robots", "STAND", "speed", "0"])
        .expecting(2)
        .complains(&["speed must be finite and more than 0"]);
}

#[test]
fn where_a_rule_makes_hardness_of_seconds_routes_are_the_quickest() {
    let rule = r#"
rule "a room is as hard as its state"
    each room  in ROOMS
    some state in ROBOTS where state.robot == room.robot && state.state == room.state
    then { room.hardness = 1.0 / state.speed; room.action = state.action; }

rule "changing shape costs what the table of changes says"
    each door   in DOORS where door.kind == "change"
    some from   in ROOMS where from.room == door.room1
    some to     in ROOMS where to.room == door.room2
    some change in CHANGES where change.robot == to.robot && change.from_state == from.state && change.to_state == to.state
    then { door.hardness = change.seconds; door.action = to.action; door.passable = true; }
"#;
    let site = starter().with("rules/quick.rhai", rule).built();
    let found = site.sqlite3(
        "SELECT count(*) > 0, max(abs(cost - seconds)) < 1e-6 FROM route WHERE status = 'ok' AND seconds IS NOT NULL",
    );
    assert_eq!(found, ["1|1"]);
}

#[test]
fn a_third_measure_is_a_row_and_a_rule() {
    let rules = r#"
rule "every metre is a risk"
    each room in ROOMS
    then { room.risk = 0.25; }

rule "a door is none"
    each door in DOORS
    then { door.risk = 0.0; }
"#;
    let site = starter().built();
    site.write("rules/risk.rhai", rules);
    site.outside_edit("INSERT INTO measures VALUES ('risk', '')");
    site.adit("build", &[]).expect_status(0);
    let route = site.adit("route", &["home", "window", "--json"]).expecting(0).json();
    expect_close(
        "risk",
        route["measures"]["risk"].as_f64(),
        route["distance"].as_f64().map(|metres| metres / 4.0),
    );
    let said = site.adit("route", &["home", "window"]).expecting(0).stdout;
    assert!(said.contains(", risk "), "{said}");
    let by_sql = rows(
        &site,
        "SELECT json_extract(measures, '$.risk') FROM route WHERE start = 'home' AND goal = 'window'",
    );
    expect_close("risk", number(&by_sql[0][0]), route["measures"]["risk"].as_f64());
}

#[test]
fn a_rule_that_takes_less_than_nothing_is_refused() {
    let rule = "rule \"it charges as it goes\" priority 1\n    each room in ROOMS\n    then { room.joules = -1.0; }\n";
    let site = starter().with("rules/charge.rhai", rule);
    site.adit("build", &[])
        .expecting(2)
        .complains(&["rule \"it charges as it goes\" gives room ", "the joules -1"]);
}

#[test]
fn the_service_says_it_as_the_command_does() {
    let site = TestSite::example("clinic").built();
    let by_command = site.adit("route", &["dock", "ward 12", "--json"]).expecting(0).json();
    let service = Service::start(&site);
    let (status, by_service) = service.ask("GET", "/api/route?start=dock&goal=ward%2012", None);
    assert_eq!(status, 200);
    assert_eq!(by_service["measures"], by_command["measures"]);
    assert!(by_service["measures"]["seconds"].as_f64() > Some(60.0));
    let (_, of) = service.ask("GET", "/api/site", None);
    let units = json!([{"measure": "joules", "unit": "J"}, {"measure": "seconds", "unit": "s"}]);
    assert_eq!(of["measures"], units);
}

#[test]
fn maps_that_are_not_cut_into_rooms_say_what_rules_say_of_each_leg() {
    let map = TestSite::empty();
    let file = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("../kb/worlds/corridors.toml");
    let folder = map.path().join("new");
    let made = Command::new(adit()).arg("new").arg(&folder).arg("--map").arg(file).output().unwrap();
    Ran::new(&made).expect_status(0);
    let site = TestSite::empty();
    for name in ["site.toml", "corridors.toml"] {
        site.write(name, std::fs::read(folder.join(name)).unwrap());
    }
    site.write(
        "rules/own.rhai",
        "rule \"it drives at half a metre a second\"\n    each leg in LEGS\n    then { leg.seconds = leg.metres / 0.5; }\n",
    );
    site.adit("build", &[]).expect_status(0);
    let route = site.adit("route", &["start", "goal", "--json"]).expecting(0).json();
    expect_close(
        "seconds",
        route["measures"]["seconds"].as_f64(),
        route["distance"].as_f64().map(|metres| metres * 2.0),
    );
    let found = site.sqlite3(
        "SELECT abs(r.seconds - sum(a.seconds)) < 1e-4, r.joules IS NULL,
           abs(r.seconds - (SELECT max(seconds) FROM waypoints WHERE start = 'start' AND goal = 'goal')) < 1e-4
         FROM route AS r JOIN action_sequence AS a USING (robot, start, goal) WHERE r.start = 'start' AND r.goal = 'goal'",
    );
    assert_eq!(found, ["1|1|1"]);
}
