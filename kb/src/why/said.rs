//! Words that several reasons share.

use crate::words::number::number;

/// `a`, `a and b`, `a, b and c`.
pub fn listed(parts: &[String]) -> String {
    match parts {
        [] => "nothing".to_owned(),
        [one] => one.clone(),
        [first @ .., last] => format!("{} and {last}", first.join(", ")),
    }
}

/// A number to three digits that say something, towards one side: so that what is said of it holds.
pub fn roughly(value: f64, round: fn(f64) -> f64) -> String {
    if value.abs() < f64::MIN_POSITIVE || !value.is_finite() {
        return number(value);
    }
    let digits = 2 - value.abs().log10().floor() as i32;
    let scale = 10f64.powi(digits);
    let text = format!("{:.*}", digits.max(0) as usize, round(value * scale) / scale);
    if text.contains('.') { text.trim_end_matches('0').trim_end_matches('.').to_owned() } else { text }
}

/// A cell as people call it: `the hardness of SQUAT (robots)`.
pub fn cell(table: &str, key: &str, column: &str, robot: &str) -> String {
    let key = key.strip_prefix(robot).and_then(|rest| rest.strip_prefix('/')).unwrap_or(key);
    format!("the {} of {key} ({table})", column.replace('_', " "))
}

/// With a capital letter, as a sentence begins.
pub fn capital(words: &str) -> String {
    let mut letters = words.chars();
    letters.next().map_or_else(String::new, |first| first.to_uppercase().chain(letters).collect())
}

#[cfg(test)]
mod tests {
    use super::roughly;

    #[test]
    fn three_digits_are_said_and_rounded_to_the_side_on_which_it_holds() {
        for (value, down, up) in
            [(5.2621, "5.26", "5.27"), (0.013_579, "0.0135", "0.0136"), (1234.5, "1230", "1240")]
        {
            assert_eq!(
                (roughly(value, f64::floor), roughly(value, f64::ceil)),
                (down.to_owned(), up.to_owned())
            );
        }
        assert_eq!(roughly(2.0, f64::floor), "2");
    }
}
