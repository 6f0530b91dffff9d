//! Lane graphs of any shape are the same after they were written and read, in each format, as far as the format has words.

use adit_planners::geometry::Point;
use adit_planners::lanes::{
    Format, Lane, LaneGraph, Level, Node, VehicleType, is_lane_graph, read_lane_graph, write,
};
use adit_planners::read::Problem;
use miette::Diagnostic as _;
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
            prop_assert!(said(&problem).contains("a."), "{}", said(&problem));
        }
    }
}

fn read_as(name: &str, text: &str) -> Result<LaneGraph, Problem> {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join(name);
    std::fs::write(&file, text).unwrap();
    read_lane_graph(&file)
}

/// What is said of a file that is refused.
fn refused(name: &str, text: &str) -> String {
    said(&read_as(name, text).unwrap_err())
}

/// A problem with the name of its file, where its line is shown.
fn said(problem: &Problem) -> String {
    let label = problem.labels().and_then(|mut labels| labels.next());
    let shown = label.and_then(|label| problem.source_code()?.read_span(label.inner(), 0, 0).ok());
    let file = shown.and_then(|shown| Some(format!("{}: ", shown.name()?)));
    format!("{}{}", file.unwrap_or_default(), problem.message)
}

const NODES: &str = r#"{"type":"Feature","properties":{"id":0},"geometry":{"type":"Point","coordinates":[0,0]}},
{"type":"Feature","properties":{"id":1},"geometry":{"type":"Point","coordinates":[1,0]}}"#;

/// A route graph of two nodes and an edge.
fn route_graph(properties: &str, kind: &str, line: &str) -> String {
    format!(
        r#"{{"features":[{NODES},{{"properties":{{"id":2,"startid":0,"endid":1{properties}}},"geometry":{{"type":"{kind}","coordinates":{line}}}}}]}}"#
    )
}

#[test]
fn a_line_is_read_as_it_is_nested() {
    let (flat, nested) = ("[[0,0],[0,2],[1,0]]", "[[[0,0],[0,2],[1,0]]]");
    for (kind, line, notes) in [
        ("LineString", flat, 0),
        ("MultiLineString", nested, 0),
        ("LineString", nested, 1),
        ("MultiLineString", flat, 1),
    ] {
        let graph = read_as("g.geojson", &route_graph("", kind, line)).unwrap();
        assert!((graph.lanes[0].length.unwrap() - 2.0 - 5.0_f64.sqrt()).abs() < 1e-9, "{kind} {line}");
        assert_eq!(graph.notes.len(), notes, "{:?}", graph.notes);
    }
}

