//! Links of one law in the lanes of one processor.

use super::places::{Places, WIDTH, are_pairs, order_of_pairs};
use super::{Laws, Pack};
use crate::links::{Answers, LinkInstance, Tangents};
use std::fmt::Debug;
use trilith_element::lanes::{Arithmetic, ErasedLaw, LaneForm, LaneLinks, LaneStep, Task};
use trilith_element::{Energy, Kinematics};

/// Fewer links of one law are asked one by one.
const WORTH_LANES: usize = 4;

/// Coordinates and history variables that a link of a pack has at most.
const MOST: (usize, usize) = (3, 9);

/// As many links of one law as there are lanes, or fewer: then other lanes repeat some of them.
#[derive(Debug)]
struct Lanes<A: Arithmetic> {
    with: A,
    law: ErasedLaw,
    /// True where the law looks at rates.
    rate: bool,
    /// Indices of the links, and of the element of the first.
    links: Vec<usize>,
    element: usize,
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
    /// What the step does where the law was asked last, and whether the tangents there are where they belong.
    step: LaneStep<A::Real>,
    given: bool,
}

pub(super) fn packs_of<A: Arithmetic + Debug + 'static>(
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
            let short = n <= MOST.0 && form.law.history <= MOST.1 && !form.law.is_long;
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
        let (first, count) = (own.first()?, own.len());
        let starts = |start: fn(&LinkInstance) -> usize| -> Vec<usize> {
            group.iter().map(|link| start(laws[*link].1)).collect()
        };
        let coordinates = starts(|link| link.range.start);
        let paired = first.law.coordinates == 2 && are_pairs(&coordinates);
        let order = match paired {
            true => order_of_pairs(with, count),
            false => std::array::from_fn(|lane| lane.min(count - 1)),
        };
        let parameter = |p: usize| with.gather(|lane| own[order[lane]].parameters[p]);
        let (n, zero) = (first.law.coordinates, with.splat(0.0));
        Some(Self {
            with,
            law: first.law,
            rate: first.rate && group.iter().any(|j| laws[*j].0.uses_rates()),
            links: group.to_vec(),
            element: laws[*group.first()?].1.element,
            coordinates: Places::new(coordinates, order, paired),
            blocks: Places::new(starts(|link| link.block.start), order, false),
            histories: Places::new(starts(|link| link.history.start), order, paired),
            parameters: (0..first.law.parameters).map(parameter).collect(),
            d: vec![zero; n],
            // A law that does not look at rates gets no numbers for them.
            v: vec![with.splat(if first.rate { 0.0 } else { f64::NAN }); n],
            d0: vec![zero; n],
            v0: vec![with.splat(if first.rate { 0.0 } else { f64::NAN }); n],
            dt: zero,
            history: vec![zero; first.law.history],
            trial: vec![zero; first.law.history],
            f: vec![zero; n],
            k: vec![zero; n * n],
            c: vec![zero; n * n],
            step: LaneStep::elastic(zero),
            given: false,
        })
    }
}

