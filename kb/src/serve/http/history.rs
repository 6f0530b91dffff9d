//! Who changed what, when, and why.

use axum::Json;
use serde::{Deserialize, Serialize};
use utoipa::ToSchema;

use super::extract::Asked;
use super::extract::Site;
use crate::serve::fault::Answered;

/// Entries that one answer gives at most.
const MOST: u32 = 1_000;

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Part {
    limit: Option<u32>,
    before: Option<i64>,
}

#[derive(Serialize, ToSchema)]
pub struct HistoryAnswer {
    generation: u64,
    edits: Vec<adit_db::history::Edit>,
}

/// Who changed what, when, and why; the newest first.
#[utoipa::path(get, path = "/api/history", tag = "tables",
    params(("limit" = Option<u32>, Query, description = "How many, 50 unless said, at most 1,000"),
           ("before" = Option<i64>, Query, description = "Only entries with a smaller number")),
    responses((status = 200, body = HistoryAnswer)))]
pub async fn history(site: Site, Asked(part): Asked<Part>) -> Answered<Json<HistoryAnswer>> {
    let (limit, before) = (part.limit.unwrap_or(50).min(MOST), part.before);
    let answer = site.read(move |tx| {
        Ok(HistoryAnswer {
            generation: crate::knowledge::generation::read(tx)?,
            edits: tx.history_before(before, limit)?,
        })
    });
    answer.await.map(Json)
}
