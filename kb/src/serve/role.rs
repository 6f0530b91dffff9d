//! What callers may do.

use serde::{Deserialize, Serialize};
use utoipa::ToSchema;

/// Something that a token may be allowed to do.
#[derive(
    Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize, ToSchema, clap::ValueEnum,
)]
#[serde(rename_all = "lowercase")]
pub enum Role {
    /// Ask for routes, tables, rules and reasons. Every token may.
    Read,
    /// Ask in SQL.
    Query,
    /// Tell facts: "door 7 is closed".
    Tell,
    /// Edit tables, undo, switch tunings, upload traversals; tell facts, too.
    Tune,
    /// Try and edit rule files.
    Rules,
    /// Everything.
    Admin,
}

pub const ALL: [Role; 6] = [Role::Read, Role::Query, Role::Tell, Role::Tune, Role::Rules, Role::Admin];
#[derive(Clone, Debug)]
pub struct Caller {
    /// By the name of the token, or as the caller says where no token is needed.
    pub name: String,
    /// What the caller may do.
    pub roles: Vec<Role>,
}

impl Caller {
    /// Whether the caller may do this.
    pub fn may(&self, role: Role) -> bool {
        let has = |role: Role| self.roles.contains(&role);
        has(Role::Admin)
            || has(role)
            || match role {
                Role::Read => true,
                Role::Tell => has(Role::Tune),
                _ => false,
            }
    }

    /// All that the caller may do.
    pub fn allowed(&self) -> Vec<Role> {
        ALL.into_iter().filter(|role| self.may(*role)).collect()
    }
}
