//! Edits, and what they would change.

use std::collections::BTreeMap;
use std::path::Path;
use std::time::{Duration, Instant};

use adit_db::history::Author;
use axum::Json;
use base64::Engine;
use base64::prelude::BASE64_STANDARD;
use serde::de::Error as _;
use serde::{Deserialize, Deserializer, Serialize};
use utoipa::ToSchema;

use super::extract::{Body, Site};
use super::trial::{self, TestsOf};
use crate::edit::{Close, Done, Edit, Lay, Tell, Thing, Write};
use crate::error::Code;
use crate::preview::{Preview, Wanted};
use crate::serve::fault::{Answered, Failure, Fault};
use crate::serve::gate::require;
use crate::serve::role::{Caller, Role};
use crate::site::sheet::Sheet;

/// The longest that routes between places are compared.
const PATIENCE_MS: u64 = 10_000;

/// Edits that may be previewed or made together.
const TOGETHER: usize = 1_000;

/// Files that may be among them: what each unpacks to is held in memory.
const FILES: usize = 8;

/// Bytes that a file unpacks to at most.
const UNPACKED: u64 = 32 << 20;

/// A value as JSON has it: a number, a text, a truth value, or null for none.
#[derive(Debug, Deserialize)]
#[serde(untagged, expecting = "expected a number, a text, true, false or null")]
pub enum Scalar {
    Truth(bool),
    Number(serde_json::Number),
    Text(String),
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
#[derive(Debug, Deserialize, ToSchema)]
#[serde(tag = "kind", rename_all = "snake_case", deny_unknown_fields)]
pub enum Wish {
    Set {
        table: String,
        key: String,
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
        table: String,
        key: String,
        /// Values of the other columns.
        #[serde(default)]
        #[schema(value_type = std::collections::BTreeMap<String, serde_json::Value>)]
        cells: std::collections::BTreeMap<String, Scalar>,
    },
    /// A row that goes.
    Remove { table: String, key: String },
    /// A table whose rows are those of a file from now on; columns that the file has not stay as they are.
    Take {
        table: String,
        /// The name of the file, which says what it is: `orders.csv`, `orders.xlsx`.
        file: String,
        /// What it holds, of a file of text.
        #[serde(default)]
        text: Option<String>,
        /// The same in Base64, of any file.
        #[serde(default)]
        base64: Option<String>,
        /// The version of the table that the editor sees: if it has another one by now, the edit is refused.
        #[serde(default)]
        version: Option<String>,
    },
    Tell {
        /// The class, as `DOORS`.
        class: String,
        /// The object: its name, `door 7`, `room d` or `x,y`.
        object: String,
        property: String,
        #[schema(value_type = serde_json::Value)]
        value: Scalar,
        /// When it ends: `18:00`, `2h`, `2026-11-21T18:00:00Z`.
        #[serde(default)]
        until: Option<String>,
        /// After how many seconds it ends, instead.
        #[serde(default)]
        for_seconds: Option<u32>,
    },
    /// Nobody passes a doorway, a named door, an area or a space from now on.
    Close {
        /// Its name; or a point `x,y`, with the heading of a robot that was blocked there: `x,y@90`.
        what: String,
        /// The robots that are kept out, one at least; all where this is not said.
        #[serde(default, deserialize_with = "some_names")]
        only: Vec<String>,
        /// The robots that come through all the same, one at least.
        #[serde(default, deserialize_with = "some_names")]
        except: Vec<String>,
        /// The space from which nobody passes the doorway; the other way it stays open.
        #[serde(default)]
        from: Option<String>,
        /// When it ends: `18:00`, `2h`, `2026-11-21T18:00:00Z`.
        #[serde(default)]
        until: Option<String>,
        /// After how many seconds it ends, instead.
        #[serde(default)]
        for_seconds: Option<u32>,
    },
    /// What was closed is open again.
    Open { what: String },
    /// An area, an obstacle or a place that lies over the map from now on.
    Lay(LaidBody),
    /// What no longer lies over the map.
    Lift { name: String },
    /// A fact that is no longer told.
    Retract { fact: i64 },
    /// A cell of a named tuning.
    SetInTuning {
        tuning: String,
        table: String,
        key: String,
        column: String,
        /// The value while the tuning is on.
        #[schema(value_type = serde_json::Value)]
        value: Scalar,
    },
    /// A cell of a named tuning that goes.
    UnsetInTuning { tuning: String, table: String, key: String, column: String },
    /// A named tuning, switched on or off.
    Switch {
        tuning: String,
        /// Whether it is on from now on.
        on: bool,
    },
    /// A rule file or a test of rules with another text: `doors.rhai`, `tests/doors.toml`.
    Write {
        file: String,
        /// The text from now on; null for a file that goes.
        text: Option<String>,
        /// The version that was read before; null for a file that is new.
        #[serde(default)]
        version: Option<String>,
    },
    /// An entry of the history, taken back.
    Undo {
        /// Its number; the latest one without.
        #[serde(default)]
        edit: Option<i64>,
    },
    /// Several edits in one transaction, which are taken back together.
    Together {
        /// In this order; at most 1,000.
        #[schema(no_recursion)]
        edits: Vec<Wish>,
    },
}

impl Wish {
    fn is_file(&self) -> bool {
        matches!(self, Self::Take { .. })
    }

