//! Where it costs little, ways keep farther off walls than they must.
#![allow(clippy::print_stdout, reason = "one of the tests shows figures")]
#![allow(clippy::float_cmp, reason = "shapes are told by their widths")]

use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

use adit_planners::clearance::Solids;
use adit_planners::geometry::{Point, Segment};
use adit_planners::layers::State;
use adit_planners::random::Random;
use adit_planners::read::{MapSettings, read_map};
use adit_planners::routes::{Berth, RouteGraph, RouteRoom, Walking, Way};
use adit_planners::world::World;
use proptest::prelude::*;

use super::floors::{blocks, check_way, graph, hall, holding, pipes, point, shapes, way};

const FIVE_CM: f64 = 0.05;

/// The most that ways may cost more.
const SHARE: f64 = 0.01;

/// The same rooms, of discs as wide as their shapes, that ask for this.
fn asking(graph: &RouteGraph, radius: impl Fn(usize) -> f64, berth: Berth) -> RouteGraph {
    let room =
        |(index, room): (usize, &RouteRoom)| RouteRoom { radius: Some(radius(index)), berth, ..room.clone() };
    RouteGraph::new(graph.rooms().iter().enumerate().map(room).collect(), graph.doors().to_vec())
}

/// The radius of the shape whose room it is, by what a metre weighs.
fn radius_of<'g>(graph: &'g RouteGraph, shapes: &'g [(State, f64)]) -> impl Fn(usize) -> f64 + 'g {
    |room| {
        let Walking::PerMetre(per_m) = graph.rooms()[room].walking else { return 0.0 };
        let shape = shapes.iter().find(|(_, weighs)| weighs.to_bits() == per_m.to_bits()).unwrap();
        shape.0.width / 2.0
    }
}

/// How far each centimetre of a way is from walls beyond the robot's rim, metres.
fn clearances(solids: &Solids, graph: &RouteGraph, way: &Way, height: f64) -> Vec<f64> {
    let mut all = Vec::new();
    for leg in &way.legs {
        let (line, radius) = (Segment::new(leg.from, leg.to), graph[leg.room].radius.unwrap());
        let steps = (line.length() / 0.01).round() as usize;
        let at = |step: usize| line.at((step as f64 + 0.5) / steps as f64);
        all.extend((0..steps).map(|step| solids.gap(at(step), at(step), height) - radius));
    }
    all
}

proptest! {
    #![proptest_config(ProptestConfig {
        cases: std::env::var("CASES").map_or(64, |cases| cases.parse().unwrap()),
        max_global_rejects: 100_000,
        ..ProptestConfig::default()
    })]

    #[test]
    fn a_way_that_keeps_off_walls_is_free_and_costs_no_more_than_its_share(
        blocks in blocks(), pipes in pipes(), from in point(), to in point(), metres in 0.01..0.4, share in 0.001..0.1
    ) {
        let (world, shapes) = (hall(&blocks, &pipes), shapes());
        let rooms = graph(&world, &shapes, 0.5);
        prop_assume!(!holding(&rooms, from).is_empty() && !holding(&rooms, to).is_empty());
        let radius = radius_of(&rooms, &shapes);
        let of = |berth: Berth| way(&asking(&rooms, &radius, berth), from, to);
        let tight = of(Berth::default());
        for nothing in [Berth { metres, share: 0.0 }, Berth { metres: 0.0, share }] {
            prop_assert_eq!(&of(nothing), &tight);
        }
        let (Some(tight), Some(wide)) = (tight, of(Berth { metres, share })) else { return Ok(()) };
        check_way(&rooms, &wide, from, to)?;
        prop_assert!(wide.cost <= tight.cost * (1.0 + share), "{} for {}", wide.cost, tight.cost);
        let solids = Solids::new(&world);
        for leg in &wide.legs {
            let radius = radius(leg.room.index());
            let (shape, _) = shapes.iter().find(|(shape, _)| shape.width == 2.0 * radius).unwrap();
            let gap = solids.gap(leg.from, leg.to, shape.height);
            prop_assert!(gap >= radius - 1e-6, "{leg:?} is {gap} m from a wall");
        }
    }
}

fn data() -> Option<PathBuf> {
    let here = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../shared");
    let data = std::env::var_os("ADIT_SHARED").map_or(here, PathBuf::from).join("data");
    data.is_dir().then_some(data)
}

/// Shapes of a robot on wheels.
fn drivers() -> Vec<(State, f64)> {
    let shape = |name: &str, width: f64| State {
        robot: None,
        state: name.to_owned(),
        height: 1.0,
        width,
        length: None,
    };
    vec![(shape("DRIVE", 0.4), 1.0), (shape("TUCKED", 0.25), 3.0), (shape("LOADED", 0.6), 0.8)]
}