#[test]
fn what_is_written_of_lif_for_others_is_read_as_theirs() {
    let meta = r#"{"projectIdentification":"p","creator":"c","exportTimestamp":"t","lifVersion":"1.0.0"}"#;
    let node = |id: &str, x: u8| {
        format!(
            r#"{{"nodeId":"{id}","nodePosition":{{"x":{x},"y":0}},"vehicleTypeNodeProperties":[{{"vehicleTypeId":"v"}}]}}"#
        )
    };
    let edge = r#"{"edgeId":"e","startNodeId":"a","endNodeId":"b","vehicleTypeEdgeProperties":[{"vehicleTypeId":"v"}]}"#;
    let layout = format!(
        r#"{{"layoutId":"l","layoutVersion":"1","nodes":[{},{}],"edges":[{edge}],"stations":[]}}"#,
        node("a", 0),
        node("b", 1)
    );
    let lif = format!(r#"{{"metaInformation":{meta},"layouts":[{layout}]}}"#);
    let graph = read_as("a.lif.json", &lif).unwrap();
    for (format, name) in
        [(Format::RouteGraph, "a.geojson"), (Format::NavGraph, "a.yaml"), (Format::Lif, "b.lif.json")]
    {
        let text = write(&graph, format).unwrap().text;
        let read = read_as(name, &text).unwrap();
        assert_eq!((read.nodes.len(), read.lanes.len()), (2, 1), "{text}");
        assert_eq!(write(&read, format).unwrap().text, text);
    }
    let other = format!(r#"{{"metaInformation":{{"creator":"me"}},"features":[{NODES}]}}"#);
    let text = write(&read_as("o.geojson", &other).unwrap(), Format::Lif).unwrap().text;
    assert_eq!(read_as("o.lif.json", &text).unwrap().nodes.len(), 2, "{text}");
}

#[test]
fn doors_that_lanes_name_are_doors() {
    let nav = "building_name: t\nlevels:\n  L1:\n    lanes: [[0, 1, {door_name: coe_door}], [1, 0, {door_name: coe_door}]]\n    vertices: [[0, 0, {name: a}], [1, 0, {name: b}]]\n";
    let route = route_graph(r#","metadata":{"door":"coe_door, other"}"#, "LineString", "[[0,0],[1,0]]");
    for (name, text, level, count) in [("t.yaml", nav, "L1", 1), ("t.geojson", route.as_str(), "map", 2)] {
        let graph = read_as(name, text).unwrap();
        assert_eq!(graph.doors.len(), count, "{name}");
        let door = &graph.doors[0];
        assert_eq!((door.door.as_str(), door.level.as_str()), ("coe_door", level));
        assert_eq!(door.ends, [Point::new(0.5, 0.0); 2]);
        let text = write(&graph, Format::NavGraph).unwrap().text;
        assert!(!text.contains("endpoints"), "a place that no file gave is not written: {text}");
        assert_eq!(read_as("t.yaml", &text).unwrap().doors, graph.doors);
    }
}

/// A building of two vertices, with a name of one and parameters of the lane between them.
fn building(name: &str, lane: &str) -> String {
    format!(
        "coordinate_system: cartesian_meters\nname: t\nlevels:\n  L1:\n    vertices:\n      - [0, 0, 0, lobby]\n      - [4, 0, 0, {name}]\n    lanes: [[0, 1, {{{lane}}}]]\n"
    )
}

#[test]
fn names_of_yaml_are_what_stands_there() {
    for name in ["101", "1.10", "0x1F", "1_000", "007", "n", "Off", "True", "1e3", "-3", "1.", ".inf"] {
        let graph = read_as("t.building.yaml", &building(name, "bidirectional: [4, yes]")).unwrap();
        assert_eq!(graph.nodes[1].name.as_deref(), Some(name));
        assert_eq!(graph.lanes.len(), 2, "yes is true where a truth is expected");
    }
    let nav = "building_name: 1.10\nlevels: {1.10: {lanes: [], vertices: [[0, 0, {name: 2.20}], [4.50, 0, {name: '3.30'}]]}}\n";
    let graph = read_as("t.yaml", nav).unwrap();
    assert_eq!((graph.name.as_str(), graph.levels[0].level.as_str()), ("1.10", "1.10"));
    let names: Vec<&str> = graph.nodes.iter().filter_map(|node| node.name.as_deref()).collect();
    assert_eq!(names, ["2.20", "3.30"]);
    let map = "name: m\nnodes:\n- node: {name: 1.0, pose: {position: {x: 0, y: 0}}}\n";
    assert_eq!(read_as("m.tmap2", map).unwrap().nodes[0].node, "1.0");
}

#[test]
fn a_large_building_is_read_and_aliases_stay_bounded() {
    let mut large = "coordinate_system: cartesian_meters\nlevels:\n  L1:\n    vertices:\n".to_owned();
    large += &"      - [0, 0, 0, \"\"]\n      - [1, 0, 0, \"\"]\n".repeat(26_000);
    large +=
        "    lanes: [[0, 1, {bidirectional: [4, true], graph_idx: [2, 0], orientation: [1, forward]}]]\n";
    assert_eq!(read_as("l.building.yaml", &large).unwrap().lanes.len(), 2);
    let ten = |of: usize| {
        let many = vec![format!("*a{of}"); 10].join(", ");
        format!("a{}: &a{} [{many}]\n", of + 1, of + 1)
    };
    let bomb = "a0: &a0 [1, 1, 1, 1, 1, 1, 1, 1, 1, 1]\n".to_owned() + &(0..9).map(ten).collect::<String>();
    let said = refused("bomb.yaml", &bomb);
    assert!(said.contains("bomb.yaml") && said.contains("aliases"), "{said}");
}

#[test]
fn what_is_wrong_in_yaml_is_said_in_words() {
    let deep = format!("levels:\n  L1: {}{}\n", "[".repeat(80), "]".repeat(80));
    for (text, words) in [
        (deep.as_str(), "nested deeper than 64 levels"),
        ("levels: {}\nlevels: {}\n", "the key `levels` stands here twice, expected once"),
        ("levels: {}\n---\nlevels: {}\n", "a second document begins"),
        ("levels: *nothing\n", "stands for nothing"),
        ("levels: [\n", "not YAML"),
        (
            "levels: {L1: {vertices: [[.nan, 0]], lanes: []}}\nbuilding_name: t\n",
            "vertices[0][0] is the text \".nan\", expected a number",
        ),
    ] {
        let said = refused("w.yaml", text);
        assert!(said.contains("w.yaml") && said.contains(words), "{said}");
        assert!(!said.contains("budget") && !said.contains("Options"), "{said}");
    }
}

#[test]
fn slips_of_a_building_are_refused_or_noted() {
    let said = refused("s.building.yaml", &building("b", "speed_limit: [3, -1]"));
    assert!(said.contains("levels.L1.lanes[0][2].speed_limit[1] is -1, expected 0 or more"), "{said}");
    let said = refused("s.building.yaml", &building("b", "graph_idx: [2, -1]"));
    assert!(said.contains("graph_idx[1] is -1, expected the number of a graph, 0 or more"), "{said}");
    let cabin = building("\"\", {lift_cabin: [1, up]}", "");
    let notes = read_as("s.building.yaml", &cabin).unwrap().notes;
    assert_eq!(notes, ["node 1 is in the cabin of lift `up`, and there is no lift of this name"]);
    let far = building("b", "").replace("cartesian_meters", "wgs84").replace("[4, 0, 0, b]", "[4, 95, 0, b]");
    let said = refused("s.building.yaml", &far);
    assert!(said.contains("levels.L1.vertices[1]") && said.contains("degrees east"), "{said}");
}

#[test]
fn a_mark_of_byte_order_is_skipped_and_a_file_that_is_not_there_is_said_so() {
    let text = route_graph("", "LineString", "[[0,0],[1,0]]");
    assert_eq!(read_as("m.geojson", &format!("\u{feff}{text}")).unwrap().lanes.len(), 1);
    assert_eq!(read_as("m.building.yaml", &format!("\u{feff}{}", building("b", ""))).unwrap().lanes.len(), 1);
    let missing = std::path::Path::new("/nowhere/nofile.geojson");
    assert!(is_lane_graph(missing));
    assert!(read_lane_graph(missing).unwrap_err().message.contains("cannot be read"));
}

#[test]
fn what_lif_cannot_say_is_said() {
    let at = Point::new(0.0, 0.0);
    let node = |id: &str| Node {
        is_charger: true,
        is_parking_spot: true,
        is_holding_point: true,
        ..Node::new(id, "l", at)
    };
    let lane = Lane {
        lane: "e".to_owned(),
        from: "a".to_owned(),
        to: "b".to_owned(),
        action: Some("dock".to_owned()),
        speed_share: Some(0.5),
        ..Lane::default()
    };
    let graph = LaneGraph {
        levels: vec![Level { level: "l".to_owned(), ..Level::default() }],
        nodes: vec![node("a"), node("b")],
        lanes: vec![lane],
        ..LaneGraph::default()
    };
    let notes = write(&graph, Format::Lif).unwrap().notes.join("\n");
    for words in [
        "2 nodes: that they are chargers",
        "parking spots",
        "holding points",
        "1 lane: an action",
        "share of a vehicle's own speed",
    ] {
        assert!(notes.contains(words), "{words}: {notes}");
    }
}

#[test]
fn lifts_of_a_site_may_stand_on_anchors_of_the_whole_site() {
    let level = |number: u8, name: &str, high: u8| {
        format!(
            r#""{number}": {{"properties": {{"name": "{name}", "elevation": {high}}}, "anchors": {{"{number}1": {{"Translate2D": [{number}, 0]}}}}}}"#
        )
    };
    let text = format!(
        r#"{{"format_version": "0.1", "properties": {{"name": "s"}},
        "anchors": {{"7": {{"Translate2D": [0, 1]}}, "8": {{"Translate2D": [0, -1]}}}},
        "levels": {{{}, {}}},
        "lifts": {{"9": {{"properties": {{"name": "main", "reference_anchors": [7, 8], "initial_level": 2}},
                          "cabin_anchors": {{"10": {{"Translate2D": [0, 0]}}}}}}}},
        "navigation": {{"guided": {{"graphs": {{"30": {{"name": "g"}}}},
                                   "lanes": {{"40": {{"anchors": [11, 10]}}, "41": {{"anchors": [10, 21]}}}}, "locations": {{}}}}}}}}"#,
        level(1, "ground", 0),
        level(2, "first", 4)
    );
    let graph = read_as("s.site.json", &text).unwrap();
    assert_eq!((graph.lifts.len(), graph.lanes.len()), (1, 4));
    assert_eq!(graph.lifts[0].at, Point::new(0.0, 0.0));
    let cabin = graph.node("10").unwrap();
    assert_eq!(
        (cabin.level.as_str(), cabin.lift.as_deref()),
        ("first", Some("main")),
        "where the lift waits"
    );
    let said = refused("s.site.json", &text.replace("[7, 8]", "[7, 6]"));
    assert!(said.contains("reference_anchors[1] is 6, and there is no anchor of this number"), "{said}");
}

#[test]
fn an_edge_of_nav2_needs_no_line_and_keeps_its_per_cent() {
    let text = route_graph(r#","metadata":{"speed_limit":85}"#, "MultiLineString", "[[[0,0],[1,0]]]");
    let text = text.replace(r#","coordinates":[[[0,0],[1,0]]]"#, "");
    let mut graph = read_as("g.geojson", &text).unwrap();
    assert_eq!((graph.lanes[0].length, graph.lanes[0].speed_share), (None, Some(0.85)));
    // as it stands in the file
    let limit = |graph: &LaneGraph| {
        let text = write(graph, Format::RouteGraph).unwrap().text;
        let file: serde_json::Value = serde_json::from_str(&text).unwrap();
        file["features"][2]["properties"]["metadata"]["speed_limit"].to_string()
    };
    assert_eq!(limit(&graph), "85.0");
    graph.lanes[0].speed_share = Some(0.5);
    assert_eq!(limit(&graph), "50.0", "somebody changed it, and its unit stays");
    let part = route_graph(r#","metadata":{"speed_limit":0.85}"#, "MultiLineString", "[[[0,0],[1,0]]]");
    assert_eq!(limit(&read_as("g.geojson", &part).unwrap()), "0.85");
}

#[test]
fn what_a_format_cannot_say_of_heights_and_numbers_is_said() {
    let mut graph =
        read_as("g.geojson", &route_graph("", "LineString", "[[0,0],[1,0]]").replace("[1,0]}}", "[1,0,3]}}"))
            .unwrap();
    assert!(graph.notes[0].ends_with("since a route graph lies on one level: 1"), "{:?}", graph.notes);
    graph.levels[0].elevation = 6.0;
    graph.nodes[1].number = Some(70_000);
    let notes = write(&graph, Format::RouteGraph).unwrap().notes.join("\n");
    assert!(notes.contains("how high levels are has no place in a route graph: map (6 m)"), "{notes}");
    assert!(notes.contains("1 node: another node has the same number, or it is above 65535"), "{notes}");
    assert!(write(&graph, Format::Lif).unwrap().notes.join("\n").contains("in LIF: map (6 m)"));
}

#[test]
fn degrees_lie_where_the_coordinate_system_of_the_file_has_them() {
    // SVY21 has its natural origin at 1°22' N, 103°50' E, which is 28,001.642 m east and 38,744.572 m north
    let (north, east) = (1.0 + 22.0 / 60.0, 103.0 + 50.0 / 60.0);
    let text = format!(
        "name: t\ncoordinate_system: wgs84\nparameters:\n  generate_crs: [1, EPSG:3414]\n  suggested_offset_x: [3, 22000]\n  suggested_offset_y: [3, 31500]\nlevels:\n  L1:\n    vertices: [[{east}, {north}, 0, a], [{east}, {}, 0, b]]\n    lanes: [[0, 1, {{}}]]\n",
        north + 0.001
    );
    let near = |graph: &LaneGraph, at: usize, x: f64, y: f64, m: f64| {
        let node = &graph.nodes[at];
        assert!(node.at.distance(Point::new(x, y)) < m, "{:?} beside {x}, {y}", node.at);
    };
    let graph = read_as("t.building.yaml", &text).unwrap();
    near(&graph, 0, 6001.642, 7244.572, 0.001);
    // a thousandth of a degree of latitude is 110.5765 m there (WGS 84)
    near(&graph, 1, 6001.642, 7244.572 + 110.5765, 0.01);
    let alone = text.replace("  generate_crs: [1, EPSG:3414]\n", "  other: [1, x]\n");
    let graph = read_as("t.building.yaml", &alone).unwrap();
    near(&graph, 0, 0.0, 0.0, 1e-6);
    near(&graph, 1, 0.0, 110.5765, 0.01);
    assert!(graph.notes[0].contains("`generate_crs`"), "{:?}", graph.notes);
    for wrong in ["EPSG:1", "EPSG:4326", "Singapore"] {
        let said = refused("t.building.yaml", &text.replace("EPSG:3414", wrong));
        assert!(said.contains("a coordinate system in metres on a plane, as EPSG:3414"), "{said}");
    }
}

#[test]
fn a_building_that_nobody_measured_says_that_its_pixels_are_metres() {
    let text = building("b", "").replace("coordinate_system: cartesian_meters\n", "");
    let notes = read_as("t.building.yaml", &text).unwrap().notes;
    assert_eq!(notes, ["nothing was measured on level L1, so that a pixel is taken for a metre"]);
}

/// A LIF file of two nodes and an edge.
fn lif(node: &str, edge: &str) -> String {
    format!(
        r#"{{"metaInformation": {{"projectIdentification": "p", "creator": "c", "exportTimestamp": "t", "lifVersion": "1.0.0"}},
"layouts": [{{"layoutId": "l", "layoutVersion": "1",
"nodes": [{{"nodeId": "a", "nodePosition": {{"x": 0, "y": 0}}, "vehicleTypeNodeProperties": [{{"vehicleTypeId": "v"}}]}},
{node}],
"edges": [{edge}],
"stations": []}}]}}"#
    )
}

const NODE_B: &str = r#"{"nodeId": "b", "nodePosition": {"x": 3, "y": 0}, "vehicleTypeNodeProperties": [{"vehicleTypeId": "v"}]}"#;

fn edge_with(properties: &str) -> String {
    format!(
        r#"{{"edgeId": "e", "startNodeId": "a", "endNodeId": "b", "vehicleTypeEdgeProperties": [{properties}]}}"#
    )
}

#[test]
fn lif_without_vehicle_types_is_refused_and_a_broken_curve_is_told() {
    let whole = edge_with(r#"{"vehicleTypeId": "v"}"#);
    assert!(read_as("a.lif.json", &lif(NODE_B, &whole)).unwrap().notes.is_empty());
    let said = refused("a.lif.json", &lif(NODE_B, &edge_with("")));
    assert!(
        said.contains(
            "edges[0].vehicleTypeEdgeProperties is [], expected what one vehicle type or more may do there"
        ),
        "{said}"
    );
    let said = refused(
        "a.lif.json",
        &lif(NODE_B, &whole.replace("vehicleTypeEdgeProperties", "mobileRobotTypeEdgeProperties")),
    );
    assert!(said.contains("layouts[0].edges[0] has no `vehicleTypeEdgeProperties`"), "{said}");
    let said =
        refused("a.lif.json", &lif(&NODE_B.replace("vehicleTypeNodeProperties", "properties"), &whole));
    assert!(said.contains("layouts[0].nodes[1] has no `vehicleTypeNodeProperties`"), "{said}");
    let points = r#""controlPoints": [{"x": 0, "y": 0}, {"x": 3, "y": 0}]"#;
    for (knots, words) in [
        ("[0, 1, 2]", "3 knots where 2 control points of the degree 1 have 4"),
        ("[0, 1, 0, 1]", "knots that fall"),
    ] {
        let curve = format!(
            r#"{{"vehicleTypeId": "v", "trajectory": {{"degree": 1, "knotVector": {knots}, {points}}}}}"#
        );
        let notes = read_as("a.lif.json", &lif(NODE_B, &edge_with(&curve))).unwrap().notes;
        assert_eq!(notes, [format!("the curve of edge e has {words}, so that it counts as straight")]);
    }
}

#[test]
fn an_id_that_stands_for_two_or_for_none_is_shown_where_it_stands() {
    let edge = edge_with(r#"{"vehicleTypeId": "v"}"#);
    let place = |text: &str| {
        let problem = read_as("a.lif.json", text).unwrap_err();
        let label = problem.labels().unwrap().next().unwrap();
        let span = problem.source_code().unwrap().read_span(label.inner(), 0, 0).unwrap();
        (span.line() + 1, problem.message.clone())
    };
    let twice = place(&lif(&NODE_B.replace("\"b\"", "\"a\""), &edge));
    assert_eq!(twice, (4, "two nodes are called `a`; expected an id for each".to_owned()));
    let none = place(&lif(NODE_B, &edge.replace("\"b\"", "\"z\"")));
    assert_eq!(none, (5, "lane `e` from `a` to `z`: there is no node `z`".to_owned()));
}
