//! What the site's areas are to vehicles: zones, by what the map, people and rules say of each.

use std::collections::BTreeMap;

use serde_json::Value;

use super::tables::{is_true, number, text};

/// An area, with what the map, people and rules say of it.
#[derive(Clone, Debug, PartialEq)]
pub struct Area {
    pub name: String,
    /// Metres.
    pub corners: Vec<[f64; 2]>,
    said: BTreeMap<String, Value>,
}

/// What a zone asks of vehicles.
#[derive(Clone, Debug, PartialEq)]
pub enum Meaning {
    /// They do not enter it.
    Blocked,
    /// Metres per second.
    SpeedLimit(f64),
    /// How much they shun it, 0 to 1.
    Penalty(f64),
    /// How much they like it, 0 to 1.
    Priority(f64),
    /// In which direction they drive, degrees, and how strictly: SOFT, RESTRICTED or STRICT.
    Directed(f64, String),
    /// As that, or the other way round; SOFT or RESTRICTED.
    Bidirected(f64, String),
    /// They keep to the lines of their orders.
    LineGuided,
    /// What they do when they enter it, and what they may do meanwhile.
    Action(String, Option<String>),
}

impl Area {
    /// Reads what `/api/areas` answers.
    pub fn read(answer: &Value) -> Vec<Self> {
        answer["areas"].as_array().into_iter().flatten().filter_map(Self::of).collect()
    }

    fn of(area: &Value) -> Option<Self> {
        let properties = area["properties"].as_object()?.iter();
        let mut said: BTreeMap<String, Value> =
            properties.map(|(name, value)| (name.clone(), value.clone())).collect();
        said.insert("kind".to_owned(), area["kind"].clone());
        let corners = serde_json::from_value(area["corners"].clone()).ok()?;
        Some(Self { name: area["name"].as_str()?.to_owned(), corners, said })
    }

    /// How fast one drives in it who drives so fast elsewhere, metres per second; `None` where it says nothing of that.
    pub fn speed_limit(&self, own: Option<f64>) -> Option<f64> {
        let said = |property| number(&self.said, property).filter(|number| *number > 0.0);
        let share = said("speed_percent").zip(own).map(|(percent, own)| own * percent / 100.0);
        said("speed_limit").into_iter().chain(share).min_by(f64::total_cmp)
    }

    /// What it is to vehicles, where kinds of areas are such zones; `None` where it is nothing to them. A sentence where that
    /// cannot be told.
    pub fn meaning(&self, kinds: &BTreeMap<String, String>) -> Result<Option<Meaning>, String> {
        let (row, area) = (&self.said, &self.name);
        if row.get("closed").is_some_and(is_true) {
            return Ok(Some(Meaning::Blocked));
        }
        let by_kind = || text(row, "kind").and_then(|kind| kinds.get(&kind).cloned());
        let Some(zone) = text(row, "zone").or_else(by_kind) else { return Ok(None) };
        let needs = |property: &str, what: &str| {
            format!("the area `{area}` is no zone {zone}: it needs a `{property}`, {what}")
        };
        let factor = || {
            let factor = number(row, "zone_factor").filter(|factor| (0.0..=1.0).contains(factor));
            factor.ok_or_else(|| needs("zone_factor", "from 0 to 1"))
        };
        let directed = |known: &[&str]| {
            let degrees = number(row, "zone_direction").ok_or_else(|| needs("zone_direction", "degrees"))?;
            let limit = text(row, "zone_limitation").unwrap_or_else(|| "SOFT".to_owned());
            let is_known = known.contains(&limit.as_str());
            is_known.then_some((degrees, limit)).ok_or_else(|| needs("zone_limitation", &known.join(" or ")))
        };
        Ok(Some(match zone.as_str() {
            "BLOCKED" => Meaning::Blocked,
            "SPEED_LIMIT" => {
                let speed = number(row, "speed_limit").filter(|speed| *speed > 0.0);
                Meaning::SpeedLimit(speed.ok_or_else(|| needs("speed_limit", "metres per second"))?)
            }
            "PENALTY" => Meaning::Penalty(factor()?),
            "PRIORITY" => Meaning::Priority(factor()?),
            "DIRECTED" => {
                let (degrees, limit) = directed(&["SOFT", "RESTRICTED", "STRICT"])?;
                Meaning::Directed(degrees, limit)
            }
            "BIDIRECTED" => {
                let (degrees, limit) = directed(&["SOFT", "RESTRICTED"])?;
                Meaning::Bidirected(degrees, limit)
            }
            "LINE_GUIDED" => Meaning::LineGuided,
            "ACTION" => {
                let action = text(row, "zone_action");
                let action =
                    action.ok_or_else(|| needs("zone_action", "what vehicles do when they enter it"))?;
                Meaning::Action(action, text(row, "zone_blocking"))
            }
            _ => {
                return Err(format!(
                    "the area `{area}` is to be a zone `{zone}`; known are BLOCKED, SPEED_LIMIT, PENALTY, PRIORITY, DIRECTED, BIDIRECTED, LINE_GUIDED, ACTION"
                ));
            }
        }))
    }
}
