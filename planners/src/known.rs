//! Known facts as planners read them: a missing or unknown value is an error that names the object.

use crate::facts::{Column, Facts, Table};
use crate::geometry::{Convex, Rect};
use crate::planner::PlannerError;
use crate::rooms::outline;

/// A class that a planner reads.
pub(crate) struct KnownClass<'a> {
    planner: &'a str,
    class: &'a str,
    table: &'a Table,
}

impl<'a> KnownClass<'a> {
    pub(crate) fn find(planner: &'a str, class: &'a str, facts: &'a Facts) -> Result<Self, PlannerError> {
        let missing = || error(planner, class, "the class is missing".to_owned());
        Ok(Self { planner, class, table: facts.get(class).ok_or_else(missing)? })
    }

    /// The property of each object, in metres where it is a length.
    pub(crate) fn numbers(&self, property: &str) -> Result<Vec<f64>, PlannerError> {
        let column = self.table.numbers(property).map_err(|what| self.error(what))?;
        self.all_known(property, column)
    }

    pub(crate) fn truths(&self, property: &str) -> Result<Vec<bool>, PlannerError> {
        let column = self.table.truths(property).map_err(|what| self.error(what))?;
        self.all_known(property, column)
    }

    /// The objects' rectangles, from their properties x0, y0, x1, y1.
    pub(crate) fn rects(&self) -> Result<Vec<Rect>, PlannerError> {
        let (x0, y0) = (self.numbers("x0")?, self.numbers("y0")?);
        let (x1, y1) = (self.numbers("x1")?, self.numbers("y1")?);
        let edges = x0.into_iter().zip(y0).zip(x1.into_iter().zip(y1));
        Ok(edges.map(|((x0, y0), (x1, y1))| Rect::new(x0, y0, x1, y1)).collect())
    }

    /// The outlines of rooms; rectangles where nobody gives any.
    pub(crate) fn outlines(&self) -> Result<Vec<Convex>, PlannerError> {
        if !self.table.columns.iter().any(|(property, _)| property == "outline") {
            return Ok(self.rects()?.into_iter().map(Convex::from).collect());
        }
        let texts = self.table.texts("outline").map_err(|what| self.error(what))?;
        let read = |(place, (bounds, text)): (usize, (Rect, &Option<String>))| {
            let read = outline::read(text.as_deref(), bounds);
            read.map_err(|what| self.error(format!("`outline` of object {} {what}", place + 1)))
        };
        self.rects()?.into_iter().zip(texts).enumerate().map(read).collect()
    }

    fn all_known<T: Copy>(&self, property: &str, column: &[Option<T>]) -> Result<Vec<T>, PlannerError> {
        let unknown = |place| {
            self.error(format!(
                "property `{property}` of object {} of {} is unknown",
                place + 1,
                column.len()
            ))
        };
        column.iter().enumerate().map(|(place, value)| value.ok_or_else(|| unknown(place))).collect()
    }

    fn error(&self, what: String) -> PlannerError {
        error(self.planner, self.class, what)
    }
}

fn error(planner: &str, class: &str, what: String) -> PlannerError {
    PlannerError::Fact { planner: planner.to_owned(), class: class.to_owned(), what }
}

/// The table with the properties x0, y0, x1, y1 of each object's rectangle.
pub(crate) fn with_edges(table: Table, rects: &[Rect]) -> Table {
    let edge = |of: fn(&Rect) -> f64| rects.iter().map(of).collect::<Column>();
    table
        .with("x0", edge(|rect| rect.x0))
        .with("y0", edge(|rect| rect.y0))
        .with("x1", edge(|rect| rect.x1))
        .with("y1", edge(|rect| rect.y1))
}

/// Keys 1, 2, ... for so many objects.
pub(crate) fn keys(objects: usize) -> Column {
    (1..=objects).map(|key| key as f64).collect()
}
