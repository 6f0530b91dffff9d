//! One scan taken into the model.

use super::beam::{Beam, Shift};
use super::correction::Correction;
use super::fit::Echo;
use super::matching::{Match, Near, matches};
use super::objects::Cluster;
use super::reinforce::{across, reinforce, same_surface};
use super::sensor_model::{self, Seen};
use super::sequences;
use super::sight::{Crossing, Evidence, Fan};
use super::{LocalModel, ModelSegment, ObjectId, SegmentFacts, SegmentId, Settings, Source, Transition};
use crate::body::Reading;
use crate::pose::Pose;

/// What one scan changed.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Update {
    /// The error of the pose that was found, as a step from the old pose to the new one.
    pub correction: Pose,
    /// By how many observations: segments give two each, predicted readings one.
    pub observations: usize,
    /// Segments that the scan showed.
    pub seen: usize,
    /// How many of them lie on the model.
    pub matched: usize,
    /// Segments that were entered, by name.
    pub entered: Vec<SegmentId>,
    /// Segments that were taken out, by name.
    pub removed: Vec<SegmentId>,
}

/// What a scan says of a segment.
#[derive(Clone, Debug, Default)]
struct Look {
    is_matched: bool,
    evidence: Evidence,
}

/// The first segment that a beam meets.
type First = Option<(usize, Crossing)>;

impl LocalModel {
    /// Takes a scan into the model: readings that follow one another, of a whole turn of the sonar or of a part, up to the
    /// pose that was last reckoned.
    ///
    /// # Arguments
    /// `decide` is the state table: it is asked once for each segment that is in the model after the scan, new ones
    /// included (their confidence is 0 then).
    ///
    /// # Complexity
    /// For b readings, s segments of which n within hearing and m that the scan shows:
    /// O(s + n log b + m n + crossings), and s calls of `decide`.
    pub fn update(
        &mut self,
        scan: &[Reading],
        time_s: f64,
        mut decide: impl FnMut(&SegmentFacts) -> Transition,
    ) -> Update {
        let before = self.estimate;
        let beams: Vec<Beam> =
            scan.iter().map(|reading| Beam::new(reading, &before, &self.odometry, &self.settings)).collect();
        let groups = sensor_model::groups(&beams, &self.settings);
        let seen = sensor_model::build(&groups, &beams, &self.settings);
        let near = self.near();
        let mut observations = self.correct_by_matches(&seen, &near);
        let shift = |beams: &[Beam], to: &Pose| -> Vec<Beam> {
            let shift = Shift::new(&before.pose, to);
            beams.iter().map(|beam| beam.moved(&shift)).collect()
        };
        let placed = shift(&beams, &self.estimate.pose);
        let (mut looks, firsts, mut is_explained) = self.look(&placed, &near);
        observations += self.correct_by_readings(&placed, &firsts, &seen, &is_explained);
        let moved = Shift::new(&before.pose, &self.estimate.pose);
        let seen: Vec<Seen> = seen.iter().map(|one| one.moved(&moved)).collect();
        let placed = shift(&beams, &self.estimate.pose);

        let mut update = Update {
            correction: before.pose.to(&self.estimate.pose),
            observations,
            seen: seen.len(),
            ..Update::default()
        };
        let (new, changed) = self.integrate(&seen, &near, &mut looks, &mut is_explained, &mut update);
        let groups: Vec<Vec<Echo>> = groups.iter().map(|group| moved_echoes(group, &placed)).collect();
        let objects = self.follow(&groups, &placed, &is_explained, &looks, time_s);
        let changed: Vec<SegmentId> = changed.into_iter().map(|place| self.segments[place].id).collect();
        let absorbed = self.merge(&changed, &near, &mut looks);
        update.removed.extend(&absorbed);
        for one in new {
            let object = objects.iter().find(|(beams, _)| one.echoes.iter().any(|e| beams.contains(&e.beam)));
            let id = self.enter(&one, object.map(|(_, id)| *id));
            update.entered.push(id);
            looks.push(Look { is_matched: true, ..Look::default() });
        }
        self.settle(&looks, &mut decide, &mut update);
        let touched: Vec<SegmentId> = changed.iter().chain(&update.entered).copied().collect();
        self.connect(&touched, &update.removed);
        update
    }

