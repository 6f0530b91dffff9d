//! Opening hours: when a named area or door is open, and the next moment at which that may change.

use std::collections::BTreeMap;

use adit_db::hours::Hours;
use adit_planners::facts::{Column, Table};
use adit_planners::read::{Code, Fields, Problem};
use jiff::civil::{Date, Weekday};
use jiff::{Timestamp, Zoned};

use crate::error::{self, Error, Result};
use crate::site::clock::Clock;

const DAYS: [&str; 7] = ["mon", "tue", "wed", "thu", "fri", "sat", "sun"];
const END_OF_DAY: u16 = 24 * 60;
const PAST_MIDNIGHT: &str = "hours past midnight are two entries: one that closes at 24:00, and one that opens at 00:00 on the next day";

/// The hours of one row, understood.
#[derive(Clone, Debug, PartialEq)]
struct Week {
    days: [bool; 7],
    /// Minutes after midnight.
    opens: u16,
    closes: u16,
}

/// All opening hours of a site, by the name of what they are about.
#[derive(Clone, Debug, Default)]
pub struct Opening(BTreeMap<String, Vec<Week>>);

impl Opening {
    /// Understands the rows of `site.toml` and of the table `hours`.
    pub fn new(rows: &[Hours]) -> Result<Self> {
        let mut opening = Self::default();
        for row in rows {
            let week = week(row).map_err(|reason| {
                let message = format!(
                    "the hours of `{}` ({} {} to {}): {reason}",
                    row.name, row.days, row.opens, row.closes
                );
                Error::said(
                    error::Code::HoursUnreadable,
                    message,
                    Some("write days like mon-fri or sat,sun".to_owned()),
                )
            })?;
            opening.0.entry(row.name.clone()).or_default().push(week);
        }
        Ok(opening)
    }

    /// The class HOURS: what has hours, and whether it is open at the moment.
    pub fn class(&self, clock: &Clock) -> Table {
        let now = clock.local();
        let open = |weeks: &Vec<Week>| weeks.iter().any(|week| week.is_open(&now));
        Table::default()
            .with("name", self.0.keys().cloned().collect::<Column>())
            .with("open", self.0.values().map(open).collect::<Column>())
    }

    /// The next moment at which something may open or close; `None` where nothing has hours.
    pub fn next_change(&self, clock: &Clock) -> Option<Timestamp> {
        let now = clock.local();
        self.0.values().flatten().filter_map(|week| week.next_change(&now)).min()
    }
}

impl Week {
    fn is_open(&self, now: &Zoned) -> bool {
        let minute = now.hour() as u16 * 60 + now.minute() as u16;
        self.days[index(now.weekday())] && (self.opens..self.closes).contains(&minute)
    }

    fn next_change(&self, now: &Zoned) -> Option<Timestamp> {
        let moment = |date: Date, minute: u16| {
            let (date, minute) =
                if minute == END_OF_DAY { (date.tomorrow().ok()?, 0) } else { (date, minute) };
            let local = date.at((minute / 60) as i8, (minute % 60) as i8, 0, 0);
            Some(local.to_zoned(now.time_zone().clone()).ok()?.timestamp())
        };
        let mut date = now.date();
        // the same day of next week is the last that can be the next
        for _ in 0..=7 {
            if self.days[index(date.weekday())] {
                let found = [self.opens, self.closes].map(|minute| moment(date, minute));
                let found = found.into_iter().flatten().find(|moment| *moment > now.timestamp());
                if found.is_some() {
                    return found;
                }
            }
            date = date.tomorrow().ok()?;
        }
        None
    }
}

fn index(day: Weekday) -> usize {
    day.to_monday_zero_offset() as usize
}

fn week(row: &Hours) -> std::result::Result<Week, String> {
    let (opens, closes) = (minutes(&row.opens)?, minutes(&row.closes)?);
    if closes <= opens {
        return Err("they end before they begin".to_owned());
    }
    Ok(Week { days: days(&row.days)?, opens, closes })
}

/// Minutes after midnight of `HH:MM`.
fn minutes(text: &str) -> std::result::Result<u16, String> {
    let wrong = || format!("`{text}` is no time from 00:00 to 24:00");
    let (hour, minute) = text.split_once(':').ok_or_else(wrong)?;
    let digits = |part: &str| {
        let part =
            Some(part).filter(|part| part.len() == 2 && part.bytes().all(|byte| byte.is_ascii_digit()));
        part.and_then(|part| part.parse::<u16>().ok()).ok_or_else(wrong)
    };
    let (hour, minute) = (digits(hour)?, digits(minute)?);
    let all = hour * 60 + minute;
    if minute < 60 && all <= END_OF_DAY { Ok(all) } else { Err(wrong()) }
}

/// The days of `mon-fri` or `sat,sun`; a range may go over the week's end.
fn days(text: &str) -> std::result::Result<[bool; 7], String> {
    let day = |name: &str| {
        let name = name.trim().to_lowercase();
        DAYS.iter()
            .position(|day| *day == name)
            .ok_or_else(|| format!("`{name}` is no day of mon, tue, wed, thu, fri, sat, sun"))
    };
    let mut days = [false; 7];
    for part in text.split(',') {
        let (first, last) = part.split_once('-').unwrap_or((part, part));
        let (mut at, last) = (day(first)?, day(last)?);
        days[at] = true;
        while at != last {
            at = (at + 1) % 7;
            days[at] = true;
        }
    }
    Ok(days)
}

