//! What changed in the experience, in order, so that whoever keeps it writes just that.

use super::clearance::Clearance;
use super::experience::{Edge, EdgeId, Vertex, VertexId};
use super::judge::{ChangeFacts, Strategy};
use super::robot::Configuration;
use super::workcell::Revision;

/// One change of the experience or of what it is about.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum Noted {
    VertexAdded(Vertex),
    /// A subgoal went along with its object.
    VertexMoved {
        id: VertexId,
        at: Configuration,
    },
    /// A subgoal was taken out, after its edges.
    VertexRemoved {
        id: VertexId,
        why: Removal,
        task: u32,
    },
    EdgeAdded(Edge),
    /// A connection was verified again, or found another path: it is now as told.
    EdgeVerified(Edge),
    /// Nothing is known any more of a connection, since an end of it moved: it is now as told.
    EdgeLoosened(Edge),
    EdgeRemoved {
        id: EdgeId,
        ends: (VertexId, VertexId),
        why: Removal,
        task: u32,
        revision: Revision,
        /// The object that is in its way, where that is known.
        object: Option<String>,
    },
    /// A shortcut was tried between two vertices and is not free in this state of the cell.
    CutRefused {
        /// Its ends, the lower number first.
        ends: (VertexId, VertexId),
        revision: Revision,
    },
    /// The path between two vertices was tightened, and is not again in this state of the cell.
    Tightened {
        /// Its ends, the lower number first.
        ends: (VertexId, VertexId),
        revision: Revision,
    },
    /// An evaluation taught something about an object.
    Learned {
        object: String,
        clearance: Clearance,
    },
    /// Nothing is known any more of an object, since it has another shape or is gone.
    ClearancesForgotten {
        object: String,
    },
    /// An object came, went or changed.
    ObjectChanged {
        object: String,
        how: ObjectChange,
        /// The state of the cell from now on.
        revision: Revision,
    },
    /// The judge was asked what becomes of the experience.
    StrategyChosen {
        facts: Box<ChangeFacts>,
        strategy: Strategy,
    },
    /// All experience was forgotten: vertices, edges, clearances. Each of them is out; no other note says so.
    Forgotten,
    /// The robot is somewhere else, next to a vertex where one is told.
    Stands {
        at: Configuration,
        /// A vertex that Reach connects with it (the paper's u with a hat).
        vertex: Option<VertexId>,
    },
}

/// How an object changed. One that has another shape and was moved, too, counts as reshaped.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ObjectChange {
    Appeared,
    Gone,
    /// It was moved or turned.
    Moved,
    Reshaped,
}

/// Why something was taken out of the graph.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum Removal {
    /// Reach cannot follow it any more.
    Broken,
    GivenUp,
    /// The check before execution found it in collision.
    Refused,
    /// It hangs on nothing that the robot reaches (A1's home component; step 3 of T).
    CutOff,
    LandmarkGone,
    /// Its object was moved to where the robot cannot follow.
    OutOfReach,
    VertexRemoved,
    /// The robot's limits no longer admit it.
    BeyondLimits,
}
