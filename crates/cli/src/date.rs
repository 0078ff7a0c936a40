//! The date of a run.

use crate::Failure;
use std::time::{SystemTime, UNIX_EPOCH};

/// A date that builds and runs are to state in place of the present one, s since 1970.
const FIXED: &str = "SOURCE_DATE_EPOCH";
/// The last second of the year 9999.
const LAST: u64 = 253_402_300_799;

/// Now in UTC, such as `2023-11-14T22:13:20Z`, or what `SOURCE_DATE_EPOCH` says.
///
/// # Errors
/// A `SOURCE_DATE_EPOCH` that is no date.
pub(crate) fn date() -> Result<String, Failure> {
    let Some(fixed) = std::env::var_os(FIXED) else {
        // Only a clock that was never set is before 1970.
        let now = SystemTime::now().duration_since(UNIX_EPOCH);
        return Ok(utc(now.map_or(0, |d| d.as_secs())));
    };
    let fixed = fixed.to_string_lossy();
    fixed.parse::<u64>().ok().filter(|s| *s <= LAST).map(utc).ok_or_else(|| {
        let message = format!("the environment variable {FIXED} is `{fixed}`");
        let help = "it must be a number of seconds since 1970, such as 1700000000, or not be set";
        Failure::input(&message, Some(help))
    })
}

/// Seconds since 1970 as a date of the Gregorian calendar.
fn utc(seconds: u64) -> String {
    let (days, second) = (seconds / 86_400, seconds % 86_400);
    // Years begin in March here, so that the day that some have more is their last; eras have 400 of them.
    let (era, day) = ((days + 719_468) / 146_097, (days + 719_468) % 146_097);
    let year = (day - day / 1460 + day / 36_524 - day / 146_096) / 365;
    let day = day - (365 * year + year / 4 - year / 100);
    let march = (5 * day + 2) / 153;
    let day = day - (153 * march + 2) / 5 + 1;
    let month = if march < 10 { march + 3 } else { march - 9 };
    let year = 400 * era + year + u64::from(month < 3);
    let (hour, minute, second) = (second / 3600, second / 60 % 60, second % 60);
    format!("{year:04}-{month:02}-{day:02}T{hour:02}:{minute:02}:{second:02}Z")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn seconds_are_dates() {
        for (seconds, date) in [
            (0, "1970-01-01T00:00:00Z"),
            (951_782_400, "2000-02-29T00:00:00Z"),
            (1_700_000_000, "2023-11-14T22:13:20Z"),
            (4_107_542_399, "2100-02-28T23:59:59Z"),
            (4_107_542_400, "2100-03-01T00:00:00Z"),
            (LAST, "9999-12-31T23:59:59Z"),
        ] {
            assert_eq!(utc(seconds), date);
        }
    }
}
