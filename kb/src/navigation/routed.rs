//! Missions on a site whose rooms are cut by state: a robot, simulated or not, drives the site's own routes, changes its shape
//! where they say so, and asks for another route where its way is closed.

use std::mem;
use std::time::Instant;

use adit_db::history::Author;
use adit_engine::{Considered, RuleBase};
use adit_planners::body::Body;
use adit_planners::geometry::{Point, Rect, Segment, polygon};
use adit_planners::navigation::{
    Entry, Met, Mission, ROOM_M, Router, Stretch, Trip, draw_along, draw_kidnapping, trip,
};
use adit_planners::pose::{Pose, wrapped};
use adit_planners::simulator::{Film, Obstacle};

use super::ground::{Ground, at};
use super::judge::{Noting, RuleJudge};
use super::missions::{Journal, Judged, Row, refuse};
use crate::answer::Answer;
use crate::edit::{Edit, Errand, Lay, Thing};
use crate::error::{Code, Error, Result};
use crate::live::Live;
use crate::navigation::body::Remote;
use crate::site::clock::stored;
use crate::state::State;

/// A robot that is a little off is taken to be where it fits, up to so far, metres.
const OFF_M: f64 = 0.5;

/// So far points that stay clear are off what is laid beside them, metres.
const HAIR_M: f64 = 1e-3;

/// Finds the site's routes, for a robot that is driven on it.
pub(super) struct Site<'l> {
    pub live: &'l mut Live,
    pub ground: &'l Ground,
    /// The site for a robot that is wider, as it was asked first.
    pub wide: &'l mut Option<State>,
    /// Whether the site is told what the robot met; otherwise that holds for this mission alone.
    pub tells: bool,
    /// Where other robots say that they are, and how wide they are: middle and radius, metres.
    pub others: &'l [(Point, f64)],
    pub on: &'l mut OnMission,
}

/// What a robot has told of what it met on a mission, and what it has heard.
pub(super) struct OnMission {
    /// Who it is.
    pub who: String,
    mission: usize,
    /// When it began: what was laid on another run under the same number is another thing.
    begun: String,
    /// What was laid over the map and lies there, by name.
    pub told: Vec<(String, Vec<Point>)>,
    /// How much was.
    laid: usize,
    /// How much was laid, and how much taken back, since that was asked last.
    passed_on: [usize; 2],
    /// The generation of the site of which it knows.
    known: u64,
    /// What became of it, in sentences.
    pub said: Vec<String>,
    pub trouble: Option<Error>,
}

impl OnMission {
    /// At the beginning of a mission of a robot that has told what lies over the map.
    pub fn begun(live: &Live, who: String, mission: usize, told: Vec<(String, Vec<Point>)>) -> Result<Self> {
        Ok(Self {
            who,
            mission,
            begun: stored(live.site().moment("0s")?),
            told,
            laid: 0,
            passed_on: [0; 2],
            known: live.generation(),
            said: Vec::new(),
            trouble: None,
        })
    }

    pub const fn mission(&self) -> usize {
        self.mission
    }
}

/// What is asked of the site.
struct Ask<'m> {
    ends: [Point; 2],
    stance: usize,
    met: &'m [Met],
    /// Each of the things that it met is so much thicker than it was seen, at the least, metres.
    room_m: f64,
    /// Whether more room is wanted beside what the map has, too.
    is_wide: bool,
}

impl Router for Site<'_> {
    fn way(&mut self, ends: [Point; 2], stance: usize, met: &[Met]) -> Option<Vec<Stretch>> {
        let way = self.found(ends, stance, met);
        self.on.known = self.live.generation();
        way.unwrap_or_else(|error| {
            self.on.trouble.get_or_insert(error);
            None
        })
    }

    fn take_told(&mut self) -> [usize; 2] {
        mem::take(&mut self.on.passed_on)
    }

    fn has_news(&mut self) -> bool {
        if let Err(error) = self.live.catch_up() {
            self.on.trouble.get_or_insert(error);
        }
        let before = mem::replace(&mut self.on.known, self.live.generation());
        before != self.on.known
    }
}

