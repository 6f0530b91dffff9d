//! Goes through expressions to change them.

use rhai::{Expr, Stmt, StmtBlock};

type Change<'f> = &'f mut dyn FnMut(&mut Expr);

pub(super) fn expr_mut(expr: &mut Expr, change: Change) {
    change(expr);
    match expr {
        Expr::InterpolatedString(parts, _) | Expr::Array(parts, _) => {
            parts.iter_mut().for_each(|part| expr_mut(part, change));
        }
        Expr::Map(map, _) => map.0.iter_mut().for_each(|(_, value)| expr_mut(value, change)),
        Expr::FnCall(call, _) | Expr::MethodCall(call, _) => {
            call.args.iter_mut().for_each(|argument| expr_mut(argument, change));
        }
        Expr::Dot(sides, ..) | Expr::Index(sides, ..) => {
            expr_mut(&mut sides.lhs, change);
            expr_mut(&mut sides.rhs, change);
        }
        Expr::And(parts, _) | Expr::Or(parts, _) | Expr::Coalesce(parts, _) => {
            parts.iter_mut().for_each(|part| expr_mut(part, change));
        }
        Expr::Stmt(block) => block_mut(block, change),
        _ => {}
    }
}

/// Changes all expressions of a block, but for the places that are assigned.
pub(super) fn block_mut(block: &mut StmtBlock, change: Change) {
    block.statements_mut().iter_mut().for_each(|stmt| stmt_mut(stmt, change));
}

fn stmt_mut(stmt: &mut Stmt, change: Change) {
    match stmt {
        Stmt::If(flow, _) | Stmt::While(flow, _) | Stmt::Do(flow, ..) | Stmt::TryCatch(flow, _) => {
            expr_mut(&mut flow.expr, change);
            block_mut(&mut flow.body, change);
            block_mut(&mut flow.branch, change);
        }
        Stmt::For(each, _) => {
            expr_mut(&mut each.2.expr, change);
            block_mut(&mut each.2.body, change);
        }
        Stmt::Switch(switch, _) => {
            expr_mut(&mut switch.0, change);
            for case in &mut switch.1.expressions {
                expr_mut(&mut case.lhs, change);
                expr_mut(&mut case.rhs, change);
            }
        }
        Stmt::Var(var, ..) => expr_mut(&mut var.1, change),
        Stmt::Assignment(assignment) => expr_mut(&mut assignment.1.rhs, change),
        Stmt::FnCall(call, _) => call.args.iter_mut().for_each(|argument| expr_mut(argument, change)),
        Stmt::Block(block) => block_mut(block, change),
        Stmt::Expr(expr) | Stmt::BreakLoop(Some(expr), ..) | Stmt::Return(Some(expr), ..) => {
            expr_mut(expr, change);
        }
        _ => {}
    }
}
