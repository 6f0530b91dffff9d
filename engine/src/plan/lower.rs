//! From rhai's expression trees to typed nodes.

use std::collections::{BTreeMap, BTreeSet};
use std::sync::Arc;

use rhai::{AST, Expr, Position, Stmt, StmtBlock};

use super::fragment::{Fragment, Object, Source};
use super::kinds::{Kind, Kinds};
use super::node::{Comparison, Node};
use crate::diagnostic::{Code, Diagnostic};
use crate::rule::{Clause, FileScope, PropertyName, Rule};
use crate::script::names::{Names, Patterns, property_of};
use crate::symbols::{Lexicon, Symbol};
use crate::value::{Type, Value};

/// A node and the type that it gives; `None` is a type that only running tells.
pub(crate) type Typed = (Node, Option<Type>);

#[derive(Debug)]
pub(crate) enum Stop {
    /// It is not among what is compiled; the interpreter can run it.
    Interpret,
    /// It is wrong, and that is on the list of problems.
    Wrong,
}

#[derive(Clone, Debug)]
pub(crate) struct Local {
    pub(crate) name: String,
    pub(crate) slot: usize,
    pub(crate) kind: Option<Type>,
}

pub(crate) struct Lowering<'r> {
    pub(crate) rule: &'r Rule,
    pub(crate) kinds: &'r dyn Kinds,
    /// The file of the expressions that are lowered: its constants and functions count.
    pub(crate) file: Arc<FileScope>,
    pub(super) symbols: &'r Lexicon,
    columns: Vec<PropertyName>,
    problems: Vec<Diagnostic>,
    /// Pattern variables by the number of their clause; nameless where they are not in scope.
    variables: Vec<String>,
    /// The variable whose properties may stand bare.
    pub(crate) own: Option<usize>,
    pub(crate) locals: Vec<Local>,
    pub(crate) slots: usize,
    /// Properties that an earlier line of the action has set for certain.
    pub(crate) certain: BTreeMap<(usize, String), (usize, Option<Type>)>,
}

impl<'r> Lowering<'r> {
    pub(crate) fn new(rule: &'r Rule, kinds: &'r dyn Kinds, symbols: &'r Lexicon) -> Self {
        Self {
            rule,
            kinds,
            file: Arc::clone(&rule.file),
            symbols,
            columns: vec![],
            problems: vec![],
            variables: vec![],
            own: None,
            locals: vec![],
            slots: 0,
            certain: BTreeMap::new(),
        }
    }

    pub(crate) fn finish(self) -> (Vec<PropertyName>, Vec<Diagnostic>) {
        (self.columns, self.problems)
    }

    /// From here on, expressions speak in this clause (`None`: after all of them).
    pub(crate) fn enter(&mut self, clause: Option<usize>) {
        let clauses = &self.rule.clauses[..clause.map_or(self.rule.clauses.len(), |clause| clause + 1)];
        let in_scope = |(index, of): (usize, &Clause)| {
            if of.quantifier.binds() || clause == Some(index) { of.variable.clone() } else { String::new() }
        };
        self.variables = clauses.iter().enumerate().map(in_scope).collect();
    }

    pub(crate) fn variables(&self) -> Vec<String> {
        self.variables.clone()
    }

    pub(crate) fn variable(&self, name: &str) -> Option<usize> {
        self.variables.iter().position(|variable| variable == name)
    }

    pub(crate) fn problem(&mut self, code: Code, position: Position, message: impl Into<String>) {
        self.complain(self.file.error(code, position, message));
    }

    pub(crate) fn complain(&mut self, problem: Diagnostic) {
        self.problems.push(problem);
    }

    /// An expression that must give this type. What is wrong is on the list, and the node is then unknown.
    pub(crate) fn wanted(&mut self, expr: &Expr, wanted: Type) -> Node {
        match self.lower(expr) {
            Ok(typed) => self.narrow(typed, wanted, expr.start_position()).unwrap_or(Node::Unknown),
            Err(_) => Node::Unknown,
        }
    }

    /// Any expression: compiled, or as a fragment for the interpreter.
    pub(crate) fn lower(&mut self, expr: &Expr) -> Result<Typed, Stop> {
        match self.compiled(expr) {
            Err(Stop::Interpret) => self.interpreted(expr),
            done => done,
        }
    }

