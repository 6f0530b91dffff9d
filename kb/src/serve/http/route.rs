//! Routes between any two ends.

use std::sync::Arc;

use axum::Json;
use axum::extract::RawQuery;
use axum::http::header;
use axum::response::{IntoResponse, Response};

use super::extract::Site;
use crate::answer::Answer;
use crate::error::Code;
use crate::live::View;
use crate::serve::fault::{Answered, Fault};
use crate::serve::shared::beside;

/// Goals that one question may name.
const GOALS: usize = 100;
struct Question {
    start: String,
    goals: Vec<String>,
    robot: Option<String>,
    within: Option<f64>,
}

impl Question {
    fn read(query: &str) -> Answered<Self> {
        let (mut start, mut goals, mut robot, mut within) = (None, Vec::new(), None, None);
        for (name, value) in form_urlencoded::parse(query.as_bytes()) {
            match &*name {
                "start" => start = Some(value.into_owned()),
                "goal" => goals.push(value.into_owned()),
                "robot" => robot = Some(value.into_owned()),
                "within" => {
                    let metres = value.parse().map_err(|_| {
                        Fault::new(
                            Code::RouteWithin,
                            format!("`within` is `{value}`, and is a number of metres"),
                        )
                    })?;
                    within = Some(metres);
                }
                other => {
                    let message =
                        format!("a route has `start`, `goal`, `robot` and `within`, and not `{other}`");
                    return Err(Fault::new(Code::ServiceQuestion, message));
                }
            }
        }
        match start {
            Some(start) if (1..=GOALS).contains(&goals.len()) => Ok(Self { start, goals, robot, within }),
            _ => {
                let message = format!("a route needs `start`, and `goal` once, or up to {GOALS} times");
                Err(Fault::new(Code::ServiceQuestion, message).helped("/api/route?start=dock&goal=ward%206"))
            }
        }
    }

    /// The answer where it takes microseconds.
    fn quick(&self, view: &View) -> Answered<Option<Response>> {
        let text = view.quick_route(&self.start, &self.goals, self.robot.as_deref())?;
        Ok(text.map(|text| ([(header::CONTENT_TYPE, "application/json")], text).into_response()))
    }

    fn answer(&self, view: &View) -> Answered<Response> {
        let answer = view.route(&self.start, &self.goals, self.robot.as_deref())?;
        match answer.status.code() {
            Some(code) => Err(Fault::new(code, answer.reason.unwrap_or_default())),
            None => Ok(Json(answer).into_response()),
        }
    }
}

/// The route of least hardness between two places, rooms or points `x,y`; of several goals to the one that costs least.
///
/// What was edited or told before is known to it, also where routes kept in the database have yet to follow.
#[utoipa::path(get, path = "/api/route", tag = "routes",
    params(
        ("start" = String, Query, description = "A place, a room or `x,y` in metres"),
        ("goal" = String, Query, description = "A place, a room or `x,y`; may stand several times"),
        ("robot" = Option<String>, Query, description = "Whose route; may be left out where there is one robot"),
        ("within" = Option<f64>, Query, description = "Metres by which a start or goal at which no state fits may be moved, to the nearest point at which one does; the answer's `taken` says where"),
    ),
    responses((status = 200, body = Answer)))]
pub async fn route(site: Site, RawQuery(query): RawQuery) -> Answered<Response> {
    let question = Question::read(query.as_deref().unwrap_or_default())?;
    let seen = Arc::clone(&site.view.load());
    let view = seen.view.clone().within(question.within)?;
    if let Some(response) = question.quick(&view)? {
        return Ok(response);
    }
    // over measured rooms it takes milliseconds, and so does the reason why there is no route
    beside(move || question.answer(&view)).await
}
