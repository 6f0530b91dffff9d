//! Routes over maps that are not cut into rooms, as answers.

use super::{Answer, Status};
use crate::state::Courses;

impl Answer {
    /// The route to the one of several goals that costs least.
    pub(crate) fn by(
        courses: &Courses,
        (start, goals): (&str, &[String]),
        robot: &str,
        generation: u64,
    ) -> Self {
        let mut best: Option<Self> = None;
        for goal in goals {
            let answer = one(courses, [robot, start, goal], generation);
            if answer.status.code().is_some() {
                return answer;
            }
            let is_better = match &best {
                None => true,
                Some(best) => match (answer.cost, best.cost) {
                    (Some(cost), Some(least)) => cost < least,
                    (cost, _) => cost.is_some(),
                },
            };
            if is_better {
                best = Some(answer);
            }
        }
        best.unwrap_or_else(|| Self::blank(robot, start, goals, generation))
    }
}

fn one(courses: &Courses, [robot, start, goal]: [&str; 3], generation: u64) -> Answer {
    let mut answer = Answer::blank(robot, start, &[goal.to_owned()], generation);
    match courses.find(robot, start, goal) {
        Err(end) => {
            answer.status = if end.is_start { Status::UnknownStart } else { Status::UnknownGoal };
            answer.reason = Some(end.reason);
        }
        Ok(found) => {
            let row = found.row;
            if row.reason.is_some() {
                answer.status = Status::NoRoute;
            }
            (answer.cost, answer.distance, answer.reason) = (row.cost, row.distance, row.reason);
            answer.measures = row.measures;
            (answer.steps, answer.waypoints, answer.remarks) = (row.steps, row.waypoints, row.remarks);
        }
    }
    answer
}
