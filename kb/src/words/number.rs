//! Numbers as people read them.

use adit_db::Cell;

/// At most three decimals, none that say nothing; an exponent where there would be more than 15 digits.
pub fn number(value: f64) -> String {
    if value.is_finite() && value.abs() >= Cell::LONG {
        return format!("{value:e}");
    }
    let text = format!("{value:.3}");
    let text = text.trim_end_matches('0').trim_end_matches('.');
    if text == "-0" { "0".to_owned() } else { text.to_owned() }
}

/// So many of something, whose word takes an `s` where there is not one of it: `1 door`, `0 doors`.
pub fn counted(count: usize, what: &str) -> String {
    format!("{count} {what}{}", if count == 1 { "" } else { "s" })
}

#[cfg(test)]
mod tests {
    use super::number;

    #[test]
    fn a_number_is_as_short_as_what_it_says() {
        for (value, text) in
            [(0.25, "0.25"), (-0.0001, "0"), (12.0, "12"), (0.199_999_999_9, "0.2"), (1e300, "1e300")]
        {
            assert_eq!(number(value), text);
        }
    }
}
