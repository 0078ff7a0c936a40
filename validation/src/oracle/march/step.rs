//! A step of the structure and its links.

use super::super::problem::{Probe, Problem};
use super::super::radau::Radau;
use super::coordinates::Coordinates;
use super::course::{NODES, Piece, between};
use super::dense::{add_product, dot};
use super::newton::{Settled, Space, solve};
use super::response::{Response, Stage};
use super::stages::Known;
use super::{Scale, State};
use nalgebra::DVector;
use std::collections::HashMap;

/// Where a march is.
#[derive(Clone, Debug)]
pub struct Point {
    /// Coordinates.
    pub q: Vec<f64>,
    /// Their rates.
    pub r: Vec<f64>,
    /// Own unknowns of the links.
    pub z: Vec<f64>,
    /// Forces of the links just before.
    pub f: Vec<f64>,
    /// Branches of their laws just before; none at the start.
    pub branches: Vec<u32>,
}

/// A step that was made.
#[derive(Clone, Debug)]
pub struct Solved {
    /// Coordinates beyond the start.
    x: Stage,
    /// Rates of coordinates over stages, 1/s.
    tilde: [[f64; 3]; 3],
    /// Link deformations beyond the start.
    y: Stage,
    /// Own unknowns.
    z: Stage,
    /// Link deformations.
    d: Stage,
    /// Link forces.
    f: Stage,
    /// Branches of the laws at the first stage.
    first: Vec<u32>,
    /// Its end.
    pub end: Point,
}

impl Solved {
    /// True where a link is on another branch at the first stage than just before, or at the end than there.
    pub fn turned(&self, from: &Point) -> bool {
        let before = !from.branches.is_empty() && from.branches != self.first;
        before || self.first != self.end.branches
    }
}

/// Makes steps.
pub struct Stepper<'a> {
    p: &'a Problem,
    /// The structure.
    pub at: Coordinates,
    rule: Radau,
    responses: HashMap<u64, Response>,
    space: Space,
    /// Multiplications so far or so.
    pub work: f64,
}

/// Responses kept at most.
const RESPONSES: usize = 60;

fn stages(values: impl Fn(usize) -> Vec<f64>) -> Stage {
    [values(0), values(1), values(2)]
}

impl<'a> Stepper<'a> {
    /// For a problem.
    ///
    /// # Errors
    /// A direction that nothing holds.
    pub fn new(p: &'a Problem) -> Result<Self, String> {
        Ok(Self {
            p,
            at: Coordinates::new(p)?,
            rule: Radau::new(),
            responses: HashMap::new(),
            space: Space::default(),
            work: 0.0,
        })
    }

    /// A state as a point.
    pub fn point(&self, s: &State) -> Point {
        let q = self.at.of(self.p, &s.u);
        // Rates of what has no mass follow from the first step.
        let mut r = self.at.of(self.p, &s.v);
        r.iter_mut().zip(&self.at.m).filter(|(_, m)| **m == 0.0).for_each(|(r, _)| *r = 0.0);
        let f = vec![0.0; self.at.links.ncols()];
        Point { q, r, z: s.z.as_slice().to_vec(), f, branches: Vec::new() }
    }

    /// A point as a state.
    pub fn state(&self, p: &Point) -> State {
        State {
            u: self.at.directions(&p.q),
            v: self.at.directions(&p.r),
            z: DVector::from_column_slice(&p.z),
        }
    }

    fn loads(&self, t: f64) -> Vec<f64> {
        let mut load = self.at.constant.clone();
        for (c, force) in self.p.channels.iter().zip(&self.at.channels) {
            let value = c.function.at(t, false)[c.order];
            if value != 0.0 {
                load.iter_mut().zip(force).for_each(|(l, f)| *l += value * f);
            }
        }
        load
    }

    /// Deformations of all link coordinates.
    fn deformations(&self, q: &[f64]) -> Vec<f64> {
        let all = self.at.links.as_slice();
        (0..self.at.links.ncols()).map(|c| dot(&all[c * q.len()..][..q.len()], q)).collect()
    }

    /// Makes a step; `like`: one that holds it, and where it starts in that, as shares of time.
    pub fn step(
        &mut self,
        t: f64,
        h: f64,
        from: &Point,
        scale: &Scale,
        like: Option<(&Solved, f64)>,
    ) -> Option<Solved> {
        let key = h.to_bits() >> 12;
        let (n, l) = (self.at.len(), self.at.links.ncols());
        let mut response = match self.responses.remove(&key) {
            Some(it) => it,
            None => {
                self.work += n as f64 * (40.0 + 1.5 * (l * l) as f64);
                Response::new(&self.rule, &self.at, h)
            }
        };
        self.work += n as f64 * (30.0 + 9.0 * l as f64) + 500.0;
        let solved = self.with(&mut response, t, h, from, scale, like);
        if self.responses.len() > RESPONSES {
            self.responses.clear();
        }
        self.responses.insert(key, response);
        self.work += std::mem::take(&mut self.space.work);
        solved
    }

