//! Random chains of channels, in two dimensions and three: no collision, the clearance that the gaps promise, and
//! never an error.

use adit_planners::channels::assembly::{Assembly, Cuboid, Decision, PartPath, StepFacts};
use proptest::prelude::*;

use super::chains::{Chain, chains};
use super::oracle::Cells;
use super::table1::{table_for_any_dimension, table1};

const ROUNDING: f64 = 1e-9;
const PLACES: usize = 200;

/// Takes the part out with the gaps of the chain, and gives for each leg the gap that it must keep.
fn taken_out<const D: usize>(
    chain: &Chain<D>,
    displacement: Option<[f64; D]>,
    rules: impl Fn(&StepFacts<D>, [f64; D]) -> Result<Decision<D>, String>,
) -> (Assembly<D>, PartPath<D>, Vec<f64>) {
    let assembly = Assembly::new(chain.channels.clone(), chain.part).unwrap();
    let last = chain.channels[chain.channels.len() - 1];
    let sides = (0..D).map(|k| (chain.part.min[k] - last.min[k]).min(last.max[k] - chain.part.max[k]));
    let mut kept = sides.fold(f64::INFINITY, f64::min);
    let mut promised = Vec::new();
    let path = assembly
        .disassemble(displacement, |facts| {
            assert!(facts.next_is_not_lower);
            let gap = std::array::from_fn(|k| chain.shares[facts.number - 1][k] * facts.bound[k]);
            let least = gap.iter().copied().fold(f64::INFINITY, f64::min);
            promised.push(least.min(kept));
            kept = least;
            rules(facts, gap)
        })
        .unwrap();
    promised.resize(path.legs.len(), kept);
    (assembly, path, promised)
}

fn check<const D: usize>(chain: &Chain<D>, assembly: &Assembly<D>, path: &PartPath<D>, promised: &[f64]) {
    assert_eq!(assembly.axes(), chain.axes);
    let cells = Cells::new(&chain.channels);
    let at =
        |corner: &[f64; D]| Cuboid::new(*corner, std::array::from_fn(|k| corner[k] + chain.part.size(k)));
    assert_eq!(path.waypoints.len(), path.legs.len() + 1);
    for ((leg, promised), ends) in path.legs.iter().zip(promised).zip(path.waypoints.windows(2)) {
        let sampled = cells.along(&at(&ends[0]), &leg.displacement, PLACES);
        let step = leg.displacement.iter().map(|by| by * by).sum::<f64>().sqrt() / PLACES as f64;
        assert!(sampled >= -ROUNDING, "hits a wall: {sampled}");
        assert!(leg.min_clearance <= sampled + ROUNDING, "{} is more than {sampled}", leg.min_clearance);
        assert!(
            leg.min_clearance >= sampled - step / 2.0 - ROUNDING,
            "{} is less than {sampled}",
            leg.min_clearance
        );
        assert!(
            leg.min_clearance >= promised - ROUNDING,
            "{} is less than the gap {promised}",
            leg.min_clearance
        );
    }
    for (corner, clearance) in path.waypoints.iter().zip(&path.clearances) {
        assert!((cells.clearance(&at(corner)).max(0.0) - clearance).abs() < ROUNDING);
    }
    let least = path.legs.iter().map(|leg| leg.min_clearance).fold(path.clearances[0], f64::min);
    assert_eq!(path.min_clearance.to_bits(), least.to_bits());
    assert!(path.waypoints.last().unwrap()[D - 1] >= chain.channels[0].max[D - 1]);
    assert_eq!(&path.reversed().reversed(), path);
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(300))]

    #[test]
    fn a_part_leaves_any_flat_chain_by_table_1(chain in chains::<2>(1..8)) {
        let (assembly, path, promised) = taken_out(&chain, None, table1);
        check(&chain, &assembly, &path, &promised);
        prop_assert!(path.legs.iter().rev().skip(1).all(|leg| leg.rule.is_some()));
    }

    #[test]
    fn a_part_leaves_any_chain_in_space(chain in chains::<3>(1..6)) {
        let (assembly, path, promised) = taken_out(&chain, None, table_for_any_dimension);
        check(&chain, &assembly, &path, &promised);
    }

    #[test]
    fn outside_it_keeps_what_the_mouth_and_the_end_leave(
        chain in chains::<3>(1..4),
        across in prop::array::uniform2(-9.0..9.0_f64),
        above in 0.0..3.0_f64,
    ) {
        let top = chain.channels[0].max[2];
        let displacement = [across[0], across[1], top + above - chain.part.min[2]];
        let (assembly, path, mut promised) = taken_out(&chain, Some(displacement), table_for_any_dimension);
        let end = path.clearances[path.clearances.len() - 1];
        let out = chain.channels.len();
        for promised in &mut promised[out..] {
            *promised = promised.min(end);
        }
        check(&chain, &assembly, &path, &promised);
        for (found, expected) in path.waypoints.last().unwrap().iter().zip(chain.part.moved(&displacement).min) {
            prop_assert_eq!(found.to_bits(), expected.to_bits());
        }
    }
}
