//! A judge of routes: what the best way would cost, found by means of its own.
//!
//! Nothing here knows rooms, doors or layers. Free space is asked for in closed form (how near a segment comes to
//! the map's own rectangles, polygons and wall cells), the best way is Dijkstra's over a fine grid of (point, state)
//! with forty directions, then drawn taut by exact checks. Only the reading of maps is shared with the program.

pub mod body;
pub mod buildings;
pub mod distances;
pub mod driven;
pub mod grid;
pub mod judge;
pub mod pictured;
pub mod plan;
pub mod random;
pub mod silly;
pub mod site;
pub mod space;
pub mod tally;
pub mod taut;
pub mod walls;
pub mod way;
