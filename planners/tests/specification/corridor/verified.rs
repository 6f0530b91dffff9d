//! Verified numbers for Lee's Table 2, corrected: its eight cases, and corridors shaped like L, U and S.
#![allow(clippy::unreadable_literal)] // as they are written elsewhere, to be compared by eye

/// One rule in one place.
pub struct Case {
    pub rule: u32,
    /// The junction entered, and the one after it: x0, y0, x1, y1.
    pub junction: [f64; 4],
    pub next_junction: [f64; 4],
    pub from: (f64, f64),
    pub gap: f64,
    pub theta_degrees: f64,
    pub arriving: (f64, f64),
    /// What the table gives as the paper prints it.
    pub as_printed: (f64, f64),
    /// Towards a turn of the same sense, and of the opposite one.
    pub leaving: [Leaving; 2],
}

/// Towards the next junction.
pub struct Leaving {
    pub next_rule: u32,
    pub from: (f64, f64),
    pub to: (f64, f64),
    pub heading_degrees: f64,
    pub arc: f64,
    pub line: f64,
}

/// A corridor with a path for each gap.
pub struct Corridor {
    pub name: &'static str,
    pub channels: &'static [[f64; 4]],
    pub start: (f64, f64),
    pub goal: (f64, f64),
    pub paths: &'static [Path],
}

/// The path of a robot 1 m wide and 1.5 m long.
pub struct Path {
    /// `None`: the safest one, 0.929688.
    pub gap: Option<f64>,
    pub rules: &'static [u32],
    pub length: f64,
    pub min_clearance: f64,
    /// Where lines and arcs meet, from the start to the goal.
    pub points: &'static [(f64, f64)],
}

