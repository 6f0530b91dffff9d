//! What takes over beyond an end of what is firm.

use serde::Serialize;

use crate::error::Result;
use crate::state::tunable::{Lever, Side};
use crate::why::contrast::same_way::SameWay;
use crate::why::contrast::{End, Takeover, actions, instead};
use crate::why::probe::{Probe, Prober};

/// What takes over beyond an end.
#[derive(Clone, Debug, PartialEq, Serialize, utoipa::ToSchema)]
pub struct Beyond {
    /// What the route costs at the end; `null` where it has no way there.
    pub cost_at_end: Option<f64>,
    /// The other way, in words.
    pub way: String,
    /// The first room or door where it leaves the present way.
    pub route_differs_at: Option<String>,
}

impl Beyond {
    /// What is beyond an end.
    pub(super) fn new(
        prober: &mut Prober,
        same: &SameWay,
        lever: &Lever,
        (end, side): (&End, Side),
    ) -> Result<Self> {
        let cost = match prober.at(lever, end.at)? {
            Probe::Weighs(weights) if end.is_closed => same.driven_cost(&weights),
            Probe::Weighs(weights) => Some(same.path.cost(&weights)).filter(|cost| cost.is_finite()),
            Probe::CutAnew | Probe::Refused => None,
        };
        let (way, at) = match &end.beyond {
            Takeover::Way(path, _) => {
                let present = actions(prober, &same.path);
                // a little beyond, so that what it does there is what it does
                let hair = end.at.abs().max(1e-6) * 1e-9;
                prober.at(lever, if side == Side::Above { end.at + hair } else { end.at - hair })?;
                let other = actions(prober, path);
                instead(prober.fork.graph(), (&same.path, &present), (path, &other))
            }
            Takeover::CutAnew => ("rooms and doors are cut anew".to_owned(), None),
            Takeover::Refused => ("rules give a hardness that does not count".to_owned(), None),
            Takeover::NoWay => ("no way is left".to_owned(), None),
        };
        Ok(Self { cost_at_end: cost, way, route_differs_at: at })
    }
}