impl Site<'_> {
    fn found(&mut self, [from, to]: [Point; 2], stance: usize, met: &[Met]) -> Result<Option<Vec<Stretch>>> {
        if self.tells {
            let things = self.things(&self.not_robots(met), from, 0.0);
            self.tell(&things)?;
        }
        let lean = self.asked(&Ask { ends: [from, to], stance, met, room_m: 0.0, is_wide: false })?;
        let Some(least) = lean.as_ref().and_then(|lean| lean.cost) else { return Ok(None) };
        // farther from what stands and from what it met, where that costs little
        let settings = &self.ground.driving.navigation;
        let rooms: &[f64] =
            if met.is_empty() { &[0.0] } else { &[settings.detour_room_m, settings.detour_clearance_m] };
        let worth = settings.room_worth * least;
        let wide = rooms.iter().map(|room_m| (*room_m, true)).filter(|_| settings.beside_m > 0.0);
        let narrow = rooms.iter().map(|room_m| (*room_m, false)).filter(|_| !met.is_empty());
        for (room_m, is_wide) in wide.chain(narrow) {
            let roomy = self.asked(&Ask { ends: [from, to], stance, met, room_m, is_wide })?;
            if let Some(roomy) = roomy.filter(|roomy| roomy.cost.is_some_and(|cost| cost <= worth)) {
                return Ok(self.ground.stretches(&roomy));
            }
        }
        Ok(lean.and_then(|lean| self.ground.stretches(&lean)))
    }

    /// The best route where things stand that the robot met; `None` where there is none, or only one that ends beside the goal.
    fn asked(&mut self, ask: &Ask<'_>) -> Result<Option<Answer>> {
        let Ask { ends: [from, to], stance, met, room_m: least_m, is_wide } = *ask;
        let state = if is_wide { self.wide()? } else { self.live.fork() };
        let mut things = self.things(met, from, least_m);
        // Where what it met is known, the way is too narrow for it, though nobody else need find it so: what stands there stands
        // nearer, so that a shape with more room goes through; where nothing stands, it comes through in none.
        let stands_there = |at: Point| self.ground.walls.iter().any(|wall| wall.distance(at) <= HAIR_M);
        let known = met.iter().enumerate().filter(|(_, met)| met.is_known);
        let (stands, narrow): (Vec<_>, Vec<_>) = known.partition(|(_, met)| stands_there(met.at));
        let nearer = stands.iter().map(|(number, one)| {
            grown_by(&Segment::new(one.at, one.at), self.thickness(&met[..*number], one))
        });
        things.extend(nearer.filter(|thing| self.ground.is_on_map(thing)));
        // beside the floor nothing is in the way
        let is_on_floor = |at: Point| {
            !state.world.is_solid(at) && !things.iter().any(|thing| polygon::is_in_convex(thing, at, HAIR_M))
        };
        let narrow = narrow.into_iter().map(|(_, met)| met).filter(|met| is_on_floor(met.at));
        let errand = Errand { avoid: narrow.map(named).collect(), ..begun_in(self.ground, stance) };
        let goal = named_point(to);
        let beside_m = self.ground.driving.navigation.beside_m;
        let lay = |(number, thing): (usize, &Vec<Point>)| {
            Edit::Lay(laid(format!("met in this mission, {number}"), thing))
        };
        let mut edits: Vec<Edit> = (1..).zip(&things).map(lay).collect();
        if is_wide {
            edits.extend(wider(self.ground, 2.0 * beside_m));
        }
        let ask = |state: State, errand: &Errand| {
            where_it_fits(asked(state, &edits, (from, &goal), errand, &self.ground.robot))
        };
        let answer = ask(state.fork(), &errand)?.filter(|answer| answer.cost.is_some());
        // where its shape does not fit by what it saw, another one may
        let answer = match answer {
            None => ask(state, &Errand { start_state: None, start_facing: None, ..errand })?,
            answer => answer,
        };
        // whoever stands where only the narrow fits goes on in the narrow
        let begins_here = |answer: &Answer| {
            !is_wide
                || answer.waypoints.first().is_some_and(|first| at(first).distance(from) <= 2.0 * beside_m)
        };
        Ok(answer.filter(|answer| {
            answer.cost.is_some() && begins_here(answer) && self.ground.leads_to(answer, to)
        }))
    }

    /// The site for a robot that is a little wider. It is cut anew for it once.
    fn wide(&mut self) -> Result<State> {
        if self.wide.is_none() {
            let edits: Vec<Edit> =
                wider(self.ground, 2.0 * self.ground.driving.navigation.beside_m).collect();
            *self.wide = Some(self.live.fork().after(&edits)?);
        }
        Ok(self.wide.as_ref().map_or_else(|| self.live.fork(), State::fork))
    }

    /// What the robot saw and did not know of, as outlines of things that stand on the map; none stands where the robot does, or
    /// on a place. Where it was in the way again, though the route left room for it, it is taken to be thicker; each by so many
    /// metres at the least.
    fn things(&self, met: &[Met], from: Point, least_m: f64) -> Vec<Vec<Point>> {
        let places = self.ground.plan.places().iter().map(|place| place.at);
        let clear: Vec<Point> = places.chain([from]).collect();
        let thick = |(number, one): (usize, &Met)| {
            let grown = self.thickness(&met[..number], one).max(least_m);
            let seen = one.seen.iter().flat_map(|surface| beside(surface, grown, &clear));
            seen.map(|surface| grown_by(&surface, grown)).collect::<Vec<_>>()
        };
        let mut things = things(met.iter().enumerate().flat_map(thick), &clear);
        things.retain(|thing| self.ground.is_on_map(thing));
        things
    }

    /// What it met, without what others are that drive here: they are gone when somebody comes by.
    fn not_robots(&self, met: &[Met]) -> Vec<Met> {
        let near_m = self.ground.driving.navigation.near_robot_m;
        let is_robot = |surface: &Segment| {
            self.others.iter().any(|(at, radius)| surface.distance(*at) <= radius + near_m)
        };
        let without = |one: &Met| {
            let seen = one.seen.iter().filter(|surface| !is_robot(surface)).copied().collect();
            Met { seen, ..one.clone() }
        };
        met.iter().map(without).collect()
    }

    /// How much thicker than it was seen something is taken to be, metres: twice as much each time that it was in the way again.
    fn thickness(&self, before: &[Met], met: &Met) -> f64 {
        let settings = &self.ground.driving.navigation;
        let again = before.iter().filter(|other| other.at.distance(met.at) <= settings.same_spot_m).count();
        (settings.squeeze_m * 2f64.powi(again as i32)).min(settings.detour_room_m)
    }

    /// Lays over the map what was met, and lifts what the robot no longer believes to be there.
    fn tell(&mut self, things: &[Vec<Point>]) -> Result<()> {
        let Self { ground, on, .. } = self;
        let author = Author { who: on.who.clone(), why: format!("met in mission {}", on.mission) };
        let (kept, gone): (Vec<_>, Vec<_>) =
            mem::take(&mut on.told).into_iter().partition(|(_, thing)| things.contains(thing));
        on.told = kept;
        let mut edits: Vec<Edit> = gone.into_iter().map(|(name, _)| Edit::Lift(name)).collect();
        for thing in things {
            if on.told.iter().all(|(_, told)| told != thing) {
                on.laid += 1;
                let name =
                    format!("met by {} in mission {} at {}, {}", on.who, on.mission, on.begun, on.laid);
                let lay = laid(name.clone(), thing);
                let until = Some(format!("{:.0}s", ground.driving.navigation.reported_s));
                edits.push(Edit::Lay(Lay { until, ..lay }));
                let middle = Rect::around(thing.iter().copied()).centre();
                on.said.push(format!(
                    "laid over the map for {}: something at {:.1}, {:.1}, {name}",
                    lasting(ground.driving.navigation.reported_s),
                    middle.x,
                    middle.y
                ));
                on.told.push((name, thing.clone()));
            }
        }
        if !edits.is_empty() {
            let before = self.live.generation();
            let lifted = edits.iter().filter(|edit| matches!(edit, Edit::Lift(_))).count();
            let laid = edits.len() - lifted;
            let outcome = self.live.edit(&Edit::Together(edits), &author)?;
            // what lies where something lay before is no news
            if outcome.generation != before {
                let [laid_before, lifted_before] = self.on.passed_on;
                self.on.passed_on = [laid_before + laid, lifted_before + lifted];
            }
            self.on.said.extend(outcome.reacted);
        }
        Ok(())
    }
}

