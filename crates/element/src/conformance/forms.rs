//! Do the other forms of a law answer as the law does: over lanes, and as the constant of a dashpot?

use super::ConformanceError as Broken;
use super::path::Path;
use super::probe::march;
use crate::lanes::{Arithmetic, LaneForm, LaneLinks, LaneStep, Portable, Real};
#[cfg(target_arch = "x86_64")]
use crate::lanes::{Avx2Lanes, Avx512Lanes};
use crate::{Answer, Field, Kinematics, Link};

/// Steps of a cycle; not a multiple of the number of lanes.
const STEPS: usize = 45;
/// Admissible difference: rounding, relative to the largest on the path.
const ROUNDING: f64 = 1e-9;

/// One question and what the law answered.
pub(super) struct Case {
    time: f64,
    d: Vec<f64>,
    v: Vec<f64>,
    d0: Vec<f64>,
    v0: Vec<f64>,
    dt: f64,
    pub(super) history: Vec<f64>,
    answer: Answer,
}

impl Case {
    /// Those along a path.
    pub(super) fn along(link: &dyn Link, path: &Path) -> Result<Vec<Self>, Broken> {
        let mut cases = Vec::new();
        march(link, path, 2, STEPS, |s| {
            let [d, v, d0, v0] = [s.at.d, s.at.v, s.at.d0, s.at.v0].map(<[f64]>::to_vec);
            let (history, answer) = (s.before.history.clone(), s.answer.clone());
            cases.push(Self { time: s.time, d, v, d0, v0, dt: s.at.dt, history, answer });
            Ok(())
        })?;
        Ok(cases)
    }

    pub(super) fn at(&self) -> Kinematics<'_> {
        let Self { d, v, d0, v0, dt, .. } = self;
        Kinematics { d, v, d0, v0, dt: *dt }
    }
}

/// All forms along a path.
pub(super) fn forms(link: &dyn Link, path: &Path) -> Result<(), Broken> {
    let active: Vec<bool> = path.scale.iter().map(|s| *s > 0.0).collect();
    let (constant, lanes) = (link.damping_constant(), link.lanes(&active));
    if constant.is_none() && lanes.is_none() {
        return Ok(());
    }
    let cases = Case::along(link, path)?;
    if let Some(c) = constant {
        dashpot(link, c, &cases, path)?;
    }
    let Some(form) = lanes else { return Ok(()) };
    let (given, own) = (form.law.history, link.history().len());
    if given != own {
        return Err(Broken::LaneHistory { given, own });
    }
    let look = Look { form: &form, cases: &cases, path, scales: Scales::of(link, &cases, path) };
    look.compare(Portable)?;
    #[cfg(target_arch = "x86_64")]
    {
        Avx2Lanes::available().map_or(Ok(()), |with| look.compare(with))?;
        Avx512Lanes::available().map_or(Ok(()), |with| look.compare(with))?;
    }
    Ok(())
}

/// `f = c ḋ`, all of it heat.
fn dashpot(link: &dyn Link, c: f64, cases: &[Case], path: &Path) -> Result<(), Broken> {
    let scales = Scales::of(link, cases, path);
    for case in cases {
        let at = case.at();
        let heat = at.viscous_work(0, c * at.v0[0], c * at.v[0]);
        let given = Parts {
            f: vec![c * at.v[0]],
            k: vec![0.0],
            c: vec![c],
            energy: [0.0, 0.0, heat],
            trial: Vec::new(),
        };
        scales.agree("damping_constant", &given, &[0], case, path)?;
    }
    Ok(())
}

/// What a form answers; rows of the coordinates that it works on.
struct Parts {
    f: Vec<f64>,
    k: Vec<f64>,
    c: Vec<f64>,
    energy: [f64; 3],
    trial: Vec<f64>,
}

/// The largest of everything on a path. A variable of the history that is a deformation, a force or an energy counts as one:
/// where it stays at zero, what rounding makes of it is beside these.
struct Scales {
    f: Vec<f64>,
    k: f64,
    c: f64,
    energy: f64,
    trial: Vec<f64>,
}

fn energies(answer: &Answer) -> [f64; 3] {
    [answer.energy.stored, answer.energy.hysteretic, answer.energy.viscous]
}

