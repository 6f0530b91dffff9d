//! What a user may change about navigation.

/// Figures of the navigator. The tolerances among them are facts, too: the judge compares with them.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Settings {
    /// So near to a goal point counts as there, metres.
    pub goal_tolerance_m: f64,
    /// The robot does not turn by less, radians.
    pub turning_resolution: f64,
    /// So far beside the line to its goal point the robot may be, metres.
    pub highway_half_width_m: f64,
    /// What is kept free on either side of the robot while it goes straight, metres.
    pub highway_clearance_m: f64,
    /// Obstacles on the way count from so near on, metres.
    pub look_ahead_m: f64,
    /// The robot goes no farther without a look around, metres.
    pub stride_m: f64,
    pub speed_m_s: f64,
    /// Readings of the sonar that make a whole scan.
    pub scan_readings: usize,
    /// Readings after which the model is updated on the way.
    pub part_readings: usize,
    /// What a detour keeps free on either side of the robot at the least, metres.
    pub detour_clearance_m: f64,
    /// What it keeps free where there is room, metres.
    pub detour_room_m: f64,
    /// A detour with room may be longer than one without by this factor.
    pub room_worth: f64,
    /// What is kept free on either side where there is no other way: a little more than on the highway, metres.
    pub squeeze_m: f64,
    /// So many times on a mission the robot squeezes through.
    pub most_squeezes: u32,
    /// A detour leaves the rectangle about its ends by at most so much, metres.
    pub detour_reach_m: f64,
    /// The grain of the search for detours, metres.
    pub grain_m: f64,
    /// How far the robot withdraws from what it touched, metres.
    pub back_off_m: f64,
    /// What was touched is in the way for so long, seconds.
    pub felt_s: f64,
    /// Surfaces of less confidence close no way for good.
    pub least_confidence: u8,
    /// Surfaces of this confidence stand, even if they are part of what seems to move.
    pub firm_confidence: u8,
    /// Surfaces farther away than this are out of the local model's sight: if it drops them, they are remembered, metres.
    pub memory_m: f64,
    /// Blocked within so far of where it was blocked before counts as the same spot, metres.
    pub same_spot_m: f64,
    /// Waits for a moving obstacle at one spot.
    pub most_waits: u32,
    /// Detours from one spot before the way counts as closed.
    pub most_detours: u32,
    /// Times that everything is looked at anew before there is no way.
    pub most_retries: u32,
    /// Before it begins anew the robot goes back on its own track, up to so far, to give way, metres.
    pub give_way_m: f64,
    /// There may be a way again for so long: things that move come to rest, seconds.
    pub no_way_after_s: f64,
    /// Times that the robot withdraws from touches before it looks around.
    pub most_back_offs: u32,
    /// After so long a mission is given up, seconds.
    pub patience_s: f64,
}

impl Default for Settings {
    fn default() -> Self {
        Self {
            goal_tolerance_m: 0.08,
            turning_resolution: 2.0_f64.to_radians(),
            highway_half_width_m: 0.10,
            highway_clearance_m: 0.02,
            look_ahead_m: 2.5,
            stride_m: 3.0,
            speed_m_s: 0.5,
            scan_readings: 120,
            part_readings: 40,
            detour_clearance_m: 0.05,
            detour_room_m: 0.10,
            room_worth: 1.3,
            squeeze_m: 0.025,
            most_squeezes: 4,
            detour_reach_m: 2.0,
            grain_m: 0.04,
            back_off_m: 0.15,
            felt_s: 90.0,
            least_confidence: 2,
            firm_confidence: 3,
            memory_m: 6.0,
            same_spot_m: 0.5,
            most_waits: 4,
            most_detours: 4,
            most_retries: 2,
            give_way_m: 1.5,
            no_way_after_s: 180.0,
            most_back_offs: 3,
            patience_s: 3600.0,
        }
    }
}
