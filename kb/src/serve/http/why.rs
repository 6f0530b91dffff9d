//! Why something is as it is, and why not otherwise.

use axum::Json;
use serde::Deserialize;

use super::extract::Asked;
use super::extract::Site;
use crate::serve::fault::Answered;
use crate::why::Why;
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
