//! How long a plan takes, rules and sweep check included, parsing and database aside: `plan_time WORLD.toml ...` prints
//! for each world the median, the fastest and the slowest of many plans in microseconds.

use std::error::Error;
use std::hint::black_box;
use std::path::Path;
use std::time::Instant;

use adit::plan::rules::{self, Kind};
use adit::plan::world::World;
use adit::plan::{Steps, Turns};

const WARM: usize = 2_000;
const ROUNDS: usize = 20_001;

fn main() -> Result<(), Box<dyn Error>> {
    for path in std::env::args().skip(1) {
        let world = World::read(Path::new(&path))?;
        let (rules, _) = rules::load(Kind::Channels, "corrected", Path::new(""))?;
        let (mut steps, mut turns) = (Steps::new(&rules)?, Turns::new(&rules)?);
        assert!(steps.is_direct() && turns.is_direct(), "the rules look at one step alone");
        let mut once = || -> Result<f64, String> {
            Ok(match &world {
                World::Assembly(world) => world.plan(&mut steps).map_err(|no_path| no_path.reason)?.length,
                World::SolidAssembly(world) => {
                    world.plan(&mut steps).map_err(|no_path| no_path.reason)?.length
                }
                World::FloorPlan(_) | World::Cell(_) => return Err("there are no channels".to_owned()),
                World::Corridor(world) => {
                    world.plan(&mut turns).map_err(|no_path| no_path.reason)?.drive.length
                }
            })
        };
        let length = once()?;
        for _ in 0..WARM {
            black_box(once()?);
        }
        let mut times: Vec<f64> = Vec::with_capacity(ROUNDS);
        for _ in 0..ROUNDS {
            let before = Instant::now();
            black_box(once()?);
            times.push(before.elapsed().as_secs_f64() * 1e6);
        }
        times.sort_by(f64::total_cmp);
        #[allow(clippy::print_stdout)] // its output is what it is for
        {
            println!(
                "{} length {length:.6} median_us {:.3} fastest_us {:.3} slowest_us {:.1}",
                Path::new(&path).file_stem().unwrap_or_default().display(),
                times[ROUNDS / 2],
                times[0],
                times[ROUNDS - 1]
            );
        }
    }
    Ok(())
}