    fn compiled(&mut self, expr: &Expr) -> Result<Typed, Stop> {
        Ok(match expr {
            Expr::IntegerConstant(number, _) => (Node::Number(*number as f64), Some(Type::Number)),
            Expr::FloatConstant(number, _) => (Node::Number(**number), Some(Type::Number)),
            Expr::BoolConstant(truth, _) => (Node::Truth((*truth).into()), Some(Type::Truth)),
            Expr::StringConstant(text, _) => (Node::Text(self.intern(text)), Some(Type::Text)),
            Expr::Unit(_) => (Node::Unknown, None),
            Expr::Variable(variable, _, position) => self.bare(&variable.1, *position)?,
            Expr::Dot(dot, ..) => match property_of(expr) {
                Some((variable, property, position)) => self.property(variable, property, position)?,
                None => match &dot.rhs {
                    Expr::MethodCall(call, position) => {
                        let arguments: Vec<&Expr> = std::iter::once(&dot.lhs).chain(&call.args).collect();
                        self.call(&call.name, &arguments, *position)?
                    }
                    _ => return Err(Stop::Interpret),
                },
            },
            Expr::And(parts, _) => (Node::And(flat(self.truths(parts)?)), Some(Type::Truth)),
            Expr::Or(parts, _) => (Node::Or(self.truths(parts)?), Some(Type::Truth)),
            Expr::Coalesce(parts, position) => self.coalesce(parts, *position)?,
            Expr::FnCall(call, position) if !call.is_qualified() => {
                let arguments: Vec<&Expr> = call.args.iter().collect();
                self.call(&call.name, &arguments, *position)?
            }
            Expr::InterpolatedString(parts, _) => self.written(parts)?,
            Expr::Stmt(block) => self.value_of(block)?,
            _ => return Err(Stop::Interpret),
        })
    }

    fn truths(&mut self, parts: &[Expr]) -> Result<Vec<Node>, Stop> {
        let mut nodes = vec![];
        for part in parts {
            let typed = self.lower(part)?;
            nodes.push(self.narrow(typed, Type::Truth, part.start_position())?);
        }
        Ok(nodes)
    }

    fn coalesce(&mut self, parts: &[Expr], position: Position) -> Result<Typed, Stop> {
        let mut parts = parts.iter();
        let mut typed = match parts.next() {
            Some(first) => self.lower(first)?,
            None => return Ok((Node::Unknown, None)),
        };
        for part in parts {
            let other = self.lower(part)?;
            let (a, b, kind) = self.unify(typed, other, position, stand_in)?;
            typed = (Node::Coalesce(Box::new(a), Box::new(b)), kind);
        }
        Ok(typed)
    }

    fn written(&mut self, parts: &[Expr]) -> Result<Typed, Stop> {
        let mut whole = Node::Text(self.intern(""));
        for part in parts {
            let (node, kind) = self.lower(part)?;
            if kind.is_none_or(|kind| kind == Type::Truth) {
                return Err(Stop::Interpret);
            }
            whole = Node::Concat(Box::new(whole), Box::new(node));
        }
        Ok((whole, Some(Type::Text)))
    }

    /// The value of `if a { b } else { c }`, or of a block of one expression.
    fn value_of(&mut self, block: &StmtBlock) -> Result<Typed, Stop> {
        match block.statements() {
            [Stmt::Expr(expr)] => self.lower(expr),
            [Stmt::Block(block)] => self.value_of(block),
            [Stmt::FnCall(call, position)] if !call.is_qualified() => {
                let arguments: Vec<&Expr> = call.args.iter().collect();
                self.call(&call.name, &arguments, *position)
            }
            [Stmt::If(flow, position)] if !flow.branch.is_empty() => {
                let typed = self.lower(&flow.expr)?;
                let condition = self.narrow(typed, Type::Truth, flow.expr.start_position())?;
                let (yes, no) = (self.value_of(&flow.body)?, self.value_of(&flow.branch)?);
                let (yes, no, kind) = self.unify(yes, no, *position, branches)?;
                Ok((Node::Choose(Box::new(condition), Box::new(yes), Box::new(no)), kind))
            }
            _ => Err(Stop::Interpret),
        }
    }

