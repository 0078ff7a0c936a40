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

/// Numbers of a kind that a link of a pack has at most.
const MOST: usize = 9;

/// Where the numbers of the links of a pack lie in a flat array.
#[derive(Clone, Debug)]
enum Places {
    /// Link after link from here on.
    Run(usize),
    /// Each for itself.
    Apart(Vec<usize>),
}

impl Places {
    /// Of links that have `n` numbers each.
    fn new(starts: Vec<usize>, n: usize) -> Self {
        if starts.windows(2).all(|two| two[0] + n == two[1]) {
            return Self::Run(starts.first().copied().unwrap_or(0));
        }
        Self::Apart(starts)
    }
}

/// Links of one law that are asked together.
pub(crate) trait Pack: Debug {
    /// Takes up a step from the deformations and rates at its start.
    fn start(&mut self, at: &Kinematics<'_>, committed: &[f64]);

    /// Forces and tangents.
    fn force(&mut self, at: &Kinematics<'_>, to: &mut [f64], tangents: &mut Tangents);

    /// History and energies of the step at the forces asked for last.
    fn commit(&mut self, trial: &mut [f64], energy: &mut [Energy]);
}

/// As many links of one law as there are lanes, or fewer: then the others hold links at rest.
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
            let short = n * n <= MOST && form.law.history <= MOST;
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
            packs.extend(Lanes::new(with, laws, group, &own));
        }
        same.iter().for_each(|j| done[*j] = true);
    }
    (packs, alone)
}

impl<A: Arithmetic + Debug + 'static> Lanes<A> {
    /// Of a group of links with their forms; none where there are none.
    fn new(with: A, laws: &Laws<'_>, group: &[usize], own: &[&LaneForm]) -> Option<Box<dyn Pack>> {
        let (first, last) = (own.first()?, own.len() - 1);
        let places = |n: usize, start: fn(&LinkInstance) -> usize| {
            Places::new(group.iter().map(|j| start(laws[*j].1)).collect(), n)
        };
        let parameter = |p: usize| with.gather(|lane| own[lane.min(last)].parameters[p]);
        let (n, zero) = (first.law.coordinates, with.splat(0.0));
        Some(Box::new(Self {
            with,
            law: first.law,
            rate: first.rate && group.iter().any(|j| laws[*j].0.uses_rates()),
            links: group.to_vec(),
            coordinates: places(n, |link| link.range.start),
            blocks: places(n * n, |link| link.block.start),
            histories: places(first.law.history, |link| link.history.start),
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
        }))
    }
}

/// Fills numbers of `count` links from a flat array: a row of lanes for each of the `N` of a link, zero in the lanes
/// that are left.
#[inline(always)]
fn take_rows<A: Arithmetic, const N: usize>(
    with: A,
    (count, places): (usize, &Places),
    from: &[f64],
    to: &mut [A::Real],
) {
    let mut own = [[0.0; N]; WIDTH];
    match places {
        Places::Run(start) => {
            let (run, _) = from[*start..*start + N * count].as_chunks::<N>();
            if let Ok(whole) = <&[[f64; N]; WIDTH]>::try_from(run) {
                return turn(with, whole, to);
            }
            own[..count].copy_from_slice(run);
        }
        Places::Apart(starts) => {
            for (own, start) in own.iter_mut().zip(starts) {
                own.copy_from_slice(&from[*start..*start + N]);
            }
        }
    }
    turn(with, &own, to);
}

/// Rows of lanes from the numbers of each link.
#[inline(always)]
fn turn<A: Arithmetic, const N: usize>(with: A, own: &[[f64; N]; WIDTH], to: &mut [A::Real]) {
    for (i, x) in to.iter_mut().enumerate().take(N) {
        *x = with.gather(|lane| own[lane][i]);
    }
}

/// Puts numbers of `count` links into a flat array.
#[inline(always)]
fn give_rows<A: Arithmetic, const N: usize>(
    with: A,
    (count, places): (usize, &Places),
    from: &[A::Real],
    to: &mut [f64],
) {
    let mut rows = [[0.0; WIDTH]; N];
    for (x, row) in from.iter().zip(&mut rows) {
        with.store(*x, row);
    }
    let mut own = [[0.0; N]; WIDTH];
    for (lane, own) in own.iter_mut().enumerate() {
        (0..N).for_each(|i| own[i] = rows[i][lane]);
    }
    match places {
        Places::Run(start) => {
            to[*start..*start + N * count].copy_from_slice(own[..count].as_flattened());
        }
        Places::Apart(starts) => {
            for (own, start) in own.iter().zip(starts) {
                to[*start..*start + N].copy_from_slice(own);
            }
        }
    }
}

