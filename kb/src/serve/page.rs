//! The page: its files, from the program itself.

use std::sync::LazyLock;

use axum::http::header;
use axum::response::{IntoResponse, Response};

use super::fault::Fault;
use crate::error::Code;
use crate::site::shipped::PAGE;

/// The page, which names all its modules: a browser would hear of each from another one, and ask for them one after the other.
static INDEX: LazyLock<Vec<u8>> = LazyLock::new(|| {
    let page = PAGE.iter().find(|(path, _)| *path == "index.html").map_or(&[][..], |(_, content)| content);
    let end = page.windows(7).position(|here| here == b"</head>").unwrap_or(page.len());
    let modules = PAGE.iter().map(|(path, _)| path).filter(|path| extension(path) == Some("js"));
    let links = modules.map(|path| format!("<link rel=\"modulepreload\" href=\"/assets/{path}\">\n"));
    [&page[..end], links.collect::<String>().as_bytes(), &page[end..]].concat()
});

pub async fn index() -> Response {
    sent("index.html", &INDEX)
}

/// A file of the page.
pub async fn asset(axum::extract::Path(name): axum::extract::Path<String>) -> Response {
    match PAGE.iter().find(|(path, _)| *path == name) {
        Some((_, content)) => sent(&name, content),
        None => Fault::new(Code::ServiceUnknown, "there is no such file").into_response(),
    }
}

fn extension(name: &str) -> Option<&str> {
    name.rsplit_once('.').map(|(_, extension)| extension)
}

fn sent(name: &str, content: &'static [u8]) -> Response {
    let kind = match extension(name) {
        Some("html") => "text/html; charset=utf-8",
        Some("css") => "text/css; charset=utf-8",
        Some("js") => "text/javascript; charset=utf-8",
        Some("svg") => "image/svg+xml",
        _ => "application/octet-stream",
    };
    // a page that stays open over an update asks anew
    let headers = [(header::CONTENT_TYPE, kind), (header::CACHE_CONTROL, "no-cache")];
    (headers, content).into_response()
}
