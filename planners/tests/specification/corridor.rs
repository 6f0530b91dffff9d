//! Robots in corridors: Lee's section 5 with Table 2, and what is promised of any network of corridors.
#![allow(clippy::float_cmp)] // helpers of tests; numbers that are copied are equal or wrong

mod bounds;
mod junctions;
mod networks;
mod paths;
mod routes;
mod sampled;
mod table2;
mod turning;
mod verified;
