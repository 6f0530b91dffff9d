//! An animation that one can watch: an SVG that plays in any browser, without scripts.

use std::borrow::Borrow;
use std::fmt::Write as _;

use super::Simulator;
use crate::geometry::{Point, Rect, Segment};
use crate::pose::Pose;
use crate::rim::Rim;

/// What there was to see at one moment.
#[derive(Clone, Debug, PartialEq)]
pub struct Frame {
    pub time_s: f64,
    pub robot: Pose,
    /// Where it thought that it was; `None` where that is not known.
    pub estimate: Option<Pose>,
    /// The shape in which it was, by number.
    pub shape: usize,
    /// How far each obstacle was from where it began, metres.
    pub obstacles: Vec<Point>,
    /// Surfaces that its model held then; `None` where they are those of the frame before.
    pub surfaces: Option<Vec<Segment>>,
    /// What is to be said of this moment.
    pub caption: Option<String>,
}

/// Frames, with what stays the same in all of them.
#[derive(Clone, Debug)]
pub struct Film {
    walls: Vec<Segment>,
    /// Obstacles by their corners, where they began.
    obstacles: Vec<Vec<Point>>,
    /// Of the robot, in each of its shapes.
    rims: Vec<Rim>,
    /// What some shape does not fit beneath.
    low: Vec<Rect>,
    frames: Vec<Frame>,
    goal: Option<Point>,
}

/// Pixels a metre.
const SCALE: f64 = 40.0;
/// Around the plan, metres.
const MARGIN_M: f64 = 0.5;
/// Room for a caption, metres.
const CAPTION_M: f64 = 0.8;

impl Simulator {
    /// How things are now, as a frame without an estimate.
    pub fn frame(&self) -> Frame {
        let obstacles = self.movers.iter().map(|mover| mover.shift).collect();
        let (time_s, robot, shape) = (self.time_s(), self.pose, self.shape);
        Frame { time_s, robot, shape, estimate: None, obstacles, surfaces: None, caption: None }
    }
}

impl Film {
    pub fn new(simulator: &Simulator) -> Self {
        let shapes = &simulator.shapes.all;
        let mut low: Vec<Rect> = Vec::new();
        for rect in shapes.iter().flat_map(|shape| &shape.overhead) {
            if !low.contains(rect) {
                low.push(*rect);
            }
        }
        Self {
            walls: simulator.walls.segments().to_vec(),
            obstacles: simulator.movers.iter().map(|mover| mover.obstacle.corners.clone()).collect(),
            rims: shapes.iter().map(|shape| shape.rim).collect(),
            low,
            frames: Vec::new(),
            goal: None,
        }
    }

    /// The same film with a goal that is marked.
    #[must_use]
    pub fn to(self, goal: Point) -> Self {
        Self { goal: Some(goal), ..self }
    }

    /// Appends a frame. Of one that is not later than the last only the caption is taken, and said after that one's.
    pub fn push(&mut self, frame: Frame) {
        match self.frames.last_mut() {
            Some(last) if last.time_s >= frame.time_s => match (&mut last.caption, frame.caption) {
                (Some(before), Some(caption)) => *before = format!("{before}; {caption}"),
                (before, caption) => *before = before.take().or(caption),
            },
            _ => self.frames.push(frame),
        }
    }

    pub fn frames(&self) -> &[Frame] {
        &self.frames
    }

    /// The film as an SVG that plays `speed` times as fast as time runs, again and again.
    pub fn svg(&self, speed: f64) -> String {
        let extent = self.extent();
        let (width, height) = (extent.dx(), extent.dy() + CAPTION_M);
        let mut out = String::new();
        let _ = write!(
            out,
            "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{:.0}\" height=\"{:.0}\" viewBox=\"0 0 {width:.2} {height:.2}\">\n\
             <rect width=\"100%\" height=\"100%\" fill=\"#fff\"/>\n\
             <g transform=\"matrix(1 0 0 -1 {:.2} {:.2})\" fill=\"none\" stroke-linecap=\"round\" stroke-width=\".05\">\n",
            width * SCALE,
            height * SCALE,
            -extent.x0,
            extent.y1,
        );
        for Rect { x0, y0, x1, y1 } in &self.low {
            let _ = writeln!(
                out,
                "<rect x=\"{x0:.2}\" y=\"{y0:.2}\" width=\"{:.2}\" height=\"{:.2}\" fill=\"#b59\" fill-opacity=\".15\" stroke=\"#b59\" stroke-dasharray=\".2 .1\"/>",
                x1 - x0,
                y1 - y0
            );
        }
        self.trail(&mut out, "#9ab", ".03", |frame| Some(frame.robot));
        self.trail(&mut out, "#c33\" stroke-dasharray=\".1 .1", ".03", |frame| frame.estimate);
        lines(&mut out, "stroke=\"#222\"", &self.walls);
        if let Some(at) = self.goal {
            let _ = writeln!(
                out,
                "<circle cx=\"{:.2}\" cy=\"{:.2}\" r=\"{:.2}\" fill=\"#2e9d66\" fill-opacity=\".35\" stroke=\"#2e9d66\"/>",
                at.x,
                at.y,
                self.rims[0].inner_m() / 2.0
            );
        }
        let clock = Clock::new(&self.frames, speed);
        self.surfaces(&mut out, &clock);
        self.movers(&mut out, &clock);
        self.robots(&mut out, &clock);
        out.push_str("</g>\n");
        self.captions(&mut out, &clock, height);
        out.push_str("</svg>\n");
        out
    }

