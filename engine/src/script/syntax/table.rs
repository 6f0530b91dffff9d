//! The grammar of `table`.

use super::shape::{At, Next, Shape, Slot, Tabling, found, wrong};
use crate::suggest::nearest;

impl Shape {
    pub(super) fn tabling(&mut self, at: Tabling, ahead: &str) -> Next {
        let then = At::Tabling;
        match (at, ahead) {
            (Tabling::Hit, "unique" | "any" | "first") => self.input(Slot::Hit, At::Clause, "$token$"),
            (Tabling::Hit, "priority") => self.input(Slot::Hit, then(Tabling::Values), "$token$"),
            (Tabling::Hit, "collect") => self.input(Slot::Hit, then(Tabling::Fold), "$token$"),
            (Tabling::Hit, _) => {
                let words = ["unique", "any", "first", "priority", "collect"];
                let meant =
                    nearest(ahead, words).map_or(String::new(), |word| format!("; did you mean `{word}`?"));
                let policies = "unique, any, first, priority or collect";
                wrong(format!("a table's rows are {policies}, not {}{meant}", found(ahead)))
            }
            (Tabling::Values, "[") => self.input(Slot::HitValues, At::Clause, "$expr$"),
            (Tabling::Values, _) => wrong(format!(
                "the values of the first output belong here, best first, as in `priority [\"no\", \"yes\"]`, \
                 not {}",
                found(ahead)
            )),
            (Tabling::Fold, "sum" | "min" | "max" | "count") => {
                self.input(Slot::HitFold, At::Clause, "$token$")
            }
            (Tabling::Fold, _) => {
                wrong(format!("a table collects the sum, min, max or count, not {}", found(ahead)))
            }
            (Tabling::Given, _) => self.input(Slot::Given, then(Tabling::AfterGiven), "$expr$"),
            (Tabling::AfterGiven, "set") => self.word("set", then(Tabling::Set)),
            (Tabling::AfterGiven, _) => {
                wrong(format!("`set` and what the table gives belong here, not {}", found(ahead)))
            }
            (Tabling::Set, _) => self.input(Slot::Set, then(Tabling::AfterSet), "$expr$"),
            (Tabling::AfterSet, "rows") => self.word("rows", then(Tabling::Rows)),
            (Tabling::AfterSet, _) => {
                wrong(format!("`rows` and a list of lists belong here, not {}", found(ahead)))
            }
            (Tabling::Rows, _) => self.input(Slot::Rows, At::End, "$expr$"),
        }
    }
}
