//! How firm a route is, and tuning from experience.

use adit_db::history::Author;
use adit_db::traversal::Traversal;
use axum::Json;
use axum::extract::{FromRequest, Request};
use axum::http::header;
use serde::{Deserialize, Serialize};
use utoipa::ToSchema;

use super::extract::{Asked, Body};
use super::extract::{BODY, Site, too_large};
use crate::error::Code;
use crate::fit::{self, Added, Fit, Row, Scale, rows_of_csv};
use crate::serve::fault::{Answered, Fault};
use crate::serve::gate::require;
use crate::serve::role::{Caller, Role};
use crate::site::calm::come_last;
use crate::state::State;
use crate::why::firm::Firm;

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Way {
    start: String,
    goal: String,
    robot: Option<String>,
}

/// How firm a route is: for each hardness the interval around its present value within which the route stays the best, and
/// what takes over beyond either end.
#[utoipa::path(get, path = "/api/firm", tag = "reasons",
    params(("start" = String, Query, description = "A place, a room or `x,y`"), ("goal" = String, Query, description = "A place, a room or `x,y`"),
           ("robot" = Option<String>, Query, description = "Whose route")),
    responses((status = 200, body = Firm)))]
pub async fn firm(site: Site, Asked(way): Asked<Way>) -> Answered<Json<Firm>> {
    let firm = move |fork: State| {
        come_last();
        fork.firm(&way.start, &way.goal, way.robot.as_deref())
    };
    site.on_fork(firm).await.map(Json)
}

#[derive(Serialize, ToSchema)]
pub struct TraversalsAnswer {
    /// In the order in which they were added.
    traversals: Vec<Traversal>,
}

/// The traversals that are kept: metres driven in a state, and what was measured.
#[utoipa::path(get, path = "/api/traversals", tag = "experience", responses((status = 200, body = TraversalsAnswer)))]
pub async fn list(site: Site) -> Answered<Json<TraversalsAnswer>> {
    site.read(|tx| Ok(TraversalsAnswer { traversals: tx.traversals()? })).await.map(Json)
}

#[derive(Debug, Deserialize, ToSchema)]
#[serde(deny_unknown_fields)]
pub struct TraversalsBody {
    /// The traversals; all of them are added, or none.
    traversals: Vec<Row>,
    /// What is measured, where a row does not say: `seconds`, `joules`.
    #[serde(default)]
    measure: Option<String>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Measured {
    measure: Option<String>,
}

/// Adds traversals, as JSON or as `text/csv` with a line of column names; all of them, or none.
#[utoipa::path(post, path = "/api/traversals", tag = "experience", request_body = TraversalsBody,
    params(("measure" = Option<String>, Query, description = "What a CSV measures, where no column says: `seconds`, `joules`")),
    responses((status = 200, body = Added)))]
pub async fn add(
    site: Site,
    caller: Caller,
    Asked(asked): Asked<Measured>,
    request: Request,
) -> Answered<Json<Added>> {
    require(&caller, Role::Tune)?;
    let kind = request.headers().get(header::CONTENT_TYPE).and_then(|kind| kind.to_str().ok());
    let (rows, measure) = if kind.is_some_and(|kind| kind.starts_with("text/csv")) {
        let bytes = axum::body::to_bytes(request.into_body(), BODY).await;
        let bytes = bytes.map_err(|_| too_large())?;
        let text = String::from_utf8(bytes.into())
            .map_err(|_| Fault::new(Code::ServiceSyntax, "the text is not in UTF-8"))?;
        (rows_of_csv(&text)?, asked.measure)
    } else {
        let Body(body) = Body::<TraversalsBody>::from_request(request, &()).await?;
        (body.traversals, body.measure.or(asked.measure))
    };
    let author = Author { who: caller.name, why: String::new() };
    let added = site.edit_at_desk(move |desk| {
        Ok(desk.live.write(|tx| fit::add(tx, &rows, measure.as_deref(), &author))?)
    });
    added.await.map(Json)
}

#[derive(Serialize, ToSchema)]
pub struct Removed {
    removed: u64,
}

/// Removes all traversals.
#[utoipa::path(delete, path = "/api/traversals", tag = "experience", responses((status = 200, body = Removed)))]
pub async fn clear(site: Site, caller: Caller) -> Answered<Json<Removed>> {
    require(&caller, Role::Tune)?;
    let gone = site.edit_at_desk(|desk| Ok(desk.live.write(|tx| Ok(tx.clear_traversals()?))?)).await?;
    Ok(Json(Removed { removed: gone }))
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Fitted {
    robot: Option<String>,
    measure: Option<String>,
    reference: Option<String>,
    #[serde(default)]
    per_metre: bool,
}

/// The hardness of each state that fits the traversals best, with 95 % intervals. One state keeps its present hardness, the
/// most driven one unless said otherwise, since all hardness may be scaled and each route stays the best.
#[utoipa::path(get, path = "/api/fit", tag = "experience",
    params(("robot" = Option<String>, Query, description = "Whose"), ("measure" = Option<String>, Query, description = "Of which measure, where there are several"),
           ("reference" = Option<String>, Query, description = "The state that keeps its hardness"),
           ("per_metre" = Option<bool>, Query, description = "Whether hardness is the measure a metre, instead")),
    responses((status = 200, body = Fit)))]
pub async fn fit(site: Site, Asked(asked): Asked<Fitted>) -> Answered<Json<Fit>> {
    let view = site.view.load().view.clone();
    let fitted = site.beside(move || {
        let scale = match &asked.reference {
            Some(state) => Scale::Reference(state),
            None if asked.per_metre => Scale::Measure,
            None => Scale::MostDriven,
        };
        view.site().fit(asked.robot.as_deref(), asked.measure.as_deref(), scale)
    });
    fitted.await.map(Json)
}
