//! Lee's two planners as their users meet them: a part that is taken out of another (Table 1), and a robot in corridors
//! (Table 2). The numbers in `channels/` were verified apart from this program.

#[path = "channels/corridors.rs"]
mod corridors;
#[path = "channels/kept.rs"]
mod kept;
#[path = "channels/parts.rs"]
mod parts;
#[path = "channels/refused.rs"]
mod refused;
#[path = "channels/rules_steer.rs"]
mod rules_steer;
#[path = "channels/support.rs"]
mod support;
