//! The name that somebody probably meant.

use adit_planners::read::nearest;

/// A help text, where a known name is near enough.
pub fn did_you_mean<'a>(name: &str, known: impl Iterator<Item = &'a str>) -> Option<String> {
    let known: Vec<&str> = known.take(5_000).collect();
    nearest(name, &known).map(|meant| format!("did you mean `{meant}`?"))
}
