//! Ways through rooms of any convex outline: what is no rectangle costs what it has to.

mod arcs;
mod berth;
mod floors;
mod triangles;
mod turned;
