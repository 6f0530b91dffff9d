//! A database that an older version made becomes one of this version, and nobody of the older one edits it any more.

use std::process::Command;
use std::time::Duration;

use adit_tests::cluster::Cluster;
use adit_tests::service::Service;
use adit_tests::{Ran, TestSite, adit};

use super::{Served, copy, soon, squat, with_site};

fn upgrade(cluster: &Cluster, arguments: &[&str]) -> Ran {
    let url = cluster.url("any");
    Ran::new(&Command::new(adit()).args(["upgrade", &url]).args(arguments).output().unwrap())
}

/// Two sites as the release of schema version 21 had them in PostgreSQL: a shop that was edited, and a floor plan with a mission.
fn as_of_version_21() -> Cluster {
    let cluster = Cluster::start();
    cluster.ask("CREATE ROLE reader LOGIN");
    cluster.load(&adit_tests::repository().join("tests/tests/postgres/v21.sql"));
    cluster
}

fn out(cluster: &Cluster, site: &str) -> TestSite {
    let back = TestSite::empty();
    copy(&[&cluster.url(site), &back.path().display().to_string()]).expect_status(0);
    back
}

#[test]
fn sites_of_an_older_version_are_served_after_an_upgrade_with_all_that_they_had() {
    let cluster = as_of_version_21();
    let manual = std::fs::read_to_string(adit_tests::repository().join("manual/src/postgres.md")).unwrap();
    let way_back = manual.split("```").find(|block| block.contains("sites_then")).unwrap();
    let heads = "SELECT site, entry, fence FROM adit.sites ORDER BY site";
    let heads_then = cluster.ask(heads);
    let to_20 = "ALTER TABLE adit.missions DROP COLUMN robot; UPDATE adit.version SET version = 20";
    for (made_older, version, robot) in [("", "21.0", "robot"), (to_20, "20.0", "")] {
        cluster.ask(&format!("BEGIN; {made_older}; COMMIT"));
        let refused = copy(&[&cluster.url("store"), &TestSite::empty().path().display().to_string()]);
        refused.expect_status(2).complains(&["postgres/version", version, "`adit upgrade`"]);
        Service::refused(&TestSite::empty(), &["--database", &cluster.url("store")])
            .expect_status(2)
            .complains(&["postgres/version"]);

        let kept = format!("adit_v{}", version.replace('.', "_"));
        let said = upgrade(&cluster, &[]).expect_status(0).stdout;
        assert!(said.contains(&format!("2 sites went from version {version} to ")), "{said}");
        assert!(said.contains(&format!("`DROP SCHEMA {kept} CASCADE`")), "{said}");
        let said = upgrade(&cluster, &[]).expect_status(0).stdout;
        assert!(said.contains("nothing is to be done for 2 sites"), "{said}");

        let store = out(&cluster, "store");
        let edit = "SELECT key || ' ' || column_name || ' ' || why FROM history";
        assert_eq!(store.sqlite3(edit), ["Bruno club he asked"]);
        assert_eq!(store.sqlite3("SELECT id, text FROM notes"), ["1|Grüße", "2|"]);
        assert_eq!(store.sqlite3("SELECT club FROM customers WHERE customer = 'Bruno'"), ["1"]);
        store.adit("build", &[]).expect_status(0);
        let world = out(&cluster, "world");
        assert_eq!(world.sqlite3("SELECT count(*), min(robot) FROM missions"), [format!("1|{robot}")]);
        assert_eq!(world.sqlite3("SELECT count(*) FROM journal"), ["12"]);
        assert_eq!(world.sqlite3("PRAGMA foreign_key_check"), Vec::<String>::new());

        // who could read routes still can, and nothing more
        let steps = "SELECT count(*) FROM adit.action_sequence WHERE site = 'world'";
        assert_ne!(cluster.ask_as("reader", steps).unwrap(), ["0"]);
        assert!(cluster.ask_as("reader", "SELECT * FROM adit.files").is_err());

        let served = Served::start(&cluster.url("store"));
        let before = served.generation();
        served.edit(&serde_json::json!({"edit": {"kind": "set", "table": "customers", "key": "Ada",
            "column": "since", "value": 2020}}));
        assert_eq!(served.generation(), before + 1);
        drop(served);

        // what was kept is the way back, as the manual has it
        assert_eq!(cluster.ask(&format!("SELECT count(*) FROM {kept}.sites")), ["0"]);
        cluster.ask(&way_back.replace("adit_v21_0", &kept));
        assert_eq!(cluster.ask(heads), heads_then);
        let next = "SELECT count(*) FROM adit.log JOIN adit.sites USING (site) WHERE log.entry > sites.entry";
        assert_eq!(cluster.ask(next), ["0"], "the next edit has its number");
    }
}

