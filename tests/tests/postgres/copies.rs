//! A site with its history, its files and whatever somebody made in its database, into PostgreSQL and back.

use adit_tests::TestSite;
use adit_tests::cluster::Cluster;

use super::copy;

/// All that is in a database, but for what is the same rows once more.
fn content(site: &TestSite) -> Vec<String> {
    let dump =
        std::process::Command::new("sqlite3").arg(site.path().join("site.db")).arg(".dump").output().unwrap();
    let text = String::from_utf8(dump.stdout).unwrap();
    let mut lines: Vec<String> =
        text.lines().filter(|line| !line.starts_with("INSERT INTO blocks")).map(str::to_owned).collect();
    lines.sort();
    lines
}

fn there_and_back(cluster: &Cluster, site: &TestSite, name: &str) -> TestSite {
    copy(&[&site.path().display().to_string(), &cluster.url(name)]).expect_status(0);
    let back = TestSite::empty();
    copy(&[&cluster.url(name), &back.path().display().to_string()]).expect_status(0);
    back
}

#[test]
fn a_site_comes_back_with_every_row_every_file_and_its_history() {
    let cluster = Cluster::start();
    let paper = TestSite::example("paper").built();
    paper.adit("tune", &["robots", "SQUAT", "hardness", "3", "--why", "a ' and a \\ and ß"]).expect_status(0);
    paper.adit("tell", &["ROOMS", "d", "hardness", "2"]);
    paper.adit("lay", &["wet floor", "--area", "hazard", "1,1", "3,1", "3,3"]);
    paper.adit("undo", &[]).expect_status(0);
    paper.outside_edit(
        "CREATE TABLE own (a, b TEXT); INSERT INTO own VALUES (1, 'x'), (1.0, NULL), (x'00ff', ''), (9e999, 'y'), (-0.0, 'z');
         DELETE FROM own WHERE b = ''; CREATE INDEX own_a ON own (a); CREATE VIEW own_too AS SELECT a FROM own;
         CREATE TABLE keyed (k TEXT, n INTEGER, v REAL, PRIMARY KEY (k, n)) WITHOUT ROWID;
         INSERT INTO keyed VALUES ('a', 1, 0.1), ('a', 2, 1e300);
         CREATE TRIGGER own_trigger AFTER INSERT ON own BEGIN INSERT INTO keyed VALUES (NEW.b, 3, 1.5); END",
    );
    let depot = TestSite::example("depot").built();
    for (name, site) in [("paper", paper), ("a depot / ü", depot)] {
        let back = there_and_back(&cluster, &site, &name.replace(' ', "%20"));
        let (before, after) = (content(&site), content(&back));
        let differs = before.iter().zip(&after).find(|(one, other)| one != other);
        assert!(before == after, "{differs:?}");
        assert!(before.len() > 500);
        let history = "SELECT * FROM history ORDER BY id";
        assert_eq!(site.sqlite3(history), back.sqlite3(history));
        for entry in std::fs::read_dir(site.path()).unwrap() {
            let file = entry.unwrap().file_name().into_string().unwrap();
            if !file.contains(".db") && site.path().join(&file).is_file() {
                assert_eq!(site.read(&file), back.read(&file), "{file}");
            }
        }
        // it is a site as any other
        back.adit("build", &[]).expect_status(0);
    }
}

#[test]
fn a_site_is_replaced_only_where_that_is_asked_for() {
    let cluster = Cluster::start();
    let site = TestSite::example("paper").built();
    let (folder, url) = (site.path().display().to_string(), cluster.url("paper"));
    copy(&[&folder, &url]).expect_status(0);
    copy(&[&folder, &url])
        .expect_status(2)
        .complains(&["postgres/site-exists", "has a site `paper` already"]);
    site.adit("tune", &["robots", "SQUAT", "hardness", "3"]).expect_status(0);
    copy(&[&folder, &url, "--replace"]).expect_status(0);
    assert_eq!(cluster.ask("SELECT hardness FROM adit.robots WHERE state = 'SQUAT'"), ["3"]);
    let back = TestSite::empty();
    std::fs::write(back.path().join("mine"), "").unwrap();
    let back = back.path().display().to_string();
    copy(&[&url, &back]).expect_status(2).complains(&["site/exists", "is not empty"]);
}
