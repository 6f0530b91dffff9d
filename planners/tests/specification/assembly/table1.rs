//! Lee's Table 1 for tests, rules 3 and 4 read along x. In what ships it is a rule base, not Rust.

use adit_planners::channels::assembly::{Decision, Margin, StepFacts};

use Margin::{High, Keep, Low};

/// The rule that fires and its margins along x and z.
pub fn table1(facts: &StepFacts<2>, gap: [f64; 2]) -> Result<Decision<2>, String> {
    let (x, z) = (0, 1);
    let (junction, part) = (&facts.junction, &facts.part);
    let (rule, margin) = match facts.next {
        Some(next) if facts.entering == z && next.max[x] < junction.max[x] => (1.0, [Low, Low]),
        Some(next) if facts.entering == z && next.max[x] > junction.max[x] => (2.0, [High, Low]),
        _ if facts.entering == x && junction.max[x] < part.max[x] => (3.0, [High, High]),
        _ if facts.entering == x && junction.max[x] > part.max[x] => (4.0, [Low, High]),
        _ => return Err(format!("no rule fires: {facts:?}")),
    };
    Ok(Decision { rule: Some(rule), gap, margin })
}

/// What the four rules have in common, for any number of dimensions: the margin is on the side that the part
/// comes from, and on the side that it goes on to; across both it stays.
#[allow(clippy::unnecessary_wraps, reason = "it stands in for a table that may have no rule")]
pub fn table_for_any_dimension<const D: usize>(
    facts: &StepFacts<D>,
    gap: [f64; D],
) -> Result<Decision<D>, String> {
    let mut margin = [Keep; D];
    let comes_from_above = facts.junction.max[facts.entering] < facts.part.max[facts.entering];
    margin[facts.entering] = if comes_from_above { High } else { Low };
    let goes_up = |next: f64| next > facts.junction.max[facts.leaving];
    let goes_up = facts.next.is_none_or(|next| goes_up(next.max[facts.leaving]));
    margin[facts.leaving] = if goes_up { High } else { Low };
    Ok(Decision { rule: None, gap, margin })
}
