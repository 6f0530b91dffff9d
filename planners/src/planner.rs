//! What a planner is: a producer of facts. Ours and anybody's implement the same trait and are registered by
//! the same call of the knowledge base.

use crate::facts::Facts;
use crate::world::World;

/// What a planner must know before it runs, and what it asserts.
#[derive(Clone, Debug, PartialEq, Eq, Default)]
pub struct Signature {
    /// Properties as `CLASS.property` (`PRIME_AREAS.open`): from tables, other planners or rules. One that ends in `?`
    /// (`ROOMS.outline?`) is taken where somebody gives it.
    pub needs: Vec<String>,
    /// Classes it asserts whole (`DOORS`), with their properties as `CLASS.property`; those that hold no numbers say
    /// so: `ROOMS.name: text`, `DOORS.one_way: truth`.
    pub gives: Vec<String>,
}

impl Signature {
    pub fn new(needs: &[&str], gives: &[&str]) -> Self {
        let owned = |names: &[&str]| names.iter().map(|name| (*name).to_owned()).collect();
        Self { needs: owned(needs), gives: owned(gives) }
    }
}

#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum PlannerError {
    #[error("planner `{planner}`: {class}: {what}")]
    Fact { planner: String, class: String, what: String },
    #[error("planner `{planner}`: {what}")]
    World { planner: String, what: String },
}

/// A producer of facts. It reads the world and what is known, and asserts classes of objects; rules decide.
pub trait Planner: Send + Sync {
    /// The name by which messages and the database speak of it.
    fn name(&self) -> &str;

    /// What it needs and what it gives; the knowledge base runs planners and rules in the order that follows.
    fn signature(&self) -> Signature;

    /// The facts. The same world and known facts must give the same result, in the same order.
    fn facts(&self, world: &World, known: &Facts) -> Result<Facts, PlannerError>;

    /// Whether it keeps what it made, so that the next facts of a world take less. A service on a site that was built before
    /// then asks for them once, while nobody waits.
    fn keeps(&self) -> bool {
        false
    }
}
