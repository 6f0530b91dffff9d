//! Connections by TLS: as safe as the URL asks, or none.

use adit_tests::TestSite;
use adit_tests::cluster::{Cluster, PASSWORD};

use super::{Served, copy, squat};

#[test]
fn a_connection_is_as_safe_as_the_url_asks_or_there_is_none() {
    let (cluster, site) = (Cluster::start(), TestSite::example("paper").built());
    let folder = site.path().display().to_string();
    let tcp = cluster.tcp(PASSWORD, "paper");
    let refused = |url: &str, said: &[&str]| {
        copy(&[&folder, url]).expect_status(2).complains(said);
    };
    refused(&format!("{tcp}&sslmode=require"), &["postgres/tls", "server does not support TLS"]);

    let voucher = cluster.secure();
    let verified = format!("{tcp}&sslmode=verify-full&sslrootcert={}", voucher.display());
    copy(&[&folder, &verified]).expect_status(0);
    let served = Served::start(&verified);
    let before = served.cost("f", "e");
    let (status, edited) = served.service.ask("POST", "/api/edits", Some(&squat(2.0)));
    assert_eq!(status, 200, "{edited}");
    assert!(served.cost("f", "e").0 > before.0);
    let ours = "SELECT count(*) > 0 AND bool_and(ssl) FROM pg_stat_ssl JOIN pg_stat_activity USING (pid) \
                WHERE application_name = 'adit'";
    assert_eq!(cluster.ask(ours), ["t"], "all that the service says goes by TLS");

    // certificates of this machine vouch for others
    refused(&format!("{tcp}&sslmode=verify-full"), &["postgres/tls", "UnknownIssuer"]);
    // it is certified as 127.0.0.1
    let elsewhere = |mode: &str| verified.replace("127.0.0.1", "localhost").replace("verify-full", mode);
    refused(&elsewhere("verify-full"), &["postgres/tls", "localhost"]);
    refused(&elsewhere("verify-ca"), &["postgres/site-exists"]);
    refused(&format!("{tcp}&sslmod=require"), &["postgres/url", "it has no `sslmod`", "sslmode"]);
}
