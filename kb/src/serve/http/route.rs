//! Routes between any two ends.

use axum::Json;
use axum::extract::RawQuery;
use axum::http::header;
use axum::response::{IntoResponse, Response};

use super::extract::Site;
use crate::answer::Answer;
use crate::error::Code;
use crate::serve::fault::{Answered, Fault};
use crate::serve::question::{Question, checked};

/// The route of least hardness between two places, rooms or points `x,y`; of several goals to the one that costs least.
///
/// With `avoid`, `load`, `at` or a state it is that of one errand, on a copy of the site: nothing is saved, and nobody else is led
/// otherwise.
///
/// What was edited or told before is known to it, also where routes kept in the database have yet to follow.
#[utoipa::path(get, path = "/api/route", tag = "routes",
    params(
        ("start" = String, Query, description = "A place, a room or `x,y` in metres"),
        ("goal" = String, Query, description = "A place, a room or `x,y`; may stand several times"),
        ("robot" = Option<String>, Query, description = "Whose route; may be left out where there is one robot"),
        ("within" = Option<f64>, Query, description = "Metres by which a start or goal at which no state fits may be moved, to the nearest point at which one does; the answer's `taken` says where"),
        ("avoid" = Option<String>, Query, description = "A doorway, a space, an area, a kind of area or a point `x,y` that is closed to this errand alone; may stand several times"),
        ("load" = Option<String>, Query, description = "What the robot carries on this errand"),
        ("at" = Option<String>, Query, description = "When the errand is: `18:00`, `2h`, `2026-11-21T18:00`; facts that end and opening hours are as they are then"),
        ("start_state" = Option<String>, Query, description = "In which state the robot starts; unless said, in whichever is cheapest"),
        ("goal_state" = Option<String>, Query, description = "In which state it arrives"),
    ),
    responses((status = 200, body = Answer)))]
pub async fn route(site: Site, RawQuery(query): RawQuery) -> Answered<Response> {
    let question = Question::read(query.as_deref().unwrap_or_default())?;
    if question.name.is_some() {
        let message = "a route has no `name`: nobody is told of it again";
        return Err(Fault::new(Code::ServiceQuestion, message)
            .helped("ask `/api/route/follow` for one that is followed"));
    }
    if !question.errand.is_none() {
        let answer = site.on_errand(move |fork| question.answer_on_errand(fork)).await?;
        return checked(answer).map(|answer| Json(answer).into_response());
    }
    let seen = site.view.load_full();
    // over doors it takes microseconds
    let quick = seen.view.clone().within(question.within)?;
    let quick = quick.quick_route(&question.start, &question.goals, question.robot.as_deref())?;
    if let Some(text) = quick {
        return Ok(([(header::CONTENT_TYPE, "application/json")], text).into_response());
    }
    // over measured rooms it takes milliseconds, and so does the reason why there is no route
    site.beside(move || question.answer(&seen.view)).await.map(|answer| Json(answer).into_response())
}
