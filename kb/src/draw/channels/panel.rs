//! What a panel shows, in metres.

use adit_planners::channels::assembly::{Assembly, Cuboid, PartPath};
use adit_planners::channels::corridor::{Corridors, Drive, Robot, Wall};
use adit_planners::geometry::{Point, Rect};

use crate::draw::text;

/// One way through channels, with what is written below it.
#[derive(Clone, Debug)]
pub struct ChannelPanel {
    pub(super) name: String,
    pub(super) figures: Vec<String>,
    pub(super) bounds: Rect,
    pub(super) picture: Picture,
}

#[derive(Clone, Debug)]
pub(super) enum Picture {
    Assembly(AssemblyPicture),
    Drive(DrivePicture),
}

/// An assembly as it is seen along an axis.
#[derive(Clone, Debug)]
pub(super) struct AssemblyPicture {
    pub channels: Vec<Rect>,
    pub junctions: Vec<Rect>,
    /// The part at each waypoint, assembled or disassembled first.
    pub parts: Vec<Rect>,
    /// Above this height all is open; `None` where height is not seen.
    pub top: Option<f64>,
}

#[derive(Clone, Debug)]
pub(super) struct DrivePicture {
    pub channels: Vec<Rect>,
    pub junctions: Vec<Rect>,
    pub walls: Vec<Wall>,
    /// Who drives, and how; nobody where the corridors alone are shown.
    pub drive: Option<(Robot, Drive)>,
    /// What is written where: numbers of channels, names of places.
    pub labels: Vec<(Point, String)>,
    /// The channels that are closed.
    pub closed: Vec<Rect>,
}

impl ChannelPanel {
    /// A way out of an assembly, or into it, seen so that the first of `axes` leads to the right and the second up:
    /// `[0, 1]` in two dimensions; in three `[0, 2]` from the front, `[0, 1]` from above.
    pub fn assembly<const D: usize>(
        name: &str,
        assembly: &Assembly<D>,
        path: &PartPath<D>,
        axes: [usize; 2],
    ) -> Self {
        let [right, up] = axes.map(|axis| axis.min(D - 1));
        let seen = |cuboid: &Cuboid<D>| {
            Rect::new(cuboid.min[right], cuboid.min[up], cuboid.max[right], cuboid.max[up])
        };
        let part = assembly.part();
        let at = |corner: &[f64; D]| {
            seen(&Cuboid::new(*corner, std::array::from_fn(|axis| corner[axis] + part.size(axis))))
        };
        let parts: Vec<Rect> = path.waypoints.iter().map(at).collect();
        let channels: Vec<Rect> = assembly.channels().iter().map(seen).collect();
        let hull = channels.iter().copied().reduce(joined).unwrap_or_else(|| at(&part.min));
        let ring = 0.06 * hull.dx().max(hull.dy());
        let walls = hull.grown(ring);
        let top = (up == D - 1).then(|| assembly.top());
        let mut bounds = parts.iter().map(|part| part.grown(ring / 2.0)).fold(walls, joined);
        if let Some(top) = top.filter(|top| bounds.y1 < top + ring) {
            bounds.y1 = top + ring;
        }
        Self {
            name: name.to_owned(),
            figures: vec![length(path.length), clearance(path)],
            bounds,
            picture: Picture::Assembly(AssemblyPicture {
                channels,
                junctions: assembly.junctions().iter().map(seen).collect(),
                parts,
                top,
            }),
        }
    }

    pub fn drive(name: &str, corridors: &Corridors, robot: Robot, drive: &Drive) -> Self {
        let figures = vec![length(drive.length), format!("clearance {:.3} m", drive.min_clearance)];
        let mut panel = Self::corridors(name, corridors);
        panel.figures = figures;
        if let Picture::Drive(picture) = &mut panel.picture {
            picture.drive = Some((robot, drive.clone()));
        }
        panel
    }

    /// Corridors that nobody drives through.
    pub fn corridors(name: &str, corridors: &Corridors) -> Self {
        let hull = corridors.channels().iter().copied().reduce(joined);
        let hull = hull.unwrap_or(Rect::new(0.0, 0.0, 1.0, 1.0));
        Self {
            name: name.to_owned(),
            figures: Vec::new(),
            bounds: hull.grown(0.05 * hull.dx().max(hull.dy())),
            picture: Picture::Drive(DrivePicture {
                channels: corridors.channels().to_vec(),
                junctions: corridors.junctions().iter().map(|junction| junction.rect).collect(),
                walls: corridors.walls().to_vec(),
                drive: None,
                labels: Vec::new(),
                closed: Vec::new(),
            }),
        }
    }

    /// With the numbers of channels, with those that are closed, and with places by name.
    #[must_use]
    pub fn labelled<'p>(
        mut self,
        is_closed: impl Fn(usize) -> bool,
        places: impl Iterator<Item = (&'p str, Point)>,
    ) -> Self {
        if let Picture::Drive(picture) = &mut self.picture {
            let numbered = (1..).zip(&picture.channels);
            picture.closed =
                numbered.clone().filter(|(number, _)| is_closed(*number)).map(|(_, rect)| *rect).collect();
            let near_an_end = |rect: &Rect| {
                let (x, y) = (rect.x0 + 0.3 * rect.dx(), rect.y0 + 0.3 * rect.dy());
                let middle = rect.centre();
                if rect.dx() > rect.dy() { Point::new(x, middle.y) } else { Point::new(middle.x, y) }
            };
            picture.labels =
                numbered.map(|(number, rect)| (near_an_end(rect), format!("C{number}"))).collect();
            picture.labels.extend(places.map(|(name, at)| (at, name.to_owned())));
        }
        self
    }

    /// The name of the panel with the letter of its place.
    pub(super) fn heading(&self, place: usize) -> String {
        format!("{}) {}", text::letters(place), self.name)
    }

    pub(super) fn caption_width(&self) -> f64 {
        let figures = self.figures.iter().map(|line| text::width(line, 13.0));
        figures.fold(text::width(&self.heading(0), 14.0), f64::max)
    }
}

fn length(metres: f64) -> String {
    format!("length {metres:.3} m")
}

/// The least clearance; where the assembled state alone leaves less than all the rest, that of the rest, too.
fn clearance<const D: usize>(path: &PartPath<D>) -> String {
    let is_way_in = path.legs.first().is_some_and(|leg| leg.junction == 0);
    let (inner, rest) = if is_way_in {
        (path.legs.len(), path.legs.split_last().map(|(_, rest)| rest))
    } else {
        (1, path.legs.split_first().map(|(_, rest)| rest))
    };
    let rest = rest.unwrap_or_default().iter().map(|leg| leg.min_clearance).fold(f64::INFINITY, f64::min);
    let least = format!("clearance {:.3} m", path.min_clearance);
    if rest.is_finite() && rest > path.min_clearance {
        format!("{least}; without leg {inner}: {rest:.3} m")
    } else {
        least
    }
}

fn joined(a: Rect, b: Rect) -> Rect {
    Rect::new(a.x0.min(b.x0), a.y0.min(b.y0), a.x1.max(b.x1), a.y1.max(b.y1))
}
