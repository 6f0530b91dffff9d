//! Which rows something has to be done for.

#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub(crate) enum Dirty {
    #[default]
    None,
    /// In any order, perhaps more than once, until [`Dirty::settle`].
    Rows(Vec<u32>),
    All,
}

/// One row in so many is many.
const MANY: usize = 16;

impl Dirty {
    pub(crate) const fn is_none(&self) -> bool {
        matches!(self, Self::None)
    }

    pub(crate) fn add(&mut self, row: u32) {
        match self {
            Self::None => *self = Self::Rows(vec![row]),
            Self::Rows(rows) => rows.push(row),
            Self::All => {}
        }
    }

    pub(crate) fn join(&mut self, other: &Self) {
        match (&mut *self, other) {
            (Self::All, _) | (_, Self::None) => {}
            (_, Self::All) => *self = Self::All,
            (Self::None, other) => *self = other.clone(),
            (Self::Rows(rows), Self::Rows(more)) => rows.extend(more),
        }
    }

    pub(crate) fn extend(&mut self, rows: impl IntoIterator<Item = u32>) {
        rows.into_iter().for_each(|row| self.add(row));
    }

    /// Ascending, each row once; all rows become [`Dirty::All`] where there are `len`.
    pub(crate) fn settle(mut self, len: usize) -> Self {
        if let Self::Rows(rows) = &mut self {
            if !rows.is_sorted_by(|a, b| a < b) {
                // of most rows it is sooner looked at each than sorted
                if rows.len() > len / MANY && rows.iter().all(|&row| (row as usize) < len) {
                    let mut is_in = vec![false; len];
                    for &row in rows.iter() {
                        is_in[row as usize] = true;
                    }
                    *rows = (0..).zip(is_in).filter_map(|(row, is_in)| is_in.then_some(row)).collect();
                } else {
                    rows.sort_unstable();
                    rows.dedup();
                }
            }
            if rows.is_empty() {
                return Self::None;
            }
            if rows.len() == len {
                return Self::All;
            }
        }
        self
    }

    pub(crate) fn rows(&self, len: usize) -> Vec<u32> {
        match self {
            Self::None => vec![],
            Self::Rows(rows) => rows.clone(),
            Self::All => (0..len as u32).collect(),
        }
    }

    /// The rows after objects moved; those that are gone are left out.
    pub(crate) fn moved(self, moved: &[Option<u32>]) -> Self {
        match self {
            Self::Rows(rows) => {
                Self::Rows(rows.into_iter().filter_map(|row| moved.get(row as usize).copied()?).collect())
            }
            other => other,
        }
    }
}