pub const CASES: [Case; 8] = [
    Case {
        rule: 1,
        junction: [0.0, 5.0, 3.0, 8.0],
        next_junction: [8.0, 5.0, 11.0, 8.0],
        from: (1.5, 1.0),
        gap: 0.2,
        theta_degrees: 11.125168,
        arriving: (2.313154, 5.135067),
        as_printed: (2.313154, 5.135067),
        leaving: [
            Leaving {
                next_rule: 7,
                from: (3.0, 5.7),
                to: (8.0, 5.7),
                heading_degrees: 0.0,
                arc: 0.963638,
                line: 5.0,
            },
            Leaving {
                next_rule: 5,
                from: (2.794505, 5.669158),
                to: (8.205495, 7.330842),
                heading_degrees: 17.071431,
                arc: 0.755071,
                line: 5.660389,
            },
        ],
    },
    Case {
        rule: 2,
        junction: [2.0, -4.0, 5.0, -1.0],
        next_junction: [10.0, -4.0, 13.0, -1.0],
        from: (3.2, 2.0),
        gap: 0.6,
        theta_degrees: 12.638311,
        arriving: (3.926652, -1.240675),
        as_printed: (6.073348, -2.073348),
        leaving: [
            Leaving {
                next_rule: 5,
                from: (5.0, -2.1),
                to: (10.0, -2.1),
                heading_degrees: 0.0,
                arc: 1.485238,
                line: 5.0,
            },
            Leaving {
                next_rule: 7,
                from: (4.831765, -2.087059),
                to: (10.168235, -2.912941),
                heading_degrees: -8.797411,
                arc: 1.31634,
                line: 5.4,
            },
        ],
    },
    Case {
        rule: 3,
        junction: [-3.0, 1.0, 0.0, 4.0],
        next_junction: [-11.0, 1.0, -8.0, 4.0],
        from: (-1.0, -4.0),
        gap: 1.0,
        theta_degrees: 5.628143,
        arriving: (-1.507231, 1.147108),
        as_printed: (-4.492769, -0.492769),
        leaving: [
            Leaving {
                next_rule: 8,
                from: (-3.0, 2.5),
                to: (-8.0, 2.5),
                heading_degrees: 180.0,
                arc: 2.20885,
                line: 5.0,
            },
            Leaving {
                next_rule: 6,
                from: (-3.0, 2.5),
                to: (-8.0, 2.5),
                heading_degrees: 180.0,
                arc: 2.20885,
                line: 5.0,
            },
        ],
    },
    Case {
        rule: 4,
        junction: [4.0, 4.0, 7.0, 7.0],
        next_junction: [-4.0, 4.0, -1.0, 7.0],
        from: (4.9, 9.5),
        gap: 0.2,
        theta_degrees: 4.524095,
        arriving: (4.697819, 6.944785),
        as_printed: (4.697819, 7.055215),
        leaving: [
            Leaving {
                next_rule: 6,
                from: (4.0, 6.3),
                to: (-1.0, 6.3),
                heading_degrees: 180.0,
                arc: 1.044285,
                line: 5.0,
            },
            Leaving {
                next_rule: 8,
                from: (4.205495, 6.330842),
                to: (-1.205495, 4.669158),
                heading_degrees: -162.928569,
                arc: 0.835718,
                line: 5.660389,
            },
        ],
    },
    Case {
        rule: 5,
        junction: [1.0, 2.0, 4.0, 5.0],
        next_junction: [1.0, 10.0, 4.0, 13.0],
        from: (-2.5, 3.5),
        gap: 0.6,
        theta_degrees: 6.408025,
        arriving: (1.122769, 3.906872),
        as_printed: (2.093128, 3.906872),
        leaving: [
            Leaving {
                next_rule: 3,
                from: (2.1, 5.0),
                to: (2.1, 10.0),
                heading_degrees: 90.0,
                arc: 1.604851,
                line: 5.0,
            },
            Leaving {
                next_rule: 1,
                from: (2.087059, 4.831765),
                to: (2.912941, 10.168235),
                heading_degrees: 81.202589,
                arc: 1.435953,
                line: 5.4,
            },
        ],
    },
    Case {
        rule: 6,
        junction: [-2.0, -2.0, 1.0, 1.0],
        next_junction: [-2.0, 6.0, 1.0, 9.0],
        from: (7.0, -1.0),
        gap: 0.2,
        theta_degrees: 12.080449,
        arriving: (0.853501, 0.315502),
        as_printed: (0.315502, 1.146499),
        leaving: [
            Leaving {
                next_rule: 1,
                from: (0.3, 1.0),
                to: (0.3, 6.0),
                heading_degrees: 90.0,
                arc: 0.951967,
                line: 5.0,
            },
            Leaving {
                next_rule: 3,
                from: (0.330842, 0.794505),
                to: (-1.330842, 6.205495),
                heading_degrees: 107.071431,
                arc: 0.7434,
                line: 5.660389,
            },
        ],
    },
    Case {
        rule: 7,
        junction: [0.0, 0.0, 3.0, 3.0],
        next_junction: [0.0, -8.0, 3.0, -5.0],
        from: (-4.5, 1.6),
        gap: 1.0,
        theta_degrees: 1.268352,
        arriving: (0.033203, 1.499632),
        as_printed: (1.499632, 0.033203),
        leaving: [
            Leaving {
                next_rule: 4,
                from: (1.5, 0.0),
                to: (1.5, -5.0),
                heading_degrees: -90.0,
                arc: 2.322989,
                line: 5.0,
            },
            Leaving {
                next_rule: 2,
                from: (1.5, 0.0),
                to: (1.5, -5.0),
                heading_degrees: -90.0,
                arc: 2.322989,
                line: 5.0,
            },
        ],
    },
    Case {
        rule: 8,
        junction: [6.0, -1.0, 9.0, 2.0],
        next_junction: [6.0, -9.0, 9.0, -6.0],
        from: (11.2, 0.3),
        gap: 0.6,
        theta_degrees: 5.082263,
        arriving: (8.902555, 0.095675),
        as_printed: (7.904325, -2.095675),
        leaving: [
            Leaving {
                next_rule: 2,
                from: (7.9, -1.0),
                to: (7.9, -6.0),
                heading_degrees: -90.0,
                arc: 1.630304,
                line: 5.0,
            },
            Leaving {
                next_rule: 4,
                from: (7.912941, -0.831765),
                to: (7.087059, -6.168235),
                heading_degrees: -98.797411,
                arc: 1.461405,
                line: 5.4,
            },
        ],
    },
];

