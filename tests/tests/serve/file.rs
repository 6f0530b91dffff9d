//! What is of a site's own file alone: of one in PostgreSQL there is no file that others would write, or that would be all there is.

use std::path::Path;
use std::process::Command;

use adit_db::Store;
use adit_tests::TestSite;
use adit_tests::service::Service;
use serde_json::json;

use crate::requests::follow;
use crate::suite::{cost, hardness, rules, served};

/// What the file alone says of a cell that was edited.
fn hardness_in(database: &Path) -> String {
    let folder = TestSite::empty();
    std::fs::copy(database, folder.path().join("site.db")).unwrap();
    folder.sqlite3("SELECT hardness FROM robots WHERE state = 'SQUAT'").join(" ")
}

fn files_of_the_database(site: &TestSite) -> Vec<String> {
    let files = std::fs::read_dir(site.path()).unwrap();
    let names = files.map(|file| file.unwrap().file_name().into_string().unwrap());
    names.filter(|name| name.starts_with("site.db")).collect()
}

#[test]
fn when_it_ends_the_database_is_one_file_again() {
    let site = TestSite::example("paper").built();
    let service = Service::start(&site);
    service.ask("POST", "/api/edits", Some(&hardness("SQUAT", 3.0)));
    assert_eq!(site.sqlite3("PRAGMA journal_mode"), ["wal"]);
    service.end();
    assert_eq!(site.sqlite3("PRAGMA journal_mode"), ["delete"]);
    assert!(!site.path().join("site.db-wal").exists());
}

#[test]
fn where_the_database_is_removed_no_edit_is_acknowledged() {
    let (site, service) = served("paper");
    let mut events = service.events();
    events.next("hello");
    std::fs::remove_file(site.path().join("site.db")).unwrap();
    let (status, refused) = service.ask("POST", "/api/edits", Some(&hardness("SQUAT", 3.0)));
    assert_eq!((status, &refused["error"]["code"]), (500, &json!("database/replaced")), "{refused}");
    assert_eq!(events.next("problems")["problems"][0]["code"], "database/replaced");
}

#[test]
fn what_another_program_edits_is_heard_within_a_second() {
    let site = TestSite::example("paper").built();
    let service = Service::start(&site);
    let mut events = service.events();
    let before = events.next("hello")["generation"].as_u64().unwrap();
    site.adit("tune", &["robots", "SQUAT", "hardness", "3"]).expect_status(0);
    let began = std::time::Instant::now();
    assert!(events.next("changed")["generation"].as_u64().unwrap() > before);
    assert!(began.elapsed().as_secs_f64() < 1.0);
    site.outside_edit("UPDATE robots SET hardness = 5 WHERE state = 'SQUAT'");
    events.next("changed");
    let (_, tables) = service.ask("GET", "/api/tables", None);
    assert!(
        tables["tables"][0]["rows"].as_array().unwrap().iter().any(|row| row[5] == json!(5.0)),
        "{tables}"
    );
}

#[test]
fn what_another_program_closes_is_heard_with_who_did_it() {
    let (site, service) = served("clinic");
    let mut follower = service.follow(follow::WAY);
    let first = follower.next("route");
    let door = follow::doorway(&first);
    site.adit("close", &[&door, "--why", "a trolley"]).expect_status(0);
    let other = follower.next("route");
    follow::says(
        &other,
        &["another way", &format!("{door} at ("), "fact 1 (DOORWAYS ", "is told (a trolley)"],
    );
    assert_eq!(follow::route(&other["route"]), follow::asked(&service, follow::WAY));
    // where it is led is no place any more
    site.edit("map.toml", "{ name = \"ward 12\"", "{ name = \"ward 112\"");
    let gone = follower.next("route");
    follow::says(
        &gone,
        &["there is no way any more: `ward 12` is no place", "files: rules, map or settings were saved"],
    );
}