/// Calls a function for the number of history variables, as a constant; for none, nothing.
macro_rules! by_history {
    ($n:expr, $of:ident . $call:ident $arguments:tt) => {
        by_history!(@ $n, $of, $call, $arguments, 1 2 3 4 5 6 7 8 9)
    };
    (@ $n:expr, $of:ident, $call:ident, $arguments:tt, $($size:literal)*) => {
        match $n {
            $($size => by_history!(! $of, $call, $size, $arguments),)*
            _ => {}
        }
    };
    (! $of:ident, $call:ident, $size:literal, ($($arguments:expr),*)) => {
        $of.$call::<A, $size>($($arguments),*)
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
        coordinates.take::<A, N>(*with, at.d0, d0);
        if *rate {
            coordinates.take::<A, N>(*with, at.v0, v0);
        }
        by_history!(history.len(), histories.take(*with, committed, history));
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

/// The answer of a pack, with the instructions of its arithmetic.
struct Respond<'a, 'b, A: Arithmetic> {
    pack: &'a mut Lanes<A>,
    at: &'a Kinematics<'a>,
    last: bool,
    to: &'a mut Answers<'b>,
}

impl<A: Arithmetic> Respond<'_, '_, A> {
    /// Of links with `N` coordinates, and blocks of `B` numbers.
    #[inline(always)]
    fn of<const N: usize, const B: usize>(self) {
        let Self { pack, at, last, to } = self;
        let (law, with, rate) = (pack.law, pack.with, pack.rate);
        pack.coordinates.take::<A, N>(with, at.d, &mut pack.d);
        if rate {
            pack.coordinates.take::<A, N>(with, at.v, &mut pack.v);
        }
        pack.given = last;
        let (mut questions, step) = pack.questions();
        with.respond(&law, &mut questions, step);
        pack.coordinates.give::<A, N>(with, &pack.f, to.f);
        if last {
            pack.give_tangents::<B>(to.tangents);
        }
    }
}

impl<A: Arithmetic> Task<A> for Respond<'_, '_, A> {
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

/// Tangents of a pack, with the instructions of its arithmetic.
struct Give<'a, A: Arithmetic> {
    pack: &'a Lanes<A>,
    to: &'a mut Tangents,
}

impl<A: Arithmetic> Task<A> for Give<'_, A> {
    type Output = ();

    #[inline(always)]
    fn run(self, _: A) {
        match self.pack.law.coordinates {
            1 => self.pack.give_tangents::<1>(self.to),
            2 => self.pack.give_tangents::<4>(self.to),
            _ => self.pack.give_tangents::<9>(self.to),
        }
    }
}

/// The end of a step of a pack, with the instructions of its arithmetic.
struct Commit<'a, 'b, A: Arithmetic> {
    pack: &'a mut Lanes<A>,
    to: &'a mut Answers<'b>,
}

impl<A: Arithmetic> Task<A> for Commit<'_, '_, A> {
    type Output = ();

    #[inline(always)]
    fn run(self, with: A) {
        let Self { pack, to: Answers { history: to, tangents, energy, .. } } = self;
        if !pack.given {
            Give { pack, to: tangents }.run(with);
        }
        let step = &pack.step;
        let (histories, trial) = (&pack.histories, &pack.trial);
        by_history!(trial.len(), histories.give(with, trial, to));
        let mut rows = [[0.0; WIDTH]; 3];
        for (x, row) in [step.stored, step.hysteretic, step.viscous].iter().zip(&mut rows) {
            with.store(*x, row);
        }
        let [stored, hysteretic, viscous] = rows;
        for (lane, link) in histories.lanes().iter().copied().zip(&pack.links) {
            let (stored, hysteretic) = (stored[lane], hysteretic[lane]);
            energy[*link] = Energy::new(stored, hysteretic, viscous[lane]);
        }
    }
}

impl<A: Arithmetic> Lanes<A> {
    /// Puts the tangents, in blocks of `B` numbers, where they belong.
    #[inline(always)]
    fn give_tangents<const B: usize>(&self, to: &mut Tangents) {
        self.blocks.give::<A, B>(self.with, &self.k, &mut to.k);
        if self.rate {
            self.blocks.give::<A, B>(self.with, &self.c, &mut to.c);
        }
    }

    /// What the law is asked, and where the end of the step goes.
    fn questions(&mut self) -> (LaneLinks<'_, A::Real>, &mut [LaneStep<A::Real>]) {
        let Self { parameters, d, v, d0, v0, dt, history, trial, f, k, c, step, .. } = self;
        let links = LaneLinks { parameters, d, v, d0, v0, dt: *dt, history, trial, f, k, c };
        (links, std::slice::from_mut(step))
    }
}

impl<A: Arithmetic + Debug> Pack for Lanes<A> {
    fn element(&self) -> usize {
        self.element
    }

    fn start(&mut self, at: &Kinematics<'_>, committed: &[f64]) {
        self.with.run(Start { pack: self, at, committed });
    }

    fn respond(&mut self, at: &Kinematics<'_>, last: bool, to: &mut Answers<'_>) {
        self.with.run(Respond { pack: self, at, last, to });
    }

    fn tangents(&mut self, to: &mut Tangents) {
        if !self.given {
            self.with.run(Give { pack: self, to });
        }
    }

    fn commit(&mut self, to: &mut Answers<'_>) {
        self.with.run(Commit { pack: self, to });
    }
}
