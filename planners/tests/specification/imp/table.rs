//! A state table for tests. What ships is written as rules.

use adit_planners::local_model::{SegmentFacts, Source, Transition};

/// Segments farther away are forgotten, metres.
pub const FAR_M: f64 = 15.0;

/// The table of the tests, for a local model.
pub fn table(facts: &SegmentFacts) -> Transition {
    let remembered = remembering(facts);
    Transition { is_kept: remembered.is_kept && facts.distance_m <= FAR_M, ..remembered }
}

/// The same for a robot that learns a building: what is far stays.
pub fn remembering(facts: &SegmentFacts) -> Transition {
    let is_recalled = facts.source == Source::RECALLED;
    let confidence = match facts {
        SegmentFacts { confidence: 0, .. } if is_recalled => 5,
        SegmentFacts { confidence: 0, .. } => 1,
        SegmentFacts { is_moving: true, is_matched: false, .. } => 0,
        SegmentFacts { is_moving: true, .. } => 1,
        SegmentFacts { is_seen_free: true, is_matched: false, .. } => facts.confidence.saturating_sub(2),
        SegmentFacts { is_matched: true, .. } => (facts.confidence + 1).min(5),
        SegmentFacts { is_visible: true, .. }
            if facts.beams_on <= facts.beams_through || facts.confidence < 3 =>
        {
            facts.confidence - 1
        }
        _ => facts.confidence,
    };
    Transition {
        confidence,
        source: facts.source,
        is_kept: confidence > 0,
        counts_for_pose: !facts.is_moving && confidence >= 2,
        is_anchored: is_recalled,
        is_cut: !is_recalled && facts.free_m > 0.2,
    }
}
