//! How each thing is bound to the columns of its table.

use super::numbers::{rows_text, text};
use super::{Cell, Clearance, Edge, Object, ObjectChange, Pair, Removed, Strategy, Subgoal, Task};
use crate::bulk::{Record, Values};

/// Something of a cell.
pub(super) struct Of<'s, T>(pub &'s str, pub T);

impl Record for &Cell {
    const TABLE: &'static str = "cells";
    const COLUMNS: &'static [&'static str] = &[
        "cell",
        "robot",
        "seed",
        "tasks",
        "revision",
        "next_subgoal",
        "next_edge",
        "configuration",
        "stands",
        "figures",
        "copied_from",
    ];

    fn bind(&self, values: &mut Values) {
        values.text(self.cell.as_str());
        values.text(self.robot.as_str());
        values.text(self.seed.as_str());
        values.integer(self.tasks);
        values.integer(self.revision);
        values.integer(self.next_subgoal);
        values.integer(self.next_edge);
        values.text(text(&self.configuration).as_str());
        values.integer(self.stands);
        values.text(self.figures.as_str());
        values.text(self.copied_from.as_deref());
    }
}

impl Record for Of<'_, (i64, &Object)> {
    const TABLE: &'static str = "cell_objects";
    const COLUMNS: &'static [&'static str] = &[
        "cell",
        "object",
        "number",
        "revision",
        "times_moved",
        "movable",
        "x",
        "y",
        "heading_rad",
        "polygon",
    ];

    fn bind(&self, values: &mut Values) {
        let Self(cell, (number, object)) = self;
        values.text(*cell);
        values.text(object.object.as_str());
        values.integer(*number);
        values.integer(object.revision);
        values.integer(object.times_moved);
        values.truth(object.movable);
        for number in object.pose {
            values.real(number);
        }
        values.text(rows_text(object.polygon.iter().map(|corner| corner.as_slice())).as_str());
    }
}

impl Record for Of<'_, &ObjectChange> {
    const TABLE: &'static str = "object_changes";
    const COLUMNS: &'static [&'static str] = &["cell", "revision", "object", "task", "how"];

    fn bind(&self, values: &mut Values) {
        let Self(cell, change) = self;
        values.text(*cell);
        values.integer(change.revision);
        values.text(change.object.as_str());
        values.integer(change.task);
        values.text(change.how);
    }
}

impl Record for Of<'_, &Subgoal> {
    const TABLE: &'static str = "subgoals";
    const COLUMNS: &'static [&'static str] = &[
        "cell",
        "subgoal",
        "configuration",
        "object",
        "tool_x",
        "tool_y",
        "tool_heading_rad",
        "branch",
        "made_task",
    ];

    fn bind(&self, values: &mut Values) {
        let Self(cell, subgoal) = self;
        let tag = subgoal.tag.as_ref();
        values.text(*cell);
        values.integer(subgoal.subgoal);
        values.text(text(&subgoal.configuration).as_str());
        values.text(tag.map(|tag| tag.object.as_str()));
        for at in 0..3 {
            values.real(tag.map(|tag| tag.tool[at]));
        }
        values.integer(tag.map(|tag| tag.branch));
        values.integer(subgoal.made_task);
    }
}

/// Where a subgoal is now.
pub(super) struct Moved<'s>(pub &'s str, pub &'s (i64, Vec<f64>));

impl Record for Moved<'_> {
    const TABLE: &'static str = "subgoals";
    const COLUMNS: &'static [&'static str] = &["cell", "subgoal", "configuration"];

    fn bind(&self, values: &mut Values) {
        let Self(cell, (subgoal, at)) = self;
        values.text(*cell);
        values.integer(*subgoal);
        values.text(text(at).as_str());
    }
}

/// A subgoal that was taken out.
pub(super) struct GoneSubgoal<'s>(pub &'s str, pub &'s Removed);

impl Record for GoneSubgoal<'_> {
    const TABLE: &'static str = "subgoals";
    const COLUMNS: &'static [&'static str] = &["cell", "subgoal", "removed_task", "because"];

    fn bind(&self, values: &mut Values) {
        let Self(cell, gone) = self;
        values.text(*cell);
        values.integer(gone.number);
        values.integer(gone.task);
        values.text(gone.because);
    }
}

