//! What does not change in a march: the structure of every lane, gathered from the setups.

use super::form::{Extent, Form, Laws};
use super::outputs::Outputs;
use super::setup::{LaneSetup, Output};
use super::small::{Aligned, SMALL, taken, times};
use super::tables::Table;
use std::sync::Arc;
use trilith_element::lanes::{Arithmetic, Real};

/// Links of one law that follow each other.
pub(super) struct Run {
    pub laws: Laws,
    /// Of each of them.
    pub extent: Extent,
    pub first: usize,
    pub count: usize,
    pub history: usize,
    pub parameters: usize,
    /// Its first link, and its first contact.
    pub link: usize,
    pub contact: usize,
}

/// How a channel that varies gets its amplitudes.
pub(super) enum Source<R> {
    /// One table for all, times a factor.
    Shared(Arc<Table>, R),
    /// A table for each.
    Own,
}

/// A channel that varies, and its load over the modes.
pub(super) struct Varying<R, const M: usize> {
    pub channel: usize,
    pub source: Source<R>,
    pub force: Aligned<[R; M]>,
}

/// What does not change in a march.
pub(super) struct Plan<R, const M: usize, const L: usize, const N: usize> {
    pub runs: Vec<Run>,
    pub parameters: Vec<R>,
    /// How many modes, link coordinates and coordinates of the widest link there are: see [`modes`](Self::modes),
    /// [`coordinates`](Self::coordinates), [`block`](Self::block).
    counts: [usize; 3],
    /// B by rows, and by columns.
    pub b: Aligned<[[R; M]; L]>,
    pub columns: Aligned<[[R; L]; M]>,
    pub omega2: Aligned<[R; M]>,
    pub damping: Aligned<[R; M]>,
    /// 1 where the structure is damped.
    pub damped: R,
    /// Some mode of some lane is damped, or has a stiffness.
    pub damps: bool,
    pub elastic: bool,
    pub rotational: [bool; L],
    /// Some coordinate is a rotation.
    pub turns: bool,
    /// Place of each lane coordinate of the setups.
    pub places: Vec<usize>,
    /// Load of each channel over the modes, and the sum of those that never change.
    pub forces: Vec<Aligned<[R; M]>>,
    pub steady: Aligned<[R; M]>,
    pub varying: Vec<Varying<R, M>>,
    pub constant: Aligned<[R; M]>,
    pub outputs: Outputs<R, M>,
    /// Residual of the link forces that counts as none, as share of the largest force so far.
    pub tolerance: R,
    /// Number of contacts, and indices of those that a body may stand on.
    pub contacts: usize,
    pub feet: Vec<usize>,
    /// Indices of all other contacts.
    pub others: Vec<usize>,
    /// A body may overturn.
    pub falls: bool,
    /// Rates matter to the laws, accelerations to an output.
    pub rate: bool,
    pub accelerations: bool,
}

/// Picks a number of each lane; lanes without an analysis repeat the last. For what is made once: not compiled anew for
/// each of the many numbers that a setup has.
#[inline(never)]
pub(super) fn pick<A: Arithmetic>(
    with: A,
    setups: &[&LaneSetup],
    of: &dyn Fn(&LaneSetup) -> f64,
) -> A::Real {
    let last = setups.len() - 1;
    with.gather(|i| of(setups[i.min(last)]))
}

/// The same of every mode; nothing where there are fewer than there is room for.
#[inline(never)]
pub(super) fn mode_wise<A: Arithmetic, const M: usize>(
    with: A,
    setups: &[&LaneSetup],
    of: &dyn Fn(&LaneSetup, usize) -> f64,
) -> Aligned<[A::Real; M]> {
    let mut all = Aligned::filled(with.splat(0.0));
    for (j, x) in all.iter_mut().enumerate().take(setups[0].shape.modes) {
        *x = pick(with, setups, &|s| of(s, j));
    }
    all
}

/// The same of every link coordinate, which has its place.
#[inline(never)]
pub(super) fn coordinate_wise<A: Arithmetic, const L: usize>(
    with: A,
    setups: &[&LaneSetup],
    places: &[usize],
    of: &dyn Fn(&LaneSetup, usize) -> f64,
) -> Aligned<[A::Real; L]> {
    let mut all = Aligned::filled(with.splat(0.0));
    for (i, place) in places.iter().enumerate() {
        all[*place] = pick(with, setups, &|s| of(s, i));
    }
    all
}

/// Where the links of a lane lie.
struct Layout {
    runs: Vec<Run>,
    /// Place of each lane coordinate of the setups.
    places: Vec<usize>,
    /// Number of contacts.
    contacts: usize,
}

impl Layout {
    /// Of links with room for `n` coordinates each.
    fn new(setups: &[&LaneSetup], n: usize) -> Self {
        let mut places = Vec::new();
        let mut runs: Vec<Run> = Vec::new();
        let (mut history, mut contact, mut parameters) = (0, 0, 0);
        for (link, form) in setups[0].forms.iter().enumerate() {
            let (first, extent) = (link * n, form.extent);
            places.extend((0..extent.coordinates).map(|i| first + i));
            let joins = |r: &&mut Run| r.laws.serve(form) && extent.coordinates == n;
            match runs.last_mut().filter(joins) {
                Some(run) => run.count += 1,
                None => {
                    let own: Vec<&Form> = setups.iter().map(|s| &s.forms[link]).collect();
                    let (laws, count) = (Laws::of(&own), 1);
                    let run =
                        Run { laws, extent, first, count, history, parameters, link, contact };
                    runs.push(run);
                }
            }
            history += extent.history;
            contact += extent.contacts;
            parameters += extent.parameters;
        }
        Self { runs, places, contacts: contact }
    }
}

