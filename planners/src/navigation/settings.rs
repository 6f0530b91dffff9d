//! What a user may change about navigation.

use crate::figures::settings;

settings! {
    /// Figures of the navigator. The tolerances among them are facts, too: the judge compares with them.
    #[derive(Clone, Copy, Debug, PartialEq)]
    pub struct Settings {
        others {}
        figures {
            goal_tolerance_m: f64 = 0.08, "goal_tolerance", "m", Positive, "So near to a goal point counts as there.";
            turning_resolution: degrees = 2.0, "turning_resolution", "°", Positive, "The robot does not turn by less.";
            highway_half_width_m: f64 = 0.10, "highway_half_width", "m", Positive, "So far beside the line to its goal point the robot may be.";
            highway_clearance_m: f64 = 0.02, "highway_clearance", "m", Room, "What is kept free on either side of the robot while it goes straight.";
            look_ahead_m: f64 = 2.5, "look_ahead", "m", Positive, "Obstacles on the way count from so near on.";
            stride_m: f64 = 3.0, "stride", "m", Positive, "The robot goes no farther without a look around.";
            speed_m_s: f64 = 0.5, "speed", "m/s", Positive, "How fast the robot goes.";
            stride_to_room: f64 = 15.0, "stride_to_room", "", Positive, "On a site's route it goes no farther without a look around than so many times the room beside it.";
            scan_readings: usize = 120, "scan_readings", "", Count, "Readings of the sonar that make a whole scan.";
            look_s: f64 = 2.0, "look", "s", NotNegative, "A look around takes so long at the least, however fast the sensors are: things move meanwhile.";
            pace_s: f64 = 1.0, "pace", "s", NotNegative, "What is seen is taken into the model no more often, however fast the sensors are: what moves is told by that it has.";
            part_readings: usize = 40, "part_readings", "", Count, "Readings after which the model is updated on the way.";
            echoes: usize = 2, "echoes", "", Count, "So many raw echoes are in the way before what they hit is: one may be false.";
            falling_m: f64 = 0.05, "falling", "m", NotNegative, "The goal point is farther away than it was from so much on.";
            detour_clearance_m: f64 = 0.05, "detour_clearance", "m", Room, "What a detour keeps free on either side of the robot at the least.";
            detour_room_m: f64 = 0.10, "room", "m", Room, "What a detour keeps free where there is room.";
            room_worth: f64 = 1.3, "room_worth", "", Positive, "A way with room may be longer, or harder, than one without by this factor.";
            beside_m: f64 = 0.02, "beside", "m", Room, "A site is asked first for ways that leave so much more beside the robot than it needs.";
            corner_m: f64 = 0.05, "corner", "m", Room, "A surface that was seen to end may go on unseen, between two beams, for so much at the most.";
            squeeze_m: f64 = 0.025, "squeeze", "m", Room, "What is kept free on either side where there is no other way: a little more than on the highway.";
            most_squeezes: u32 = 4, "most_squeezes", "", Times, "So many times on a mission the robot squeezes through.";
            detour_reach_m: f64 = 2.0, "detour_reach", "m", Positive, "A detour leaves the rectangle about its ends by at most so much.";
            grain_m: f64 = 0.04, "grain", "m", Grain, "The grain of the search for detours.";
            back_off_m: f64 = 0.15, "back_off", "m", Positive, "How far the robot withdraws from what it touched.";
            change_room_m: f64 = 0.15, "change_room", "m", Room, "What is kept free on either side of the robot where it changes its shape, if there is such a place.";
            change_reach_m: f64 = 1.5, "change_reach", "m", NotNegative, "So far before or behind the place that a route says the robot changes its shape, to have room.";
            felt_s: f64 = 90.0, "felt", "s", NotNegative, "What was touched is in the way for so long.";
            least_confidence: u8 = 2, "least_confidence", "", Count, "Surfaces of less confidence close no way for good.";
            firm_confidence: u8 = 3, "firm_confidence", "", Count, "Surfaces of this confidence stand, even if they are part of what seems to move.";
            memory_m: f64 = 6.0, "memory", "m", Positive, "Surfaces farther away than this are remembered where the local model drops them.";
            same_spot_m: f64 = 0.5, "same_spot", "m", Positive, "Blocked within so far of where it was blocked before counts as the same spot.";
            most_waits: u32 = 4, "most_waits", "", Times, "Waits for a moving obstacle at one spot.";
            most_detours: u32 = 4, "most_detours", "", Times, "Detours from one spot before the way counts as closed.";
            most_closed: u32 = 2, "most_closed", "", Times, "Ways closed at one spot before a path is looked for off the network, through what is known to be free.";
            most_reports: u32 = 8, "most_reports", "", Times, "Ways that routes lead and that are reported closed at one spot before everything is looked at anew.";
            heed_s: f64 = 0.5, "heed", "s", Positive, "So often a robot on a site's route asks whether others changed what ways there are.";
            near_robot_m: f64 = 0.3, "near_robot", "m", NotNegative, "What is seen so near to where another robot says that its rim is, is that robot.";
            pause_s: f64 = 60.0, "pause", "s", NotNegative, "Of several robots who found no way waits so long before it sets out for elsewhere.";
            reported_s: f64 = 3600.0, "reported", "s", Positive, "What the robot tells a site of which rooms are cut holds so long.";
            most_retries: u32 = 2, "most_retries", "", Times, "Times that everything is looked at anew before there is no way.";
            give_way_m: f64 = 1.5, "give_way", "m", NotNegative, "Before it begins anew the robot goes back on its own track, up to so far, to give way.";
            no_way_after_s: f64 = 180.0, "no_way_after", "s", NotNegative, "There may be a way again for so long: things that move come to rest.";
            most_back_offs: u32 = 3, "most_back_offs", "", Times, "Times that the robot withdraws from touches before it looks around.";
            sure_m: f64 = 0.06, "sure", "m", Positive, "The position is sure while its standard deviation is no larger.";
            sure_heading: degrees = 5.0, "sure_heading", "°", Positive, "The heading is sure while its standard deviation is no larger.";
            most_unexplained: f64 = 0.75, "most_unexplained", "", Positive, "Where a larger share of a scan's beams ends before the known walls, the robot is elsewhere.";
            most_contradicted: u32 = 5, "most_contradicted", "", Times, "Where more beams side by side run through known walls, the robot is elsewhere.";
            most_searches: u32 = 6, "most_searches", "", Times, "So many times on a mission the robot looks for itself over the whole building before it is lost.";
            most_seeks: u32 = 3, "most_seeks", "", Times, "So many times on a mission it goes where known walls tell where it is.";
            off_facing: degrees = 1.0, "off_facing", "°", Positive, "A robot that is longer than wide turns back to its facing where it is off that by more.";
            patience_s: f64 = 3600.0, "patience", "s", Positive, "After so long a mission is given up.";
        }
    }
}
