//! The values of a batch: one for all, or one for each.

use std::borrow::Cow;

use crate::symbols::Symbol;
use crate::value::{Cell, Truth, Type};

#[derive(Clone, Debug)]
pub(crate) enum Lane<'a, T: Copy> {
    Same(T),
    Each(Cow<'a, [T]>),
}

impl<T: Copy> Lane<'_, T> {
    pub(crate) fn at(&self, index: usize) -> T {
        match self {
            Self::Same(value) => *value,
            Self::Each(values) => values[index],
        }
    }

    pub(crate) fn map<U: Copy>(&self, f: impl Fn(T) -> U) -> Lane<'static, U> {
        match self {
            Self::Same(value) => Lane::Same(f(*value)),
            Self::Each(values) => Lane::Each(values.iter().map(|&value| f(value)).collect()),
        }
    }

    pub(crate) fn zip<V: Copy, U: Copy>(&self, other: &Lane<V>, f: impl Fn(T, V) -> U) -> Lane<'static, U> {
        match (self, other) {
            (Self::Same(a), Lane::Same(b)) => Lane::Same(f(*a, *b)),
            (Self::Same(a), Lane::Each(b)) => Lane::Each(b.iter().map(|&b| f(*a, b)).collect()),
            (Self::Each(a), Lane::Same(b)) => Lane::Each(a.iter().map(|&a| f(a, *b)).collect()),
            (Self::Each(a), Lane::Each(b)) => {
                Lane::Each(a.iter().zip(b.iter()).map(|(&a, &b)| f(a, b)).collect())
            }
        }
    }

    pub(crate) fn extend(&self, out: &mut Vec<T>, len: usize) {
        match self {
            Self::Same(value) => out.resize(out.len() + len, *value),
            Self::Each(values) => out.extend_from_slice(&values[..len]),
        }
    }

    pub(crate) fn into_static(self) -> Lane<'static, T> {
        match self {
            Self::Same(value) => Lane::Same(value),
            Self::Each(values) => Lane::Each(Cow::Owned(values.into_owned())),
        }
    }

    fn select(&self, chosen: &[u32]) -> Lane<'static, T> {
        match self {
            Self::Same(value) => Lane::Same(*value),
            Self::Each(values) => Lane::Each(chosen.iter().map(|&at| values[at as usize]).collect()),
        }
    }

    /// Writes the values of some places, of those that `which` says.
    fn scatter(&mut self, values: &Lane<T>, places: &[u32], which: &[bool], len: usize) {
        if let Self::Same(value) = self {
            *self = Self::Each(vec![*value; len].into());
        }
        let Self::Each(own) = self else { return };
        let own = own.to_mut();
        for (index, (&at, _)) in places.iter().zip(which).enumerate().filter(|(_, (_, which))| **which) {
            own[at as usize] = values.at(index);
        }
    }

    /// The values from `yes` where `choose` says so, else from `self`.
    pub(crate) fn blend(&self, yes: &Self, len: usize, choose: impl Fn(usize) -> bool) -> Lane<'static, T> {
        let pick = |index, yes: T, no: T| if choose(index) { yes } else { no };
        Lane::Each(match (self, yes) {
            (Self::Same(no), Self::Same(yes)) => (0..len).map(|index| pick(index, *yes, *no)).collect(),
            (Self::Same(no), Self::Each(yes)) => {
                yes[..len].iter().enumerate().map(|(index, &yes)| pick(index, yes, *no)).collect()
            }
            (Self::Each(no), Self::Same(yes)) => {
                no[..len].iter().enumerate().map(|(index, &no)| pick(index, *yes, no)).collect()
            }
            (Self::Each(no), Self::Each(yes)) => {
                let both = no[..len].iter().zip(&yes[..len]).enumerate();
                both.map(|(index, (&no, &yes))| pick(index, yes, no)).collect()
            }
        })
    }
}

