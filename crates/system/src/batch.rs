//! Links of one law side by side in the lanes of a register.
//!
//! A law over lanes ([`LaneForm`](trilith_element::lanes::LaneForm)) answers for several links at once, and in two
//! parts: the iteration of a step asks for forces only, history and energies follow once at its end.

use crate::links::{LinkInstance, Tangents};
use std::fmt::Debug;
use trilith_element::lanes::{Arithmetic, ErasedLaw, LaneForm, LaneLinks, LaneStep, Task};
#[cfg(target_arch = "x86_64")]
use trilith_element::lanes::{Avx2Lanes, Avx512Lanes};
use trilith_element::{Energy, Kinematics, Link};

/// Lanes of every arithmetic that has several.
const WIDTH: usize = 8;

/// Fewer links of one law are asked one by one.
const WORTH_LANES: usize = 4;

/// Coordinates and history variables that a link of a pack has at most.
const MOST: (usize, usize) = (3, 9);

/// Where the numbers of the links of a pack begin in a flat array; lanes that are left repeat the last link.
type Places = [usize; WIDTH];

/// Links of one law that are asked together.
pub(crate) trait Pack: Debug {
    /// Takes up a step from the deformations and rates at its start.
    fn start(&mut self, at: &Kinematics<'_>, committed: &[f64]);

    /// Forces and tangents.
    fn force(&mut self, at: &Kinematics<'_>, to: &mut [f64], tangents: &mut Tangents);

    /// History and energies of the step at the forces asked for last.
    fn commit(&mut self, trial: &mut [f64], energy: &mut [Energy]);
}

/// As many links of one law as there are lanes, or fewer: then the others repeat the last one.
#[derive(Debug)]
struct Lanes<A: Arithmetic> {
    with: A,
    law: ErasedLaw,
    /// True where the law looks at rates.
    rate: bool,
    /// Indices of the links.
    links: Vec<usize>,
    /// Where their deformations, tangents and histories lie.
    coordinates: Places,
    blocks: Places,
    histories: Places,
    parameters: Vec<A::Real>,
    d: Vec<A::Real>,
    v: Vec<A::Real>,
    d0: Vec<A::Real>,
    v0: Vec<A::Real>,
    dt: A::Real,
    history: Vec<A::Real>,
    trial: Vec<A::Real>,
    f: Vec<A::Real>,
    k: Vec<A::Real>,
    c: Vec<A::Real>,
    step: LaneStep<A::Real>,
}

type Laws<'a> = [(&'a dyn Link, &'a LinkInstance)];

/// The packs of those of some links that have a law over lanes in company, and the indices of the others.
pub(crate) fn packs(laws: &Laws<'_>, some: Vec<usize>) -> (Vec<Box<dyn Pack>>, Vec<usize>) {
    #[cfg(target_arch = "x86_64")]
    if let Some(with) = Avx512Lanes::available() {
        return packs_of(with, laws, some);
    }
    #[cfg(target_arch = "x86_64")]
    if let Some(with) = Avx2Lanes::available() {
        return packs_of(with, laws, some);
    }
    (Vec::new(), some)
}

fn packs_of<A: Arithmetic + Debug + 'static>(
    with: A,
    laws: &Laws<'_>,
    some: Vec<usize>,
) -> (Vec<Box<dyn Pack>>, Vec<usize>) {
    const { assert!(A::WIDTH == WIDTH, "lanes") };
    let forms: Vec<Option<LaneForm>> = laws
        .iter()
        .map(|(law, link)| {
            let n = link.range.len();
            let form = law.lanes(&vec![true; n])?;
            let whole = form.coordinates.iter().copied().eq(0..n);
            let short = n <= MOST.0 && form.law.history <= MOST.1;
            (whole && short && form.law.history == link.history.len()).then_some(form)
        })
        .collect();
    let (mut packs, mut alone, mut done) = (Vec::new(), Vec::new(), vec![false; laws.len()]);
    for (at, i) in some.iter().copied().enumerate() {
        if done[i] {
            continue;
        }
        let of =
            |j: usize| forms[j].as_ref().map(|form| (form.law.id, form.rate, form.law.coordinates));
        let kind = of(i);
        let like = |j: &usize| kind.is_some() && of(*j) == kind;
        let same: Vec<usize> = some[at..].iter().copied().filter(like).collect();
        if same.len() < WORTH_LANES {
            alone.push(i);
            continue;
        }
        for group in same.chunks(WIDTH) {
            let own: Vec<&LaneForm> = group.iter().filter_map(|j| forms[*j].as_ref()).collect();
            packs.extend(Lanes::new(with, laws, group, &own).map(|p| Box::new(p) as Box<dyn Pack>));
        }
        same.iter().for_each(|j| done[*j] = true);
    }
    (packs, alone)
}

impl<A: Arithmetic + Debug + 'static> Lanes<A> {
    /// Of a group of links with their forms; none where there are none.
    fn new(with: A, laws: &Laws<'_>, group: &[usize], own: &[&LaneForm]) -> Option<Self> {
        let (first, last) = (own.first()?, own.len() - 1);
        let places = |start: fn(&LinkInstance) -> usize| -> Places {
            std::array::from_fn(|lane| start(laws[group[lane.min(last)]].1))
        };
        let parameter = |p: usize| with.gather(|lane| own[lane.min(last)].parameters[p]);
        let (n, zero) = (first.law.coordinates, with.splat(0.0));
        Some(Self {
            with,
            law: first.law,
            rate: first.rate && group.iter().any(|j| laws[*j].0.uses_rates()),
            links: group.to_vec(),
            coordinates: places(|link| link.range.start),
            blocks: places(|link| link.block.start),
            histories: places(|link| link.history.start),
            parameters: (0..first.law.parameters).map(parameter).collect(),
            d: vec![zero; n],
            v: vec![zero; n],
            d0: vec![zero; n],
            v0: vec![zero; n],
            dt: zero,
            history: vec![zero; first.law.history],
            trial: vec![zero; first.law.history],
            f: vec![zero; n],
            k: vec![zero; n * n],
            c: vec![zero; n * n],
            step: LaneStep::elastic(zero),
        })
    }
}

