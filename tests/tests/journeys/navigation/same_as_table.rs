//! The shipped rules say in every situation what the table says that the planners' missions are judged by: what holds there
//! holds for the rules.

use std::path::Path;
use std::sync::{Arc, OnceLock};

use adit::navigation::judge::RuleJudge;
use adit::plan::rules::{self, Kind};
use adit_engine::RuleBase;
use adit_planners::floor_plan::{Spot, Way};
use adit_planners::local_model::{SegmentFacts, SegmentId, Source};
use adit_planners::navigation::{Judge, Mode, Settings, State, StateFacts, WayFacts};
use proptest::prelude::*;

use super::table::Table;

fn judge() -> RuleJudge {
    static RULES: OnceLock<Arc<RuleBase>> = OnceLock::new();
    let load = || rules::load(Kind::Navigation, "navigation", Path::new("")).expect("a shipped rule base").0;
    RuleJudge::new(RULES.get_or_init(load)).expect("rules")
}

fn states() -> impl Strategy<Value = State> {
    prop::sample::select(vec![
        State::Hold,
        State::Decide,
        State::Turn,
        State::Move,
        State::Wait,
        State::Blocked,
    ])
}

/// Lengths and angles about the tolerances, and on them.
fn near(of: f64) -> impl Strategy<Value = f64> {
    (0_i32..6).prop_map(move |steps| of * f64::from(steps) / 2.0)
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(2_000))]

    #[test]
    fn figure_5(
        state in states(),
        [a, b, c, d, e, f, g, h] in prop::array::uniform8(any::<bool>()),
        [is_changing, has_room] in prop::array::uniform2(any::<bool>()),
        mode in prop::sample::select(vec![Mode::Automatic, Mode::Route, Mode::Learn, Mode::Manual]),
        distance_m in near(1.5),
        heading_error in near(0.02),
        off_line_m in near(0.1),
        free_m in near(1.5),
        echo_m in near(0.5),
        left_m in prop::option::of(near(1.0)),
        right_m in prop::option::of(near(1.0)),
        [detours_here, waits, retries, scans, back_offs] in prop::array::uniform5(0_u32..6),
        closed_here in 0_u32..12,
        time_s in near(600.0),
        [has_walls, is_matched, is_searched, is_aside, is_last] in prop::array::uniform5(any::<bool>()),
        [contradicted, searches, seeks] in prop::array::uniform3(0_u32..8),
        sigma_m in near(0.06),
        sigma_heading in near(5.0_f64.to_radians()),
        unexplained in near(0.5),
    ) {
        let facts = StateFacts {
            mode,
            state,
            has_goal: a,
            distance_m,
            is_falling: b,
            heading_error,
            off_line_m,
            free_m,
            echo_m,
            is_obstacle_moving: c,
            is_contact: d,
            is_busy: e,
            is_changing,
            has_room,
            is_scan_complete: f,
            left_m,
            right_m,
            detours_here,
            closed_here,
            waits,
            scans,
            back_offs,
            time_s,
            has_way: g,
            is_shut: h,
            retries,
            sigma_m,
            sigma_heading,
            has_walls,
            unexplained,
            contradicted,
            is_matched,
            is_searched,
            searches,
            is_aside,
            seeks,
            is_last,
            settings: Settings::default(),
        };
        let mut judge = judge();
        prop_assert!(judge.is_direct());
        prop_assert_eq!(judge.next_state(&facts), Table.next_state(&facts));
        prop_assert_eq!(judge.trouble(), None);
    }

    #[test]
    fn segments(
        source in prop::sample::select(vec![Source::SONAR, Source::CONTACT, Source::RECALLED]),
        confidence in 0_u8..6,
        [is_matched, is_visible, is_seen_free, is_moving, is_learning] in prop::array::uniform5(any::<bool>()),
        [beams_on, beams_through, age, unseen] in prop::array::uniform4(0_u32..4),
        [free_m, distance_m] in [near(0.1), near(15.0)],
    ) {
        let facts = SegmentFacts {
            id: SegmentId(1),
            source,
            confidence,
            is_matched,
            is_visible,
            is_seen_free,
            is_moving,
            beams_on,
            beams_through,
            free_m,
            age,
            unseen,
            distance_m,
            length_m: 1.0,
            sigma_m: 0.01,
            is_learning,
        };
        let mut judge = judge();
        prop_assert_eq!(judge.segment(&facts), Table.segment(&facts));
        prop_assert_eq!(judge.trouble(), None);
    }

    #[test]
    fn ways(length in near(4.0), times_blocked in 0_u32..5, is_cut in any::<bool>()) {
        let way = Way {
            from: Spot::Start,
            to: Spot::Goal,
            length,
            clearance: 0.4,
            doorway: None,
            region: Some(0),
            points: Vec::new(),
        };
        let facts = WayFacts { way: &way, is_cut, times_blocked };
        prop_assert_eq!(judge().weigh(&facts), Table.weigh(&facts));
    }
}
