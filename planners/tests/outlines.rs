//! Ways through rooms of any convex outline: what is no rectangle costs what it has to.
#![allow(clippy::unwrap_used, reason = "a test stops at the first surprise")]

mod outlines {
    mod arcs;
    mod berth;
    mod floors;
    mod triangles;
    mod turned;
}
