//! Classes by condition and links, said in terms of plain clauses.

use std::sync::Arc;

use rhai::{ASTFlags, Expr, Namespace};

use super::rewrite::{block_mut, expr_mut};
use super::syntax::Quantifier;
use crate::declared::Declarations;
use crate::diagnostic::{Code, Diagnostic};
use crate::rule::{Action, Clause, LinkUse, PropertyName, Rule};

/// Puts the class of objects where a class by condition stands, and hidden clauses where links are read through.
/// Gives the declarations that the rule rests on, as they are written.
pub(crate) fn desugar(
    rule: &mut Rule,
    declared: &Declarations,
    problems: &mut Vec<Diagnostic>,
) -> Vec<String> {
    let mut used = vec![];
    for clause in &mut rule.clauses {
        if let Some(class) = declared.classes.get(&clause.class) {
            used.push(class.signature.clone());
            clause.class.clone_from(&class.root);
            clause.conditions.clone_from(&class.conditions);
        }
    }
    if !declared.links.is_empty() {
        let mut links = Links { declared, used: vec![], own: None, own_used: false, inserted: vec![] };
        links.clauses(rule, problems);
        links.action(rule);
        used.extend(links.used);
    }
    used
}

struct Links<'d> {
    declared: &'d Declarations,
    used: Vec<String>,
    /// The clause whose parts are looked at.
    own: Option<usize>,
    /// Whether a link of that clause's own object was found.
    own_used: bool,
    inserted: Vec<usize>,
}

