//! What a robot met on a mission, in sentences.

use adit_db::mission::Happened;
use serde::Serialize;
use serde_json::Value;

use crate::words::number::{counted, number};

/// Something that happened, and how often it did, one time after the other.
#[derive(Clone, Debug, Serialize)]
pub struct Chapter {
    /// The first time, seconds by the robot's clock.
    pub time: f64,
    pub text: String,
    pub times: usize,
}

impl Chapter {
    pub fn line(&self) -> String {
        let times = if self.times == 1 { String::new() } else { format!(" ({} times)", self.times) };
        format!("  {:>6.1} s  {}{times}", self.time, self.text)
    }
}

/// What of a journal people want to know.
pub fn told(happened: &[Happened]) -> Vec<Chapter> {
    let mut chapters: Vec<Chapter> = Vec::new();
    for (time, event, detail) in happened {
        let detail = detail.as_deref().and_then(|detail| serde_json::from_str(detail).ok());
        let Some(text) = sentence(event, &detail.unwrap_or(Value::Null)) else { continue };
        match chapters.last_mut() {
            Some(last) if last.text == text => last.times += 1,
            _ => chapters.push(Chapter { time: *time, text, times: 1 }),
        }
    }
    chapters
}

/// What happened, as far as people want to know it.
pub fn sentence(event: &str, detail: &Value) -> Option<String> {
    let metres = |of: &str| detail[of].as_f64().map(number);
    match event {
        "doorways closed" => {
            let all: Vec<String> = detail["doorways"].as_array()?.iter().map(Value::to_string).collect();
            Some(match &all[..] {
                [] => "rules let it through every doorway again".to_owned(),
                [one] => format!("rules let nobody through doorway {one}"),
                all => format!("rules let nobody through doorways {}", all.join(", ")),
            })
        }
        "contact" => Some(format!("it touched something {}", side(detail["bearing"].as_f64()?))),
        "detour" => Some(format!("something stood in its way; it went around it, {} m", metres("length")?)),
        "way closed" => {
            let at = place(&detail["at"])?;
            let what = match (detail["doorway"].as_u64(), detail["region"].as_u64()) {
                (Some(doorway), _) => format!("doorway {doorway} at {at}"),
                (None, Some(region)) => format!("region {region} at {at}"),
                (None, None) => format!("its way at {at}"),
            };
            Some(format!("it found {what} blocked, and looked for another way"))
        }
        "planned" if detail["off_network"] == true => {
            Some("the doorways as planned led nowhere; it went on through what was free".to_owned())
        }
        "located" if detail["anywhere"] == true => {
            let poses = detail["poses"].as_array()?;
            Some(match &poses[..] {
                [only] => format!("it was not where it thought, and found itself at {}", place(only)?),
                all => format!("it was not where it thought, and could be at {} places", all.len()),
            })
        }
        "sought" => {
            Some(format!("unsure where it was, it set out to {}, where walls tell", place(&detail["at"])?))
        }
        "told" => {
            let things = |of: &str| detail[of].as_u64().filter(|count| *count > 0);
            let things = |of: &str| things(of).map(|count| counted(count as usize, "thing"));
            Some(match (things("laid"), things("lifted")) {
                (Some(laid), None) => format!("it told the site of {laid} that it met"),
                (None, lifted) => format!("it told the site that {} stood there no longer", lifted?),
                (Some(laid), Some(lifted)) => {
                    format!("it told the site of {laid} that it met, and that {lifted} stood there no longer")
                }
            })
        }
        "heard" if detail["other_way"] == true => {
            Some("others changed what ways there are, and it took another one".to_owned())
        }
        "silent" => Some(format!("it was not heard any more: {}", detail["why"].as_str()?)),
        "begun anew" => Some("it forgot what it had met, and looked again".to_owned()),
        _ => None,
    }
}

/// A place of a list of numbers that begins with its coordinates.
fn place(at: &Value) -> Option<String> {
    let at = at.as_array()?;
    Some(format!("({:.2}, {:.2})", at.first()?.as_f64()?, at.get(1)?.as_f64()?))
}

/// Where a bearing points to, degrees counterclockwise from ahead.
fn side(bearing: f64) -> &'static str {
    match bearing.rem_euclid(360.0) {
        of if of <= 45.0 || of >= 315.0 => "ahead",
        of if of < 135.0 => "on its left",
        of if of <= 225.0 => "behind it",
        _ => "on its right",
    }
}
