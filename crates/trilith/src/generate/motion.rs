//! A synthetic ground motion in closed form.

use std::f64::consts::TAU;

/// Acceleration of component `component` (0, 1, …) at 0, `dt`, 2 `dt` … up to `duration` (s), scaled to
/// the largest value `peak`.
///
/// ```text
///   a(t) = e(t) Σ √S(ωⱼ) sin(ωⱼ t + φⱼ),   fⱼ = 0.1 + 0.1 j Hz, j = 1 … 240
///   S: Clough–Penzien with ω_g = 2π 2.5, ζ_g = 0.6, ω_f = 2π 0.25, ζ_f = 0.6
///   φⱼ = 2π frac(0.6180339887 j² + 0.7548776662 (c + 1) j)
///   e = (t/2)² up to 2 s, 1 up to 12 s, exp(−0.3 (t − 12)) from there
/// ```
///
/// Spectrum: \[Clough & Penzien 1993, eq. 28-33\].
#[must_use]
pub fn synthetic(component: usize, dt: f64, duration: f64, peak: f64) -> Vec<f64> {
    let (wg, xg, wf, xf) = (TAU * 2.5, 0.6, TAU * 0.25, 0.6);
    let sines: Vec<[f64; 3]> = (1..=240)
        .map(|j| {
            let j = f64::from(j);
            let w = TAU * (0.1 + 0.1 * j);
            let ground = 4.0 * xg * xg * wg * wg * w * w;
            let filter = 4.0 * xf * xf * wf * wf * w * w;
            let s = (wg.powi(4) + ground) / ((wg * wg - w * w).powi(2) + ground) * w.powi(4)
                / ((wf * wf - w * w).powi(2) + filter);
            let turn = j * j * 0.618_033_988_7 + (component as f64 + 1.0) * j * 0.754_877_666_2;
            [s.sqrt(), w, TAU * turn.fract()]
        })
        .collect();
    let envelope = |t: f64| match t {
        t if t < 2.0 => (0.5 * t).powi(2),
        t if t > 12.0 => (-0.3 * (t - 12.0)).exp(),
        _ => 1.0,
    };
    let steps = (duration / dt).round() as usize;
    let mut values: Vec<f64> = (0..=steps)
        .map(|i| {
            let t = i as f64 * dt;
            envelope(t) * sines.iter().map(|[a, w, phase]| a * (w * t + phase).sin()).sum::<f64>()
        })
        .collect();
    let largest = values.iter().fold(0.0_f64, |m, x| m.max(x.abs()));
    if largest > 0.0 {
        values.iter_mut().for_each(|x| *x *= peak / largest);
    }
    values
}

#[cfg(test)]
mod tests {
    use super::synthetic;

    /// Samples of the record of the benchmark, made by another program.
    #[test]
    fn it_is_the_record_of_the_benchmark() {
        let expected = [
            (100, [0.013_723_802_703_206_01, 0.088_029_244_422_792_04]),
            (877, [2.364_089_903_376_261_7, -2.943]),
            (1692, [3.924, 0.181_104_210_686_346_8]),
            (3000, [0.295_315_336_046_207_63, -0.648_912_575_470_114_9]),
        ];
        let records = [synthetic(0, 0.005, 20.0, 3.924), synthetic(1, 0.005, 20.0, 2.943)];
        for (i, values) in expected {
            for (record, value) in records.iter().zip(values) {
                assert!((record[i] - value).abs() < 1e-12, "{i}: {} {value}", record[i]);
            }
        }
        assert_eq!(records[0].len(), 4001);
        assert!(synthetic(0, 0.1, 0.04, 1.0).iter().all(|x| x.is_finite()));
    }
}
