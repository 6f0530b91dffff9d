//! The order in which rules are evaluated: first what concludes a property, then who reads it.

use std::collections::{BTreeMap, BTreeSet};

use crate::declared::Declarations;
use crate::diagnostic::{Code, Diagnostic};
use crate::rule::{PropertyName, Rule};

#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) enum Step {
    Rule(usize),
    Merge(PropertyName),
    Level(PropertyName, i64),
}

/// The steps in an order that respects all dependencies, or the cycles that make one impossible.
pub(crate) fn order(rules: &[Rule], declared: &Declarations) -> Result<Vec<Step>, Vec<Diagnostic>> {
    let mut levels = levels(rules);
    for name in declared.supplied() {
        levels.entry(name.clone()).or_default();
    }
    let mut needs: BTreeMap<Step, BTreeSet<Step>> = BTreeMap::new();
    // Rules that react are no part of an inference: they run after it.
    for (index, rule) in rules.iter().enumerate().filter(|(_, rule)| !rule.reacts()) {
        let own = rule.level().map(|level| (rule.sets.keys().next(), level));
        let inputs = needs.entry(Step::Rule(index)).or_default();
        for read in rule.reads.keys() {
            match own {
                Some((Some(target), level)) if target == read => {
                    inputs.extend(below(&levels, read, level));
                }
                _ => inputs.extend(below(&levels, read, i64::MAX)),
            }
        }
        if let Some((Some(target), level)) = own {
            inputs.extend(below(&levels, target, level));
        }
        for set in rule.sets.keys() {
            let step = rule
                .level()
                .map_or_else(|| Step::Merge(set.clone()), |level| Step::Level(set.clone(), level));
            needs.entry(step).or_default().insert(Step::Rule(index));
        }
    }
    for (property, levels) in &levels {
        let mut before = Step::Merge(property.clone());
        needs.entry(before.clone()).or_default();
        for &level in levels {
            let step = Step::Level(property.clone(), level);
            needs.entry(step.clone()).or_default().insert(before);
            before = step;
        }
    }
    sort(rules, &needs)
}

type Levels = BTreeMap<PropertyName, BTreeSet<i64>>;

fn levels(rules: &[Rule]) -> Levels {
    let mut levels = Levels::new();
    for rule in rules {
        for set in rule.sets.keys() {
            levels.entry(set.clone()).or_default().extend(rule.level());
        }
    }
    levels
}

fn below(levels: &Levels, property: &PropertyName, level: i64) -> Option<Step> {
    let known = levels.get(property)?;
    Some(match known.range(..level).next_back() {
        Some(&lower) => Step::Level(property.clone(), lower),
        None => Step::Merge(property.clone()),
    })
}

fn sort(rules: &[Rule], needs: &BTreeMap<Step, BTreeSet<Step>>) -> Result<Vec<Step>, Vec<Diagnostic>> {
    let mut done: BTreeSet<&Step> = BTreeSet::new();
    let mut order = vec![];
    while order.len() < needs.len() {
        let ready: Vec<&Step> = needs
            .iter()
            .filter(|(step, inputs)| !done.contains(step) && inputs.iter().all(|input| done.contains(input)))
            .map(|(step, _)| step)
            .collect();
        if ready.is_empty() {
            return Err(vec![cycle(rules, needs, &done)]);
        }
        order.extend(ready.iter().map(|step| (*step).clone()));
        done.extend(ready);
    }
    Ok(order)
}

/// Walks from a step that waits to one that it waits for, until a step comes again.
fn cycle(rules: &[Rule], needs: &BTreeMap<Step, BTreeSet<Step>>, done: &BTreeSet<&Step>) -> Diagnostic {
    let waiting = |step: &Step| needs[step].iter().find(|input| !done.contains(input));
    let mut path: Vec<&Step> = needs.keys().filter(|step| !done.contains(step)).take(1).collect();
    while let Some(next) = path.last().and_then(|step| waiting(step)) {
        if let Some(start) = path.iter().position(|step| *step == next) {
            path.drain(..start);
            break;
        }
        path.push(next);
    }
    let mut first = None;
    let mut parts = vec![];
    for step in path.iter().rev() {
        match step {
            Step::Rule(index) => {
                first = first.or(Some(&rules[*index]));
                parts.push(format!("rule \"{}\"", rules[*index].name));
            }
            Step::Merge(property) | Step::Level(property, _) => parts.push(property.to_string()),
        }
    }
    parts.extend(parts.first().cloned());
    let rule = first.unwrap_or(&rules[0]);
    rule.file
        .error(Code::Cycle, rule.position, format!("these rules wait for each other: {}", parts.join(" -> ")))
        .help("a rule must not depend on what it helps to conclude")
}
