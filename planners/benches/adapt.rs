//! Tasks of a two-link arm: the first ones, while it learns, later ones along what it learned; and a hundred with a change of
//! the cell in the middle, by repair on demand and by Solve alone. `adit experiment` times them with SQLite.
//! `cargo bench -p adit-planners --bench adapt`
#![allow(missing_docs)] // divan's macros

use std::f64::consts::PI;
use std::sync::Arc;

use adit_planners::adapt::{
    Adapt, Arm, ChangeFacts, EdgeFacts, Experiment, Judge, KeepNothing, LandmarkFacts, Limit, Method, Object,
    Plugins, Scenario, Settings, Shape, Strategy, TOUCHING_M, Trust, Workcell,
};
use adit_planners::geometry::Point;
use divan::{Bencher, black_box};

const HOME: [f64; 2] = [3.0, 0.0];
const GOALS: [[f64; 2]; 5] = [[0.9, -0.4], [-0.6, 0.4], [1.9, 0.4], [-1.8, -0.8], [0.0, -0.9]];

fn main() {
    divan::main();
}

struct Table;

impl Judge for Table {
    fn strategy(&mut self, _: &ChangeFacts) -> Strategy {
        Strategy::OnDemand
    }

    fn landmark(&mut self, facts: &LandmarkFacts<'_>) -> Option<f64> {
        Some(facts.distance_m)
    }

    fn trust(&mut self, _: &EdgeFacts) -> Trust {
        Trust::Verify
    }
}

fn post(name: &str, x: f64, y: f64) -> Object {
    let corners = [(-0.2, -0.2), (0.2, -0.2), (0.2, 0.2), (-0.2, 0.2)];
    let shape = corners.map(|(dx, dy)| Point::new(x + dx, y + dy)).to_vec();
    Object::fixed(name, Shape::new(shape).expect("a square is an outline"))
}

fn arm() -> Arc<Arm> {
    let limits = vec![Limit { low: -PI, high: PI }, Limit { low: -2.7, high: 2.7 }];
    Arc::new(Arm::new(Point::default(), vec![1.0, 0.9], 0.03, limits).expect("it is an arm"))
}

fn posts() -> Vec<Object> {
    vec![post("front", 1.3, 0.4), post("left", 0.3, 1.3), post("back", -1.1, 0.9), post("right", 0.8, -1.2)]
}

fn planner() -> Adapt {
    let cell = Workcell::new(arm(), posts(), TOUCHING_M).expect("names differ");
    Adapt::new(cell, Plugins::standard(), Settings::default(), HOME.to_vec())
}

#[divan::bench]
fn five_tasks_without_experience(bencher: Bencher) {
    bencher.with_inputs(planner).bench_local_refs(|adapt| {
        for goal in &GOALS {
            black_box(adapt.task(goal, &mut Table));
        }
    });
}

#[divan::bench]
fn five_tasks_that_were_done_before(bencher: Bencher) {
    let mut learned = planner();
    for goal in GOALS.iter().cycle().take(15) {
        learned.task(goal, &mut Table);
    }
    bencher.with_inputs(|| learned.clone()).bench_local_refs(|adapt| {
        for goal in &GOALS {
            black_box(adapt.task(goal, &mut Table));
        }
    });
}

/// A hundred tasks; after forty of them another post comes.
fn hundred_tasks(method: Method) {
    let scenario = Scenario {
        name: "posts".to_owned(),
        robot: arm(),
        objects: posts(),
        changed: [posts(), vec![post("new", -1.3, -0.6)]].concat(),
        change_after_task: 40,
        tasks: 100,
        home: HOME.to_vec(),
        goals: GOALS.map(|goal| goal.to_vec()).to_vec(),
        added_goals: vec![vec![1.5, -1.2]],
    };
    let experiment = Experiment {
        scenario: &scenario,
        plugins: &Plugins::standard(),
        settings: &Settings::default(),
        touching_m: TOUCHING_M,
        runs: 1,
        seed: 1,
        judge: &|| Box::new(Table),
        keeper: &|_, _| Box::new(KeepNothing),
        clock: &|| 0.0,
        progress: &|| (),
    };
    black_box(experiment.run(method).expect("names differ"));
}

#[divan::bench]
fn hundred_tasks_by_repair_on_demand() {
    hundred_tasks(Method::Adapt(Strategy::OnDemand));
}

#[divan::bench]
fn hundred_tasks_by_solve_alone() {
    hundred_tasks(Method::Solve);
}