    fn with(
        &mut self,
        response: &mut Response,
        t: f64,
        h: f64,
        from: &Point,
        scale: &Scale,
        like: Option<(&Solved, f64)>,
    ) -> Option<Solved> {
        let (p, n, l, nz) = (self.p, self.at.len(), self.at.links.ncols(), from.z.len());
        let times = self.times(t, h);
        let mut loads = stages(|i| self.loads(times[i]));
        let mut x = response.alone(&self.at, &from.q, &from.r, &mut loads);
        let (mut y, mut z, mut f, mut d) = <(Stage, Stage, Stage, Stage)>::default();
        let mut all_branches = Vec::new();
        if l > 0 {
            let alone = stages(|i| self.deformations(&x[i]));
            let mut start = stages(|_| self.deformations(&from.q));
            let mut moved = stages(|_| vec![0.0; l]);
            if !p.moved.is_empty() {
                for i in 0..3 {
                    let [place, rate] = p.supports(times[i], false);
                    let (place, rate) = (&p.a.b_s * place, &p.a.b_s * rate);
                    for c in 0..p.a.b.nrows() {
                        start[i][c] += place[c];
                        moved[i][c] = rate[c];
                    }
                }
            }
            let sizes = self.sizes(&start[2], scale);
            let mut kept = std::mem::take(&mut response.kept);
            let known = Known {
                p,
                count: (l, nz),
                response: &*response,
                alone,
                start,
                moved,
                own: &from.z,
            };
            let guess = match like {
                Some((whole, s)) => guess_within(whole, s, from, l),
                None => guess_ahead(&known, from),
            };
            let settled = solve(&known, guess, &sizes, &mut kept, &mut self.space);
            d = known.start;
            response.kept = kept;
            let Settled { x: unknown, f: forces, branches } = settled?;
            all_branches = branches;
            y = stages(|i| unknown[i * l..(i + 1) * l].to_vec());
            z = stages(|i| unknown[3 * l + i * nz..3 * l + (i + 1) * nz].to_vec());
            f = stages(|i| forces[i * l..(i + 1) * l].to_vec());
            for i in 0..3 {
                d[i].iter_mut().zip(&y[i]).for_each(|(d, y)| *d += y);
            }
            let push = stages(|i| {
                let mut push = vec![0.0; n];
                for (c, f) in f[i].iter().enumerate().filter(|(_, f)| **f != 0.0) {
                    let row = &self.at.links.as_slice()[c * n..(c + 1) * n];
                    push.iter_mut().zip(row).for_each(|(p, b)| *p += f * b);
                }
                push
            });
            for (x, w) in x.iter_mut().zip(response.stages(&push)) {
                x.iter_mut().zip(w).for_each(|(x, w)| *x -= w);
            }
        }
        let q = from.q.iter().zip(&x[2]).map(|(q, x)| q + x).collect();
        let r = response.rate(2, &x);
        let links = p.a.links.len().min(all_branches.len());
        let branches = all_branches.split_off(all_branches.len() - links);
        let end = Point { q, r, z: z[2].clone(), f: f[2].clone(), branches };
        all_branches.truncate(links);
        Some(Solved { x, tilde: response.tilde, y, z, d, f, first: all_branches, end })
    }

    /// How far links go on before the first stage of a step, where they are on another branch than at the end of the
    /// step before: what they do on the way no stage sees. Largest share of `sizes`, of links with own unknowns
    /// or a force that jumps, and of others.
    pub fn unseen(&self, t: f64, h: f64, from: &Point, step: &Solved, sizes: &[f64]) -> [f64; 2] {
        let mut unseen = [0.0_f64; 2];
        let p = self.p;
        if from.branches.is_empty() {
            return unseen;
        }
        let moved = (!p.moved.is_empty()).then(|| {
            let [from, _] = p.supports(t, true);
            let [to, _] = p.supports(self.times(t, h)[0], false);
            &p.a.b_s * (to - from)
        });
        for (i, link) in p.a.links.iter().enumerate() {
            if from.branches[i] == step.first[i] {
                continue;
            }
            let most = &mut unseen[usize::from(!link.law.remembers_or_jumps())];
            for c in link.first..link.first + link.axes.len() {
                let way = step.y[0][c] + moved.as_ref().map_or(0.0, |m| m[c]);
                *most = most.max(way.abs() / sizes[c].max(1e-12));
            }
        }
        unseen
    }

    fn times(&self, t: f64, h: f64) -> [f64; 3] {
        self.rule.c.map(|c| if c == 1.0 { t + h } else { t + c * h })
    }

