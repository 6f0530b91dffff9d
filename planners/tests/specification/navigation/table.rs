//! A judge as a plain table, for tests. What ships is written as rules: a row here is a row there.
//!
//! The first row that holds decides. `reach` is the smaller one of `distance_m` and `look_ahead_m`.
//!
//! Astray is: `contradicted` > `most_contradicted` or `unexplained` > `most_unexplained`. Unsure is: `sigma_m` > `sure_m` or
//! `sigma_heading` > `sure_heading`.
//!
//! | doubt   | if                                                     |
//! |---------|--------------------------------------------------------|
//! |         | has_walls is false                                     |
//! | Lost    | astray, searches >= most_searches                      |
//! | Match   | astray, is_matched is false                            |
//! | Search  | astray, is_searched is false                           |
//! | Look    | astray                                                 |
//! | Match   | unsure, is_matched is false                            |
//! | Unsure  | unsure                                                 |
//! |         | otherwise                                              |
//!
//! | state   | if                                                     | next    | action   |
//! |---------|--------------------------------------------------------|---------|----------|
//! | Hold    | mode is Manual                                         | Hold    |          |
//! | Hold    | has_way is false                                       | Blocked |          |
//! | Hold    | is_changing, has_room is false                         | Blocked |          |
//! | Hold    | is_changing                                            | Hold    |          |
//! | Hold    | has_goal                                               | Decide  |          |
//! | Hold    | otherwise                                              | Hold    |          |
//! | Decide  | has_goal is false                                      | Hold    |          |
//! | Decide  | scans = 0                                              | Wait    |          |
//! | Decide  | doubt is Lost                                          | Hold    | Lost     |
//! | Decide  | doubt is Search                                        | Decide  | Search   |
//! | Decide  | doubt is Look                                          | Wait    |          |
//! | Decide  | doubt is Match                                         | Decide  | Match    |
//! | Decide  | is_aside without doubt                                 | Decide  | Resume   |
//! | Decide  | is_changing                                            | Hold    |          |
//! | Decide  | Unsure, distance_m <= goal_tolerance_m, seeks < most   | Decide  | Seek     |
//! | Decide  | Unsure, distance_m <= goal_tolerance_m, is_last        | Hold    | Lost     |
//! | Decide  | distance_m <= goal_tolerance_m                         | Hold    |          |
//! | Decide  | is_contact                                             | Blocked |          |
//! | Decide  | free_m < reach                                         | Blocked |          |
//! | Decide  | heading_error > turning_resolution                     | Turn    |          |
//! | Decide  | otherwise                                              | Move    |          |
//! | Turn    | is_contact                                             | Blocked |          |
//! | Turn    | is_busy                                                | Turn    |          |
//! | Turn    | heading_error > turning_resolution                     | Turn    |          |
//! | Turn    | otherwise                                              | Wait    |          |
//! | Move    | is_contact                                             | Blocked |          |
//! | Move    | distance_m <= goal_tolerance_m, is_last and has_walls  | Wait    |          |
//! | Move    | distance_m <= goal_tolerance_m                         | Hold    |          |
//! | Move    | is_falling is false                                    | Wait    |          |
//! | Move    | off_line_m > highway_half_width_m                      | Wait    |          |
//! | Move    | free_m < reach                                         | Blocked |          |
//! | Move    | echo_m < reach and echo_m < 1                          | Wait    |          |
//! | Move    | is_busy                                                | Move    |          |
//! | Move    | otherwise                                              | Wait    |          |
//! | Wait    | is_scan_complete                                       | Decide  |          |
//! | Wait    | otherwise                                              | Wait    |          |
//! | Blocked | is_busy                                                | Blocked |          |
//! | Blocked | is_contact and back_offs < most_back_offs              | Blocked | BackOff  |
//! | Blocked | is_scan_complete is false                              | Wait    |          |
//! | Blocked | mode is Learn                                          | Hold    | NoWay    |
//! | Blocked | as without a way: mode is Route, closed_here >= most_reports |   |          |
//! | Blocked | doubt is Lost                                          | Hold    | Lost     |
//! | Blocked | doubt is Search                                        | Decide  | Search   |
//! | Blocked | doubt is Look                                          | Wait    |          |
//! | Blocked | doubt is Match                                         | Decide  | Match    |
//! | Blocked | has_way is false, is_aside without doubt               | Decide  | Resume   |
//! | Blocked | has_way is false and retries < most_retries            | Decide  | Retry    |
//! | Blocked | has_way, is_shut are false, time_s < no_way_after_s    | Decide  | Retry    |
//! | Blocked | has_way is false, Unsure, seeks < most_seeks           | Decide  | Seek     |
//! | Blocked | has_way is false, Unsure                               | Hold    | Lost     |
//! | Blocked | has_way is false, searches > 0                         | Hold    | Lost     |
//! | Blocked | has_way is false                                       | Hold    | NoWay    |
//! | Blocked | is_obstacle_moving and waits < most_waits              | Wait    |          |
//! | Blocked | is_changing, has_room is false                         | Decide  | Close    |
//! | Blocked | detours_here >= most_detours                           | Decide  | Close    |
//! | Blocked | left_m is the smaller one, or the only one             | Decide  | Left     |
//! | Blocked | right_m is known                                       | Decide  | Right    |
//! | Blocked | otherwise                                              | Decide  | Close    |

