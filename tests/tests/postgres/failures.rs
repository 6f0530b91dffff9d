//! What is wrong is said with its code, in words.

use adit_tests::TestSite;
use adit_tests::cluster::PASSWORD;
use adit_tests::service::Service;

use super::{Served, copy, squat, with_site};

#[test]
fn whatever_keeps_a_site_from_being_copied_or_served_is_said() {
    let (cluster, site) = with_site("paper");
    let folder = site.path().display().to_string();
    let back = TestSite::empty();
    let out = back.path().join("back").display().to_string();
    let refused = |url: &str, said: &[&str]| {
        copy(&[url, &out]).expect_status(2).complains(said);
        let empty = TestSite::empty();
        Service::refused(&empty, &["--database", url]).expect_status(2).complains(said);
        assert!(!back.path().join("back").exists(), "nothing half is left");
    };
    refused("postgres://localhost:nine/plant", &["postgres/url", "no URL of a PostgreSQL database"]);
    refused(
        "postgres://adit@127.0.0.1:1/plant?site=paper",
        &["postgres/unreachable", "plant at 127.0.0.1:1"],
    );
    refused(&cluster.tcp("wrong", "paper"), &["postgres/let-in", "password"]);
    refused(&cluster.url("papr"), &["postgres/unknown-site", "has no site `papr`; it has paper"]);
    refused(&cluster.url_as("nobody", "paper"), &["postgres/let-in", "nobody"]);
    cluster.ask("CREATE ROLE poor LOGIN");
    refused(&cluster.url_as("poor", "paper"), &["postgres/rights"]);
    let poor = cluster.url_as("poor", "other");
    copy(&[&folder, &poor]).expect_status(2).complains(&["postgres/rights"]);
    copy(&[&folder, &out]).expect_status(2).complains(&["postgres/url", "one of the two"]);
    // by TCP, with the right one
    copy(&[&cluster.tcp(PASSWORD, "paper"), &out]).expect_status(0);
    std::fs::remove_dir_all(&out).unwrap();
    let secret = copy(&[&cluster.tcp("s3cret-w0rd", "paper"), &out]);
    assert!(![secret.stdout, secret.stderr].concat().contains("s3cret-w0rd"), "a password is not printed");

    cluster.ask("UPDATE adit.version SET version = version + 1");
    refused(&cluster.url("paper"), &["postgres/version", "this program knows version"]);
    copy(&[&folder, &cluster.url("new")]).expect_status(2).complains(&["postgres/version"]);
    cluster.ask("DROP SCHEMA adit CASCADE");
    refused(&cluster.url("paper"), &["postgres/unknown-site", "holds no sites"]);
}

#[test]
fn files_that_are_not_the_sites_are_neither_lost_nor_taken() {
    let (cluster, site) = with_site("paper");
    site.edit("map.toml", "height = 15.0", "height = 14.0");
    let url = cluster.url("paper");
    Service::refused(&site, &["--database", &url])
        .expect_status(2)
        .complains(&["postgres/files", "map.toml"]);
    let outside = TestSite::example("paper");
    let file = outside.path().join("map.toml");
    let elsewhere = TestSite::empty();
    std::fs::rename(&file, elsewhere.path().join("map.toml")).unwrap();
    outside.edit("site.toml", "map.toml", &elsewhere.path().join("map.toml").display().to_string());
    copy(&[&outside.path().display().to_string(), &cluster.url("outside")])
        .expect_status(2)
        .complains(&["postgres/files", "is not in the site's folder"]);
}

#[test]
fn while_the_database_is_gone_routes_are_answered_and_edits_are_refused() {
    let (cluster, _site) = with_site("paper");
    let served = Served::start(&cluster.url("paper"));
    let before = served.cost("f", "e");
    cluster.kill();
    let (status, refused) = served.service.ask("POST", "/api/edits", Some(&squat(2.0)));
    assert_eq!((status, refused["error"]["code"].as_str()), (503, Some("postgres/unreachable")), "{refused}");
    assert_eq!(served.cost("f", "e"), before);
    super::soon(std::time::Duration::from_secs(3), || {
        let said = served.service.ask("GET", "/api/site", None).1["problems"].to_string();
        said.contains("postgres/unreachable")
    });
    for _ in 0..20 {
        let (_, site) = served.service.ask("GET", "/api/site", None);
        assert_eq!(
            site["problems"][0]["code"], "postgres/unreachable",
            "it is said as long as it is so: {site}"
        );
        std::thread::sleep(std::time::Duration::from_millis(100));
    }
    cluster.up();
    super::soon(std::time::Duration::from_secs(5), || {
        served.service.ask("POST", "/api/edits", Some(&squat(2.0))).0 == 200
    });
    super::soon(std::time::Duration::from_secs(3), || {
        served.service.ask("GET", "/api/site", None).1["problems"].as_array().unwrap().is_empty()
    });
    drop(cluster);
}
