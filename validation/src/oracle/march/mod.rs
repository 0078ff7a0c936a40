//! Radau IIA on the whole structure, step by step.
//!
//! | file | does |
//! |---|---|
//! | `coordinates` | the structure without links, as single equations |
//! | `response` | their answer within a step of one size |
//! | `stages` | the links at the stages |
//! | `newton` | deformations and own unknowns of the links |
//! | `step` | a step |
//! | `course` | what is recorded |
//!
//! Every step is made whole and in halves; their distance is the error, and the halves are kept.

mod coordinates;
mod course;
mod dense;
mod newton;
mod response;
mod stages;
mod step;

use super::problem::Problem;
use course::{Piece, Record};
use nalgebra::DVector;
use step::{Point, Solved, Stepper};

/// Displacements, velocities (of what has mass) and own unknowns of the links.
#[derive(Clone, Debug)]
pub struct State {
    /// Displacements.
    pub u: DVector<f64>,
    /// Velocities.
    pub v: DVector<f64>,
    /// Own unknowns.
    pub z: DVector<f64>,
}

/// Largest values so far: what errors are measured against.
#[derive(Clone, Debug)]
pub struct Scale {
    u: DVector<f64>,
    v: DVector<f64>,
    z: DVector<f64>,
    d: DVector<f64>,
}

impl Scale {
    /// Of displacements up to this one.
    #[must_use]
    pub fn of(p: &Problem, displacement: f64) -> Self {
        let (n, l) = (p.a.k.nrows(), p.a.b.nrows());
        let own = p.a.links.iter().flat_map(|l| vec![l.law.own_size(); l.law.unknowns()]);
        let z = DVector::from_iterator(p.unknowns(), own) * displacement;
        let all = |n| DVector::from_element(n, displacement);
        Self { u: all(n), v: all(n), z, d: all(l) }
    }

    fn largest(p: &Problem, of: &DVector<f64>, turns: bool) -> f64 {
        let on = |j: &usize| {
            let column = p.a.t.column(*j);
            (0..column.len()).any(|i| column[i] != 0.0 && (i % 6 > 2) == turns)
        };
        (0..of.len()).filter(on).map(|j| of[j]).fold(0.0, f64::max)
    }

    /// Largest displacement, or rotation, of any direction.
    #[must_use]
    pub fn displacement(&self, p: &Problem, turns: bool) -> f64 {
        Self::largest(p, &self.u, turns)
    }

    /// Largest velocity of any direction.
    #[must_use]
    pub fn velocity(&self, p: &Problem, turns: bool) -> f64 {
        Self::largest(p, &self.v, turns)
    }
}

/// What a march leaves.
#[derive(Clone, Debug)]
pub struct Course {
    record: Record,
    /// State at the end.
    pub end: State,
    /// Largest values.
    pub scale: Scale,
    /// Steps made.
    pub steps: usize,
}

/// How finely, and how much work at most.
#[derive(Clone, Copy, Debug)]
pub struct Effort {
    /// Error of a step, as share of the largest value so far.
    pub tolerance: f64,
    /// Work at most, in multiplications or so.
    pub work: f64,
}

/// What the outputs between the ends of steps are asked for, where they are asked: links that stick and slip within
/// a step bend their forces, though all is well at its ends.
#[derive(Clone, Debug)]
pub struct Between {
    /// Sizes of the outputs.
    pub sizes: Vec<f64>,
    /// Share of these that two polynomials may be apart.
    pub share: f64,
    /// Times closer than this are alike, s.
    pub window: f64,
}

/// Where loads begin or bend, forces are known at no time before the first stage: their polynomial is led on to the
/// start, which may be the largest or least value around, and no other time says that. The first step is held to what
/// is asked between the ends of steps down to this share of the window, and so is a step in which a link turns to
/// another branch: what its force did just before is the largest value, where it jumps.
const FIRST: f64 = 1.0 / 64.0;

