//! What routes are found with.

use std::cell::OnceCell;

use adit_planners::world::World;

use crate::error::Result;
use crate::graph::gauge::{Gauge, Sizes};
use crate::graph::{Rules, SiteGraph};
use crate::knowledge::laid::Laid;
use crate::site::Site;

/// What routes are found with.
pub(crate) struct Basis<'a> {
    /// Its rooms and doors.
    pub graph: &'a SiteGraph,
    /// The rules' names.
    pub rules: &'a Rules,
    pub ground: Ground<'a>,
    /// How far an end may be moved to where something fits, metres; `None`: not at all.
    pub within: Option<f64>,
    /// In which state the robot starts, and in which it arrives; `None`: in whichever is cheapest.
    pub ends_in: [Option<&'a str>; 2],
    /// At which facing it starts, in degrees, where that state is longer than wide; `None`: at whichever is cheapest.
    pub start_facing: Option<f64>,
}

/// The map, with what measures clearances in it.
pub(crate) enum Ground<'a> {
    Known(&'a World, &'a Gauge),
    /// For a single question: read where it needs the map, with what lies over it, for robots of these sizes.
    Later(&'a Site, Laid, Sizes, OnceCell<Box<(World, Gauge)>>),
}

impl Ground<'_> {
    pub(super) fn get(&self) -> Result<(&World, &Gauge)> {
        match self {
            Self::Known(world, gauge) => Ok((world, gauge)),
            Self::Later(site, laid, sizes, read) => {
                if read.get().is_none() {
                    let world = laid.over(&site.world()?).0;
                    let gauge = Gauge::new(&world, sizes.clone());
                    read.get_or_init(|| Box::new((world, gauge)));
                }
                let (world, gauge) = &**read.get().expect("it was read just now");
                Ok((world, gauge))
            }
        }
    }
}

impl Basis<'_> {
    /// What judges which points fit; none where all hardness lies on the doors, and rooms are of no state.
    pub(super) fn gauge(&self) -> Result<Option<&Gauge>> {
        if self.graph.graph().is_on_doors() { Ok(None) } else { Ok(Some(self.ground.get()?.1)) }
    }
}