/// Chooses the number of rows that a loop is compiled for; none are no work.
macro_rules! by_rows {
    ($n:expr, $call:ident, $($arguments:expr),*) => {
        by_rows!(@ $n, $call, ($($arguments),*), 1 2 3 4 5 6 7 8 9)
    };
    (@ $n:expr, $call:ident, $arguments:tt, $($size:literal)*) => {
        match $n {
            $($size => by_rows!(! $call, $size, $arguments),)*
            _ => {}
        }
    };
    (! $call:ident, $size:literal, ($($arguments:expr),*)) => {
        $call::<A, $size>($($arguments),*)
    };
}

/// Takes numbers from a flat array, with the instructions of an arithmetic.
struct Take<'a, R> {
    count: usize,
    places: &'a Places,
    from: &'a [f64],
    to: &'a mut [R],
}

impl<A: Arithmetic> Task<A> for Take<'_, A::Real> {
    type Output = ();

    #[inline(always)]
    fn run(self, with: A) {
        let Self { count, places, from, to } = self;
        by_rows!(to.len(), take_rows, with, (count, places), from, to);
    }
}

/// Gives numbers to a flat array, with the instructions of an arithmetic.
struct Give<'a, R> {
    count: usize,
    places: &'a Places,
    from: &'a [R],
    to: &'a mut [f64],
}

impl<A: Arithmetic> Task<A> for Give<'_, A::Real> {
    type Output = ();

    #[inline(always)]
    fn run(self, with: A) {
        let Self { count, places, from, to } = self;
        by_rows!(from.len(), give_rows, with, (count, places), from, to);
    }
}

fn take<A: Arithmetic>(
    with: A,
    (count, places): (usize, &Places),
    from: &[f64],
    to: &mut [A::Real],
) {
    with.run(Take { count, places, from, to });
}

fn give<A: Arithmetic>(
    with: A,
    (count, places): (usize, &Places),
    from: &[A::Real],
    to: &mut [f64],
) {
    with.run(Give { count, places, from, to });
}

impl<A: Arithmetic + Debug> Pack for Lanes<A> {
    fn start(&mut self, at: &Kinematics<'_>, committed: &[f64]) {
        let Self { with, links, coordinates, histories, d0, v0, history, .. } = self;
        let count = links.len();
        take(*with, (count, coordinates), at.d0, d0);
        if self.rate {
            take(*with, (count, coordinates), at.v0, v0);
        }
        take(*with, (count, histories), committed, history);
        self.dt = with.splat(at.dt);
    }

    fn force(&mut self, at: &Kinematics<'_>, to: &mut [f64], tangents: &mut Tangents) {
        let coordinates = (self.links.len(), &self.coordinates);
        let blocks = (self.links.len(), &self.blocks);
        let Self { with, law, rate, parameters, d, v, d0, v0, dt, history, trial, f, k, c, .. } =
            self;
        take(*with, coordinates, at.d, d);
        if *rate {
            take(*with, coordinates, at.v, v);
        }
        let mut links = LaneLinks { parameters, d, v, d0, v0, dt: *dt, history, trial, f, k, c };
        with.force(law, &mut links);
        give(*with, coordinates, f, to);
        give(*with, blocks, k, &mut tangents.k);
        if *rate {
            give(*with, blocks, c, &mut tangents.c);
        }
    }

    fn commit(&mut self, to: &mut [f64], energy: &mut [Energy]) {
        let histories = (self.links.len(), &self.histories);
        let Self { with, law, parameters, d, v, d0, v0, dt, history, trial, f, k, c, step, .. } =
            self;
        let mut links = LaneLinks { parameters, d, v, d0, v0, dt: *dt, history, trial, f, k, c };
        with.commit(law, &mut links, std::slice::from_mut(step));
        give(*with, histories, trial, to);
        let [stored, hysteretic, viscous] =
            [step.stored, step.hysteretic, step.viscous].map(|x| {
                let mut lanes = [0.0; WIDTH];
                with.store(x, &mut lanes);
                lanes
            });
        for (lane, link) in self.links.iter().enumerate() {
            energy[*link] = Energy {
                stored: stored[lane],
                hysteretic: hysteretic[lane],
                viscous: viscous[lane],
            };
        }
    }
}