/// So many seconds, as people say it.
fn lasting(seconds: f64) -> String {
    let minutes = (seconds / 60.0).round();
    match minutes {
        60.0 => "an hour".to_owned(),
        _ if minutes % 60.0 == 0.0 => format!("{} hours", minutes / 60.0),
        _ if minutes > 1.0 => format!("{minutes} minutes"),
        _ => format!("{seconds} seconds"),
    }
}

fn laid(name: String, outline: &[Point]) -> Lay {
    let corners = outline.iter().map(|at| [at.x, at.y]).collect();
    Lay { what: Thing::Obstacle, name, corners, ..Lay::default() }
}

/// A surface in pieces, so that what is so near to them, metres, leaves points clear. Nobody comes through where it is parted.
fn beside(surface: &Segment, metres: f64, clear: &[Point]) -> Vec<Segment> {
    let (along, length) = (surface.direction(), surface.length());
    let is_near = |at: &&Point| surface.distance(**at) <= 2.0 * metres;
    let mut feet: Vec<f64> = clear.iter().filter(is_near).map(|at| (*at - surface.a).dot(along)).collect();
    feet.sort_by(f64::total_cmp);
    let free = metres + HAIR_M;
    let ends = feet.iter().flat_map(|foot| [foot - free, foot + free]);
    let ends: Vec<f64> = [0.0].into_iter().chain(ends).chain([length]).collect();
    let pieces = ends.chunks_exact(2).map(|piece| [piece[0].clamp(0.0, length), piece[1].clamp(0.0, length)]);
    let pieces = pieces.filter(|[from, to]| to > from);
    pieces.map(|[from, to]| Segment::new(surface.a + along * from, surface.a + along * to)).collect()
}

