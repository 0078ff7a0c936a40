//! The design spectrum of `--spectrum`: of a code, or points of a file.

use crate::Failure;
use crate::text::shown;
use serde::Deserialize;
use std::path::Path;
use trilith::element::dimension::{ACCELERATION, Dimension, TIME};
use trilith::model::quantity;
use trilith::record::design::{Asce7, DesignSpectrum, Ec8, Points};
use trilith::report::RunData;
use trilith::results::GROUND_DAMPING;

/// How spectra of codes are written.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
enum Written {
    #[serde(rename = "EC8")]
    Ec8 {
        ground: Ground,
        ag: Given,
        #[serde(default = "first", rename = "type")]
        kind: u8,
    },
    #[serde(rename = "ASCE7")]
    Asce7 { sds: Given, sd1: Given, tl: Given },
}

#[derive(Clone, Copy, Debug, Deserialize)]
enum Ground {
    A,
    B,
    C,
    D,
    E,
}

/// A quantity: SI, or with its unit.
#[derive(Deserialize)]
#[serde(untagged)]
enum Given {
    Number(f64),
    Text(String),
}

fn first() -> u8 {
    1
}

impl Given {
    fn positive(&self, name: &str, of: Dimension) -> Result<f64, String> {
        let x = match self {
            Self::Number(x) => *x,
            Self::Text(text) => quantity(text, of).map_err(|why| format!("`{name}`: {why}"))?,
        };
        let good = x.is_finite() && x > 0.0;
        good.then_some(x).ok_or_else(|| format!("`{name}` must be above 0"))
    }
}

/// The spectrum that an argument means: a file where there is one of that name.
pub(crate) fn read(text: &str) -> Result<DesignSpectrum, Failure> {
    let path = Path::new(text);
    let is_code = text.trim_start().starts_with("EC8") || text.trim_start().starts_with("ASCE7");
    if is_code && !path.exists() {
        return of_code(text).map_err(|why| {
            Failure::input(
                &format!("`--spectrum {text}`: {why}"),
                Some("such as `EC8(ground: B, ag: \"0.25 g\")` or `ASCE7(sds: \"1 g\", sd1: \"0.6 g\", tl: \"8 s\")`"),
            )
        });
    }
    let bytes = std::fs::read_to_string(path).map_err(|error| {
        Failure::input(
            &format!("{} cannot be read: {error}", shown(path)),
            Some("`--spectrum` takes a file with the columns `T [s],Sa [g]`, or a spectrum of a code: `EC8(…)`, `ASCE7(…)`"),
        )
    })?;
    points(&bytes).map_err(|why| {
        Failure::input(
            &format!("{}: {why}", shown(path)),
            Some("two columns are wanted, period and acceleration, headed such as `T [s],Sa [g]`"),
        )
    })
}

/// Lays the spectrum that an argument means over that of the ground motion.
///
/// # Errors
/// Where the case shakes nothing.
pub(crate) fn lay_over(
    data: &mut RunData,
    text: &str,
    spectrum: &DesignSpectrum,
) -> Result<(), Failure> {
    let name = match spectrum {
        DesignSpectrum::Points(_) => {
            Path::new(text).file_stem().unwrap_or_default().to_string_lossy()
        }
        _ => text.into(),
    };
    match data.lay_over_ground(&name, |period| spectrum.acceleration(period, GROUND_DAMPING)) {
        true => Ok(()),
        false => Err(Failure::input(
            "no motion of the ground is in this case: there is no spectrum to lay another one over",
            Some("leave `--spectrum` out, or run a case with a `base` motion"),
        )),
    }
}

fn of_code(text: &str) -> Result<DesignSpectrum, String> {
    Ok(match ron::from_str(text).map_err(|e| e.to_string())? {
        Written::Ec8 { ground, ag, kind } => {
            let ag = ag.positive("ag", ACCELERATION)?;
            let ground = format!("{ground:?}").chars().next().unwrap_or('A');
            let it = Ec8::new(ag, kind, ground);
            DesignSpectrum::Ec8(it.ok_or("`type` is 1 or 2")?)
        }
        Written::Asce7 { sds, sd1, tl } => {
            let of = |x: &Given, name| x.positive(name, ACCELERATION);
            let (sds, sd1, tl) = (of(&sds, "sds")?, of(&sd1, "sd1")?, tl.positive("tl", TIME)?);
            if sd1 > sds * tl {
                return Err("S_D1 / S_DS must be below T_L".into());
            }
            DesignSpectrum::Asce7(Asce7 { sds, sd1, tl })
        }
    })
}