pub const CORRIDORS: [Corridor; 3] = [
    Corridor {
        name: "L",
        channels: &[[0.0, 0.0, 3.0, 9.0], [0.0, 6.0, 9.0, 9.0]],
        start: (1.5, 2.0),
        goal: (7.0, 7.5),
        paths: &[
            Path {
                gap: Some(0.2),
                rules: &[1],
                length: 9.256241,
                min_clearance: 0.2,
                points: &[(1.5, 2.0), (2.313154, 6.135067), (2.864933, 6.686846), (7.0, 7.5)],
            },
            Path {
                gap: Some(0.6),
                rules: &[1],
                length: 9.767421,
                min_clearance: 0.6,
                points: &[(1.5, 2.0), (1.905315, 6.108007), (2.891993, 7.094685), (7.0, 7.5)],
            },
            Path {
                gap: Some(1.0),
                rules: &[1],
                length: 10.356194,
                min_clearance: 0.864009,
                points: &[(1.5, 2.0), (1.5, 6.0), (3.0, 7.5), (7.0, 7.5)],
            },
            Path {
                gap: None,
                rules: &[1],
                length: 10.246981,
                min_clearance: 0.929687,
                points: &[(1.5, 2.0), (1.570532, 6.025049), (2.974951, 7.429468), (7.0, 7.5)],
            },
        ],
    },
    Corridor {
        name: "U",
        channels: &[[0.0, 0.0, 3.0, 9.0], [0.0, 6.0, 12.0, 9.0], [9.0, 0.0, 12.0, 9.0]],
        start: (1.5, 2.0),
        goal: (10.5, 2.0),
        paths: &[
            Path {
                gap: Some(0.2),
                rules: &[1, 7],
                length: 16.355799,
                min_clearance: 0.2,
                points: &[
                    (1.5, 2.0),
                    (2.313154, 6.135067),
                    (3.0, 6.7),
                    (9.0, 6.7),
                    (9.686846, 6.135067),
                    (10.5, 2.0),
                ],
            },
            Path {
                gap: Some(0.6),
                rules: &[1, 7],
                length: 17.495297,
                min_clearance: 0.6,
                points: &[
                    (1.5, 2.0),
                    (1.905315, 6.108007),
                    (3.0, 7.1),
                    (9.0, 7.1),
                    (10.094685, 6.108007),
                    (10.5, 2.0),
                ],
            },
            Path {
                gap: Some(1.0),
                rules: &[1, 7],
                length: 18.712389,
                min_clearance: 0.864009,
                points: &[(1.5, 2.0), (1.5, 6.0), (3.0, 7.5), (9.0, 7.5), (10.5, 6.0), (10.5, 2.0)],
            },
            Path {
                gap: None,
                rules: &[1, 7],
                length: 18.492729,
                min_clearance: 0.929687,
                points: &[
                    (1.5, 2.0),
                    (1.570532, 6.025049),
                    (3.0, 7.429688),
                    (9.0, 7.429688),
                    (10.429468, 6.025049),
                    (10.5, 2.0),
                ],
            },
        ],
    },
    Corridor {
        name: "S",
        channels: &[[0.0, 0.0, 3.0, 9.0], [0.0, 6.0, 12.0, 9.0], [9.0, 6.0, 12.0, 18.0]],
        start: (1.5, 2.0),
        goal: (10.5, 16.0),
        paths: &[
            Path {
                gap: Some(0.2),
                rules: &[1, 5],
                length: 19.528577,
                min_clearance: 0.2,
                points: &[
                    (1.5, 2.0),
                    (2.313154, 6.135067),
                    (2.824511, 6.677646),
                    (9.175489, 8.322354),
                    (9.695523, 8.920959),
                    (10.5, 16.0),
                ],
            },
            Path {
                gap: Some(0.6),
                rules: &[1, 5],
                length: 20.539184,
                min_clearance: 0.6,
                points: &[
                    (1.5, 2.0),
                    (1.905315, 6.108007),
                    (2.857939, 7.090788),
                    (9.142061, 7.909212),
                    (10.098224, 8.937523),
                    (10.5, 16.0),
                ],
            },
            Path {
                gap: Some(1.0),
                rules: &[1, 5],
                length: 21.712389,
                min_clearance: 0.864009,
                points: &[(1.5, 2.0), (1.5, 6.0), (3.0, 7.5), (9.0, 7.5), (10.5, 9.0), (10.5, 16.0)],
            },
            Path {
                gap: None,
                rules: &[1, 5],
                length: 21.494107,
                min_clearance: 0.929687,
                points: &[
                    (1.5, 2.0),
                    (1.570532, 6.025049),
                    (2.966686, 7.429299),
                    (9.033314, 7.570701),
                    (10.429616, 8.985655),
                    (10.5, 16.0),
                ],
            },
        ],
    },
];
