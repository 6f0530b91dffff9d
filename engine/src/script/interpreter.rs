//! The one place where a rhai engine is made, with every limit set.

use std::cell::Cell;
use std::collections::BTreeSet;
use std::sync::OnceLock;
use std::time::Instant;

use rhai::packages::{
    BasicArrayPackage, BasicMapPackage, BasicMathPackage, CorePackage, LogicPackage, MoreStringPackage,
    Package,
};
use rhai::{Dynamic, Engine, EvalAltResult, ImmutableString, OptimizationLevel};

use super::limits::{
    MAX_ARRAY, MAX_CALL_LEVELS, MAX_DEPTHS, MAX_FUNCTIONS, MAX_MAP, MAX_STEPS, MAX_TEXT, MAX_VARIABLES,
};
use super::{sizes, syntax};
use crate::zero::{negated, product, written};

thread_local! {
    static DEADLINE: Cell<Option<Instant>> = const { Cell::new(None) };
    static STEPS: Cell<u64> = const { Cell::new(0) };
}

pub(crate) fn start_run(deadline: Instant) {
    DEADLINE.set(Some(deadline));
    STEPS.set(0);
}

/// Every step looks here. rhai's own counter starts anew in each closure that a native function calls, so
/// the steps are counted on the thread.
fn on_step() -> Option<Dynamic> {
    let steps = STEPS.get() + 1;
    STEPS.set(steps);
    if steps > MAX_STEPS {
        return Some("more steps than a rule may take".into());
    }
    let late = steps.is_multiple_of(64) && DEADLINE.get().is_some_and(|deadline| Instant::now() > deadline);
    late.then(|| "longer than a rule may take".into())
}

pub(crate) fn reader() -> &'static Engine {
    static READER: OnceLock<Engine> = OnceLock::new();
    READER.get_or_init(|| {
        let mut engine = bare();
        // Each rule leaves a marker among the variables of the file.
        engine.set_max_variables(100_000);
        syntax::register(&mut engine);
        engine
    })
}

/// For running what cannot be compiled.
pub(crate) fn runner() -> &'static Engine {
    static RUNNER: OnceLock<Engine> = OnceLock::new();
    RUNNER.get_or_init(|| {
        let mut engine = bare();
        engine.set_max_variables(MAX_VARIABLES);
        engine
    })
}

fn functions() -> Vec<serde_json::Value> {
    let json = runner().gen_fn_metadata_to_json(true).unwrap_or_default();
    let mut listed: serde_json::Value = serde_json::from_str(&json).unwrap_or_default();
    serde_json::from_value(listed["functions"].take()).unwrap_or_default()
}

pub(crate) fn function_names() -> &'static BTreeSet<String> {
    static NAMES: OnceLock<BTreeSet<String>> = OnceLock::new();
    NAMES.get_or_init(|| {
        let functions = functions();
        let names = functions.iter().filter_map(|function| function["name"].as_str());
        // Keywords that read as functions.
        let keywords =
            ["type_of", "is_shared", "Fn", "call", "curry", "is_def_var", "is_def_fn", "print", "debug"];
        names.chain(keywords).map(str::to_owned).collect()
    })
}

/// The functions that change the plain value that they are called on; others read it, or give a new one.
pub(super) const CHANGING: [&str; 15] = [
    "+=",
    "append",
    "clear",
    "crop",
    "make_lower",
    "make_upper",
    "pad",
    "pop",
    "remove",
    "replace",
    "set",
    "set_tag",
    "take",
    "trim",
    "truncate",
];

pub(super) fn bare() -> Engine {
    let mut engine = Engine::new_raw();
    CorePackage::new().register_into_engine(&mut engine);
    LogicPackage::new().register_into_engine(&mut engine);
    BasicMathPackage::new().register_into_engine(&mut engine);
    BasicArrayPackage::new().register_into_engine(&mut engine);
    BasicMapPackage::new().register_into_engine(&mut engine);
    MoreStringPackage::new().register_into_engine(&mut engine);
    // Rules are compiled by this crate; the interpreter gets its parts as they are written.
    engine.set_optimization_level(OptimizationLevel::None);
    engine.set_max_operations(MAX_STEPS);
    engine.set_max_call_levels(MAX_CALL_LEVELS);
    engine.set_max_expr_depths(MAX_DEPTHS.0, MAX_DEPTHS.1);
    engine.set_max_string_size(MAX_TEXT);
    engine.set_max_array_size(MAX_ARRAY);
    engine.set_max_map_size(MAX_MAP);
    engine.set_max_functions(MAX_FUNCTIONS);
    engine.set_max_modules(0);
    engine.set_max_strings_interned(1024);
    engine.disable_symbol("eval");
    engine.disable_symbol("import");
    engine.disable_symbol("export");
    // `f = f.curry(f)` doubles what `f` holds, and nothing measures that. The parser calls it all the same, for closures
    // that look outside.
    engine.disable_symbol("curry");
    engine.on_print(|_| {});
    engine.on_debug(|_, _, _| {});
    engine.on_progress(|_| on_step());
    // Otherwise the built-in operators win over ours.
    engine.set_fast_operators(false);
    register_functions(&mut engine);
    sizes::register(&mut engine);
    engine
}

