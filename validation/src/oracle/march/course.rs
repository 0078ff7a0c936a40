//! Values of what is recorded over a march, between its steps too.

/// Nodes of a step: its start and its stages.
pub const NODES: [f64; 4] = [0.0, 0.155_051_025_721_682_2, 0.644_948_974_278_317_8, 1.0];

/// Values of the probes over a step: at its start and its three stages.
#[derive(Clone, Debug)]
pub struct Piece {
    /// Its start.
    pub t: f64,
    /// Its length.
    pub h: f64,
    /// Values at the nodes; not a number at the start where the value there is none.
    pub values: Vec<[f64; 4]>,
}

/// The polynomial through values at the nodes; without the first where that is no number.
#[must_use]
pub fn between(values: &[f64; 4], s: f64) -> f64 {
    let from = usize::from(values[0].is_nan());
    let mut sum = 0.0;
    for i in from..4 {
        let mut share = 1.0;
        for j in (from..4).filter(|j| *j != i) {
            share *= (s - NODES[j]) / (NODES[i] - NODES[j]);
        }
        sum += share * values[i];
    }
    sum
}

impl Piece {
    /// Largest distance from what two pieces with other nodes say of the same time, as share of `sizes`.
    #[must_use]
    pub fn apart(&self, halves: &[Self; 2], sizes: &[f64]) -> f64 {
        let mut most = 0.0_f64;
        for (i, (values, size)) in self.values.iter().zip(sizes).enumerate() {
            for half in halves {
                for (c, x) in NODES.iter().zip(half.values[i]).skip(1) {
                    let s = (half.t + c * half.h - self.t) / self.h;
                    most = most.max((between(values, s) - x).abs() / size);
                }
            }
        }
        most
    }
}

impl Piece {
    /// How far what is known at the stages alone goes on before the first stage of the piece behind, where it is
    /// elsewhere by then: no node has it. Largest share of `sizes`.
    #[must_use]
    pub fn lost(&self, next: &Self, sizes: &[f64]) -> f64 {
        let s = 1.0 + NODES[1] * next.h / self.h;
        let mut most = 0.0_f64;
        for ((old, new), size) in self.values.iter().zip(&next.values).zip(sizes) {
            if new[0].is_nan() {
                let led = between(old, s);
                most = most.max((led - old[3]).abs().min((led - new[1]).abs()) / size);
            }
        }
        most
    }

    /// How far what is known at the stages alone, led back to the start of the piece behind, is from where it was at
    /// the end of this one. Largest share of `sizes`.
    #[must_use]
    pub fn jump(&self, next: &Self, sizes: &[f64]) -> f64 {
        let mut most = 0.0_f64;
        for ((old, new), size) in self.values.iter().zip(&next.values).zip(sizes) {
            if new[0].is_nan() {
                most = most.max((between(new, 0.0) - old[3]).abs() / size);
            }
        }
        most
    }
}

/// What a march leaves in its probes.
#[derive(Clone, Debug, Default)]
pub struct Record {
    /// Steps one after the other.
    pub pieces: Vec<Piece>,
}

impl Record {
    /// Value of a probe at a time.
    #[must_use]
    pub fn at(&self, probe: usize, t: f64) -> f64 {
        let i = self.pieces.partition_point(|p| p.t + p.h < t).min(self.pieces.len() - 1);
        self.within(i, probe, t)
    }

    fn within(&self, piece: usize, probe: usize, t: f64) -> f64 {
        let p = &self.pieces[piece];
        between(&p.values[probe], ((t - p.t) / p.h).clamp(0.0, 1.0))
    }

    /// Smallest and largest value of a probe between two times: there, at the nodes and in the middle.
    #[must_use]
    pub fn span(&self, probe: usize, from: f64, to: f64) -> (f64, f64) {
        let (mut low, mut high) = (f64::INFINITY, f64::NEG_INFINITY);
        let mut add = |x: f64| (low, high) = (low.min(x), high.max(x));
        let first = self.pieces.partition_point(|p| p.t + p.h < from);
        let last = self.pieces.len() - 1;
        add(self.within(first.min(last), probe, from));
        add(self.at(probe, 0.5 * (from + to)));
        let mut end = first.min(last);
        while end < last && self.pieces[end].t + self.pieces[end].h < to {
            end += 1;
        }
        add(self.within(end, probe, to));
        for p in self.pieces[first.min(last)..].iter().take_while(|p| p.t <= to) {
            for (c, x) in NODES.iter().zip(p.values[probe]) {
                let t = p.t + c * p.h;
                if (from..=to).contains(&t) && !x.is_nan() {
                    add(x);
                }
            }
        }
        (low, high)
    }
}
