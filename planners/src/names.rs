//! Names of rooms in the order in which they are made: a, b, ... z, aa, ab, ... (Abou-Ali et al., Table 3).

/// The name of the room made as number `index`, counted from 0.
///
/// ```
/// use adit_planners::names::room_name;
/// assert_eq!([0, 25, 26, 701, 702].map(room_name), ["a", "z", "aa", "zz", "aaa"]);
/// ```
pub fn room_name(index: usize) -> String {
    let mut letters = Vec::new();
    let mut rest = index;
    loop {
        letters.push(b'a' + (rest % 26) as u8);
        if rest < 26 {
            break;
        }
        rest = rest / 26 - 1;
    }
    letters.iter().rev().map(|&letter| char::from(letter)).collect()
}
