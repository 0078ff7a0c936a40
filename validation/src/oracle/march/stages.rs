//! The equations of the links at the stages of a step.

use super::super::laws::At;
use super::super::number::Dual;
use super::super::problem::Problem;
use super::dense::{Factor, add_product};
use super::response::{Response, Stage};

/// What is known of a step before its links are.
pub struct Known<'a> {
    /// The problem.
    pub p: &'a Problem,
    /// Number of link coordinates, and of own unknowns.
    pub count: (usize, usize),
    /// Response of the structure.
    pub response: &'a Response,
    /// Deformations beyond the start of the step that the structure would have alone.
    pub alone: Stage,
    /// Deformations at the start, with that of moved supports at the stages.
    pub start: Stage,
    /// Rates from moved supports.
    pub moved: Stage,
    /// Own unknowns at the start.
    pub own: &'a [f64],
}

/// Values of the laws: forces on all link coordinates and residuals of own equations, by stages.
#[derive(Clone, Debug, Default)]
pub struct Values {
    /// Forces.
    pub f: Vec<f64>,
    /// Residuals.
    pub g: Vec<f64>,
    /// Branches of the laws.
    pub branches: Vec<u32>,
}

/// Tangents of a link over the three stages, its own unknowns eliminated.
#[derive(Clone, Debug)]
pub struct Tangent {
    /// Its first coordinate and their number; its first own unknown and their number.
    pub at: [usize; 4],
    /// Forces over deformations.
    pub f: Vec<f64>,
    /// Forces over own unknowns.
    pub f_by_own: Vec<f64>,
    /// Own equations over own unknowns.
    pub own: Option<Factor>,
    /// Own unknowns that follow deformations.
    pub follow: Vec<f64>,
    /// Largest term of each own equation.
    pub sizes: Vec<f64>,
}

/// Room for the numbers of a law.
#[derive(Default)]
pub struct Room {
    input: Vec<Dual>,
    f: Vec<Dual>,
    g: Vec<Dual>,
}

