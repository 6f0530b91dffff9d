//! All routes of the service, and what every request passes. Their description is answered by one of them: a circle with
//! `http/service`.

mod areas;
mod edits;
mod experience;
mod extract;
mod facts;
mod floor;
mod follow;
mod history;
mod map;
mod missions;
pub mod pass;
mod portions;
mod queries;
mod route;
mod rules;
mod service;
mod sql;
mod stream;
mod tables;
mod trial;
mod whereabouts;
mod why;

use std::collections::BTreeSet;
use std::sync::Arc;

use axum::body::Body;
use axum::extract::{DefaultBodyLimit, MatchedPath, State};
use axum::http::{HeaderValue, Method, Request, StatusCode, header};
use axum::response::{IntoResponse, Response};
use axum::routing::get;
use axum::{Router, middleware};
use tower::ServiceBuilder;
use tower_http::CompressionLevel;
use tower_http::catch_panic::CatchPanicLayer;
use tower_http::compression::CompressionLayer;
use tower_http::set_header::SetResponseHeaderLayer;
use utoipa::openapi::path::{Operation, Parameter, ParameterIn};
use utoipa::openapi::security::{HttpAuthScheme, HttpBuilder, SecurityRequirement, SecurityScheme};
use utoipa::openapi::{Content, OpenApi, PathItem, Ref, RefOr, ResponseBuilder};
use utoipa_axum::router::OpenApiRouter;
use utoipa_axum::routes;

use super::fault::{Failure, Fault};
use super::shared::Shared;
use super::{event, gate, meter, page};
use crate::error::Code;
use extract::{BODY, too_large};
use pass::Peer;

/// Scripts, styles and data come from here and nowhere else.
const POLICY: &str = "default-src 'self'; img-src 'self' data: blob:; object-src 'none'; base-uri 'none'; \
                      form-action 'self'; frame-ancestors 'none'";

/// All routes, and their description.
fn described() -> (Router<Arc<Shared>>, OpenApi) {
    let (router, mut api) = OpenApiRouter::<Arc<Shared>>::new()
        .routes(routes!(service::health))
        .routes(routes!(service::ready))
        .routes(routes!(service::site))
        .routes(routes!(service::openapi))
        .routes(routes!(service::metrics))
        .routes(routes!(map::map))
        .routes(routes!(floor::floor))
        .routes(routes!(map::weights))
        .routes(routes!(map::picture))
        .routes(routes!(map::scan))
        .routes(routes!(route::route))
        .routes(routes!(follow::follow))
        .routes(routes!(follow::moved))
        .routes(routes!(whereabouts::list, whereabouts::hear))
        .routes(routes!(whereabouts::forget))
        .routes(routes!(missions::list))
        .routes(routes!(missions::journal))
        .routes(routes!(tables::tables))
        .routes(routes!(tables::file))
        .routes(routes!(tables::tunings))
        .routes(routes!(edits::edit))
        .routes(routes!(edits::blocked))
        .routes(routes!(edits::preview))
        .routes(routes!(facts::list, facts::tell))
        .routes(routes!(facts::retract))
        .routes(routes!(areas::list, areas::lay))
        .routes(routes!(areas::lift))
        .routes(routes!(history::history))
        .routes(routes!(why::ask))
        .routes(routes!(why::why))
        .routes(routes!(why::why_not))
        .routes(routes!(experience::firm))
        .routes(routes!(experience::list, experience::add, experience::clear))
        .routes(routes!(experience::fit))
        .routes(routes!(rules::list))
        .routes(routes!(rules::save, rules::remove))
        .routes(routes!(trial::check))
        .routes(routes!(rules::versions))
        .routes(routes!(rules::complete))
        .routes(routes!(rules::classes))
        .routes(routes!(rules::tables))
        .routes(routes!(rules::made_test))
        .routes(routes!(sql::ask, sql::download))
        .routes(routes!(sql::schema))
        .routes(routes!(queries::list))
        .routes(routes!(queries::save, queries::remove))
        .routes(routes!(stream::events))
        .split_for_parts();
    describe(&mut api);
    (router, api)
}

/// What the description says besides its routes.
fn describe(api: &mut OpenApi) {
    "Adit".clone_into(&mut api.info.title);
    env!("CARGO_PKG_VERSION").clone_into(&mut api.info.version);
    api.info.description = Some(
        "Routes of least hardness through a building, the tables and rules that they follow from, and why. Metres; \
         hardness has no unit. `generation` numbers the state of the knowledge base that an answer rests on. Every \
         answer with a status of 400 or more is a `Failure`. The data of events on `/api/events` are `Hello`, \
         `Changed`, `Rerouted` and `Problems`; those of `route` on `/api/route/follow` are `Followed`."
            .to_owned(),
    );
    let mut parts = api.components.take().unwrap_or_default();
    let mut add = |schemas: Vec<(String, utoipa::openapi::RefOr<utoipa::openapi::Schema>)>| {
        parts.schemas.extend(schemas);
    };
    add(schemas::<Failure>());
    add(schemas::<event::Hello>());
    add(schemas::<event::Changed>());
    add(schemas::<event::Rerouted>());
    add(schemas::<event::Problems>());
    add(schemas::<event::Followed>());
    let failure = Content::new(Some(Ref::from_schema_name("Failure")));
    let failure = ResponseBuilder::new().content("application/json", failure).build();
    for path in api.paths.paths.values_mut() {
        let asked = [&mut path.get, &mut path.put, &mut path.post, &mut path.delete];
        for operation in asked.into_iter().flatten() {
            operation.security = Some(vec![SecurityRequirement::new("token", [""; 0])]);
            operation.responses.responses.insert("4XX".to_owned(), failure.clone().into());
        }
    }
    let bearer = HttpBuilder::new().scheme(HttpAuthScheme::Bearer).build();
    parts.add_security_scheme("token", SecurityScheme::Http(bearer));
    api.components = Some(parts);
}

