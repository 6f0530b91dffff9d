//! A cell as a site: the tables that its file fills, and motions between its goals (Chen).

use std::path::PathBuf;
use std::sync::Arc;

use adit_db::Cell as Value;
use adit_db::place::Place;
use adit_planners::adapt::{Arm, Configuration, Limit, Object, PointRobot, Settings, Shape, TOUCHING_M};
use adit_planners::floor_plan::outline;
use adit_planners::geometry::Point;
use adit_planners::planner::Planner;

use super::cell::{Cell, Goal, RobotKind, Target};
use super::draft::pose;
use super::judge::RuleJudge;
use super::motions::{HOME, Motions, ROBOT, written};
use crate::error::Result;
use crate::plan::consult::Class;
use crate::plan::course::{Asked, Course, ObjectsOf, Pathfinder, no_map, refuse_gaps};
use crate::plan::figures;
use crate::plan::rules::Kind;
use crate::site::figures::table;
use crate::site::tables::TableFile;
use crate::words::number::number;

const ARMS: [(&str, &str); 5] =
    [("robot", "TEXT"), ("x", "REAL"), ("y", "REAL"), ("link_radius", "REAL"), ("margin", "REAL")];
const JOINTS: [(&str, &str); 5] =
    [("joint", "INTEGER"), ("length", "REAL"), ("low", "REAL"), ("high", "REAL"), ("home", "REAL")];
const DISCS: [(&str, &str); 9] = [
    ("robot", "TEXT"),
    ("radius", "REAL"),
    ("x0", "REAL"),
    ("y0", "REAL"),
    ("x1", "REAL"),
    ("y1", "REAL"),
    ("home_x", "REAL"),
    ("home_y", "REAL"),
    ("margin", "REAL"),
];
const OBJECTS: [(&str, &str); 6] = [
    ("object", "TEXT"),
    ("outline", "TEXT"),
    ("x", "REAL"),
    ("y", "REAL"),
    ("heading", "REAL"),
    ("movable", "BOOLEAN"),
];
const GOALS: [(&str, &str); 6] = [
    ("goal", "TEXT"),
    ("object", "TEXT"),
    ("x", "REAL"),
    ("y", "REAL"),
    ("heading", "REAL"),
    ("configuration", "TEXT"),
];

/// A cell as its file has it.
#[derive(Debug)]
pub struct CellOf {
    pub file: PathBuf,
    pub cell: Cell,
}

fn text(of: &str) -> Value {
    Value::from(of)
}

fn corners(shape: &Shape) -> Value {
    let corners: Vec<[f64; 2]> = shape.corners().iter().map(|at| [at.x, at.y]).collect();
    text(&serde_json::json!(corners).to_string())
}

