//! Restitution of a contact of spring and dashpot struck by a mass m, without gravity.
//!
//! ```text
//!   m ẍ + c ẋ + k x = 0,  x(0) = 0,  ẋ(0) = v;   ζ = c / (2 √(k m)),  e = −ẋ(end) / v
//!   the dashpot may pull (ends where x = 0):     ln e = −π ζ / √(1 − ζ²)
//!   it may not (ends where the force is zero):   ln e = −2 ζ acos(ζ) / √(1 − ζ²)        ζ < 1
//!                                                ln e = −2                              ζ = 1
//!                                                ln e = −2 ζ acosh(ζ) / √(ζ² − 1)       ζ > 1
//!   it acts on approach only:                    half of the last three
//! ```
//!
//! Weight lowers e of slow impacts: a contact in which gravity matters (speed not far above g √(m/k))
//! returns less than e.
//!
//! Source: integration of the equation of motion; the same in \[Anagnostopoulos 2004\] for the first form.

use std::f64::consts::PI;

/// Damping ratio ζ at which the restitution is `e`, 0 < e ≤ 1.
pub(crate) fn damping_ratio(e: f64, pull: bool) -> f64 {
    let log = e.ln();
    if pull {
        return -log / PI.hypot(log);
    }
    if e >= 1.0 {
        return 0.0;
    }
    // ln e falls from 0 without bound as ζ grows; halving ends at the last bit.
    let (mut low, mut high) = (0.0, 1.0);
    while log_restitution(high) > log {
        high *= 2.0;
    }
    loop {
        let middle = 0.5 * (low + high);
        if middle <= low || middle >= high {
            return middle;
        }
        if log_restitution(middle) > log {
            low = middle;
        } else {
            high = middle;
        }
    }
}

/// Damping ratio ζ at which the restitution is `e` where the dashpot acts on approach only. The way in
/// is that of a contact that never pulls, where in and out take equal shares of ln e.
pub(crate) fn approach_ratio(e: f64) -> f64 {
    damping_ratio(e * e, false)
}

/// ln e of a contact that never pulls.
fn log_restitution(ratio: f64) -> f64 {
    let square = 1.0 - ratio * ratio;
    // The limit of both forms at ζ = 1, where they are 0/0.
    let quotient = if square.abs() < 1e-9 {
        1.0
    } else if square > 0.0 {
        ratio.acos() / square.sqrt()
    } else {
        ratio.acosh() / (-square).sqrt()
    };
    -2.0 * ratio * quotient
}

#[cfg(test)]
mod tests {
    use super::damping_ratio;
    use approx::assert_relative_eq;

    #[test]
    fn the_ratio_follows_the_integrated_motion() {
        // Restitution and ratios computed by integrating the motion.
        for (e, pulling, pushing) in [
            (0.25, 0.403_712_8, 0.597_342_3),
            (0.5, 0.215_453_8, 0.255_275_6),
            (0.7, 0.112_808_5, 0.122_214_7),
            (0.9, 0.033_518_4, 0.034_265_2),
            (0.05, 0.6901, 1.9453),
            (0.1, 0.5912, 1.2432),
        ] {
            assert_relative_eq!(damping_ratio(e, true), pulling, max_relative = 1e-4);
            assert_relative_eq!(damping_ratio(e, false), pushing, max_relative = 1e-4);
        }
        assert_relative_eq!(damping_ratio(0.25, false), 0.597_342_3, max_relative = 1e-6);
        assert_relative_eq!(damping_ratio((-2.0f64).exp(), false), 1.0, max_relative = 1e-6);
        for pull in [true, false] {
            assert_eq!(damping_ratio(1.0, pull), 0.0);
            assert!(damping_ratio(1e-9, pull).is_finite());
        }
    }
}
