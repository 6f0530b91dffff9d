//! Edits, and what they would change.

use std::time::{Duration, Instant};

use adit_db::Cell;
use adit_db::history::Author;
use axum::Json;
use serde::{Deserialize, Serialize};
use utoipa::ToSchema;

use super::Site;
use super::extract::Body;
use crate::edit::Tell;
use crate::edit::{Done, Edit};
use crate::error::Code;
use crate::live::Outcome;
use crate::preview::{Preview, Wanted};
use crate::serve::fault::{Answered, Failure, Fault};
use crate::serve::gate::require;
use crate::serve::role::{Caller, Role};

/// The longest that routes between places are compared.
const PATIENCE_MS: u64 = 10_000;

/// Edits that one preview may hold.
const PREVIEWED: usize = 1_000;

/// A value as JSON has it: a number, a text, a truth value, or null for none.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(untagged)]
pub enum Scalar {
    /// A truth value.
    Truth(bool),
    /// A number.
    Number(serde_json::Number),
    /// A text.
    Text(String),
    /// No value.
    None(()),
}

impl Scalar {
    /// As people write it.
    fn text(&self) -> String {
        match self {
            Self::Truth(truth) => truth.to_string(),
            Self::Number(number) => number.to_string(),
            Self::Text(text) => text.clone(),
            Self::None(()) => String::new(),
        }
    }

    /// As tables hold it, where truth values are 0 and 1.
    fn cell(&self) -> String {
        match self {
            Self::Truth(truth) => i64::from(*truth).to_string(),
            other => other.text(),
        }
    }
}

/// An edit. A key is the columns of a row's key joined by `/`, as `robot/SQUAT`; the robot may be left out where there is
/// one.
#[derive(Clone, Debug, Deserialize, ToSchema)]
#[serde(tag = "kind", rename_all = "snake_case", deny_unknown_fields)]
pub enum Wish {
    /// One cell.
    Set {
        /// The table.
        table: String,
        /// The row.
        key: String,
        /// The column.
        column: String,
        /// The value from now on.
        #[schema(value_type = serde_json::Value)]
        value: Scalar,
        /// The value that the editor sees: if it is another one by now, the edit is refused.
        #[serde(default)]
        #[schema(value_type = Option<serde_json::Value>)]
        old: Option<Scalar>,
    },
    /// A new row.
    Add {
        /// The table.
        table: String,
        /// The row.
        key: String,
        /// Values of the other columns.
        #[serde(default)]
        #[schema(value_type = std::collections::BTreeMap<String, serde_json::Value>)]
        cells: std::collections::BTreeMap<String, Scalar>,
    },
    /// A row that goes.
    Remove {
        /// The table.
        table: String,
        /// The row.
        key: String,
    },
    /// A fact.
    Tell {
        /// The class, as `DOORS`.
        class: String,
        /// The object: its name, `door 7`, `room d` or `x,y`.
        object: String,
        /// The property.
        property: String,
        /// What it is.
        #[schema(value_type = serde_json::Value)]
        value: Scalar,
        /// When it ends: `18:00`, `2h`, `2026-11-21T18:00:00Z`.
        #[serde(default)]
        until: Option<String>,
        /// After how many seconds it ends, instead.
        #[serde(default)]
        for_seconds: Option<u32>,
    },
    /// A fact that is no longer told.
    Retract {
        /// Its number.
        fact: i64,
    },
    /// A cell of a named tuning.
    SetInTuning {
        /// The tuning.
        tuning: String,
        /// The table.
        table: String,
        /// The row.
        key: String,
        /// The column.
        column: String,
        /// The value while the tuning is on.
        #[schema(value_type = serde_json::Value)]
        value: Scalar,
    },
    /// A cell of a named tuning that goes.
    UnsetInTuning {
        /// The tuning.
        tuning: String,
        /// The table.
        table: String,
        /// The row.
        key: String,
        /// The column.
        column: String,
    },
    /// A named tuning, switched on or off.
    Switch {
        /// The tuning.
        tuning: String,
        /// Whether it is on from now on.
        on: bool,
    },
    /// An entry of the history, taken back.
    Undo {
        /// Its number; the latest one without.
        #[serde(default)]
        edit: Option<i64>,
    },
}

/// A fact, as it is said.
#[derive(Clone, Debug)]
pub struct Fact {
    /// The class.
    pub class: String,
    /// The object.
    pub object: String,
    /// The property.
    pub property: String,
    /// What it is.
    pub value: Scalar,
    /// When it ends.
    pub until: Option<String>,
    /// After how many seconds it ends, instead.
    pub for_seconds: Option<u32>,
}