#[test]
fn the_program_tells_of_edited_rules_and_takes_them_back() {
    let (site, service) = rules::served();
    let (text, version) = rules::file(&service, "rooms.rhai");
    let cell = json!({"kind": "set", "table": "robots", "key": "SQUAT", "column": "hardness", "value": 3});
    let rule = rules::write("rooms.rhai", Some(&format!("// One.\n{text}")), &version);
    assert_eq!(rules::edit(&service, &[rule, cell]).0, 200);
    service.end();
    let told = site.adit("history", &[]).expect_status(0).stdout;
    assert!(told.contains("rule file rooms.rhai") && told.contains("1 line more"), "{told}");
    let undone = site.adit("undo", &["1"]).expect_status(0).stdout;
    assert!(undone.contains("rule file rooms.rhai is as it was before, and one more"), "{undone}");
    assert_eq!(site.read("rules/rooms.rhai"), text);
    assert_eq!(site.sqlite3("SELECT hardness FROM robots WHERE state = 'SQUAT'"), ["4.0"]);
}

#[test]
fn a_clean_end_leaves_one_file_with_every_edit_in_it() {
    for signal in ["TERM", "INT"] {
        let (site, service) = served("paper");
        for question in ["/api/history", "/api/facts", "/api/schema", "/api/sql?query=SELECT%201"] {
            assert_eq!(service.ask("GET", question, None).0, 200, "{question}");
        }
        assert_eq!(service.ask("POST", "/api/edits", Some(&hardness("SQUAT", 3.25))).0, 200);
        service.end_by(signal);
        assert_eq!(files_of_the_database(&site), ["site.db"], "after SIG{signal}");
        assert_eq!(hardness_in(&site.path().join("site.db")), "3.25");
    }
}

/// A service that is killed leaves its log beside the database; the next program that writes takes it in.
#[test]
fn after_a_killed_service_the_next_edit_leaves_one_file() {
    let (site, service) = served("paper");
    assert_eq!(service.ask("POST", "/api/edits", Some(&hardness("SQUAT", 3.25))).0, 200);
    service.kill();
    site.adit("tune", &["robots", "LIE-FACE-DOWN", "hardness", "8"]).expect_status(0);
    for (verb, arguments) in
        [("sql", &["SELECT 1"][..]), ("route", &["f", "e"]), ("history", &[]), ("doctor", &[])]
    {
        site.adit(verb, arguments).expect_status(0);
        assert_eq!(files_of_the_database(&site), ["site.db"], "after adit {verb}");
    }
    assert_eq!(hardness_in(&site.path().join("site.db")), "3.25");
}

#[test]
fn a_reader_of_somebody_elses_does_not_keep_edits_out_of_the_file() {
    let (site, service) = served("paper");
    assert_eq!(service.ask("POST", "/api/edits", Some(&hardness("SQUAT", 3.25))).0, 200);
    let database = site.path().join("site.db");
    let mut reader = Store::open_read_only(&database).unwrap();
    let read = reader.snapshot(|tx| {
        tx.rooms()?;
        service.end();
        assert_eq!(hardness_in(&database), "3.25");
        tx.rooms()
    });
    assert!(!read.unwrap().is_empty());
}

/// A table that no rule reads is somebody's all the same: a program that drives vehicles waits for its goals.
#[test]
fn an_edit_from_the_shell_from_which_nothing_follows_is_heard_of() {
    let site = TestSite::example("paper");
    site.write("tables/vehicles.csv", "vehicle,goal\nv1,e\n");
    let site = site.built();
    let service = Service::start(&site);
    let mut events = service.events();
    let hello = events.next("hello");
    site.adit("tune", &["vehicles", "v1", "goal", "f"]).expect_status(0);
    let changed = events.next("changed");
    assert_eq!((&changed["who"], &changed["rooms"]), (&"cli".into(), &0.into()), "{changed}");
    assert!(changed["generation"].as_u64() > hello["generation"].as_u64(), "{changed}");
    site.adit("undo", &[]).expect_status(0);
    assert!(events.next("changed")["generation"].as_u64() > changed["generation"].as_u64());
}

#[test]
fn a_database_is_served_by_one_service_at_a_time() {
    let site = TestSite::example("paper").built();
    let service = Service::start(&site);
    Service::refused(&site, &["--listen", "127.0.0.1:0"])
        .expect_status(2)
        .complains(&["database/served", "site.db already"]);
    // whoever edits from the shell is no service
    site.adit("tune", &["robots", "SQUAT", "hardness", "3"]).expect_status(0);
    service.kill();
    Service::start(&site).end();
}