#[test]
fn an_upgrade_that_cannot_be_made_changes_nothing() {
    let cluster = as_of_version_21();
    let rows = "SELECT site, entry, fence FROM adit.sites ORDER BY site";
    let before = cluster.ask(rows);
    cluster.ask("CREATE SCHEMA adit_v21_0");
    upgrade(&cluster, &[]).expect_status(2).complains(&["postgres/upgrade", "`adit_v21_0`"]);
    cluster.ask("DROP SCHEMA adit_v21_0");
    // a row that does not go through
    cluster.ask("UPDATE adit.own_rows SET row = 'half a li' WHERE table_name = 'notes'");
    upgrade(&cluster, &[]).expect_status(2).complains(&["postgres/sql", "a row of notes cannot be read"]);
    assert_eq!(cluster.ask(rows), before);
    assert_eq!(cluster.ask("SELECT version FROM adit.version"), ["21"]);
    cluster.ask("UPDATE adit.version SET version = 9900");
    upgrade(&cluster, &[]).expect_status(2).complains(&["postgres/version", "99.0", "a newer program"]);
    cluster.ask("DROP SCHEMA adit CASCADE");
    upgrade(&cluster, &[]).expect_status(2).complains(&["postgres/unknown-site", "holds no sites"]);
}

/// What an upgrade by a newer program leaves, as a service of this version finds it.
#[test]
fn a_service_of_the_older_version_that_runs_on_answers_and_edits_nothing_any_more() {
    let (cluster, _site) = with_site("paper");
    let served = Served::start(&cluster.url("paper"));
    served.edit(&squat(2.5));
    let before = served.cost("f", "e");
    cluster.ask(
        "BEGIN; ALTER SCHEMA adit RENAME TO adit_then; CREATE SCHEMA adit;
         CREATE TABLE adit.version AS SELECT one, version + 100 AS version FROM adit_then.version;
         CREATE TABLE adit.sites AS TABLE adit_then.sites; CREATE TABLE adit.log AS TABLE adit_then.log;
         UPDATE adit.sites SET entry = entry + 1, fence = fence + 1;
         INSERT INTO adit.log (site, entry, generation, owner, fence, changes)
           SELECT site, entry, generation, '', 0, NULL FROM adit.sites;
         INSERT INTO adit_then.log (site, entry, generation, owner, fence, changes)
           SELECT site, entry + 1, generation, '', fence, NULL FROM adit_then.sites;
         DELETE FROM adit_then.sites; COMMIT",
    );
    let refused = || {
        let (status, said) = served.service.ask("POST", "/api/edits", Some(&squat(3.5)));
        assert_eq!((status, said["error"]["code"].as_str()), (500, Some("postgres/version")), "{said}");
    };
    refused();
    soon(Duration::from_secs(3), || {
        let said = served.service.ask("GET", "/api/site", None).1["problems"].to_string();
        said.contains("postgres/version")
    });
    // also on a connection that it makes anew
    cluster.ask("SELECT pg_terminate_backend(pid) FROM pg_stat_activity WHERE pid <> pg_backend_pid()");
    refused();
    assert_eq!(served.cost("f", "e"), before, "routes are answered as of the last state");
    assert_eq!(cluster.ask("SELECT count(*) FROM adit.log WHERE changes LIKE '%3.5%'"), ["0"]);
    assert_eq!(cluster.ask("SELECT count(*) FROM adit_then.log WHERE changes LIKE '%3.5%'"), ["0"]);
}