/// The `[[hours]]` of `site.toml`: name, days (every day, unless said), opens, closes.
pub fn read(fields: &Fields<'_, '_>, problems: &mut Vec<Problem>) -> Vec<Hours> {
    let mut rows: Vec<Hours> = Vec::new();
    for entry in fields.tables("hours", "[[hours]]", problems) {
        entry.refuse_unknown(&["name", "days", "opens", "closes"], problems);
        let name = entry.string("name", problems);
        let every_day = || DAYS[0].to_owned() + "-" + DAYS[6];
        let days_given = entry.get("days").and_then(|_| entry.string("days", problems));
        let (opens, closes) = (entry.string("opens", problems), entry.string("closes", problems));
        let (Some(name), Some(opens), Some(closes)) = (name, opens, closes) else { continue };
        let mut refuse = |span: &std::ops::Range<usize>, message: String, help: Option<&str>| {
            let problem = entry.text.problem(Code::WrongType, span, message);
            problems.push(match help {
                Some(help) => problem.with_help(help),
                None => problem,
            });
        };
        if name.value.trim().is_empty() {
            refuse(&name.span, "`name` is empty".to_owned(), None);
            continue;
        }
        if let Some(given) = &days_given
            && let Err(reason) = days(&given.value)
        {
            refuse(
                &given.span,
                format!("`days` of `{}`: {reason}", name.value),
                Some("write days like mon-fri or sat,sun"),
            );
            continue;
        }
        let mut times = Vec::new();
        for (key, time) in [("opens", &opens), ("closes", &closes)] {
            match minutes(&time.value) {
                Ok(minutes) => times.push(minutes),
                Err(reason) => refuse(&time.span, format!("`{key}` of `{}`: {reason}", name.value), None),
            }
        }
        let &[from, to] = times.as_slice() else { continue };
        if to <= from {
            let message = format!(
                "the hours of `{}` end before they begin: they open at {} and close at {}",
                name.value, opens.value, closes.value
            );
            refuse(&closes.span, message, Some(PAST_MIDNIGHT));
            continue;
        }
        let days = days_given.map_or_else(every_day, |days| days.value);
        let row = Hours { name: name.value, days, opens: opens.value, closes: closes.value };
        if rows
            .iter()
            .any(|known| (&known.name, &known.days, &known.opens) == (&row.name, &row.days, &row.opens))
        {
            let message = format!("`{}` opens at {} on {} twice", row.name, row.opens, row.days);
            refuse(&opens.span, message, None);
            continue;
        }
        rows.push(row);
    }
    rows
}

#[cfg(test)]
mod tests {
    use jiff::tz::TimeZone;

    use super::*;

    fn hours(days: &str, opens: &str, closes: &str) -> Hours {
        let [days, opens, closes] = [days, opens, closes].map(str::to_owned);
        Hours { name: "ward".to_owned(), days, opens, closes }
    }

    /// Whether it is open then, and when that may change next, in Berlin.
    fn at(rows: &[Hours], moment: &str) -> (bool, String) {
        let clock = Clock::new(Some(moment.parse().unwrap()), &TimeZone::get("Europe/Berlin").unwrap());
        let opening = Opening::new(rows).unwrap();
        let Some(Column::Truth(open)) = opening.class(&clock).column("open").cloned() else { panic!() };
        (open[0].unwrap(), crate::site::clock::stored(opening.next_change(&clock).unwrap()))
    }

    #[test]
    fn open_from_the_first_minute_up_to_the_last() {
        let rows = [hours("mon-fri", "08:00", "18:30")];
        // 2026-11-20 is a Friday
        assert_eq!(at(&rows, "2026-11-20T06:59:59Z"), (false, "2026-11-20T07:00:00Z".to_owned()));
        assert_eq!(at(&rows, "2026-11-20T07:00:00Z"), (true, "2026-11-20T17:30:00Z".to_owned()));
        assert_eq!(at(&rows, "2026-11-20T17:30:00Z"), (false, "2026-11-23T07:00:00Z".to_owned()));
    }

    #[test]
    fn past_midnight_by_two_rows_over_the_weeks_end() {
        let rows = [hours("sun", "22:00", "24:00"), hours("mon", "00:00", "06:00")];
        assert!(at(&rows, "2026-11-22T22:59:00Z").0);
        assert!(at(&rows, "2026-11-22T23:00:00Z").0);
        assert!(!at(&rows, "2026-11-23T05:00:00Z").0);
        assert_eq!(days("sat-mon").unwrap(), [true, false, false, false, false, true, true]);
    }

    #[test]
    fn the_clock_of_summer_is_the_one_on_the_wall() {
        assert!(at(&[hours("mon-sun", "08:00", "09:00")], "2026-07-01T06:00:00Z").0);
        assert!(!at(&[hours("mon-sun", "08:00", "09:00")], "2026-11-21T06:00:00Z").0);
    }

    #[test]
    fn hours_that_cannot_be_are_refused_by_name() {
        for (row, why) in [
            (hours("mon", "18:00", "08:00"), "end before they begin"),
            (hours("mon", "08:00", "08:00"), "end before they begin"),
            (hours("someday", "08:00", "09:00"), "`someday` is no day"),
            (hours("mon", "8", "09:00"), "`8` is no time"),
            (hours("mon", "08:00", "24:01"), "`24:01` is no time"),
            (hours("mon", "08:60", "09:00"), "`08:60` is no time"),
        ] {
            let said = Opening::new(&[row]).unwrap_err().to_string();
            assert!(said.contains(why) && said.contains("`ward`"), "{said}");
        }
    }
}
