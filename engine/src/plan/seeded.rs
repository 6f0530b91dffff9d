//! A rule's clauses in the order of a search that begins at an object of any of them (TREAT: Miranker 1987).

use super::clause::{ClausePlan, all, join};
use super::link::Join;
use super::node::{Comparison, Node};
use crate::script::syntax::Quantifier;
use crate::value::Truth;

struct Part {
    node: Node,
    clause: usize,
    /// It looks through a link, whatever that leads to.
    after_link: bool,
}

/// The search for what the clauses bind: all of it, or where the object of clause `seed` is given. If that is an
/// `each`, all bindings with the object are found; else the bindings of the clauses before to which it matters.
pub(crate) fn seeded(clauses: &[ClausePlan], seed: Option<usize>) -> Vec<ClausePlan> {
    let is_each = |clause: usize| clauses[clause].quantifier == Quantifier::Each;
    let end = seed.filter(|&seed| !is_each(seed)).unwrap_or(clauses.len());
    let mut parts: Vec<Part> = clauses.iter().flat_map(parts).collect();
    parts.retain(|part| Some(part.clause) != seed || !part.after_link);
    let mut bound = 0;
    let mut ordered = vec![];
    for number in seed.into_iter().chain((0..end).filter(|&number| Some(number) != seed)) {
        let now = bound | 1 << number;
        let (mut chosen, mut after) = (vec![], vec![]);
        // What decides whom a clause binds is asked there; all else as soon as it can be.
        let decides = |part: &Part| !part.after_link && !is_each(part.clause) && Some(part.clause) != seed;
        let due = |part: &mut Part| {
            if decides(part) { part.clause == number } else { part.node.variables() & !now == 0 }
        };
        for part in parts.extract_if(.., due) {
            let chooses = decides(&part) || is_each(number) || Some(number) == seed;
            if chooses { chosen.push(part) } else { after.push(part) }
        }
        let drives = ordered.is_empty() && (is_each(number) || seed.is_some());
        let lenient = seed.filter(|&seed| clauses[seed].minds_unknowns());
        ordered.push(clause(&clauses[number], drives, lenient, chosen, after));
        bound = now;
    }
    ordered
}

/// One clause's turn; the first drives the search. An object of `lenient` matters already where it is unknown whether it passes.
fn clause(
    clause: &ClausePlan,
    drives: bool,
    lenient: Option<usize>,
    chosen: Vec<Part>,
    after: Vec<Part>,
) -> ClausePlan {
    let perhaps = chosen.iter().any(|part| Some(part.clause) == lenient);
    let mut joins: Vec<Join> = vec![];
    let mut tests = vec![];
    for Part { node, clause: of, .. } in chosen {
        let found = match &node {
            Node::Compare(Comparison::Equal, a, b) if !drives => {
                join((**a).clone(), (**b).clone(), clause.variable).ok()
            }
            _ => None,
        };
        let found = found.filter(|found| joins.iter().all(|join| join.column != found.column));
        if perhaps || found.is_none() {
            tests.push(if Some(of) == lenient { or_unknown(node) } else { node });
        }
        joins.extend(found);
    }
    joins.sort_by_key(|join| join.column);
    let after = after
        .into_iter()
        .map(|part| if Some(part.clause) == lenient { or_unknown(part.node) } else { part.node });
    let (own, test) = if drives { (all(tests), None) } else { (None, all(tests)) };
    ClausePlan {
        joins,
        own,
        test,
        after: all(after.collect()),
        perhaps,
        by_own: clause.by.is_none(),
        thresholds: vec![],
        ..clause.clone()
    }
}

fn or_unknown(node: Node) -> Node {
    Node::Coalesce(Box::new(node), Box::new(Node::Truth(Truth::True)))
}

fn parts(plan: &ClausePlan) -> Vec<Part> {
    let clause = plan.variable;
    let link = plan.quantifier == Quantifier::Link;
    let equation = |join: &Join| {
        let own = Node::Property { variable: clause, column: join.column };
        Node::Compare(Comparison::Equal, Box::new(own), Box::new(join.key.clone()))
    };
    let found = plan.joins.iter().filter(|_| link).map(equation);
    let found = found.map(|node| Part { node, clause, after_link: false });
    let asked = plan.parts.iter().map(|node| Part { node: node.clone(), clause, after_link: link });
    found.chain(asked).collect()
}