    /// Sizes of the unknowns of the links that their accuracy is measured against.
    fn sizes(&self, d: &[f64], scale: &Scale) -> Vec<f64> {
        let l = self.p.a.b.nrows();
        let known = |i: usize| if i < l { scale.d[i] } else { 0.0 };
        let of_d: Vec<f64> = d.iter().enumerate().map(|(i, d)| known(i).max(d.abs())).collect();
        let mut of_z = Vec::with_capacity(scale.z.len());
        for link in &self.p.a.links {
            let size =
                of_d[link.first..][..link.axes.len()].iter().fold(0.0, |a: f64, b| a.max(*b));
            let size = size * link.law.own_size();
            of_z.extend((0..link.law.unknowns()).map(|_| size));
        }
        [&of_d, &of_d, &of_d, &of_z, &of_z, &of_z].into_iter().flatten().copied().collect()
    }

    /// The probes over a step.
    pub fn piece(&self, t: f64, h: f64, before: &Point, s: &Solved) -> Piece {
        let p = self.p;
        let [a, b, c] = self.times(t, h);
        let times = [t, a, b, c];
        let moved: Vec<_> = match p.moved.is_empty() {
            true => Vec::new(),
            false => (0..4).map(|i| p.supports(times[i], i == 0)).collect(),
        };
        let beside = |row: &DVector<f64>, i: usize, order: usize| match moved.is_empty() {
            true => 0.0,
            false => row.dot(&moved[i][order]),
        };
        let one = |(probe, row): (&Probe, &Vec<f64>)| {
            let mut values = [f64::NAN; 4];
            let x = || stages_of(row, &s.x);
            match probe {
                Probe::Displacement(_, m) => {
                    let (start, x) = (dot(row, &before.q), x());
                    values[0] = start + beside(m, 0, 0);
                    (1..4).for_each(|i| values[i] = start + x[i - 1] + beside(m, i, 0));
                }
                Probe::Velocity(_, m) => {
                    let x = x();
                    for i in 1..4 {
                        values[i] = s.tilde[i - 1].iter().zip(x).map(|(a, x)| a * x).sum::<f64>()
                            + beside(m, i, 1);
                    }
                }
                Probe::Acceleration(_, m, base) => {
                    // Rates at the stages, beyond that at the start.
                    let (x, start) = (x(), dot(row, &before.r));
                    let rate = s.tilde.map(|t| dot(&t, &x) - start);
                    for i in 1..4 {
                        let all = p.moved.iter().map(|f| f.at(times[i], false)[2]);
                        let with = m.iter().zip(all).map(|(m, a)| m * a);
                        let base = base.iter().map(|f| f.at(times[i], false)[0]);
                        values[i] = dot(&s.tilde[i - 1], &rate) + with.chain(base).sum::<f64>();
                    }
                }
                Probe::Member([(_, m), (_, w)]) => {
                    let (of_place, of_rate) = row.split_at(before.q.len());
                    let (start, x) = (dot(of_place, &before.q), stages_of(of_place, &s.x));
                    let y = stages_of(of_rate, &s.x);
                    for i in 1..4 {
                        values[i] = start + x[i - 1] + dot(&s.tilde[i - 1], &y);
                        values[i] += beside(m, i, 0) + beside(w, i, 1);
                    }
                }
                Probe::Force(c) => (1..4).for_each(|i| values[i] = s.f[i - 1][*c]),
                Probe::Deformation(c) => (1..4).for_each(|i| values[i] = s.d[i - 1][*c]),
            }
            values
        };
        Piece { t, h, values: p.probes.iter().zip(&self.at.probes).map(one).collect() }
    }
}

fn stages_of(row: &[f64], x: &Stage) -> [f64; 3] {
    [0, 1, 2].map(|i| dot(row, &x[i]))
}

/// A first guess from a step that was made and holds this one.
fn guess_within(whole: &Solved, s: f64, from: &Point, l: usize) -> Vec<f64> {
    let (nz, begin) = (from.z.len(), if s > 0.0 { 0.5 } else { 0.0 });
    let mut guess = vec![0.0; 3 * (l + nz)];
    for c in 0..l {
        let values = [0.0, whole.y[0][c], whole.y[1][c], whole.y[2][c]];
        let start = between(&values, begin);
        for i in 0..3 {
            guess[i * l + c] = between(&values, begin + 0.5 * NODES[i + 1]) - start;
        }
    }
    for c in 0..nz {
        let values = [f64::NAN, whole.z[0][c], whole.z[1][c], whole.z[2][c]];
        for i in 0..3 {
            guess[3 * l + i * nz + c] = between(&values, begin + 0.5 * NODES[i + 1]);
        }
    }
    guess
}

/// A first guess: forces and own unknowns as they were.
fn guess_ahead(known: &Known<'_>, from: &Point) -> Vec<f64> {
    let mut guess: Vec<f64> = known.alone.iter().flatten().copied().collect();
    let forces = [&from.f, &from.f, &from.f].into_iter().flatten().map(|f| -f).collect::<Vec<_>>();
    add_product(&mut guess, &known.response.links, &forces);
    (0..3).for_each(|_| guess.extend_from_slice(known.own));
    guess
}
