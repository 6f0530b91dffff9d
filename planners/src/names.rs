//! Names of rooms: a, b, ... z, aa, ab, ... in the order in which they are made.

/// The name of the room made as number `index`, counted from 0.
pub fn room_name(index: usize) -> String {
    let mut letters = Vec::new();
    let mut rest = index + 1;
    while rest > 0 {
        letters.push(char::from(b'a' + ((rest - 1) % 26) as u8));
        rest = (rest - 1) / 26;
    }
    letters.iter().rev().collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn after_z_comes_aa() {
        let names: Vec<String> = [0, 25, 26, 27, 701, 702].map(room_name).into();
        assert_eq!(names, ["a", "z", "aa", "ab", "zz", "aaa"]);
    }
}
