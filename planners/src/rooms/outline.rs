//! Outlines of rooms as facts and tables have them: `[[x,y],…]`, counterclockwise, metres. Of a room that is a rectangle
//! nothing is said but its edges.

use crate::geometry::tolerance::ROUNDING_M;
use crate::geometry::{Convex, Point, Rect, cross};

/// What is written of an outline, to be read back to the bit; `None` for a rectangle.
pub fn write(outline: &Convex) -> Option<String> {
    // the shortest text that is read as the same number
    let corner = |corner: Point| format!("[{:?},{:?}]", corner.x, corner.y);
    let corners = || outline.corners().map(corner).collect::<Vec<_>>().join(",");
    outline.rect().is_none().then(|| format!("[{}]", corners()))
}

/// The outline that is written of a room.
///
/// # Errors
/// What is wrong with it: one sentence, without its subject.
pub fn read(text: Option<&str>, bounds: Rect) -> Result<Convex, String> {
    let Some(text) = text else { return Ok(bounds.into()) };
    let corners = corners(text).filter(|corners| corners.len() >= 3);
    let corners =
        corners.ok_or_else(|| format!("is not a list of at least three corners [x,y], but {text}"))?;
    if !is_convex(&corners) {
        return Err(format!("is not convex, or not counterclockwise: {text}"));
    }
    let about = Rect::around(corners.iter().copied());
    if about != bounds {
        return Err(format!("lies in the rectangle {}, not in {}", sides(&about), sides(&bounds)));
    }
    Ok(Convex::new(corners))
}

/// The area that two rooms share within a rectangle: all of it where what they share is that rectangle, or is thinner
/// than numbers tell.
pub fn shared(one: &Convex, other: &Convex, within: Rect) -> Convex {
    if one.rect().is_some() && other.rect().is_some() {
        return within.into();
    }
    one.common(other).map_or_else(|| within.into(), |common| part_of(common, within))
}

/// The part of what two rooms share that lies within a rectangle; all of that where it is thinner than numbers tell.
pub(crate) fn part_of(common: Convex, within: Rect) -> Convex {
    if within.encloses(&common.bounds()) {
        return common;
    }
    common.common(&within.into()).unwrap_or_else(|| within.into())
}

fn corners(text: &str) -> Option<Vec<Point>> {
    let list = text.trim().strip_prefix('[')?.strip_suffix(']')?.trim_end().strip_suffix(']')?;
    let number = |text: &str| text.trim().parse().ok().filter(|number: &f64| number.is_finite());
    let corner = |(before, text): (usize, &str)| {
        let text = if before == 0 { text } else { text.trim_start().strip_prefix(',')? };
        let (x, y) = text.trim_start().strip_prefix('[')?.split_once(',')?;
        Some(Point::new(number(x)?, number(y)?))
    };
    list.split(']').enumerate().map(corner).collect()
}

/// Whether it turns left at each corner, and only once around.
fn is_convex(corners: &[Point]) -> bool {
    let at = |number: usize| corners[number % corners.len()];
    let is_left = |a: Point, b: Point, p: Point| cross(a, b, p) >= -ROUNDING_M * a.distance(b);
    let turns_left = |number: usize| is_left(at(number), at(number + 1), at(number + 2));
    let is_seen =
        |number: usize| is_left(at(0), at(number), at(number + 1)) && is_left(at(0), at(1), at(number));
    let bounds = Rect::around(corners.iter().copied());
    bounds.dx() > 0.0
        && bounds.dy() > 0.0
        && (0..corners.len()).all(turns_left)
        && (1..corners.len()).all(is_seen)
}

fn sides(rect: &Rect) -> String {
    format!("{:?}, {:?}, {:?}, {:?}", rect.x0, rect.y0, rect.x1, rect.y1)
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    const SLANTED: &str = "[[0.0,-1.0],[1.0,0.0],[0.0,1.0],[-1.0,0.0]]";
    const ABOUT: Rect = Rect::new(-1.0, -1.0, 1.0, 1.0);

    #[test]
    fn of_a_rectangle_nothing_is_written() {
        assert_eq!(write(&ABOUT.into()), None);
        assert_eq!(read(None, ABOUT), Ok(ABOUT.into()));
    }

    #[test]
    fn an_outline_is_a_list_of_corners_and_may_have_spaces() {
        let slanted = read(Some(SLANTED), ABOUT).unwrap();
        assert_eq!(write(&slanted).as_deref(), Some(SLANTED));
        let spaced = SLANTED.replace(',', " , ").replace('[', "[ ").replace(']', " ]");
        assert_eq!(read(Some(&spaced), ABOUT), Ok(slanted));
    }

    #[test]
    fn what_is_no_outline_is_refused_with_what_is_wrong() {
        let wrong = [
            ("", "three corners"),
            ("[]", "three corners"),
            ("[[0,0],[1,0]]", "three corners"),
            ("[[0,0],[1,0],[0,1],]", "three corners"),
            ("[[0,0],[1,0],[0,nan]]", "three corners"),
            ("[[0,0],[1,0],[0,1e999]]", "three corners"),
            ("[[0,0],[1,0,0],[0,1]]", "three corners"),
            ("[[0,0],[0,1],[1,0]]", "counterclockwise"),
            ("[[0,0],[1,0],[2,0]]", "convex"),
            ("[[0,0],[4,0],[1,1],[0,4]]", "convex"),
            ("[[0,3],[-2,-3],[3,1],[-3,1],[2,-3]]", "convex"),
            ("[[1,1],[3,1],[2,2],[1,0],[4,0],[4,4],[1,4]]", "convex"),
            ("[[0,0],[1,0],[0,1]]", "lies in the rectangle 0.0, 0.0, 1.0, 1.0, not in -1.0, -1.0, 1.0, 1.0"),
        ];
        for (text, why) in wrong {
            let refused = read(Some(text), ABOUT).unwrap_err();
            assert!(refused.contains(why), "{text}: {refused}");
        }
    }

    #[test]
    fn rectangles_share_the_box_that_is_said_and_slanted_rooms_what_of_it_lies_in_both() {
        let within = Rect::new(0.0, 0.0, 0.5, 0.5);
        assert_eq!(shared(&ABOUT.into(), &ABOUT.into(), within), within.into());
        let slanted = read(Some(SLANTED), ABOUT).unwrap();
        let corner = shared(&slanted, &ABOUT.into(), Rect::new(0.0, 0.0, 1.0, 1.0));
        assert!((corner.area() - 0.5).abs() < 1e-12);
    }

    proptest! {
        #[test]
        fn an_outline_is_read_back_to_the_bit(
            corners in prop::collection::vec((-1e3..1e3, -1e3..1e3), 3..12), scale in -30_i32..30
        ) {
            let scaled = |(x, y): (f64, f64)| Point::new(x / 3.0 * 2f64.powi(scale), y / 7.0 * 10f64.powi(scale));
            let outline = Convex::new(crate::geometry::polygon::hull(corners.into_iter().map(scaled)));
            let text = write(&outline).unwrap();
            let back = read(Some(&text), outline.bounds()).unwrap();
            let bits = |of: &Convex| -> Vec<[u64; 2]> {
                of.corners().map(|corner| [corner.x.to_bits(), corner.y.to_bits()]).collect()
            };
            prop_assert_eq!(bits(&back), bits(&outline));
        }
    }
}