/// Values of one type, or cells where only running tells the type.
#[derive(Clone, Debug)]
pub(crate) enum Values<'a> {
    Numbers(Lane<'a, f64>),
    Texts(Lane<'a, Symbol>),
    Truths(Lane<'a, Truth>),
    Cells(Lane<'a, Cell>),
}

impl<'a> Values<'a> {
    pub(crate) const UNKNOWN: Values<'static> = Values::Cells(Lane::Same(Cell::Unknown));

    pub(crate) fn cell(&self, index: usize) -> Cell {
        match self {
            Self::Numbers(lane) => Cell::number(lane.at(index)),
            Self::Texts(lane) => text_cell(lane.at(index)),
            Self::Truths(lane) => truth_cell(lane.at(index)),
            Self::Cells(lane) => lane.at(index),
        }
    }

    pub(crate) fn known(&self) -> Lane<'static, Truth> {
        match self {
            Self::Numbers(lane) => lane.map(|number| (!number.is_nan()).into()),
            Self::Texts(lane) => lane.map(|symbol| (symbol != Symbol::UNKNOWN).into()),
            Self::Truths(lane) => lane.map(|truth| (truth != Truth::Unknown).into()),
            Self::Cells(lane) => lane.map(|cell| (cell != Cell::Unknown).into()),
        }
    }

    pub(crate) fn into_static(self) -> Values<'static> {
        match self {
            Self::Numbers(lane) => Values::Numbers(lane.into_static()),
            Self::Texts(lane) => Values::Texts(lane.into_static()),
            Self::Truths(lane) => Values::Truths(lane.into_static()),
            Self::Cells(lane) => Values::Cells(lane.into_static()),
        }
    }

    /// As numbers; what is none is unknown.
    pub(crate) fn numbers(self) -> Lane<'a, f64> {
        match self {
            Self::Numbers(lane) => lane,
            Self::Cells(lane) => lane.map(|cell| match cell {
                Cell::Number(number) => number,
                _ => f64::NAN,
            }),
            _ => Lane::Same(f64::NAN),
        }
    }

    /// As texts; what is none is unknown.
    pub(crate) fn texts(self) -> Lane<'a, Symbol> {
        match self {
            Self::Texts(lane) => lane,
            Self::Cells(lane) => lane.map(|cell| match cell {
                Cell::Text(symbol) => symbol,
                _ => Symbol::UNKNOWN,
            }),
            _ => Lane::Same(Symbol::UNKNOWN),
        }
    }

    /// As truth values; what is none is unknown.
    pub(crate) fn truths(self) -> Lane<'a, Truth> {
        match self {
            Self::Truths(lane) => lane,
            Self::Cells(lane) => lane.map(|cell| match cell {
                Cell::Truth(truth) => truth.into(),
                _ => Truth::Unknown,
            }),
            _ => Lane::Same(Truth::Unknown),
        }
    }

    pub(crate) fn cells(self) -> Lane<'a, Cell> {
        match self {
            Self::Numbers(lane) => lane.map(Cell::number),
            Self::Texts(lane) => lane.map(text_cell),
            Self::Truths(lane) => lane.map(truth_cell),
            Self::Cells(lane) => lane,
        }
    }

    pub(crate) fn narrow(self, kind: Type) -> Self {
        match kind {
            Type::Number => Values::Numbers(self.numbers()),
            Type::Text => Values::Texts(self.texts()),
            Type::Truth => Values::Truths(self.truths()),
        }
    }

    /// The values of `yes` where `choose` says so, else those of `self`.
    pub(crate) fn blend(self, yes: Self, len: usize, choose: impl Fn(usize) -> bool) -> Values<'static> {
        match (self, yes) {
            (Self::Numbers(a), Self::Numbers(b)) => Values::Numbers(a.blend(&b, len, choose)),
            (Self::Texts(a), Self::Texts(b)) => Values::Texts(a.blend(&b, len, choose)),
            (Self::Truths(a), Self::Truths(b)) => Values::Truths(a.blend(&b, len, choose)),
            (a, b) => match (a.kind(), b.kind()) {
                (Some(kind), None) => Self::blend(a, b.narrow(kind), len, choose),
                (None, Some(kind)) => Self::blend(a.narrow(kind), b, len, choose),
                _ => Values::Cells(a.cells().blend(&b.cells(), len, choose)),
            },
        }
    }

    pub(crate) fn select(&self, chosen: &[u32]) -> Values<'static> {
        match self {
            Self::Numbers(lane) => Values::Numbers(lane.select(chosen)),
            Self::Texts(lane) => Values::Texts(lane.select(chosen)),
            Self::Truths(lane) => Values::Truths(lane.select(chosen)),
            Self::Cells(lane) => Values::Cells(lane.select(chosen)),
        }
    }

    /// The type; `None` for cells.
    pub(crate) const fn kind(&self) -> Option<Type> {
        match self {
            Self::Numbers(_) => Some(Type::Number),
            Self::Texts(_) => Some(Type::Text),
            Self::Truths(_) => Some(Type::Truth),
            Self::Cells(_) => None,
        }
    }
}

impl Values<'static> {
    /// Writes the values of some places, of those that `which` says.
    pub(crate) fn scatter(&mut self, values: &Values, places: &[u32], which: &[bool], len: usize) {
        if let (Values::Cells(Lane::Same(Cell::Unknown)), Some(kind)) = (&*self, values.kind()) {
            *self = std::mem::replace(self, Values::UNKNOWN).narrow(kind);
        }
        match (&mut *self, values) {
            (Values::Numbers(own), Values::Numbers(lane)) => own.scatter(lane, places, which, len),
            (Values::Texts(own), Values::Texts(lane)) => own.scatter(lane, places, which, len),
            (Values::Truths(own), Values::Truths(lane)) => own.scatter(lane, places, which, len),
            (Values::Cells(own), values) => {
                let cells = Lane::Each((0..places.len()).map(|index| values.cell(index)).collect());
                own.scatter(&cells, places, which, len);
            }
            (_, values) => {
                let kind = self.kind();
                let own = std::mem::replace(self, Values::UNKNOWN);
                let cells: Vec<Cell> = (0..len).map(|index| own.cell(index)).collect();
                let mut own = Values::Cells(Lane::Each(cells.into()));
                own.scatter(values, places, which, len);
                // What only running tells of another type stays unknown.
                *self = kind.map_or_else(|| own.clone(), |kind| own.clone().narrow(kind));
            }
        }
    }
}

