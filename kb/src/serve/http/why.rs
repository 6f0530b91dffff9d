//! Why something is as it is, and why not otherwise.

use axum::Json;
use serde::{Deserialize, Serialize};
use utoipa::ToSchema;

use super::extract::{Asked, Body, Site};
use crate::error::{Code, Error};
use crate::serve::fault::Answered;
use crate::why::Why;
use crate::why::ask::{self, Said};
use crate::why::way::WhyWay;
use crate::why::why_not::WhyNot;

/// Of a thing, or of a route.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub struct What {
    #[serde(rename = "what")]
    thing: Option<String>,
    start: Option<String>,
    goal: Option<String>,
    at: Option<String>,
    robot: Option<String>,
}

/// Why a thing is as it is, or why a route does what it does.
#[derive(Serialize, utoipa::ToSchema)]
#[serde(untagged)]
pub enum Reasons {
    /// Of a thing.
    Thing(Why),
    /// Of a route.
    Way(WhyWay),
}

/// Why a room, a door or one of its properties is as it is: the rule, the facts, the values. With `start` and `goal`, why the
/// best route does what it does: what keeps easier states out, what the best way without costs, and up to where the choice holds.
#[utoipa::path(get, path = "/api/why", tag = "reasons",
    params(("what" = Option<String>, Query, description = "`door 7`, `room d`, `doors.7.hardness`"),
           ("start" = Option<String>, Query, description = "Of a route: a place, a space, a room or `x,y`"), ("goal" = Option<String>, Query, description = "Of a route: a place, a space, a room or `x,y`"),
           ("at" = Option<String>, Query, description = "Only its stretches at this space, doorway, area, named door or point"),
           ("robot" = Option<String>, Query, description = "Whose route")),
    responses((status = 200, body = Reasons)))]
pub async fn why(site: Site, Asked(asked): Asked<What>) -> Answered<Json<Reasons>> {
    let answer = site.on_fork(move |fork| match (&asked.thing, &asked.start, &asked.goal) {
        (Some(what), None, None) => fork.why(what).map(Reasons::Thing),
        (None, Some(start), Some(goal)) => {
            fork.why_way((start, goal), asked.at.as_deref(), asked.robot.as_deref()).map(Reasons::Way)
        }
        _ => {
            let message = "say `what`, or `start` and `goal` of a route";
            Err(Error::said(Code::WhyUnknown, message, None))
        }
    });
    answer.await.map(Json)
}

#[derive(Debug, Deserialize, ToSchema)]
#[serde(deny_unknown_fields)]
pub struct AskBody {
    /// What to find out: class, object and property, as `orders.2.total`.
    what: String,
    /// What was answered so far.
    #[serde(default)]
    answers: Vec<AnswerBody>,
}

#[derive(Debug, Deserialize, ToSchema)]
#[serde(deny_unknown_fields)]
pub struct AnswerBody {
    /// What was asked, as `question.what` says it.
    what: String,
    /// The value; `null`: it is not known.
    #[schema(value_type = serde_json::Value)]
    value: serde_json::Value,
}

/// What a value is. Where rules lack something to conclude it, the next question: ask again with its answer. Nothing is
/// kept of the answers; tell them where they should hold.
#[utoipa::path(post, path = "/api/ask", tag = "reasons", request_body = AskBody,
    responses((status = 200, body = ask::Asked)))]
pub async fn ask(site: Site, Body(body): Body<AskBody>) -> Answered<Json<ask::Asked>> {
    let said = body.answers.into_iter().map(|AnswerBody { what, value }| {
        let value = match value {
            serde_json::Value::Null => None,
            serde_json::Value::String(text) => Some(text),
            other => Some(other.to_string()),
        };
        Said { what, value }
    });
    let said: Vec<Said> = said.collect();
    site.on_fork(move |fork| fork.ask(&body.what, &said)).await.map(Json)
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub struct OtherWay {
    start: String,
    goal: String,
    through: String,
    robot: Option<String>,
}

/// Why the best route does not lead through something: what that would cost, and what decides.
#[utoipa::path(get, path = "/api/why-not", tag = "reasons",
    params(("start" = String, Query, description = "A place, a room or `x,y`"), ("goal" = String, Query, description = "A place, a room or `x,y`"),
           ("through" = String, Query, description = "A space, a doorway, an area, a named door, `room d`, `door 7`, a place, or a point `x,y`"), ("robot" = Option<String>, Query, description = "Whose route")),
    responses((status = 200, body = WhyNot)))]
pub async fn why_not(site: Site, Asked(asked): Asked<OtherWay>) -> Answered<Json<WhyNot>> {
    let answer = site
        .on_fork(move |fork| fork.why_not(&asked.start, &asked.goal, &asked.through, asked.robot.as_deref()));
    answer.await.map(Json)
}