impl Record for Of<'_, &Edge> {
    const TABLE: &'static str = "edges";
    const COLUMNS: &'static [&'static str] = &[
        "cell",
        "edge",
        "subgoal1",
        "subgoal2",
        "via",
        "loose",
        "length",
        "made_task",
        "verified_task",
        "verified_revision",
        "times_verified",
    ];

    fn bind(&self, values: &mut Values) {
        let Self(cell, edge) = self;
        values.text(*cell);
        values.integer(edge.edge);
        values.integer(edge.ends[0]);
        values.integer(edge.ends[1]);
        values.text(rows_text(edge.via.iter().map(Vec::as_slice)).as_str());
        values.truth(edge.loose);
        values.real(edge.length);
        values.integer(edge.made_task);
        values.integer(edge.verified_task);
        values.integer(edge.verified_revision);
        values.integer(edge.times_verified);
    }
}

/// An edge that was taken out.
pub(super) struct GoneEdge<'s>(pub &'s str, pub &'s Removed);

impl Record for GoneEdge<'_> {
    const TABLE: &'static str = "edges";
    const COLUMNS: &'static [&'static str] =
        &["cell", "edge", "removed_task", "removed_revision", "broken_by", "because"];

    fn bind(&self, values: &mut Values) {
        let Self(cell, gone) = self;
        values.text(*cell);
        values.integer(gone.number);
        values.integer(gone.task);
        values.integer(gone.revision);
        values.text(gone.object.as_deref());
        values.text(gone.because);
    }
}

/// What is said of a pair.
pub(super) const fn kind(pair: &Pair) -> &'static str {
    if pair.tightened { "tightened" } else { "refused" }
}

impl Record for Of<'_, &Pair> {
    const TABLE: &'static str = "subgoal_pairs";
    const COLUMNS: &'static [&'static str] = &["cell", "subgoal1", "subgoal2", "kind", "revision"];

    fn bind(&self, values: &mut Values) {
        let Self(cell, pair) = self;
        values.text(*cell);
        values.integer(pair.ends[0]);
        values.integer(pair.ends[1]);
        values.text(kind(pair));
        values.integer(pair.revision);
    }
}

impl Record for Of<'_, &Clearance> {
    const TABLE: &'static str = "clearances";
    const COLUMNS: &'static [&'static str] = &["cell", "object", "kind", "ax", "ay", "bx", "by", "within"];

    fn bind(&self, values: &mut Values) {
        let Self(cell, clearance) = self;
        values.text(*cell);
        values.text(clearance.object.as_str());
        values.text(if clearance.b.is_some() { "free" } else { "taken" });
        values.real(clearance.a[0]);
        values.real(clearance.a[1]);
        values.real(clearance.b.map(|b| b[0]));
        values.real(clearance.b.map(|b| b[1]));
        values.real(clearance.within);
    }
}

impl Record for Of<'_, &Task> {
    const TABLE: &'static str = "tasks";
    const COLUMNS: &'static [&'static str] = &[
        "cell",
        "task",
        "goal",
        "configuration",
        "found",
        "reason",
        "evaluations",
        "solve_calls",
        "reach_calls",
        "length",
        "path",
    ];

    fn bind(&self, values: &mut Values) {
        let Self(cell, task) = self;
        values.text(*cell);
        values.integer(task.task);
        values.text(task.goal.as_str());
        values.text(task.configuration.as_deref().map(text).as_deref());
        values.truth(task.reason.is_none());
        values.text(task.reason.as_deref());
        values.integer(task.evaluations);
        values.integer(task.solve_calls);
        values.integer(task.reach_calls);
        values.real(task.length);
        let path = task.path.as_ref().map(|path| rows_text(path.iter().map(Vec::as_slice)));
        values.text(path.as_deref());
    }
}

impl Record for Of<'_, &Strategy> {
    const TABLE: &'static str = "strategies";
    const COLUMNS: &'static [&'static str] =
        &["cell", "revision", "task", "strategy", "facts", "rule", "table_row", "file", "line"];

    fn bind(&self, values: &mut Values) {
        let Self(cell, chosen) = self;
        let rule = chosen.rule.as_ref();
        values.text(*cell);
        values.integer(chosen.revision);
        values.integer(chosen.task);
        values.text(chosen.strategy);
        values.text(chosen.facts.as_str());
        values.text(rule.map(|rule| rule.rule.as_str()));
        values.integer(rule.and_then(|rule| rule.row));
        values.text(rule.map(|rule| rule.file.as_str()));
        values.integer(rule.map(|rule| rule.line));
    }
}
