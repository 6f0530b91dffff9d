//! Ways for a disc.

use std::path::Path;

use adit_planners::floor_plan::clear::clearance;
use adit_planners::floor_plan::{Disc, Network, Rule};
use adit_planners::geometry::Point;
use serde_json::Value;

use super::regions::golden;

const DISC: Disc = Disc { radius: 0.25, margin: 0.0 };

pub struct Pair {
    pub ends: [Point; 2],
    pub optimum: f64,
    pub all: f64,
    pub nearest: f64,
}

pub fn pairs(name: &str) -> Vec<Pair> {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/golden/floorplans").join(name);
    let plan: Value = serde_json::from_str(&std::fs::read_to_string(path).unwrap()).unwrap();
    let point = |value: &Value| Point::new(value[0].as_f64().unwrap(), value[1].as_f64().unwrap());
    let pair = |pair: &Value| Pair {
        ends: [point(&pair["start"]), point(&pair["goal"])],
        optimum: pair["shortest_r025"].as_f64().unwrap(),
        all: pair["adit_all"].as_f64().unwrap(),
        nearest: pair["adit_nearest"].as_f64().unwrap(),
    };
    plan["pairs"].as_array().unwrap().iter().map(pair).collect()
}

#[test]
fn probe() {
    for name in ["house-7.json", "office-14.json", "plant-25.json"] {
        let plan = golden(name);
        let start = std::time::Instant::now();
        let network = Network::new(&plan, DISC).unwrap();
        println!("{name} {:?} adits {} ways {} notes {:?}", start.elapsed(), network.adits.len(), network.ways.len(), network.notes);
        let mut ratios = [Vec::new(), Vec::new(), Vec::new()];
        let mut spent = std::time::Duration::ZERO;
        for pair in pairs(name) {
            let [from, to] = pair.ends;
            for (rule, ratios) in [Rule::Nearest, Rule::AllAdits, Rule::Tight].into_iter().zip(&mut ratios) {
                let start = std::time::Instant::now();
                let path = network.path(from, to, rule, |way| Some(way.length)).unwrap();
                if rule == Rule::Tight { spent += start.elapsed(); }
                let clear = clearance(&path.points, &plan.barriers());
                assert!(clear >= DISC.radius, "{rule:?} {clear}");
                ratios.push(path.length / pair.optimum);
                let gold = match rule { Rule::Nearest => pair.nearest, Rule::AllAdits => pair.all, _ => continue };
                if (path.length - gold).abs() > 1e-3 { println!("{rule:?} {} {gold}", path.length); }
            }
        }
        for r in &mut ratios {
            r.sort_by(f64::total_cmp);
            println!("   median {:.4} worst {:.4} least {:.4}", (r[9] + r[10]) / 2.0, r[19], r[0]);
        }
        println!("   {spent:?} for 20");
    }
}
