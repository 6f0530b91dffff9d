//! An exploration of a simulated building, and how it went.

use super::{Explorer, Guide, Learned};
use crate::floor_plan::{Disc, FloorPlan};
use crate::geometry::{Point, Segment};
use crate::navigation::mission::{frame, state_caption};
use crate::navigation::{Building, Ending, Entry, Happening, Outfit};
use crate::pose::Pose;
use crate::simulator::{Film, SimulationError, Simulator};

/// A robot that is to learn a building.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Exploration {
    /// Where the robot stands, and thinks that it stands.
    pub start: Pose,
    /// Where the user points at first.
    pub towards: Option<Point>,
    /// Of the errors of wheels and sonar.
    pub seed: u64,
}

#[derive(Clone, Debug, PartialEq)]
pub struct Explored {
    /// [`Ending::Arrived`] where no opening was left that was worth a look.
    pub ending: Ending,
    pub learned: Learned,
    /// Metres that the robot really went.
    pub path_m: f64,
    /// Seconds by the body's clock.
    pub simulated_s: f64,
    /// Whole scans.
    pub looks: u32,
    /// Touches of the skirt by the robot.
    pub touches: usize,
    /// The deepest that anything was within the robot, metres; below 0 where there was always a gap. More than a hair is
    /// a collision.
    pub overlap_m: f64,
    /// The largest error of the estimated position, metres.
    pub worst_error_m: f64,
}

impl Exploration {
    /// Explores.
    ///
    /// # Arguments
    /// `plan` is the true building; the robot is told nothing of it. `journal` gets every event; `film` gets a frame for
    /// each look around and each change of state.
    pub fn run(
        &self,
        plan: &FloorPlan,
        outfit: &Outfit,
        guide: &mut impl Guide,
        mut journal: impl FnMut(Entry),
        mut film: Option<&mut Option<Film>>,
    ) -> Result<Explored, SimulationError> {
        let walls: Vec<Segment> = plan.barriers().into_iter().map(Segment::from).collect();
        let mut body = Simulator::new(&walls, Vec::new(), outfit.robot, self.start, self.seed)?;
        let nothing = Building::unknown(Disc { radius: outfit.robot.radius_m, margin: 0.0 });
        let start = outfit.estimate(self.start);
        let mut explorer = Explorer::new(&nothing, outfit.model, outfit.navigation, start);
        explorer.point_out(self.towards);
        if let Some(film) = &mut film {
            **film = Some(Film::new(&body));
        }
        let mut explored = Explored {
            ending: Ending::OutOfPatience,
            learned: Learned::default(),
            path_m: 0.0,
            simulated_s: 0.0,
            looks: 0,
            touches: 0,
            overlap_m: f64::NEG_INFINITY,
            worst_error_m: 0.0,
        };
        loop {
            let before = body.pose();
            let ending = explorer.step(&mut body, guide);
            let (truth, thought) = (body.pose(), explorer.navigator().estimate().pose);
            explored.path_m += before.at.distance(truth.at);
            explored.worst_error_m = explored.worst_error_m.max(thought.at.distance(truth.at));
            explored.overlap_m = explored.overlap_m.max(body.overlap_m());
            for event in explorer.take_events() {
                explored.looks += u32::from(matches!(event.what, Happening::SetEstimatedPosition(_)));
                if let Some(Some(film)) = film.as_deref_mut() {
                    film_event(film, &body, &explorer, &event.what);
                }
                journal(Entry { event, truth: Some(truth) });
            }
            if let Some(ending) = ending {
                let (learned, simulated_s) = (explorer.learned(), body.time_s());
                let touches = body.touches_by_robot();
                return Ok(Explored { ending, learned, simulated_s, touches, ..explored });
            }
        }
    }
}

fn film_event(film: &mut Film, body: &Simulator, explorer: &Explorer<'_>, what: &Happening) {
    let caption = match what {
        Happening::State { decision, .. } => state_caption(*decision),
        Happening::SetEstimatedPosition(_) => {
            let openings = explorer.openings().len();
            format!("looked around: {openings} {}", if openings == 1 { "opening" } else { "openings" })
        }
        Happening::Contact { .. } => "contact".to_owned(),
        _ => return,
    };
    let navigator = explorer.navigator();
    film.push(frame(body, navigator, navigator.estimate().pose, caption));
}
