//! One property of all objects of a class, as typed values side by side.

use crate::symbols::Symbol;
use crate::value::{Cell, Truth, Type};

/// Unknown is NaN, [`Symbol::UNKNOWN`] or [`Truth::Unknown`].
#[derive(Clone, Debug)]
pub(crate) enum Column {
    Numbers(Vec<f64>),
    Texts(Vec<Symbol>),
    Truths(Vec<Truth>),
}

impl Column {
    pub(crate) fn unknown(kind: Type, len: usize) -> Self {
        match kind {
            Type::Number => Self::Numbers(vec![f64::NAN; len]),
            Type::Text => Self::Texts(vec![Symbol::UNKNOWN; len]),
            Type::Truth => Self::Truths(vec![Truth::Unknown; len]),
        }
    }

    pub(crate) const fn kind(&self) -> Type {
        match self {
            Self::Numbers(_) => Type::Number,
            Self::Texts(_) => Type::Text,
            Self::Truths(_) => Type::Truth,
        }
    }

    pub(crate) fn len(&self) -> usize {
        match self {
            Self::Numbers(values) => values.len(),
            Self::Texts(values) => values.len(),
            Self::Truths(values) => values.len(),
        }
    }

    /// Makes it this long; new rows are unknown.
    pub(crate) fn resize(&mut self, len: usize) {
        match self {
            Self::Numbers(values) => values.resize(len, f64::NAN),
            Self::Texts(values) => values.resize(len, Symbol::UNKNOWN),
            Self::Truths(values) => values.resize(len, Truth::Unknown),
        }
    }

    /// The value of a row; unknown past the end.
    pub(crate) fn cell(&self, row: usize) -> Cell {
        match self {
            Self::Numbers(values) => values.get(row).map_or(Cell::Unknown, |&number| Cell::number(number)),
            Self::Texts(values) => match values.get(row) {
                Some(&symbol) if symbol != Symbol::UNKNOWN => Cell::Text(symbol),
                _ => Cell::Unknown,
            },
            Self::Truths(values) => {
                values.get(row).and_then(|truth| truth.known()).map_or(Cell::Unknown, Cell::Truth)
            }
        }
    }

    pub(crate) fn is_unknown(&self, row: usize) -> bool {
        self.cell(row) == Cell::Unknown
    }

    /// Adds a row; unknown if the value is of another type.
    pub(crate) fn push(&mut self, cell: Cell) {
        match (self, cell) {
            (Self::Numbers(values), Cell::Number(number)) => values.push(number),
            (Self::Numbers(values), _) => values.push(f64::NAN),
            (Self::Texts(values), Cell::Text(symbol)) => values.push(symbol),
            (Self::Texts(values), _) => values.push(Symbol::UNKNOWN),
            (Self::Truths(values), Cell::Truth(truth)) => values.push(truth.into()),
            (Self::Truths(values), _) => values.push(Truth::Unknown),
        }
    }

    /// Puts a row in; those from there on move down.
    pub(crate) fn insert(&mut self, row: usize, cell: Cell) {
        match self {
            Self::Numbers(values) => values.insert(row, f64::NAN),
            Self::Texts(values) => values.insert(row, Symbol::UNKNOWN),
            Self::Truths(values) => values.insert(row, Truth::Unknown),
        }
        self.set(row, cell);
    }

    /// Takes a row out; those after it move up.
    pub(crate) fn remove(&mut self, row: usize) {
        match self {
            Self::Numbers(values) => drop(values.remove(row)),
            Self::Texts(values) => drop(values.remove(row)),
            Self::Truths(values) => drop(values.remove(row)),
        }
    }

    /// Writes a row. `false` if the value is of another type.
    pub(crate) fn set(&mut self, row: usize, cell: Cell) -> bool {
        match (self, cell) {
            (Self::Numbers(values), Cell::Number(number)) => values[row] = number,
            (Self::Numbers(values), Cell::Unknown) => values[row] = f64::NAN,
            (Self::Texts(values), Cell::Text(symbol)) => values[row] = symbol,
            (Self::Texts(values), Cell::Unknown) => values[row] = Symbol::UNKNOWN,
            (Self::Truths(values), Cell::Truth(truth)) => values[row] = truth.into(),
            (Self::Truths(values), Cell::Unknown) => values[row] = Truth::Unknown,
            _ => return false,
        }
        true
    }

    /// The rows in which two columns of one type differ, as far as both go, ascending.
    pub(crate) fn differing(&self, other: &Self) -> Vec<u32> {
        fn rows<T: Copy>(a: &[T], b: &[T], same: impl Fn(T, T) -> bool) -> Vec<u32> {
            let pairs = a.iter().zip(b).zip(0..);
            pairs.filter(|((a, b), _)| !same(**a, **b)).map(|(_, row)| row).collect()
        }
        match (self, other) {
            (Self::Numbers(a), Self::Numbers(b)) => {
                rows(a, b, |a, b| a.to_bits() == b.to_bits() || (a.is_nan() && b.is_nan()))
            }
            (Self::Texts(a), Self::Texts(b)) => rows(a, b, |a, b| a == b),
            (Self::Truths(a), Self::Truths(b)) => rows(a, b, |a, b| a == b),
            _ => (0..self.len() as u32).collect(),
        }
    }

    /// The column after rows moved (`None`: they stayed); new rows are unknown.
    pub(crate) fn moved(&self, moved: Option<&[Option<u32>]>, len: usize) -> Self {
        let mut column = Self::unknown(self.kind(), len);
        for from in 0..self.len() {
            let to = moved.map_or(Some(from as u32), |moved| moved.get(from).copied().flatten());
            if let Some(to) = to.filter(|&to| (to as usize) < len) {
                column.set(to as usize, self.cell(from));
            }
        }
        column
    }
}
