//! Degrees on the earth as metres on a plane.

use proj4rs::Proj;
use proj4rs::transform::transform;

use crate::geometry::Point;
use crate::read::{At, Read};

/// A projection from degrees east and north of WGS 84 to metres.
pub(super) struct Earth {
    degrees: Proj,
    metres: Proj,
    offset: Point,
}

impl Earth {
    /// A coordinate system that a file names, as `EPSG:3414`.
    ///
    /// # Arguments
    /// `offset` is taken from its coordinates, metres.
    pub fn named(system: &At<'_>, offset: Point) -> Read<Self> {
        let expected = "a coordinate system in metres on a plane, as EPSG:3414";
        let name = system.text()?;
        let metres = Proj::from_user_string(&name).map_err(|_| system.wrong(expected))?;
        if metres.is_latlong() || (metres.to_meter() - 1.0).abs() > 1e-12 {
            return Err(system.wrong(expected));
        }
        let degrees = wgs84().ok_or_else(|| system.wrong(expected))?;
        Ok(Self { degrees, metres, offset })
    }

    /// Metres east and north of a point, by the transverse Mercator projection about it: over a few kilometres lengths are
    /// right to a millionth.
    pub fn about(origin: Point) -> Option<Self> {
        let text = format!(
            "+proj=tmerc +lat_0={} +lon_0={} +k=1 +x_0=0 +y_0=0 +ellps=WGS84 +units=m +no_defs",
            origin.y, origin.x
        );
        let metres = Proj::from_proj_string(&text).ok()?;
        Some(Self { degrees: wgs84()?, metres, offset: Point::new(0.0, 0.0) })
    }

    /// Where degrees east and north lie; `None` where the projection does not reach.
    pub fn metres(&self, degrees: Point) -> Option<Point> {
        if degrees.y.abs() > 89.0 || degrees.x.abs() > 180.0 {
            return None;
        }
        let mut at = (degrees.x.to_radians(), degrees.y.to_radians(), 0.0);
        transform(&self.degrees, &self.metres, &mut at).ok()?;
        let at = Point::new(at.0 - self.offset.x, at.1 - self.offset.y);
        (at.x.is_finite() && at.y.is_finite()).then_some(at)
    }
}

fn wgs84() -> Option<Proj> {
    Proj::from_proj_string("+proj=longlat +ellps=WGS84 +datum=WGS84 +no_defs").ok()
}
