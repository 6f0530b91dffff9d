//! What is counted and timed, for Prometheus.

use std::sync::{Arc, OnceLock};
use std::time::Instant;

use axum::extract::{MatchedPath, Request};
use axum::middleware::Next;
use axum::response::Response;
use metrics::{counter, gauge, histogram};
use metrics_exporter_prometheus::{PrometheusBuilder, PrometheusHandle};

use super::shared::Shared;

/// Seconds at which a histogram is cut.
const BUCKETS: [f64; 11] = [1e-4, 2.5e-4, 5e-4, 1e-3, 2.5e-3, 5e-3, 1e-2, 5e-2, 0.1, 0.5, 2.0];

static RECORDER: OnceLock<Option<PrometheusHandle>> = OnceLock::new();

/// Begins to count. One process counts once, however many services it runs.
pub fn start() {
    RECORDER.get_or_init(|| PrometheusBuilder::new().set_buckets(&BUCKETS).ok()?.install_recorder().ok());
}

/// Counts and times a request under the name of its route.
pub async fn count(request: Request, next: Next) -> Response {
    let path = request.extensions().get::<MatchedPath>().cloned();
    let began = Instant::now();
    let response = next.run(request).await;
    let path: Arc<str> = path.map_or_else(|| "unknown".into(), |path| path.as_str().into());
    let status = response.status().as_u16() / 100;
    counter!("adit_requests_total", "route" => path.to_string(), "status" => format!("{status}xx"))
        .increment(1);
    histogram!("adit_request_seconds", "route" => path.to_string()).record(began.elapsed().as_secs_f64());
    response
}

/// All that was counted, in Prometheus' text.
pub fn text(shared: &Shared) -> String {
    let seen = shared.view.load();
    gauge!("adit_generation").set(seen.view.generation() as f64);
    gauge!("adit_subscribers").set(shared.subscribed() as f64);
    gauge!("adit_rooms").set(seen.view.graph().rooms.len() as f64);
    gauge!("adit_doors").set(seen.view.graph().doors.len() as f64);
    RECORDER.get().and_then(Option::as_ref).map(PrometheusHandle::render).unwrap_or_default()
}
