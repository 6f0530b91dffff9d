//! The known word that somebody probably meant.

/// The candidate nearest to `word` by letters to insert, remove, change or swap with a neighbour, if it is near enough to be meant: at most a third of the
/// word's letters differ, and always one may; capitals are no difference. Of equally near ones the first.
pub fn nearest<'a>(word: &str, candidates: &[&'a str]) -> Option<&'a str> {
    let allowed = (word.chars().count() / 3).max(1);
    let distances = candidates
        .iter()
        .map(|&candidate| (strsim::osa_distance(&word.to_lowercase(), &candidate.to_lowercase()), candidate));
    distances.min_by_key(|&(distance, _)| distance).filter(|&(d, _)| d <= allowed).map(|(_, c)| c)
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
        assert_eq!(nearest("WIDTH", &keys), Some("width"));
    }
}
