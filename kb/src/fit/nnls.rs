//! Least squares without negative numbers: the active-set method of Lawson and Hanson (1974), chapter 23.

use nalgebra::{DMatrix, DVector};

/// The x of least |a x - b| with no negative element. The columns of `a` must be independent.
pub fn nnls(a: &DMatrix<f64>, b: &DVector<f64>) -> DVector<f64> {
    let columns = a.ncols();
    let mut x = DVector::zeros(columns);
    let mut free = vec![false; columns];
    let scale = a.column_iter().map(|column| column.norm()).fold(0.0, f64::max) * b.norm();
    // each round frees a column and the error gets less, so a set of free columns never comes back
    for _ in 0..3 * columns + 10 {
        let slope = a.transpose() * (b - a * &x);
        let next = (0..columns).filter(|&column| !free[column] && slope[column] > 1e-12 * scale);
        let Some(next) = next.max_by(|&one, &two| slope[one].total_cmp(&slope[two])) else { break };
        free[next] = true;
        loop {
            let wanted = solved(a, b, &free);
            let below = |column: &usize| free[*column] && wanted[*column] <= 0.0;
            let negative: Vec<usize> = (0..columns).filter(below).collect();
            if negative.is_empty() {
                x = wanted;
                break;
            }
            // as far towards it as nothing gets negative
            let step =
                negative.iter().map(|&column| x[column] / (x[column] - wanted[column])).fold(1.0, f64::min);
            x += (wanted - &x) * step.max(0.0);
            for column in negative {
                if x[column] <= 1e-14 * x.amax().max(f64::MIN_POSITIVE) {
                    (x[column], free[column]) = (0.0, false);
                }
            }
            if !free.contains(&true) {
                break;
            }
        }
    }
    x
}

/// Least squares in the free columns; 0 in the others.
fn solved(a: &DMatrix<f64>, b: &DVector<f64>, free: &[bool]) -> DVector<f64> {
    let columns: Vec<usize> = (0..a.ncols()).filter(|&column| free[column]).collect();
    let part = a.select_columns(&columns);
    let mut x = DVector::zeros(a.ncols());
    let qr = part.qr();
    if let Some(found) = qr.r().solve_upper_triangular(&(qr.q().transpose() * b)) {
        for (value, column) in found.iter().zip(columns) {
            x[column] = *value;
        }
    }
    x
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        /// The conditions of Kuhn and Tucker: nothing that may grow would lessen the error by growing.
        #[test]
        fn no_element_is_negative_and_none_would_better_be_another(
            numbers in prop::collection::vec(-3.0..3.0_f64, 24), b in prop::collection::vec(-3.0..3.0_f64, 8)
        ) {
            let (a, b) = (DMatrix::from_vec(8, 3, numbers), DVector::from_vec(b));
            let x = nnls(&a, &b);
            let slope = a.transpose() * (&b - &a * &x);
            for column in 0..3 {
                prop_assert!(x[column] >= 0.0);
                prop_assert!(slope[column] <= 1e-8, "{} {}", x[column], slope[column]);
                prop_assert!(x[column] == 0.0 || slope[column].abs() <= 1e-8);
            }
        }
    }
}
