//! What becomes of each segment, as the state table says.

use super::super::{LocalModel, ModelSegment, SegmentFacts, Transition};
use super::Update;
use super::looking::Look;

impl LocalModel {
    /// Asks the state table about segments, and does what it says: about each one that is new, that moves or of which the
    /// scan shows something, and about some of the others, in turn. Beams through a segment show something once they are as many
    /// as make it visible or seen free.
    pub(super) fn settle(
        &mut self,
        looks: &[Look],
        decide: &mut impl FnMut(&SegmentFacts) -> Transition,
        update: &mut Update,
    ) {
        let at = self.estimate.pose.at;
        self.scans = self.scans.wrapping_add(1);
        let (scans, turns) = (self.scans, self.settings.hidden_scans.max(1));
        let mut pieces = Vec::new();
        let mut place = 0;
        let (objects, settings) = (&self.objects, &self.settings);
        self.segments.retain_mut(|segment| {
            let look = &looks[place];
            place += 1;
            let evidence = &look.evidence;
            if segment.confidence > 0 {
                segment.age = segment.age.saturating_add(1);
                segment.unseen = if look.is_matched { 0 } else { segment.unseen.saturating_add(1) };
            }
            let is_moving = segment.object.is_some_and(|id| objects.is_moving(id));
            let is_visible = evidence.on + evidence.through >= settings.visible_beams;
            let is_seen_free = evidence.through >= settings.free_beams && evidence.through >= evidence.on;
            let is_shown = look.is_matched || evidence.on > 0 || is_visible || is_seen_free;
            let has_turn = segment.id.0.wrapping_add(scans).is_multiple_of(turns);
            if segment.confidence > 0 && !is_moving && !is_shown && !has_turn {
                return true;
            }
            let facts = SegmentFacts {
                is_matched: look.is_matched,
                is_visible,
                is_seen_free,
                is_moving,
                beams_on: evidence.on,
                beams_through: evidence.through,
                free_m: evidence.free_m(),
                ..segment.facts(at, settings.is_learning)
            };
            let transition = decide(&facts);
            segment.follow(transition);
            let mut keeps = transition.is_kept;
            if keeps && facts.free_m > 0.0 && transition.is_cut {
                let left = segment.without(&evidence.free, settings.shortest_m);
                keeps = !left.is_empty();
                for (number, line) in left.into_iter().enumerate() {
                    if number == 0 {
                        segment.line = line;
                    } else {
                        pieces.push(ModelSegment { line, joins: [None; 2], ..*segment });
                    }
                }
            }
            if !keeps {
                update.removed.push(segment.id);
            }
            keeps
        });
        for piece in pieces {
            let id = self.next_id();
            update.entered.push(id);
            self.segments.push(ModelSegment { id, ..piece });
        }
    }
}
