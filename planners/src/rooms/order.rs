//! Which of two areas is the larger.

/// Mantissa bits that are left out: areas that differ by less than about 1e-12 of their size differ by rounding.
const ROUNDING_BITS: u32 = 12;

/// A key that orders areas by size; areas equal but for rounding get the same key. Square metres, not negative.
pub(crate) fn area_key(area: f64) -> u64 {
    (area.to_bits() + (1 << (ROUNDING_BITS - 1))) >> ROUNDING_BITS
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rounding_makes_no_area_larger() {
        assert_eq!(area_key((0.3 - 0.1) * 5.0), area_key(0.2 * 5.0));
        assert!(area_key(1.0) < area_key(1.000_001));
        assert!(area_key(0.0) < area_key(1e-9));
    }
}
