//! The interpreter of reactions: objects whose properties can be read and set, `tell`, `forget` and `lasting`.
//!
//! What a body does is written down while it runs, and done once it has run to its end.

use std::cell::RefCell;
use std::collections::BTreeMap;
use std::sync::OnceLock;

use rhai::{Dynamic, Engine, EvalAltResult, ImmutableString, Map};

use super::interpreter::bare;

/// An object that a clause binds, as a body sees it: the number of its variable.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Object(pub(crate) usize);

/// `lasting(value, seconds)`: a value that holds for so long.
#[derive(Clone, Debug)]
pub(crate) struct Lasting {
    pub(crate) value: Dynamic,
    pub(crate) seconds: f64,
}

#[derive(Clone, Debug)]
pub(crate) enum Write {
    /// `x.property = value`
    Value { variable: usize, property: String, value: Dynamic },
    /// `tell("CLASS", #{ ... })`
    Object { class: String, properties: Map },
    /// `forget(x)`
    Gone { variable: usize },
}

#[derive(Debug, Default)]
pub(crate) struct Run {
    /// For each variable the known properties that the body looks at.
    pub(crate) known: Vec<BTreeMap<String, Dynamic>>,
    pub(crate) writes: Vec<Write>,
}

thread_local! {
    static RUN: RefCell<Run> = RefCell::default();
}

/// Runs a body with these properties; gives what it asked for, as far as it came.
pub(crate) fn with_run<T>(known: Vec<BTreeMap<String, Dynamic>>, run: impl FnOnce() -> T) -> (T, Vec<Write>) {
    RUN.set(Run { known, writes: vec![] });
    let outcome = run();
    (outcome, RUN.take().writes)
}

pub(crate) fn reactor() -> &'static Engine {
    static REACTOR: OnceLock<Engine> = OnceLock::new();
    REACTOR.get_or_init(|| {
        let mut engine = bare();
        engine.set_max_variables(super::limits::MAX_VARIABLES);
        engine
            .register_type_with_name::<Object>("object")
            .register_indexer_get(|object: &mut Object, property: ImmutableString| read(*object, &property))
            .register_indexer_set(|object: &mut Object, property: ImmutableString, value: Dynamic| {
                let (variable, property) = (object.0, property.to_string());
                write(Write::Value { variable, property, value });
            })
            .register_fn("tell", |class: ImmutableString, properties: Map| {
                write(Write::Object { class: class.to_string(), properties });
            })
            .register_fn("forget", |object: Object| write(Write::Gone { variable: object.0 }))
            .register_type_with_name::<Lasting>("value with an end")
            .register_fn(
                "lasting",
                |value: Dynamic, seconds: Dynamic| -> Result<Lasting, Box<EvalAltResult>> {
                    let number = seconds.as_float().or_else(|_| seconds.as_int().map(|whole| whole as f64));
                    let wrong = |_| format!("a value lasts for a number of seconds, not `{seconds}`");
                    Ok(Lasting { value, seconds: number.map_err(wrong)? })
                },
            );
        engine
    })
}

/// What the body has set itself, else what is known; nothing where that is unknown.
fn read(object: Object, property: &str) -> Dynamic {
    RUN.with_borrow(|run| {
        let own = run.writes.iter().rev().find_map(|write| match write {
            Write::Value { variable, property: set, value } if *variable == object.0 && set == property => {
                Some(
                    value
                        .clone()
                        .try_cast::<Lasting>()
                        .map_or_else(|| value.clone(), |lasting| lasting.value),
                )
            }
            _ => None,
        });
        own.or_else(|| run.known.get(object.0)?.get(property).cloned()).unwrap_or(Dynamic::UNIT)
    })
}

fn write(write: Write) {
    RUN.with_borrow_mut(|run| run.writes.push(write));
}
