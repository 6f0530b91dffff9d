//! What a user may change about the local model.

/// Figures of the local model. Lengths are metres, angles radians, unless the name says otherwise.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Settings {
    /// How far the sonar hears.
    pub sonar_range_m: f64,
    /// Standard deviation of a reading, as a share of the range.
    pub range_noise: f64,
    /// What is added to the standard deviation of every reading, whatever its range.
    pub range_noise_m: f64,
    /// Standard deviation of the distance by the wheels' count, as a share of it.
    pub distance_noise: f64,
    /// Errors of the distance are alike over such a stretch: what a robot goes at one command, metres.
    pub distance_stretch_m: f64,
    /// Standard deviation of the heading by the wheels' count, radians after one metre; it grows with the root.
    pub heading_noise: f64,
    /// Heading that the wheels' count is thought to gain, radians a metre. Where it is not known, 0; then
    /// `heading_noise` has to cover it.
    pub heading_bias: f64,
    /// Neighbouring echoes farther apart are not joined to a segment.
    pub largest_gap_m: f64,
    /// Echoes off a straight line by more than so many standard deviations end a segment.
    pub split_sigmas: f64,
    /// Echoes off a straight line by less never end a segment.
    pub split_m: f64,
    /// A segment has at least so many echoes.
    pub fewest_echoes: usize,
    /// A segment is at least so long.
    pub shortest_m: f64,
    /// Ends that are no farther apart are joined to a sequence.
    pub join_m: f64,
    /// Angle up to which a segment of a scan may lie on one that scans move, whatever the standard deviations.
    pub match_angle: f64,
    /// Distance up to which a segment of a scan may lie on one that scans move, whatever the standard deviations.
    pub match_offset_m: f64,
    /// With a larger standard deviation of the position no segment of a scan is taken for one that stays where it is: which
    /// one it is cannot be told segment by segment, metres.
    pub match_sigma_m: f64,
    /// The same of the heading.
    pub match_sigma_heading: f64,
    /// Corrections of the position that are larger must not explain fewer beams than are explained without them, metres.
    pub certain_step_m: f64,
    /// Share of the shorter one that has to lie beside the other.
    pub match_overlap: f64,
    /// Differences beyond so many standard deviations are no match, and correct nothing.
    pub match_sigmas: f64,
    /// Beams that cross the place of a segment before it counts as visible.
    pub visible_beams: u32,
    /// Beams side by side that run through a segment before that part of it counts as free.
    pub free_beams: u32,
    /// Beams that meet a segment at a smaller angle say nothing about whether it is still there.
    pub grazing_angle: f64,
    /// Segments of which scans show nothing are asked about once in so many scans: what is hidden, out of hearing or crossed by
    /// fewer beams than make it visible changes by its distance and its age alone.
    pub hidden_scans: u32,
    /// Standard deviation across a segment of the global model.
    pub recalled_sigma_m: f64,
    /// Standard deviation of the angle of a segment of the global model.
    pub recalled_sigma_angle: f64,
    /// Standard deviation across a segment that the robot has found, as seen from where it has found it, at most.
    pub own_sigma_m: f64,
    /// The same of its angle.
    pub own_sigma_angle: f64,
    /// The place of the robot is never thought to be surer than this standard deviation: errors of the model do not
    /// average out however often it is seen.
    pub least_sigma_m: f64,
    /// The same for the heading.
    pub least_sigma_heading: f64,
    /// Segments of the global model are recalled up to this distance.
    pub recall_m: f64,
    /// A new reading corrects the pose only where its beam meets the model at so large an angle at least.
    pub critical_angle: f64,
    /// A new reading corrects the pose only so far from the ends of the segment that it meets.
    pub critical_margin_m: f64,
    /// Length of a segment that is entered for a contact.
    pub contact_length_m: f64,
    /// Echoes that belong together and cover at most this much may be a moving object.
    pub object_size_m: f64,
    /// No object is thought to be faster, metres a second.
    pub object_speed_m_s: f64,
    /// What has moved less counts as standing.
    pub object_step_m: f64,
    /// Scans without sight of an object until it is forgotten.
    pub object_patience: u32,
    /// Whether the model is to become a global one; the state table is told.
    pub is_learning: bool,
    /// Whether there are walls to go by besides what the robot finds itself; so it is from the first one on that is recalled.
    pub knows_walls: bool,
}

impl Default for Settings {
    fn default() -> Self {
        Self {
            sonar_range_m: 8.0,
            range_noise: 0.01,
            range_noise_m: 0.005,
            distance_noise: 0.02,
            distance_stretch_m: 3.0,
            heading_noise: 1.0_f64.to_radians(),
            heading_bias: 0.0,
            largest_gap_m: 0.6,
            split_sigmas: 3.0,
            split_m: 0.03,
            fewest_echoes: 4,
            shortest_m: 0.15,
            join_m: 0.2,
            match_angle: 12.0_f64.to_radians(),
            match_offset_m: 0.3,
            match_sigma_m: 1.0,
            match_sigma_heading: 20.0_f64.to_radians(),
            certain_step_m: 0.1,
            match_overlap: 0.5,
            match_sigmas: 4.0,
            visible_beams: 2,
            free_beams: 2,
            grazing_angle: 15.0_f64.to_radians(),
            hidden_scans: 8,
            recalled_sigma_m: 0.01,
            recalled_sigma_angle: 0.2_f64.to_radians(),
            own_sigma_m: 0.05,
            own_sigma_angle: 2.0_f64.to_radians(),
            least_sigma_m: 0.005,
            least_sigma_heading: 0.1_f64.to_radians(),
            recall_m: 12.0,
            critical_angle: 30.0_f64.to_radians(),
            critical_margin_m: 0.3,
            contact_length_m: 0.2,
            object_size_m: 1.5,
            object_speed_m_s: 1.0,
            object_step_m: 0.25,
            object_patience: 3,
            is_learning: false,
            knows_walls: false,
        }
    }
}
