//! A straight piece of a frame: its stiffness, and forces at its nodes that do what loads between them do.
//!
//! Loads act through the shapes that the ends give the piece (shear included), which is exact at the nodes: by Betti the
//! displacement at a place by a unit displacement of an end is the force at that end by a unit load at the place.
//! Released directions are condensed. Reference: Przemieniecki, Theory of Matrix Structural Analysis, 1968, §5.6.

#[cfg(test)]
mod tests;

use super::geometry::{Axes, Vector, to_global};
use super::section::Section;

/// Forces or displacements of both ends.
pub type Ends = [f64; 12];
/// A matrix over both ends.
pub type Matrix = [[f64; 12]; 12];

/// Points and weights of Gauss over −1 … 1, exact to the fifth power.
const GAUSS: [(f64, f64); 3] =
    [(-0.774_596_669_241_483_4, 5.0 / 9.0), (0.0, 8.0 / 9.0), (0.774_596_669_241_483_4, 5.0 / 9.0)];

/// A piece between two nodes.
#[derive(Clone, Debug)]
pub struct Piece {
    pub name: String,
    pub nodes: [usize; 2],
    pub at: [Vector; 2],
    pub axes: Axes,
    pub section: Section,
    /// Where it begins along its frame, and its length.
    pub start: f64,
    pub length: f64,
    /// Lengths at the ends that are rigid in bending and shear.
    pub rigid: [f64; 2],
    /// Released directions and what springs hold them.
    pub released: [[bool; 6]; 2],
    pub fixity: [[f64; 6]; 2],
}

/// Loads of a piece: those at the ends of its flexible part, and those that reach the nodes directly.
#[derive(Clone, Copy, Debug, Default)]
pub struct Loads {
    flexible: Ends,
    direct: Ends,
}

/// Indices of deflection and rotation at both ends, sign of the rotation.
const PLANES: [([usize; 4], f64); 2] = [([1, 5, 7, 11], 1.0), ([2, 4, 8, 10], -1.0)];

impl Piece {
    fn flexible(&self) -> f64 {
        self.length - self.rigid[0] - self.rigid[1]
    }

    /// Bending stiffness and share of shear in plane 1–2 (0) or 1–3 (1).
    fn bending(&self, plane: usize) -> (f64, f64) {
        let s = &self.section;
        let ei = s.young * s.moments[1 - plane];
        let ga = s.shear * s.shear_areas[plane];
        let phi = if ga > 0.0 { 12.0 * ei / (ga * self.flexible().powi(2)) } else { 0.0 };
        (ei, phi)
    }

    /// Stiffness at the ends of the flexible part, nothing released.
    fn whole(&self) -> Matrix {
        let (s, l) = (&self.section, self.flexible());
        let mut k = [[0.0; 12]; 12];
        for (i, x) in [(0, s.young * s.area / self.length), (3, s.shear * s.torsion / self.length)]
        {
            for (a, b, sign) in
                [(i, i, 1.0), (i + 6, i + 6, 1.0), (i, i + 6, -1.0), (i + 6, i, -1.0)]
            {
                k[a][b] += sign * x;
            }
        }
        for (plane, (dofs, sign)) in PLANES.iter().enumerate() {
            let (ei, phi) = self.bending(plane);
            let f = ei / (l.powi(3) * (1.0 + phi));
            let (a, b) = ((4.0 + phi) * l * l, (2.0 - phi) * l * l);
            let (c, t) = (12.0, 6.0 * l);
            let values = [[c, t, -c, t], [t, a, -t, b], [-c, -t, c, -t], [t, b, -t, a]];
            let signs = [1.0, *sign, 1.0, *sign];
            for i in 0..4 {
                for j in 0..4 {
                    k[dofs[i]][dofs[j]] += f * signs[i] * signs[j] * values[i][j];
                }
            }
        }
        k
    }

    /// Takes released directions out of stiffness and loads; springs keep their share.
    fn release(&self, k: &mut Matrix, f: &mut Ends) {
        let original: Ends = std::array::from_fn(|i| k[i][i]);
        for c in 0..12 {
            let (end, dof) = (c / 6, c % 6);
            let spring = self.fixity[end][dof];
            let pivot = k[c][c] + spring;
            if !self.released[end][dof] || pivot <= 1e-10 * original[c] || pivot <= 0.0 {
                continue;
            }
            let (row, load) = (k[c], f[c]);
            for a in (0..12).filter(|a| *a != c) {
                f[a] -= row[a] / pivot * load;
                for b in (0..12).filter(|b| *b != c) {
                    k[a][b] -= row[a] * row[b] / pivot;
                }
                k[a][c] = spring * row[a] / pivot;
                k[c][a] = k[a][c];
            }
            k[c][c] = spring - spring * spring / pivot;
            f[c] = spring / pivot * load;
        }
    }

    /// Forces at the nodes from those at the ends of the flexible part.
    fn through_arms(&self, f: &Ends) -> Ends {
        let mut out = *f;
        for (at, arm) in [(0, self.rigid[0]), (6, -self.rigid[1])] {
            out[at + 5] += arm * f[at + 1];
            out[at + 4] -= arm * f[at + 2];
        }
        out
    }