/// A row of lanes for each of the `N` numbers that the links have in a flat array.
#[inline(always)]
fn take<A: Arithmetic, const N: usize>(with: A, places: &Places, from: &[f64], to: &mut [A::Real]) {
    let mut own = [&[0.0; N]; WIDTH];
    for (own, start) in own.iter_mut().zip(places) {
        *own = from[*start..].first_chunk().expect("numbers of a link");
    }
    for (i, x) in to.iter_mut().enumerate().take(N) {
        *x = with.gather(|lane| own[lane][i]);
    }
}

/// Puts the numbers of the first `count` links into a flat array.
#[inline(always)]
fn give<A: Arithmetic, const N: usize>(
    with: A,
    (places, count): (&Places, usize),
    from: &[A::Real],
    to: &mut [f64],
) {
    let mut rows = [[0.0; WIDTH]; N];
    for (x, row) in from.iter().zip(&mut rows) {
        with.store(*x, row);
    }
    for (lane, start) in places.iter().enumerate().take(count) {
        let own: &mut [f64; N] = to[*start..].first_chunk_mut().expect("numbers of a link");
        (0..N).for_each(|i| own[i] = rows[i][lane]);
    }
}

/// Calls a function for the number of history variables, as a constant; for none, nothing.
macro_rules! by_history {
    ($n:expr, $call:ident, $arguments:tt) => {
        by_history!(@ $n, $call, $arguments, 1 2 3 4 5 6 7 8 9)
    };
    (@ $n:expr, $call:ident, $arguments:tt, $($size:literal)*) => {
        match $n {
            $($size => by_history!(! $call, $size, $arguments),)*
            _ => {}
        }
    };
    (! $call:ident, $size:literal, ($($arguments:expr),*)) => {
        $call::<A, $size>($($arguments),*)
    };
}

/// The start of a step of a pack, with the instructions of its arithmetic.
struct Start<'a, A: Arithmetic> {
    pack: &'a mut Lanes<A>,
    at: &'a Kinematics<'a>,
    committed: &'a [f64],
}

