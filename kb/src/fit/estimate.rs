//! The hardness that fits observations best, with intervals.

use std::collections::{BTreeMap, BTreeSet};

use nalgebra::{DMatrix, DVector};
use statrs::distribution::{ContinuousCDF, StudentsT};

use super::nnls::nnls;
use crate::words::number::counted;

/// Columns whose part that no other explains is less than this share are not told apart.
const APART: f64 = 1e-7;

/// One measurement: of a traversal, or of a mission.
#[derive(Clone, Debug, PartialEq)]
pub struct Observation {
    /// Metres by state.
    pub metres: BTreeMap<String, f64>,
    pub measured: f64,
}

impl Observation {
    /// So much, of no metres yet.
    pub fn measured(measured: f64) -> Self {
        Self { metres: BTreeMap::new(), measured }
    }
}

#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Unknown {
    /// It is always driven in together with these, in the same proportion.
    NotApart(Vec<String>),
}

#[derive(Clone, Debug, PartialEq)]
pub struct Value {
    /// The measure a metre; `None`: the observations do not tell.
    pub value: Option<f64>,
    /// The interval that holds the true one with 95 %; `None` where there are too few observations.
    pub interval: Option<(f64, f64)>,
    pub unknown: Option<Unknown>,
    /// Observations in which it was driven in.
    pub observations: usize,
    column: Option<usize>,
}

#[derive(Clone, Debug, PartialEq)]
pub struct Estimate {
    /// By state.
    pub values: BTreeMap<String, Value>,
    pub observations: usize,
    /// How much an observation of one metre scatters.
    pub residual_sd: Option<f64>,
    covariance: DMatrix<f64>,
    quantile: Option<f64>,
}

/// Least squares of what was measured, weighed by the inverse of the metres, with no negative hardness.
pub fn estimate(observations: &[Observation]) -> Estimate {
    let used: Vec<&Observation> =
        observations.iter().filter(|one| one.metres.values().sum::<f64>() > 0.0).collect();
    let names: Vec<String> = {
        let names: BTreeSet<&String> = used.iter().flat_map(|one| one.metres.keys()).collect();
        names.into_iter().cloned().collect()
    };
    let weight = |row: usize| used[row].metres.values().sum::<f64>().sqrt().recip();
    let metres = |row: usize, name: &String| used[row].metres.get(name).copied().unwrap_or(0.0);
    let all =
        DMatrix::from_fn(used.len(), names.len(), |row, column| weight(row) * metres(row, &names[column]));
    let measured = DVector::from_fn(used.len(), |row, _| weight(row) * used[row].measured);
    let (kept, mingled) = independent(&all);
    let design = all.select_columns(&kept);
    let fitted = nnls(&design, &measured);
    let freedom = used.len().saturating_sub(kept.len());
    let quantile = (freedom > 0).then(|| StudentsT::new(0.0, 1.0, freedom as f64).ok()).flatten();
    let quantile = quantile.map(|student| student.inverse_cdf(0.975));
    let covariance = covariance(&design, &measured);
    // an interval is about the best fit of all; where none may be negative, its part from 0 on
    let free = least_squares(&design, &measured);
    let residual = (&measured - &design * &fitted).norm_squared();
    let value = |(index, name): (usize, &String)| {
        let together = mingled.get(&index);
        let column = kept.iter().position(|&kept| kept == index).filter(|_| together.is_none());
        let interval = column.zip(quantile).map(|(column, quantile)| {
            let half = quantile * covariance[(column, column)].max(0.0).sqrt();
            let middle = if fitted[column] > 0.0 { fitted[column] } else { free[column] };
            ((middle - half).max(0.0), (middle + half).max(0.0))
        });
        let names = |with: &BTreeSet<usize>| with.iter().map(|&other| names[other].clone()).collect();
        let value = Value {
            value: column.map(|column| fitted[column]),
            interval,
            unknown: together.map(|with| Unknown::NotApart(names(with))),
            observations: used
                .iter()
                .filter(|one| one.metres.get(name).is_some_and(|metres| *metres > 0.0))
                .count(),
            column,
        };
        (name.clone(), value)
    };
    Estimate {
        values: names.iter().enumerate().map(value).collect(),
        observations: used.len(),
        residual_sd: (freedom > 0).then(|| (residual / freedom as f64).sqrt()),
        covariance,
        quantile,
    }
}

