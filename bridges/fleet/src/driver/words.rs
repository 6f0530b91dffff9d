//! What vehicles report, in words.

use crate::wire::{Fault, Report};

/// An error in a sentence.
pub fn error(error: &Fault) -> String {
    let Fault { error_type, error_level, error_description, error_references } = error;
    let about: Vec<String> = error_references
        .iter()
        .map(|reference| format!("{} {}", reference.reference_key, reference.reference_value))
        .collect();
    let description =
        if error_description.is_empty() { String::new() } else { format!(": {error_description}") };
    let about = if about.is_empty() { String::new() } else { format!(" ({})", about.join(", ")) };
    format!("{error_type} [{error_level}]{description}{about}")
}

/// Why a vehicle does not take this update of its order, if it says so.
pub fn refusal(report: &Report, order: &str, update: u32) -> Option<String> {
    let refers = |fault: &Fault, key: &str, value: &str| {
        let found = fault.error_references.iter().find(|reference| reference.reference_key == key);
        found.map(|reference| reference.reference_value == value)
    };
    let update = update.to_string();
    let of_order = report.errors.iter().find(|fault| {
        refers(fault, "orderId", order) == Some(true)
            && refers(fault, "orderUpdateId", &update).unwrap_or(true)
            // an action that fails is no refusal
            && refers(fault, "actionStatus", "FAILED") != Some(true)
    });
    of_order.map(error)
}