impl<A: Arithmetic> Start<'_, A> {
    #[inline(always)]
    fn of<const N: usize>(self) {
        let Self { pack, at, committed } = self;
        let Lanes { with, coordinates, histories, d0, v0, history, rate, dt, .. } = pack;
        take::<A, N>(*with, coordinates, at.d0, d0);
        if *rate {
            take::<A, N>(*with, coordinates, at.v0, v0);
        }
        by_history!(history.len(), take, (*with, histories, committed, history));
        *dt = with.splat(at.dt);
    }
}

impl<A: Arithmetic> Task<A> for Start<'_, A> {
    type Output = ();

    #[inline(always)]
    fn run(self, _: A) {
        match self.pack.law.coordinates {
            1 => self.of::<1>(),
            2 => self.of::<2>(),
            _ => self.of::<3>(),
        }
    }
}

/// Forces and tangents of a pack, with the instructions of its arithmetic.
struct Force<'a, A: Arithmetic> {
    pack: &'a mut Lanes<A>,
    at: &'a Kinematics<'a>,
    to: &'a mut [f64],
    tangents: &'a mut Tangents,
}

impl<A: Arithmetic> Force<'_, A> {
    /// Of links with `N` coordinates, and blocks of `B` numbers.
    #[inline(always)]
    fn of<const N: usize, const B: usize>(self) {
        let Self { pack, at, to, tangents } = self;
        let (count, with, rate) = (pack.links.len(), pack.with, pack.rate);
        take::<A, N>(with, &pack.coordinates, at.d, &mut pack.d);
        if rate {
            take::<A, N>(with, &pack.coordinates, at.v, &mut pack.v);
        }
        let law = pack.law;
        with.force(&law, &mut pack.questions());
        give::<A, N>(with, (&pack.coordinates, count), &pack.f, to);
        give::<A, B>(with, (&pack.blocks, count), &pack.k, &mut tangents.k);
        if rate {
            give::<A, B>(with, (&pack.blocks, count), &pack.c, &mut tangents.c);
        }
    }
}

impl<A: Arithmetic> Task<A> for Force<'_, A> {
    type Output = ();

    #[inline(always)]
    fn run(self, _: A) {
        match self.pack.law.coordinates {
            1 => self.of::<1, 1>(),
            2 => self.of::<2, 4>(),
            _ => self.of::<3, 9>(),
        }
    }
}

/// The end of a step of a pack, with the instructions of its arithmetic.
struct Commit<'a, A: Arithmetic> {
    pack: &'a mut Lanes<A>,
    to: &'a mut [f64],
    energy: &'a mut [Energy],
}

impl<A: Arithmetic> Task<A> for Commit<'_, A> {
    type Output = ();

    #[inline(always)]
    fn run(self, with: A) {
        let Self { pack, to, energy } = self;
        let (law, count, mut step) = (pack.law, pack.links.len(), pack.step);
        with.commit(&law, &mut pack.questions(), std::slice::from_mut(&mut step));
        let (places, trial) = ((&pack.histories, count), &pack.trial);
        by_history!(trial.len(), give, (with, places, trial, to));
        let mut rows = [[0.0; WIDTH]; 3];
        for (x, row) in [step.stored, step.hysteretic, step.viscous].iter().zip(&mut rows) {
            with.store(*x, row);
        }
        let [stored, hysteretic, viscous] = rows;
        for (lane, link) in pack.links.iter().enumerate() {
            let (stored, hysteretic) = (stored[lane], hysteretic[lane]);
            energy[*link] = Energy { stored, hysteretic, viscous: viscous[lane] };
        }
    }
}

impl<A: Arithmetic> Lanes<A> {
    fn questions(&mut self) -> LaneLinks<'_, A::Real> {
        let Self { parameters, d, v, d0, v0, dt, history, trial, f, k, c, .. } = self;
        LaneLinks { parameters, d, v, d0, v0, dt: *dt, history, trial, f, k, c }
    }
}

impl<A: Arithmetic + Debug> Pack for Lanes<A> {
    fn start(&mut self, at: &Kinematics<'_>, committed: &[f64]) {
        self.with.run(Start { pack: self, at, committed });
    }

    fn force(&mut self, at: &Kinematics<'_>, to: &mut [f64], tangents: &mut Tangents) {
        self.with.run(Force { pack: self, at, to, tangents });
    }

    fn commit(&mut self, to: &mut [f64], energy: &mut [Energy]) {
        self.with.run(Commit { pack: self, to, energy });
    }
}
