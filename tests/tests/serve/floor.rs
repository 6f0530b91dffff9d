//! The floor as the page has it, packed.

use serde_json::Value;

use super::served;

/// The packed floor, read as the manual describes it.
struct Packed {
    head: Value,
    numbers: Vec<[u8; 4]>,
    at: usize,
}

impl Packed {
    fn of(bytes: &[u8]) -> Self {
        let length = u32::from_le_bytes(bytes[..4].try_into().unwrap()) as usize;
        let head = serde_json::from_slice(&bytes[4..4 + length]).unwrap();
        let (numbers, rest) = bytes[4 + length..].as_chunks();
        assert!(length.is_multiple_of(4) && rest.is_empty());
        Self { head, numbers: numbers.to_vec(), at: 0 }
    }

    fn take(&mut self, count: usize) -> &[[u8; 4]] {
        self.at += count;
        &self.numbers[self.at - count..self.at]
    }

    fn integers(&mut self, count: usize) -> Vec<i64> {
        self.take(count).iter().map(|four| i64::from(i32::from_le_bytes(*four))).collect()
    }

    fn points(&mut self, count: usize) -> Vec<f64> {
        let from = [0, 1].map(|axis| self.head["bounds"][axis].as_f64().unwrap());
        let coordinates = self.take(2 * count).iter().map(|four| f64::from(f32::from_le_bytes(*four)));
        coordinates.zip(from.into_iter().cycle()).map(|(at, from)| at + from).collect()
    }

    fn polygons(&mut self, count: usize) -> Vec<Vec<f64>> {
        let corners = self.integers(count);
        corners.into_iter().map(|corners| self.points(corners as usize)).collect()
    }
}

fn numbers(of: &Value) -> Vec<f64> {
    of.as_array().unwrap().iter().map(|number| number.as_f64().unwrap()).collect()
}

#[track_caller]
fn near(packed: &[f64], of: &Value) {
    let of = numbers(of);
    assert_eq!(packed.len(), of.len());
    assert!(packed.iter().zip(&of).all(|(one, other)| (one - other).abs() < 1e-4), "{packed:?} {of:?}");
}

#[test]
fn the_packed_floor_is_the_map_without_changes_of_shape() {
    for (example, changes) in [("paper", false), ("clinic", true)] {
        let (_site, service) = served(example);
        let (_, map) = service.ask("GET", "/api/map", None);
        let mut packed = Packed::of(&service.bytes("/api/floor"));
        let doors: Vec<&Value> =
            map["doors"].as_array().unwrap().iter().filter(|door| door["kind"] == "door").collect();
        assert_eq!(doors.len() < map["doors"].as_array().unwrap().len(), changes, "{example}");
        for part in ["layout", "generation", "bounds", "places", "spaces", "doorways", "layers", "areas"] {
            assert_eq!(packed.head[part], map[part], "{example}: {part}");
        }
        let (walls, rooms) = (map["walls"].as_array().unwrap(), map["rooms"].as_array().unwrap());
        let counts = serde_json::json!([walls.len(), rooms.len(), doors.len()]);
        assert_eq!(packed.head["counts"], counts);
        for (corners, wall) in packed.polygons(walls.len()).iter().zip(walls) {
            near(corners, wall);
        }
        let (room, layer, shapes) =
            (packed.integers(rooms.len()), packed.integers(rooms.len()), packed.polygons(rooms.len()));
        for (at, of) in rooms.iter().enumerate() {
            assert_eq!(
                (room[at], layer[at]),
                (of["room"].as_i64().unwrap(), of["layer"].as_i64().unwrap_or(-1))
            );
            assert_eq!(packed.head["names"][at], of["name"]);
            near(&shapes[at], if of["outline"].is_null() { &of["rect"] } else { &of["outline"] });
        }
        let (door, room1) = (packed.integers(doors.len()), packed.integers(doors.len()));
        for (at, of) in doors.iter().enumerate() {
            assert_eq!((door[at], room1[at]), (of["door"].as_i64().unwrap(), of["room1"].as_i64().unwrap()));
            near(&packed.points(2), &of["segment"]);
        }
        assert_eq!(packed.at, packed.numbers.len(), "{example}: that is all");

        let (_, weights) = service.ask("GET", "/api/weights?changes=false", None);
        let (_, all) = service.ask("GET", "/api/weights", None);
        assert_eq!(weights["rooms"], all["rooms"]);
        assert_eq!(weights["doors"]["hardness"].as_array().unwrap().len(), doors.len());
        let kinds = map["doors"].as_array().unwrap().iter().zip(all["doors"]["hardness"].as_array().unwrap());
        let of_doors: Vec<&Value> =
            kinds.filter(|(door, _)| door["kind"] == "door").map(|(_, hardness)| hardness).collect();
        assert!(weights["doors"]["hardness"].as_array().unwrap().iter().eq(of_doors));
    }
}
