//! What is on the disk: nothing acknowledged is lost, and a disk that fails once is no failure for ever.

use std::path::Path;
use std::process::Command;

use adit_db::Store;
use adit_tests::service::Service;
use adit_tests::{TestSite, adit};
use serde_json::json;

use crate::{hardness, served};

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

/// Lets a program write files up to so many bytes; what is longer fails as on a disk that has no room.
fn room_for_files(service: &Service, bytes: &str) {
    let pid = service.pid().to_string();
    let set = Command::new("prlimit").args(["--pid", &pid, &format!("--fsize={bytes}:")]).status();
    assert!(set.unwrap().success());
}

#[test]
fn edits_go_on_once_the_disk_has_room_again() {
    let site = TestSite::example("paper").built();
    // the signal for a file that is too long would end the program
    let mut program = Command::new("sh");
    program.args(["-c", "trap '' XFSZ; exec \"$0\" \"$@\""]).arg(adit());
    let service = Service::start_by(program, &site, &["--listen", "127.0.0.1:0"]);
    let edit = |value: f64| service.ask("POST", "/api/edits", Some(&hardness("SQUAT", value)));
    assert_eq!(edit(3.0).0, 200);
    for round in 0..3 {
        room_for_files(&service, "4096");
        let (status, refused) = edit(9.0);
        assert_eq!((status, &refused["error"]["status"]), (500, &json!(500)), "{refused}");
        room_for_files(&service, "unlimited");
        let value = 4.0 + f64::from(round);
        let (status, answer) = edit(value);
        assert_eq!(status, 200, "after the disk was full: {answer}");
    }
    service.end();
    assert_eq!(hardness_in(&site.path().join("site.db")), "6.0");
}
