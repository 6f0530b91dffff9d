//! Another domain: which plants need water, how much, and why.
//!
//! `cargo run -p adit-engine --example watering`

use adit_engine::{Class, KnowledgeBase, RuleBase, SourceFile};

const RULES: &str = r#"
const THIRSTY = 1.5;   // litres that no plant should exceed

rule "how much"
    each plant in PLANTS
    some kind in KINDS where kind.kind == plant.kind
    then {
        let dry = max(0, plant.days_dry - kind.bears_days);
        plant.litres = min(THIRSTY, dry * kind.litres_a_day);
    }

rule "who waters"
    each plant in PLANTS where plant.litres > 0
    least person in PEOPLE by hypot(person.x - plant.x, person.y - plant.y) where person.can_carry >= plant.litres
    then { plant.waterer = person.name; }

revise "a hot day asks for more"
    each plant in PLANTS
    some day in TODAY where day.celsius > 30
    set plant.litres by * 1.5
"#;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let rules = RuleBase::compile(&[SourceFile::new("watering.rhai", RULES)])?;
    let mut garden = KnowledgeBase::new();
    garden.assert(
        Class::new("PLANTS", &["pot"])
            .texts("pot", ["fern", "cactus", "basil"].map(Some))
            .texts("kind", ["fern", "cactus", "herb"].map(Some))
            .numbers("days_dry", [Some(3.0), Some(9.0), None])
            .numbers("x", [0.0, 4.0, 8.0].map(Some))
            .numbers("y", [0.0; 3].map(Some)),
    )?;
    garden.assert(
        Class::new("KINDS", &["kind"])
            .texts("kind", ["fern", "cactus", "herb"].map(Some))
            .numbers("bears_days", [1.0, 20.0, 1.0].map(Some))
            .numbers("litres_a_day", [0.25, 0.05, 0.2].map(Some)),
    )?;
    garden.assert(
        Class::new("PEOPLE", &["name"])
            .texts("name", ["Ann", "Bob"].map(Some))
            .numbers("can_carry", [0.3, 10.0].map(Some))
            .numbers("x", [0.0, 9.0].map(Some))
            .numbers("y", [1.0, 0.0].map(Some)),
    )?;
    garden.assert(Class::new("TODAY", &[]).numbers("celsius", [Some(33.0)]))?;
    for problem in rules.check(&garden.schema()) {
        eprintln!("{problem}");
    }
    let report = garden.conclude(&rules);
    for pot in ["fern", "cactus", "basil"] {
        for property in ["litres", "waterer"] {
            if let Some(why) = garden.why(&rules, "PLANTS", pot, property) {
                eprintln!("{why}");
            }
        }
    }
    for gap in &report.gaps {
        for (reason, objects) in &gap.reasons {
            eprintln!("{} has no value for {objects} of its objects: {reason}", gap.property);
        }
    }
    Ok(())
}
