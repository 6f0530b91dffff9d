//! The known word that somebody probably meant.

/// The candidate nearest to `word` by edit distance, if it is near enough to be meant: at most a third of the
/// word's letters differ, and always one may. Of equally near ones the first.
pub fn nearest<'a>(word: &str, candidates: &[&'a str]) -> Option<&'a str> {
    let allowed = (word.chars().count() / 3).max(1);
    let distances = candidates.iter().map(|&candidate| (edit_distance(word, candidate), candidate));
    distances.min_by_key(|&(distance, _)| distance).filter(|&(d, _)| d <= allowed).map(|(_, c)| c)
}

fn edit_distance(a: &str, b: &str) -> usize {
    let b: Vec<char> = b.chars().collect();
    let mut row: Vec<usize> = (0..=b.len()).collect();
    for (i, ca) in a.chars().enumerate() {
        let mut diagonal = row[0];
        row[0] = i + 1;
        for (j, &cb) in b.iter().enumerate() {
            let replaced = diagonal + usize::from(ca != cb);
            diagonal = row[j + 1];
            row[j + 1] = replaced.min(row[j] + 1).min(diagonal + 1);
        }
    }
    row[b.len()]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_slip_of_the_finger_finds_the_key() {
        let keys = ["width", "depth", "obstacle", "bridge", "place"];
        assert_eq!(nearest("obstacles", &keys), Some("obstacle"));
        assert_eq!(nearest("wdth", &keys), Some("width"));
        assert_eq!(nearest("with", &keys), Some("width"));
        assert_eq!(nearest("robot", &keys), None);
    }
}