    /// The places of segments within hearing.
    fn within_hearing(&self) -> impl Iterator<Item = usize> {
        let reach = self.settings.sonar_range_m + self.settings.match_offset_m;
        let at = self.estimate.pose.at;
        let is_near = move |segment: &ModelSegment| {
            let line = &segment.line;
            line.a.x.min(line.b.x) - reach <= at.x
                && at.x <= line.a.x.max(line.b.x) + reach
                && line.a.y.min(line.b.y) - reach <= at.y
                && at.y <= line.a.y.max(line.b.y) + reach
        };
        self.segments.iter().enumerate().filter(move |(_, segment)| is_near(segment)).map(|(place, _)| place)
    }

    fn near(&self) -> Vec<Near> {
        self.within_hearing().map(|place| Near::new(place, &self.segments[place])).collect()
    }

    fn matches(&self, seen: &Seen, near: &[Near]) -> Vec<Match> {
        matches(seen, near, &self.segments, &self.estimate, &self.settings)
    }

    /// The mean error of matched segments, in orientation and position.
    fn correct_by_matches(&mut self, seen: &[Seen], near: &[Near]) -> usize {
        let mut correction = Correction::new();
        for one in seen {
            let firm = |on: &Match| self.segments[on.model].counts_for_pose;
            if let Some(on) = self.matches(one, near).into_iter().find(firm) {
                correction.by_match(one, &on, &self.segments[on.model], &self.estimate, &self.settings);
            }
        }
        self.estimate = correction.apply(&self.estimate, &self.settings);
        correction.count
    }

    /// What beams say of the segments within hearing, what each beam meets first, and whether the model explains it.
    fn look(&self, beams: &[Beam], near: &[Near]) -> (Vec<Look>, Vec<First>, Vec<bool>) {
        let fan = Fan::new(beams);
        let mut looks = vec![Look::default(); self.segments.len()];
        let mut firsts: Vec<First> = vec![None; beams.len()];
        let mut is_explained = vec![false; beams.len()];
        let mut crossings = Vec::new();
        let at = self.estimate.pose.at;
        let (sigma_m, sigma_heading) = (self.estimate.sigma_m(), self.estimate.sigma_heading());
        for wall in near {
            let segment = &self.segments[wall.model];
            fan.crossings(segment, wall.length_m, beams, &self.settings, &mut crossings);
            if crossings.is_empty() {
                continue;
            }
            let far = segment.line.distance(at);
            let sigma = sigma_m.hypot(segment.sigma_m).hypot(sigma_heading * far);
            for crossing in &crossings {
                let first = &mut firsts[crossing.beam];
                if first.is_none_or(|(_, other)| crossing.range_m < other.range_m) {
                    *first = Some((wall.model, *crossing));
                }
                let beam = &beams[crossing.beam];
                is_explained[crossing.beam] |= crossing.agrees(beam, sigma, &self.settings);
            }
            looks[wall.model].evidence =
                Evidence::new(&mut crossings, beams, wall.length_m, sigma, &self.settings);
        }
        (looks, firsts, is_explained)
    }

    /// Readings in critical directions: there the model predicts them, and no matched segment has used them.
    fn correct_by_readings(
        &mut self,
        beams: &[Beam],
        firsts: &[First],
        seen: &[Seen],
        is_explained: &[bool],
    ) -> usize {
        let mut is_used = vec![false; beams.len()];
        for echo in seen.iter().flat_map(|one| &one.echoes) {
            is_used[echo.beam] = true;
        }
        let mut correction = Correction::new();
        let (sine, margin) = (self.settings.critical_angle.sin(), self.settings.critical_margin_m);
        for (i, first) in firsts.iter().enumerate() {
            let Some((model, crossing)) = first else { continue };
            let segment = &self.segments[*model];
            let is_inside = crossing.place_m >= margin && crossing.place_m <= segment.line.length() - margin;
            let is_critical = crossing.sine >= sine && is_inside && segment.counts_for_pose;
            if !is_used[i] && is_explained[i] && is_critical {
                correction.by_reading(&beams[i], crossing, segment, &self.estimate, &self.settings);
            }
        }
        self.estimate = correction.apply(&self.estimate, &self.settings);
        correction.count
    }

