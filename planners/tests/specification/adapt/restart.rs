//! A planner that was written down as rows and read again goes on exactly as one that never stopped.

use adit_planners::adapt::{
    Adapt, Clearance, Edge, Experience, ExperienceError, Noted, Placed, Settings, Strategy, Vertex, VertexId,
    Workcell,
};

use super::support::{Table, arm, moved, planner, plugins, rect};

const GOALS: [[f64; 2]; 6] = [[1.6, 0.4], [-0.6, -0.5], [2.4, 0.9], [0.9, 1.5], [-1.6, 0.7], [1.6, 0.4]];

fn objects() -> Vec<adit_planners::adapt::Object> {
    vec![rect("box", [1.2, -0.2, 1.5, 0.1]), rect("shelf", [-0.4, 1.2, 0.3, 1.5])]
}

/// Everything that is kept of a planner.
fn reread(adapt: &Adapt) -> Adapt {
    let old = adapt.cell();
    let placed =
        old.placed().iter().map(|p| Placed::with(p.object.clone(), p.since, p.times_moved)).collect();
    let mut cell = Workcell::resume(arm(), placed, old.revision(), old.touching_m()).unwrap();
    let rows: Vec<(String, Clearance)> =
        old.clearances().map(|(object, row)| (object.to_owned(), row)).collect();
    for (object, row) in &rows {
        assert!(cell.recall(object, row));
    }
    // Rows of a table come in any order.
    let vertices: Vec<Vertex> =
        adapt.experience().vertices().cloned().collect::<Vec<_>>().into_iter().rev().collect();
    let edges: Vec<Edge> =
        adapt.experience().edges().cloned().collect::<Vec<_>>().into_iter().rev().collect();
    let graph = Experience::from_rows(vertices, edges, adapt.experience().next_numbers()).unwrap();
    Adapt::resume(cell, graph, plugins(), Settings::default(), adapt.progress().clone())
}

#[test]
fn a_restart_changes_nothing() {
    let mut judge = Table(Strategy::OnDemand);
    let mut going = planner(arm(), objects(), &[2.5, 0.0]);
    let mut stopping = going.clone();
    for (task, goal) in GOALS.iter().cycle().take(18).enumerate() {
        stopping = reread(&stopping);
        if task == 9 {
            let mut changed = objects();
            changed[1] = moved(&changed[1], 0.3, 0.05, 0.2);
            going.change(changed.clone(), &mut judge).unwrap();
            stopping.change(changed, &mut judge).unwrap();
        }
        assert_eq!(going.task(goal, &mut judge), stopping.task(goal, &mut judge));
    }
    assert_eq!(going.experience(), stopping.experience());
    assert_eq!(going.progress(), stopping.progress());
}

#[test]
fn rows_that_are_no_graph_are_refused() {
    let vertex = |id| Vertex { id: VertexId(id), at: vec![0.0], tag: None, made_task: 1 };
    let twice = Experience::from_rows(vec![vertex(1), vertex(1)], vec![], (2, 0));
    assert_eq!(twice.unwrap_err(), ExperienceError::Vertex(VertexId(1)));
    let beyond = Experience::from_rows(vec![vertex(2)], vec![], (2, 0));
    assert_eq!(beyond.unwrap_err(), ExperienceError::Vertex(VertexId(2)));
}

/// The rows that somebody keeps who is told only what changed.
#[derive(Default)]
struct Kept {
    vertices: std::collections::BTreeMap<VertexId, Vertex>,
    edges: std::collections::BTreeMap<(VertexId, VertexId), Edge>,
    clearances: Vec<(String, Clearance)>,
}

impl Kept {
    fn take(&mut self, noted: Noted) {
        match noted {
            Noted::VertexAdded(vertex) => drop(self.vertices.insert(vertex.id, vertex)),
            Noted::VertexMoved { id, at } => self.vertices.get_mut(&id).unwrap().at = at,
            Noted::VertexRemoved { id, .. } => drop(self.vertices.remove(&id).unwrap()),
            Noted::EdgeAdded(edge) | Noted::EdgeVerified(edge) | Noted::EdgeLoosened(edge) => {
                self.edges.insert(edge.ends, edge);
            }
            Noted::EdgeRemoved { ends, .. } => drop(self.edges.remove(&ends).unwrap()),
            Noted::Forgotten => *self = Self::default(),
            Noted::Learned { object, clearance } => self.clearances.push((object, clearance)),
            Noted::ClearancesForgotten { object } => self.clearances.retain(|row| row.0 != object),
            _ => (),
        }
    }
}

#[test]
fn what_is_noted_is_all_that_changed() {
    for strategy in [Strategy::Forget, Strategy::VerifyAll, Strategy::RepairAll, Strategy::OnDemand] {
        let mut judge = Table(strategy);
        let mut adapt = planner(arm(), objects(), &[2.5, 0.0]);
        let mut kept = Kept::default();
        for (task, goal) in GOALS.iter().cycle().take(20).enumerate() {
            let mut cell = objects();
            match task / 5 {
                0 => (),
                1 => cell.push(rect("new", [0.3, 0.9, 0.6, 1.1])),
                2 => cell[1] = moved(&cell[1], 0.3, 0.05, 0.2),
                _ => drop(cell.remove(1)),
            }
            adapt.change(cell, &mut judge).unwrap();
            adapt.task(goal, &mut judge);
            adapt.take_noted().into_iter().for_each(|noted| kept.take(noted));
            assert!(kept.vertices.values().eq(adapt.experience().vertices()), "{strategy:?} {task}");
            assert!(kept.edges.values().eq(adapt.experience().edges()), "{strategy:?} {task}");
            let mut rows: Vec<_> =
                adapt.cell().clearances().map(|(name, row)| format!("{name} {row:?}")).collect();
            let mut noted: Vec<_> =
                kept.clearances.iter().map(|(name, row)| format!("{name} {row:?}")).collect();
            rows.sort();
            noted.sort();
            assert_eq!(noted, rows, "{strategy:?} {task}");
        }
    }
}