/// The interpreter's numbers are those of rules: `1 / 2` is a half, and 3.0 is written "3".
#[allow(clippy::float_cmp)]
fn register_functions(engine: &mut Engine) {
    type Refused = Result<(), Box<EvalAltResult>>;
    engine
        .register_fn("sleep", |_: i64| -> Refused { Err("a rule may not sleep".into()) })
        .register_fn("sleep", |_: f64| -> Refused { Err("a rule may not sleep".into()) })
        .register_fn("/", |a: i64, b: i64| a as f64 / b as f64)
        .register_fn("%", |a: i64, b: i64| a as f64 % b as f64)
        .register_fn("*", product)
        .register_fn("*", |a: i64, b: f64| product(a as f64, b))
        .register_fn("*", |a: f64, b: i64| product(a, b as f64))
        .register_fn("-", negated)
        .register_fn("**", |a: i64, b: i64| (a as f64).powf(b as f64))
        // rhai's own multiplies whole powers out, and differs in the last bit.
        .register_fn("**", |a: f64, b: i64| a.powf(b as f64))
        .register_fn("+", |text: ImmutableString, number: f64| format!("{text}{}", written(number)))
        .register_fn("+", |number: f64, text: ImmutableString| format!("{}{text}", written(number)))
        .register_fn("+=", |text: &mut ImmutableString, number: f64| *text += written(number))
        .register_fn("to_string", written)
        .register_fn("ceil", f64::ceil)
        .register_fn("ceil", |a: i64| a)
        .register_fn("floor", |a: i64| a)
        .register_fn("round", |a: i64| a)
        .register_fn("sqrt", |a: i64| (a as f64).sqrt());
    // rhai takes numbers that differ in the last bit for equal; rules compare exactly.
    macro_rules! compare {
        ($($operator:tt)*) => {$(
            engine
                .register_fn(stringify!($operator), |a: f64, b: f64| a $operator b)
                .register_fn(stringify!($operator), |a: i64, b: f64| (a as f64) $operator b)
                .register_fn(stringify!($operator), |a: f64, b: i64| a $operator (b as f64));
        )*};
    }
    compare!(< <= > >= == !=);
    macro_rules! two {
        ($name:literal, $function:expr) => {
            engine
                .register_fn($name, |a: f64, b: f64| -> f64 { $function(a, b) })
                .register_fn($name, |a: i64, b: f64| -> f64 { $function(a as f64, b) })
                .register_fn($name, |a: f64, b: i64| -> f64 { $function(a, b as f64) })
                .register_fn($name, |a: i64, b: i64| -> f64 { $function(a as f64, b as f64) });
        };
    }
    two!("min", f64::min);
    two!("max", f64::max);
    two!("hypot", f64::hypot);
    engine
        .register_fn("min", |a: f64, b: f64, c: f64| a.min(b).min(c))
        .register_fn("max", |a: f64, b: f64, c: f64| a.max(b).max(c))
        .register_fn("known", |value: Dynamic| !value.is_unit())
        .register_fn("unknown", |value: Dynamic| value.is_unit());
}

#[cfg(test)]
mod tests {
    use super::*;

    /// An update of rhai must not bring a function that nobody has looked at, nor one that is not documented.
    #[test]
    fn the_functions_are_those_that_are_documented() {
        let manual = include_str!(concat!(env!("CARGO_MANIFEST_DIR"), "/FUNCTIONS.md"));
        let (tables, properties) = manual.split_once("Properties, written with a point:").unwrap();
        let rows = tables.lines().filter(|line| line.starts_with("| `"));
        let names = |text: &str| -> BTreeSet<String> {
            let marked = text.split('`').skip(1).step_by(2);
            marked.map(str::to_owned).collect()
        };
        let functions = rows.flat_map(|row| names(row.rsplit_once(" | ").unwrap().0));
        let properties = names(properties).into_iter().map(|name| format!("get${name}"));
        let documented: BTreeSet<String> = functions.chain(properties).collect();
        let not_said: Vec<_> = function_names().difference(&documented).collect();
        let not_there: Vec<_> = documented.difference(function_names()).collect();
        assert!(
            not_said.is_empty() && not_there.is_empty(),
            "not said: {not_said:?}, not there: {not_there:?}"
        );
    }
    /// What looks as if it could change a plain value is known to change it, or to read it only.
    #[test]
    fn the_functions_that_change_values_are_those_that_are_listed() {
        const READING: [&str; 9] =
            ["+", "debug", "get$tag", "print", "split", "split_rev", "tag", "to_debug", "to_string"];
        let plain = [
            "&mut ImmutableString",
            "&mut string",
            "&mut char",
            "&mut Dynamic",
            "&mut f64",
            "&mut i64",
            "&mut bool",
        ];
        let functions = functions();
        let taking = functions.iter().filter(|function| {
            function["params"][0]["type"].as_str().is_some_and(|taken| plain.contains(&taken))
        });
        let taking: BTreeSet<&str> = taking.filter_map(|function| function["name"].as_str()).collect();
        let known: BTreeSet<&str> = CHANGING.into_iter().chain(READING).chain(["set$tag"]).collect();
        assert_eq!(taking, known);
    }
}