fn text_cell(symbol: Symbol) -> Cell {
    if symbol == Symbol::UNKNOWN { Cell::Unknown } else { Cell::Text(symbol) }
}

fn truth_cell(truth: Truth) -> Cell {
    truth.known().map_or(Cell::Unknown, Cell::Truth)
}

#[derive(Clone, Debug)]
pub(crate) enum Rows {
    /// Not bound: all its properties are unknown.
    Unbound,
    From(u32),
    Same(u32),
    Each(Vec<u32>),
    /// No rows: the number that a clause of `count` or `sum` gives.
    Numbers(Lane<'static, f64>),
}

/// Stands where a variable is bound to no row.
pub(crate) const NO_ROW: u32 = u32::MAX;

impl Rows {
    pub(crate) fn each(rows: Vec<u32>) -> Self {
        // What is the same for the whole batch is looked at once, which counts where it is small.
        if let [row] = rows.as_slice() { Self::Same(*row) } else { Self::Each(rows) }
    }

    pub(crate) fn at(&self, index: usize) -> u32 {
        match self {
            Self::Unbound | Self::Numbers(_) => NO_ROW,
            Self::From(first) => first + index as u32,
            Self::Same(row) => *row,
            Self::Each(rows) => rows[index],
        }
    }

    /// The number that a clause gives; NaN where it is unknown, or the clause gives none.
    pub(crate) fn number(&self, index: usize) -> f64 {
        if let Self::Numbers(numbers) = self { numbers.at(index) } else { f64::NAN }
    }

    pub(crate) fn extend(&self, out: &mut Vec<u32>, len: usize) {
        match self {
            Self::Unbound | Self::Numbers(_) => out.resize(out.len() + len, NO_ROW),
            Self::From(first) => out.extend(*first..*first + len as u32),
            Self::Same(row) => out.resize(out.len() + len, *row),
            Self::Each(rows) => out.extend_from_slice(&rows[..len]),
        }
    }

    fn select(&self, chosen: &[u32]) -> Self {
        match self {
            Self::Unbound => Self::Unbound,
            Self::Same(row) => Self::Same(*row),
            Self::From(first) => Self::each(chosen.iter().map(|&index| first + index).collect()),
            Self::Each(rows) => Self::each(chosen.iter().map(|&index| rows[index as usize]).collect()),
            Self::Numbers(numbers) => Self::Numbers(numbers.select(chosen)),
        }
    }
}

#[derive(Clone, Debug)]
pub(crate) struct Frame {
    pub(crate) len: usize,
    pub(crate) rows: Vec<Rows>,
}

impl Frame {
    /// These objects of one variable, of so many; the others are not bound.
    pub(crate) fn of(variables: usize, variable: usize, rows: &[u32]) -> Self {
        let mut bound = vec![Rows::Unbound; variables];
        bound[variable] = Rows::each(rows.to_vec());
        Self { len: rows.len(), rows: bound }
    }

    pub(crate) fn select(&self, chosen: &[u32]) -> Self {
        Self { len: chosen.len(), rows: self.rows.iter().map(|rows| rows.select(chosen)).collect() }
    }

    /// Those of the bindings that are kept: all, or as [`select`](Self::select).
    pub(crate) fn kept(self, kept: &[u32]) -> Self {
        if kept.len() == self.len { self } else { self.select(kept) }
    }

    pub(crate) fn binding(&self, index: usize) -> Vec<u32> {
        self.rows.iter().map(|rows| rows.at(index)).collect()
    }

    /// Bindings by their numbers, each with the row that a variable is bound to.
    pub(crate) fn paired(&self, variable: usize, pairs: &[(u32, u32)]) -> Self {
        if let [(binding, row)] = *pairs {
            let mut next = self.repeat(binding as usize, 1);
            next.rows[variable] = Rows::Same(row);
            return next;
        }
        let (bindings, rows): (Vec<u32>, Vec<u32>) = pairs.iter().copied().unzip();
        let mut next = self.select(&bindings);
        next.rows[variable] = Rows::Each(rows);
        next
    }

    pub(crate) fn repeat(&self, index: usize, len: usize) -> Self {
        let rows = self.rows.iter().map(|rows| match rows {
            Rows::Unbound => Rows::Unbound,
            Rows::Numbers(numbers) => Rows::Numbers(Lane::Same(numbers.at(index))),
            bound => Rows::Same(bound.at(index)),
        });
        Self { len, rows: rows.collect() }
    }
}
