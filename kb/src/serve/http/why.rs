//! Why something is as it is, and why not otherwise.

use axum::Json;
use serde::Deserialize;
use utoipa::ToSchema;

use super::extract::{Asked, Body, Site};
use crate::serve::fault::Answered;
use crate::why::Why;
use crate::why::ask::{self, Said};
use crate::why::why_not::WhyNot;

#[derive(Deserialize)]
pub struct What {
    what: String,
}

/// Why a room, a door or one of its properties is as it is: the rule, the facts, the values.
#[utoipa::path(get, path = "/api/why", tag = "reasons",
    params(("what" = String, Query, description = "`door 7`, `room d`, `doors.7.hardness`")),
    responses((status = 200, body = Why)))]
pub async fn why(site: Site, Asked(What { what }): Asked<What>) -> Answered<Json<Why>> {
    let fork = site.fork().await?;
    site.at_length(move || fork.why(&what)).await.map(Json)
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
    let fork = site.fork().await?;
    site.at_length(move || fork.ask(&body.what, &said)).await.map(Json)
}

#[derive(Deserialize)]
pub struct OtherWay {
    start: String,
    goal: String,
    through: String,
    robot: Option<String>,
}

/// Why the best route does not lead through a room or door: what that would cost, and what decides.
#[utoipa::path(get, path = "/api/why-not", tag = "reasons",
    params(("start" = String, Query, description = "A place, a room or `x,y`"), ("goal" = String, Query, description = "A place, a room or `x,y`"),
           ("through" = String, Query, description = "`room d`, `door 7`"), ("robot" = Option<String>, Query, description = "Whose route")),
    responses((status = 200, body = WhyNot)))]
pub async fn why_not(site: Site, Asked(asked): Asked<OtherWay>) -> Answered<Json<WhyNot>> {
    let fork = site.fork().await?;
    let answer = site
        .at_length(move || fork.why_not(&asked.start, &asked.goal, &asked.through, asked.robot.as_deref()));
    answer.await.map(Json)
}
