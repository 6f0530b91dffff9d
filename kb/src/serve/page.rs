//! The page: its files, from the program itself.

use axum::http::header;
use axum::response::{IntoResponse, Response};

use super::fault::Fault;
use crate::error::Code;
use crate::site::shipped::PAGE;

pub async fn index() -> Response {
    file("index.html")
}

/// A file of the page.
pub async fn asset(axum::extract::Path(name): axum::extract::Path<String>) -> Response {
    file(&name)
}

fn file(name: &str) -> Response {
    let Some((_, content)) = PAGE.iter().find(|(path, _)| *path == name) else {
        return Fault::new(Code::ServiceUnknown, "there is no such file").into_response();
    };
    let kind = match name.rsplit_once('.').map(|(_, extension)| extension) {
        Some("html") => "text/html; charset=utf-8",
        Some("css") => "text/css; charset=utf-8",
        Some("js") => "text/javascript; charset=utf-8",
        Some("svg") => "image/svg+xml",
        _ => "application/octet-stream",
    };
    // a page that stays open over an update asks anew
    let headers = [(header::CONTENT_TYPE, kind), (header::CACHE_CONTROL, "no-cache")];
    (headers, *content).into_response()
}