    /// Reinforces and extends what was seen again.
    ///
    /// # Returns
    /// What is new in the scan, and the places of segments that changed.
    fn integrate(
        &mut self,
        seen: &[Seen],
        near: &[Near],
        looks: &mut [Look],
        is_explained: &mut [bool],
        update: &mut Update,
    ) -> (Vec<Seen>, Vec<usize>) {
        let (mut new, mut changed) = (Vec::new(), Vec::new());
        for one in seen {
            let found = self.matches(one, near);
            if found.is_empty() {
                new.push(one.clone());
                continue;
            }
            update.matched += 1;
            for on in &found {
                looks[on.model].is_matched = true;
            }
            if found.iter().any(|on| self.segments[on.model].is_anchored) {
                new.extend(self.beside(one, near));
            } else {
                let segment = &mut self.segments[found[0].model];
                reinforce(segment, &one.fit, &one.line, &self.estimate);
                changed.push(found[0].model);
            }
            for echo in &one.echoes {
                is_explained[echo.beam] = true;
            }
        }
        changed.sort_unstable();
        changed.dedup();
        (new, changed)
    }

    /// The pieces of a scan's segment that lie beside none of the segments on which it lies. One between two walls, with
    /// echoes in it, fills the gap: a closed door. One at an end has to be enough for a segment of its own.
    fn beside(&self, one: &Seen, near: &[Near]) -> Vec<Seen> {
        // whatever lies on the same line leaves nothing of it, however short the part beside it
        let settings = Settings { match_overlap: 0.0, ..self.settings };
        let on = matches(one, near, &self.segments, &self.estimate, &settings);
        let place = |p| one.fit.place(p);
        let ordered = |a: f64, b: f64| (a.min(b), a.max(b));
        let lines = on.iter().map(|on| self.segments[on.model].line);
        let mut covered: Vec<(f64, f64)> = lines.map(|line| ordered(place(line.a), place(line.b))).collect();
        covered.sort_by(|a, b| a.0.total_cmp(&b.0));
        let (begin, end) = ordered(place(one.line.a), place(one.line.b));
        let (mut gaps, mut from) = (Vec::new(), begin);
        for (cover, until) in covered {
            gaps.push((from, cover.min(end), from > begin && cover < end));
            from = from.max(until);
        }
        gaps.push((from, end, false));
        // an end is not known better than two segments that are joined there
        let margin = self.settings.join_m / 2.0;
        let piece = |(from, to, is_between): (f64, f64, bool)| {
            let is_in = |echo: &&Echo| (from + margin..=to - margin).contains(&place(echo.at));
            let echoes: Vec<Echo> = one.echoes.iter().filter(is_in).copied().collect();
            let enough = if is_between { 2 } else { self.settings.fewest_echoes };
            let is_enough = echoes.len() >= enough && to - from >= self.settings.shortest_m + 2.0 * margin;
            is_enough.then(|| one.piece(from, to, echoes))
        };
        gaps.into_iter().filter(|(from, to, _)| from + 2.0 * margin < *to).filter_map(piece).collect()
    }

    fn follow(
        &mut self,
        groups: &[Vec<Echo>],
        beams: &[Beam],
        is_explained: &[bool],
        looks: &[Look],
        time_s: f64,
    ) -> Vec<(Vec<usize>, ObjectId)> {
        let clusters = Cluster::among(groups, is_explained, &self.settings);
        let matched = self.segments.iter().zip(looks).filter(|(_, look)| look.is_matched);
        let standing: Vec<ObjectId> = matched.filter_map(|(segment, _)| segment.object).collect();
        let ids = self.objects.follow(&clusters, beams, |id| standing.contains(&id), time_s, &self.settings);
        clusters.into_iter().map(|cluster| cluster.beams).zip(ids).collect()
    }

