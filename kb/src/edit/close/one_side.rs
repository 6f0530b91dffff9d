//! A doorway that is closed from one side.

use adit_db::Tx;

use super::super::tell::Tell;
use super::Close;
use crate::error::{Code, Error, Result};
use crate::graph::Building;
use crate::knowledge::LAYOUT;
use crate::knowledge::told::closing::CLOSED_FROM;
use crate::words::suggest::{did_you_mean, listed};

impl Close {
    /// The fact that closes a doorway to whoever comes from a space.
    pub(super) fn closing_one_side(
        &self,
        tx: &mut Tx<'_>,
        (class, object): (&'static str, String),
        from: &str,
    ) -> Result<Tell> {
        let (what, building) = (self.what.trim(), Building::read(tx)?);
        let refused =
            |message: String, help: Option<String>| Err(Error::said(Code::TellUsage, message, help));
        if !self.only.is_empty() || !self.except.is_empty() {
            let message =
                format!("what is closed from one side is so for all robots: `{what}` from `{from}`");
            let help = "leave out `only` and `except`, or close it from both sides".to_owned();
            return refused(message, Some(help));
        }
        let doorway = building.doorway_named(&object);
        if tx.site_value(LAYOUT)?.is_some() || class != "DOORWAYS" && doorway.is_none() {
            let message =
                format!("`{what}` is no doorway between rooms, so it has no side to be closed from");
            return refused(message, None);
        }
        let Some(space) = building.space_named(from) else {
            let names: Vec<String> =
                building.spaces.iter().filter_map(|space| building.space(space.space)).collect();
            let help = did_you_mean(from, names.iter().map(String::as_str));
            return Err(Error::said(
                Code::TellUnknownObject,
                format!("the site has no space called `{from}`"),
                help.or_else(|| listed("there", names.iter().map(String::as_str))),
            ));
        };
        if let Some(doorway) = doorway
            && (doorway.space1 == doorway.space2 || ![doorway.space1, doorway.space2].contains(&space.space))
        {
            let beside =
                [doorway.space1, doorway.space2].map(|space| building.space(space).unwrap_or_default());
            let message = format!("`{what}` does not lead out of `{from}`");
            let help = if doorway.space1 == doorway.space2 {
                format!("both its sides are of {}", beside[0])
            } else {
                format!("it is between {} and {}", beside[0], beside[1])
            };
            return refused(message, Some(help));
        }
        Ok(Tell {
            class: "DOORWAYS".to_owned(),
            object,
            property: CLOSED_FROM.to_owned(),
            value: building.space(space.space).unwrap_or_else(|| from.to_owned()),
            until: self.until.clone(),
            new_property: false,
        })
    }
}