    fn extent(&self) -> Rect {
        let walls = self.walls.iter().flat_map(|wall| [wall.a, wall.b]);
        let extent = Rect::around(walls.chain(self.frames.iter().map(|frame| frame.robot.at)));
        if extent.x0.is_finite() { extent.grown(MARGIN_M) } else { Rect::new(0.0, 0.0, 1.0, 1.0) }
    }

    /// What frames say of something, each from its frame until the next one that says something, or to the end.
    fn changes<'f, T>(
        &'f self,
        of: impl Fn(&'f Frame) -> Option<T> + 'f,
    ) -> impl Iterator<Item = (usize, Option<usize>, T)> + 'f {
        let said = self.frames.iter().enumerate().filter_map(move |(from, frame)| Some((from, of(frame)?)));
        let mut said = said.peekable();
        std::iter::from_fn(move || {
            let (from, what) = said.next()?;
            Some((from, said.peek().map(|(until, _)| *until), what))
        })
    }

    fn trail(&self, out: &mut String, colour: &str, width: &str, pose: impl Fn(&Frame) -> Option<Pose>) {
        let points = self.frames.iter().filter_map(pose);
        let points: Vec<String> = points.map(|pose| format!("{:.2},{:.2}", pose.at.x, pose.at.y)).collect();
        if points.len() > 1 {
            let points = points.join(" ");
            let _ =
                writeln!(out, "<polyline stroke=\"{colour}\" stroke-width=\"{width}\" points=\"{points}\"/>");
        }
    }

    fn surfaces(&self, out: &mut String, clock: &Clock) {
        for (from, until, surfaces) in self.changes(|frame| frame.surfaces.as_ref()) {
            out.push_str(
                "<g stroke=\"#27a\" stroke-width=\".09\" stroke-opacity=\".6\" visibility=\"hidden\">",
            );
            clock.show(out, from, until);
            lines(out, "", surfaces);
            out.push_str("</g>\n");
        }
    }

    fn movers(&self, out: &mut String, clock: &Clock) {
        for (number, corners) in self.obstacles.iter().enumerate() {
            let points: Vec<String> = corners.iter().map(|p| format!("{:.3},{:.3}", p.x, p.y)).collect();
            let shift = |frame: &Frame| frame.obstacles.get(number).copied().unwrap_or_default();
            out.push_str("<g>");
            let at = self.frames.iter().map(shift);
            clock.slide(out, "translate", at.map(|p| format!("{:.3} {:.3}", p.x, p.y)));
            let _ = writeln!(
                out,
                "<polygon fill=\"#e9b44c\" stroke=\"#96690a\" points=\"{}\"/></g>",
                points.join(" ")
            );
        }
    }

    fn robots(&self, out: &mut String, clock: &Clock) {
        let truth = self.frames.iter().map(|frame| frame.robot);
        self.robot(out, clock, "stroke=\"#345\" fill=\"#cde\"", truth);
        if self.frames.iter().any(|frame| frame.estimate.is_some()) {
            let estimate = self.frames.iter().map(|frame| frame.estimate.unwrap_or(frame.robot));
            self.robot(out, clock, "stroke=\"#c33\" stroke-dasharray=\".08 .08\"", estimate);
        }
    }

    fn robot(&self, out: &mut String, clock: &Clock, style: &str, poses: impl Iterator<Item = Pose>) {
        let poses: Vec<Pose> = poses.collect();
        let _ = write!(out, "<g {style}>");
        clock.slide(out, "translate", poses.iter().map(|p| format!("{:.3} {:.3}", p.at.x, p.at.y)));
        out.push_str("<g>");
        // headings are counted on over a whole turn, so that the robot does not spin back
        let mut total = 0.0;
        let mut last = 0.0;
        let headings = poses.iter().map(|pose| {
            total += crate::pose::wrapped(pose.heading - last);
            last = pose.heading;
            format!("{:.1}", total.to_degrees())
        });
        clock.slide(out, "rotate", headings.collect::<Vec<_>>().into_iter());
        for (from, until, shape) in self.shapes() {
            out.push_str(if from == 0 && until.is_none() { "<g>" } else { "<g visibility=\"hidden\">" });
            if from > 0 || until.is_some() {
                clock.show(out, from, until);
            }
            let rim = &self.rims[shape];
            let ahead = rim.reach_m(Point::towards(0.0));
            if rim.is_disc() {
                let _ = write!(out, "<circle r=\"{ahead}\"/>");
            } else {
                let corners = rim.outline(Point::default());
                let corners: Vec<String> = corners.iter().map(|p| format!("{:.3},{:.3}", p.x, p.y)).collect();
                let _ = write!(out, "<polygon points=\"{}\"/>", corners.join(" "));
            }
            let _ = write!(out, "<path d=\"M0 0H{ahead}\"/></g>");
        }
        out.push_str("</g></g>\n");
    }

    /// Which shape the robot has from which frame until which, or to the end.
    fn shapes(&self) -> Vec<(usize, Option<usize>, usize)> {
        let mut all: Vec<(usize, Option<usize>, usize)> = Vec::new();
        for (number, frame) in self.frames.iter().enumerate() {
            if all.last().is_some_and(|(_, _, shape)| *shape == frame.shape) {
                continue;
            }
            if let Some((_, until, _)) = all.last_mut() {
                *until = Some(number);
            }
            all.push((number, None, frame.shape));
        }
        all
    }

    fn captions(&self, out: &mut String, clock: &Clock, height: f64) {
        let at = height - CAPTION_M / 2.0;
        for (from, until, caption) in self.changes(|frame| frame.caption.as_ref()) {
            let _ = write!(
                out,
                "<text x=\".3\" y=\"{at:.2}\" font-size=\".4\" font-family=\"sans-serif\" visibility=\"hidden\">"
            );
            clock.show(out, from, until);
            let _ = write!(out, "{:.1} s: ", self.frames[from].time_s);
            for c in caption.chars().filter(|c| !c.is_control()) {
                match c {
                    '<' => out.push_str("&lt;"),
                    '>' => out.push_str("&gt;"),
                    '&' => out.push_str("&amp;"),
                    c => out.push(c),
                }
            }
            out.push_str("</text>\n");
        }
    }
}

