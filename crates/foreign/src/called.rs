//! Links whose law is called.

use crate::card::Shape;
use crate::declaration::MOST_HISTORY;
use crate::function::{LawFunction, NoAnswer};
use std::borrow::Cow;
use std::sync::Arc;
use trilith_element::{Coordinates, Energy, Field, Kinematics, LawFailed, Link, Response};

/// Coordinates at most: the local axes.
const N: usize = 6;
/// Steps of differences, as a share of the amplitude of a coordinate.
const STEP: f64 = 1e-6;

/// A link whose law is a function that is [called](LawFunction).
///
/// **Tangents** that the law does not give are central differences, `(f(x + h) − f(x − h))/2h` with h a millionth of the
/// amplitude of the coordinate (for rates, of the rate of such cycles). Of a smooth law they are right to about 1e-9 of force
/// over amplitude; nearer to a kink than h they are the mean of both sides, which costs iterations and no accuracy: the force
/// is that of the law everywhere. They cost 2 n calls, 4 n where the law looks at rates.
///
/// **Energy** that the law does not tell is the work that the step does on it, `½ (f₀ + f)·(d − d₀)`, counted as heat that is
/// negative where the link gives work back: the ledger closes by construction, says nothing of the law, and every run
/// [says so](Link::accounts).
#[derive(Debug)]
pub struct CalledLaw {
    shape: &'static Shape,
    function: Arc<dyn LawFunction>,
    parameters: Box<[f64]>,
    engaged: Box<[f64]>,
    rest: Box<[f64]>,
}

/// Room for an answer that nobody wants whole.
struct Scratch {
    f: [f64; N],
    k: [f64; N * N],
    c: [f64; N * N],
    trial: [f64; MOST_HISTORY],
    energy: Energy,
}

impl Scratch {
    fn new() -> Self {
        Self {
            f: [0.0; N],
            k: [0.0; N * N],
            c: [0.0; N * N],
            trial: [f64::NAN; MOST_HISTORY],
            energy: Energy::default(),
        }
    }
}

impl CalledLaw {
    pub(crate) fn new(
        shape: &'static Shape,
        function: Arc<dyn LawFunction>,
        parameters: Box<[f64]>,
    ) -> Result<Self, String> {
        function.check(&parameters)?;
        let n = shape.axes.len();
        let mut rest = vec![0.0; shape.fields.len()].into_boxed_slice();
        function.at_rest(&parameters, &mut rest)?;
        let mut engaged = vec![0.0; n * n].into_boxed_slice();
        let given = function.engaged(&parameters, &mut engaged)?;
        let mut law = Self { shape, function, parameters, engaged, rest };
        if !given {
            law.engaged = law.diagonal_at_rest();
        }
        Ok(law)
    }

    /// The diagonal of the tangent at rest, where it is positive. A law without an answer there has none.
    fn diagonal_at_rest(&self) -> Box<[f64]> {
        let n = self.shape.axes.len();
        let mut k = vec![0.0; n * n];
        let (mut f, mut c, mut energy) = ([0.0; N], [0.0; N * N], Energy::default());
        let mut trial = [0.0; MOST_HISTORY];
        let still = if self.shape.rates { [0.0; N] } else { [f64::NAN; N] };
        let at = Kinematics::still(&[0.0; N][..n], &still[..n]);
        let out = &mut Response::new(&mut f[..n], &mut k, &mut c[..n * n], &mut energy);
        let trial = &mut trial[..self.rest.len()];
        // What is wrong there shows where the law is asked, with the name of the link.
        let _ = self.answer(&at, &self.rest, trial, out);
        let entry = |i: usize| {
            if i.is_multiple_of(n + 1) && k[i].is_finite() { k[i].max(0.0) } else { 0.0 }
        };
        (0..n * n).map(entry).collect()
    }

    fn answer(
        &self,
        at: &Kinematics<'_>,
        committed: &[f64],
        trial: &mut [f64],
        out: &mut Response<'_>,
    ) -> Result<(), NoAnswer> {
        let Self { shape, function, parameters, .. } = self;
        function.respond(parameters, at, committed, trial, out)?;
        if !shape.tangent {
            let columns = |x: &[f64]| x.iter().all(|x| x.is_finite());
            if columns(out.f) {
                self.differences(at, committed, false, &shape.amplitude, out.k)?;
                if shape.rates {
                    self.differences(at, committed, true, &shape.rate, out.c)?;
                }
            }
        } else if !shape.rates {
            out.c.fill(0.0);
        }
        if !shape.energy {
            *out.energy = Energy::new(0.0, self.work(at, committed, out.f)?, 0.0);
        }
        Ok(())
    }

