//! What is asked of the state table, and what it answers.

/// Names a segment for as long as the model lives; no number is used twice.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct SegmentId(pub u32);

/// Where a segment comes from. The model itself gives the first three; a state table may use other numbers.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Source(pub u8);

impl Source {
    /// Fitted to readings of the sonar.
    pub const SONAR: Self = Self(0);
    /// Felt by the skirt.
    pub const CONTACT: Self = Self(1);
    /// Recalled from a global model.
    pub const RECALLED: Self = Self(2);
}

/// What a scan showed about one segment.
#[derive(Clone, Copy, Debug, PartialEq)]
#[expect(clippy::struct_excessive_bools, reason = "each is a column of the state table")]
pub struct SegmentFacts {
    pub id: SegmentId,
    pub source: Source,
    /// 1 to 5 as the table gave it; 0 for a segment that is new and asked about for the first time.
    pub confidence: u8,
    /// Whether a segment of the scan lies on it.
    pub is_matched: bool,
    /// Whether enough beams crossed its place with nothing before it.
    pub is_visible: bool,
    /// Whether enough beams ran through it, and no fewer than ended on it.
    pub is_seen_free: bool,
    /// Whether it is part of something that moves.
    pub is_moving: bool,
    /// Beams that ended on it.
    pub beams_on: u32,
    /// Beams that ran through it.
    pub beams_through: u32,
    /// Metres of it through which beams ran side by side.
    pub free_m: f64,
    /// Scans since it was entered.
    pub age: u32,
    /// Scans since it was last matched, or since it was entered.
    pub unseen: u32,
    /// Metres from the robot to its nearest point.
    pub distance_m: f64,
    pub length_m: f64,
    /// Whether the model is to become a global one.
    pub is_learning: bool,
    /// How firm its place is: standard deviation across it, metres.
    pub sigma_m: f64,
}

/// What becomes of a segment.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[expect(clippy::struct_excessive_bools, reason = "each is a column of the state table")]
pub struct Transition {
    pub confidence: u8,
    pub source: Source,
    pub is_kept: bool,
    /// Whether the pose is corrected by it.
    pub counts_for_pose: bool,
    /// Whether it stays as it is: then scans neither move nor extend it.
    pub is_anchored: bool,
    /// Whether what was seen free of it is taken out of it.
    pub is_cut: bool,
}
