//! The name that somebody probably meant.

use adit_planners::read::nearest;

/// So many names are listed.
const LISTED: usize = 12;

/// Which names there are, where these are few: places are dock, home; the only one is cart.
pub fn listed<'a>(what: &str, known: impl Iterator<Item = &'a str>) -> Option<String> {
    let known: Vec<&str> = known.take(LISTED + 1).collect();
    match known.as_slice() {
        [] => None,
        [only] => Some(format!("the only one is `{only}`")),
        _ => (known.len() <= LISTED).then(|| format!("{what} are {}", known.join(", "))),
    }
}

/// A help text, where a known name is near enough.
pub fn did_you_mean<'a>(name: &str, known: impl Iterator<Item = &'a str>) -> Option<String> {
    let known: Vec<&str> = known.take(5_000).collect();
    // who says a name rightly did not mean another one
    if known.contains(&name) {
        return None;
    }
    nearest(name, &known).map(|meant| format!("did you mean `{meant}`?"))
}