impl Course for CellOf {
    fn name(&self) -> &'static str {
        "cell"
    }

    fn tables(&self) -> Vec<TableFile> {
        let Cell { robot, objects, goals, home, .. } = &self.cell;
        let of_map = |name: &str, columns: &[(&str, &'static str)], rows| {
            TableFile::of_map(&self.file, name, (columns, 1), rows)
        };
        let mut tables = match robot {
            RobotKind::Arm(arm) => {
                let (base, radius) = (arm.base(), arm.radius());
                let row = [text(ROBOT), Value::Real(base.x), Value::Real(base.y), Value::Real(radius)];
                let row = row.into_iter().chain([Value::Real(TOUCHING_M)]).collect();
                let joints = (1..).zip(arm.lengths()).zip(robot.robot().limits().to_vec()).zip(home);
                let joints = joints.map(|(((joint, length), limit), home)| {
                    let reals = [*length, limit.low, limit.high, *home].map(Value::Real);
                    [vec![Value::Integer(joint)], reals.to_vec()].concat()
                });
                vec![of_map("arms", &ARMS, vec![row]), of_map("joints", &JOINTS, joints.collect())]
            }
            RobotKind::Point(point) => {
                let limits = robot.robot().limits().to_vec();
                let reals = [
                    point.radius(),
                    limits[0].low,
                    limits[1].low,
                    limits[0].high,
                    limits[1].high,
                    home[0],
                    home[1],
                    TOUCHING_M,
                ];
                let row = [vec![text(ROBOT)], reals.map(Value::Real).to_vec()].concat();
                vec![of_map("discs", &DISCS, vec![row])]
            }
        };
        let objects = objects.iter().map(|object| {
            let Object { name, shape, pose, is_movable } = object;
            vec![
                text(name),
                corners(shape),
                Value::Real(pose.at.x),
                Value::Real(pose.at.y),
                Value::Real(pose.heading.to_degrees()),
                Value::Integer((*is_movable).into()),
            ]
        });
        let goals = goals.iter().map(|Goal { name, target }| match target {
            Target::Configuration(at) => {
                let at = text(&serde_json::json!(at).to_string());
                vec![text(name), Value::Null, Value::Null, Value::Null, Value::Null, at]
            }
            Target::Tool { object, pose } => {
                let reals = [pose.at.x, pose.at.y, pose.heading.to_degrees()].map(Value::Real);
                [vec![text(name), text(object)], reals.to_vec(), vec![Value::Null]].concat()
            }
        });
        tables.push(of_map("objects", &OBJECTS, objects.collect()));
        tables.push(of_map("goals", &GOALS, goals.collect()));
        tables.push(table(&self.file, "learning", Settings::FIGURES, &self.cell.settings));
        tables
    }

    fn places(&self) -> Vec<Place> {
        Vec::new()
    }

    fn planner(&self) -> Option<Arc<dyn Planner>> {
        None
    }

    fn asks(&self) -> Vec<Class> {
        Kind::Adapt.classes()
    }

    fn pathfinder(&self, asked: &Asked<'_>) -> Result<Box<dyn Pathfinder>> {
        let (cell, margin) = self.cell_now(asked)?;
        let goal_table = asked.objects("GOALS");
        let action = |row: usize| Some((goal_table.text(row, "goal")?, goal_table.text(row, "action")?));
        let actions = goal_table.rows().filter_map(action).collect();
        let judge = RuleJudge::of_site(asked, None, false)?;
        Ok(Box::new(Motions::new((cell, margin), actions, judge)?))
    }
}

impl CellOf {
    /// The cell as its tables have it, and how near the robot may come to objects, metres.
    pub fn cell_now(&self, asked: &Asked<'_>) -> Result<(Cell, f64)> {
        let (robot, home, margin) = match &self.cell.robot {
            RobotKind::Arm(_) => arm(asked)?,
            RobotKind::Point(_) => disc(asked)?,
        };
        let objects = objects(asked.objects("OBJECTS"))?;
        let goals = goals(asked.objects("GOALS"), &robot)?;
        let mut settings = Settings::default();
        figures::read(asked.objects("LEARNING"), Settings::FIGURES, &mut settings)?;
        let cell = Cell { robot, objects, home, goals, settings, change: None, ..self.cell.clone() };
        let known = cell.goals.iter().find_map(|goal| match &goal.target {
            Target::Tool { object, .. } if cell.object(object).is_none() => {
                Some((goal.name.clone(), object.clone()))
            }
            _ => None,
        });
        if let Some((goal, object)) = known {
            return Err(no_map(format!("goals {goal}: there is no object `{object}`")));
        }
        Ok((cell, margin))
    }
}

fn margin(of: ObjectsOf<'_>, row: usize) -> Result<f64> {
    let margin = of.number(row, "margin").unwrap_or(TOUCHING_M);
    let found = margin.to_string();
    if margin > 0.0 { Ok(margin) } else { Err(of.wrong(row, "margin", "more than 0", Some(&found))) }
}

/// The arm as its tables have it, where it begins, and how near it may come to objects.
fn arm(asked: &Asked<'_>) -> Result<(RobotKind, Configuration, f64)> {
    let (arms, joints) = (asked.objects("ARMS"), asked.objects("JOINTS"));
    refuse_gaps(joints, "joint")?;
    if arms.rows().len() != 1 {
        return Err(no_map(format!(
            "a cell has one robot, and the table arms has {} rows",
            arms.rows().len()
        )));
    }
    let of = |name: &str| joints.rows().map(|row| joints.needed(row, name)).collect::<Result<Vec<f64>>>();
    let (low, high) = (of("low")?, of("high")?);
    let limits = low.into_iter().zip(high).map(|(low, high)| Limit { low, high }).collect();
    let base = Point::new(arms.number(0, "x").unwrap_or(0.0), arms.number(0, "y").unwrap_or(0.0));
    let radius = arms.number(0, "link_radius").unwrap_or(0.0);
    let arm = Arm::new(base, of("length")?, radius, limits).map_err(no_map)?;
    let robot = RobotKind::Arm(Arc::new(arm));
    let home = of("home")?;
    admitted("home", &home, &robot)?;
    Ok((robot, home, margin(arms, 0)?))
}

