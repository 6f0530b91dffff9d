//! Queries that people keep.

use adit_db::saved::SavedQuery;
use axum::Json;
use serde::{Deserialize, Serialize};
use utoipa::ToSchema;

use super::extract::Site;
use super::extract::{Body, Named};
use crate::error::Code;
use crate::serve::fault::{Answered, Fault};
use crate::serve::gate::require;
use crate::serve::role::{Caller, Role};

#[derive(Serialize, ToSchema)]
pub struct QueriesAnswer {
    queries: Vec<SavedQuery>,
}

/// The queries that are kept.
#[utoipa::path(get, path = "/api/queries", tag = "sql", responses((status = 200, body = QueriesAnswer)))]
pub async fn list(site: Site) -> Answered<Json<QueriesAnswer>> {
    site.read(|tx| Ok(QueriesAnswer { queries: tx.saved_queries()? })).await.map(Json)
}

#[derive(Debug, Deserialize, ToSchema)]
#[serde(deny_unknown_fields)]
pub struct QueryBody {
    query: String,
}

/// Keeps a query under a name, in place of one of the same name.
#[utoipa::path(put, path = "/api/queries/{name}", tag = "sql", request_body = QueryBody,
    params(("name" = String, Path, description = "Its name")), responses((status = 200, body = QueriesAnswer)))]
pub async fn save(
    site: Site,
    caller: Caller,
    Named(name): Named<String>,
    Body(QueryBody { query }): Body<QueryBody>,
) -> Answered<Json<QueriesAnswer>> {
    require(&caller, Role::Tune)?;
    let keep =
        site.edit_at_desk(move |desk| Ok(desk.live.keep_query(&name, Some((&query, &caller.name)))?));
    keep.await?;
    list(site).await
}

/// Takes a query away.
#[utoipa::path(delete, path = "/api/queries/{name}", tag = "sql",
    params(("name" = String, Path, description = "Its name")), responses((status = 200, body = QueriesAnswer)))]
pub async fn remove(site: Site, caller: Caller, Named(name): Named<String>) -> Answered<Json<QueriesAnswer>> {
    require(&caller, Role::Tune)?;
    let gone = site.edit_at_desk(move |desk| Ok(desk.live.keep_query(&name, None)?)).await?;
    if !gone {
        return Err(Fault::new(Code::SqlUnknownQuery, "no query of this name is kept"));
    }
    list(site).await
}
