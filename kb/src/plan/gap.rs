//! What a world asks for as the gap at its junctions.

use std::fmt;

use adit_planners::read::{Fields, Problem};
use toml::Spanned;
use toml::de::DeValue;

/// The gap that is asked for: `N` numbers, one an axis.
#[derive(Clone, Debug, PartialEq)]
pub enum Asked<const N: usize> {
    /// These, in metres.
    Gap([f64; N]),
    /// The largest that there is.
    Safest,
    /// What rules conclude from facts about part, junction and time.
    Rules,
}

/// As people write it: `gap 0.2`, `gap 0.1/0.2`, `safest gap`, `gap by rules`.
impl<const N: usize> fmt::Display for Asked<N> {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Gap(gap) if gap.iter().all(|one| one.to_bits() == gap[0].to_bits()) => {
                write!(out, "gap {}", gap[0])
            }
            Self::Gap(gap) => {
                let gaps: Vec<String> = gap.iter().map(ToString::to_string).collect();
                write!(out, "gap {}", gaps.join("/"))
            }
            Self::Safest => out.write_str("safest gap"),
            Self::Rules => out.write_str("gap by rules"),
        }
    }
}

impl<const N: usize> Asked<N> {
    /// As rules see it.
    pub const fn word(&self) -> &'static str {
        match self {
            Self::Gap(_) => "gap",
            Self::Safest => "safest",
            Self::Rules => "rules",
        }
    }

    /// Along an axis, in metres, where it is given.
    pub const fn along(&self, axis: usize) -> Option<f64> {
        match self {
            Self::Gap(gap) => Some(gap[axis]),
            Self::Safest | Self::Rules => None,
        }
    }

    /// As people write it, on the command line.
    pub fn parse(text: &str) -> Result<Self, String> {
        match text {
            "safest" => return Ok(Self::Safest),
            "rules" => return Ok(Self::Rules),
            _ => {}
        }
        let numbers: Option<Vec<f64>> = text.split('/').map(|part| part.trim().parse().ok()).collect();
        numbers
            .and_then(|numbers| Self::of(&numbers))
            .ok_or_else(|| format!("`{text}` is {}", Self::wanted()))
    }

    fn of(numbers: &[f64]) -> Option<Self> {
        if numbers.iter().any(|number| !number.is_finite()) {
            return None;
        }
        match numbers {
            [one] => Some(Self::Gap([*one; N])),
            all => all.try_into().ok().map(Self::Gap),
        }
    }

    fn wanted() -> String {
        let list = if N > 1 { format!(", {N} of them, one an axis") } else { String::new() };
        format!("no gap: a number of metres{list}, `safest` or `rules`")
    }

    /// The key `gap` of a table; where it is missing, rules choose.
    pub(super) fn read(fields: &Fields<'_, '_>, problems: &mut Vec<Problem>) -> Self {
        fields.get("gap").and_then(|value| Self::value(fields, value, problems)).unwrap_or(Self::Rules)
    }

    fn value(
        fields: &Fields<'_, '_>,
        value: &Spanned<DeValue<'_>>,
        problems: &mut Vec<Problem>,
    ) -> Option<Self> {
        let wrong = |problems: &mut Vec<Problem>| {
            let wanted = if N > 1 {
                "a number, a list with a number for each axis, \"safest\" or \"rules\""
            } else {
                "a number, \"safest\" or \"rules\""
            };
            problems.push(fields.wrong_type("gap", wanted, value.get_ref(), value.span()));
            None
        };
        match value.get_ref() {
            DeValue::String(text) => match &**text {
                "safest" => Some(Self::Safest),
                "rules" => Some(Self::Rules),
                _ => wrong(problems),
            },
            DeValue::Integer(_) | DeValue::Float(_) => {
                fields.finite("gap", value, problems).map(|gap| Self::Gap([gap; N]))
            }
            DeValue::Array(_) if N > 1 => {
                let numbers = fields.list("gap", value, problems)?;
                Self::of(&numbers).or_else(|| wrong(problems))
            }
            _ => wrong(problems),
        }
    }
}
