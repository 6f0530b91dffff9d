//! Rule files: how they are read, and the interpreter behind them.

pub(crate) mod interpreter;
pub(crate) mod names;
pub(crate) mod read;
mod resolve;
pub(crate) mod source;
pub(crate) mod syntax;
