//! Rules whose values never count, since the property is told of every object.

use crate::declared::Declarations;
use crate::diagnostic::{Code, Diagnostic};
use crate::rule::{Action, PropertyName, Rule};

pub(crate) fn lint(
    rules: &[Rule],
    declared: &Declarations,
    is_told: impl Fn(&PropertyName) -> bool,
) -> Vec<Diagnostic> {
    let mut found = vec![];
    for rule in rules {
        if !matches!(rule.action, Action::Conclude { .. } | Action::Table(_)) {
            continue;
        }
        for (name, position) in &rule.sets {
            if declared.rules_first(name) || !is_told(name) {
                continue;
            }
            let message =
                format!("what rule \"{}\" gives {name} never counts: each object is told one", rule.name());
            let help = format!(
                "to change what is told, `revise`; to have the rule count, `property {name} from rule, table`"
            );
            found.push(rule.file.error(Code::Unreachable, *position, message).warning().help(help));
        }
    }
    found
}
