//! Spaces and doorways as the inference knows them, as rows, and as the facts that their planner gave.

use adit_db::Tx;
use adit_db::space::{Doorway, Space};
use adit_engine::KnowledgeBase as Inference;
use adit_planners::facts::{Column, Table};
use adit_planners::world::World;

use crate::error::Result;
use crate::graph::{Building, OneWay};
use crate::knowledge::classes;

/// Spaces and doorways as the inference knows them, with what rules say; those that lack what planners give are none.
pub fn known(knowledge: &Inference) -> Building {
    let column = |class: &str, property: &str| classes::column(knowledge, class, property);
    let numbers = |class: &str, property: &str| match column(class, property) {
        Some(Column::Number(values)) => values,
        _ => Vec::new(),
    };
    let texts = |class: &str, property: &str| match column(class, property) {
        Some(Column::Text(values)) => values,
        _ => Vec::new(),
    };
    let truths = |class: &str, property: &str| match column(class, property) {
        Some(Column::Truth(values)) => values,
        _ => Vec::new(),
    };
    let [keys, areas, breadths, x, y] =
        ["space", "area", "breadth", "x", "y"].map(|property| numbers("SPACES", property));
    let [called, names, kinds, outlines] =
        ["called", "name", "kind", "outline"].map(|property| texts("SPACES", property));
    let closed = truths("SPACES", "closed");
    let space = |row: usize| {
        Some(Space {
            space: at(&keys, row)? as i64,
            called: at(&called, row),
            name: at(&names, row),
            kind: at(&kinds, row),
            area: at(&areas, row)?,
            breadth: at(&breadths, row)?,
            x: at(&x, row)?,
            y: at(&y, row)?,
            outline: at(&outlines, row)?,
            closed: at(&closed, row),
        })
    };
    let spaces = (0..keys.len()).filter_map(space).collect();
    let [keys, one, other, x, y, x0, y0, x1, y1, widths, heights] =
        ["doorway", "space1", "space2", "x", "y", "x0", "y0", "x1", "y1", "width", "height"]
            .map(|property| numbers("DOORWAYS", property));
    let [called, names, closed_from] =
        ["called", "name", "closed_from"].map(|property| texts("DOORWAYS", property));
    let closed = truths("DOORWAYS", "closed");
    let doorway = |row: usize| {
        Some(Doorway {
            doorway: at(&keys, row)? as i64,
            called: at(&called, row),
            name: at(&names, row),
            space1: at(&one, row)? as i64,
            space2: at(&other, row)? as i64,
            x: at(&x, row)?,
            y: at(&y, row)?,
            x0: at(&x0, row)?,
            y0: at(&y0, row)?,
            x1: at(&x1, row)?,
            y1: at(&y1, row)?,
            width: at(&widths, row)?,
            height: at(&heights, row),
            closed: at(&closed, row),
            closed_from: at(&closed_from, row),
        })
    };
    let doorways = (0..keys.len()).filter_map(doorway).collect();
    Building { spaces, doorways, ..Building::default() }
}

/// The areas that one goes through in one direction, as the inference knows them, by name.
pub fn one_ways(knowledge: &Inference, world: &World) -> Vec<OneWay> {
    let Some(Column::Number(headings)) = classes::column(knowledge, "AREAS", "heading") else {
        return Vec::new();
    };
    let Some(Column::Text(names)) = classes::column(knowledge, "AREAS", "area") else { return Vec::new() };
    let mut found: Vec<OneWay> = std::iter::zip(names, headings)
        .filter_map(|(name, heading)| {
            let (area, heading) = (name?, heading?);
            let of = world.areas.iter().find(|of| of.name == area)?;
            Some(OneWay { area, heading, corners: of.shape.corners() })
        })
        .collect();
    found.sort_by(|one, other| one.area.cmp(&other.area));
    found
}

/// What the planner of spaces and doorways gave of one of its classes, as the last build kept it; `None` for another class.
pub fn recalled(class: &str, tx: &mut Tx<'_>) -> Result<Option<Table>> {
    Ok(match class {
        "SPACES" => {
            let rows = tx.spaces()?;
            let number = |of: fn(&Space) -> f64| rows.iter().map(of).collect::<Column>();
            let table = Table::default()
                .with("space", number(|row| row.space as f64))
                .with("called", rows.iter().map(|row| row.called.clone()).collect::<Column>())
                .with("area", number(|row| row.area))
                .with("breadth", number(|row| row.breadth))
                .with("x", number(|row| row.x))
                .with("y", number(|row| row.y));
            let closed = Column::Truth(vec![None; rows.len()]);
            let outlines = rows.into_iter().map(|row| row.outline).collect::<Column>();
            Some(table.with("outline", outlines).with("closed", closed))
        }
        "DOORWAYS" => {
            let rows = tx.doorways()?;
            let number = |of: fn(&Doorway) -> f64| rows.iter().map(of).collect::<Column>();
            let table = Table::default()
                .with("doorway", number(|row| row.doorway as f64))
                .with("called", rows.iter().map(|row| row.called.clone()).collect::<Column>())
                .with("space1", number(|row| row.space1 as f64))
                .with("space2", number(|row| row.space2 as f64))
                .with("x", number(|row| row.x))
                .with("y", number(|row| row.y))
                .with("x0", number(|row| row.x0))
                .with("y0", number(|row| row.y0))
                .with("x1", number(|row| row.x1))
                .with("y1", number(|row| row.y1))
                .with("width", number(|row| row.width));
            let closed = Column::Truth(vec![None; rows.len()]);
            let closed_from = Column::Text(vec![None; rows.len()]);
            let heights = rows.iter().map(|row| row.height).collect::<Column>();
            Some(table.with("height", heights).with("closed", closed).with("closed_from", closed_from))
        }
        _ => None,
    })
}

fn at<T: Clone>(values: &[Option<T>], row: usize) -> Option<T> {
    values.get(row).cloned().flatten()
}