impl Links<'_> {
    fn clauses(&mut self, rule: &mut Rule, problems: &mut Vec<Diagnostic>) {
        let mut index = 0;
        while index < rule.clauses.len() {
            if rule.clauses[index].link.is_none() {
                index = self.clause(rule, index, problems);
            }
            index += 1;
        }
    }

    /// Rewrites the parts of a clause; gives its number afterwards.
    fn clause(&mut self, rule: &mut Rule, mut index: usize, problems: &mut Vec<Diagnostic>) -> usize {
        let clause = &mut rule.clauses[index];
        let (by, have, condition) = (clause.by.take(), clause.have.take(), clause.condition.take());
        let each = clause.quantifier == Quantifier::Each;
        let mut kept: Vec<Expr> = vec![];
        let mut moved: Vec<Expr> = vec![];
        let mut rewritten = |links: &mut Self, rule: &mut Rule, mut expr: Expr, may_move: bool| {
            (links.own, links.own_used) = (Some(index), false);
            links.inserted.clear();
            links.expr(rule, &mut expr);
            index += links.inserted.iter().filter(|&&at| at <= index).count();
            if links.own_used && !may_move {
                let clause = &rule.clauses[index];
                let word = clause.quantifier.word();
                let message = format!("`{word}` cannot look through a link of its own object");
                let help = "let a rule copy what it reads there into a property of the object itself";
                problems.push(rule.file.error(Code::Declaration, expr.start_position(), message).help(help));
            }
            (expr, links.own_used)
        };
        let by = by.map(|by| rewritten(self, rule, by, false).0);
        let have = have.map(|have| rewritten(self, rule, have, false).0);
        for part in condition.into_iter().flat_map(parts) {
            let (part, own_used) = rewritten(self, rule, part, each);
            if own_used { moved.push(part) } else { kept.push(part) }
        }
        // whether one part refutes a hypothesis does not hang on what another one leaves open: they are weighed as a whole
        if rule.hypothesis.is_some() && each && !moved.is_empty() {
            moved.splice(0..0, kept.drain(..));
        }
        self.own = None;
        let links = rule.clauses[index + 1..].iter().take_while(|clause| clause.link.is_some()).count();
        let clause = &mut rule.clauses[index];
        (clause.by, clause.have, clause.condition) = (by, have, all(kept));
        if each {
            rule.clauses[index + links].condition =
                all(moved).or(rule.clauses[index + links].condition.take());
        }
        index
    }

    fn action(&mut self, rule: &mut Rule) {
        let mut action = std::mem::replace(
            &mut rule.action,
            Action::Default { property: String::new(), value: None, position: rule.position },
        );
        self.inserted.clear();
        match &mut action {
            Action::Conclude { then, otherwise } => {
                block_mut(then, &mut |expr| self.node(rule, expr));
                if let Some(block) = otherwise {
                    block_mut(block, &mut |expr| self.node(rule, expr));
                }
            }
            Action::Revise { amount, .. } => self.expr(rule, amount),
            Action::React(reaction) => {
                block_mut(&mut reaction.body, &mut |expr| self.node(rule, expr));
                for (_, _, value) in reaction.tells.iter_mut().flat_map(|telling| &mut telling.properties) {
                    self.expr(rule, value);
                }
                for setting in &mut reaction.sets {
                    setting.value.iter_mut().for_each(|value| self.expr(rule, value));
                }
            }
            Action::Table(table) => {
                for (input, _) in &mut table.given {
                    self.expr(rule, input);
                }
                for output in table.rows.iter_mut().flat_map(|row| &mut row.outputs) {
                    self.expr(rule, output);
                }
            }
            Action::Default { .. } => {}
        }
        // Clauses that were put in meanwhile moved the others of this action; those before had moved the rule's.
        for at in std::mem::take(&mut self.inserted) {
            shift(&mut action, at);
        }
        rule.action = action;
    }

    fn expr(&mut self, rule: &mut Rule, expr: &mut Expr) {
        expr_mut(expr, &mut |expr| self.node(rule, expr));
    }

    /// `door.room1.height` becomes the property `height` of the hidden variable `door.room1`.
    fn node(&mut self, rule: &mut Rule, expr: &mut Expr) {
        while let Some((variable, name)) = self.through(rule, expr) {
            let Expr::Dot(path, ..) = expr else { return };
            let Expr::Dot(rest, ..) = &path.rhs else { return };
            let mut path = (**path).clone();
            let position = path.lhs.start_position();
            path.rhs = rest.rhs.clone();
            path.lhs =
                Expr::Variable(Box::new((None, name.as_str().into(), Namespace::NONE, 0)), None, position);
            let flags = if let Expr::Dot(_, flags, _) = expr { *flags } else { ASTFlags::empty() };
            *expr = Expr::Dot(Box::new(path), flags, position);
            self.own_used |= self.own.is_some_and(|own| own == variable);
        }
    }

    /// If the path reads through a link: the clause of its variable, and the hidden variable, which is there then.
    fn through(&mut self, rule: &mut Rule, expr: &Expr) -> Option<(usize, String)> {
        let Expr::Dot(path, ..) = expr else { return None };
        let (Expr::Variable(variable, ..), Expr::Dot(rest, ..)) = (&path.lhs, &path.rhs) else { return None };
        let Expr::Property(property, position) = &rest.lhs else { return None };
        let visible = |(index, clause): &(usize, &Clause)| {
            clause.variable == *variable.1 && (clause.quantifier.binds() || self.own == Some(*index))
        };
        let (index, clause) = rule.clauses.iter().enumerate().find(visible)?;
        let from = PropertyName::new(&clause.class, property.2.as_str());
        let link = self.declared.links.get(&from)?;
        let name = format!("{}.{}", variable.1, property.2);
        let origin = clause.link.as_ref().map_or(index, |link| link.clause);
        if !rule.clauses.iter().any(|clause| clause.variable == name) {
            let mut hidden = Clause::new(Quantifier::Link, name.clone(), *position);
            hidden.class.clone_from(&link.class);
            hidden.class_position = link.class_position;
            hidden.link = Some(LinkUse {
                clause: index,
                property: from.property,
                key: link.key.as_ref().map(|(key, _)| key.clone()),
                position: *position,
                declared: (Arc::clone(&link.file), link.position),
            });
            self.used.push(link.signature.clone());
            let at = index
                + 1
                + rule.clauses[index + 1..].iter().take_while(|clause| clause.link.is_some()).count();
            self.insert(rule, at, hidden);
        }
        Some((if self.own == Some(origin) { origin } else { index }, name))
    }

    fn insert(&mut self, rule: &mut Rule, at: usize, clause: Clause) {
        rule.clauses.insert(at, clause);
        self.inserted.push(at);
        for clause in &mut rule.clauses {
            if let Some(link) = &mut clause.link
                && link.clause >= at
            {
                link.clause += 1;
            }
        }
        if let Some(own) = &mut self.own
            && *own >= at
        {
            *own += 1;
        }
        shift(&mut rule.action, at);
    }
}

/// Counts the clauses that an action names anew after one was put in.
fn shift(action: &mut Action, at: usize) {
    match action {
        Action::Revise { target, .. } if target.0 >= at => target.0 += 1,
        Action::React(reaction) => {
            reaction.sets.iter_mut().filter(|set| set.variable >= at).for_each(|set| set.variable += 1);
        }
        Action::Table(table) => {
            table.set.iter_mut().filter(|(clause, ..)| *clause >= at).for_each(|(clause, ..)| *clause += 1);
        }
        _ => {}
    }
}

fn parts(condition: Expr) -> Vec<Expr> {
    match condition {
        Expr::And(joined, _) => joined.into_iter().flat_map(parts).collect(),
        other => vec![other],
    }
}

fn all(mut parts: Vec<Expr>) -> Option<Expr> {
    if parts.len() < 2 {
        return parts.pop();
    }
    let position = parts[0].start_position();
    Some(Expr::And(Box::new(parts.into_iter().collect()), position))
}