use std::f64::consts::FRAC_PI_4;

use adit_planners::local_model::{SegmentFacts, Source, Transition};
use adit_planners::navigation::learn::{Guide, OpeningFacts};
use adit_planners::navigation::{Action, Judge, Mode, State, StateDecision, StateFacts, WayFacts};

/// The table.
#[derive(Clone, Copy, Debug, Default)]
pub struct Table;

impl Judge for Table {
    fn next_state(&mut self, facts: &StateFacts) -> StateDecision {
        let (state, action) = row(facts);
        StateDecision { state, action }
    }

    fn segment(&mut self, facts: &SegmentFacts) -> Transition {
        segment(facts)
    }

    fn weigh(&mut self, facts: &WayFacts) -> Option<f64> {
        (!facts.is_cut).then(|| facts.way.length * (1.0 + f64::from(facts.times_blocked)))
    }
}

impl Guide for Table {
    fn opening(&mut self, facts: &OpeningFacts) -> Option<f64> {
        let is_asked = facts.off_asked.is_some_and(|off| off <= FRAC_PI_4);
        match facts {
            OpeningFacts { width_m, .. } if *width_m < 0.25 => None,
            OpeningFacts { times_tried: 3.., .. } => None,
            _ if is_asked => Some(1000.0 - facts.distance_m),
            OpeningFacts { is_in_sight: true, .. } => Some(500.0 - facts.distance_m),
            _ => Some(facts.width_m - 0.2 * facts.distance_m),
        }
    }
}

/// What is to be done about where the robot is.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Doubt {
    None,
    Lost,
    Search,
    Look,
    Match,
    Unsure,
}

fn doubt(facts: &StateFacts) -> Doubt {
    let settings = &facts.settings;
    let is_astray =
        facts.contradicted > settings.most_contradicted || facts.unexplained > settings.most_unexplained;
    match () {
        () if !facts.has_walls => Doubt::None,
        () if is_astray && facts.searches >= settings.most_searches => Doubt::Lost,
        () if is_astray && !facts.is_matched => Doubt::Match,
        () if is_astray && !facts.is_searched => Doubt::Search,
        () if is_astray => Doubt::Look,
        () if facts.sigma_m <= settings.sure_m && facts.sigma_heading <= settings.sure_heading => Doubt::None,
        () if !facts.is_matched => Doubt::Match,
        () => Doubt::Unsure,
    }
}

#[expect(clippy::match_same_arms, reason = "an arm is a row of the table")]
fn row(facts: &StateFacts) -> (State, Action) {
    let settings = &facts.settings;
    let reach = facts.distance_m.min(settings.look_ahead_m) - 1e-6;
    let is_there = facts.distance_m <= settings.goal_tolerance_m;
    let is_turned = facts.heading_error <= settings.turning_resolution;
    let (doubt, may_seek) = (doubt(facts), facts.seeks < settings.most_seeks);
    let state = match facts.state {
        State::Hold if facts.mode == Mode::Manual => State::Hold,
        State::Hold if !facts.has_way => State::Blocked,
        State::Hold if facts.is_changing && !facts.has_room => State::Blocked,
        State::Hold if facts.is_changing => State::Hold,
        State::Hold if facts.has_goal => State::Decide,
        State::Hold => State::Hold,
        State::Decide if !facts.has_goal => State::Hold,
        State::Decide if facts.scans == 0 => State::Wait,
        State::Decide if doubt == Doubt::Lost => return (State::Hold, Action::Lost),
        State::Decide if doubt == Doubt::Search => return (State::Decide, Action::Search),
        State::Decide if doubt == Doubt::Look => State::Wait,
        State::Decide if doubt == Doubt::Match => return (State::Decide, Action::Match),
        State::Decide if doubt == Doubt::None && facts.is_aside => return (State::Decide, Action::Resume),
        State::Decide if facts.is_changing => State::Hold,
        State::Decide if doubt == Doubt::Unsure && is_there && may_seek => {
            return (State::Decide, Action::Seek);
        }
        State::Decide if doubt == Doubt::Unsure && is_there && facts.is_last => {
            return (State::Hold, Action::Lost);
        }
        State::Decide if is_there => State::Hold,
        State::Decide if facts.is_contact || facts.free_m < reach => State::Blocked,
        State::Decide if !is_turned => State::Turn,
        State::Decide => State::Move,
        State::Turn if facts.is_contact => State::Blocked,
        State::Turn if facts.is_busy || !is_turned => State::Turn,
        State::Turn => State::Wait,
        State::Move if facts.is_contact => State::Blocked,
        State::Move if is_there && facts.is_last && facts.has_walls => State::Wait,
        State::Move if is_there => State::Hold,
        State::Move if !facts.is_falling || facts.off_line_m > settings.highway_half_width_m => State::Wait,
        State::Move if facts.free_m < reach => State::Blocked,
        State::Move if facts.echo_m < reach.min(1.0) => State::Wait,
        State::Move if facts.is_busy => State::Move,
        State::Move => State::Wait,
        State::Wait if facts.is_scan_complete => State::Decide,
        State::Wait => State::Wait,
        State::Blocked => return blocked(facts),
    };
    (state, Action::None)
}

