//! Many sites in one database: each is reached by keys that begin with its name, and costs what it costs alone.

use std::time::{Duration, Instant};

use adit_tests::TestSite;
use adit_tests::cluster::Cluster;
use serde_json::json;

use super::{Served, copy, soon, squat};

/// Puts copies of a site beside it, `NAME-1` to `NAME-NUMBER`, as `adit copy` of each would, but faster.
fn multiply(cluster: &Cluster, site: &str, number: usize) {
    let tables = cluster.ask(
        "SELECT c.table_name, string_agg(quote_ident(c.column_name), ', ' ORDER BY c.ordinal_position)
         FROM information_schema.columns c JOIN information_schema.tables t USING (table_schema, table_name)
         WHERE table_schema = 'adit' AND table_type = 'BASE TABLE' AND c.column_name <> 'site' AND table_name <> 'version'
         GROUP BY 1",
    );
    for table in tables {
        let (table, columns) = table.split_once('|').unwrap();
        let sql = format!(
            "INSERT INTO adit.{table} (site, {columns}) SELECT '{site}-' || n, {columns}
             FROM generate_series(1, {number}) AS n CROSS JOIN adit.{table} WHERE site = '{site}' ORDER BY n"
        );
        cluster.ask(&sql);
    }
}

/// What reads or writes rows of sites without their key, among the plans that PostgreSQL was told to log.
fn without_key(log: &str) -> Vec<&str> {
    let of_ours = |line: &&str| ![" pg_", "relname = ", "nspname = "].iter().any(|of| line.contains(of));
    let scans = log.lines().map(str::trim).filter(of_ours);
    let is_without = |line: &&str| {
        let is_whole = line.contains("Seq Scan on ");
        let is_by_key = line.split_once("Index Cond: ").is_some_and(|(_, by)| !by.contains("site = "));
        (is_whole || is_by_key) && !line.contains("one = 1")
    };
    scans.filter(is_without).collect()
}

/// Has PostgreSQL log the plan of each statement, and read a table whole only where there is no key.
const EXPLAINED: &str =
    "-c session_preload_libraries=auto_explain -c auto_explain.log_min_duration=0 -c enable_seqscan=off";

#[test]
fn all_that_is_read_and_written_of_a_site_is_reached_by_keys_that_begin_with_its_name() {
    let cluster = Cluster::start_with(EXPLAINED);
    let site = TestSite::example("paper");
    site.copy_rules_and_tests("paper");
    let site = site.built();
    site.outside_edit("CREATE TABLE own (a, b TEXT); INSERT INTO own VALUES (1, 'x'), (2, 'y')");
    let folder = site.path().display().to_string();
    copy(&[&folder, &cluster.url("paper")]).expect_status(0);
    multiply(&cluster, "paper", 50);
    cluster.ask("ANALYZE");
    let before = cluster.log().len();

    let (one, other) = (Served::start(&cluster.url("paper-7")), Served::start(&cluster.url("paper-7")));
    // so often that PostgreSQL makes plans for any values
    for round in 0..17 {
        one.edit(&squat(2.0 + f64::from(round)));
    }
    other.edit(&json!({"edit": {"kind": "undo"}}));
    other.edit(&json!({"edit": {"kind": "tell", "class": "DOORS", "object": "door 3", "property": "hardness", "value": 50.0}}));
    let (_, rules) = one.service.ask("GET", "/api/rules", None);
    let file = rules["files"].as_array().unwrap().iter().find(|file| file["file"] == "doors.rhai").unwrap();
    let body = json!({"text": format!("{}\n// saved\n", file["text"].as_str().unwrap()), "version": file["version"]});
    assert_eq!(one.service.ask("PUT", "/api/rules/doors.rhai", Some(&body)).0, 200);
    soon(Duration::from_secs(3), || one.generation() == other.generation());
    let back = TestSite::empty();
    copy(&[&cluster.url("paper-8"), &back.path().display().to_string()]).expect_status(0);
    copy(&[&folder, &cluster.url("paper-9"), "--replace"]).expect_status(0);
    drop((one, other));

    let log = cluster.log().split_off(before);
    assert!(log.matches("Index Cond: ").count() > 100, "{log}");
    for table in ["own_rows", "files", "log", "sites", "robots", "sequences"] {
        let names = [format!("adit.{table}"), format!("adit.\"{table}\"")];
        assert!(names.iter().any(|name| log.contains(name)), "nothing was asked of {table}");
    }
    let without = without_key(&log);
    assert!(without.is_empty(), "{}", without.join("\n"));
}

