//! The part of the work of z that became heat.

use super::BoucWen;

impl BoucWen {
    /// θ with ∫_θ^ε A/η dε = ½ z², at least `before`.
    pub(super) fn heat(&self, before: f64, work: f64, z: f64) -> f64 {
        let wanted = self.stretch(before, work) - 0.5 * z * z;
        // A/η falls with ε: Newton's method comes up from `before` and cannot pass the root.
        let mut heat = before;
        for _ in 0..60 {
            let change = (wanted - self.stretch(before, heat)) * self.compliance(heat);
            if change <= 1e-15 * work.max(heat) {
                break;
            }
            heat += change;
        }
        heat
    }

    /// η/A.
    fn compliance(&self, work: f64) -> f64 {
        let a = (self.a0 - self.delta_a * work).max(super::LEAST * self.a0);
        (1.0 + self.delta_eta * work) / a
    }

    /// ∫ A/η dε between two works.
    fn stretch(&self, from: f64, to: f64) -> f64 {
        let kept = super::LEAST * self.a0;
        let end = if self.delta_a > 0.0 { (self.a0 - kept) / self.delta_a } else { f64::INFINITY };
        let (middle, start) = (to.min(end).max(from), from.max(end));
        let falling = if from < end {
            self.piece(from, middle, self.a0 - self.delta_a * from, self.delta_a)
        } else {
            0.0
        };
        let level = if to > end { self.piece(start, to, kept, 0.0) } else { 0.0 };
        falling + level
    }

    /// ∫ (a − δ (ε − `from`))/η dε from `from` to `to`.
    fn piece(&self, from: f64, to: f64, a: f64, delta: f64) -> f64 {
        let eta = 1.0 + self.delta_eta * from;
        let w = to - from;
        let y = self.delta_eta * w / eta;
        // ln(1 + y)/y and (y − ln(1 + y))/y².
        let (one, two) = if y.abs() < 0.01 {
            let sum = |m: i32| (0..9).rev().fold(0.0, |s, k| 1.0 / f64::from(m + k) - y * s);
            (sum(1), sum(2))
        } else {
            let l = y.ln_1p();
            (l / y, (y - l) / (y * y))
        };
        w * (a * one - delta * w * two) / eta
    }
}