    /// Joins segments that have grown over one another.
    ///
    /// # Returns
    /// The names of those that were absorbed.
    fn merge(&mut self, changed: &[SegmentId], near: &[Near], looks: &mut Vec<Look>) -> Vec<SegmentId> {
        let mut absorbed: Vec<usize> = Vec::new();
        for id in changed {
            let Ok(one) = self.place(*id) else { continue };
            for other in near.iter().map(|wall| wall.model) {
                let (a, b) = (&self.segments[one], &self.segments[other]);
                let is_loose = !a.is_anchored && !b.is_anchored && a.object == b.object;
                if one == other || absorbed.contains(&other) || absorbed.contains(&one) || !is_loose {
                    continue;
                }
                if let Some(line) = same_surface(a, b, &self.settings) {
                    let other_one = *b;
                    let segment = &mut self.segments[one];
                    reinforce(segment, &line, &other_one.line, &self.estimate);
                    segment.confidence = segment.confidence.max(other_one.confidence);
                    segment.counts_for_pose |= other_one.counts_for_pose;
                    segment.age = segment.age.max(other_one.age);
                    absorbed.push(other);
                }
            }
        }
        absorbed.sort_unstable();
        let ids = absorbed.iter().map(|&place| self.segments[place].id).collect();
        for place in absorbed.into_iter().rev() {
            self.segments.remove(place);
            looks.remove(place);
        }
        ids
    }

    /// Where a segment stands; segments stand in the order of their names.
    fn place(&self, id: SegmentId) -> Result<usize, usize> {
        self.segments.binary_search_by_key(&id, |segment| segment.id)
    }

    fn enter(&mut self, one: &Seen, object: Option<ObjectId>) -> SegmentId {
        let (pose_m, pose_angle) = across(&one.fit, &self.estimate);
        self.add(
            one.line,
            (one.fit.sigma_m.powi(2) + pose_m).sqrt(),
            (one.fit.sigma_angle.powi(2) + pose_angle).sqrt(),
            Source::SONAR,
            object,
        )
    }

    /// Asks the state table about each segment, and does what it says.
    fn settle(
        &mut self,
        looks: &[Look],
        decide: &mut impl FnMut(&SegmentFacts) -> Transition,
        update: &mut Update,
    ) {
        let at = self.estimate.pose.at;
        let mut pieces = Vec::new();
        let mut place = 0;
        let (objects, settings) = (&self.objects, &self.settings);
        let is_learning = settings.is_learning;
        self.segments.retain_mut(|segment| {
            let look = &looks[place];
            place += 1;
            let evidence = &look.evidence;
            if segment.confidence > 0 {
                segment.age = segment.age.saturating_add(1);
                segment.unseen = if look.is_matched { 0 } else { segment.unseen.saturating_add(1) };
            }
            let is_moving = segment.object.is_some_and(|id| objects.is_moving(id));
            let facts = SegmentFacts {
                is_matched: look.is_matched,
                is_visible: evidence.on + evidence.through >= settings.visible_beams,
                is_seen_free: evidence.through >= settings.free_beams && evidence.through >= evidence.on,
                is_moving,
                beams_on: evidence.on,
                beams_through: evidence.through,
                free_m: evidence.free_m(),
                ..segment.facts(at, is_learning)
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

    /// Joins the ends of what changed.
    fn connect(&mut self, changed: &[SegmentId], gone: &[SegmentId]) {
        sequences::forget(&mut self.segments, gone);
        let near: Vec<usize> = self.within_hearing().collect();
        let changed: Vec<usize> = changed.iter().filter_map(|id| self.place(*id).ok()).collect();
        sequences::join(&mut self.segments, &changed, &near, &self.settings);
    }
}

fn moved_echoes(group: &[Echo], beams: &[Beam]) -> Vec<Echo> {
    group.iter().filter_map(|echo| beams[echo.beam].echo().map(|at| Echo { at, ..*echo })).collect()
}