fn lines(out: &mut String, style: &str, segments: &[Segment]) {
    if segments.is_empty() {
        return;
    }
    let _ = write!(out, "<path {style} d=\"");
    for Segment { a, b } in segments {
        let _ = write!(out, "M{:.2} {:.2}L{:.2} {:.2}", a.x, a.y, b.x, b.y);
    }
    out.push_str("\"/>\n");
}

/// When each frame is shown, as shares of the whole.
struct Clock {
    shares: Vec<String>,
    lasts_s: f64,
}

impl Clock {
    fn new(frames: &[Frame], speed: f64) -> Self {
        let begin = frames.first().map_or(0.0, |frame| frame.time_s);
        let lasts = frames.last().map_or(0.0, |frame| frame.time_s - begin);
        let share = |frame: &Frame| format!("{:.5}", (frame.time_s - begin) / lasts);
        let shares = frames.iter().map(share).collect();
        let is_usable = speed.is_finite() && speed > 0.0;
        Self { shares, lasts_s: lasts / if is_usable { speed } else { 1.0 } }
    }

    /// Moves what it is in, frame by frame.
    fn slide(&self, out: &mut String, kind: &str, values: impl Iterator<Item = String>) {
        let what = format!("animateTransform attributeName=\"transform\" type=\"{kind}\"");
        self.animate(out, &what, &self.shares, &values.collect::<Vec<_>>());
    }

    /// Shows what it is in from one frame until another, or to the end.
    fn show(&self, out: &mut String, from: usize, until: Option<usize>) {
        let (mut times, mut values) = (vec!["0"], vec![if from == 0 { "visible" } else { "hidden" }]);
        if from > 0 {
            times.push(&self.shares[from]);
            values.push("visible");
        }
        if let Some(until) = until {
            times.push(&self.shares[until]);
            values.push("hidden");
        }
        self.animate(out, "animate attributeName=\"visibility\" calcMode=\"discrete\"", &times, &values);
    }

    fn animate(&self, out: &mut String, what: &str, times: &[impl Borrow<str>], values: &[impl Borrow<str>]) {
        if self.lasts_s > 0.0 {
            let _ = write!(
                out,
                "<{what} dur=\"{:.2}s\" repeatCount=\"indefinite\" keyTimes=\"{}\" values=\"{}\"/>",
                self.lasts_s,
                times.join(";"),
                values.join(";"),
            );
        }
    }
}
