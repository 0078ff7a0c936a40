//! Links of one law side by side in the lanes of a register.
//!
//! A law over lanes ([`LaneForm`](trilith_element::lanes::LaneForm)) answers for several links at once, and in two
//! parts: the iteration of a step asks for forces only, history and energies follow once at its end.

use crate::links::{LinkInstance, Tangents};
#[cfg(not(target_arch = "x86_64"))]
use trilith_element::lanes::Portable as Lanes;
#[cfg(target_arch = "x86_64")]
use trilith_element::lanes::WideLanes as Lanes;
use trilith_element::lanes::{Arithmetic, ErasedLaw, LaneLinks, LaneStep};
use trilith_element::{Energy, Kinematics, Link};

type Real = <Lanes as Arithmetic>::Real;

/// Fewer links of one law are asked one by one.
const WORTH_LANES: usize = 4;

/// Numbers of a kind that a link of a pack has at most.
const MOST: usize = 9;

/// The lanes of this machine, where it has any.
fn lanes() -> Option<Lanes> {
    #[cfg(target_arch = "x86_64")]
    return Lanes::available();
    #[cfg(not(target_arch = "x86_64"))]
    None
}

/// Where a link of a pack lies in the flat arrays.
#[derive(Clone, Copy, Debug)]
struct Place {
    /// Its index.
    link: usize,
    coordinate: usize,
    block: usize,
    history: usize,
}

/// As many links of one law as there are lanes, or fewer: then the last one fills the others.
#[derive(Clone, Debug)]
pub(crate) struct Pack {
    with: Lanes,
    law: ErasedLaw,
    /// True where the law looks at rates.
    rate: bool,
    places: Vec<Place>,
    parameters: Vec<Real>,
    d: Vec<Real>,
    v: Vec<Real>,
    d0: Vec<Real>,
    v0: Vec<Real>,
    dt: Real,
    history: Vec<Real>,
    f: Vec<Real>,
    k: Vec<Real>,
    c: Vec<Real>,
    step: LaneStep<Real>,
}

/// The packs of the links that have a law over lanes in company, and the indices of all others.
pub(crate) fn packs(laws: &[(&dyn Link, &LinkInstance)]) -> (Vec<Pack>, Vec<usize>) {
    let Some(with) = lanes() else { return (Vec::new(), (0..laws.len()).collect()) };
    let forms: Vec<_> = laws
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
    for i in 0..laws.len() {
        if done[i] {
            continue;
        }
        let of =
            |j: usize| forms[j].as_ref().map(|form| (form.law.id, form.rate, form.law.coordinates));
        let kind = of(i);
        let same: Vec<usize> =
            (i..laws.len()).filter(|j| kind.is_some() && of(*j) == kind).collect();
        if same.len() < WORTH_LANES {
            alone.push(i);
            continue;
        }
        for group in same.chunks(Lanes::WIDTH) {
            let own: Vec<_> = group.iter().filter_map(|j| forms[*j].as_ref()).collect();
            let Some(first) = own.first() else { continue };
            let place = |j: &usize| {
                let link = laws[*j].1;
                let (coordinate, block) = (link.range.start, link.block.start);
                Place { link: *j, coordinate, block, history: link.history.start }
            };
            let last = own.len() - 1;
            let parameter = |p: usize| with.gather(|lane| own[lane.min(last)].parameters[p]);
            let (n, zero) = (first.law.coordinates, with.splat(0.0));
            packs.push(Pack {
                with,
                law: first.law,
                rate: first.rate && group.iter().any(|j| laws[*j].0.uses_rates()),
                places: group.iter().map(place).collect(),
                parameters: (0..first.law.parameters).map(parameter).collect(),
                d: vec![zero; n],
                v: vec![zero; n],
                d0: vec![zero; n],
                v0: vec![zero; n],
                dt: zero,
                history: vec![zero; first.law.history],
                f: vec![zero; n],
                k: vec![zero; n * n],
                c: vec![zero; n * n],
                step: LaneStep::elastic(zero),
            });
        }
        same.iter().for_each(|j| done[*j] = true);
    }
    (packs, alone)
}