/// A surface with what is so near to it, metres, as a rectangle.
fn grown_by(surface: &Segment, metres: f64) -> Vec<Point> {
    let along = surface.direction() * metres;
    let (aside, a, b) = (along.perpendicular(), surface.a - along, surface.b + along);
    vec![a - aside, b - aside, b + aside, a + aside]
}

/// The least convex things that hold these, which are convex, counterclockwise; those that meet are one. None of the clear points
/// lies in them: where one would, they stay apart.
fn things(all: impl IntoIterator<Item = Vec<Point>>, clear: &[Point]) -> Vec<Vec<Point>> {
    let is_apart = |thing: &[Point]| clear.iter().all(|at| !polygon::is_in_convex(thing, *at, 0.0));
    let mut things: Vec<Vec<Point>> = Vec::new();
    for mut thing in all {
        let joined = |other: &[Point], thing: &[Point]| {
            let hull = || polygon::hull(other.iter().chain(thing).copied());
            polygon::do_convex_meet(other, thing).then(hull).filter(|hull| is_apart(hull))
        };
        while let Some((place, hull)) =
            things.iter().enumerate().find_map(|(place, other)| Some((place, joined(other, &thing)?)))
        {
            things.remove(place);
            thing = hull;
        }
        things.push(thing);
    }
    things.retain(|thing| is_apart(thing));
    things
}

/// What makes a robot larger all around in each of its states.
fn wider(ground: &Ground, by_m: f64) -> impl Iterator<Item = Edit> + '_ {
    ground.outlines.iter().flat_map(move |outline| {
        let key = format!("{}/{}", ground.robot, outline.name);
        let sizes = [("width", Some(2.0 * outline.radius_m)), ("length", outline.length_m)];
        sizes.into_iter().filter_map(move |(column, metres)| {
            let value = format!("{:?}", metres? + by_m);
            Some(Edit::Set("robots".to_owned(), key.clone(), column.to_owned(), value))
        })
    })
}

