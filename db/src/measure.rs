//! What adds up along a route besides hardness: the table `measures`, and what is said of them.

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};
use sqlx::{Row, SqliteConnection};

use crate::error::Result;
use crate::transaction::Tx;

/// A property of rooms, by the metre, and of doors, of passing, that adds up along routes.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, utoipa::ToSchema)]
pub struct Measure {
    /// The property's name: `seconds`.
    pub measure: String,
    /// In which unit it is: `s`; empty where it has none.
    pub unit: String,
}

/// How much of each measure. One that is not known is not in it.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, utoipa::ToSchema)]
#[serde(transparent)]
pub struct Measures(pub BTreeMap<String, f64>);

impl Measures {
    /// What a text of the database says; one that nobody of ours wrote says nothing.
    pub fn of(text: Option<&str>) -> Self {
        text.and_then(|text| serde_json::from_str(text).ok()).unwrap_or_default()
    }

    /// As the database has it; `None`: nothing is known.
    pub fn text(&self) -> Option<String> {
        if self.is_empty() { None } else { serde_json::to_string(self).ok() }
    }

    pub fn is_empty(&self) -> bool {
        self.0.is_empty()
    }

    /// What so many metres take of which this is one. Where ways are not measured, only what takes nothing is known.
    #[must_use]
    pub fn along(&self, metres: Option<f64>) -> Self {
        let of = |(name, a_metre): (&String, &f64)| {
            let amount = if *a_metre == 0.0 { Some(0.0) } else { metres.map(|metres| metres * a_metre) };
            Some((name.clone(), amount?))
        };
        Self(self.0.iter().filter_map(of).collect())
    }

    /// Both together: what is not known of one is not known of the sum.
    #[must_use]
    pub fn and(&self, other: &Self) -> Self {
        let sum = |(name, one): (&String, &f64)| Some((name.clone(), one + other.0.get(name)?));
        Self(self.0.iter().filter_map(sum).collect())
    }

    /// To a millionth, as answers say it: sums that were taken in another order say the same.
    #[must_use]
    pub fn rounded(&self) -> Self {
        let round = |(name, amount): (&String, &f64)| (name.clone(), (amount * 1e6).round() / 1e6);
        Self(self.0.iter().map(round).collect())
    }
}

/// The measures that there are, by name.
pub async fn measures(connection: &mut SqliteConnection) -> Result<Vec<Measure>> {
    let rows =
        sqlx::query("SELECT measure, unit FROM measures ORDER BY measure").fetch_all(connection).await?;
    let read = |row: &sqlx::sqlite::SqliteRow| -> sqlx::Result<Measure> {
        Ok(Measure { measure: row.try_get(0)?, unit: row.try_get(1)? })
    };
    Ok(rows.iter().map(read).collect::<sqlx::Result<_>>()?)
}

impl Tx<'_> {
    /// The measures that there are, by name.
    pub fn measures(&mut self) -> Result<Vec<Measure>> {
        self.run(measures)
    }
}