fn disc(asked: &Asked<'_>) -> Result<(RobotKind, Configuration, f64)> {
    let discs = asked.objects("DISCS");
    if discs.rows().len() != 1 {
        return Err(no_map(format!(
            "a cell has one robot, and the table discs has {} rows",
            discs.rows().len()
        )));
    }
    let of = |name| discs.needed(0, name);
    let limits = [Limit { low: of("x0")?, high: of("x1")? }, Limit { low: of("y0")?, high: of("y1")? }];
    let radius = of("radius")?;
    if limits.iter().any(|limit| limit.low >= limit.high) || radius < 0.0 {
        return Err(no_map("discs: expected x0 < x1, y0 < y1 and a radius of 0 at least"));
    }
    let robot = RobotKind::Point(Arc::new(PointRobot::new(limits, radius)));
    let home = vec![of("home_x")?, of("home_y")?];
    admitted("home", &home, &robot)?;
    Ok((robot, home, margin(discs, 0)?))
}

/// Refuses a configuration that the robot cannot have.
fn admitted(what: &str, at: &[f64], robot: &RobotKind) -> Result<()> {
    if robot.robot().admits(at) {
        return Ok(());
    }
    let limits: Vec<String> = robot
        .robot()
        .limits()
        .iter()
        .map(|limit| format!("{} to {}", number(limit.low), number(limit.high)))
        .collect();
    Err(no_map(format!(
        "{what} is {}, expected {} numbers within {}",
        written(at),
        limits.len(),
        limits.join(" and ")
    )))
}

fn objects(table: ObjectsOf<'_>) -> Result<Vec<Object>> {
    let object = |row: usize| -> Result<Object> {
        let text = table.text(row, "outline").unwrap_or_default();
        let corners =
            outline(&text).map_err(|_| table.wrong(row, "outline", "corners as [[x,y],…]", Some(&text)))?;
        let name = table.text(row, "object").unwrap_or_default();
        let shape = Shape::new(corners).map_err(|error| no_map(format!("objects {name}: {error}")))?;
        let at = [table.number(row, "x").unwrap_or(0.0), table.number(row, "y").unwrap_or(0.0)];
        let pose = pose(at, table.number(row, "heading").unwrap_or(0.0));
        Ok(Object { name, shape, pose, is_movable: table.truth(row, "movable") })
    };
    table.rows().map(object).collect()
}

fn goals(table: ObjectsOf<'_>, robot: &RobotKind) -> Result<Vec<Goal>> {
    let goal = |row: usize| -> Result<Goal> {
        let name = table.text(row, "goal").unwrap_or_default();
        if name == HOME {
            return Err(no_map("goals home: that is where the robot begins; call the goal otherwise"));
        }
        let target = match (table.text(row, "object"), table.text(row, "configuration")) {
            (Some(object), _) => {
                let at = [table.needed(row, "x")?, table.needed(row, "y")?];
                let pose = pose(at, table.number(row, "heading").unwrap_or(0.0));
                Target::Tool { object, pose }
            }
            (None, Some(text)) => {
                let wrong = |_| table.wrong(row, "configuration", "numbers as [a,b]", Some(&text));
                let at: Vec<f64> = serde_json::from_str(&text).map_err(wrong)?;
                admitted(&format!("goals {name}: configuration"), &at, robot)?;
                Target::Configuration(at)
            }
            (None, None) => {
                return Err(table.wrong(
                    row,
                    "configuration",
                    "numbers as [a,b], or an object and a point in its frame",
                    None,
                ));
            }
        };
        Ok(Goal { name, target })
    };
    table.rows().map(goal).collect()
}
