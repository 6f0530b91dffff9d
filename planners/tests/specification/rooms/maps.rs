//! Random maps that are hard on purpose: overlaps, shared edges, touching corners, flat and stray rectangles.

use adit_planners::geometry::Rect;
use adit_planners::rooms::LowBridge;
use proptest::prelude::*;

pub const BOUNDS: Rect = Rect::new(0.0, 0.0, 12.0, 9.0);

#[derive(Clone, Debug)]
pub struct Map {
    pub obstacles: Vec<Rect>,
    pub low: Vec<LowBridge>,
}

pub fn any_map() -> impl Strategy<Value = Map> {
    prop_oneof![3 => map_on(whole()), 1 => map_on(quarters()), 1 => map_on(anywhere())]
}

/// Many small obstacles, more than the oracle of prime areas can take.
pub fn crowded_map() -> impl Strategy<Value = Map> {
    let small = (anywhere(), anywhere(), 0.05..0.8, 0.05..0.8);
    let obstacle = small.prop_map(|(x, y, w, h)| Rect::new(x, y, x + w, y + h));
    prop::collection::vec(obstacle, 20..60).prop_map(|obstacles| Map { obstacles, low: Vec::new() })
}

fn map_on(coordinate: impl Strategy<Value = f64> + Clone + 'static) -> BoxedStrategy<Map> {
    let bridge =
        (rect(coordinate.clone()), 1..4).prop_map(|(rect, h)| LowBridge { rect, height: f64::from(h) });
    let parts = (prop::collection::vec(rect(coordinate), 0..12), prop::collection::vec(bridge, 0..4));
    parts.prop_map(|(obstacles, low)| Map { obstacles, low }).boxed()
}

/// From corner to corner, or thin from one corner; flat ones and ones outside the bounds are among them.
fn rect(coordinate: impl Strategy<Value = f64> + Clone) -> impl Strategy<Value = Rect> {
    let corners = (coordinate.clone(), coordinate.clone(), coordinate.clone(), coordinate);
    (corners, any::<[bool; 2]>()).prop_map(|((ax, ay, bx, by), [thin_x, thin_y])| {
        let (bx, by) = (if thin_x { ax + 1.0 } else { bx }, if thin_y { ay + 1.0 } else { by });
        Rect::new(ax.min(bx), ay.min(by), ax.max(bx), ay.max(by))
    })
}

fn whole() -> impl Strategy<Value = f64> + Clone {
    (-1..14).prop_map(f64::from)
}

fn quarters() -> impl Strategy<Value = f64> + Clone {
    (-4..52).prop_map(|quarters| f64::from(quarters) / 4.0)
}

fn anywhere() -> impl Strategy<Value = f64> + Clone {
    -1.0..14.0
}