/// What another program wrote keeps the site from being derived: whoever edits over HTTP can take it away, and nothing is lost.
#[test]
fn an_edit_mends_what_another_program_wrote_and_rules_cannot_take() {
    let site =
        TestSite::example("starter").with("site.toml", "map = \"map.toml\"\nrobots = \"robots.toml\"\n");
    let site = site.built();
    let service = Service::start(&site);
    let before = cost(&service, "home", "window");
    let mut events = service.events();
    let wrong = "INSERT INTO laid (name, what, kind, outline, properties, why) VALUES \
                 ('bad', 'area', 'floor', '[[7,1],[8,1],[8,2],[7,2]]', '{\"hardness_factor\":-3}', '')";
    let wrote = Command::new("sqlite3").arg(site.path().join("site.db")).arg(wrong).status();
    assert!(wrote.unwrap().success());
    let said = events.next("problems");
    assert_eq!(said["problems"][0]["code"], "rule/hardness", "{said}");
    assert_eq!(
        service.ask("POST", "/api/edits", Some(&hardness("STAND", 1.5))).0,
        422,
        "it cannot be derived"
    );
    let (status, lifted) = service.ask("DELETE", "/api/areas/bad", None);
    assert_eq!(status, 200, "{lifted}");
    assert_eq!(cost(&service, "home", "window"), before);
    loop {
        let said = events.next("problems");
        if said["problems"].as_array().unwrap().is_empty() {
            break;
        }
    }
    assert_eq!(service.ask("POST", "/api/edits", Some(&hardness("STAND", 1.5))).0, 200);
}

#[test]
fn missions_that_were_kept_are_looked_at_again_with_what_was_met_and_which_rule_decided() {
    let site = TestSite::example("clinic").built();
    site.adit("simulate", &["dock", "ward 12", "--keep"]).expect_status(0);
    site.adit("simulate", &["--missions", "1", "--seed", "5", "--keep"]).expect_status(0);
    let service = Service::start(&site);
    let (_, answer) = service.ask("GET", "/api/missions", None);
    let numbers: Vec<&serde_json::Value> =
        answer["missions"].as_array().unwrap().iter().map(|mission| &mission["mission"]).collect();
    assert_eq!(numbers, [2, 1], "the newest first");
    let (_, one) = service.ask("GET", "/api/missions?limit=1", None);
    assert_eq!(one["missions"].as_array().unwrap().len(), 1);
    let (_, mission) = service.ask("GET", "/api/missions/1", None);
    assert_eq!((&mission["spaces"], &mission["ending"]), (&json!(["dock", "ward 12"]), &json!("arrived")));
    let journal = mission["journal"].as_array().unwrap();
    let kept = site.sqlite3("SELECT count(*) FROM journal WHERE mission = 1").join("");
    assert_eq!(journal.len().to_string(), kept);
    assert_eq!(journal[0]["pose"], json!([2.0, 2.0, 0.0]));
    let shapes = journal.iter().filter_map(|entry| entry["shape"].as_str());
    assert!(
        shapes.clone().any(|shape| shape == "SQUAT"),
        "beneath the pipe: {:?}",
        shapes.collect::<Vec<_>>()
    );
    assert!(journal.iter().any(|entry| entry["way"].as_array().is_some_and(|way| way.len() > 2)));
    assert!(
        journal
            .iter()
            .any(|entry| entry["rule"].as_str().is_some_and(|rule| rule.contains("execution.rhai:")))
    );
    let (status, refused) = service.ask("GET", "/api/missions/9", None);
    assert_eq!((status, &refused["error"]["code"]), (404, &json!("mission/unknown")), "{refused}");
    // what a mission may end as is for reading, and nobody tunes it
    let (_, tables) = service.ask("GET", "/api/tables", None);
    let names: Vec<&str> =
        tables["tables"].as_array().unwrap().iter().filter_map(|table| table["table"].as_str()).collect();
    assert!(names.contains(&"robots") && !names.contains(&"endings"), "{names:?}");
}