    fn bare(&mut self, name: &str, position: Position) -> Result<Typed, Stop> {
        if let Some(local) = self.locals.iter().rev().find(|local| local.name == name) {
            return Ok((Node::Local(local.slot), local.kind));
        }
        if let Some((clause, _)) = self.numbers().find(|(_, number)| *number == name) {
            return Ok((Node::Aggregate(clause), Some(Type::Number)));
        }
        if let Some(constant) = self.file.constants.get(name) {
            return Ok(self.literal(constant));
        }
        if let Some(own) = self.own {
            let variable = self.variables[own].clone();
            return self.property(&variable, name, position);
        }
        self.problem(Code::UnknownVariable, position, format!("nothing here is called `{name}`"));
        Err(Stop::Wrong)
    }

    pub(crate) fn property(
        &mut self,
        variable: &str,
        property: &str,
        position: Position,
    ) -> Result<Typed, Stop> {
        let Some(index) = self.variable(variable) else { return Err(Stop::Interpret) };
        if let Some(&(slot, kind)) = self.certain.get(&(index, property.to_owned())) {
            return Ok((Node::Local(slot), kind));
        }
        let name = PropertyName::new(&self.rule.clauses[index].class, property);
        match self.kinds.kind(&name) {
            Kind::Missing => {
                let known = self.kinds.properties(&name.class);
                let known = known.iter().map(String::as_str);
                self.complain(self.file.unknown_property(position, &name, known));
                Err(Stop::Wrong)
            }
            Kind::Holds(kind) => Ok((Node::Property { variable: index, column: self.column(name) }, kind)),
        }
    }

    pub(crate) fn column(&mut self, name: PropertyName) -> usize {
        self.columns.iter().position(|column| *column == name).unwrap_or_else(|| {
            self.columns.push(name);
            self.columns.len() - 1
        })
    }

    pub(crate) fn narrow(
        &mut self,
        (node, kind): Typed,
        wanted: Type,
        position: Position,
    ) -> Result<Node, Stop> {
        match kind {
            Some(kind) if kind == wanted => Ok(node),
            Some(kind) => {
                let message =
                    format!("{} are wanted here, and this gives {}", wanted.plural(), kind.plural());
                self.problem(Code::Type, position, message);
                Err(Stop::Wrong)
            }
            None => Ok(Node::Narrow(wanted, Box::new(node))),
        }
    }

    /// A value that is given to a property, brought to the type that is wanted of it; `what` gives it.
    pub(super) fn given(
        &mut self,
        what: &str,
        name: &PropertyName,
        wanted: Option<Type>,
        (node, kind): Typed,
        position: Position,
    ) -> Result<Typed, Stop> {
        match (wanted, kind) {
            (Some(wanted), Some(kind)) if wanted != kind => {
                let message = format!("{name} holds {}, and {what} gives {}", wanted.plural(), kind.plural());
                self.problem(Code::Type, position, message);
                Err(Stop::Wrong)
            }
            (Some(wanted), None) => Ok((Node::Narrow(wanted, Box::new(node)), Some(wanted))),
            (_, kind) => Ok((node, kind)),
        }
    }

    /// Two nodes brought to one type; `differ` words what is wrong where they hold two.
    fn unify(
        &mut self,
        (a, kind_a): Typed,
        (b, kind_b): Typed,
        position: Position,
        differ: fn(&str, &str) -> String,
    ) -> Result<(Node, Node, Option<Type>), Stop> {
        match (kind_a, kind_b) {
            (Some(kind), Some(other)) if kind != other => {
                self.problem(Code::Type, position, differ(kind.plural(), other.plural()));
                Err(Stop::Wrong)
            }
            (Some(kind), None) => Ok((a, Node::Narrow(kind, Box::new(b)), Some(kind))),
            (None, Some(kind)) => Ok((Node::Narrow(kind, Box::new(a)), b, Some(kind))),
            (kind, _) => Ok((a, b, kind)),
        }
    }

