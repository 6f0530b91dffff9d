//! A long answer on its way out, some of it at a time: what is left of it is counted, and between two portions others have
//! their turn.

use std::pin::Pin;
use std::task::{Context, Poll, ready};

use axum::Error;
use axum::body::{Body, Bytes, HttpBody};
use hyper::body::{Frame, SizeHint};

use crate::serve::share::Held;
use crate::serve::shared::SHORT;

/// A body whose bytes are copied out portion by portion, so that the whole is given back when the last one is out.
pub struct Portions {
    body: Body,
    rest: Bytes,
    has_yielded: bool,
    _held: Held,
}

impl Portions {
    pub fn new(body: Body, held: Held) -> Self {
        Self { body, rest: Bytes::new(), has_yielded: true, _held: held }
    }
}

impl HttpBody for Portions {
    type Data = Bytes;
    type Error = Error;

    fn poll_frame(
        mut self: Pin<&mut Self>,
        context: &mut Context<'_>,
    ) -> Poll<Option<Result<Frame<Bytes>, Error>>> {
        if self.rest.is_empty() {
            match ready!(Pin::new(&mut self.body).poll_frame(context)) {
                Some(Ok(frame)) => match frame.into_data() {
                    Ok(bytes) => self.rest = bytes,
                    Err(frame) => return Poll::Ready(Some(Ok(frame))),
                },
                other => return Poll::Ready(other),
            }
        }
        if !self.has_yielded {
            self.has_yielded = true;
            context.waker().wake_by_ref();
            return Poll::Pending;
        }
        self.has_yielded = false;
        let count = self.rest.len().min(SHORT);
        let portion = Bytes::copy_from_slice(&self.rest.split_to(count));
        Poll::Ready(Some(Ok(Frame::data(portion))))
    }

    fn is_end_stream(&self) -> bool {
        self.rest.is_empty() && self.body.is_end_stream()
    }

    fn size_hint(&self) -> SizeHint {
        let rest = self.rest.len() as u64;
        match self.body.size_hint().exact() {
            Some(size) => SizeHint::with_exact(size + rest),
            None => SizeHint::default(),
        }
    }
}
