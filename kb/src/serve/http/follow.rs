//! Routes that are followed.

use std::sync::Arc;

use adit_planners::geometry::Point;
use axum::Json;
use axum::extract::RawQuery;
use axum::http::HeaderMap;
use axum::response::IntoResponse;
use futures_util::stream;
use serde::Deserialize;
use utoipa::ToSchema;

use super::extract::{Body, Named, Site};
use super::stream::{Over, sent};
use crate::answer::Answer;
use crate::error::Code;
use crate::serve::event::Event;
use crate::serve::fault::{Answered, Fault};
use crate::serve::follower::Follower;
use crate::serve::gate;
use crate::serve::question::Question;

/// The route that `/api/route` answers, as an event `route`, and again whenever another one is the best, with what was done
/// meanwhile and by whom. Nothing is sent where nothing about the route changed; whoever lags hears of the newest state.
#[utoipa::path(get, path = "/api/route/follow", tag = "routes",
    params(
        ("start" = String, Query, description = "A place, a room or `x,y` in metres; `from` means the same"),
        ("goal" = String, Query, description = "A place, a room or `x,y`; may stand several times; `to` means the same"),
        ("robot" = Option<String>, Query, description = "Whose route; may be left out where there is one robot"),
        ("within" = Option<f64>, Query, description = "Metres by which a start or goal at which no state fits may be moved, to the nearest point at which one does; the answer's `taken` says where"),
        ("name" = Option<String>, Query, description = "What people call the robot, as `/api/whereabouts` then does"),
    ),
    responses((status = 200, content_type = "text/event-stream", body = String)))]
pub async fn follow(
    site: Site,
    RawQuery(query): RawQuery,
    headers: HeaderMap,
) -> Answered<impl IntoResponse> {
    let question = Question::read(query.as_deref().unwrap_or_default())?;
    if !question.errand.is_none() {
        let message = "a route that is followed has no `avoid`, `load`, `at` or states";
        return Err(Fault::new(Code::ServiceQuestion, message).helped("ask `/api/route` for one errand"));
    }
    let subscription = site.subscribe(site.asker())?;
    // subscribed before the state is read, so that no change falls between both
    let seen = site.view.load_full();
    let over = Over::of(&site);
    // and before the caller is looked at, so that no token is taken away between both
    gate::caller(&site, &headers)?;
    let (shared, asker) = (Arc::clone(&site), Arc::clone(site.asker()));
    let (follower, first) =
        site.beside(move || Follower::new(&shared, asker, subscription, question, &seen.view)).await?;
    Ok(sent(stream::unfold((Some(first), follower, over), next)))
}

type Place = (Option<Arc<Event>>, Follower, Over);

async fn next((first, mut follower, mut over): Place) -> Option<(Arc<Event>, Place)> {
    let word = if let Some(first) = first {
        first
    } else {
        tokio::select! {
            word = follower.next() => word?,
            () = over.come() => return None,
        }
    };
    Some((word, (None, follower, over)))
}

/// Where whoever follows a route now is, metres, in the map's frame.
#[derive(Debug, Deserialize, ToSchema)]
#[serde(deny_unknown_fields)]
pub struct Moved {
    x: f64,
    y: f64,
}

/// Says where a follower now is: the answer is the route from there, and from now on the stream says when another one is the
/// best from there. Where the point is refused the follower is where it was.
#[utoipa::path(post, path = "/api/route/follow/{follower}", tag = "routes", request_body = Moved,
    params(("follower" = String, Path, description = "Its name, as each event `route` of its stream says it")),
    responses((status = 200, body = Answer)))]
pub async fn moved(
    site: Site,
    Named(follower): Named<String>,
    Body(Moved { x, y }): Body<Moved>,
) -> Answered<Json<Answer>> {
    let shared = Arc::clone(&site);
    let moved = site.beside(move || {
        let seen = shared.view.load_full();
        shared.followers.moves(&follower, &seen.view, Point::new(x, y))
    });
    moved.await.map(|answer| Json((*answer).clone()))
}
