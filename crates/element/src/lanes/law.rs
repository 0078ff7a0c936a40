//! Laws over lanes, and how a sweep calls them.

use super::listed::Listed;
#[cfg(target_arch = "x86_64")]
use super::side_by_side::respond_together;
use super::{Arithmetic, Dual, Portable, Real, Task};
#[cfg(target_arch = "x86_64")]
use super::{Avx2Lanes, Avx512Lanes, FusedOne};
use crate::{Contact, Energy, Kinematics};
use std::any::TypeId;
use std::fmt;
use std::marker::PhantomData;

/// What a law is asked about, as [`Kinematics`](crate::Kinematics) and the committed history, with the
/// parameters of the link.
#[derive(Clone, Copy, Debug)]
pub struct LaneAt<'a, R> {
    /// Parameters.
    pub parameters: &'a [R],
    /// Deformation at the end of the step.
    pub d: &'a [R],
    /// Rate at the end of the step; zero where [`LaneForm::rate`] says that nobody looks.
    pub v: &'a [R],
    /// Deformation at the start of the step.
    pub d0: &'a [R],
    /// Rate at the start of the step.
    pub v0: &'a [R],
    /// Step, s; zero at the very start.
    pub dt: R,
    /// Committed history.
    pub history: &'a [R],
}

impl<'a> LaneAt<'a, f64> {
    /// What an ordinary link is asked about.
    #[must_use]
    pub fn new(at: &Kinematics<'a>, history: &'a [f64], parameters: &'a [f64]) -> Self {
        Self { parameters, d: at.d, v: at.v, d0: at.d0, v0: at.v0, dt: at.dt, history }
    }
}

impl<R: Real> LaneAt<'_, R> {
    /// As [`Kinematics::viscous_work`].
    #[inline(always)]
    #[must_use]
    pub fn viscous_work(&self, i: usize, start: R, end: R) -> R {
        let (v0, v1) = (self.v0[i], self.v[i]);
        let two = start.of(2.0);
        let sum = start * (two * v0 + v1) + end * (v0 + two * v1);
        (self.dt * sum * start.of(1.0 / 6.0)).max(start.of(0.0))
    }
}

/// Force and tangents to be written, all of them: nothing is zeroed before.
#[derive(Debug)]
pub struct LaneForce<'a, R> {
    /// Force.
    pub f: &'a mut [R],
    /// ∂f/∂d, row by row.
    pub k: &'a mut [R],
    /// ∂f/∂ḋ, row by row.
    pub c: &'a mut [R],
}

/// What a contact does, as [`Contact`](crate::Contact).
#[derive(Clone, Copy, Debug)]
pub struct LaneContact<R> {
    /// Distance between the surfaces, m.
    pub gap: R,
    /// Normal force, N.
    pub normal: R,
    /// Tangential position, m.
    pub position: [R; 2],
    /// 1 while slipping goes on, else 0.
    pub slipping: R,
}

impl<R: Real> LaneContact<R> {
    /// Of a contact that has no friction.
    #[inline(always)]
    #[must_use]
    pub fn smooth(gap: R, normal: R) -> Self {
        let zero = gap.of(0.0);
        Self { gap, normal, position: [zero; 2], slipping: zero }
    }
}

impl From<LaneContact<f64>> for Contact {
    fn from(it: LaneContact<f64>) -> Self {
        let LaneContact { gap, normal, position, slipping } = it;
        Self { gap, normal, position, slipping: slipping > 0.0 }
    }
}

/// What a step did: energies as [`Energy`](crate::Energy).
#[derive(Clone, Copy, Debug)]
pub struct LaneStep<R> {
    /// Recoverable energy at the end of the step, J.
    pub stored: R,
    /// Heat of friction and yielding in the step, J.
    pub hysteretic: R,
    /// Heat of rate-dependent forces in the step, J.
    pub viscous: R,
}

impl<R: Real> LaneStep<R> {
    /// Of an elastic law.
    #[inline(always)]
    #[must_use]
    pub fn elastic(stored: R) -> Self {
        let zero = stored.of(0.0);
        Self { stored, hysteretic: zero, viscous: zero }
    }
}

impl From<LaneStep<f64>> for Energy {
    fn from(it: LaneStep<f64>) -> Self {
        let LaneStep { stored, hysteretic, viscous } = it;
        Self { stored, hysteretic, viscous }
    }
}

