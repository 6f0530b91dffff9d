//! The strategies after a change (Chen 1994, section 2.5) on a cell of our own: after task 40 one half of it is
//! filled with fixtures, and most goals are of a new product in the other half.

use adit_planners::adapt::{Curve, Method, Scenario, Strategy};

use super::arm_scenario::ArmScenario;
use super::figure_5::run;

const CELL: &str = include_str!("../../../../kb/worlds/new-product.json");

/// Strategies on the same tasks; none of them fails.
fn curves<const N: usize>(all: [Strategy; N], runs: u32) -> [Curve; N] {
    let file: ArmScenario = serde_json::from_str(CELL).unwrap();
    let scenario = Scenario::try_from(&file).unwrap();
    let curves = all.map(|strategy| run(&scenario, runs, Method::Adapt(strategy)));
    for (curve, strategy) in curves.iter().zip(all) {
        assert_eq!(curve.rows.iter().map(|row| row.failures).sum::<u32>(), 0, "{strategy:?}");
    }
    curves
}

/// By how many evaluations a method exceeds another one up to a task, run by run: mean and its standard error.
fn excess(method: &Curve, other: &Curve, task: usize) -> (f64, f64) {
    let pairs = method.evaluations.iter().zip(&other.evaluations);
    let excess: Vec<f64> = pairs.map(|(a, b)| a[task - 1] as f64 - b[task - 1] as f64).collect();
    let count = excess.len() as f64;
    let mean = excess.iter().sum::<f64>() / count;
    let squares: f64 = excess.iter().map(|x| (x - mean).powi(2)).sum();
    (mean, (squares / (count - 1.0) / count).sqrt())
}

/// The first method exceeds the second one by more than so many standard errors.
fn assert_dearer(name: &str, dear: &Curve, cheap: &Curve, task: usize, errors: f64) {
    let (mean, error) = excess(dear, cheap, task);
    assert!(mean > errors * error, "{name} at {task}: {mean:.1}, standard error {error:.1}");
}

const ALL: [Strategy; 4] = [Strategy::Forget, Strategy::VerifyAll, Strategy::RepairAll, Strategy::OnDemand];

/// Too few runs for standard errors: the order of the means.
#[test]
fn after_the_change_on_demand_is_cheapest_and_forgetting_dearest_and_repairing_all_jumps() {
    let [a0, a1, a2, a3] = curves(ALL, 12);
    for (name, other) in [("A2 over A0", &a0), ("A2 over A1", &a1), ("A2 over A3", &a3)] {
        assert_dearer(name, &a2, other, 41, 0.0);
    }
    for task in [60, 80, 100] {
        assert_dearer("A0 over A1", &a0, &a1, task, 0.0);
        assert_dearer("A1 over A3", &a1, &a3, task, 0.0);
    }
}

/// A2 comes down, but not below A1 by task 100 (over 80 runs it is 19 ± 5 above): few tasks need what it repaired.
#[test]
#[ignore = "takes minutes: 400 runs"]
fn the_order_holds_by_more_than_two_standard_errors() {
    let [a0, a1, a2, a3] = curves(ALL, 100);
    for (name, other) in [("A2 over A0", &a0), ("A2 over A1", &a1), ("A2 over A3", &a3)] {
        assert_dearer(name, &a2, other, 41, 2.0);
    }
    for task in [60, 80, 100] {
        assert_dearer("A0 over A1", &a0, &a1, task, 2.0);
        assert_dearer("A1 over A3", &a1, &a3, task, 2.0);
    }
}
