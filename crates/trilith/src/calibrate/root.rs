//! Where a falling function is zero.

/// Evaluations at most; each of them is a run.
const LIMIT: usize = 40;
/// The function counts as zero below this: restitutions are known no better from a run.
const CLOSE: f64 = 1e-5;

/// The root of a function that falls from f(low) ≥ 0, sought from `low` to `guess` and, where it is
/// still positive there, beyond: Illinois variant of the false position (Dowell and Jarratt 1971).
pub(super) fn falling_root<E>(
    low: f64,
    guess: f64,
    mut f: impl FnMut(f64) -> Result<f64, E>,
) -> Result<f64, E> {
    let (mut a, mut fa) = (low, f(low)?);
    if fa <= CLOSE {
        return Ok(a);
    }
    let (mut b, mut fb) = (guess, f(guess)?);
    let mut made = 2;
    while fb > 0.0 && made < LIMIT {
        (a, fa) = (b, fb);
        b = low + 2.0 * (b - low);
        fb = f(b)?;
        made += 1;
    }
    let mut last = 0;
    while fa > CLOSE && fb < -CLOSE && made < LIMIT {
        let c = (a * fb - b * fa) / (fb - fa);
        let fc = f(c)?;
        made += 1;
        if fc > 0.0 {
            (a, fa) = (c, fc);
            fb *= if last == 1 { 0.5 } else { 1.0 };
            last = 1;
        } else {
            (b, fb) = (c, fc);
            fa *= if last == -1 { 0.5 } else { 1.0 };
            last = -1;
        }
        if fc.abs() <= CLOSE {
            return Ok(c);
        }
    }
    Ok(if fa.abs() < fb.abs() { a } else { b })
}

#[cfg(test)]
mod tests {
    use super::falling_root;

    #[test]
    fn finds_the_root_inside_beyond_and_at_the_start() {
        let mut calls = 0;
        let mut f = |x: f64| {
            calls += 1;
            Ok::<_, ()>((-x).exp() - 0.3)
        };
        let wanted = -(0.3_f64.ln());
        assert!((falling_root(0.0, 5.0, &mut f).unwrap() - wanted).abs() < 1e-4);
        assert!((falling_root(0.0, 0.1, &mut f).unwrap() - wanted).abs() < 1e-4);
        assert_eq!(falling_root(wanted + 1e-9, 2.0, &mut f), Ok(wanted + 1e-9));
        assert!(calls < 30, "{calls}");
        assert_eq!(falling_root(0.0, 1.0, |_| Err::<f64, _>("no run")), Err("no run"));
    }
}
