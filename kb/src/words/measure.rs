//! What a route takes, in words.

use adit_db::measure::{Measure, Measures};

use super::number::number;

/// `1 min 20 s, 4.2 kJ, risk 0.3`: times and energies first, in the order of their names; `None` where nothing is known.
pub fn taken(measures: &Measures, all: &[Measure]) -> Option<String> {
    let known = all.iter().filter_map(|of| Some((of, *measures.0.get(&of.measure)?)));
    let mut said: Vec<(usize, String)> = known
        .map(|(of, amount)| match of.unit.as_str() {
            "s" => (0, time(amount)),
            "J" => (1, energy(amount)),
            "" => (2, format!("{} {}", of.measure, number(amount))),
            unit => (2, format!("{} {} {unit}", of.measure, number(amount))),
        })
        .collect();
    said.sort_by_key(|(rank, _)| *rank);
    let said: Vec<String> = said.into_iter().map(|(_, text)| text).collect();
    (!said.is_empty()).then(|| said.join(", "))
}

/// A time as people say it.
pub fn time(seconds: f64) -> String {
    if seconds < 10.0 {
        return format!("{} s", short(seconds));
    }
    let seconds = seconds.round();
    let (minutes, rest) = ((seconds / 60.0).floor(), seconds % 60.0);
    let and = |rest: f64, unit: &str| if rest > 0.0 { format!(" {rest:.0} {unit}") } else { String::new() };
    if minutes < 1.0 {
        format!("{rest:.0} s")
    } else if minutes < 60.0 {
        format!("{minutes:.0} min{}", and(rest, "s"))
    } else {
        format!("{:.0} h{}", (minutes / 60.0).floor(), and(minutes % 60.0, "min"))
    }
}

fn energy(joules: f64) -> String {
    match joules {
        joules if joules >= 1e6 => format!("{} MJ", short(joules / 1e6)),
        joules if joules >= 1e3 => format!("{} kJ", short(joules / 1e3)),
        joules => format!("{} J", short(joules)),
    }
}

/// To a tenth below a hundred, without one that says nothing.
fn short(amount: f64) -> String {
    if amount >= 100.0 { format!("{amount:.0}") } else { number((amount * 10.0).round() / 10.0) }
}

#[cfg(test)]
mod tests {
    use super::{energy, time};

    #[test]
    fn times_and_energies_are_said_as_people_say_them() {
        for (seconds, text) in [
            (0.25, "0.3 s"),
            (9.96, "10 s"),
            (59.7, "1 min"),
            (80.2, "1 min 20 s"),
            (3_600.0, "1 h"),
            (7_290.0, "2 h 1 min"),
        ] {
            assert_eq!(time(seconds), text);
        }
        for (joules, text) in [(0.0, "0 J"), (412.6, "413 J"), (4_200.0, "4.2 kJ"), (1_250_000.0, "1.3 MJ")] {
            assert_eq!(energy(joules), text);
        }
    }
}
