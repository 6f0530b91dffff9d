//! Rule files: how they are read, and the interpreter behind them.

pub(crate) mod desugar;
pub(crate) mod failure;
pub(crate) mod interpreter;
pub(crate) mod limits;
pub(crate) mod names;
mod open;
pub(crate) mod over;
mod reaction;
pub(crate) mod reactor;
pub(crate) mod read;
pub(crate) mod resolve;
mod rewrite;
mod sizes;
pub(crate) mod source;
pub(crate) mod syntax;
pub(crate) mod wording;