impl Scales {
    fn of(link: &dyn Link, cases: &[Case], path: &Path) -> Self {
        let most = |x: &mut dyn Iterator<Item = f64>| x.fold(0.0, |a: f64, b| a.max(b.abs()));
        let n = path.scale.len();
        let answers = || cases.iter().map(|c| &c.answer);
        let f: Vec<f64> = (0..n).map(|i| most(&mut answers().map(|a| a.f[i]))).collect();
        let work: f64 = f.iter().zip(&path.scale).map(|(f, d)| f * d).sum();
        let energy = most(&mut answers().flat_map(energies)).max(work);
        let deformation = most(&mut cases.iter().flat_map(|c| c.d.iter().copied()));
        let force = most(&mut f.iter().copied());
        let of_its_kind = |field: &Field| match field.unit {
            "m" | "rad" => deformation,
            "N" | "N·m" => force,
            "J" => energy,
            _ => 0.0,
        };
        let trial = |(i, field): (usize, &Field)| {
            most(&mut answers().map(|a| a.trial[i])).max(of_its_kind(field))
        };
        let trial = link.history().iter().enumerate().map(trial).collect();
        Self {
            f,
            k: most(&mut answers().flat_map(|a| a.k.iter().copied())),
            c: most(&mut answers().flat_map(|a| a.c.iter().copied())),
            energy,
            trial,
        }
    }

    /// Is a form's answer that of the law?
    fn agree(
        &self,
        form: &'static str,
        given: &Parts,
        coordinates: &[usize],
        case: &Case,
        path: &Path,
    ) -> Result<(), Broken> {
        let same = |what, index, given: f64, own: f64, scale: f64| {
            if (given - own).abs() <= ROUNDING * scale {
                return Ok(());
            }
            let (path, time) = (path.number, case.time);
            Err(Broken::Form { form, what, index, given, own, path, time })
        };
        let (own, n) = (&case.answer, case.d.len());
        for (i, row) in coordinates.iter().enumerate() {
            same("f", *row, given.f[i], own.f[*row], self.f[*row])?;
            for (j, column) in coordinates.iter().enumerate() {
                let (from, to) = (i * coordinates.len() + j, row * n + column);
                same("k", to, given.k[from], own.k[to], self.k)?;
                same("c", to, given.c[from], own.c[to], self.c)?;
            }
        }
        for (i, (given, own)) in given.energy.iter().zip(energies(own)).enumerate() {
            same("energy", i, *given, own, self.energy)?;
        }
        for (i, (given, own)) in given.trial.iter().zip(&own.trial).enumerate() {
            same("trial", i, *given, *own, self.trial[i])?;
        }
        Ok(())
    }
}

/// A form for lanes and what it is held against.
struct Look<'a> {
    form: &'a LaneForm,
    cases: &'a [Case],
    path: &'a Path,
    scales: Scales,
}

impl Look<'_> {
    /// Asks about a step of the path in every lane.
    fn compare<A: Arithmetic>(&self, with: A) -> Result<(), Broken> {
        let Self { form, cases, path, scales } = self;
        for cases in cases.chunks(A::WIDTH) {
            let mut batch = Batch::new(with, form, cases);
            batch.ask(with, form);
            let Batch { step, f, k, c, trial, .. } = &batch;
            for (lane, case) in cases.iter().enumerate() {
                let one = |x: &A::Real| with.lane(*x, lane);
                let all = |x: &[A::Real]| x.iter().map(one).collect();
                let energy = [step.stored, step.hysteretic, step.viscous].map(|x| one(&x));
                let given = Parts { f: all(f), k: all(k), c: all(c), energy, trial: all(trial) };
                scales.agree("lanes", &given, &form.coordinates, case, path)?;
            }
        }
        Ok(())
    }
}

/// A question in every lane, and room for the answers.
pub(super) struct Batch<R> {
    parameters: Vec<R>,
    d: Vec<R>,
    v: Vec<R>,
    d0: Vec<R>,
    v0: Vec<R>,
    dt: R,
    history: Vec<R>,
    trial: Vec<R>,
    f: Vec<R>,
    k: Vec<R>,
    c: Vec<R>,
    step: LaneStep<R>,
}

impl<R: Real> Batch<R> {
    /// The questions of some cases, the last one in the lanes that are left.
    pub(super) fn new<A: Arithmetic<Real = R>>(with: A, form: &LaneForm, cases: &[Case]) -> Self {
        let (law, at) = (&form.law, &form.coordinates);
        let n = law.coordinates;
        let zero = with.splat(0.0);
        let of = |lane: usize| &cases[lane.min(cases.len() - 1)];
        let take = |read: fn(&Case) -> &[f64]| -> Vec<R> {
            at.iter().map(|i| with.gather(|lane| read(of(lane))[*i])).collect()
        };
        // Without rates it gets none, as in a run.
        let rates = |read: fn(&Case) -> &[f64]| match form.rate {
            true => take(read),
            false => vec![with.splat(f64::NAN); n],
        };
        Self {
            parameters: form.parameters.iter().map(|p| with.splat(*p)).collect(),
            d: take(|c| &c.d),
            v: rates(|c| &c.v),
            d0: take(|c| &c.d0),
            v0: rates(|c| &c.v0),
            dt: with.gather(|lane| of(lane).dt),
            history: (0..law.history).map(|i| with.gather(|lane| of(lane).history[i])).collect(),
            // What a law leaves unwritten is found.
            trial: vec![with.splat(f64::NAN); law.history],
            f: vec![zero; n],
            k: vec![zero; n * n],
            c: vec![zero; n * n],
            step: LaneStep::elastic(zero),
        }
    }

