//! What time it is for a derivation, and times as people write them.

use std::sync::Arc;
use std::sync::atomic::{AtomicI64, Ordering};

use jiff::civil::{Date, DateTime, Time};
use jiff::tz::TimeZone;
use jiff::{SignedDuration, Span, Timestamp, Zoned};

use crate::error::{Code, Error, Result};

/// The moment for which facts are told, and the site's time zone.
#[derive(Clone, Debug)]
pub struct Clock {
    now: Timestamp,
    zone: TimeZone,
}

/// The time of a simulation, which whoever knows the site sees alike; where nothing is simulated, none.
#[derive(Clone, Debug, Default)]
pub struct Dial(Arc<AtomicI64>);

/// No simulation has this time, in microseconds.
const PRESENT: i64 = 0;

impl Dial {
    /// Says that it is so many seconds after a moment.
    pub fn set(&self, since: Timestamp, seconds: f64) {
        let passed = SignedDuration::from_micros((seconds * 1e6) as i64);
        let now = since.checked_add(passed).map_or(PRESENT, Timestamp::as_microsecond);
        self.0.store(now, Ordering::Relaxed);
    }

    /// Says that nothing is simulated any more.
    pub fn stop(&self) {
        self.0.store(PRESENT, Ordering::Relaxed);
    }

    pub fn read(&self) -> Option<Timestamp> {
        let now = self.0.load(Ordering::Relaxed);
        (now != PRESENT).then(|| Timestamp::from_microsecond(now).ok()).flatten()
    }
}

impl Clock {
    /// The present, or another moment to ask about.
    pub fn new(at: Option<Timestamp>, zone: &TimeZone) -> Self {
        Self { now: at.unwrap_or_else(Timestamp::now), zone: zone.clone() }
    }

    pub fn now(&self) -> Timestamp {
        self.now
    }

    /// The moment as the site's clocks show it.
    pub fn local(&self) -> Zoned {
        self.now.to_zoned(self.zone.clone())
    }

    /// Whether the moment is still to come.
    pub fn is_ahead(&self) -> bool {
        self.now > Timestamp::now()
    }

    /// A time as people write it: `2026-11-21T18:00` of the site's time zone, `2026-11-21` (its begin), `18:00` (the
    /// next one), `2h` or `3 days` (from now), or an instant with its offset (`2026-11-21T18:00:00Z`).
    pub fn parse(&self, text: &str) -> Result<Timestamp> {
        let zoned = |local: DateTime| local.to_zoned(self.zone.clone()).ok().map(|zoned| zoned.timestamp());
        // a text with an offset must not be taken for a local time without it
        if let Ok(instant) = text.parse::<Timestamp>() {
            return Ok(instant);
        }
        let found = if let Ok(date) = text.parse::<Date>()
            && !text.contains([':', 'T', ' '])
        {
            zoned(date.at(0, 0, 0, 0))
        } else if let Ok(local) = text.parse::<DateTime>() {
            zoned(local)
        } else if let Ok(time) = text.parse::<Time>()
            // `2026` may be a year, `30` minutes
            && text.contains(':')
        {
            self.next(time).and_then(zoned)
        } else if let Ok(span) = text.parse::<Span>() {
            self.local().checked_add(span).ok().map(|zoned| zoned.timestamp())
        } else {
            None
        };
        found.ok_or_else(|| {
            let help = "write 2026-11-21T18:00, 2026-11-21, 18:00, 2h or 2026-11-21T18:00:00Z".to_owned();
            Error::said(Code::TimeUnreadable, format!("`{text}` is no time"), Some(help))
        })
    }

    /// The next moment at which clocks show this time.
    fn next(&self, time: Time) -> Option<DateTime> {
        let local = self.local().datetime();
        let today = local.date().to_datetime(time);
        if today > local { Some(today) } else { Some(local.date().tomorrow().ok()?.to_datetime(time)) }
    }
}

/// A moment as the database keeps it: in UTC, to the second.
pub fn stored(moment: Timestamp) -> String {
    moment.strftime("%Y-%m-%dT%H:%M:%SZ").to_string()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn clock() -> Clock {
        let zone = TimeZone::get("Europe/Berlin").unwrap();
        Clock::new(Some("2026-11-21T11:30:00Z".parse().unwrap()), &zone)
    }

    fn utc(text: &str) -> String {
        stored(clock().parse(text).unwrap())
    }

    #[test]
    fn times_are_of_the_sites_zone_unless_they_say_otherwise() {
        assert_eq!(utc("2026-11-21T18:00"), "2026-11-21T17:00:00Z");
        assert_eq!(utc("2026-07-01 18:00"), "2026-07-01T16:00:00Z");
        assert_eq!(utc("2026-11-21T18:00:00Z"), "2026-11-21T18:00:00Z");
        assert_eq!(utc("2026-11-22"), "2026-11-21T23:00:00Z");
    }

    #[test]
    fn a_time_of_day_is_the_next_one_and_a_span_counts_from_now() {
        assert_eq!(utc("13:00"), "2026-11-21T12:00:00Z");
        assert_eq!(utc("12:00"), "2026-11-22T11:00:00Z");
        assert_eq!(utc("2h"), "2026-11-21T13:30:00Z");
        assert_eq!(utc("3 days"), "2026-11-24T11:30:00Z");
    }

    #[test]
    fn a_number_alone_is_no_time_of_day() {
        for text in ["2026", "1800", "30", "7"] {
            assert!(clock().parse(text).is_err(), "{text}");
        }
    }

    #[test]
    fn what_is_no_time_is_refused_with_examples() {
        assert!(clock().parse("tomorrow").unwrap_err().to_string().contains("`tomorrow` is no time"));
    }
}