/// Share of its size that an output may jump by where a link turns to another branch, in steps that are no window.
const JUMP: f64 = 1e-3;

/// First steps in the whole of a problem. A damped stop that begins pressed in may let go within a millionth of it; but
/// where nobody knows yet how large motions get, all that happens within that is large.
const FIRST_OF_ALL: f64 = 1024.0;
const FIRST_WHERE_KNOWN: f64 = 1_048_576.0;

/// Links without unknowns of their own whose force does not jump remember nothing of the way that no stage has seen: it
/// counts by this share.
const OF_NONE: f64 = 1e-3;

struct March<'a> {
    steps: Stepper<'a>,
    tolerance: f64,
    between: Option<&'a Between>,
    scale: Scale,
    /// Directions with mass.
    heavy: Vec<bool>,
    /// Sizes of own unknowns for a deformation of 1.
    own: DVector<f64>,
    /// Own unknowns of every link.
    links: Vec<std::ops::Range<usize>>,
}

/// A step that was tried: its error as share of the largest values, its halves, where they end.
struct Tried {
    error: f64,
    halves: [Solved; 2],
    end: State,
}

/// Why a march does not come to its end.
#[derive(Clone, Debug)]
pub enum Halt {
    /// Its work is spent: how many steps were tried, how far it came, s.
    Spent(usize, f64),
    /// It cannot go on.
    Stuck(String),
}

impl From<String> for Halt {
    fn from(reason: String) -> Self {
        Self::Stuck(reason)
    }
}

impl std::fmt::Display for Halt {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Self::Spent(steps, _) => write!(f, "{steps} steps were too much work"),
            Self::Stuck(reason) => f.write_str(reason),
        }
    }
}

/// Marches from a state over all of the problem.
///
/// # Errors
/// Where no step is short enough, or work ran out.
pub fn march(
    p: &Problem,
    start: State,
    known: Option<Scale>,
    effort: Effort,
    between: Option<&Between>,
) -> Result<Course, Halt> {
    let (n, l, nz) = (p.a.k.nrows(), p.a.b.nrows(), p.unknowns());
    let none = |n| DVector::zeros(n);
    let first_of_all = if known.is_some() { FIRST_WHERE_KNOWN } else { FIRST_OF_ALL };
    let scale = known.unwrap_or(Scale { u: none(n), v: none(n), z: none(nz), d: none(l) });
    let heavy = (0..n).map(|i| p.a.m[(i, i)] > 0.0).collect();
    let own = p.a.links.iter().flat_map(|l| vec![l.law.own_size(); l.law.unknowns()]);
    let own = DVector::from_iterator(nz, own);
    let mut first = 0;
    let links = p.a.links.iter().map(|l| {
        first += l.law.unknowns();
        first - l.law.unknowns()..first
    });
    let links = links.collect();
    let (steps, tolerance) = (Stepper::new(p)?, effort.tolerance);
    let mut it = March { steps, tolerance, between, scale, heavy, own, links };
    it.grow(&start, &p.a.b);
    let mut at_point = it.steps.point(&start);
    let mut end = start;
    let (mut record, mut steps) = (Record::default(), 0_usize);
    // Short: what is over within the first step is seen by none of its stages.
    let mut next = p.breaks[p.breaks.len() - 1] / first_of_all;
    for pair in p.breaks.windows(2) {
        let (from, length) = (pair[0], pair[1] - pair[0]);
        // A step is length / 2^level and starts at a multiple of its own length.
        let mut level = (length / next).log2().ceil().max(0.0) as u32;
        let (mut at, mut deep) = (0_u64, 40_u32);
        deep = deep.max(level);
        // The first half of a step that was too long is the next that is tried.
        let mut whole = None;
        while at < 1 << deep {
            steps += 1;
            let t = from + length * at as f64 / (1_u64 << deep) as f64;
            if it.steps.work > effort.work {
                return Err(Halt::Spent(steps, t));
            }
            let unit = 1_u64 << (deep - level);
            let h = length / (1_u64 << level) as f64;
            let before = record.pieces.last().map(|piece| (piece, at > 0));
            let (tried, first) = it.try_step(t, h, &at_point, whole.take(), before);
            let rise = match tried {
                Some(tried) if tried.error <= it.tolerance => {
                    let [first, second] = tried.halves;
                    let half = 0.5 * h;
                    record.pieces.push(it.steps.piece(t, half, &at_point, &first));
                    record.pieces.push(it.steps.piece(t + half, half, &first.end, &second));
                    at_point = second.end;
                    it.grow(&tried.end, &p.a.b);
                    end = tried.end;
                    at += unit;
                    next = h;
                    if tried.error < it.tolerance / 100.0
                        && level > 0
                        && at.is_multiple_of(2 * unit)
                    {
                        level -= 1;
                        next = 2.0 * h;
                    }
                    continue;
                }
                Some(Tried { error, halves: [first, _], .. }) => {
                    let rise = ((error / it.tolerance).log2() / 4.0).clamp(1.0, 4.0) as u32;
                    whole = Some(first).filter(|_| rise == 1);
                    rise
                }
                None => {
                    whole = first;
                    1
                }
            };
            level += rise;
            if level >= deep {
                return Err(Halt::Stuck(format!("no step is short enough at t = {t:e}")));
            }
        }
    }
    Ok(Course { record, end, scale: it.scale, steps })
}

