//! "Did you mean": the nearest name by edit distance.

/// The candidate nearest to a misspelt name, if it is near enough to be meant.
pub(crate) fn nearest<'a>(name: &str, candidates: impl IntoIterator<Item = &'a str>) -> Option<&'a str> {
    let limit = (name.chars().count() / 3).max(1);
    // Letters to insert, remove, change or swap with a neighbour.
    let distance = |other: &str| strsim::osa_distance(&name.to_lowercase(), &other.to_lowercase());
    let others = candidates.into_iter().filter(|other| *other != name);
    let near = others.map(|other| (distance(other), other)).filter(|(distance, _)| *distance <= limit);
    near.min_by_key(|(distance, _)| *distance).map(|(_, other)| other)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn swapped_and_missing_letters_are_near() {
        assert_eq!(nearest("hieght", ["width", "height"]), Some("height"));
        assert_eq!(nearest("ROBOT", ["ROOMS", "ROBOTS"]), Some("ROBOTS"));
    }

    #[test]
    fn another_word_is_not_near() {
        assert_eq!(nearest("colour", ["width", "height"]), None);
    }
}
