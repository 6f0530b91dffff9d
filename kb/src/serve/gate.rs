//! Who may come in: the host that was called, the page that calls, the token, and what it allows.

use axum::extract::Request;
use axum::http::{HeaderMap, header};

use super::fault::{Answered, Fault};
use super::role::{Caller, Role};
use super::shared::Shared;
use crate::error::Code;

/// Under which name a caller edits where no token is needed; percent-encoded.
const WHO: &str = "x-adit-who";
const NAME_LENGTH: usize = 100;

/// Names of the machine itself.
const HERE: [&str; 3] = ["localhost", "127.0.0.1", "[::1]"];

/// What proxies say of whom they ask for.
const PROXIED: [&str; 3] = ["forwarded", "via", "x-forwarded-for"];

/// What is answered to everybody: whether the service lives, and whether it can save.
const OPEN: [&str; 2] = ["/api/health", "/api/ready"];

/// Who asks, where the request may come in.
pub fn look(shared: &Shared, request: &Request) -> Answered<Caller> {
    let headers = request.headers();
    check_host(shared, headers)?;
    check_origin(headers)?;
    let path = request.uri().path();
    // the page itself holds nothing: it asks for a token once it is there; who watches the service has none
    let is_open = OPEN.contains(&path) || !(path.starts_with("/api/") || path == "/metrics");
    match caller(shared, headers) {
        Err(_) if is_open => Ok(nobody()),
        caller => caller,
    }
}

/// A page elsewhere whose name was made to point here (DNS rebinding) calls by that name.
fn check_host(shared: &Shared, headers: &HeaderMap) -> Answered<()> {
    let name = called(headers);
    let listen = shared.settings.listen.ip();
    let is_ours = HERE.contains(&name)
        || name.trim_matches(['[', ']']) == listen.to_string()
        || shared.settings.hosts.iter().any(|known| known.eq_ignore_ascii_case(name));
    if is_ours {
        return Ok(());
    }
    let fault = Fault::new(
        Code::AuthHost,
        format!("this service is not called `{}`", name.chars().take(NAME_LENGTH).collect::<String>()),
    );
    Err(fault.helped("start it with `--host NAME` to let it be called so"))
}

/// Whether the service is called as one does on its own machine. A proxy there passes on by what name it was called, or for whom
/// it asks.
pub fn is_called_on_the_spot(headers: &HeaderMap) -> bool {
    let is_passed_on = PROXIED.iter().any(|name| headers.contains_key(*name));
    !is_passed_on && HERE.contains(&called(headers))
}

/// The name by which the service is called, of `name:port`.
fn called(headers: &HeaderMap) -> &str {
    let host = headers.get(header::HOST).and_then(|host| host.to_str().ok()).unwrap_or_default();
    match host.rsplit_once(':') {
        Some((name, port)) if port.bytes().all(|byte| byte.is_ascii_digit()) => name,
        _ => host,
    }
}

/// Browsers say which page calls; only our own may.
fn check_origin(headers: &HeaderMap) -> Answered<()> {
    let Some(origin) = headers.get(header::ORIGIN) else { return Ok(()) };
    let host = headers.get(header::HOST).and_then(|host| host.to_str().ok()).unwrap_or_default();
    let origin = origin.to_str().unwrap_or_default();
    let called_by = origin.strip_prefix("http://").or_else(|| origin.strip_prefix("https://"));
    if called_by == Some(host) {
        return Ok(());
    }
    Err(Fault::new(Code::AuthOrigin, "a page from elsewhere may not call this service"))
}

/// Who asks, by the token that is sent.
pub fn caller(shared: &Shared, headers: &HeaderMap) -> Answered<Caller> {
    let tokens = shared.tokens.borrow();
    let given = headers.get(header::AUTHORIZATION).map(|value| value.to_str().unwrap_or_default());
    let token = given.map(|value| value.strip_prefix("Bearer ").unwrap_or_default());
    match (token, tokens.as_ref()) {
        // who sends a token wants to be known: nobody is taken for somebody else
        (Some(token), tokens) => tokens
            .and_then(|tokens| tokens.holder(token.trim()))
            .ok_or_else(|| Fault::new(Code::AuthTokenUnknown, "nobody holds this token")),
        (None, Some(_)) => Err(Fault::new(Code::AuthTokenMissing, "this site asks for a token")
            .helped("send it as `Authorization: Bearer TOKEN`; `adit token SITE add NAME` makes one")),
        (None, None) => Ok(Caller { name: said(headers), roles: vec![Role::Admin] }),
    }
}

fn nobody() -> Caller {
    Caller { name: String::new(), roles: Vec::new() }
}

/// The name that a caller gives, where nobody checks it.
fn said(headers: &HeaderMap) -> String {
    let text = headers.get(WHO).and_then(|value| value.to_str().ok()).unwrap_or_default();
    let text = percent_encoding::percent_decode_str(text).decode_utf8_lossy();
    let name: String = text.chars().filter(|c| !c.is_control()).take(NAME_LENGTH).collect();
    if name.trim().is_empty() { "http".to_owned() } else { name.trim().to_owned() }
}

/// Refuses a caller who may not do this.
pub fn require(caller: &Caller, role: Role) -> Answered<()> {
    if caller.may(role) {
        return Ok(());
    }
    let role = format!("{role:?}").to_lowercase();
    let message = format!("`{}` may not do this: it needs the role `{role}`", caller.name);
    Err(Fault::new(Code::AuthRole, message))
}
