//! What the robot senses, taken into the model.

use std::f64::consts::TAU;

use super::{Navigator, TRACK_M, TRACK_POINTS};
use crate::body::{Body, Silence};
use crate::geometry::{Point, Segment};
use crate::navigation::event::Happening;
use crate::navigation::judge::{Judge, Mode, State};
use crate::navigation::known::moving;

impl Navigator<'_> {
    pub(super) fn sense(&mut self, body: &mut impl Body, judge: &mut impl Judge) -> Result<(), Silence> {
        let before = self.sensed.as_ref().and_then(|sensed| sensed.contact);
        let mut sensed = body.sense()?;
        self.directions = body.directions();
        self.model.reckon(&sensed.odometry);
        let is_held = !sensed.is_busy && self.course.is_some_and(|course| course.is_held(&sensed));
        let touch = sensed.contact.filter(|_| before.is_none() || is_held);
        let (time_s, shape) = (sensed.time_s, sensed.shape);
        if sensed.is_busy || self.readings_standing == 0 {
            (self.standing_s, self.looked_s) = (time_s, None);
        }
        self.readings_standing =
            if sensed.is_busy { 0 } else { self.readings_standing + sensed.readings.len() };
        self.part.append(&mut sensed.readings);
        self.sensed = Some(sensed);
        self.take_stance(shape);
        self.rim = body.rim().turned(self.building.facing.unwrap_or(0.0));
        self.keep_track();
        if let Some(contact) = touch {
            // What runs into a robot that stands, or goes elsewhere, is in the model then, and no reason to stop.
            let is_ahead = self.course.is_some_and(|course| course.leads_to(contact));
            let far_m = body.rim().reach_m(Point::towards(contact.bearing));
            if is_held || is_ahead || self.state == State::Turn {
                self.contact = self.contact.or(Some(contact));
                self.felt.push((time_s, self.model.surface_at(&contact, far_m)));
            }
            self.model.touched(&contact, far_m, |facts| judge.segment(facts));
            self.gather();
            self.tell(Happening::Contact { bearing: contact.bearing });
        }
        let is_standing = self.readings_standing > 0;
        let most = if is_standing { self.scan_readings() } else { self.part_readings() };
        if self.part.len() >= most && time_s - self.updated_s >= self.settings.pace_s {
            self.updated_s = time_s;
            // of more than a turn the latest counts
            self.part.drain(..self.part.len().saturating_sub(self.scan_readings()));
            self.update(judge);
        }
        Ok(())
    }

    /// Remembers where the robot came from, the latest part of it.
    fn keep_track(&mut self) {
        let at = self.pose().at;
        if self.track.back().is_none_or(|last| last.distance(at) >= TRACK_M) {
            self.track.push_back(at);
            while self.track.len() > TRACK_POINTS {
                self.track.pop_front();
            }
        }
    }

    /// Takes the readings into the model.
    pub(super) fn update(&mut self, judge: &mut impl Judge) {
        let part = std::mem::take(&mut self.part);
        let walls = (0..).zip(self.building.walls.iter().copied());
        self.model.recall(walls, |facts| judge.segment(facts));
        let update = self.model.update(&part, self.time_s(), |facts| judge.segment(facts));
        self.memory.note(&self.model, &self.building.walls, &self.settings);
        self.forget_loose(part.len());
        self.gather();
        if self.mode != Mode::Learn {
            self.keep_loose(&part);
        }
        if let (Some(seen), Some(sensed)) = (&mut self.seen, &self.sensed) {
            let pose = self.model.estimate().pose;
            seen.look(&part, &pose, &sensed.odometry, self.rim.inner_m(), &self.barriers);
        }
        if !(update.entered.is_empty() && update.removed.is_empty()) {
            self.tell(Happening::Segments { entered: update.entered, removed: update.removed });
        }
        let is_whole = self.readings_standing >= self.scan_readings();
        if is_whole && self.time_s() - self.standing_s >= self.settings.look_s {
            self.looked_s = Some(self.time_s());
            self.scans += 1;
            self.recognise(&part);
            self.tell(Happening::SetEstimatedPosition(*self.model.estimate()));
        }
    }

    /// Brings what is in the way up to date.
    pub(super) fn gather(&mut self) {
        self.barriers.truncate(self.building.walls.len() + self.building.overhead.len());
        let doorways = &self.building.network.regions.doorways;
        let line = |&doorway: &usize| Segment::new(doorways[doorway].from, doorways[doorway].to);
        self.barriers.extend(self.forbidden.iter().map(line));
        self.obstacles_from = self.barriers.len();
        let (now, patience) = (self.time_s(), self.settings.felt_s);
        self.felt.retain(|(time_s, _)| now - time_s <= patience);
        self.barriers.extend(self.obstacles(1));
        self.moving = moving(&self.model, &self.settings).collect();
        self.detours = None;
    }

    pub(super) fn obstacles(&self, confidence: u8) -> Vec<Segment> {
        // what a robot learns is what it sees
        let spacing = if self.mode == Mode::Learn { 0.0 } else { TAU / self.directions.max(1) as f64 };
        let mut obstacles = self.memory.obstacles((&self.model, spacing), confidence, &self.settings);
        obstacles.extend(self.felt.iter().map(|(_, surface)| *surface));
        obstacles.extend(self.loose.iter().map(|(_, surface)| *surface));
        obstacles
    }
}