    pub(crate) fn compare(
        &mut self,
        comparison: Comparison,
        a: &Expr,
        b: &Expr,
        position: Position,
    ) -> Result<Typed, Stop> {
        let (a, b) = (self.lower(a)?, self.lower(b)?);
        let (a, b, kind) = self.unify(a, b, position, compared)?;
        let ordered = !matches!(comparison, Comparison::Equal | Comparison::Unequal);
        if ordered && kind == Some(Type::Truth) {
            self.problem(Code::Type, position, "truth values have no order");
            return Err(Stop::Wrong);
        }
        Ok((Node::Compare(comparison, Box::new(a), Box::new(b)), Some(Type::Truth)))
    }

    pub(super) fn literal(&self, value: &Value) -> Typed {
        let node = match value {
            Value::Number(number) => Node::Number(*number),
            Value::Text(text) => Node::Text(self.intern(text)),
            Value::Truth(truth) => Node::Truth((*truth).into()),
        };
        (node, Some(value.kind()))
    }

    pub(crate) fn intern(&self, text: &str) -> Symbol {
        self.symbols.write().intern(text)
    }

    fn interpreted(&mut self, expr: &Expr) -> Result<Typed, Stop> {
        let mut names = Names::default();
        let patterns = self.variables.clone();
        names.expression(expr, &Patterns(&patterns), self.own);
        let statement = Stmt::Expr(Box::new(expr.clone()));
        let fragment = self.fragment(vec![statement], &names, expr.start_position())?;
        Ok((Node::Interpret(Box::new(fragment)), None))
    }

    pub(crate) fn fragment(
        &mut self,
        statements: Vec<Stmt>,
        names: &Names,
        position: Position,
    ) -> Result<Fragment, Stop> {
        let mut objects: BTreeMap<String, Object> = BTreeMap::new();
        let mut bare = vec![];
        let free: BTreeSet<&str> = names.free.iter().map(|(name, _)| name.as_str()).collect();
        for ((variable, property), &place) in &names.reads {
            let name = self.variables[*variable].clone();
            if self.own == Some(*variable) && self.is_given(property) {
                continue;
            }
            let source = match self.property(&name, property, place)? {
                (Node::Property { column, .. }, _) => Source::Column(column),
                (Node::Local(slot), _) => Source::Slot(slot),
                _ => continue,
            };
            if let (Some(own), Source::Column(column)) = (self.own, source)
                && own == *variable
            {
                bare.push((property.clone(), own, column));
            }
            let object = objects.entry(name).or_default();
            object.variable = *variable;
            object.properties.push((property.clone(), source));
        }
        let constants =
            self.file.constants.iter().map(|(name, constant)| (name.clone(), constant.into())).collect();
        let locals = self
            .locals
            .iter()
            .map(|local| (local.name.clone(), local.slot, free.contains(local.name.as_str())))
            .collect();
        let own = |name: &str| self.own.is_some_and(|own| names.reads.contains_key(&(own, name.to_owned())));
        let numbers = self
            .numbers()
            .filter(|(_, name)| free.contains(name) || own(name))
            .map(|(clause, name)| (name.to_owned(), clause))
            .collect();
        let script = AST::new(statements, self.file.functions.clone());
        let file = Arc::clone(&self.file);
        Ok(Fragment { script, file, position, objects, bare, numbers, constants, locals })
    }

    fn numbers(&self) -> impl Iterator<Item = (usize, &'r str)> {
        let rule = self.rule;
        let number = |(clause, of): (usize, &'r Clause)| Some((clause, of.number.as_ref()?.0.as_str()));
        rule.clauses.iter().enumerate().filter_map(number)
    }

    fn is_given(&self, name: &str) -> bool {
        self.numbers().any(|(_, number)| number == name)
            || self.file.constants.contains_key(name)
            || self.locals.iter().any(|local| local.name == name)
    }
}

/// `(a && b) && c` is one condition of three parts.
fn flat(parts: Vec<Node>) -> Vec<Node> {
    let inner = |part| if let Node::And(inner) = part { inner } else { vec![part] };
    parts.into_iter().flat_map(inner).collect()
}

fn compared(these: &str, those: &str) -> String {
    format!("{these} cannot be compared with {those}")
}

fn stand_in(these: &str, those: &str) -> String {
    format!("{those} cannot stand in for {these} that are unknown")
}

fn branches(these: &str, those: &str) -> String {
    format!("this gives {these} in one case and {those} in the other")
}
