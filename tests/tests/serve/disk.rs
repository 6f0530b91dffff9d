//! A disk that fails once is no failure for ever.

use std::process::Command;
use std::time::{Duration, Instant};

use adit_tests::database::on_postgres;
use adit_tests::service::Service;
use adit_tests::{TestSite, adit};
use serde_json::json;

use super::hardness;

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
        if on_postgres() {
            assert_eq!((status, &refused["error"]["code"]), (503, &json!("postgres/kept")), "{refused}");
        } else {
            assert_eq!((status, &refused["error"]["status"]), (500, &json!(500)), "{refused}");
            let (status, unready) = service.ask("GET", "/api/ready", None);
            assert_eq!((status, &unready["error"]["code"]), (503, &json!("service/not-ready")), "{unready}");
            let (_, about) = service.ask("GET", "/api/site", None);
            assert_eq!(about["problems"][0]["message"], refused["error"]["message"], "{about}");
        }
        room_for_files(&service, "unlimited");
        let value = 4.0 + f64::from(round);
        let (status, answer) = edit(value);
        assert_eq!(status, 200, "after the disk was full: {answer}");
        assert_eq!(service.ask("GET", "/api/ready", None).0, 200);
    }
    if !on_postgres() {
        // whoever sends no edits to a service that is not ready hears in time that it is
        room_for_files(&service, "4096");
        assert_eq!(edit(9.0).0, 500);
        room_for_files(&service, "unlimited");
        assert_eq!(service.ask("GET", "/api/ready", None).0, 503);
        let began = Instant::now();
        while service.ask("GET", "/api/ready", None).0 != 200 {
            assert!(began.elapsed() < Duration::from_mins(2), "it is never ready again");
            std::thread::sleep(Duration::from_millis(200));
        }
    }
    service.end();
    // in PostgreSQL there was room for all of them
    let kept = if on_postgres() { "3.0 9.0 4.0 9.0 5.0 9.0 6.0" } else { "3.0 4.0 5.0 6.0" };
    assert_eq!(site.sqlite3("SELECT new FROM history ORDER BY id").join(" "), kept);
    assert_eq!(site.sqlite3("SELECT hardness FROM robots WHERE state = 'SQUAT'"), ["6.0"]);
}
