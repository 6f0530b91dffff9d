//! Things that move: groups of echoes that the model does not explain, followed from scan to scan.

use super::Settings;
use super::beam::Beam;
use super::fit::Echo;
use crate::geometry::Point;

/// Names a thing that may move, for as long as the model lives.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct ObjectId(pub u32);

/// Something small that the model did not explain when it was seen.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Object {
    pub id: ObjectId,
    /// The middle of what is seen of it.
    pub at: Point,
    /// How far its echoes lie apart, metres.
    pub size_m: f64,
    pub seen_s: f64,
    /// Where it goes: metres a second along x and y.
    pub velocity: Point,
    /// Whether it was seen to go from one place to another.
    pub is_moving: bool,
    pub unseen: u32,
}

/// Echoes near one another that nothing explains.
#[derive(Clone, Debug)]
pub(super) struct Cluster {
    pub at: Point,
    pub size_m: f64,
    /// The beams of its echoes.
    pub beams: Vec<usize>,
}

impl Cluster {
    /// Small clusters among the groups of a scan; `is_explained` tells of a beam whether the model explains its echo.
    pub fn among(groups: &[Vec<Echo>], is_explained: &[bool], settings: &Settings) -> Vec<Self> {
        let runs = groups.iter().flat_map(|group| {
            group.chunk_by(|a, b| is_explained[a.beam] == is_explained[b.beam]).filter(|run| {
                // a single echo may be a false one
                run.len() > 1 && run.iter().all(|echo| !is_explained[echo.beam])
            })
        });
        runs.map(Self::new).filter(|cluster| cluster.size_m <= settings.object_size_m).collect()
    }

    fn new(echoes: &[Echo]) -> Self {
        let count = echoes.len() as f64;
        let (x, y) = echoes.iter().fold((0.0, 0.0), |(x, y), echo| (x + echo.at.x, y + echo.at.y));
        let at = Point::new(x / count, y / count);
        let size_m = 2.0 * echoes.iter().map(|echo| echo.at.distance(at)).fold(0.0, f64::max);
        Self { at, size_m, beams: echoes.iter().map(|echo| echo.beam).collect() }
    }
}

/// The things that are followed.
#[derive(Clone, Debug, Default)]
pub(super) struct Objects {
    pub list: Vec<Object>,
    next: u32,
}

impl Objects {
    /// Follows clusters. `is_standing` are objects of which the model explains what is seen.
    ///
    /// # Returns
    /// For each cluster the object that it is.
    pub fn follow(
        &mut self,
        clusters: &[Cluster],
        beams: &[Beam],
        is_standing: impl Fn(ObjectId) -> bool,
        time_s: f64,
        settings: &Settings,
    ) -> Vec<ObjectId> {
        let mut pairs = Vec::new();
        for (o, object) in self.list.iter().enumerate() {
            let since = time_s - object.seen_s;
            let expected = object.at + object.velocity * since;
            for (c, cluster) in clusters.iter().enumerate() {
                let reach = settings.object_speed_m_s * since + settings.object_size_m / 2.0;
                if cluster.at.distance(object.at) <= reach {
                    pairs.push((cluster.at.distance(expected), o, c));
                }
            }
        }
        pairs.sort_by(|a, b| a.0.total_cmp(&b.0).then((a.1, a.2).cmp(&(b.1, b.2))));
        let mut found = vec![None; clusters.len()];
        let mut is_taken = vec![false; self.list.len()];
        for (_, o, c) in pairs {
            if found[c].is_none() && !is_taken[o] {
                found[c] = Some(self.list[o].id);
                is_taken[o] = true;
                self.list[o].step_to(&clusters[c], beams, time_s, settings);
            }
        }
        for (object, _) in self.list.iter_mut().zip(is_taken).filter(|(_, is_taken)| !is_taken) {
            if is_standing(object.id) {
                (object.is_moving, object.velocity, object.unseen) = (false, Point::default(), 0);
                object.seen_s = time_s;
            } else if is_looked_at(object.at, beams, settings) {
                object.unseen += 1;
            }
        }
        self.list.retain(|object| object.unseen <= settings.object_patience);
        let named = found.into_iter().zip(clusters);
        named.map(|(id, cluster)| id.unwrap_or_else(|| self.enter(cluster, time_s))).collect()
    }

    fn enter(&mut self, cluster: &Cluster, seen_s: f64) -> ObjectId {
        let id = ObjectId(self.next);
        self.next += 1;
        let (at, size_m, velocity) = (cluster.at, cluster.size_m, Point::default());
        self.list.push(Object { id, at, size_m, seen_s, velocity, is_moving: false, unseen: 0 });
        id
    }

    pub fn is_moving(&self, id: ObjectId) -> bool {
        self.list.iter().any(|object| object.id == id && object.is_moving)
    }
}

impl Object {
    /// Goes to where a cluster is seen. It is moving if its old place is seen free.
    fn step_to(&mut self, cluster: &Cluster, beams: &[Beam], time_s: f64, settings: &Settings) {
        let since = time_s - self.seen_s;
        let far = cluster.at.distance(self.at) >= settings.object_step_m;
        if far && since > 0.0 && (self.is_moving || is_free(self.at, beams, settings)) {
            let velocity = Point::new((cluster.at.x - self.at.x) / since, (cluster.at.y - self.at.y) / since);
            (self.velocity, self.is_moving) = (velocity, true);
        } else if !far {
            (self.velocity, self.is_moving) = (Point::default(), false);
        }
        (self.at, self.size_m, self.seen_s, self.unseen) = (cluster.at, cluster.size_m, time_s, 0);
    }
}

fn is_looked_at(place: Point, beams: &[Beam], settings: &Settings) -> bool {
    beams
        .iter()
        .map(|beam| beam.seen_from(place))
        .any(|(ahead, aside)| ahead > 0.0 && aside <= settings.object_step_m)
}

/// Whether a beam passed a place closely and went on.
fn is_free(place: Point, beams: &[Beam], settings: &Settings) -> bool {
    beams.iter().any(|beam| {
        let (ahead, aside) = beam.seen_from(place);
        let beyond = ahead + settings.match_sigmas * beam.sigma_m + settings.object_step_m;
        ahead > 0.0
            && aside <= settings.object_step_m / 2.0
            && beam.range_m.is_some_and(|range| range > beyond)
    })
}
