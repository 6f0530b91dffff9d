//! The way in from the network: connections with limits of their own, until the program is told to end.

use std::net::SocketAddr;
use std::sync::Arc;
use std::time::Duration;

use hyper::service::service_fn;
use hyper_util::rt::{TokioIo, TokioTimer};
use hyper_util::server::graceful::GracefulShutdown;
use tokio::net::TcpListener;
use tokio::sync::Semaphore;
use tower::ServiceExt;

use super::http;
use super::shared::Shared;
use crate::error::{Code, Error, Result};

/// Rules run on these threads, too, in previews: their deepest nesting needs more than the usual stack.
const STACK: usize = 16 << 20;

/// Connections that are open at once; more wait to be accepted.
const CONNECTIONS: usize = 4_096;

/// Bytes that wait for a reader that is slow, in the program and in the kernel. What waits cannot be taken back: whoever
/// follows something and lags is to hear how things stand, not how they stood. An address may have 64 kB.
const UNREAD: usize = 96 << 10;
#[cfg(target_os = "linux")]
const UNSENT: u32 = 16 << 10;

/// How long a client may take over the head of a request, and keep an idle connection.
const HEAD: Duration = Duration::from_secs(30);

/// How long open requests may take to end when the service does.
const FAREWELL: Duration = Duration::from_secs(5);

/// Answers requests until the program is told to end (Ctrl-C, SIGTERM).
pub fn serve(shared: &Arc<Shared>, ready: impl FnOnce(SocketAddr)) -> Result<()> {
    let failed = |error: std::io::Error| Error::said(Code::ServeRuntime, error.to_string(), None);
    let mut runtime = tokio::runtime::Builder::new_multi_thread();
    let runtime = runtime.enable_all().thread_stack_size(STACK).build().map_err(failed)?;
    runtime.block_on(async {
        let listen = shared.settings.listen;
        let listener = TcpListener::bind(listen).await.map_err(|error| {
            let help = "`--listen 127.0.0.1:0` takes any free port".to_owned();
            Error::said(Code::ServeAddress, format!("cannot listen on {listen}: {error}"), Some(help))
        })?;
        ready(listener.local_addr().map_err(failed)?);
        accept(shared, &listener).await;
        Ok(())
    })
}

async fn accept(shared: &Arc<Shared>, listener: &TcpListener) {
    let router = http::router(Arc::clone(shared));
    let mut server = hyper::server::conn::http1::Builder::new();
    server.timer(TokioTimer::new()).header_read_timeout(HEAD).max_buf_size(UNREAD);
    let open = GracefulShutdown::new();
    let places = Arc::new(Semaphore::new(CONNECTIONS));
    let mut end = std::pin::pin!(told_to_end());
    loop {
        let Ok(place) = Arc::clone(&places).acquire_owned().await else { break };
        let stream = tokio::select! {
            accepted = listener.accept() => if let Ok((stream, _)) = accepted {
                stream
            } else {
                // too many open files, or a client that went away at once: the next one may fare better
                tokio::time::sleep(Duration::from_millis(50)).await;
                continue;
            },
            () = &mut end => break,
        };
        stream.set_nodelay(true).ok();
        #[cfg(target_os = "linux")]
        socket2::SockRef::from(&stream).set_tcp_notsent_lowat(UNSENT).ok();
        let router = router.clone();
        let service = service_fn(move |request| router.clone().oneshot(request));
        let connection = open.watch(server.serve_connection(TokioIo::new(stream), service));
        tokio::spawn(async move {
            // a client that breaks off is no failure of ours
            connection.await.ok();
            drop(place);
        });
    }
    shared.ending.send_replace(true);
    tokio::time::timeout(FAREWELL, open.shutdown()).await.ok();
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