    /// Asks for all of the answer.
    pub(super) fn ask<A: Arithmetic<Real = R>>(&mut self, with: A, form: &LaneForm) {
        let law = &form.law;
        let mut links = LaneLinks {
            parameters: &self.parameters,
            d: &self.d,
            v: &self.v,
            d0: &self.d0,
            v0: &self.v0,
            dt: self.dt,
            history: &self.history,
            trial: &mut self.trial,
            f: &mut self.f,
            k: &mut self.k,
            c: &mut self.c,
        };
        let end = std::slice::from_mut(&mut self.step);
        with.respond(law, &mut links, end);
    }
}

#[cfg(test)]
mod tests {
    use super::super::{ConformanceError, Kit};
    use crate::lanes::{LaneAt, LaneForce, LaneForm, LaneLaw, LaneStep, Real};
    use crate::{Axis, Coordinates, Kinematics, Link, Response};

    const K: f64 = 50.0;
    const C: f64 = 3.0;

    /// A stop without a gap, and a dashpot; each says of itself what the test wants.
    #[derive(Debug)]
    enum Law {
        Stop(fn() -> LaneForm),
        Dashpot(f64),
    }

    /// `SPOIL`: 1 a stiffness that is not that of the law, 2 one lane's question decides for all.
    struct Stop<const SPOIL: u8>;

    impl<const SPOIL: u8> LaneLaw for Stop<SPOIL> {
        const COORDINATES: usize = 1;
        const HISTORY: usize = 0;
        const PARAMETERS: usize = 1;

        #[inline(always)]
        fn respond<R: Real>(
            at: &LaneAt<'_, R>,
            out: &mut LaneForce<'_, R>,
            _: &mut [R],
        ) -> LaneStep<R> {
            let (k, d) = (at.parameters[0], at.d[0]);
            let zero = k.of(0.0);
            let mut closed = d.lt(zero);
            if SPOIL == 2 && d.any(closed) {
                closed = zero.le(zero);
            }
            (out.f[0], out.k[0], out.c[0]) = ((k * d).only(closed), k.only(closed), zero);
            if SPOIL == 1 {
                out.k[0] = k;
            }
            LaneStep::elastic(zero.of(0.5) * out.f[0] * out.f[0] / k)
        }
    }

    fn stop<const SPOIL: u8>() -> LaneForm {
        LaneForm::of::<Stop<SPOIL>>(vec![0], vec![K])
    }

    impl Link for Law {
        fn coordinates(&self) -> Coordinates {
            Coordinates::Local(vec![Axis::U1])
        }
        fn engaged_stiffness(&self, k: &mut [f64]) {
            k[0] = K;
        }
        fn respond(&self, at: &Kinematics<'_>, _: &[f64], _: &mut [f64], out: &mut Response<'_>) {
            match self {
                Self::Dashpot(_) => {
                    (out.f[0], out.c[0]) = (C * at.v[0], C);
                    out.energy.viscous = at.viscous_work(0, C * at.v0[0], out.f[0]);
                }
                Self::Stop(_) if at.d[0] < 0.0 => {
                    (out.f[0], out.k[0]) = (K * at.d[0], K);
                    out.energy.stored = 0.5 * K * at.d[0] * at.d[0];
                }
                Self::Stop(_) => {}
            }
        }
        fn damping_constant(&self) -> Option<f64> {
            if let Self::Dashpot(c) = self { Some(*c) } else { None }
        }
        fn lanes(&self, _: &[bool]) -> Option<LaneForm> {
            if let Self::Stop(form) = self { Some(form()) } else { None }
        }
    }

    fn broken(law: &Law) -> (&'static str, &'static str) {
        match Kit::new(&[0.02], 1.0).check(law) {
            Err(ConformanceError::Form { form, what, .. }) => (form, what),
            other => panic!("{other:?}"),
        }
    }

    #[test]
    fn sound_forms_pass() {
        for law in [Law::Stop(stop::<0>), Law::Dashpot(C)] {
            assert!(Kit::new(&[0.02], 1.0).check(&law).is_ok(), "{law:?}");
        }
    }

    #[test]
    fn a_form_with_another_answer_is_caught() {
        assert_eq!(broken(&Law::Stop(stop::<1>)), ("lanes", "k"));
        assert_eq!(broken(&Law::Dashpot(1.01 * C)), ("damping_constant", "f"));
    }

    #[test]
    #[cfg(target_arch = "x86_64")]
    fn lanes_that_are_not_alone_are_caught() {
        if crate::lanes::Avx2Lanes::available().is_some() {
            assert_eq!(broken(&Law::Stop(stop::<2>)), ("lanes", "f"));
        }
    }
}
