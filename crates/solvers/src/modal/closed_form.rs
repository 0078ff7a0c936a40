//! The motion of modes inside a step of the exact rule.

use super::recurrence::{Recurrence, Structure};
use trilith_linalg::add_products;

/// The closed form of FNA over a step, taken from the motions at its ends alone: with loads and link forces linear
/// in the step, what drives a mode is known at both ends from q̈ + D q̇ + Ω² q.
pub(crate) struct ClosedForm {
    structure: Structure,
    /// ω of the modes, rad/s.
    pub omega: Vec<f64>,
    /// Recurrences by their length, the one used last at the end.
    recurrences: Vec<(f64, Recurrence)>,
}

/// Values (8 bytes each) in the recurrences that are kept.
const KEPT_VALUES: usize = 1 << 22;
/// Recurrences kept at least and at most.
const KEPT: (usize, usize) = (2, 64);

/// Difference between the closed form and a step that was made otherwise, as a share of the motion.
const OTHERWISE: f64 = 1e-6;

impl ClosedForm {
    /// Of a structure on a basis.
    pub(crate) fn new(structure: &Structure) -> Self {
        let structure = structure.clone();
        let omega = structure.omega2[..structure.modes].iter().map(|w| w.max(0.0).sqrt()).collect();
        Self { structure, omega, recurrences: Vec::new() }
    }

    /// What drives the modes and the static shapes: s = q̈ + D q̇ + Ω² q, without q̈ in these.
    fn source(&self, motion: &[f64]) -> Vec<f64> {
        let Structure { modes, omega2, rates, damping, .. } = &self.structure;
        let n = omega2.len();
        let mut s = motion[2 * n..].to_vec();
        s[*modes..].fill(0.0);
        let (q, v) = (&motion[..n], &motion[n..2 * n]);
        match damping {
            Some(damping) => damping.mul_add(1.0, v, &mut s),
            None => add_products(1.0, rates, v, &mut s),
        }
        add_products(1.0, omega2, q, &mut s);
        s
    }

    /// Square of the amplitude with which a mode swings about what the loads move slowly, in a step of this length, at the
    /// end where it is larger; as if no other mode damped it.
    #[inline]
    pub(crate) fn swing_square(&self, j: usize, from: &[f64], to: &[f64], length: f64) -> f64 {
        let w2 = self.structure.omega2[j];
        let [start, end] = self.swinging(j, from, to, length).map(|[q, v]| q * q + v * v / w2);
        start.max(end)
    }

    /// Displacement and velocity of that swing at both ends of the step.
    #[inline]
    pub(crate) fn swinging(
        &self,
        j: usize,
        from: &[f64],
        to: &[f64],
        length: f64,
    ) -> [[f64; 2]; 2] {
        let n = self.structure.omega2.len();
        let w2 = self.structure.omega2[j];
        let slow = |x: &[f64]| x[j] + (x[2 * n + j] + self.structure.rates[j] * x[n + j]) / w2;
        let (start, end) = (slow(from), slow(to));
        let rate = (end - start) / length;
        [[from[j] - start, from[n + j] - rate], [to[j] - end, to[n + j] - rate]]
    }

    /// How far a force of one unit moves a coordinate with these shares of the motion in a step of this length, at most.
    pub(crate) fn yields(&self, row: impl Iterator<Item = (usize, f64)>, length: f64) -> f64 {
        let Structure { modes, omega2, .. } = &self.structure;
        let share = |(j, b): (usize, f64)| {
            let soft = omega2[j].max(0.0).recip();
            b * b * if j < *modes { soft.min(length * length / 6.0) } else { soft }
        };
        // What takes no part in the motion may be as soft as it likes.
        row.filter(|(_, b)| *b != 0.0).map(share).sum()
    }

    /// Leads a motion over a part as long as those that [`inside`](Self::inside) evaluated last, under what drives it at
    /// both ends of the part.
    pub(crate) fn go_on(&self, motion: &mut Vec<f64>, [source0, source1]: [&[f64]; 2]) {
        let Some((_, recurrence)) = self.recurrences.last() else { return };
        let n = self.structure.omega2.len();
        let mut next = vec![0.0; 3 * n];
        let (q, rest) = next.split_at_mut(n);
        let (v, a) = rest.split_at_mut(n);
        let inputs = [&motion[..n], &motion[n..2 * n], source0, source1];
        recurrence.apply(1, inputs, q);
        recurrence.apply(2, inputs, v);
        self.structure.acceleration(source1, q, v, a);
        *motion = next;
    }

    /// The recurrence of a length, out of those that are kept: the caller puts it back.
    fn recurrence(&mut self, length: f64) -> Recurrence {
        if let Some(at) = self.recurrences.iter().position(|(known, _)| *known == length) {
            return self.recurrences.remove(at).1;
        }
        let n = self.omega.len();
        let values = if self.structure.damping.is_some() { 12 * n * n } else { 12 * n };
        let most = (KEPT_VALUES / values.max(1)).clamp(KEPT.0, KEPT.1);
        self.recurrences.drain(..(self.recurrences.len() + 1).saturating_sub(most));
        Recurrence::exact(&self.structure, length)
    }

    /// The motions at the ends of all but the last of so many equal parts of a step; none where the step was made by
    /// another rule.
    pub(crate) fn inside(
        &mut self,
        from: &[f64],
        to: &[f64],
        length: f64,
        parts: usize,
    ) -> Vec<Vec<f64>> {
        let n = self.structure.omega2.len();
        let part = length / parts as f64;
        let (s0, s1) = (self.source(from), self.source(to));
        let recurrence = self.recurrence(part);
        let at = |i: usize| -> Vec<f64> {
            let share = i as f64 / parts as f64;
            s0.iter().zip(&s1).map(|(a, b)| a + share * (b - a)).collect()
        };
        let mut all = vec![from.to_vec()];
        for i in 1..=parts {
            let (before, source0, source1) = (&all[i - 1], at(i - 1), at(i));
            let mut motion = vec![0.0; 3 * n];
            let (q, rest) = motion.split_at_mut(n);
            let (v, a) = rest.split_at_mut(n);
            let inputs = [&before[..n], &before[n..2 * n], &source0[..], &source1[..]];
            recurrence.apply(1, inputs, q);
            recurrence.apply(2, inputs, v);
            self.structure.acceleration(&source1, q, v, a);
            all.push(motion);
        }
        self.recurrences.push((part, recurrence));
        let end = all.pop().unwrap_or_default();
        // Static shapes that nothing damps have rates of their own making.
        let free = |order: usize, i: &usize| order == 0 || !self.structure.undamped.contains(i);
        let agree = |order: usize| {
            let own = || (0..n).filter(|i| free(order, i)).map(|i| order * n + i);
            let square = |x: &mut dyn Iterator<Item = f64>| x.map(|x| x * x).sum::<f64>();
            let most = all.iter().map(|m| square(&mut own().map(|i| m[i]))).fold(0.0, f64::max);
            square(&mut own().map(|i| end[i] - to[i])) <= OTHERWISE * OTHERWISE * most
        };
        if agree(0) && agree(1) { all.split_off(1) } else { Vec::new() }
    }
}