impl March<'_> {
    fn grow(&mut self, s: &State, b: &nalgebra::DMatrix<f64>) {
        let up = |to: &mut DVector<f64>, x: &DVector<f64>| {
            to.iter_mut().zip(x.iter()).for_each(|(a, b)| *a = a.max(b.abs()));
        };
        up(&mut self.scale.u, &s.u);
        up(&mut self.scale.v, &s.v);
        up(&mut self.scale.z, &s.z);
        up(&mut self.scale.d, &(b * &s.u));
    }

    /// The step, and else its first half where there is one; `before`: the last one, and whether loads go on from it.
    fn try_step(
        &mut self,
        t: f64,
        h: f64,
        from: &Point,
        whole: Option<Solved>,
        before: Option<(&Piece, bool)>,
    ) -> (Option<Tried>, Option<Solved>) {
        let (scale, half) = (&self.scale, 0.5 * h);
        let Some(whole) = whole.or_else(|| self.steps.step(t, h, from, scale, None)) else {
            return (None, None);
        };
        let Some(first) = self.steps.step(t, half, from, scale, Some((&whole, 0.0))) else {
            return (None, None);
        };
        let second = self.steps.step(t + half, half, &first.end, scale, Some((&whole, 0.5)));
        let Some(second) = second else {
            return (None, Some(first));
        };
        let (a, end) = (self.steps.state(&whole.end), self.steps.state(&second.end));
        self.steps.work += 4.0 * (a.u.len() as f64).powi(2);
        let mut error = self.distance(h, &a, &end);
        for (t, from, step) in [(t, from, &first), (t + half, &first.end, &second)] {
            let [own, none] = self.steps.unseen(t, half, from, step, self.scale.d.as_slice());
            error = error.max(own).max(none * OF_NONE);
        }
        let turned = [first.turned(from), second.turned(&first.end)];
        let goes_on = before.filter(|(_, goes_on)| *goes_on).map(|(piece, _)| piece);
        let bent = goes_on.is_none() || turned.contains(&true);
        let least = if bent { FIRST } else { 1.0 };
        if let Some(it) = self.between.filter(|it| h > least * it.window) {
            let pieces = [
                self.steps.piece(t, half, from, &first),
                self.steps.piece(t + half, half, &first.end, &second),
            ];
            let mut off = self.steps.piece(t, h, from, &whole).apart(&pieces, &it.sizes);
            let ahead = [goes_on, Some(&pieces[0])];
            for ((before, piece), _) in ahead.iter().zip(&pieces).zip(turned).filter(|x| x.1) {
                off = off.max(before.map_or(0.0, |before| before.lost(piece, &it.sizes)));
            }
            error = error.max(off / it.share * self.tolerance);
            // A link may have come all the way to its new branch before the first stage: its force goes there in no
            // time where it is led back, and is wrong all the while.
            if half > it.window {
                let ahead = [before.map(|(piece, _)| piece), Some(&pieces[0])];
                for ((before, piece), _) in ahead.iter().zip(&pieces).zip(turned).filter(|x| x.1) {
                    let jump = before.map_or(0.0, |before| before.jump(piece, &it.sizes));
                    error = error.max(jump / JUMP * self.tolerance);
                }
            }
        }
        (Some(Tried { error, halves: [first, second], end }), None)
    }

    /// Largest difference of two ends of a step, as share of the largest values so far. What may be rounding
    /// of the motion and of its increments over the step counts as none.
    fn distance(&self, h: f64, a: &State, b: &State) -> f64 {
        let motion = self.scale.u.amax().max(b.u.amax());
        let noise = ROUNDING * motion;
        let any = |_: usize| true;
        let u = share(&a.u, &b.u, &self.scale.u, [1e-12, noise], any);
        let v = share(&a.v, &b.v, &self.scale.v, [1e-11, noise / h], |i| self.heavy[i]);
        let unit = |x: &DVector<f64>| x.component_div(&self.own);
        let [x, y, mut scale] = [&a.z, &b.z, &self.scale.z].map(unit);
        // Own unknowns of one link are parts of one deformation.
        for link in &self.links {
            let size = link.clone().map(|i| scale[i].max(y[i].abs())).fold(0.0, f64::max);
            link.clone().for_each(|i| scale[i] = size);
        }
        let z = share(&x, &y, &scale, [(1e-6 * motion).max(1e-12), noise], any);
        u.max(v).max(z)
    }
}