    /// Forces that displacements of its nodes put on its nodes, all global.
    #[must_use]
    pub fn forces(&self, u: &[[f64; 6]; 2]) -> [[f64; 6]; 2] {
        use super::geometry::{six, to_local};
        let [mut a, mut b] = u.map(|u| six(&self.axes, u, to_local));
        a[1] += self.rigid[0] * a[5];
        a[2] -= self.rigid[0] * a[4];
        b[1] -= self.rigid[1] * b[5];
        b[2] += self.rigid[1] * b[4];
        let u: Ends = std::array::from_fn(|i| if i < 6 { a[i] } else { b[i - 6] });
        let (mut k, mut none) = (self.whole(), [0.0; 12]);
        self.release(&mut k, &mut none);
        let f = k.map(|row| row.iter().zip(u).map(|(k, u)| k * u).sum());
        self.global(&self.through_arms(&f))
    }

    fn global(&self, f: &Ends) -> [[f64; 6]; 2] {
        let end = |at: usize| {
            super::geometry::six(&self.axes, std::array::from_fn(|i| f[at + i]), to_global)
        };
        [end(0), end(6)]
    }

    /// A force and a moment in local axes at a distance from its first node.
    pub fn point(&self, loads: &mut Loads, s: f64, f: [f64; 6]) {
        let share = s / self.length;
        for i in [0, 3] {
            loads.flexible[i] += f[i] * (1.0 - share);
            loads.flexible[i + 6] += f[i] * share;
        }
        let l = self.flexible();
        let x = (s - self.rigid[0]) / l;
        for (plane, (dofs, sign)) in PLANES.iter().enumerate() {
            let (force, moment) = (f[1 + plane], sign * f[5 - plane]);
            if !(0.0..=1.0).contains(&x) {
                // On a rigid end.
                let (at, arm) = if x < 0.0 { (0, s) } else { (2, s - self.length) };
                loads.direct[dofs[at]] += force;
                loads.direct[dofs[at + 1]] += sign * (moment + arm * force);
                continue;
            }
            let (_, phi) = self.bending(plane);
            let (q, c) = (1.0 / (1.0 + phi), x * x);
            let cubic = c * x;
            let deflection = [
                q * (1.0 - 3.0 * c + 2.0 * cubic + phi * (1.0 - x)),
                q * l * (x - 2.0 * c + cubic + phi / 2.0 * (x - c)),
                q * (3.0 * c - 2.0 * cubic + phi * x),
                q * l * (cubic - c + phi / 2.0 * (c - x)),
            ];
            let bend = 6.0 * q / l * (c - x);
            let rotation = [
                bend,
                q * (1.0 - 4.0 * x + 3.0 * c + phi * (1.0 - x)),
                -bend,
                q * (3.0 * c - 2.0 * x + phi * x),
            ];
            for (i, turn) in [1.0, *sign, 1.0, *sign].into_iter().enumerate() {
                loads.flexible[dofs[i]] += turn * (force * deflection[i] + moment * rotation[i]);
            }
        }
    }

    /// A load per length between two distances from the start of the frame, straight between its ends.
    pub fn spread(&self, loads: &mut Loads, [from, to]: [f64; 2], ends: [[f64; 6]; 2]) {
        if to <= from {
            return;
        }
        // Each part of the piece has its own shapes.
        let cuts = [0.0, self.rigid[0], self.length - self.rigid[1], self.length];
        for w in cuts.windows(2) {
            let a = (self.start + w[0]).max(from);
            let b = (self.start + w[1]).min(to);
            if b <= a {
                continue;
            }
            for (x, weight) in GAUSS {
                let s = (a + b) / 2.0 + x * (b - a) / 2.0;
                let share = (s - from) / (to - from);
                let f = std::array::from_fn(|i| {
                    (ends[0][i] + share * (ends[1][i] - ends[0][i])) * weight * (b - a) / 2.0
                });
                self.point(loads, s - self.start, f);
            }
        }
    }

    /// Warmth: degrees, and degrees per length along local 2 and 3, at both ends.
    pub fn warmth(&self, loads: &mut Loads, [a, b]: [[f64; 3]; 2]) {
        let s = &self.section;
        let push = s.young * s.area * s.expansion * (a[0] + b[0]) / 2.0;
        loads.flexible[0] -= push;
        loads.flexible[6] += push;
        let l = self.flexible();
        for (plane, (dofs, sign)) in PLANES.iter().enumerate() {
            let (ei, phi) = self.bending(plane);
            let q = ei / (1.0 + phi);
            for (x, weight) in GAUSS {
                let x = (x + 1.0) / 2.0;
                let at = (self.rigid[0] + x * l) / self.length;
                let curvature = -s.expansion * (a[plane + 1] + at * (b[plane + 1] - a[plane + 1]));
                let bend = 6.0 / l * (2.0 * x - 1.0);
                let shapes = [bend, -4.0 + 6.0 * x - phi, -bend, -2.0 + 6.0 * x + phi];
                for (i, turn) in [1.0, *sign, 1.0, *sign].into_iter().enumerate() {
                    loads.flexible[dofs[i]] += turn * q * shapes[i] * curvature * weight / 2.0;
                }
            }
        }
    }

    /// The forces at its nodes, global.
    #[must_use]
    pub fn at_nodes(&self, loads: &Loads) -> [[f64; 6]; 2] {
        let (mut k, mut f) = (self.whole(), loads.flexible);
        self.release(&mut k, &mut f);
        let mut f = self.through_arms(&f);
        f.iter_mut().zip(loads.direct).for_each(|(a, b)| *a += b);
        self.global(&f)
    }
}
