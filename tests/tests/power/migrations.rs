//! The power goes while a database of an older version is brought up to date.

use adit_tests::{Ran, TestSite, repository};

use crate::judge::{Content, Recording, laid_out};
use crate::tape::Recorder;

/// A site whose database is of version 1, built by this program.
fn migrated() -> Recording {
    let site = TestSite::example("paper");
    let fixture = repository().join("db/tests/fixtures/schema-v1.sql");
    site.outside_edit(&format!(".read {}", fixture.display()));
    let disk = Recorder::of(&site);
    Recording::of(&site, &disk, || {
        let built = disk.adit().arg("build").arg(site.path()).output().unwrap();
        Ran::new(&built).expect_status(0);
    })
}

#[test]
fn a_power_cut_leaves_the_old_database_or_a_newer_one_with_a_whole_copy_of_the_old_one_beside_it() {
    let mut newer = 0;
    migrated().after_cuts(30, |_, left| {
        let site = laid_out(left);
        // whoever reads first and may write takes half a transaction back
        site.outside_edit("SELECT count(*) FROM sqlite_schema");
        let version: i32 = site.sqlite3("PRAGMA user_version")[0].parse().unwrap();
        let copy = site.path().join("site.db.bak-v1");
        assert!(copy.exists() || version == 1, "there is no copy beside version {version}");
        if copy.exists() {
            let content = Content::of(&copy);
            let content = content.unwrap_or_else(|damage| panic!("beside version {version}: {damage}"));
            assert!(content.text.contains("INSERT INTO rooms"), "beside version {version}: {}", content.text);
        }
        newer += i32::from(version > 1);
        let is_broken_off = site.path().join("site.db.bak-half").exists();
        if is_broken_off || version > 1 && newer % 8 == 1 {
            site.adit("build", &[]).expect_status(0);
            site.adit("doctor", &[]).expect_status(0);
        }
    });
    assert!((5..30).contains(&newer), "{newer} of 30");
}