/// The schema of a type, and of those that it is made of.
fn schemas<T: utoipa::ToSchema>() -> Vec<(String, utoipa::openapi::RefOr<utoipa::openapi::Schema>)> {
    let mut all = vec![(T::name().into_owned(), T::schema())];
    T::schemas(&mut all);
    all
}

/// The description of all routes.
pub fn openapi() -> OpenApi {
    described().1
}

/// The routes with all that a request passes: the meter, the shape of failures, its caller's share, the gate.
pub fn router(shared: Arc<Shared>) -> Router {
    let (routes, api) = described();
    let asked = Arc::new(asked_behind(&api));
    let routes = routes.route_layer(middleware::from_fn_with_state(asked, question));
    let header = |name, value: &'static str| {
        SetResponseHeaderLayer::if_not_present(name, HeaderValue::from_static(value))
    };
    let layers = ServiceBuilder::new()
        .layer(middleware::from_fn(meter::count))
        .layer(header(header::CONTENT_SECURITY_POLICY, POLICY))
        .layer(header(header::X_CONTENT_TYPE_OPTIONS, "nosniff"))
        .layer(header(header::REFERRER_POLICY, "no-referrer"))
        .layer(middleware::from_fn(unpacked))
        .layer(CompressionLayer::new().quality(CompressionLevel::Fastest))
        .layer(middleware::from_fn(shape))
        .layer(CatchPanicLayer::custom(|_| Fault::internal().into_response()))
        .layer(middleware::from_fn_with_state(Arc::clone(&shared), pass::pass))
        .layer(DefaultBodyLimit::max(BODY));
    Router::new()
        .route("/", get(page::index))
        .route("/assets/{name}", get(page::asset))
        .merge(routes)
        .fallback(unknown)
        .method_not_allowed_fallback(not_so)
        .layer(layers)
        .with_state(shared)
}

/// The ways in which addresses are asked of which something behind the question mark is read.
fn asked_behind(api: &OpenApi) -> BTreeSet<(Method, String)> {
    let reads = |operation: &Operation| {
        let mut parameters = operation.parameters.iter().flatten();
        let is_behind =
            |of: &RefOr<Parameter>| matches!(of, RefOr::T(of) if of.parameter_in == ParameterIn::Query);
        parameters.any(is_behind)
    };
    let of_path = |(path, item): (&String, &PathItem)| {
        let asked = [
            (Method::GET, &item.get),
            (Method::PUT, &item.put),
            (Method::POST, &item.post),
            (Method::DELETE, &item.delete),
        ];
        let read = asked.into_iter().filter(|(_, operation)| operation.as_ref().is_some_and(reads));
        read.map(|(method, _)| (method, path.clone())).collect::<Vec<_>>()
    };
    api.paths.paths.iter().flat_map(of_path).collect()
}

/// Refuses what stands behind the question mark where nothing of it is read: who asks for a `dry_run` there would edit.
async fn question(
    State(asked): State<Arc<BTreeSet<(Method, String)>>>,
    path: MatchedPath,
    request: Request<Body>,
    next: middleware::Next,
) -> Response {
    let key = (request.method().clone(), path.as_str().to_owned());
    match request.uri().query().filter(|query| !query.is_empty() && !asked.contains(&key)) {
        None => next.run(request).await,
        Some(query) => {
            let first = form_urlencoded::parse(query.as_bytes()).next();
            let name = first.map_or_else(String::new, |(name, _)| name.into_owned());
            let message =
                format!("`{name}` means nothing here: {} {} reads nothing behind `?`", key.0, key.1);
            Fault::new(Code::ServiceQuestion, message).into_response()
        }
    }
}

/// Sends whoever asks from the same machine, for nobody elsewhere, everything as it is: packing it takes longer than sending it.
async fn unpacked(mut request: Request<Body>, next: middleware::Next) -> Response {
    let is_near = request.extensions().get::<Peer>().is_some_and(|peer| peer.0.is_loopback());
    if is_near && gate::is_called_on_the_spot(request.headers()) {
        request.headers_mut().remove(header::ACCEPT_ENCODING);
    }
    next.run(request).await
}

async fn unknown() -> Fault {
    Fault::new(Code::ServiceUnknown, "there is nothing at this address")
        .helped("GET /api/openapi.json lists all")
}

async fn not_so() -> Fault {
    let message = "this address is not asked in this way";
    Fault::new(Code::ServiceMethod, message).helped("GET /api/openapi.json lists all")
}

/// Gives failures of the layers below, which say them in words, the one shape of failures.
async fn shape(request: Request<Body>, next: middleware::Next) -> Response {
    let response = next.run(request).await;
    let status = response.status();
    let is_json = response
        .headers()
        .get(header::CONTENT_TYPE)
        .is_some_and(|kind| kind.as_bytes().starts_with(b"application/json"));
    if status.as_u16() < 400 || is_json {
        return response;
    }
    let fault = match status {
        StatusCode::PAYLOAD_TOO_LARGE => too_large(),
        _ if status.is_server_error() => Fault::internal(),
        _ => Fault::new(Code::ServiceRefused, status.canonical_reason().unwrap_or("refused")),
    };
    fault.into_response()
}
