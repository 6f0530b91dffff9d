//! Names of places, areas and doors: one space of names, so that a name means one thing.

use super::super::diagnostic::{Code, Problem};
use super::super::fields::{Fields, Located};

#[derive(Default)]
pub(super) struct Names {
    taken: Vec<(&'static str, Located<String>)>,
}

impl Names {
    /// The `name` of an item, unless it is none or taken.
    ///
    /// # Arguments
    /// `what` is how messages call such items: `place`, `area`, `door`.
    pub(super) fn take(
        &mut self,
        item: &Fields<'_, '_>,
        what: &'static str,
        problems: &mut Vec<Problem>,
    ) -> Option<Located<String>> {
        let name = item.string("name", problems)?;
        let problem = |code, message: String| item.text.problem(code, &name.span, message);
        if name.value.trim().is_empty() {
            let article = if what == "area" { "an" } else { "a" };
            problems.push(problem(Code::EmptyName, format!("{article} {what} needs a name")));
            return None;
        }
        if name.value.contains(char::is_control) {
            let message = format!("the name {:?} holds a control character, which is no letter", name.value);
            problems.push(problem(Code::EmptyName, message));
            return None;
        }
        if let Some((of, first)) = self.taken.iter().find(|(_, taken)| taken.value == name.value) {
            let line = item.text.line(first.span.start);
            let message = format!("`{}` is already the name of the {of} on line {line}", name.value);
            problems.push(problem(duplicate(of, what), message).and_at(&first.span, "the first one"));
            return None;
        }
        self.taken.push((what, name.clone()));
        Some(name)
    }
}

/// The code of a name that two items have.
pub(super) fn duplicate(one: &str, other: &str) -> Code {
    if one == "place" && other == "place" { Code::DuplicatePlace } else { Code::DuplicateName }
}
