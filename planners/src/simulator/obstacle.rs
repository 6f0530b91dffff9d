//! Things in the way that no model knows, standing or on a course.

use crate::geometry::tolerance::ROUNDING_M;
use crate::geometry::{Point, Segment, polygon};
use crate::pose::{Frame, Pose};

/// A solid thing with straight sides.
#[derive(Clone, Debug, PartialEq)]
pub struct Obstacle {
    /// Its corners in order, at the beginning.
    pub corners: Vec<Point>,
    /// Where it goes; `None` where it stands.
    pub course: Option<Course>,
}

/// A way that an obstacle goes without turning.
#[derive(Clone, Debug, PartialEq)]
pub struct Course {
    /// Steps from where it begins, in metres: to the first of these points (as seen from the beginning), then the next.
    pub through: Vec<Point>,
    pub speed_m_s: f64,
    /// When it starts, seconds.
    pub starts_s: f64,
    /// Whether it goes back to where it began, and again, without end. Otherwise it rests at its last point.
    pub goes_round: bool,
}

impl Obstacle {
    /// A box with a middle, its extents along its own axes in metres, and turned by an angle in radians.
    pub fn boxed(middle: Point, dx_m: f64, dy_m: f64, angle: f64) -> Self {
        let frame = Frame::from(&Pose { at: middle, heading: angle });
        let corner = |(u, v): (f64, f64)| frame.place(Point::new(u * dx_m / 2.0, v * dy_m / 2.0));
        let corners = [(-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0)].map(corner).to_vec();
        Self { corners, course: None }
    }

    /// Its corners where it comes to rest; where it began, if it never does.
    pub fn at_rest(&self) -> Vec<Point> {
        let course = self.course.as_ref().filter(|course| !course.goes_round);
        let last = course.and_then(|course| course.through.last().copied()).unwrap_or_default();
        self.corners.iter().map(|&p| p + last).collect()
    }

    #[must_use]
    pub fn on(self, course: Course) -> Self {
        Self { course: Some(course), ..self }
    }
}

/// An obstacle on its way.
#[derive(Clone, Debug)]
pub(super) struct Mover {
    pub obstacle: Obstacle,
    /// How far it is from where it began.
    pub shift: Point,
    /// The point of its course that is next.
    next: usize,
    pub sides: Vec<Segment>,
}

impl Mover {
    pub fn new(obstacle: Obstacle) -> Self {
        let mut mover = Self { obstacle, shift: Point::default(), next: 0, sides: Vec::new() };
        mover.place();
        mover
    }

    /// The way that it wants to go until a time, in a straight line.
    pub fn way(&self, now_s: f64, step_s: f64) -> Point {
        let Some(course) = &self.obstacle.course else { return Point::default() };
        let Some(goal) = self.goal(course) else { return Point::default() };
        let far = course.speed_m_s * (now_s + step_s - course.starts_s).clamp(0.0, step_s);
        let left = self.shift.distance(goal);
        if left <= far {
            return goal - self.shift;
        }
        let share = far / left;
        Point::new((goal.x - self.shift.x) * share, (goal.y - self.shift.y) * share)
    }

    pub fn go(&mut self, way: Point) {
        if way == Point::default() {
            return;
        }
        self.shift = self.shift + way;
        self.place();
        let Some(course) = &self.obstacle.course else { return };
        if self.goal(course).is_some_and(|goal| goal.distance(self.shift) < ROUNDING_M) {
            let stops = course.through.len() + usize::from(course.goes_round);
            self.next = if course.goes_round { (self.next + 1) % stops } else { self.next + 1 };
        }
    }

    fn goal(&self, course: &Course) -> Option<Point> {
        let back = (course.goes_round && self.next == course.through.len()).then(Point::default);
        course.through.get(self.next).copied().or(back)
    }

    fn place(&mut self) {
        let corners: Vec<Point> = self.obstacle.corners.iter().map(|&corner| corner + self.shift).collect();
        self.sides = polygon::sides(&corners).collect();
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn after(seconds: f64, goes_round: bool) -> Point {
        let through = vec![Point::new(2.0, 0.0), Point::new(2.0, 1.0)];
        let course = Course { through, speed_m_s: 0.5, starts_s: 1.0, goes_round };
        let mut mover = Mover::new(Obstacle::boxed(Point::new(5.0, 5.0), 1.0, 1.0, 0.0).on(course));
        for step in 0..(seconds * 8.0) as u32 {
            mover.go(mover.way(f64::from(step) / 8.0, 0.125));
        }
        mover.shift
    }

    #[test]
    fn an_obstacle_keeps_to_its_course_and_rests_at_its_end() {
        assert_eq!(after(1.0, false), Point::default());
        assert!(after(3.0, false).distance(Point::new(1.0, 0.0)) < ROUNDING_M);
        assert!(after(60.0, false).distance(Point::new(2.0, 1.0)) < ROUNDING_M);
    }

    #[test]
    fn an_obstacle_may_go_round_without_end() {
        let round = 4.0 + 2.0 + 5.0_f64.sqrt() * 2.0;
        assert!(after(1.0 + round + 2.0, true).distance(Point::new(1.0, 0.0)) < 0.15);
    }
}
