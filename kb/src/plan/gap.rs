//! What a world asks for at its junctions: the gap, and how the part or the load is to be handled.

use std::collections::BTreeMap;
use std::fmt;

use adit_planners::read::{Code, Fields, Problem};
use toml::Spanned;
use toml::de::DeValue;

use super::course::ObjectsOf;
use crate::error::Result;

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

    fn of(numbers: &[f64]) -> Option<Self> {
        if numbers.iter().any(|number| !number.is_finite()) {
            return None;
        }
        match numbers {
            [one] => Some(Self::Gap([*one; N])),
            all => all.try_into().ok().map(Self::Gap),
        }
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
        let read = Self::number_or_word(fields, value, problems)?;
        if let Self::Gap(gap) = &read
            && let Some(below) = gap.iter().find(|gap| **gap < 0.0)
        {
            let message =
                format!("`gap` is {below}, and a gap is what is left free: expected 0 or more metres");
            problems.push(fields.text.problem(Code::NotPositive, &value.span(), message));
            return None;
        }
        Some(read)
    }

    fn number_or_word(
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

/// What a world asks for at one junction, besides its geometry.
#[derive(Clone, Copy, Debug)]
pub struct Wishes<'a, const N: usize> {
    /// The name of what moves.
    pub mover: &'a str,
    pub gap: &'a Asked<N>,
    /// Whether the part, or the load, must not be scratched.
    pub fragile: bool,
    /// Whether time presses.
    pub hurry: bool,
}

/// What a world asks for at all of its junctions.
#[derive(Clone, Debug)]
pub struct Wanted<const N: usize> {
    /// The name of what moves.
    pub mover: String,
    pub gap: Asked<N>,
    /// Where it is another one: the number of the junction.
    pub gaps: BTreeMap<usize, Asked<N>>,
    /// Whether the part, or the load, must not be scratched.
    pub fragile: bool,
    /// Whether time presses.
    pub hurry: bool,
}

impl<const N: usize> Wanted<N> {
    /// The keys of it in a world.
    pub(super) const KEYS: [&str; 4] = ["gap", "junction", "fragile", "hurry"];

    pub(super) fn read(mover: &str, fields: &Fields<'_, '_>, problems: &mut Vec<Problem>) -> Self {
        Self {
            mover: mover.to_owned(),
            gap: Asked::read(fields, problems),
            gaps: gaps_of_junctions(fields, problems),
            fragile: flag(fields, "fragile", problems),
            hurry: flag(fields, "hurry", problems),
        }
    }

    /// What is asked for where no junction is meant.
    pub fn general(&self) -> Wishes<'_, N> {
        Wishes { mover: &self.mover, gap: &self.gap, fragile: self.fragile, hurry: self.hurry }
    }

    /// What is asked for at a junction.
    pub fn at(&self, junction: usize) -> Wishes<'_, N> {
        Wishes { gap: self.gaps.get(&junction).unwrap_or(&self.gap), ..self.general() }
    }
}

/// `[[....junction]]`: a gap of its own for one junction.
fn gaps_of_junctions<const N: usize>(
    fields: &Fields<'_, '_>,
    problems: &mut Vec<Problem>,
) -> BTreeMap<usize, Asked<N>> {
    let mut gaps = BTreeMap::new();
    for entry in fields.tables("junction", "[[junction]]", problems) {
        entry.refuse_unknown(&["number", "gap"], problems);
        let Some(number) = entry.number("number", problems) else { continue };
        if number.value.fract() != 0.0 || number.value < 1.0 {
            let message = format!("`number` is {}; junctions are numbered 1, 2, ...", number.value);
            problems.push(entry.text.problem(Code::WrongType, &number.span, message));
            continue;
        }
        let junction = number.value as usize;
        if gaps.insert(junction, Asked::read(&entry, problems)).is_some() {
            let message = format!("junction {junction} stands here twice");
            problems.push(entry.text.problem(Code::DuplicateName, &number.span, message));
        }
    }
    gaps
}

/// The gap that a row of a table asks for, in these columns and `gap_by`; the numbers count where all are given.
pub(super) fn of_row<const N: usize>(
    of: ObjectsOf<'_>,
    row: usize,
    columns: &[String; N],
) -> Result<Asked<N>> {
    let by = of.text(row, "gap_by");
    let otherwise = match by.as_deref() {
        None | Some("rules") => Asked::Rules,
        Some("safest") => Asked::Safest,
        Some(other) => return Err(of.wrong(row, "gap_by", "`rules` or `safest`", Some(other))),
    };
    let given = columns.each_ref().map(|name| of.number(row, name));
    for (name, found) in columns.iter().zip(given) {
        if let Some(found) = found.filter(|found| *found < 0.0) {
            return Err(of.wrong(row, name, "0 or more metres", Some(&found.to_string())));
        }
    }
    // one is emptied after the other: what is not given along all axes is none
    if given.iter().any(Option::is_none) {
        return Ok(otherwise);
    }
    Ok(Asked::Gap(given.map(Option::unwrap_or_default)))
}

/// The gaps that the table GAPS asks for, by junction, of which there are so many.
pub(super) fn at_junctions<const N: usize>(
    gaps: ObjectsOf<'_>,
    junctions: usize,
    columns: &[String; N],
) -> Result<BTreeMap<usize, Asked<N>>> {
    let gap = |row: usize| {
        let number = gaps.needed(row, "junction")?;
        if number < 1.0 || number > junctions as f64 || number.fract() != 0.0 {
            let expected = format!("1 to {junctions}");
            return Err(gaps.wrong(row, "junction", &expected, Some(&number.to_string())));
        }
        Ok((number as usize, of_row(gaps, row, columns)?))
    };
    gaps.rows().map(gap).collect()
}

/// Refuses gaps for junctions that a world of so many has not.
pub(super) fn refuse_beyond(junctions: usize, fields: &Fields<'_, '_>, problems: &mut Vec<Problem>) {
    // what else is wrong with the tables was said when they were read
    let said = &mut Vec::new();
    for entry in fields.tables("junction", "[[junction]]", said) {
        if let Some(number) = entry.number("number", said).filter(|number| number.value > junctions as f64) {
            let message = format!("there is no junction {}; there are {junctions}", number.value);
            problems.push(entry.text.problem(Code::Outside, &number.span, message));
        }
    }
}

/// True or false under a key; false where it is missing.
fn flag(fields: &Fields<'_, '_>, key: &str, problems: &mut Vec<Problem>) -> bool {
    fields.get(key).is_some() && fields.truth(key, problems).unwrap_or(false)
}