/// What ways on a map keep.
#[derive(Default)]
struct Kept {
    routes: usize,
    /// Ways that would keep 5 cm all along for at most the share.
    easy: usize,
    /// Centimetres: of easy ways, with 5 cm beside them before and now; of all.
    easy_cm: [usize; 3],
    all_cm: [usize; 3],
    most: f64,
    took: [Duration; 2],
}

impl Kept {
    fn measure(&mut self, world: &World, shapes: &[(State, f64)], random: &mut Random) {
        let grown = |by: f64| -> Vec<(State, f64)> {
            let wider = |(state, per_m): &(State, f64)| {
                (State { width: state.width + 2.0 * by, ..state.clone() }, *per_m)
            };
            shapes.iter().map(wider).collect()
        };
        let (rooms, wider, larger) =
            (graph(world, shapes, 0.5), graph(world, &grown(FIVE_CM), 0.5), grown(FIVE_CM));
        let tight = asking(&rooms, radius_of(&rooms, shapes), Berth::default());
        let wide = asking(&rooms, radius_of(&rooms, shapes), Berth { metres: FIVE_CM, share: SHARE });
        let wider = asking(&wider, radius_of(&wider, &larger), Berth::default());
        let solids = Solids::new(world);
        let b = world.bounds;
        let points: Vec<Point> = (0..20_000)
            .map(|_| Point::new(random.between(b.x0, b.x1), random.between(b.y0, b.y1)))
            .filter(|p| !holding(&wider, *p).is_empty())
            .take(12)
            .collect();
        for (place, &from) in points.iter().enumerate() {
            for &to in &points[place + 1..] {
                let begun = Instant::now();
                let Some(before) = way(&tight, from, to) else { continue };
                self.took[0] += begun.elapsed();
                let begun = Instant::now();
                let now = way(&wide, from, to).unwrap();
                self.took[1] += begun.elapsed();
                self.routes += 1;
                self.most = self.most.max(now.cost / before.cost);
                let [was, is] = [&before, &now].map(|way| {
                    let all = clearances(&solids, &tight, way, 1.0);
                    [all.len(), all.iter().filter(|clear| **clear >= FIVE_CM - 1e-5).count()]
                });
                let add = |sum: &mut [usize; 3]| {
                    sum[0] += is[0];
                    sum[1] += was[1];
                    sum[2] += is[1];
                };
                add(&mut self.all_cm);
                if way(&wider, from, to).is_some_and(|way| way.cost <= before.cost * (1.0 + SHARE)) {
                    self.easy += 1;
                    add(&mut self.easy_cm);
                }
            }
        }
    }

    fn print(&self, what: &str) {
        let share = |[all, was, is]: [usize; 3]| {
            let of = |part: usize| 100.0 * part as f64 / all.max(1) as f64;
            format!("{:.1} % ({:.1} % before)", of(is), of(was))
        };
        let took = self.took.map(|took| took.as_secs_f64() * 1e3 / self.routes.max(1) as f64);
        println!(
            "{what}: {} routes at most {:.4} as costly, {:.2} ms for {:.2}; 5 cm on {}; where that is easy ({}) on {}",
            self.routes,
            self.most,
            took[1],
            took[0],
            share(self.all_cm),
            self.easy,
            share(self.easy_cm)
        );
    }
}

#[test]
#[ignore = "a minute; [STATES=3] [MAP=office] cargo test -p adit-planners --test specification on_maps -- --ignored --nocapture"]
fn on_maps_of_others_ways_keep_5_cm_off_walls_where_that_costs_at_most_one_in_a_hundred() {
    let Some(data) = data() else { return };
    let folders = ["room-segmentation", "nav2", "turtlebot3", "aws-robomaker", "mir_robot", "stage"];
    let files = folders.into_iter().flat_map(|folder| std::fs::read_dir(data.join(folder)).unwrap());
    let mut maps: Vec<PathBuf> = files.map(|file| file.unwrap().path()).collect();
    maps.retain(|map| map.extension().is_some_and(|extension| extension == "yaml"));
    maps.sort();
    if let Ok(only) = std::env::var("MAP") {
        maps.retain(|map| map.to_string_lossy().contains(&only));
    }
    let states = std::env::var("STATES").map_or(1, |states| states.parse().unwrap());
    let mut all = Kept::default();
    for map in maps {
        let Ok((world, _)) = read_map(&map, &MapSettings::default()) else { continue };
        let mut own = Kept::default();
        own.measure(&world, &drivers()[..states], &mut Random::new(7));
        own.print(&map.file_stem().unwrap().to_string_lossy());
        all.routes += own.routes;
        all.easy += own.easy;
        all.most = all.most.max(own.most);
        for place in 0..3 {
            all.easy_cm[place] += own.easy_cm[place];
            all.all_cm[place] += own.all_cm[place];
        }
        for (sum, own) in all.took.iter_mut().zip(own.took) {
            *sum += own;
        }
    }
    all.print("all");
    assert!(all.easy_cm[2] * 100 >= all.easy_cm[0] * 95, "ways scrape along walls that have room");
}
