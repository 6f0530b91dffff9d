//! Questions in SQL, which can do nothing but read.

use std::time::Instant;

use adit_db::Cell;
use adit_db::query::{Answer, Limits};
use adit_db::relation::Named as Relation;
use axum::Json;
use axum::http::header;
use axum::response::{IntoResponse, Response};
use serde::{Deserialize, Serialize};
use utoipa::ToSchema;

use super::extract::Site;
use super::extract::{Asked, Body};
use crate::error::{Code, Error};
use crate::serve::fault::{Answered, Fault};
use crate::serve::gate::require;
use crate::serve::role::{Caller, Role};
use crate::words::cells::{object, text};

/// Rows of an answer on the page, unless more are asked for; a download has as many as the service allows.
const ROWS: usize = 1_000;

/// Bytes of one answer.
const BYTES: usize = 16 << 20;
#[derive(Debug, Deserialize, ToSchema)]
#[serde(deny_unknown_fields)]
pub struct SqlBody {
    /// One statement that reads.
    query: String,
    /// How many rows at most; 1,000 unless said.
    #[serde(default)]
    limit: Option<usize>,
}

#[derive(Serialize, ToSchema)]
pub struct SqlAnswer {
    columns: Vec<String>,
    /// A value for each column.
    #[schema(value_type = Vec<Vec<serde_json::Value>>)]
    rows: Vec<Vec<Cell>>,
    /// Whether there were more rows than are given.
    truncated: bool,
    /// Milliseconds that it took.
    took_ms: f64,
    generation: u64,
}

async fn answer(site: &Site, query: String, rows: usize) -> Answered<Answer> {
    let settings = &site.settings;
    let limits = Limits { deadline: settings.sql_deadline, rows: rows.min(settings.sql_rows), bytes: BYTES };
    site.query(move |store| store.query(&query, &limits).map_err(Error::of(Code::SqlRefused))).await
}

/// Answers one SQL statement that reads: see `/api/schema` for what there is.
#[utoipa::path(post, path = "/api/sql", tag = "sql", request_body = SqlBody,
    responses((status = 200, body = SqlAnswer)))]
pub async fn ask(site: Site, caller: Caller, Body(body): Body<SqlBody>) -> Answered<Json<SqlAnswer>> {
    require(&caller, Role::Query)?;
    let began = Instant::now();
    let generation = site.view.load().view.generation();
    let Answer { columns, rows, truncated } = answer(&site, body.query, body.limit.unwrap_or(ROWS)).await?;
    let took_ms = began.elapsed().as_secs_f64() * 1e3;
    Ok(Json(SqlAnswer { columns, rows, truncated, took_ms, generation }))
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Download {
    query: String,
    #[serde(default)]
    format: Format,
}

#[derive(Clone, Copy, Default, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Format {
    /// An object for each row.
    #[default]
    Json,
    /// RFC 4180.
    Csv,
}

/// The answer to one SQL statement as a file; the address is a link that can be shared.
#[utoipa::path(get, path = "/api/sql", tag = "sql",
    params(("query" = String, Query, description = "One statement that reads"), ("format" = Option<String>, Query, description = "json or csv")),
    responses((status = 200, body = String, content_type = "text/csv")))]
pub async fn download(site: Site, caller: Caller, Asked(asked): Asked<Download>) -> Answered<Response> {
    require(&caller, Role::Query)?;
    let answer = answer(&site, asked.query, usize::MAX).await?;
    let (kind, name, text) = match asked.format {
        Format::Json => ("application/json", "answer.json", json(&answer)),
        Format::Csv => ("text/csv; charset=utf-8", "answer.csv", csv(&answer)?),
    };
    let cut = if answer.truncated { "true" } else { "false" };
    let headers = [
        (header::CONTENT_TYPE, kind.to_owned()),
        (header::CONTENT_DISPOSITION, format!("attachment; filename=\"{name}\"")),
        (header::HeaderName::from_static("x-adit-truncated"), cut.to_owned()),
    ];
    Ok((headers, text).into_response())
}

fn json(answer: &Answer) -> String {
    let rows = answer.rows.iter().map(|row| object(&answer.columns, row));
    serde_json::Value::Array(rows.collect()).to_string()
}

fn csv(answer: &Answer) -> Answered<String> {
    let mut writer = csv::Writer::from_writer(Vec::new());
    let mut written = writer.write_record(&answer.columns);
    for row in &answer.rows {
        written = written.and_then(|()| writer.write_record(row.iter().map(text)));
    }
    written.map_err(|_| Fault::internal())?;
    let bytes = writer.into_inner().map_err(|_| Fault::internal())?;
    String::from_utf8(bytes).map_err(|_| Fault::internal())
}

#[derive(Serialize, ToSchema)]
pub struct SchemaAnswer {
    tables: Vec<Relation>,
}

/// The tables and views that can be asked about, with their columns.
#[utoipa::path(get, path = "/api/schema", tag = "sql", responses((status = 200, body = SchemaAnswer)))]
pub async fn schema(site: Site) -> Answered<Json<SchemaAnswer>> {
    site.read(|tx| Ok(SchemaAnswer { tables: tx.relations()? })).await.map(Json)
}
