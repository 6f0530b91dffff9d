//! Paths through channels: a rectangular free space where channels meet at right angles in junctions, and rules say how to
//! pass each junction (Lee, *Rule-Based Path Planning for Assembly Task*).

pub mod corridor;