impl Estimate {
    /// The interval of how many times harder one state is than another.
    pub fn ratio(&self, of: &Value, to: &Value) -> Option<(f64, f64)> {
        let (one, two) = (of.column?, to.column?);
        let (value, other) = (of.value?, to.value.filter(|value| *value > 0.0)?);
        let ratio = value / other;
        // the delta method: both are uncertain, and not independent
        let variance = self.covariance[(one, one)] - 2.0 * ratio * self.covariance[(one, two)]
            + ratio * ratio * self.covariance[(two, two)];
        let half = self.quantile? * variance.max(0.0).sqrt() / other;
        Some(((ratio - half).max(0.0), ratio + half))
    }

    /// What cannot be said, and why.
    pub fn notes(&self) -> Vec<String> {
        let mut notes = Vec::new();
        for (name, value) in &self.values {
            if let Some(Unknown::NotApart(others)) = &value.unknown {
                let others: Vec<&str> =
                    others.iter().map(String::as_str).filter(|other| other != name).collect();
                notes.push(format!(
                    "{name} cannot be told apart from {}: they are driven in together, in the same proportion",
                    others.join(", ")
                ));
            }
        }
        if self.observations > 0 && self.quantile.is_none() {
            let are = if self.observations == 1 { "is" } else { "are" };
            notes.push(format!("{} {are} too few for intervals", counted(self.observations, "observation")));
        }
        notes
    }
}

/// Columns that are independent, the first ones of those that are not; and for each column that is mingled with others,
/// all of these.
fn independent(all: &DMatrix<f64>) -> (Vec<usize>, BTreeMap<usize, BTreeSet<usize>>) {
    let (mut kept, mut basis): (Vec<usize>, Vec<DVector<f64>>) = (Vec::new(), Vec::new());
    let mut mingled: BTreeMap<usize, BTreeSet<usize>> = BTreeMap::new();
    for index in 0..all.ncols() {
        let column = all.column(index).into_owned();
        let mut rest = column.clone();
        // twice is enough (Kahan)
        for _ in 0..2 {
            for known in &basis {
                rest -= known * known.dot(&rest);
            }
        }
        if rest.norm() > APART * column.norm() {
            basis.push(rest.normalize());
            kept.push(index);
            continue;
        }
        // which of the kept ones make it up
        let parts = least_squares(&all.select_columns(&kept), &column);
        let mut together: BTreeSet<usize> = BTreeSet::from([index]);
        for (part, &other) in parts.iter().zip(&kept) {
            if (part * all.column(other).norm()).abs() > 1e-6 * column.norm() {
                together.insert(other);
            }
        }
        let more: Vec<usize> =
            together.iter().filter_map(|one| mingled.get(one)).flatten().copied().collect();
        together.extend(more);
        for &one in &together {
            mingled.entry(one).or_default().extend(&together);
        }
    }
    (kept, mingled)
}

fn least_squares(a: &DMatrix<f64>, b: &DVector<f64>) -> DVector<f64> {
    if a.ncols() == 0 {
        return DVector::zeros(0);
    }
    let qr = a.clone().qr();
    qr.r().solve_upper_triangular(&(qr.q().transpose() * b)).unwrap_or_else(|| DVector::zeros(a.ncols()))
}

/// How the estimates scatter, by the errors as they were found: HC3.
fn covariance(design: &DMatrix<f64>, measured: &DVector<f64>) -> DMatrix<f64> {
    let columns = design.ncols();
    let Some(inverse) = (design.transpose() * design).try_inverse() else {
        return DMatrix::zeros(columns, columns);
    };
    let errors = measured - design * least_squares(design, measured);
    let mut middle = DMatrix::zeros(columns, columns);
    for (row, error) in design.row_iter().zip(errors.iter()) {
        let leverage = (row * &inverse * row.transpose())[(0, 0)];
        // a row that alone decides a column has no error to tell by
        let error = error / (1.0 - leverage).max(1e-9);
        middle += row.transpose() * row * (error * error);
    }
    &inverse * middle * &inverse
}