impl Fact {
    /// The edit that tells it.
    pub fn edit(&self) -> Answered<Edit> {
        let until = match (&self.until, self.for_seconds) {
            (Some(_), Some(_)) => {
                return Err(Fault::new(
                    Code::TellUsage,
                    "a fact ends at `until` or after `for_seconds`, not both",
                ));
            }
            (None, Some(seconds)) => Some(format!("{seconds} seconds")),
            (until, None) => until.clone(),
        };
        Ok(Edit::Tell(Tell {
            class: self.class.clone(),
            object: self.object.clone(),
            property: self.property.clone(),
            value: self.value.text(),
            until,
            new_property: false,
        }))
    }
}

impl Wish {
    /// The role that it takes.
    fn role(&self) -> Role {
        match self {
            Self::Tell { .. } | Self::Retract { .. } => Role::Tell,
            _ => Role::Tune,
        }
    }

    /// The edit that is meant.
    fn edit(&self) -> Answered<Edit> {
        Ok(match self {
            Self::Set { table, key, column, value, old } => {
                let [table, key, column] = [table, key, column].map(Clone::clone);
                match old {
                    Some(old) => Edit::SetFrom([table, key, column], old.cell(), value.cell()),
                    None => Edit::Set(table, key, column, value.cell()),
                }
            }
            Self::Add { table, key, cells } => {
                let cells = cells.iter().map(|(column, value)| (column.clone(), value.cell()));
                Edit::Add(table.clone(), key.clone(), cells.collect())
            }
            Self::Remove { table, key } => Edit::Remove(table.clone(), key.clone()),
            Self::Tell { class, object, property, value, until, for_seconds } => {
                let [class, object, property] = [class, object, property].map(Clone::clone);
                let (value, until) = (value.clone(), until.clone());
                Fact { class, object, property, value, until, for_seconds: *for_seconds }.edit()?
            }
            Self::Retract { fact } => Edit::Retract(*fact),
            Self::SetInTuning { tuning, table, key, column, value } => {
                let cell = [table.clone(), key.clone(), column.clone(), value.cell()];
                Edit::SetInTuning(tuning.clone(), cell)
            }
            Self::UnsetInTuning { tuning, table, key, column } => {
                Edit::UnsetInTuning(tuning.clone(), [table.clone(), key.clone(), column.clone()])
            }
            Self::Switch { tuning, on } => Edit::Switch(tuning.clone(), *on),
            Self::Undo { edit } => Edit::Undo(*edit),
        })
    }
}

/// In a few words, what an edit did.
pub fn words(edit: &Edit, outcome: &Outcome) -> String {
    let Some(Done { key, old, new, .. }) = &outcome.done else { return String::new() };
    match edit {
        Edit::Set(table, _, column, _) | Edit::SetFrom([table, _, column], ..) => {
            format!("{table}.{key}.{column}: {old} → {new}")
        }
        Edit::Add(table, ..) => format!("{table}.{key} is new"),
        Edit::Remove(table, ..) => format!("{table}.{key} is gone"),
        Edit::Tell(fact) => {
            format!("fact {key}: {} {} {} = {}", fact.class, fact.object, fact.property, fact.value)
        }
        Edit::Retract(_) => format!("fact {key} is taken back"),
        Edit::SetInTuning(tuning, [table, row, column, value]) => {
            format!("tuning {tuning}: {table}.{row}.{column} = {value}")
        }
        Edit::UnsetInTuning(tuning, [table, row, column]) => {
            format!("tuning {tuning}: no {table}.{row}.{column} any more")
        }
        Edit::Switch(tuning, on) => format!("tuning {tuning} is {}", if *on { "on" } else { "off" }),
        Edit::Undo(_) => match (old, new) {
            // a row as JSON says too much
            (Cell::Text(row), Cell::Null) if row.starts_with('{') => format!("undone: {key} is gone again"),
            (Cell::Null, Cell::Text(row)) if row.starts_with('{') => format!("undone: {key} is back"),
            _ => format!("undone: {key}: {old} → {new}"),
        },
    }
}

/// An edit, with its reason.
#[derive(Debug, Deserialize, ToSchema)]
#[serde(deny_unknown_fields)]
pub struct EditBody {
    /// The edit.
    edit: Wish,
    /// Why.
    #[serde(default)]
    why: Option<String>,
}

