//! Places that an object takes, found by where a link is.

use crate::geometry::{Point, Segment};

/// Discs that belong to the object, gathered by what lies together: most of them are out of a question at once.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Taken {
    about: Option<Disc>,
    groups: Vec<Group>,
}

#[derive(Clone, Debug, PartialEq)]
struct Group {
    about: Disc,
    discs: Vec<Disc>,
}

#[derive(Clone, Copy, Debug, PartialEq)]
struct Disc {
    at: Point,
    within_m: f64,
}

impl Disc {
    /// The square of the distance from its middle to an axis, if it comes nearer to that than so many metres.
    fn nears(&self, axis: &Segment, near_m: f64) -> Option<f64> {
        let (near_m, squared) = (near_m + self.within_m, axis.squared_distance(self.at));
        (near_m > 0.0 && squared < near_m * near_m).then_some(squared)
    }

    /// A disc that holds this one and another one.
    fn with(&self, other: &Self) -> Self {
        let apart = self.at.distance(other.at);
        let within_m = f64::midpoint(self.within_m, apart + other.within_m);
        if within_m <= self.within_m || apart <= 0.0 {
            return Self { within_m: self.within_m.max(apart + other.within_m), ..*self };
        }
        if within_m <= other.within_m {
            return *other;
        }
        Self { at: self.at.lerp(other.at, (within_m - self.within_m) / apart), within_m }
    }
}

impl Taken {
    pub fn put(&mut self, at: Point, within_m: f64) {
        /// A place as near to the first one of a group joins it.
        const TOGETHER_M: f64 = 0.15;
        let disc = Disc { at, within_m };
        self.about = Some(self.about.map_or(disc, |about| about.with(&disc)));
        let group = self.groups.iter_mut().find(|group| group.discs[0].at.distance(at) <= TOGETHER_M);
        if let Some(group) = group {
            group.about = group.about.with(&disc);
            group.discs.push(disc);
        } else {
            self.groups.push(Group { about: disc, discs: vec![disc] });
        }
    }

    /// A disc about all of them: its middle, and how far it comes.
    pub fn about(&self) -> Option<(Point, f64)> {
        self.about.map(|about| (about.at, about.within_m))
    }

    /// Metres from an axis to what is nearest to it, if that is nearer than so many metres; negative where it takes a part of it.
    pub fn nearer(&self, axis: &Segment, mut than_m: f64) -> Option<f64> {
        self.about?.nears(axis, than_m)?;
        let mut found = None;
        for group in &self.groups {
            if group.about.nears(axis, than_m).is_none() {
                continue;
            }
            for disc in &group.discs {
                if let Some(squared) = disc.nears(axis, than_m) {
                    than_m = squared.sqrt() - disc.within_m;
                    found = Some(than_m);
                }
            }
        }
        found
    }

    /// Whether a disc lies by no more than so many metres beyond one that is known.
    pub fn is_near(&self, at: Point, within_m: f64, beyond_m: f64) -> bool {
        let is_near = |disc: &Disc, beyond_m: f64| {
            let room = disc.within_m + beyond_m - within_m;
            room >= 0.0 && disc.at.squared_distance(at) <= room * room
        };
        self.groups
            .iter()
            .filter(|group| is_near(&group.about, beyond_m))
            .any(|group| group.discs.iter().any(|disc| is_near(disc, beyond_m)))
    }

    /// The middles, and how near to them everything is taken.
    pub fn all(&self) -> impl Iterator<Item = (Point, f64)> + '_ {
        let discs = self.groups.iter().flat_map(|group| &group.discs);
        discs.map(|disc| (disc.at, disc.within_m))
    }
}