/// Fills numbers of each link from a flat array: a row of lanes for each of the `N` of a link.
fn take_rows<const N: usize>(
    with: Lanes,
    places: &[Place],
    from: &[f64],
    at: fn(&Place) -> usize,
    to: &mut [Real],
) {
    let mut rows = [[0.0; Lanes::WIDTH]; N];
    for lane in 0..Lanes::WIDTH {
        let start = at(&places[lane.min(places.len() - 1)]);
        let own = &from[start..start + N];
        for i in 0..N {
            rows[i][lane] = own[i];
        }
    }
    for (x, row) in to.iter_mut().zip(&rows) {
        *x = with.load(row);
    }
}

/// Puts numbers of each link into a flat array.
fn give_rows<const N: usize>(
    with: Lanes,
    places: &[Place],
    from: &[Real],
    at: fn(&Place) -> usize,
    to: &mut [f64],
) {
    let mut rows = [[0.0; Lanes::WIDTH]; N];
    for (x, row) in from.iter().zip(&mut rows) {
        with.store(*x, row);
    }
    for (lane, place) in places.iter().enumerate().take(Lanes::WIDTH) {
        let start = at(place);
        let own = &mut to[start..start + N];
        for i in 0..N {
            own[i] = rows[i][lane];
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
        $call::<$size>($($arguments),*)
    };
}

fn take(with: Lanes, places: &[Place], from: &[f64], at: fn(&Place) -> usize, to: &mut [Real]) {
    by_rows!(to.len(), take_rows, with, places, from, at, to);
}

fn give(with: Lanes, places: &[Place], from: &[Real], at: fn(&Place) -> usize, to: &mut [f64]) {
    by_rows!(from.len(), give_rows, with, places, from, at, to);
}

impl Pack {
    /// Takes up a step from the deformations and rates at its start.
    pub(crate) fn start(&mut self, at: &Kinematics<'_>, committed: &[f64]) {
        let Self { with, places, d0, v0, history, .. } = self;
        take(*with, places, at.d0, |p| p.coordinate, d0);
        if self.rate {
            take(*with, places, at.v0, |p| p.coordinate, v0);
        }
        take(*with, places, committed, |p| p.history, history);
        self.dt = with.splat(at.dt);
    }

    /// Forces and tangents.
    pub(crate) fn force(&mut self, at: &Kinematics<'_>, to: &mut [f64], tangents: &mut Tangents) {
        let Self {
            with, law, rate, places, parameters, d, v, d0, v0, dt, history, f, k, c, ..
        } = self;
        take(*with, places, at.d, |p| p.coordinate, d);
        if *rate {
            take(*with, places, at.v, |p| p.coordinate, v);
        }
        let mut links = LaneLinks { parameters, d, v, d0, v0, dt: *dt, history, f, k, c };
        with.force(law, &mut links);
        give(*with, places, f, |p| p.coordinate, to);
        give(*with, places, k, |p| p.block, &mut tangents.k);
        if *rate {
            give(*with, places, c, |p| p.block, &mut tangents.c);
        }
    }

    /// History and energies of the step at the forces asked for last.
    pub(crate) fn commit(&mut self, trial: &mut [f64], energy: &mut [Energy]) {
        let Self {
            with, law, places, parameters, d, v, d0, v0, dt, history, f, k, c, step, ..
        } = self;
        let mut links = LaneLinks { parameters, d, v, d0, v0, dt: *dt, history, f, k, c };
        with.commit(law, &mut links, std::slice::from_mut(step));
        give(*with, places, history, |p| p.history, trial);
        for (lane, place) in places.iter().enumerate() {
            let of = |x: Real| with.lane(x, lane);
            let LaneStep { stored, hysteretic, viscous, .. } = *step;
            energy[place.link] =
                Energy { stored: of(stored), hysteretic: of(hysteretic), viscous: of(viscous) };
        }
    }
}
