//! Which parts of a picture are drawn.

use std::collections::BTreeSet;
use std::str::FromStr;

/// A part of a picture. The figures are those of Abou-Ali et al.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Layer {
    /// Ground, obstacles, bridges, places, and the scale bar.
    Map,
    /// Rooms with their names (Figure 6).
    Rooms,
    /// Doors with their numbers, by hardness.
    Doors,
    Route,
    /// The side panel: steps, actions, the scale of hardness.
    Legend,
    /// Strips (Figure 4).
    Strips,
    /// Prime areas (Figure 5).
    Primes,
    /// Rooms as nodes, doors as edges (Figure 7).
    Graph,
    /// The graph with its hardness (Figure 9).
    Weighted,
}

impl Layer {
    /// Every layer, in the order in which help texts list them.
    pub const ALL: [Self; 9] = [
        Self::Map,
        Self::Rooms,
        Self::Doors,
        Self::Route,
        Self::Legend,
        Self::Strips,
        Self::Primes,
        Self::Graph,
        Self::Weighted,
    ];

    /// Its name on the command line.
    pub fn name(self) -> &'static str {
        match self {
            Self::Map => "map",
            Self::Rooms => "rooms",
            Self::Doors => "doors",
            Self::Route => "route",
            Self::Legend => "legend",
            Self::Strips => "strips",
            Self::Primes => "primes",
            Self::Graph => "graph",
            Self::Weighted => "weighted",
        }
    }
}

/// A list of layers with a name that is none.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error(
    "there is no layer `{name}`; layers are map, rooms, doors, route, legend, strips, primes, graph, weighted"
)]
pub struct UnknownLayer {
    pub name: String,
}

/// The layers of one picture. The default shows all but the paper's figures.
///
/// Parsed from `strips,primes`; the map is always there, so that a figure stands on its ground.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Layers {
    pub shown: BTreeSet<Layer>,
    /// Where rooms belong to states: the state whose rooms are drawn. `None`: the one with the largest area, and
    /// of the others the rooms that the route uses.
    pub state: Option<String>,
}

impl Layers {
    /// The layers given, for no state in particular.
    pub fn of(layers: &[Layer]) -> Self {
        Self { shown: layers.iter().copied().collect(), state: None }
    }

    pub fn has(&self, layer: Layer) -> bool {
        self.shown.contains(&layer)
    }
}

impl Default for Layers {
    fn default() -> Self {
        Self::of(&[Layer::Map, Layer::Rooms, Layer::Doors, Layer::Route, Layer::Legend])
    }
}

impl FromStr for Layers {
    type Err = UnknownLayer;

    fn from_str(list: &str) -> Result<Self, UnknownLayer> {
        let mut layers = Self::of(&[Layer::Map]);
        for name in list.split(',').map(str::trim).filter(|name| !name.is_empty()) {
            let layer = Layer::ALL.into_iter().find(|layer| layer.name() == name);
            layers.shown.insert(layer.ok_or_else(|| UnknownLayer { name: name.to_owned() })?);
        }
        Ok(layers)
    }
}