    /// The force alone, into a scratch.
    #[inline(never)]
    fn force(
        &self,
        at: &Kinematics<'_>,
        committed: &[f64],
        to: &mut Scratch,
    ) -> Result<(), NoAnswer> {
        let n = self.shape.axes.len();
        let Scratch { f, k, c, trial, energy } = to;
        let trial = &mut trial[..committed.len()];
        let out = &mut Response::new(&mut f[..n], &mut k[..n * n], &mut c[..n * n], energy);
        self.function.force(&self.parameters, at, committed, trial, out)
    }

    /// Derivatives of the force by deformations or rates, row by row.
    #[inline(never)]
    fn differences(
        &self,
        at: &Kinematics<'_>,
        committed: &[f64],
        by_rate: bool,
        size: &[f64],
        to: &mut [f64],
    ) -> Result<(), NoAnswer> {
        let n = self.shape.axes.len();
        let middle = if by_rate { at.v } else { at.d };
        for j in 0..n {
            let mut x = [0.0; N];
            x[..n].copy_from_slice(middle);
            let mut sides = [Scratch::new(), Scratch::new()];
            let mut ends = [middle[j] - STEP * size[j], middle[j] + STEP * size[j]];
            for (side, end) in sides.iter_mut().zip(&mut ends) {
                x[j] = *end;
                let (d, v) = if by_rate { (at.d, &x[..n]) } else { (&x[..n], at.v) };
                let moved = Kinematics::new([d, v], [at.d0, at.v0], at.dt);
                // Where the law ends beside, the other side alone counts.
                match self.force(&moved, committed, side) {
                    Ok(()) if side.f[..n].iter().all(|f| f.is_finite()) => {}
                    Ok(()) | Err(NoAnswer::Refused(_)) => *end = f64::NAN,
                    Err(failed) => return Err(failed),
                }
            }
            let [mut below, mut above] = sides;
            if ends[0].is_nan() || ends[1].is_nan() {
                let gone = if ends[0].is_nan() { 0 } else { 1 };
                if ends[1 - gone].is_nan() {
                    (0..n).for_each(|i| to[i * n + j] = 0.0);
                    continue;
                }
                ends[gone] = middle[j];
                let side = if gone == 0 { &mut below } else { &mut above };
                self.force(at, committed, side)?;
            }
            let between = ends[1] - ends[0];
            (0..n).for_each(|i| to[i * n + j] = (above.f[i] - below.f[i]) / between);
        }
        Ok(())
    }

    /// The work that a step does on the law.
    #[inline(never)]
    fn work(&self, at: &Kinematics<'_>, committed: &[f64], f: &[f64]) -> Result<f64, NoAnswer> {
        if at.d == at.d0 {
            return Ok(0.0);
        }
        let mut start = Scratch::new();
        self.force(&Kinematics::still(at.d0, at.v0), committed, &mut start)?;
        let moved = at.d.iter().zip(at.d0).map(|(d, d0)| d - d0);
        Ok(moved.zip(f.iter().zip(&start.f)).map(|(moved, (f, f0))| 0.5 * (f0 + f) * moved).sum())
    }
}

impl Link for CalledLaw {
    fn coordinates(&self) -> Coordinates {
        Coordinates::Local(self.shape.axes.clone())
    }

    fn history(&self) -> Cow<'static, [Field]> {
        Cow::Borrowed(self.shape.fields)
    }

    fn at_rest(&self, at: &mut [f64]) {
        at.copy_from_slice(&self.rest);
    }

    fn engaged_stiffness(&self, k: &mut [f64]) {
        k.copy_from_slice(&self.engaged);
    }

    fn respond(
        &self,
        at: &Kinematics<'_>,
        committed: &[f64],
        trial: &mut [f64],
        out: &mut Response<'_>,
    ) {
        match self.answer(at, committed, trial, out) {
            Ok(()) => {}
            Err(NoAnswer::Refused(_)) => out.f.fill(f64::NAN),
            Err(NoAnswer::Failed(message)) => failed(message),
        }
    }

    fn refusal(&self, at: &Kinematics<'_>, committed: &[f64]) -> Option<String> {
        match self.force(at, committed, &mut Scratch::new()) {
            Err(NoAnswer::Refused(why)) => Some(why),
            _ => None,
        }
    }

    fn uses_rates(&self) -> bool {
        self.shape.rates
    }

    fn accounts(&self) -> bool {
        self.shape.energy
    }
}

/// Ends the run: the one way out of a law that has gone wrong. It is caught where the law was asked.
fn failed(message: String) -> ! {
    std::panic::resume_unwind(Box::new(LawFailed(message)))
}