impl<R: Real, const M: usize, const L: usize, const N: usize> Plan<R, M, L, N> {
    pub fn new<A: Arithmetic<Real = R>>(with: A, setups: &[&LaneSetup]) -> Self {
        let one = setups[0];
        let zero = with.splat(0.0);
        let get = |of: &dyn Fn(&LaneSetup) -> f64| pick(with, setups, of);
        let modes = one.shape.modes;
        let mode_wise = |of: &dyn Fn(&LaneSetup, usize) -> f64| mode_wise::<A, M>(with, setups, of);
        let widest = one.forms.iter().map(|form| form.extent.coordinates).max().unwrap_or(1);
        let block = block::<L, N>(widest);
        let Layout { runs, places, contacts } = Layout::new(setups, block);
        let parameters = one.forms.iter().enumerate().flat_map(|(l, form)| {
            (0..form.extent.parameters).map(move |i| get(&|s| s.forms[l].parameters[i]))
        });
        let parameters = parameters.collect();
        let mut b = Aligned::full_of(zero);
        let mut rotational = [false; L];
        for (i, place) in places.iter().enumerate() {
            b[*place] = *mode_wise(&|s, j| s.rows[i][j]);
            rotational[*place] = one.rotational[i];
        }
        let mut columns = Aligned::full_of(zero);
        for (j, column) in columns.iter_mut().enumerate() {
            for (to, row) in column.iter_mut().zip(&*b) {
                *to = row[j];
            }
        }
        let channels = one.forces.len();
        let forces: Vec<Aligned<[R; M]>> =
            (0..channels).map(|c| mode_wise(&|s, j| s.forces[c][j])).collect();
        let varying = (0..channels).filter_map(|channel| {
            let table = |s: &LaneSetup| s.tables[channel].clone();
            let (shared, _) = table(one)?;
            let same = |s: &&LaneSetup| table(s).is_some_and(|(t, _)| Arc::ptr_eq(&t, &shared));
            let source = if setups.iter().all(same) {
                Source::Shared(shared, get(&|s| table(s).map_or(0.0, |t| t.1)))
            } else {
                Source::Own
            };
            Some(Varying { channel, source, force: forces[channel] })
        });
        let varying = varying.collect();
        let conserved = |s: &LaneSetup, j: usize| -> f64 {
            (0..channels).filter(|c| s.conservative[*c]).map(|c| s.forces[c][j]).sum()
        };
        let mut steady = Aligned::filled(zero);
        for c in (0..channels).filter(|c| one.tables[*c].is_none()) {
            for j in 0..modes {
                steady[j] = steady[j] + get(&|s| s.forces[c][j]);
            }
        }
        let damped = |s: &LaneSetup| f64::from(u8::from(s.damping.iter().any(|c| *c != 0.0)));
        Self {
            runs,
            parameters,
            counts: [modes, block * one.forms.len(), block],
            b,
            columns,
            omega2: mode_wise(&|s, j| s.omega2[j]),
            damping: mode_wise(&|s, j| s.damping[j]),
            damped: get(&damped),
            damps: setups.iter().any(|s| damped(s) != 0.0),
            elastic: setups.iter().any(|s| s.omega2.iter().any(|w| *w != 0.0)),
            steady,
            turns: rotational.contains(&true),
            rotational,
            forces,
            varying,
            tolerance: get(&|s| s.tolerance),
            constant: mode_wise(&|s, j| conserved(s, j)),
            rate: setups.iter().any(|s| s.forms.iter().any(|f| f.rate)),
            accelerations: one
                .outputs
                .iter()
                .any(|o| matches!(o, Output::Motion { order: 1 | 2, .. })),
            outputs: Outputs::new(with, setups, &places),
            contacts,
            feet: one.shape.feet.clone(),
            others: (0..contacts).filter(|i| !one.shape.feet.contains(i)).collect(),
            falls: one.forms.iter().any(|f| f.extent.falls),
            places,
        }
    }
}

/// Coordinates that a link takes where the widest has so many: all that there is room for where that is little in all.
#[inline(always)]
fn block<const L: usize, const N: usize>(widest: usize) -> usize {
    if const { L <= SMALL } { N } else { widest.min(N) }
}

impl<R: Real, const M: usize, const L: usize, const N: usize> Plan<R, M, L, N> {
    /// Modes that loops go over.
    #[inline(always)]
    pub fn modes(&self) -> usize {
        taken::<M>(self.counts[0])
    }

    /// Link coordinates that loops go over: whole [blocks](Self::block).
    #[inline(always)]
    pub fn coordinates(&self) -> usize {
        taken::<L>(self.counts[1])
    }

    /// Coordinates of every link that loops go over.
    #[inline(always)]
    pub fn block(&self) -> usize {
        block::<L, N>(self.counts[2])
    }

    /// B q.
    #[inline(always)]
    pub fn deform(&self, q: &[R; M]) -> [R; L] {
        times((self.coordinates(), self.modes()), &self.columns, q)
    }

    /// Bᵀ f.
    #[inline(always)]
    pub fn push(&self, f: &[R; L]) -> [R; M] {
        times((self.modes(), self.coordinates()), &self.b, f)
    }
}