/// What an edit did.
#[derive(Debug, Serialize, ToSchema)]
pub struct Edited {
    /// The entry of the history.
    #[schema(value_type = Object)]
    pub done: Option<Done>,
    /// Number of the knowledge base's state from now on.
    pub generation: u64,
    /// Names the cut of the floor.
    pub layout: String,
    /// Rooms with another hardness, action or passability.
    pub rooms: usize,
    /// Doors with another hardness, action or passability.
    pub doors: usize,
    /// Whether all was derived anew.
    pub anew: bool,
    /// Milliseconds that it took, waiting included.
    pub took_ms: f64,
}

/// Makes an edit for a caller.
pub async fn make(site: &Site, caller: &Caller, edit: Edit, why: String) -> Answered<Edited> {
    let began = Instant::now();
    let author = Author { who: caller.name.clone(), why };
    let wanted = edit.clone();
    let edited = site.edit_at_desk(move |desk| {
        let outcome = desk.edit(&edit, &author, |outcome| words(&edit, outcome))?;
        Ok(Edited {
            generation: outcome.generation,
            layout: desk.live.view().layout().to_owned(),
            rooms: outcome.rooms,
            doors: outcome.doors,
            anew: outcome.anew,
            done: outcome.done,
            took_ms: 0.0,
        })
    });
    match edited.await {
        Ok(edited) => Ok(Edited { took_ms: began.elapsed().as_secs_f64() * 1e3, ..edited }),
        Err(fault) => Err(with_current(site, &wanted, fault).await),
    }
}

/// Adds to a conflict what is there now.
async fn with_current(site: &Site, edit: &Edit, mut fault: Fault) -> Fault {
    if let Edit::SetFrom(cell, ..) = edit
        && fault.code == Code::EditConflict
    {
        let [table, key, column] = cell.clone();
        let present = site.read(move |tx| Ok(tx.cell(&table, &key, &column)?)).await;
        fault.current = present.ok().map(|present| Box::new(serde_json::json!(present)));
    }
    fault
}

/// Makes an edit: one transaction with all that follows from it, kept in the history with who and why.
#[utoipa::path(post, path = "/api/edits", tag = "tables", security(("token" = [])), request_body = EditBody,
    responses((status = 200, body = Edited), (status = 409, description = "the cell holds another value by now", body = Failure), (status = "4XX", body = Failure)))]
pub async fn edit(site: Site, caller: Caller, Body(body): Body<EditBody>) -> Answered<Json<Edited>> {
    require(&caller, body.edit.role())?;
    make(&site, &caller, body.edit.edit()?, body.why.unwrap_or_default()).await.map(Json)
}

/// Edits that are tried.
#[derive(Debug, Deserialize, ToSchema)]
#[serde(deny_unknown_fields)]
pub struct PreviewBody {
    /// The edits, in this order.
    edits: Vec<Wish>,
    /// A route to show beside it: from a place, a room or `x,y`.
    #[serde(default)]
    start: Option<String>,
    /// Where to.
    #[serde(default)]
    goal: Option<String>,
    /// Whose.
    #[serde(default)]
    robot: Option<String>,
    /// Milliseconds in which routes between places are compared, at most 10,000; what is not compared by then is said.
    #[serde(default)]
    patience_ms: Option<u64>,
}

/// What edits would change; nothing is saved.
#[utoipa::path(post, path = "/api/preview", tag = "tables", security(("token" = [])), request_body = PreviewBody,
    responses((status = 200, body = Preview), (status = "4XX", body = Failure)))]
pub async fn preview(site: Site, Body(body): Body<PreviewBody>) -> Answered<Json<Preview>> {
    if body.edits.len() > PREVIEWED {
        return Err(Fault::new(Code::ServiceTooMany, format!("a preview holds up to {PREVIEWED} edits")));
    }
    let edits = body.edits.iter().map(Wish::edit).collect::<Answered<Vec<Edit>>>()?;
    let mut fork = site.fork().await?;
    if let Some(patience) = body.patience_ms {
        fork = fork.with_patience(Duration::from_millis(patience.min(PATIENCE_MS)));
    }
    let preview = site.at_length(move || {
        let route = body.start.as_deref().zip(body.goal.as_deref());
        let wanted = route.map(|(start, goal)| Wanted { start, goal, robot: body.robot.as_deref() });
        fork.preview(&edits, wanted)
    });
    preview.await.map(Json)
}
