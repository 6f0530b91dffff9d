//! What is accepted of a body, and of who drives it.

/// The version of the protocol.
pub const PROTOCOL: u32 = 1;

/// A line is at most so long, bytes, its end not counted.
pub const LINE_BYTES: usize = 1 << 20;

/// A body measures into at most so many directions.
pub const MOST_DIRECTIONS: u32 = 4096;

/// Nothing is heard from farther away, metres.
pub const FARTHEST_M: f64 = 1_000.0;

/// No radius is larger, metres.
pub const LARGEST_RADIUS_M: f64 = 100.0;

/// Odometry is within so much of where it began, metres.
pub const WORLD_M: f64 = 1_000_000.0;

/// No time is later, seconds.
pub const LATEST_S: f64 = 1e9;

/// A line as messages show it: its beginning.
pub fn shortened(line: &str) -> String {
    const CHARACTERS: usize = 120;
    let line = line.trim_end();
    match line.char_indices().nth(CHARACTERS) {
        Some((end, _)) => format!("`{}`... ({} bytes)", &line[..end], line.len()),
        None => format!("`{line}`"),
    }
}
