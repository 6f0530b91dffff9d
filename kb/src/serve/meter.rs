//! What is counted and timed, for Prometheus.

use std::sync::{Arc, OnceLock};
use std::time::Instant;

use axum::extract::{MatchedPath, Request};
use axum::middleware::Next;
use axum::response::Response;
use prometheus::{HistogramOpts, HistogramVec, IntCounterVec, IntGauge, Opts, Registry, TextEncoder};

use super::shared::Shared;

/// Seconds at which a histogram is cut.
const BUCKETS: [f64; 11] = [1e-4, 2.5e-4, 5e-4, 1e-3, 2.5e-3, 5e-3, 1e-2, 5e-2, 0.1, 0.5, 2.0];

static METER: OnceLock<Option<Meter>> = OnceLock::new();

struct Meter {
    registry: Registry,
    requests: IntCounterVec,
    seconds: HistogramVec,
    generation: IntGauge,
    subscribers: IntGauge,
    rooms: IntGauge,
    doors: IntGauge,
    problems: IntGauge,
    hindrances: IntGauge,
}

impl Meter {
    fn new() -> prometheus::Result<Self> {
        let seconds = HistogramOpts::new("adit_request_seconds", "How long requests took, by route");
        let meter = Self {
            registry: Registry::new(),
            requests: IntCounterVec::new(
                Opts::new("adit_requests_total", "Requests answered, by route and kind of status"),
                &["route", "status"],
            )?,
            seconds: HistogramVec::new(seconds.buckets(BUCKETS.to_vec()), &["route"])?,
            generation: IntGauge::new("adit_generation", "The generation of the site that is served")?,
            subscribers: IntGauge::new("adit_subscribers", "Who hears of changes at present")?,
            rooms: IntGauge::new("adit_rooms", "Rooms of the site")?,
            doors: IntGauge::new("adit_doors", "Doors of the site")?,
            problems: IntGauge::new("adit_problems", "What is wrong, as `/api/site` says it")?,
            hindrances: IntGauge::new(
                "adit_not_ready",
                "What keeps edits from being saved, as `/api/ready` says it",
            )?,
        };
        meter.registry.register(Box::new(meter.requests.clone()))?;
        meter.registry.register(Box::new(meter.seconds.clone()))?;
        let Self { generation, subscribers, rooms, doors, problems, hindrances, .. } = &meter;
        for gauge in [generation, subscribers, rooms, doors, problems, hindrances] {
            meter.registry.register(Box::new(gauge.clone()))?;
        }
        Ok(meter)
    }
}

fn meter() -> Option<&'static Meter> {
    METER.get_or_init(|| Meter::new().ok()).as_ref()
}

/// Counts and times a request under the name of its route. One process counts once, however many services it runs.
pub async fn count(request: Request, next: Next) -> Response {
    let path = request.extensions().get::<MatchedPath>().cloned();
    let began = Instant::now();
    let response = next.run(request).await;
    let path: Arc<str> = path.map_or_else(|| "unknown".into(), |path| path.as_str().into());
    let status = format!("{}xx", response.status().as_u16() / 100);
    if let Some(meter) = meter() {
        meter.requests.with_label_values(&[&*path, &status]).inc();
        meter.seconds.with_label_values(&[&*path]).observe(began.elapsed().as_secs_f64());
    }
    response
}

/// All that was counted, in Prometheus' text.
pub fn text(shared: &Shared) -> String {
    let Some(meter) = meter() else { return String::new() };
    let seen = shared.view.load();
    meter.generation.set(seen.view.generation() as i64);
    meter.subscribers.set(shared.subscribed() as i64);
    meter.rooms.set(seen.view.graph().rooms.len() as i64);
    meter.doors.set(seen.view.graph().doors.len() as i64);
    meter.problems.set(shared.problems().len() as i64);
    meter.hindrances.set(shared.hindrances().len() as i64);
    TextEncoder::new().encode_to_string(&meter.registry.gather()).unwrap_or_default()
}
