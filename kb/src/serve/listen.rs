//! The way in from the network: connections with limits of their own, until the program is told to end.

use std::net::SocketAddr;
use std::pin::Pin;
use std::sync::Arc;
use std::time::Duration;

use hyper::service::service_fn;
use hyper_util::rt::{TokioIo, TokioTimer};
use hyper_util::server::graceful::GracefulShutdown;
use tokio::net::TcpListener;
use tower::ServiceExt;

use super::fault::{Failure, Fault};
use super::http::{self, pass::Peer};
use super::patient::Patient;
use super::share::Asker;
use super::shared::Shared;
use crate::error::{Code, Error, Result};

/// Rules run on these threads, too, in previews: their deepest nesting needs more than the usual stack.
const STACK: usize = 16 << 20;

/// Bytes that wait for a reader that is slow, in the program and in the kernel. What waits cannot be taken back: whoever
/// follows something and lags is to hear how things stand, not how they stood. An address may have 64 kB.
const UNREAD: usize = 96 << 10;
#[cfg(target_os = "linux")]
const UNSENT: u32 = 16 << 10;

/// How long a client may take over the head of a request, and keep an idle connection.
const HEAD: Duration = Duration::from_secs(30);

/// How long it is waited for a client that does not read its answer.
const READING: Duration = Duration::from_secs(30);

/// How long open requests may take to end when the service does.
const FAREWELL: Duration = Duration::from_secs(5);

/// Answers requests until the program is told to end (Ctrl-C, SIGTERM).
pub fn serve(shared: &Arc<Shared>, ready: impl FnOnce(SocketAddr)) -> Result<()> {
    let failed = |error: std::io::Error| Error::said(Code::ServeRuntime, error.to_string(), None);
    let mut runtime = tokio::runtime::Builder::new_multi_thread();
    // whoever takes all the processors answers long texts, too: there are threads left that read and answer others
    let cores = std::thread::available_parallelism().map_or(1, std::num::NonZero::get);
    let runtime =
        runtime.worker_threads(cores + 2).enable_all().thread_stack_size(STACK).build().map_err(failed)?;
    runtime.block_on(async {
        let listen = shared.settings.listen;
        let listener = TcpListener::bind(listen).await.map_err(|error| {
            let help = "another program may listen there: `--listen ADDRESS:PORT` names another port, and 0 any free one".to_owned();
            Error::said(Code::ServeAddress, format!("cannot listen on {listen}: {error}"), Some(help))
        })?;
        let mut end = std::pin::pin!(told_to_end());
        // signals are listened for once it is polled, which is to be before anybody knows of the service
        tokio::select! {
            biased;
            () = &mut end => return Ok(()),
            () = std::future::ready(()) => {}
        }
        ready(listener.local_addr().map_err(failed)?);
        accept(shared, &listener, end).await;
        Ok(())
    })
}

async fn accept(shared: &Arc<Shared>, listener: &TcpListener, mut end: Pin<&mut impl Future<Output = ()>>) {
    let router = http::router(Arc::clone(shared));
    let mut server = hyper::server::conn::http1::Builder::new();
    server.timer(TokioTimer::new()).header_read_timeout(HEAD).max_buf_size(UNREAD);
    let reading = READING.min(shared.settings.patience);
    let open = GracefulShutdown::new();
    loop {
        let (stream, from) = tokio::select! {
            // looked at first: who has been answered once is heard when it ends the service
            biased;
            () = &mut end => break,
            accepted = listener.accept() => if let Ok(accepted) = accepted {
                accepted
            } else {
                // too many open files, or a client that went away at once: the next one may fare better
                tokio::time::sleep(Duration::from_millis(50)).await;
                continue;
            },
        };
        let place = match shared.connections.hold(&Arc::new(Asker::at(from.ip())), 1) {
            Ok(place) => place,
            Err(spent) => {
                stream.try_write(refusal(spent.into()).as_bytes()).ok();
                continue;
            }
        };
        stream.set_nodelay(true).ok();
        #[cfg(target_os = "linux")]
        socket2::SockRef::from(&stream).set_tcp_notsent_lowat(UNSENT).ok();
        let router = router.clone();
        let service = service_fn(move |mut request: hyper::Request<_>| {
            request.extensions_mut().insert(Peer(from.ip()));
            router.clone().oneshot(request)
        });
        let connection =
            open.watch(server.serve_connection(TokioIo::new(Patient::new(stream, reading)), service));
        tokio::spawn(async move {
            // a client that breaks off is no failure of ours
            connection.await.ok();
            drop(place);
        });
    }
    shared.ending.send_replace(true);
    tokio::time::timeout(FAREWELL, open.shutdown()).await.ok();
}

/// What a connection is answered that nobody will listen to.
fn refusal(fault: Fault) -> String {
    let status = fault.code.http();
    let body = serde_json::to_string(&Failure { error: fault }).unwrap_or_default();
    let length = body.len();
    format!(
        "HTTP/1.1 {status}\r\nContent-Type: application/json\r\nContent-Length: {length}\r\nRetry-After: 1\r\n\
         Connection: close\r\n\r\n{body}"
    )
}

/// Waits for Ctrl-C, or SIGTERM.
async fn told_to_end() {
    let interrupt = async {
        if tokio::signal::ctrl_c().await.is_err() {
            std::future::pending::<()>().await;
        }
    };
    #[cfg(unix)]
    let terminate = async {
        match tokio::signal::unix::signal(tokio::signal::unix::SignalKind::terminate()) {
            Ok(mut signal) => {
                signal.recv().await;
            }
            Err(_) => std::future::pending().await,
        }
    };
    #[cfg(not(unix))]
    let terminate = std::future::pending::<()>();
    tokio::select! {
        () = interrupt => {}
        () = terminate => {}
    }
}