/// An errand of a robot that begins in a stance.
fn begun_in(ground: &Ground, stance: usize) -> Errand {
    let (state, start_facing) = ground.of_stance(stance);
    Errand { start_state: Some(state.to_owned()), start_facing, ..Errand::default() }
}

/// A route from where a robot is, or may be, on an errand, after edits that nobody keeps.
fn asked(
    state: State,
    edits: &[Edit],
    (from, goal): (Point, &str),
    errand: &Errand,
    robot: &str,
) -> Result<Answer> {
    let start = named_point(from);
    state.within(Some(OFF_M))?.route_after(edits, errand, (&start, goal), robot)
}

/// An answer; none where the robot fits nowhere near an end by what is told, from which nothing leads on.
fn where_it_fits(answer: Result<Answer>) -> Result<Option<Answer>> {
    match answer {
        Err(error) if error.problems().iter().any(|one| one.code() == Some(Code::RouteSolid)) => Ok(None),
        answer => answer.map(Some),
    }
}

/// As ends of routes name it.
fn named_point(at: Point) -> String {
    format!("{:?},{:?}", at.x, at.y)
}

/// As closings name it: the point, and the degrees into which the robot looked.
fn named(met: &Met) -> String {
    format!("{:.3},{:.3}@{:.0}", met.at.x, met.at.y, met.heading.to_degrees())
}

/// All that happened, and for each decision the rule that spoke.
type Happened = (Vec<Entry>, Vec<Option<Considered>>);

/// Missions on a site.
pub struct Missions<'l> {
    pub live: &'l mut Live,
    pub ground: &'l Ground,
    /// The rules that drive the robot.
    pub rules: &'l std::sync::Arc<RuleBase>,
    /// Whether the site is told what the robot meets.
    pub tells: bool,
    /// Where ways are looked for that leave more room.
    pub(super) wide: Option<State>,
}

impl<'l> Missions<'l> {
    /// Missions of a robot by rules that drive it; the site is told what it meets where `tells`.
    pub fn new(
        live: &'l mut Live,
        (ground, rules): (&'l Ground, &'l std::sync::Arc<RuleBase>),
        tells: bool,
    ) -> Self {
        Self { live, ground, rules, tells, wide: None }
    }
}

