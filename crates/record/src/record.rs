//! A record: acceleration at even steps, and where it comes from.

use crate::Format;

/// Where a component points.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum Direction {
    /// Horizontal, degrees from north, clockwise.
    Azimuth(f64),
    /// Up.
    Vertical,
    /// Not stated.
    #[default]
    Unknown,
}

impl Direction {
    /// From a name such as `N-S`, `EW`, `HNZ`, `Up`, `360 Deg` or `S00E`.
    #[must_use]
    pub fn from_name(name: &str) -> Self {
        let name = name.trim().to_uppercase();
        let letters: String = name.chars().filter(char::is_ascii_alphanumeric).collect();
        match letters.as_str() {
            "UP" | "UD" | "DU" | "DN" | "DOWN" | "V" | "VER" | "VERT" | "VERTICAL" | "Z" => {
                return Self::Vertical;
            }
            "NS" | "N" | "NORTH" | "SN" => return Self::Azimuth(0.0),
            "EW" | "E" | "EAST" | "WE" => return Self::Azimuth(90.0),
            _ => {}
        }
        if let Some(degrees) = quadrant(&letters) {
            return Self::Azimuth(degrees);
        }
        if let Ok(degrees) = letters.trim_end_matches("DEG").trim().parse::<f64>()
            && (0.0..=360.0).contains(&degrees)
        {
            return Self::Azimuth(degrees);
        }
        // Codes of the SEED convention: band, instrument, orientation.
        match letters.as_bytes() {
            [_, b'N' | b'L' | b'G' | b'H', b'Z'] => Self::Vertical,
            [_, b'N' | b'L' | b'G' | b'H', b'N'] => Self::Azimuth(0.0),
            [_, b'N' | b'L' | b'G' | b'H', b'E'] => Self::Azimuth(90.0),
            _ => Self::Unknown,
        }
    }
}

/// `S00E`, `N90W`: so many degrees from the first letter towards the second.
fn quadrant(text: &str) -> Option<f64> {
    let (first, rest) = (text.chars().next()?, text.get(1..)?);
    let (degrees, last) = (rest.get(..rest.len().checked_sub(1)?)?, rest.chars().last()?);
    let degrees = degrees.parse::<f64>().ok().filter(|d| (0.0..=90.0).contains(d))?;
    match (first, last) {
        ('N', 'E') => Some(degrees),
        ('N', 'W') => Some((360.0 - degrees) % 360.0),
        ('S', 'E') => Some(180.0 - degrees),
        ('S', 'W') => Some(180.0 + degrees),
        _ => None,
    }
}

/// One component of a ground motion.
#[derive(Clone, Debug, PartialEq)]
pub struct Record {
    /// Acceleration at 0, dt, 2 dt …, m/s².
    pub acceleration: Vec<f64>,
    /// Time step, s.
    pub dt: f64,
    /// Name of the component as the file gives it.
    pub component: String,
    /// Where it points.
    pub direction: Direction,
    /// The station, where it is given.
    pub station: String,
    /// The event, where it is given.
    pub event: String,
    /// Format that it was read from; `None` for one that was made.
    pub format: Option<Format>,
    /// Largest |acceleration| as the header states it, m/s².
    pub stated_peak: Option<f64>,
    /// What was done on reading, in a few words each.
    pub notes: Vec<String>,
}

impl Record {
    /// A record without a history.
    #[must_use]
    pub fn new(acceleration: Vec<f64>, dt: f64) -> Self {
        Self {
            acceleration,
            dt,
            component: String::new(),
            direction: Direction::Unknown,
            station: String::new(),
            event: String::new(),
            format: None,
            stated_peak: None,
            notes: Vec::new(),
        }
    }

    /// Time of the last sample, s.
    #[must_use]
    pub fn duration(&self) -> f64 {
        self.acceleration.len().saturating_sub(1) as f64 * self.dt
    }

    /// True unless it is known to be vertical.
    #[must_use]
    pub fn is_horizontal(&self) -> bool {
        self.direction != Direction::Vertical
    }

    /// The record as columns `t [s],a [m/s^2]` under comments that say what it is; reads back to the same bits.
    #[must_use]
    pub fn to_csv(&self) -> String {
        use std::fmt::Write;
        let mut out = String::new();
        let lines =
            [("event", &self.event), ("station", &self.station), ("component", &self.component)];
        let told = lines.into_iter().filter(|(_, text)| !text.is_empty());
        // Writing to a String cannot fail.
        for (key, text) in told {
            let _ = writeln!(out, "# {key} {}", comment(text));
        }
        for note in &self.notes {
            let _ = writeln!(out, "# {}", comment(note));
        }
        let _ = writeln!(out, "# dt = {:?} s\nt [s],a [m/s^2]", self.dt);
        for (t, a) in self.times().zip(&self.acceleration) {
            let _ = writeln!(out, "{:?},{a:?}", (t * 1e9).round() / 1e9);
        }
        out
    }

    /// Times of the samples, s.
    pub fn times(&self) -> impl Iterator<Item = f64> + '_ {
        (0..self.acceleration.len()).map(|i| i as f64 * self.dt)
    }
}

/// A text in a line of comment. A spreadsheet does not know comments: behind a comma there it begins a cell.
fn comment(text: &str) -> String {
    let text = text.replace(['\n', '\r'], " ");
    let mut parts = text.split(',');
    let first = parts.next().unwrap_or_default().to_owned();
    parts.fold(crate::visible(&first).into_owned(), |line, part| line + "," + &crate::cell(part))
}

#[cfg(test)]
mod tests {
    use super::Direction::{Azimuth, Unknown, Vertical};
    use super::*;

    #[test]
    fn a_record_reads_back_to_the_same_bits() {
        let values = (0..200).map(|i| (0.1 * f64::from(i)).sin() / 3.0).collect();
        let mut r = Record::new(values, 1.0 / 200.0);
        r.component = "90".into();
        let back = crate::parse(r.to_csv().as_bytes(), "a.csv", &Default::default()).unwrap();
        assert_eq!((back[0].dt, &back[0].acceleration), (r.dt, &r.acceleration));
    }

    #[test]
    fn comments_are_no_formulas_in_a_spreadsheet() {
        let mut r = Record::new(vec![0.0, 1.0], 0.5);
        r.event = "Town, 1999,=1+1".into();
        r.notes.push("a\nb".into());
        r.notes.push("\u{1b}[2Jc, \u{7}".into());
        let text = r.to_csv();
        let start = "# event Town, 1999,'=1+1\n# a b\n# \\u{1b}[2Jc, \\u{7}\n# dt";
        assert!(text.starts_with(start), "{text}");
    }

    #[test]
    fn names_tell_directions() {
        let cases = [
            ("N-S", Azimuth(0.0)),
            ("EW", Azimuth(90.0)),
            ("HNE", Azimuth(90.0)),
            ("HNZ", Vertical),
            ("360 Deg", Azimuth(360.0)),
            ("Up", Vertical),
            ("S00E", Azimuth(180.0)),
            ("N90W", Azimuth(270.0)),
            ("H1", Unknown),
            ("", Unknown),
        ];
        for (name, direction) in cases {
            assert_eq!(Direction::from_name(name), direction, "{name}");
        }
    }
}