fn blocked(facts: &StateFacts) -> (State, Action) {
    let settings = &facts.settings;
    let is_early =
        facts.retries < settings.most_retries || facts.time_s < settings.no_way_after_s && !facts.is_shut;
    let leads_on =
        facts.has_way && !(facts.mode == Mode::Route && facts.closed_here >= settings.most_reports);
    let (doubt, may_seek) = (doubt(facts), facts.seeks < settings.most_seeks);
    let is_left = facts.left_m.is_some_and(|left| facts.right_m.is_none_or(|right| left <= right));
    match () {
        () if facts.is_busy => (State::Blocked, Action::None),
        () if facts.is_contact && facts.back_offs < settings.most_back_offs => {
            (State::Blocked, Action::BackOff)
        }
        () if !facts.is_scan_complete => (State::Wait, Action::None),
        () if facts.mode == Mode::Learn => (State::Hold, Action::NoWay),
        () if doubt == Doubt::Lost => (State::Hold, Action::Lost),
        () if doubt == Doubt::Search => (State::Decide, Action::Search),
        () if doubt == Doubt::Look => (State::Wait, Action::None),
        () if doubt == Doubt::Match => (State::Decide, Action::Match),
        () if !leads_on && doubt == Doubt::None && facts.is_aside => (State::Decide, Action::Resume),
        () if !leads_on && is_early => (State::Decide, Action::Retry),
        () if !leads_on && doubt == Doubt::Unsure && may_seek => (State::Decide, Action::Seek),
        () if !leads_on && doubt == Doubt::Unsure => (State::Hold, Action::Lost),
        () if !leads_on && facts.searches > 0 => (State::Hold, Action::Lost),
        () if !leads_on => (State::Hold, Action::NoWay),
        () if facts.is_obstacle_moving && facts.waits < settings.most_waits => (State::Wait, Action::None),
        () if facts.is_changing && !facts.has_room => (State::Decide, Action::Close),
        () if facts.detours_here >= settings.most_detours => (State::Decide, Action::Close),
        () if is_left => (State::Decide, Action::Left),
        () if facts.right_m.is_some() => (State::Decide, Action::Right),
        () => (State::Decide, Action::Close),
    }
}

/// The state table of segments. A surface that was seen often enough is not taken for one that moves: sides of a box that
/// come into sight one after the other look as if it did.
fn segment(facts: &SegmentFacts) -> Transition {
    let is_recalled = facts.source == Source::RECALLED;
    let confidence = match facts {
        SegmentFacts { confidence: 0, .. } if is_recalled => 5,
        SegmentFacts { confidence: 0, .. } => 1,
        SegmentFacts { is_moving: true, is_matched: false, confidence: ..=2, .. } => 0,
        SegmentFacts { is_moving: true, confidence: ..=2, .. } => 1,
        SegmentFacts { is_seen_free: true, is_matched: false, .. } => facts.confidence.saturating_sub(2),
        SegmentFacts { is_matched: true, .. } => (facts.confidence + 1).min(5),
        SegmentFacts { is_visible: true, beams_on: 0, .. } => facts.confidence - 1,
        _ => facts.confidence,
    };
    Transition {
        confidence,
        source: facts.source,
        is_kept: confidence > 0 && (is_recalled || facts.is_learning || facts.distance_m <= 15.0),
        counts_for_pose: (!facts.is_moving || confidence > 2) && confidence >= 2,
        is_anchored: is_recalled,
        is_cut: !is_recalled && facts.free_m > 0.2,
    }
}
