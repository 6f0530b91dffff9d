//! Which names a rule uses: properties read and set, variables, functions.

use std::collections::{BTreeMap, BTreeSet};

use rhai::{ASTNode, Expr, FnCallExpr, Position, Stmt, StmtBlock};

use super::interpreter::CHANGING;

/// A property of a pattern variable: its clause, and the property's name.
pub(crate) type Use = (usize, String);

#[derive(Debug, Default)]
pub(crate) struct Names {
    pub(crate) reads: BTreeMap<Use, Position>,
    pub(crate) sets: BTreeMap<Use, Position>,
    /// Variables that are neither of a clause nor declared here: name, place.
    pub(crate) free: Vec<(String, Position)>,
    /// Numbers that clauses give, as they are used.
    pub(crate) numbers: BTreeMap<String, Position>,
    /// Objects used whole, which rules cannot do.
    pub(crate) whole: Vec<(String, Position)>,
    /// `x.p += e` and the like.
    pub(crate) updates: Vec<(String, Position)>,
    /// Assignments to a clause's variable itself, or to a part of a property.
    pub(crate) misplaced: Vec<Position>,
    /// Functions called: name, number of arguments, place.
    pub(crate) calls: Vec<(String, usize, Position)>,
    pub(crate) nested: Vec<Position>,
}

/// The pattern variables that are in scope, in the order of their clauses.
pub(crate) struct Patterns<'a>(pub(crate) &'a [String]);

impl Patterns<'_> {
    pub(crate) fn index(&self, name: &str) -> Option<usize> {
        self.0.iter().position(|variable| variable == name)
    }
}

/// What the names of an expression may stand for.
struct Scope<'s> {
    patterns: &'s Patterns<'s>,
    /// The variable whose properties may stand bare, as in `by hardness`.
    own: Option<usize>,
    declared: BTreeSet<String>,
    /// What an earlier line has set for certain.
    certain: BTreeSet<Use>,
}

impl Names {
    /// Looks through an expression. `own` is the variable whose properties may stand bare, as in `by hardness`.
    pub(crate) fn expression(&mut self, expr: &Expr, patterns: &Patterns, own: Option<usize>) {
        let scope = Scope { patterns, own, declared: BTreeSet::new(), certain: BTreeSet::new() };
        let mut done: Vec<*const Expr> = vec![];
        expr.walk(&mut vec![], &mut |path| {
            if let Some(ASTNode::Expr(expr)) = path.last() {
                self.node(expr, &scope, &mut done);
            }
            true
        });
    }

    /// Looks through an action. What an earlier line has set for certain may be read by a later one.
    pub(crate) fn block(&mut self, block: &StmtBlock, patterns: &Patterns) {
        let mut scope = Scope { patterns, own: None, declared: declared(block), certain: BTreeSet::new() };
        for stmt in block.statements() {
            self.statement(stmt, &scope);
            if let Stmt::Assignment(assignment) = stmt
                && let Some((variable, property, _)) = property_of(&assignment.1.lhs)
                && let Some(index) = patterns.index(variable)
            {
                scope.certain.insert((index, property.to_owned()));
            }
        }
    }

    fn statement(&mut self, stmt: &Stmt, scope: &Scope) {
        let mut done: Vec<*const Expr> = vec![];
        stmt.walk(&mut vec![], &mut |path| {
            match path.last() {
                Some(ASTNode::Stmt(Stmt::Assignment(assignment))) => {
                    let update = assignment.0.is_op_assignment();
                    self.assignment(update, &assignment.1.lhs, scope.patterns, &mut done);
                }
                Some(ASTNode::Stmt(Stmt::FnCall(call, position))) => {
                    self.calls.push((call.name.to_string(), call.args.len(), *position));
                    done.extend(forgotten(call));
                }
                Some(ASTNode::Expr(expr)) => self.node(expr, scope, &mut done),
                _ => {}
            }
            true
        });
    }

    fn assignment(&mut self, update: bool, target: &Expr, patterns: &Patterns, done: &mut Vec<*const Expr>) {
        match property_of(target) {
            Some((variable, property, position)) => {
                let Some(index) = patterns.index(variable) else { return };
                if update {
                    self.updates.push((format!("{variable}.{property}"), position));
                }
                self.sets.entry((index, property.to_owned())).or_insert(position);
                skip(target, done);
            }
            None => {
                if root(target).is_some_and(|name| patterns.index(name).is_some()) {
                    self.misplaced.push(target.start_position());
                    skip(target, done);
                }
            }
        }
    }

