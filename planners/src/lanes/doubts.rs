//! What a file probably says by mistake: words close to those that are read, and that count for nothing.

use std::collections::BTreeMap;

use serde_json::Value;

use super::{LaneGraph, Properties};

/// What is read of nodes, lanes and vehicles, in one format or another.
const READ: [&str; 24] = [
    "abs_speed_limit",
    "action",
    "bidirectional",
    "closed",
    "graph_idx",
    "is_charger",
    "is_holding_point",
    "is_parking_spot",
    "length",
    "lift_cabin",
    "loadRestriction",
    "loadSetNames",
    "maxHeight",
    "maxSpeed",
    "minHeight",
    "nodeName",
    "orientation",
    "overridable",
    "penalty",
    "rotationAllowed",
    "speed_limit",
    "trajectory",
    "unloaded",
    "loaded",
];

/// So many letters may be others in a word that was meant; shorter words are near to too many.
const SLIPS: usize = 2;
const SHORT: usize = 6;

impl LaneGraph {
    /// Says of what is most likely misspelt that nothing comes of it.
    pub(super) fn note_doubts(&mut self) {
        let mut keys: BTreeMap<&str, usize> = BTreeMap::new();
        let of_lanes = self.lanes.iter().map(|lane| &lane.properties);
        let of_others = self.nodes.iter().map(|node| &node.properties);
        for properties in of_lanes.chain(of_others).chain(self.uses.iter().map(|of| &of.properties)) {
            count(properties, &mut keys);
        }
        let meant = |key: &str| {
            let near = READ.iter().map(|read| (strsim::osa_distance(key, read), *read));
            // what is read may be kept as well
            let near = near.min().filter(|(slips, _)| (1..=SLIPS).contains(slips) && key.len() >= SHORT);
            near.map(|(_, read)| read)
        };
        let misspelt = keys.iter().filter_map(|(key, count)| {
            let read = meant(key)?;
            let times = if *count == 1 { "once".to_owned() } else { format!("{count} times") };
            Some(format!("`{key}`, which stands there {times}, is not read; did you mean `{read}`?"))
        });
        let mut notes: Vec<String> = misspelt.collect();
        let mut ways: BTreeMap<&str, usize> = BTreeMap::new();
        for way in self.lanes.iter().filter_map(|lane| lane.orientation.as_deref()) {
            let is_known = ["forward", "backward"].contains(&way) || way.parse::<f64>().is_ok();
            *ways.entry(way).or_default() += usize::from(!is_known);
        }
        let unknown = ways.iter().filter(|(_, count)| **count > 0).map(|(way, count)| {
            format!("lanes on which vehicles look `{way}`, which is neither `forward` nor `backward` nor degrees, and counts for nothing: {count}")
        });
        notes.extend(unknown);
        if self.lanes.is_empty() {
            notes.push("the file has no lanes: no route leads anywhere".to_owned());
        }
        self.notes.extend(notes);
    }
}

/// Counts the keys of properties, and of what lies in those.
fn count<'p>(properties: &'p Properties, keys: &mut BTreeMap<&'p str, usize>) {
    for (key, value) in properties {
        *keys.entry(key).or_default() += 1;
        if let Value::Object(more) = value {
            count(more, keys);
        }
    }
}