/// Rounding of a motion, as share of it.
const ROUNDING: f64 = 1e-14;

fn share(
    x: &DVector<f64>,
    y: &DVector<f64>,
    scale: &DVector<f64>,
    [floor, noise]: [f64; 2],
    on: impl Fn(usize) -> bool,
) -> f64 {
    let size = |i: usize| scale[i].max(x[i].abs()).max(y[i].abs());
    let all = (0..x.len()).map(size).fold(0.0, f64::max);
    let mut worst = 0.0_f64;
    for i in (0..x.len()).filter(|i| on(*i)) {
        let e = ((x[i] - y[i]).abs() - noise) / size(i).max(1e-4 * all).max(floor);
        worst = if e.is_nan() { f64::INFINITY } else { worst.max(e) };
    }
    worst
}

impl Course {
    /// Value of a probe at a time.
    #[must_use]
    pub fn at(&self, probe: usize, t: f64) -> f64 {
        self.record.at(probe, t)
    }

    /// Smallest and largest value of a probe between two times.
    #[must_use]
    pub fn span(&self, probe: usize, from: f64, to: f64) -> (f64, f64) {
        self.record.span(probe, from, to)
    }
}

impl State {
    /// The start of a problem from rest, or thrown there.
    #[must_use]
    pub fn start(p: &Problem) -> Self {
        // Supports may be away at the start already: a Ricker wavelet has no beginning.
        let [moved, _] = p.supports(p.breaks[0], true);
        let d = &p.a.b * &p.u0 + &p.a.b_s * moved;
        let at = |first: usize, count: usize| d.as_slice()[first..first + count].to_vec();
        let links = p.a.links.iter();
        let z: Vec<f64> = links.flat_map(|l| l.law.thrown(&at(l.first, l.axes.len()))).collect();
        Self { u: p.u0.clone(), v: p.v0.clone(), z: z.into() }
    }
}
