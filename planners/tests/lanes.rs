//! Lane graphs of any shape are the same after they were written and read, in each format, as far as the format has words.
#![allow(clippy::unwrap_used)] // in a test a failed unwrap is a failed test

use adit_planners::geometry::Point;
use adit_planners::lanes::{Format, Lane, LaneGraph, Level, Node, VehicleType, read_lane_graph, write};
use proptest::prelude::*;

fn names() -> impl Strategy<Value = Option<String>> {
    prop_oneof![Just(None), "[a-z \"\\\\:#{}äß-]{0,8}[a-z]".prop_map(Some)]
}

fn reals() -> impl Strategy<Value = Option<f64>> {
    prop_oneof![Just(None), (1..4000u32).prop_map(|number| Some(f64::from(number) / 64.0))]
}

/// Where, its name, what it is for, and how its id is made.
type AnyNode = (f64, f64, Option<String>, [bool; 4], usize);

/// Between which nodes, its name, limit, penalty and cost, what it is, and the share of speed.
type AnyLane = (usize, usize, Option<String>, Option<f64>, Option<f64>, Option<f64>, [bool; 3], u32);

prop_compose! {
    fn nodes()(of in prop::collection::vec((-1e6..1e6f64, -1e6..1e6f64, names(), any::<[bool; 4]>(), 0..3usize), 1..12)) -> Vec<Node> {
        let node = |(place, (x, y, name, flags, id)): (usize, AnyNode)| Node {
            // some have the number as their id, some a text, some what is another's number
            node: match id { 0 => place.to_string(), 1 => format!("n {place}"), _ => format!("{}", place + 500) },
            name,
            is_parking_spot: flags[0],
            is_charger: flags[1],
            is_holding_point: flags[2],
            closed: flags[3],
            number: Some(place as u32),
            ..Node::new("", "map", Point::new(x, y))
        };
        of.into_iter().enumerate().map(node).collect()
    }
}

prop_compose! {
    fn graphs()(nodes in nodes())(
        lanes in prop::collection::vec(
            (0..nodes.len(), 0..nodes.len(), names(), reals(), reals(), reals(), any::<[bool; 3]>(), 1..=64u32), 0..20),
        nodes in Just(nodes),
    ) -> LaneGraph {
        let lane = |(place, (from, to, name, limit, penalty, cost, flags, share)): (usize, AnyLane)| Lane {
            lane: if flags[2] { format!("edge {place}") } else { place.to_string() },
            name,
            from: nodes[from].node.clone(),
            to: nodes[to].node.clone(),
            speed_limit: limit,
            speed_share: (share < 64).then(|| f64::from(share) / 64.0),
            penalty,
            cost,
            is_cost_fixed: flags[0],
            closed: flags[1],
            number: Some(place as u32),
            ..Lane::default()
        };
        let lanes = lanes.into_iter().filter(|(from, to, ..)| from != to).enumerate().map(lane).collect();
        LaneGraph {
            name: "any".to_owned(),
            levels: vec![Level { level: "map".to_owned(), ..Level::default() }],
            nodes,
            lanes,
            vehicle_types: vec![VehicleType { vehicle_type: "robot".to_owned(), ..VehicleType::default() }],
            ..LaneGraph::default()
        }
    }
}

/// What of a graph a format keeps.
fn kept(mut graph: LaneGraph, format: Format) -> LaneGraph {
    for node in &mut graph.nodes {
        node.properties.clear();
        if format == Format::Lif {
            [node.is_parking_spot, node.is_charger, node.is_holding_point, node.closed] = [false; 4];
        }
    }
    for lane in &mut graph.lanes {
        lane.properties.clear();
        lane.graph = None;
        if format == Format::Lif {
            let Lane { lane: id, name, from, to, number, .. } = lane.clone();
            *lane = Lane { lane: id, name, from, to, number, ..Lane::default() };
        }
    }
    LaneGraph { nodes: graph.nodes, lanes: graph.lanes, ..LaneGraph::default() }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(64))]
    #[test]
    fn what_is_written_is_read_again_and_written_the_same(graph in graphs()) {
        let folder = tempfile::tempdir().unwrap();
        for (format, name) in [(Format::NavGraph, "g.yaml"), (Format::RouteGraph, "g.geojson"), (Format::Lif, "g.lif.json")] {
            let file = folder.path().join(name);
            let text = write(&graph, format).unwrap().text;
            std::fs::write(&file, &text).unwrap();
            let read = read_lane_graph(&file).unwrap();
            prop_assert_eq!(kept(read.clone(), format), kept(graph.clone(), format), "{}", &text);
            prop_assert_eq!(write(&read, format).unwrap().text, text);
        }
    }

    /// Whatever a file holds, it is read or refused in a sentence.
    #[test]
    fn no_text_makes_a_reader_panic(text in "[\\[\\]{}:,\"a-z0-9 \n-]{0,80}", end in 0..3usize) {
        let folder = tempfile::tempdir().unwrap();
        let file = folder.path().join(["a.geojson", "a.building.yaml", "a.lif.json"][end]);
        std::fs::write(&file, text).unwrap();
        if let Err(problem) = read_lane_graph(&file) {
            prop_assert!(problem.message.contains("a."), "{}", problem.message);
        }
    }
}