/// A law over lanes. Same contract as [`Link`](crate::Link). All functions must be `#[inline(always)]`.
pub trait LaneLaw: 'static {
    /// Number of coordinates n.
    const COORDINATES: usize;
    /// Number of history variables, which are those of the link.
    const HISTORY: usize;
    /// Number of parameters.
    const PARAMETERS: usize;
    /// Number of contacts, those of the link.
    const CONTACTS: usize = 0;
    /// True where it may end a run: a body that overturns.
    const FALLS: bool = false;
    /// True for a law so long that several links of one analysis gain nothing side by side.
    const IS_LONG: bool = false;

    /// Force, tangents, the whole trial history, and energies of a step.
    fn respond<R: Real>(
        at: &LaneAt<'_, R>,
        out: &mut LaneForce<'_, R>,
        trial: &mut [R],
    ) -> LaneStep<R>;

    /// What its contacts do after a step, where the history is that of its end and the start of the step is not looked
    /// at; 1 where the body on them has overturned, else 0.
    #[inline(always)]
    fn contacts<R: Real>(at: &LaneAt<'_, R>, _: &[R], _: &mut [LaneContact<R>]) -> R {
        at.dt.of(0.0)
    }
}

/// A link in the form for lanes. Analyses whose links have the same law run together.
#[derive(Clone, Debug)]
pub struct LaneForm {
    /// The law.
    pub law: ErasedLaw,
    /// The coordinates of the link that it works on, as indices into those of the link; the others
    /// must be zero at all times.
    pub coordinates: Vec<usize>,
    /// Its parameters.
    pub parameters: Vec<f64>,
    /// True where rates of deformation matter.
    pub rate: bool,
}

impl LaneForm {
    /// A link of a law.
    ///
    /// # Panics
    /// Where the numbers of coordinates or parameters are not those of the law.
    #[must_use]
    pub fn of<L: LaneLaw>(coordinates: Vec<usize>, parameters: Vec<f64>) -> Self {
        assert_eq!(coordinates.len(), L::COORDINATES, "coordinates of a law over lanes");
        assert_eq!(parameters.len(), L::PARAMETERS, "parameters of a law over lanes");
        Self { law: ErasedLaw::of::<L>(), coordinates, parameters, rate: true }
    }

    /// The same where its law does not look at rates.
    #[must_use]
    pub fn without_rate(self) -> Self {
        Self { rate: false, ..self }
    }
}

/// Links of one law, one after the other in every slice.
#[derive(Debug)]
pub struct LaneLinks<'a, R> {
    /// Parameters of all links.
    pub parameters: &'a [R],
    /// Deformations at the end of the step.
    pub d: &'a [R],
    /// Their rates.
    pub v: &'a [R],
    /// Deformations at the start of the step.
    pub d0: &'a [R],
    /// Their rates.
    pub v0: &'a [R],
    /// Step.
    pub dt: R,
    /// Committed history.
    pub history: &'a [R],
    /// History at the end of the step.
    pub trial: &'a mut [R],
    /// Forces; contacts look at them.
    pub f: &'a mut [R],
    /// ∂f/∂d, block by block.
    pub k: &'a mut [R],
    /// ∂f/∂ḋ, block by block.
    pub c: &'a mut [R],
}

impl<'a, R: Real> LaneLinks<'a, R> {
    /// What the link with this index is asked about.
    #[inline(always)]
    fn question<L: LaneLaw>(&self, i: usize) -> LaneAt<'a, R> {
        let (n, h, p) = (L::COORDINATES, L::HISTORY, L::PARAMETERS);
        let r = i * n..(i + 1) * n;
        LaneAt {
            parameters: &self.parameters[i * p..(i + 1) * p],
            d: &self.d[r.clone()],
            v: &self.v[r.clone()],
            d0: &self.d0[r.clone()],
            v0: &self.v0[r],
            dt: self.dt,
            history: &self.history[i * h..(i + 1) * h],
        }
    }

    /// The same with where the answer goes: force and tangents, and the history at the end.
    #[inline(always)]
    fn with_room<L: LaneLaw>(&mut self, i: usize) -> (LaneAt<'a, R>, LaneForce<'_, R>, &mut [R]) {
        let (n, h) = (L::COORDINATES, L::HISTORY);
        let at = self.question::<L>(i);
        let block = i * n * n..(i + 1) * n * n;
        let out = LaneForce {
            f: &mut self.f[i * n..(i + 1) * n],
            k: &mut self.k[block.clone()],
            c: &mut self.c[block],
        };
        (at, out, &mut self.trial[i * h..(i + 1) * h])
    }

    /// The answer of the link with this index.
    #[cfg(target_arch = "x86_64")]
    #[inline(always)]
    pub(super) fn respond<L: LaneLaw>(&mut self, i: usize) -> LaneStep<R> {
        let (at, mut out, trial) = self.with_room::<L>(i);
        L::respond(&at, &mut out, trial)
    }
}

