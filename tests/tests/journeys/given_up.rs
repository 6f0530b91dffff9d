//! What nobody waits for any more is given up before its next stage.

use std::sync::Arc;

use adit::edit::Edit;
use adit::{Code, KnowledgeBase, Live};
use adit_tests::TestSite;

/// A stale preview took a core until its end, and the one that was asked for next waited for it.
#[test]
fn a_preview_is_given_up_once_its_caller_has_gone_and_its_site_is_as_it_was() {
    let site = TestSite::example("clinic").built();
    let live = Live::open(KnowledgeBase::open(site.path()).unwrap()).unwrap();
    let cell = |column: &str, value: &str| {
        let key = site.sqlite3("SELECT robot || '/' || state FROM robots LIMIT 1").remove(0);
        Edit::Set("robots".to_owned(), key, column.to_owned(), value.to_owned())
    };
    for (column, value) in [("hardness", "7"), ("width", "0.41")] {
        let waits = Arc::new(());
        let waited_for = live.fork().waited_for_by(Arc::downgrade(&waits));
        let seen = waited_for.preview(&[cell(column, value)], None).unwrap();
        assert_eq!(seen, live.preview(&[cell(column, value)], None).unwrap());
        let left_alone = live.fork().waited_for_by(Arc::downgrade(&waits));
        drop(waits);
        let given_up = left_alone.preview(&[cell(column, value)], None).unwrap_err();
        assert_eq!(given_up.problems()[0].code(), Some(Code::ServiceLate));
    }
}

/// How firm a route is takes half a minute on a large floor; it took a core for that long whoever had gone.
#[test]
fn how_firm_a_route_is_is_given_up_once_its_caller_has_gone() {
    let site = TestSite::example("clinic").built();
    let live = Live::open(KnowledgeBase::open(site.path()).unwrap()).unwrap();
    let waits = Arc::new(());
    let left_alone = live.fork().waited_for_by(Arc::downgrade(&waits));
    drop(waits);
    let given_up = left_alone.firm("dock", "ward 12", None).unwrap_err();
    assert_eq!(given_up.problems()[0].code(), Some(Code::ServiceLate));
}