impl Missions<'_> {
    /// A mission between two points, without obstacles.
    pub fn between(&self, [start, goal]: [Point; 2], heading: f64, seed: u64) -> Mission {
        Mission::between(Pose { at: start, heading }, goal, seed)
    }

    /// Missions drawn by chance, with up to five boxes that the robot does not know; on each it is carried off once where
    /// `is_kidnapped`.
    pub fn drawn(&self, count: usize, (seed, is_kidnapped): (u64, bool)) -> Result<Vec<Mission>> {
        let one = |number| {
            let mission = self.drawn_one(number, seed)?;
            let to = || draw_kidnapping(&self.ground.plan, self.ground.widest_radius(), &mission);
            let kidnapping = is_kidnapped.then(to).flatten();
            Ok(Mission { kidnapping, ..mission })
        };
        (0..count).map(one).collect()
    }

    /// The mission of a number among those that are drawn by chance.
    pub(super) fn drawn_one(&self, number: usize, seed: u64) -> Result<Mission> {
        let (ground, radius) = (self.ground, self.ground.least_radius());
        // Far apart, so that seeds that lie together give different missions.
        let seed = seed.wrapping_add((number as u64 + 1).wrapping_mul(0x9E37_79B9_7F4A_7C15));
        let mut trouble = None;
        let way = |start: Point, goal: Point| {
            // routes may begin and end a little beside points at which the robot does not fit; missions do not
            ground.fitting(&self.live.fork(), start).ok()?;
            let ends = (start, &*named_point(goal));
            match asked(self.live.fork(), &[], ends, &Errand::default(), &ground.robot) {
                Ok(answer) => {
                    let way = ground.stretches(&answer).filter(|_| ground.leads_to(&answer, goal))?;
                    Some(way.into_iter().flat_map(|stretch| stretch.points).collect())
                }
                Err(error) => {
                    trouble.get_or_insert(error);
                    None
                }
            }
        };
        let mission = draw_along(&ground.plan, &ground.doorways, radius, seed, way);
        // on a place nothing can be laid, by which a mission is judged
        let is_on_place = |thing: &Obstacle| {
            let corners = thing.at_rest();
            ground.plan.places().iter().any(|place| polygon::is_in_convex(&corners, place.at, HAIR_M))
        };
        match (mission, trouble) {
            (Some(mut mission), _) => {
                // nor where the robot stands, in the shape in which it begins
                let rim = ground.buildings[self.stance_of(&mission)?].rim;
                let start = mission.start.at;
                let is_on_robot = |thing: &Obstacle| {
                    let far = |side: Segment| rim.distance(start, &side);
                    polygon::sides(&thing.corners).map(far).any(|far| far <= rim.radius_m() + HAIR_M)
                };
                mission.obstacles.retain(|thing| !is_on_place(thing) && !is_on_robot(thing));
                Ok(mission)
            }
            (None, Some(trouble)) => Err(trouble),
            (None, None) => {
                let message =
                    "the site has no room for missions: start and goal need some metres between them";
                Err(Error::said(Code::SimulateNoRoom, message, None))
            }
        }
    }

    /// Runs a mission, and judges it by what is possible with its obstacles where they come to rest.
    ///
    /// # Returns
    /// Beside the mission with its journal what the site was told, and what followed, in sentences.
    pub fn run(
        &mut self,
        (number, mission): (usize, &Mission),
        film: Option<&mut Option<Film>>,
    ) -> Result<(Journal, Vec<String>)> {
        let before = Instant::now();
        let (ground, goal) = (self.ground, named_point(mission.goal));
        let stance = self.stance_of(mission)?;
        let mission = &self.placed(mission, stance);
        let (on, outfit) = ground.stage(stance);
        let (outcome, journal, said) = self.along(number, |site, judge, entries| {
            mission
                .run(&on, &outfit, Some(site), judge, |entry| entries.push(entry), film)
                .map_err(Error::of(Code::SimulateImpossible))
        })?;
        let radius = ground.shapes.all[outcome.trip.shape].rim.inner_m();
        let kidnapped = outcome.kidnapped.map(|(pose, shape)| (pose, ground.stance_at(shape, pose.heading)));
        let (from, stance) = kidnapped.unwrap_or((mission.start, stance));
        let judged = self.judged(mission, (from.at, &goal), stance)?;
        let row = Row::new((number, mission), &outcome, Some(judged), radius);
        let row = self.weighed(row, &outcome.trip, before);
        // being carried is not driving, however hard that were
        let cost = row.cost.filter(|_| outcome.kidnapped.is_none());
        let row = Row { cost, ..row };
        Ok(((row, journal.0, journal.1), said))
    }

    /// Has a robot drive to a goal of which nobody knows where it really is.
    ///
    /// # Returns
    /// As [`Self::run`].
    pub fn drive(
        &mut self,
        number: usize,
        (start, goal): (Pose, Point),
        body: &mut Remote,
    ) -> Result<(Journal, Vec<String>)> {
        let before = Instant::now();
        let ground = self.ground;
        let stance = ground.stance_at(body.shape(), start.heading);
        let (_, outfit) = ground.stage(stance);
        let outfit = outfit.measuring(body.directions(), body.range_m());
        let (trip, journal, said) = self.along(number, |site, judge, entries| {
            let on = (&ground.buildings[..], stance);
            Ok(trip(body, on, (start, goal), &outfit, Some(site), judge, |entry| entries.push(entry)))
        })?;
        let row = Row::of_trip(number, [start.at, goal], &trip);
        let row = Row { silence: body.silence().map(str::to_owned), ..row };
        let row = self.weighed(row, &trip, before);
        Ok(((row, journal.0, journal.1), said))
    }

    /// Has something driven by the site's routes and rules.
    ///
    /// # Returns
    /// Beside what came of it the journal, and what the site was told, and what followed, in sentences.
    pub(super) fn along<O>(
        &mut self,
        number: usize,
        go: impl FnOnce(&mut Site<'_>, &mut Noting<'_, RuleJudge>, &mut Vec<Entry>) -> Result<O>,
    ) -> Result<(O, Happened, Vec<String>)> {
        let mut on = OnMission::begun(self.live, self.ground.robot.clone(), number, Vec::new())?;
        let mut site = Site {
            live: self.live,
            ground: self.ground,
            wide: &mut self.wide,
            tells: self.tells,
            others: &[],
            on: &mut on,
        };
        let mut judge = RuleJudge::of_rules(self.rules)?;
        let mut noting = Noting::new(&mut judge);
        let mut entries = Vec::new();
        let outcome = go(&mut site, &mut noting, &mut entries)?;
        let (said, trouble, decided) = (on.said, on.trouble, noting.decided);
        if let Some(trouble) = trouble {
            return Err(trouble);
        }
        refuse(judge.trouble())?;
        Ok((outcome, (entries, decided), said))
    }

    /// A row with what the robot did in each state, and how hard that was.
    pub(super) fn weighed(&self, row: Row, trip: &Trip, before: Instant) -> Row {
        let milliseconds = before.elapsed().as_secs_f64() * 1e3;
        let states = || self.ground.states.iter().cloned();
        Row {
            by_state: states().zip(trip.metres.iter().copied()).filter(|(_, metres)| *metres > 0.0).collect(),
            paces: states().zip(trip.paces.iter().copied()).filter(|(_, pace)| pace.seconds > 0.0).collect(),
            cost: Some(self.ground.hardness(&self.live.fork(), &trip.track, &trip.changes)),
            milliseconds,
            ..row
        }
    }

    /// A mission whose robot faces as it has to in the stance in which it begins.
    pub(super) fn placed(&self, mission: &Mission, stance: usize) -> Mission {
        let heading = mission.start.heading;
        let heading = wrapped(heading + self.ground.buildings[stance].off_facing(heading));
        Mission { start: Pose { heading, ..mission.start }, ..mission.clone() }
    }

    /// In which stance the robot begins: as its route does; without one, in the first that fits there.
    pub(super) fn stance_of(&self, mission: &Mission) -> Result<usize> {
        let (at, goal) = (mission.start.at, named_point(mission.goal));
        let first = asked(self.live.fork(), &[], (at, &goal), &Errand::default(), &self.ground.robot)?;
        let by_route = self.ground.stretches(&first).and_then(|way| Some(way.first()?.stance));
        let fitting = self.ground.fitting(&self.live.fork(), at)?;
        Ok(by_route.filter(|stance| fitting.contains(stance)).unwrap_or(fitting[0]))
    }

    /// What is possible for who knows of all obstacles.
    fn judged(&self, mission: &Mission, ends: (Point, &str), stance: usize) -> Result<Judged> {
        let errand = begun_in(self.ground, stance);
        // one that comes to rest beside the map is in nobody's way
        let boxes = mission.obstacles.iter().map(Obstacle::at_rest);
        let boxes = (1..).zip(boxes.filter(|thing| self.ground.is_on_map(thing)));
        let boxes =
            boxes.map(|(number, thing): (usize, _)| Edit::Lay(laid(format!("unknown box {number}"), &thing)));
        let mut edits: Vec<Edit> = boxes.collect();
        let best = |edits: &[Edit]| -> Result<Option<Answer>> {
            let answer = where_it_fits(asked(self.live.fork(), edits, ends, &errand, &self.ground.robot))?;
            Ok(answer.filter(|answer| answer.cost.is_some() && self.ground.leads_to(answer, mission.goal)))
        };
        let known = best(&edits)?;
        edits.extend(wider(self.ground, 2.0 * ROOM_M));
        let roomy = best(&edits)?;
        Ok(Judged {
            is_possible: known.is_some(),
            is_with_room: roomy.is_some(),
            least_cost: known.as_ref().and_then(|known| known.cost),
            optimum_m: known.and_then(|known| known.distance),
        })
    }
}