impl Known<'_> {
    /// Deformations, rates, own unknowns and their rates of a link at a stage.
    fn input(&self, room: &mut Room, x: &[f64], stage: usize, [first, m, own, k]: [usize; 4]) {
        let (l, nz) = self.count;
        let [a, b, c] = self.response.tilde[stage];
        let own_at = |j: usize, i: usize| x[3 * l + j * nz + i];
        let number = |x: f64| Dual(x, 0.0);
        room.input.clear();
        let d = (first..first + m).map(|i| self.start[stage][i] + x[stage * l + i]);
        room.input.extend(d.map(number));
        let v = (first..first + m)
            .map(|i| a * x[i] + b * x[l + i] + c * x[2 * l + i] + self.moved[stage][i]);
        room.input.extend(v.map(number));
        room.input.extend((own..own + k).map(|i| number(own_at(stage, i))));
        let w = (own..own + k).map(|i| {
            let z = self.own[i];
            a * (own_at(0, i) - z) + b * (own_at(1, i) - z) + c * (own_at(2, i) - z)
        });
        room.input.extend(w.map(number));
        room.f.resize(m, Dual::default());
        room.g.resize(k, Dual::default());
    }

    fn ask(&self, room: &mut Room, link: usize, m: usize, k: usize) -> u32 {
        let (d, rest) = room.input.split_at(m);
        let (v, rest) = rest.split_at(m);
        let (z, w) = rest.split_at(k);
        let at = At { d, v, z, w, still: self.p.still, creep: self.p.creep };
        self.p.a.links[link].law.answer(&at, &mut room.f, &mut room.g)
    }

    /// First coordinate, number, first own unknown, number of every link.
    fn places(&self) -> impl Iterator<Item = [usize; 4]> + '_ {
        let mut own = 0;
        self.p.a.links.iter().map(move |link| {
            let k = link.law.unknowns();
            own += k;
            [link.first, link.axes.len(), own - k, k]
        })
    }

    /// Forces and residuals.
    pub fn values(&self, x: &[f64], room: &mut Room, out: &mut Values) {
        let (l, nz) = self.count;
        out.f.resize(3 * l, 0.0);
        out.g.resize(3 * nz, 0.0);
        out.branches.clear();
        let a = &self.p.a;
        for stage in 0..3 {
            for (link, at) in self.places().enumerate() {
                let [first, m, own, k] = at;
                self.input(room, x, stage, at);
                out.branches.push(self.ask(room, link, m, k));
                (0..m).for_each(|c| out.f[stage * l + first + c] = room.f[c].0);
                (0..k).for_each(|c| out.g[stage * nz + own + c] = room.g[c].0);
            }
            let [r, s, t] = self.response.tilde[stage];
            let laws = a.b.nrows();
            for (i, c) in (laws..).zip(&a.dash) {
                out.f[stage * l + i] = c * (r * x[i] + s * x[l + i] + t * x[2 * l + i]);
            }
            for i in laws + a.dash.len()..l {
                out.f[stage * l + i] = -x[stage * l + i];
            }
        }
    }

    /// What is left of the equations: deformations first, then own unknowns.
    pub fn residual(&self, x: &[f64], it: &Values, r: &mut Vec<f64>) {
        let l = self.count.0;
        r.clear();
        r.extend((0..3 * l).map(|i| x[i] - self.alone[i / l][i % l]));
        add_product(r, &self.response.links, &it.f);
        r.extend_from_slice(&it.g);
    }

    /// Tangents of all links; none where the own equations of one are singular.
    pub fn tangents(&self, x: &[f64], room: &mut Room) -> Option<Vec<Tangent>> {
        let tilde = &self.response.tilde;
        let mut all = Vec::with_capacity(self.count.0);
        for (link, at) in self.places().enumerate() {
            let [_, m, _, k] = at;
            let (m3, k3) = (3 * m, 3 * k);
            let mut f = vec![0.0; m3 * m3];
            let mut f_by_own = vec![0.0; m3 * k3];
            let mut g = vec![0.0; k3 * m3];
            let mut own = vec![0.0; k3 * k3];
            for stage in 0..3 {
                self.input(room, x, stage, at);
                for seed in 0..2 * (m + k) {
                    room.input.iter_mut().for_each(|x| x.1 = 0.0);
                    room.input[seed].1 = 1.0;
                    self.ask(room, link, m, k);
                    // A rate follows from all stages.
                    let (of_own, place, rate) = match seed {
                        s if s < m => (false, s, false),
                        s if s < 2 * m => (false, s - m, true),
                        s if s < 2 * m + k => (true, s - 2 * m, false),
                        s => (true, s - 2 * m - k, true),
                    };
                    for j in 0..3 {
                        let share = match rate {
                            true => tilde[stage][j],
                            false if j == stage => 1.0,
                            false => continue,
                        };
                        let (width, column) =
                            if of_own { (k3, j * k + place) } else { (m3, j * m + place) };
                        let (of_f, of_g) =
                            if of_own { (&mut f_by_own, &mut own) } else { (&mut f, &mut g) };
                        for c in 0..m {
                            of_f[(stage * m + c) * width + column] += share * room.f[c].1;
                        }
                        for c in 0..k {
                            of_g[(stage * k + c) * width + column] += share * room.g[c].1;
                        }
                    }
                }
            }
            let largest = |a: &[f64]| a.iter().fold(0.0_f64, |s, x| s.max(x.abs()));
            let size = |i: usize| {
                largest(&g[i * m3..(i + 1) * m3]).max(largest(&own[i * k3..(i + 1) * k3]))
            };
            let sizes = (0..k3).map(size).collect();
            let mut follow = vec![0.0; k3 * m3];
            let mut factor = None;
            if k > 0 {
                let own = Factor::new(own, k3)?;
                let mut column = vec![0.0; k3];
                for j in 0..m3 {
                    (0..k3).for_each(|i| column[i] = g[i * m3 + j]);
                    own.solve(&mut column, &mut Vec::new());
                    (0..k3).for_each(|i| follow[i * m3 + j] = column[i]);
                }
                for i in 0..m3 {
                    for n in 0..k3 {
                        let share = f_by_own[i * k3 + n];
                        (0..m3).for_each(|j| f[i * m3 + j] -= share * follow[n * m3 + j]);
                    }
                }
                factor = Some(own);
            }
            all.push(Tangent { at, f, f_by_own, own: factor, follow, sizes });
        }
        let laws = self.p.a.b.nrows();
        let plain = |i: usize, f: Vec<f64>| Tangent {
            at: [i, 1, 0, 0],
            f,
            f_by_own: Vec::new(),
            own: None,
            follow: Vec::new(),
            sizes: Vec::new(),
        };
        let dash = &self.p.a.dash;
        for (i, c) in (laws..).zip(dash) {
            all.push(plain(i, tilde.iter().flatten().map(|x| c * x).collect()));
        }
        for i in laws + dash.len()..self.count.0 {
            all.push(plain(i, vec![-1.0, 0.0, 0.0, 0.0, -1.0, 0.0, 0.0, 0.0, -1.0]));
        }
        Some(all)
    }
}
