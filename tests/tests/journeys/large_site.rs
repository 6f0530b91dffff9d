//! A site of 100,000 rooms builds end to end, and a route leads across it.

use std::fmt::Write;

use adit_tests::TestSite;

/// Obstacles of a jittered grid: in general position, so that n of them make 3 n + 1 rooms.
fn map(side: usize) -> String {
    let mut text = format!("width = {0}\ndepth = {0}\n", side * 5);
    // a linear congruential generator (Knuth): the same map every time
    let mut seed = 1_u64;
    let mut random = move || {
        seed = seed.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (seed >> 11) as f64 / (1_u64 << 53) as f64
    };
    text.push_str("obstacle = [\n");
    for column in 0..side {
        for row in 0..side {
            let (x, y) =
                ((column * 5) as f64 + 0.2 + 1.5 * random(), (row * 5) as f64 + 0.2 + 1.5 * random());
            let (x1, y1) = (x + 0.5 + 2.5 * random(), y + 0.5 + 2.5 * random());
            writeln!(text, "  {{ rect = [{x:.9}, {y:.9}, {x1:.9}, {y1:.9}] }},")
                .expect("written to a string");
        }
    }
    text.push_str("]\n[[place]]\nname = \"near corner\"\nat = [0.1, 0.1]\n");
    let far = side as f64 * 5.0 - 0.1;
    writeln!(text, "[[place]]\nname = \"far corner\"\nat = [{far}, {far}]").expect("written to a string");
    text
}

#[test]
fn a_hundred_thousand_rooms() {
    let site = TestSite::example("paper")
        .with("map.toml", &map(184))
        .with("site.toml", "name = \"large\"\nrooms = \"paper\"\nstarts = [\"near corner\"]\n")
        .with(
            "robots.toml",
            "[[robots]]\nstate = \"WALK\"\naction = \"WALK\"\nheight = 1.7\nwidth = 0.05\nhardness = 1.0\n",
        )
        .built();
    assert_eq!(site.sqlite3("SELECT count(*) > 100000 FROM rooms"), ["1"]);
    assert_eq!(
        site.sqlite3("SELECT status FROM route WHERE start = 'near corner' AND goal = 'far corner'"),
        ["ok"]
    );
    let steps = site
        .sqlite3("SELECT count(*) FROM action_sequence WHERE start = 'near corner' AND goal = 'far corner'");
    assert!(steps[0].parse::<usize>().expect("a number") > 100, "{steps:?}");
}