/// What a law answers over plain numbers: one function for the link itself and for sweeps on any machine.
#[inline(never)]
pub fn respond<L: LaneLaw>(
    at: &LaneAt<'_, f64>,
    out: &mut LaneForce<'_, f64>,
    trial: &mut [f64],
) -> LaneStep<f64> {
    L::respond(at, out, trial)
}

type RespondBy<A> =
    fn(A, &mut LaneLinks<'_, <A as Arithmetic>::Real>, &mut [LaneStep<<A as Arithmetic>::Real>]);
type ContactsBy<A> = fn(
    A,
    &LaneLinks<'_, <A as Arithmetic>::Real>,
    &mut [LaneContact<<A as Arithmetic>::Real>],
    &mut [<A as Arithmetic>::Real],
);

/// A number with its derivatives in some directions at once.
pub type Directions = Dual<DIRECTIONS>;

/// How many they are.
pub const DIRECTIONS: usize = 8;

type DerivativeBy =
    fn(&LaneAt<'_, Listed>, &mut LaneForce<'_, Listed>, &mut [Listed]) -> LaneStep<Listed>;

/// A law on one arithmetic: all of its answer, and its contacts.
#[derive(Clone, Copy)]
pub(super) struct Entries<R, C> {
    pub respond: R,
    pub contacts: C,
}

type EntriesBy<A> = Entries<RespondBy<A>, ContactsBy<A>>;

/// A law over lanes without its type: entries for every [`Arithmetic`].
#[derive(Clone, Copy)]
pub struct ErasedLaw {
    /// Which law it is.
    pub id: TypeId,
    /// Number of coordinates.
    pub coordinates: usize,
    /// Number of history variables.
    pub history: usize,
    /// Number of parameters.
    pub parameters: usize,
    /// Number of contacts.
    pub contacts: usize,
    /// True where it may end a run.
    pub falls: bool,
    /// True where several links of one analysis gain nothing side by side.
    pub is_long: bool,
    derivative: DerivativeBy,
    pub(super) portable: EntriesBy<Portable>,
    #[cfg(target_arch = "x86_64")]
    pub(super) fused: EntriesBy<FusedOne>,
    #[cfg(target_arch = "x86_64")]
    pub(super) avx2: EntriesBy<Avx2Lanes>,
    #[cfg(target_arch = "x86_64")]
    pub(super) avx512: EntriesBy<Avx512Lanes>,
}

impl fmt::Debug for ErasedLaw {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("ErasedLaw").field("id", &self.id).finish_non_exhaustive()
    }
}

// One link to a task: a law inside a loop takes several times as long to compile. Only where lanes are widest is that
// worth it: a call for each link takes 3 % of a sweep.

#[cfg(target_arch = "x86_64")]
pub(super) struct RespondTask<'a, 'b, L, R>(
    pub &'a mut LaneLinks<'b, R>,
    pub usize,
    pub PhantomData<L>,
);

#[cfg(target_arch = "x86_64")]
impl<A: Arithmetic, L: LaneLaw> Task<A> for RespondTask<'_, '_, L, A::Real> {
    type Output = LaneStep<A::Real>;
    #[inline(always)]
    fn run(self, _: A) -> LaneStep<A::Real> {
        self.0.respond::<L>(self.1)
    }
}