/// What things take in one database.
#[derive(Default)]
struct Taken {
    opened: Vec<Duration>,
    edited: Vec<Duration>,
    answered: Vec<Duration>,
    copied: Vec<Duration>,
}

fn median(mut of: Vec<Duration>) -> f64 {
    of.sort();
    of[of.len() / 2].as_secs_f64() * 1e3
}

fn timed<T>(into: &mut Vec<Duration>, what: impl FnOnce() -> T) -> T {
    let began = Instant::now();
    let done = what();
    into.push(began.elapsed());
    done
}

/// A site alone in a cluster, and a thousand of it in another one, of which each round takes another. `ADIT_SITES` says how many,
/// `ADIT_EXAMPLE` of which example.
#[test]
#[ignore = "minutes; cargo test --workspace --release --test postgres thousand_sites -- --ignored --nocapture"]
fn of_a_thousand_sites_each_costs_what_it_costs_alone() {
    const ROUNDS: usize = 15;
    let number = std::env::var("ADIT_SITES").map_or(1_000, |number| number.parse().unwrap());
    let example = std::env::var("ADIT_EXAMPLE").unwrap_or_else(|_| "clinic".to_owned());
    let (alone, among) = (Cluster::start(), Cluster::start());
    let site = TestSite::example(&example).built();
    for cluster in [&alone, &among] {
        copy(&[&site.path().display().to_string(), &cluster.url(&example)]).expect_status(0);
    }
    let began = Instant::now();
    multiply(&among, &example, number - 1);
    println!("{number} sites are there after {:.0} s", began.elapsed().as_secs_f64());
    for cluster in [&alone, &among] {
        cluster.ask("VACUUM ANALYZE");
        cluster.ask("CHECKPOINT");
        println!("{}", cluster.ask("SELECT pg_size_pretty(pg_database_size('plant'))").concat());
    }
    let state = site.sqlite3("SELECT state FROM robots ORDER BY position LIMIT 1").remove(0);
    let ends = site.sqlite3("SELECT place FROM places ORDER BY place LIMIT 2");
    let ends = ends.join("&goal=").replace(' ', "%20");
    let mut taken = [Taken::default(), Taken::default()];
    for round in 0..ROUNDS {
        let other = format!("{example}-{}", 1 + round * (number - 1) / ROUNDS);
        for (url, taken) in [alone.url(&example), among.url(&other)].iter().zip(&mut taken) {
            let served = timed(&mut taken.opened, || Served::start(url));
            let ask = || served.service.ask("GET", &format!("/api/route?start={ends}"), None).0;
            assert_eq!(ask(), 200);
            for again in 0..20 {
                let value = 2.0 + f64::from(again) / 1e3 + round as f64 / 10.0;
                let edit = json!({"edit": {"kind": "set", "table": "robots", "key": state, "column": "hardness", "value": value}});
                timed(&mut taken.edited, || served.edit(&edit));
                timed(&mut taken.answered, ask);
            }
            drop(served);
            let back = TestSite::empty();
            let back = back.path().display().to_string();
            timed(&mut taken.copied, || copy(&[url, &back]).expect_status(0));
        }
    }
    let [alone, among] = taken;
    let mut worst = 0.0;
    for (what, alone, among) in [
        ("opened", alone.opened, among.opened),
        ("an edit", alone.edited, among.edited),
        ("an answer", alone.answered, among.answered),
        ("copied out", alone.copied, among.copied),
    ] {
        let (alone, among) = (median(alone), median(among));
        println!("{what}: {alone:.2} ms alone, {among:.2} ms among {number}: {:.2} times", among / alone);
        worst = f64::max(worst, among / alone);
    }
    assert!(worst <= 1.2, "{worst:.2} times");
}