    /// The roles that it takes.
    fn roles(&self) -> Vec<Role> {
        match self {
            Self::Tell { .. }
            | Self::Close { .. }
            | Self::Open { .. }
            | Self::Lay(_)
            | Self::Lift { .. }
            | Self::Retract { .. } => vec![Role::Tell],
            Self::Write { .. } => vec![Role::Rules],
            Self::Together { edits } => roles(edits),
            _ => vec![Role::Tune],
        }
    }

    pub fn edit(self) -> Answered<Edit> {
        Ok(match self {
            Self::Set { table, key, column, value, old: Some(old) } => {
                Edit::SetFrom([table, key, column], old.cell(), value.cell())
            }
            Self::Set { table, key, column, value, old: None } => Edit::Set(table, key, column, value.cell()),
            Self::Add { table, key, cells } => Edit::Add(
                table,
                key,
                cells.into_iter().map(|(column, value)| (column, value.cell())).collect(),
            ),
            Self::Remove { table, key } => Edit::Remove(table, key),
            Self::Take { table, file, text, base64, version } => {
                let bytes = match (text, base64) {
                    (Some(text), None) => text.into_bytes(),
                    (None, Some(coded)) => BASE64_STANDARD.decode(coded).map_err(|error| {
                        Fault::new(Code::EditUsage, format!("`base64` is not Base64: {error}"))
                    })?,
                    _ => {
                        let message = "what the file holds is in `text` or in `base64`, in one of them";
                        return Err(Fault::new(Code::EditUsage, message));
                    }
                };
                Edit::Table(table, Sheet::of(Path::new(&file), bytes, UNPACKED)?, version)
            }
            Self::Tell { until: Some(_), for_seconds: Some(_), .. }
            | Self::Close { until: Some(_), for_seconds: Some(_), .. } => {
                let message = "a fact ends at `until` or after `for_seconds`, not both";
                return Err(Fault::new(Code::TellUsage, message));
            }
            Self::Tell { class, object, property, value, until, for_seconds } => {
                let until = until.or(for_seconds.map(|seconds| format!("{seconds} seconds")));
                let value = value.text();
                Edit::Tell(Tell { class, object, property, value, until, new_property: false })
            }
            Self::Close { what, only, except, from, until, for_seconds } => {
                let until = until.or(for_seconds.map(|seconds| format!("{seconds} seconds")));
                Edit::Close(Close { what, until, only, except, from })
            }
            Self::Open { what } => Edit::Open(what),
            Self::Lay(LaidBody { until: Some(_), for_seconds: Some(_), .. }) => {
                let message = "it ends at `until` or after `for_seconds`, not both";
                return Err(Fault::new(Code::TellUsage, message));
            }
            Self::Lay(LaidBody { what, name, corners, mut properties, until, for_seconds }) => {
                let kind = properties.remove("kind").map(|kind| kind.text());
                properties.retain(|_, value| !matches!(value, Scalar::None(())));
                let what = match what {
                    LaidThing::Area => Thing::Area,
                    LaidThing::Obstacle => Thing::Obstacle,
                    LaidThing::Place => Thing::Place,
                    LaidThing::Bridge => Thing::Bridge,
                    LaidThing::Door => Thing::Door,
                };
                let until = until.or(for_seconds.map(|seconds| format!("{seconds} seconds")));
                let properties = properties.into_iter().map(|(name, value)| (name, value.text())).collect();
                Edit::Lay(Lay { what, name, corners, kind, properties, until })
            }
            Self::Lift { name } => Edit::Lift(name),
            Self::Retract { fact } => Edit::Retract(fact),
            Self::SetInTuning { tuning, table, key, column, value } => {
                Edit::SetInTuning(tuning, [table, key, column, value.cell()])
            }
            Self::UnsetInTuning { tuning, table, key, column } => {
                Edit::UnsetInTuning(tuning, [table, key, column])
            }
            Self::Switch { tuning, on } => Edit::Switch(tuning, on),
            Self::Write { file, text, version } => Edit::Write(Write { file, text, seen: version }),
            Self::Undo { edit } => Edit::Undo(edit),
            Self::Together { edits } => Edit::Together(all(edits)?),
        })
    }
}

/// The roles that edits take together.
fn roles(edits: &[Wish]) -> Vec<Role> {
    let mut roles: Vec<Role> = edits.iter().flat_map(Wish::roles).collect();
    roles.sort_unstable();
    roles.dedup();
    roles
}

fn all(edits: Vec<Wish>) -> Answered<Vec<Edit>> {
    if edits.len() > TOGETHER {
        return Err(Fault::new(Code::ServiceTooMany, format!("up to {TOGETHER} edits go together")));
    }
    if edits.iter().filter(|edit| edit.is_file()).count() > FILES {
        return Err(Fault::new(Code::ServiceTooMany, format!("up to {FILES} files go together")));
    }
    edits.into_iter().map(Wish::edit).collect()
}

/// An area, an obstacle, a place, a bridge or a named door that people lay over the map.
#[derive(Debug, Deserialize, ToSchema)]
#[serde(deny_unknown_fields)]
pub struct LaidBody {
    #[serde(default)]
    pub(super) what: LaidThing,
    pub(super) name: String,
    /// `[x, y]` in metres, in the order in which they follow one another; two are those of a rectangle or the posts of a door, and one is a
    /// place.
    pub(super) corners: Vec<[f64; 2]>,
    /// What is said of an area or a door, and the `height` of a bridge; `kind` is what it is: `wet`, `keep-out`.
    #[serde(default)]
    #[schema(value_type = std::collections::BTreeMap<String, serde_json::Value>)]
    pub(super) properties: BTreeMap<String, Scalar>,
    /// When it ends: `18:00`, `2h`, `2026-11-21T18:00:00Z`.
    #[serde(default)]
    pub(super) until: Option<String>,
    /// After how many seconds it ends, instead.
    #[serde(default)]
    pub(super) for_seconds: Option<u32>,
}

#[derive(Clone, Copy, Debug, Default, Deserialize, ToSchema)]
#[serde(rename_all = "lowercase")]
pub enum LaidThing {
    /// A part of the floor with a name, of which rules speak.
    #[default]
    Area,
    /// Something that no robot comes through.
    Obstacle,
    /// A named point, from and to which ways lead.
    Place,
    /// Something to pass under, a rectangle along the axes; its `height` in metres stands among the properties.
    Bridge,
    /// A doorway with a name, from post to post.
    Door,
}

#[derive(Debug, Deserialize, ToSchema)]
#[serde(deny_unknown_fields)]
pub struct EditBody {
    edit: Wish,
    #[serde(default)]
    why: Option<String>,
}

#[derive(Debug, Serialize, ToSchema)]
pub struct Edited {
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
    /// What rules that react told, in sentences.
    pub reacted: Vec<String>,
    /// What it leaves as one may not expect it, in sentences: what is closed for longer, or passed all the same.
    pub remarks: Vec<String>,
    /// What the tests of the rules gave, where rule files are others.
    pub tests: Option<TestsOf>,
    /// Milliseconds that it took, waiting included.
    pub took_ms: f64,
}

pub async fn make(site: &Site, caller: &Caller, edit: Edit, why: String) -> Answered<Edited> {
    let began = Instant::now();
    let author = Author { who: caller.name.clone(), why };
    let (wanted, caller) = (edit.clone(), caller.clone());
    let edited = site.edit_at_desk(move |desk| {
        let folder = desk.live.site().rule_folder();
        let tests = trial::tried(desk, &caller, &edit)?;
        let outcome = desk.edit(&edit, &author).map_err(|error| trial::refused(error, &folder))?;
        Ok(Edited {
            generation: outcome.generation,
            layout: desk.live.view().layout().to_owned(),
            rooms: outcome.rooms,
            doors: outcome.doors,
            anew: outcome.anew,
            reacted: outcome.reacted,
            remarks: outcome.remarks,
            done: outcome.done,
            tests,
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
#[utoipa::path(post, path = "/api/edits", tag = "tables", request_body = EditBody,
    responses((status = 200, body = Edited), (status = 409, description = "the cell, the table or the file is another by now", body = Failure)))]
pub async fn edit(site: Site, caller: Caller, Body(body): Body<EditBody>) -> Answered<Json<Edited>> {
    body.edit.roles().into_iter().try_for_each(|role| require(&caller, role))?;
    let wish = body.edit;
    let edit = site.beside(move || wish.edit()).await?;
    make(&site, &caller, edit, body.why.unwrap_or_default()).await.map(Json)
}

/// Names of robots. None is no way to say all: whoever has picked robots and found none would close to everybody.
fn some_names<'de, D: Deserializer<'de>>(given: D) -> Result<Vec<String>, D::Error> {
    let names = Vec::<String>::deserialize(given)?;
    if names.is_empty() {
        return Err(D::Error::custom(
            "expected the name of one robot at least; without the list it is for all",
        ));
    }
    Ok(names)
}

/// Where a robot is that cannot go on.
#[derive(Debug, Deserialize, ToSchema)]
#[serde(deny_unknown_fields)]
pub struct BlockedBody {
    /// Where its middle is, metres, in the map's frame.
    x: f64,
    y: f64,
    /// Where it was to go, degrees counterclockwise from +x.
    heading: f64,
    /// The robots for which it is blocked, one at least; all where this is not said.
    #[serde(default, deserialize_with = "some_names")]
    only: Vec<String>,
    /// The robots that come through all the same, one at least.
    #[serde(default, deserialize_with = "some_names")]
    except: Vec<String>,
    /// When the way is free again: `18:00`, `2h`, `2026-11-21T18:00:00Z`; somebody opens it where neither this nor `for_seconds`
    /// is said.
    #[serde(default)]
    until: Option<String>,
    /// After how many seconds, instead.
    #[serde(default)]
    for_seconds: Option<u32>,
    #[serde(default)]
    why: Option<String>,
}

/// Closes the doorway ahead of a robot that is blocked, or, where none is near, the cross-section there. The same as the edit
/// `close` of `x,y@heading`.
#[utoipa::path(post, path = "/api/blocked", tag = "tables", request_body = BlockedBody,
    responses((status = 200, body = Edited)))]
pub async fn blocked(site: Site, caller: Caller, Body(body): Body<BlockedBody>) -> Answered<Json<Edited>> {
    let BlockedBody { x, y, heading, only, except, until, for_seconds, why } = body;
    let wish =
        Wish::Close { what: format!("{x},{y}@{heading}"), only, except, from: None, until, for_seconds };
    wish.roles().into_iter().try_for_each(|role| require(&caller, role))?;
    make(&site, &caller, wish.edit()?, why.unwrap_or_default()).await.map(Json)
}

#[derive(Debug, Deserialize, ToSchema)]
#[serde(deny_unknown_fields)]
pub struct PreviewBody {
    /// The edits, in this order.
    edits: Vec<Wish>,
    /// A route to show beside it: from a place, a space, a room or `x,y`.
    #[serde(default)]
    start: Option<String>,
    #[serde(default)]
    goal: Option<String>,
    #[serde(default)]
    robot: Option<String>,
    /// Metres by which a start or goal at which no state fits may be moved, to the nearest point at which one does.
    #[serde(default)]
    within: Option<f64>,
    /// Milliseconds in which routes between places are compared, at most 10,000, or as long as all before that took, where that
    /// is longer; what is not compared by then is said. With 0 none are.
    #[serde(default)]
    patience_ms: Option<u64>,
}

/// What edits would change; nothing is saved. With rule files it takes the role `rules`: what is tried runs.
#[utoipa::path(post, path = "/api/preview", tag = "tables", request_body = PreviewBody,
    responses((status = 200, body = Preview)))]
pub async fn preview(site: Site, caller: Caller, Body(body): Body<PreviewBody>) -> Answered<Json<Preview>> {
    if roles(&body.edits).contains(&Role::Rules) {
        require(&caller, Role::Rules)?;
    }
    if body.edits.iter().any(Wish::is_file) {
        require(&caller, Role::Tune)?;
    }
    let wishes = body.edits;
    let edits = site.beside(move || all(wishes)).await?;
    let folder = site.view.load().view.site().rule_folder();
    let preview = site.on_fork(move |fork| {
        let mut fork = fork.within(body.within)?;
        if let Some(patience) = body.patience_ms {
            fork = fork.with_patience(Duration::from_millis(patience.min(PATIENCE_MS)));
        }
        let route = body.start.as_deref().zip(body.goal.as_deref());
        let wanted = route.map(|(start, goal)| Wanted { start, goal, robot: body.robot.as_deref() });
        fork.preview(&edits, wanted)
    });
    let mut preview = preview.await.map_err(|fault| trial::placed(fault, &folder))?;
    if let Some(rules) = &mut preview.rules {
        for failure in &mut rules.failures {
            trial::place(failure, &folder);
        }
    }
    Ok(Json(preview))
}