#[cfg(target_arch = "x86_64")]
struct RespondAll<'a, 'b, L, R>(&'a mut LaneLinks<'b, R>, &'a mut [LaneStep<R>], PhantomData<L>);

#[cfg(target_arch = "x86_64")]
impl<A: Arithmetic, L: LaneLaw> Task<A> for RespondAll<'_, '_, L, A::Real> {
    type Output = ();
    #[inline(always)]
    fn run(self, _: A) {
        let Self(links, steps, _) = self;
        for (i, step) in steps.iter_mut().enumerate() {
            *step = links.respond::<L>(i);
        }
    }
}

struct ContactsTask<'a, 'b, L, R>(
    &'a LaneLinks<'b, R>,
    usize,
    &'a mut [LaneContact<R>],
    PhantomData<L>,
);

impl<A: Arithmetic, L: LaneLaw> Task<A> for ContactsTask<'_, '_, L, A::Real> {
    type Output = A::Real;
    #[inline(always)]
    fn run(self, _: A) -> A::Real {
        let Self(links, i, out, _) = self;
        let (n, c) = (L::COORDINATES, L::CONTACTS);
        let at = links.question::<L>(i);
        L::contacts(&at, &links.f[i * n..(i + 1) * n], &mut out[i * c..(i + 1) * c])
    }
}

#[cfg(target_arch = "x86_64")]
fn respond_all<A: Arithmetic, L: LaneLaw>(
    with: A,
    links: &mut LaneLinks<'_, A::Real>,
    out: &mut [LaneStep<A::Real>],
) {
    with.run(RespondAll::<L, _>(links, out, PhantomData));
}

#[cfg(target_arch = "x86_64")]
fn respond_each<A: Arithmetic, L: LaneLaw>(
    with: A,
    links: &mut LaneLinks<'_, A::Real>,
    out: &mut [LaneStep<A::Real>],
) {
    for (i, step) in out.iter_mut().enumerate() {
        *step = with.run(RespondTask::<L, _>(links, i, PhantomData));
    }
}

fn respond_plainly<L: LaneLaw>(
    _: Portable,
    links: &mut LaneLinks<'_, f64>,
    out: &mut [LaneStep<f64>],
) {
    for (i, step) in out.iter_mut().enumerate() {
        let (at, mut out, trial) = links.with_room::<L>(i);
        *step = respond::<L>(&at, &mut out, trial);
    }
}

fn entries_by<A: Arithmetic, L: LaneLaw>(respond: RespondBy<A>) -> EntriesBy<A> {
    Entries {
        respond,
        contacts: |with, links, out, fallen| {
            for (i, fallen) in fallen.iter_mut().enumerate() {
                *fallen = with.run(ContactsTask::<L, _>(links, i, out, PhantomData));
            }
        },
    }
}

impl ErasedLaw {
    /// All of the answer of links of one law, and its derivatives in [some directions](Directions) at once, exact to
    /// rounding: in which ones is said by the derivatives of what the law is asked about.
    ///
    /// # Panics
    /// Where slices are not those of as many links as there are steps.
    pub fn derivative(
        &self,
        links: &mut LaneLinks<'_, Directions>,
        out: &mut [LaneStep<Directions>],
    ) {
        let (n, h, p) = (self.coordinates, self.history, self.parameters);
        for (i, step) in out.iter_mut().enumerate() {
            let (own, block) = (i * n..(i + 1) * n, i * n * n..(i + 1) * n * n);
            Listed::begin();
            let listed = |x: &[Directions]| x.iter().map(|x| Listed::new(*x)).collect::<Vec<_>>();
            let at = [&links.d, &links.v, &links.d0, &links.v0].map(|x| listed(&x[own.clone()]));
            let [parameters, history] =
                [(links.parameters, p), (links.history, h)].map(|(x, n)| listed(&x[i * n..][..n]));
            let zero = Listed::new(Directions::constant(0.0));
            let [mut f, mut k, mut c, mut trial] = [n, n * n, n * n, h].map(|n| vec![zero; n]);
            let asked = LaneAt {
                parameters: &parameters,
                d: &at[0],
                v: &at[1],
                d0: &at[2],
                v0: &at[3],
                dt: Listed::new(links.dt),
                history: &history,
            };
            let mut force = LaneForce { f: &mut f, k: &mut k, c: &mut c };
            let did = (self.derivative)(&asked, &mut force, &mut trial);
            let give = |to: &mut [Directions], from: &[Listed]| {
                to.iter_mut().zip(from).for_each(|(to, x)| *to = x.number());
            };
            give(&mut links.f[own], &f);
            give(&mut links.k[block.clone()], &k);
            give(&mut links.c[block], &c);
            give(&mut links.trial[i * h..(i + 1) * h], &trial);
            *step = LaneStep {
                stored: did.stored.number(),
                hysteretic: did.hysteretic.number(),
                viscous: did.viscous.number(),
            };
        }
    }

    /// The entries of a law.
    #[must_use]
    pub fn of<L: LaneLaw>() -> Self {
        Self {
            id: TypeId::of::<L>(),
            coordinates: L::COORDINATES,
            history: L::HISTORY,
            parameters: L::PARAMETERS,
            contacts: L::CONTACTS,
            falls: L::FALLS,
            is_long: L::IS_LONG,
            derivative: |at, out, trial| L::respond(at, out, trial),
            portable: entries_by::<Portable, L>(respond_plainly::<L>),
            #[cfg(target_arch = "x86_64")]
            fused: entries_by::<FusedOne, L>(respond_together::<L>),
            #[cfg(target_arch = "x86_64")]
            avx2: entries_by::<Avx2Lanes, L>(respond_each::<Avx2Lanes, L>),
            #[cfg(target_arch = "x86_64")]
            avx512: entries_by::<Avx512Lanes, L>(respond_all::<Avx512Lanes, L>),
        }
    }
}