    fn node(&mut self, expr: &Expr, scope: &Scope, done: &mut Vec<*const Expr>) {
        let Scope { patterns, own, declared, certain } = scope;
        if done.iter().any(|&seen| std::ptr::eq(seen, expr)) {
            return;
        }
        match expr {
            Expr::Dot(dot, ..) => {
                if let (Expr::Variable(variable, ..), Some((property, position))) =
                    (&dot.lhs, leading_property(&dot.rhs))
                    && let Some(index) = patterns.index(&variable.1)
                {
                    let used = (index, property.to_owned());
                    if !certain.contains(&used) {
                        self.reads.entry(used).or_insert(position);
                    }
                    done.push(&raw const dot.lhs);
                }
            }
            Expr::Variable(variable, _, position) => {
                let name = variable.1.as_str();
                if patterns.index(name).is_some() {
                    self.whole.push((name.to_owned(), *position));
                } else if let Some(own) = own {
                    self.reads.entry((*own, name.to_owned())).or_insert(*position);
                } else if !declared.contains(name) {
                    self.free.push((name.to_owned(), *position));
                }
            }
            Expr::FnCall(call, position) if !call.is_operator_call() => {
                self.calls.push((call.name.to_string(), call.args.len(), *position));
                done.extend(forgotten(call));
            }
            Expr::MethodCall(call, position) => {
                self.calls.push((call.name.to_string(), call.args.len() + 1, *position));
            }
            Expr::Custom(_, position) => self.nested.push(*position),
            _ => {}
        }
    }
}

/// `variable.property` and nothing more: the two names, and the place of the property.
pub(crate) fn property_of(expr: &Expr) -> Option<(&str, &str, Position)> {
    let Expr::Dot(dot, ..) = expr else { return None };
    match (&dot.lhs, &dot.rhs) {
        (Expr::Variable(variable, ..), Expr::Property(property, position)) => {
            Some((&variable.1, &property.2, *position))
        }
        _ => None,
    }
}

fn leading_property(expr: &Expr) -> Option<(&str, Position)> {
    match expr {
        Expr::Property(property, position) => Some((&property.2, *position)),
        Expr::Dot(dot, ..) | Expr::Index(dot, ..) => leading_property(&dot.lhs),
        _ => None,
    }
}

/// `forget(x)` is the one place where an object stands whole.
fn forgotten(call: &FnCallExpr) -> Option<*const Expr> {
    match &*call.args {
        [object @ Expr::Variable(..)] if call.name == "forget" => Some(&raw const *object),
        _ => None,
    }
}

fn root(expr: &Expr) -> Option<&str> {
    match expr {
        Expr::Variable(variable, ..) => Some(&variable.1),
        Expr::Dot(dot, ..) | Expr::Index(dot, ..) => root(&dot.lhs),
        _ => None,
    }
}

/// Marks an assigned place, so that it does not count as read.
fn skip(target: &Expr, done: &mut Vec<*const Expr>) {
    done.push(std::ptr::from_ref(target));
    if let Expr::Dot(dot, ..) | Expr::Index(dot, ..) = target {
        skip(&dot.lhs, done);
    }
}

pub(crate) fn walk(block: &StmtBlock, look: &mut dyn FnMut(&[ASTNode])) {
    for stmt in block.statements() {
        stmt.walk(&mut vec![], &mut |path| {
            look(path);
            true
        });
    }
}

fn declared(block: &StmtBlock) -> BTreeSet<String> {
    let mut names = BTreeSet::new();
    walk(block, &mut |path| match path.last() {
        Some(ASTNode::Stmt(Stmt::Var(var, ..))) => {
            names.insert(var.0.name.to_string());
        }
        Some(ASTNode::Stmt(Stmt::For(each, _))) => {
            names.insert(each.0.name.to_string());
            names.extend(each.1.iter().map(|counter| counter.name.to_string()));
        }
        Some(ASTNode::Stmt(Stmt::TryCatch(flow, _))) => {
            if let Expr::Variable(caught, ..) = &flow.expr {
                names.insert(caught.1.to_string());
            }
        }
        _ => {}
    });
    names
}

/// Whether an expression of an action changes one of the action's variables, or a property of an object: by an
/// assignment in it, a function that changes what it is called on, or a closure that shares the variable.
pub(crate) fn changes_in_expressions(block: &StmtBlock, patterns: &Patterns) -> bool {
    let inside = |path: &[ASTNode]| path.iter().any(|node| matches!(node, ASTNode::Expr(_)));
    let mut own: BTreeSet<String> = patterns.0.iter().cloned().collect();
    walk(block, &mut |path| match path.last() {
        Some(ASTNode::Stmt(Stmt::Var(var, ..))) if !inside(path) => {
            own.insert(var.0.name.to_string());
        }
        _ => {}
    });
    let of_own = |expr: &Expr| root(expr).is_some_and(|name| own.contains(name));
    let mut changes = false;
    walk(block, &mut |path| {
        changes |= match path.last() {
            Some(ASTNode::Stmt(Stmt::Assignment(assignment))) => inside(path) && of_own(&assignment.1.lhs),
            Some(ASTNode::Stmt(Stmt::Share(..))) => true,
            Some(ASTNode::Stmt(Stmt::FnCall(call, _)) | ASTNode::Expr(Expr::FnCall(call, _))) => {
                CHANGING.contains(&call.name.as_str()) && call.args.first().is_some_and(of_own)
            }
            Some(ASTNode::Expr(expr @ Expr::Dot(dot, ..))) => of_own(expr) && calls_changing(&dot.rhs),
            _ => false,
        };
    });
    changes
}

/// Whether one of the method calls of a path changes what it is called on.
fn calls_changing(path: &Expr) -> bool {
    match path {
        Expr::MethodCall(call, _) => CHANGING.contains(&call.name.as_str()),
        Expr::Dot(dot, ..) | Expr::Index(dot, ..) => calls_changing(&dot.lhs) || calls_changing(&dot.rhs),
        _ => false,
    }
}