fn points(text: &str) -> Result<DesignSpectrum, String> {
    let lines = text.trim_start_matches('\u{feff}').lines().enumerate();
    let lines = lines.map(|(i, l)| (i + 1, l.trim()));
    let mut lines = lines.filter(|(_, l)| !l.is_empty() && !l.starts_with('#'));
    let two = |(at, line): (usize, &str)| -> Result<[String; 2], String> {
        match line.split(',').map(|cell| cell.trim().to_owned()).collect::<Vec<_>>().try_into() {
            Ok(two) => Ok(two),
            Err(cells) => Err(format!("line {at} has {} columns", Vec::len(&cells))),
        }
    };
    let head = two(lines.next().ok_or("there is nothing in it")?)?;
    if let Some(cell) = head.iter().find(|cell| cell.parse::<f64>().is_ok()) {
        return Err(format!("`{cell}` stands where a head with units should"));
    }
    let unit = |cell: &str, of: Dimension| match cell.trim_end_matches(']').split_once('[') {
        None => Ok(1.0),
        Some((_, unit)) => quantity(&format!("1 {}", unit.trim()), of)
            .map_err(|why| format!("column `{cell}`: {why}")),
    };
    let units = [unit(&head[0], TIME)?, unit(&head[1], ACCELERATION)?];
    let mut points = Vec::new();
    for (at, line) in lines {
        let mut point = [0.0; 2];
        for ((x, cell), unit) in point.iter_mut().zip(two((at, line))?).zip(units) {
            let number: Option<f64> =
                cell.parse().ok().filter(|x: &f64| x.is_finite() && *x >= 0.0);
            *x = unit * number.ok_or(format!("line {at}: `{cell}` is no number from 0 on"))?;
        }
        points.push(point);
    }
    let points =
        Points::new(points).ok_or("there must be two points or more, with rising periods")?;
    Ok(DesignSpectrum::Points(points))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn spectra_are_read_in_their_units() {
        let spectrum = points("# of a site\nT [s],Sa [g]\n0,0.4\n1,1\n2,0.5\n").unwrap();
        assert!((spectrum.acceleration(1.5, 0.05).unwrap() - 0.75 * 9.80665).abs() < 1e-12);
        let code = of_code("EC8(ground: C, ag: \"0.2 g\", type: 2)").unwrap();
        let plateau = 2.5 * 1.5 * 0.2 * 9.80665;
        assert!((code.acceleration(0.2, 0.05).unwrap() - plateau).abs() < 1e-12);
    }

    #[test]
    fn what_is_wrong_with_a_spectrum_is_told() {
        for (text, part) in [
            ("", "nothing in it"),
            ("0,0.4\n1,1", "head with units"),
            ("T,Sa,b\n", "line 1 has 3 columns"),
            ("T [s],Sa [m]\n0,1\n1,1", "column `Sa [m]`"),
            ("T [s],Sa [g]\n0,1\n1,-1", "line 3: `-1`"),
            ("T [s],Sa [g]\n0,1\n1,x", "line 3: `x`"),
            ("T [s],Sa [g]\n0,1", "two points"),
            ("T [s],Sa [g]\n0,1\n2,1\n1,1", "rising"),
        ] {
            let why = points(text).expect_err(text);
            assert!(why.contains(part), "{text}: {why}");
        }
        for (text, part) in [
            ("EC8(ground: F, ag: 1)", "F"),
            ("EC8(ground: A, ag: \"1 m\")", "`ag`"),
            ("EC8(ground: A, ag: -1)", "`ag` must be above 0"),
            ("EC8(ground: A, ag: 1, type: 3)", "`type` is 1 or 2"),
            ("EC8(ground: A)", "ag"),
            ("EC8(ground: A, ag: 1, q: 2)", "q"),
            ("ASCE7(sds: 1, sd1: 9, tl: 8)", "T_L"),
        ] {
            let why = of_code(text).expect_err(text);
            assert!(why.contains(part), "{text}: {why}");
        }
    }
}
