//! A connection whose other side must read: who lets what is written to it lie is hung up on.

use std::io::{self, ErrorKind};
use std::pin::Pin;
use std::task::{Context, Poll};
use std::time::Duration;

use tokio::io::{AsyncRead, AsyncWrite, ReadBuf};
use tokio::net::TcpStream;
use tokio::time::{Sleep, sleep};

/// Bytes that must go out in the time that is waited for a reader.
const LEAST: usize = 16 << 10;

pub struct Patient {
    stream: TcpStream,
    /// How long it is waited for a reader.
    patience: Duration,
    /// Runs while something waits to be written.
    window: Option<Pin<Box<Sleep>>>,
    /// Bytes that went out meanwhile.
    written: usize,
}

impl Patient {
    pub fn new(stream: TcpStream, patience: Duration) -> Self {
        Self { stream, patience, window: None, written: 0 }
    }

    fn judged(
        &mut self,
        context: &mut Context<'_>,
        wanted: usize,
        wrote: Poll<io::Result<usize>>,
    ) -> Poll<io::Result<usize>> {
        match wrote {
            Poll::Ready(Ok(count)) if count == wanted => self.window = None,
            Poll::Ready(Ok(count)) => self.written += count,
            Poll::Ready(Err(_)) => {}
            Poll::Pending => {
                if self.window.is_none() {
                    self.written = 0;
                }
                let window = self.window.get_or_insert_with(|| Box::pin(sleep(self.patience)));
                while window.as_mut().poll(context).is_ready() {
                    if self.written < LEAST {
                        return Poll::Ready(Err(ErrorKind::TimedOut.into()));
                    }
                    self.written = 0;
                    window.set(sleep(self.patience));
                }
            }
        }
        wrote
    }
}

impl AsyncRead for Patient {
    fn poll_read(
        mut self: Pin<&mut Self>,
        context: &mut Context<'_>,
        buffer: &mut ReadBuf<'_>,
    ) -> Poll<io::Result<()>> {
        Pin::new(&mut self.stream).poll_read(context, buffer)
    }
}

impl AsyncWrite for Patient {
    fn poll_write(
        mut self: Pin<&mut Self>,
        context: &mut Context<'_>,
        bytes: &[u8],
    ) -> Poll<io::Result<usize>> {
        let wrote = Pin::new(&mut self.stream).poll_write(context, bytes);
        self.judged(context, bytes.len(), wrote)
    }

    fn poll_write_vectored(
        mut self: Pin<&mut Self>,
        context: &mut Context<'_>,
        parts: &[io::IoSlice<'_>],
    ) -> Poll<io::Result<usize>> {
        let wrote = Pin::new(&mut self.stream).poll_write_vectored(context, parts);
        self.judged(context, parts.iter().map(|part| part.len()).sum(), wrote)
    }

    fn is_write_vectored(&self) -> bool {
        self.stream.is_write_vectored()
    }

    fn poll_flush(mut self: Pin<&mut Self>, context: &mut Context<'_>) -> Poll<io::Result<()>> {
        Pin::new(&mut self.stream).poll_flush(context)
    }

    fn poll_shutdown(mut self: Pin<&mut Self>, context: &mut Context<'_>) -> Poll<io::Result<()>> {
        Pin::new(&mut self.stream).poll_shutdown(context)
    }
}
