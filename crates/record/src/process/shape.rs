//! Trimming, taper, scaling.

use super::ProcessError;
use crate::measure::peak;

/// The samples from one time to another, both included, s.
///
/// # Errors
/// [`ProcessError::Trim`] where that is not within the record.
pub fn trim(a: &[f64], dt: f64, from: f64, to: f64) -> Result<Vec<f64>, ProcessError> {
    let duration = a.len().saturating_sub(1) as f64 * dt;
    let tiny = 1e-6 * dt;
    if !(from >= -tiny && to > from && to <= duration + tiny) {
        return Err(ProcessError::Trim { from, to, duration });
    }
    let (first, last) = ((from / dt - 1e-6).ceil().max(0.0), (to / dt + 1e-6).floor());
    if last <= first {
        return Err(ProcessError::Trim { from, to, duration });
    }
    Ok(a[first as usize..=(last as usize).min(a.len() - 1)].to_vec())
}

/// Lets each end rise and fall with a half cosine over a share of the duration.
///
/// # Errors
/// [`ProcessError::Taper`] for a share outside 0 … 0.5.
pub fn taper(a: &mut [f64], share: f64) -> Result<(), ProcessError> {
    if !(0.0..=0.5).contains(&share) {
        return Err(ProcessError::Taper(share));
    }
    let n = a.len();
    let m = (share * n.saturating_sub(1) as f64).round();
    for i in 0..m as usize {
        let w = 0.5 - 0.5 * (std::f64::consts::PI * i as f64 / m).cos();
        a[i] *= w;
        a[n - 1 - i] *= w;
    }
    Ok(())
}

/// Times a factor.
#[must_use]
pub fn scaled(a: &[f64], factor: f64) -> Vec<f64> {
    a.iter().map(|x| factor * x).collect()
}

/// Scaled so that the largest |value| is this one, m/s².
///
/// # Errors
/// [`ProcessError::Zero`] for a record that is zero throughout.
pub fn scaled_to(a: &[f64], target: f64) -> Result<Vec<f64>, ProcessError> {
    let largest = peak(a);
    if largest == 0.0 {
        return Err(ProcessError::Zero);
    }
    Ok(scaled(a, target / largest))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_taper_is_half_a_cosine_at_each_end() {
        // A quarter of 9 samples is 2 steps: sin² of 0 and of a quarter of π, then all.
        let mut a = vec![2.0; 9];
        taper(&mut a, 0.25).unwrap();
        let expected = [0.0, 1.0, 2.0, 2.0, 2.0, 2.0, 2.0, 1.0, 0.0];
        assert!(a.iter().zip(expected).all(|(x, e)| (x - e).abs() < 1e-15), "{a:?}");
        assert!(taper(&mut a, 0.6).is_err());
    }

    #[test]
    fn a_trim_keeps_both_ends() {
        let a: Vec<f64> = (0..11).map(f64::from).collect();
        // 0.3/0.1 is below 3 and 0.7/0.1 below 7 by rounding.
        assert_eq!(trim(&a, 0.1, 0.3, 0.7).unwrap(), [3.0, 4.0, 5.0, 6.0, 7.0]);
        assert!(trim(&a, 0.1, 0.3, 1.2).is_err() && trim(&a, 0.1, 0.5, 0.5).is_err());
    }
}
