//! Why a simulation cannot begin.

/// A simulation that cannot begin. Walls, obstacles and corners are numbered from 1.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum SimulationError {
    /// A figure of the robot that is no use.
    #[error("the robot's {name} is {value}; expected a number that is not below what makes sense")]
    Setting { name: &'static str, value: f64 },
    /// A coordinate that is no number, or the start.
    #[error("{what} is at {x}, {y}; expected two finite numbers")]
    NotFinite { what: String, x: f64, y: f64 },
    #[error("obstacle {number} has {corners} corners; expected 3 or more")]
    Outline { number: usize, corners: usize },
    #[error("obstacle {number} moves at {speed_m_s} m/s; expected a speed of 0 or more")]
    Speed { number: usize, speed_m_s: f64 },
    #[error("there is no shape {shape}; the robot has {shapes}, numbered from 0")]
    NoShape { shape: usize, shapes: usize },
    #[error("the robot begins at {x}, {y}, {}", too_near(*gap_m, what, *radius_m))]
    Start {
        x: f64,
        y: f64,
        /// From the middle of a disc.
        gap_m: f64,
        what: String,
        /// Of a disc.
        radius_m: Option<f64>,
    },
}

fn too_near(gap_m: f64, what: &str, radius_m: Option<f64>) -> String {
    match radius_m {
        Some(radius_m) => format!("{gap_m:.3} m from {what}; its radius is {radius_m} m"),
        None => format!("where {what} would be within it"),
    }
}
