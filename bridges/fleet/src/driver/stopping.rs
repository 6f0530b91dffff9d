//! Stops: an order is taken away. In a circle with the vehicle's file, of which it is a part.

use super::{AGAIN, Cancel, Driver, Effect, Now};
use crate::wire::{Action, Blocking, Instant};

impl Driver {
    /// Takes its order away.
    pub(super) fn cancel(&mut self, why: &str, now: &Now<'_, '_>, effects: &mut Vec<Effect>) -> String {
        self.unfollow(effects);
        self.orders += 1;
        let action = format!("cancel {} {}", now.world.clock.words, self.orders);
        let cancel = Cancel { action, at: now.world.clock.seconds, why: why.to_owned(), reports: 0 };
        effects.push(Effect::Say(format!("{} stops: {why}", self.row.name)));
        self.send_cancel(&cancel, now, effects);
        self.cancels = Some(cancel);
        format!("stops: {why}")
    }

    fn send_cancel(&mut self, cancel: &Cancel, now: &Now<'_, '_>, effects: &mut Vec<Effect>) {
        self.heads[1] = self.heads[1].wrapping_add(1);
        let action = Action {
            id: cancel.action.clone(),
            kind: "cancelOrder".to_owned(),
            words: cancel.why.clone(),
            blocking: Blocking::Hard,
            parameters: Vec::new(),
        };
        let message =
            now.to.instant(&Instant { actions: vec![action] }, self.heads[1], &now.world.clock.words);
        effects.push(Effect::Send { to: now.to.clone(), topic: "instantActions", message });
    }

    /// Whether a cancelling has yet to be done with.
    pub(super) fn is_cancelling(&mut self, now: &Now<'_, '_>, effects: &mut Vec<Effect>) -> bool {
        let Some(mut cancel) = self.cancels.take() else { return false };
        let ended = matches!(now.report.became_of(&cancel.action), Some("FINISHED" | "FAILED"));
        if (ended || cancel.reports > 0) && !now.report.is_busy() {
            self.given = None;
            self.is_broken = false;
            return false;
        }
        if now.world.clock.seconds - cancel.at >= AGAIN {
            cancel.at = now.world.clock.seconds;
            self.send_cancel(&cancel, now, effects);
        }
        self.cancels = Some(cancel);
        true
    }
}
