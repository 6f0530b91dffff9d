//! What the judge is told.

use super::Navigator;
use crate::geometry::{Point, path_length};
use crate::navigation::highway::free_ahead;
use crate::navigation::judge::StateFacts;

impl Navigator<'_> {
    pub(super) fn facts(&self) -> StateFacts {
        let pose = self.pose();
        let target = self.legs.front().copied();
        let distance_m = target.map_or(0.0, |target| pose.at.distance(target));
        let (free_m, is_obstacle_moving) = self.free_m(target);
        let length_of = |path: &Option<Vec<Point>>| path.as_ref().map(|points| path_length(points));
        let detours = self.detours.as_ref();
        StateFacts {
            mode: self.mode,
            state: self.state,
            has_goal: target.is_some(),
            distance_m,
            is_falling: distance_m <= self.line.nearest_m + self.settings.falling_m,
            heading_error: target.map_or(0.0, |target| self.heading_off(target).abs()),
            off_line_m: target
                .map_or(0.0, |target| pose.at.distance(pose.at.nearest_on(self.line.from, target))),
            free_m,
            echo_m: self.echo_m(target),
            is_obstacle_moving,
            is_contact: self.contact.is_some(),
            back_offs: self.back_offs,
            is_busy: self.sensed.as_ref().is_some_and(|sensed| sensed.is_busy),
            is_changing: self.is_changing(),
            has_room: self.met_beside_change().is_none(),
            is_scan_complete: self.is_scan_complete(),
            scans: self.scans,
            left_m: detours.and_then(|detours| length_of(&detours.left)),
            right_m: detours.and_then(|detours| length_of(&detours.right)),
            detours_here: self.spot.detours,
            closed_here: self.spot.closed,
            waits: self.spot.waits,
            has_way: self.has_way,
            is_shut: self.is_shut,
            retries: self.retries,
            sigma_m: self.model.estimate().sigma_m(),
            sigma_heading: self.model.estimate().sigma_heading(),
            has_walls: self.whereabouts.has_walls(),
            unexplained: self.whereabouts.recognition.unexplained,
            contradicted: self.whereabouts.recognition.contradicted as u32,
            is_matched: self.whereabouts.is_matched,
            is_searched: self.whereabouts.is_searched,
            searches: self.whereabouts.searches,
            is_aside: self.whereabouts.aside.is_some(),
            seeks: self.whereabouts.sought.len() as u32,
            is_last: self.legs.len() == 1 && self.stretches.is_empty(),
            time_s: self.time_s() - self.begun_s,
            settings: self.figures(),
        }
    }

    /// By how much it has to turn before it goes to a point, radians: who keeps its facing goes there as it stands.
    pub(super) fn heading_off(&self, target: Point) -> f64 {
        let pose = self.pose();
        if self.building.facing.is_some() {
            self.building.off_facing(pose.heading)
        } else {
            pose.bearing(target)
        }
    }

    /// Metres ahead that are free in the model, and whether what is there moves.
    pub(super) fn free_m(&self, target: Option<Point>) -> (f64, bool) {
        let Some(target) = target else { return (0.0, false) };
        let least = self.rim.radius_m();
        let reach = [least, least + self.figures().highway_clearance_m];
        let standing = free_ahead(&self.rim, self.pose().at, target, reach, &self.barriers);
        let moving = free_ahead(&self.rim, self.pose().at, target, reach, &self.moving);
        (standing.metres.min(moving.metres), moving.by.is_some() && moving.metres <= standing.metres)
    }

    /// Metres ahead that are free by readings that are not in the model yet.
    pub(super) fn echo_m(&self, target: Option<Point>) -> f64 {
        let (Some(target), Some(sensed)) = (target, &self.sensed) else { return 0.0 };
        let pose = self.pose();
        let distance = pose.at.distance(target);
        let heading = pose.bearing(target);
        let clearance = self.settings.highway_clearance_m;
        let towards = pose.direction(heading);
        let sides = [towards.perpendicular(), -towards.perpendicular()];
        let [left, right] = sides.map(|side| self.rim.extent_m(side) + clearance);
        let front = |aside: f64| {
            if self.rim.is_disc() {
                (left.powi(2) - aside.powi(2)).max(0.0).sqrt()
            } else {
                self.rim.extent_m(towards) + clearance
            }
        };
        let ahead = self.part.iter().filter_map(|reading| {
            let from = sensed.odometry.to(&reading.odometry);
            let towards = from.direction(reading.bearing);
            let range = reading.range_m?;
            let at = from.at + towards * range;
            let (sin, cos) = heading.sin_cos();
            let (ahead, aside) = (at.x * cos + at.y * sin, at.y * cos - at.x * sin);
            let free = ahead - front(aside);
            (aside < left && aside > -right && ahead > 0.0 && free < distance).then_some(free.max(0.0))
        });
        let mut near: Vec<f64> = ahead.collect();
        near.sort_by(f64::total_cmp);
        near.get(self.settings.echoes - 1).copied().unwrap_or(distance)
    }
}
