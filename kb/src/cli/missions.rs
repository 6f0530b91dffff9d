//! What missions on floor plans and on routes have in common: which is filmed, how they are numbered, and a row for each.

use adit_db::Tx;
use adit_planners::navigation::Mission;

use super::args::SimulateArgs;
use super::output::{line, table};
use crate::error::{Code, Error, Result};
use crate::navigation::missions::{Row, Truth};
use crate::words::number::{counted, number};

/// The mission of which a film is wanted.
pub(super) fn filmed<'m>(args: &SimulateArgs, missions: &'m [Mission]) -> Result<Option<&'m Mission>> {
    if args.film.is_none() {
        return Ok(None);
    }
    let mission = args.mission.checked_sub(1).and_then(|index| missions.get(index));
    let missing =
        || format!("there is no mission {}; they are numbered 1 to {}", args.mission, missions.len());
    mission.map(Some).ok_or_else(|| Error::said(Code::SimulateNoMission, missing(), None))
}

/// The number of the last mission of a world that is kept; 0 where none is.
pub(super) fn last_mission(tx: &mut Tx<'_>, world: &str) -> Result<usize> {
    let is_there = tx.worlds_of_missions()?.iter().any(|known| known == world);
    Ok(if is_there { tx.numbers_of_missions(world)?.2 as usize } else { 0 })
}

pub(super) fn show(rows: &[Row]) {
    let cells = rows.iter().map(|row| {
        let over = row.over_optimum().map_or_else(String::new, |over| format!("{over:.3}"));
        let judged = match row.right() {
            Some(true) => "",
            Some(false) => "WRONG",
            None => "not judged",
        };
        vec![
            row.robot.clone().unwrap_or_default(),
            row.mission.to_string(),
            row.ending.to_owned(),
            row.truth.as_ref().map_or_else(String::new, |truth| truth.obstacles.to_string()),
            number(row.length),
            over,
            row.detours.to_string(),
            row.replans.to_string(),
            format!("{:.0}", row.seconds),
            if row.has_collided() { "COLLIDED".to_owned() } else { judged.to_owned() },
        ]
    });
    let heads =
        ["mission", "ending", "obstacles", "metres", "over optimum", "detours", "replans", "seconds", ""];
    if rows.iter().any(|row| row.robot.is_some()) {
        table(&[&["robot"], &heads[..]].concat(), cells);
    } else {
        table(&heads, cells.map(|cells| cells[1..].to_vec()));
    }
    summary(rows);
}

fn summary(rows: &[Row]) {
    let count = |ending| rows.iter().filter(|row| row.ending == ending).count();
    let touches: usize = rows.iter().map(|row| row.touches).sum();
    line(&format!(
        "{}: {} arrived, {} found no way, {} lost, {} gave up; {} wrong, {} not judged, {} collided, {} touch{}",
        counted(rows.len(), "mission"),
        count("arrived"),
        count("no_way"),
        count("lost"),
        count("gave_up"),
        rows.iter().filter(|row| row.right() == Some(false)).count(),
        rows.iter().filter(|row| row.right().is_none()).count(),
        rows.iter().filter(|row| row.has_collided()).count(),
        touches,
        if touches == 1 { "" } else { "es" },
    ));
    if rows.iter().any(|row| row.right().is_none() && row.robot.is_some()) {
        line(
            "not judged: doors and robots come and go, so nobody can say afterwards whether there was a way",
        );
    } else if rows.iter().any(|row| row.right().is_none()) {
        line("not judged: rules let nobody through some doorway, and the judge knows of walls alone");
    }
    let possible = |with_room, radius| {
        let is_so = move |truth: &Truth| {
            truth.possible_with_room == Some(with_room) && truth.possible == Some(radius)
        };
        let of = rows.iter().filter(move |row| row.truth.as_ref().is_some_and(is_so));
        let arrived = of.clone().filter(|row| row.ending == "arrived").count();
        (of.count(), arrived)
    };
    let ((possible, by_room), (between, by_luck), (impossible, by_error)) =
        (possible(true, true), possible(false, true), possible(false, false));
    if possible + between + impossible > 0 {
        line(&format!(
            "{possible} possible with room: {by_room} arrived; {between} possible without: {by_luck} arrived; \
             {impossible} impossible: {by_error} arrived"
        ));
    }
    let arrived = || rows.iter().filter(|row| row.ending == "arrived");
    let spreads: [(&str, Vec<f64>); 6] = [
        ("length over optimum", arrived().filter_map(Row::over_optimum).collect()),
        ("replans", rows.iter().map(|row| f64::from(row.replans)).collect()),
        ("detours", rows.iter().map(|row| f64::from(row.detours)).collect()),
        ("seconds by the robot's clock", rows.iter().map(|row| row.seconds).collect()),
        ("metres from the goal", arrived().filter_map(|row| Some(row.truth.as_ref()?.miss)).collect()),
        (
            "worst error of position",
            rows.iter().filter_map(|row| Some(row.truth.as_ref()?.worst_error)).collect(),
        ),
    ];
    // of few, the shares are one and the same
    let shares: &[(&str, f64)] = match rows.len() {
        0 | 1 => &[("value", 1.0)],
        2..=10 => &[("median", 0.5), ("worst", 1.0)],
        _ => &[("median", 0.5), ("90 %", 0.9), ("99 %", 0.99), ("worst", 1.0)],
    };
    let spread = |(what, mut values): (&str, Vec<f64>)| {
        values.sort_by(f64::total_cmp);
        // between two values, as far on as the share says
        let at = |share: f64| {
            let place = (values.len() as f64 - 1.0) * share;
            let (low, high) = (values.get(place.floor() as usize)?, values.get(place.ceil() as usize)?);
            Some(low + (high - low) * place.fract())
        };
        let figure = |share| at(share).map_or_else(|| "-".to_owned(), |value| format!("{value:.3}"));
        std::iter::once(what.to_owned()).chain(shares.iter().map(|(_, share)| figure(*share))).collect()
    };
    let heads: Vec<&str> = std::iter::once("").chain(shares.iter().map(|(head, _)| *head)).collect();
    table(&heads, spreads.map(spread));
}

/// Whether all ended as they should, as far as that is judged.
pub(super) fn are_right(rows: &[Row]) -> bool {
    rows.iter().all(|row| row.right() != Some(false) && !row.has_collided())
}
