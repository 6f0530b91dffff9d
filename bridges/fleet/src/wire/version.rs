//! The versions of VDA 5050 that are spoken.

/// As a vehicle says it in the head of each of its messages.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Version {
    V2_0,
    V2_1,
    V3_0,
}

impl Version {
    /// All that are spoken.
    pub const ALL: [Self; 3] = [Self::V2_0, Self::V2_1, Self::V3_0];

    /// Reads `2.0`, `2.1.0`, `v3`; `None` for one that is not spoken. Of a later minor version the newest known is spoken.
    pub fn read(text: &str) -> Option<Self> {
        let mut parts = text.trim().trim_start_matches(['v', 'V']).split('.');
        let major: u32 = parts.next()?.parse().ok()?;
        let minor: u32 = parts.next().map_or(Some(0), |minor| minor.parse().ok())?;
        match (major, minor) {
            (2, 0) => Some(Self::V2_0),
            (2, _) => Some(Self::V2_1),
            (3, _) => Some(Self::V3_0),
            _ => None,
        }
    }

    /// As it stands in messages.
    pub fn full(self) -> &'static str {
        match self {
            Self::V2_0 => "2.0.0",
            Self::V2_1 => "2.1.0",
            Self::V3_0 => "3.0.0",
        }
    }

    /// As it stands in topics.
    pub fn of_topic(self) -> &'static str {
        match self {
            Self::V2_0 | Self::V2_1 => "v2",
            Self::V3_0 => "v3",
        }
    }
}

impl std::fmt::Display for Version {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(self.full().strip_suffix(".0").unwrap_or_default())
    }
}
