//! What a law over lanes says of its derivatives, against differences of it: those by the deformation and the rate, which are
//! its tangents, and by its parameters, the history and the start of the step.

use crate::shared::parameters::{numbers, read};
use crate::{
    BilinearDamper, Dashpot, FrictionPendulum, ImpactHertz, ImpactKelvin, LeadRubber,
    MaxwellDamper, PMMHinge, RubberIsolator, TensionCompressionFriction, Wen,
};
use trilith_element::lanes::{
    Arithmetic, Directions, Dual, LaneForm, LaneLinks, LaneStep, Portable, Real,
};
use trilith_element::{Described, Energy, Kinematics, Link, Response, Value};

/// Numbers of a question, in the order parameters, history, d, v, d₀, v₀, Δt.
#[derive(Clone)]
struct Question(Vec<f64>);

/// Force, its derivatives by d and ḋ, and the history at the end of the step.
struct Answers<R> {
    f: Vec<R>,
    k: Vec<R>,
    c: Vec<R>,
    trial: Vec<R>,
}

impl Question {
    fn of(form: &LaneForm, at: &Kinematics<'_>, history: &[f64]) -> Self {
        let rates = |x: &[f64]| x.iter().map(|x| if form.rate { *x } else { 0.0 }).collect();
        let [v, v0]: [Vec<f64>; 2] = [rates(at.v), rates(at.v0)];
        Self([&form.parameters, history, at.d, &v, at.d0, &v0, &[at.dt]].concat())
    }

    /// Asks for the answer with each number made into one of the kind that is wanted.
    fn ask<R: Real>(
        &self,
        form: &LaneForm,
        make: impl Fn(usize, f64) -> R,
        call: impl Fn(&mut LaneLinks<'_, R>, &mut [LaneStep<R>]),
    ) -> Answers<R> {
        let (p, h, n) = (form.law.parameters, form.law.history, form.law.coordinates);
        let all: Vec<R> = self.0.iter().enumerate().map(|(i, x)| make(i, *x)).collect();
        let zero = all[0].of(0.0);
        let part = |from: usize, count: usize| &all[from..from + count];
        let mut out = Answers {
            f: vec![zero; n],
            k: vec![zero; n * n],
            c: vec![zero; n * n],
            trial: vec![zero; h],
        };
        let mut links = LaneLinks {
            parameters: part(0, p),
            history: part(p, h),
            d: part(p + h, n),
            v: part(p + h + n, n),
            d0: part(p + h + 2 * n, n),
            v0: part(p + h + 3 * n, n),
            dt: all[p + h + 4 * n],
            trial: &mut out.trial,
            f: &mut out.f,
            k: &mut out.k,
            c: &mut out.c,
        };
        call(&mut links, &mut [LaneStep::elastic(zero)]);
        out
    }

    fn values(&self, form: &LaneForm) -> Vec<f64> {
        let call = |links: &mut LaneLinks<'_, f64>, out: &mut [LaneStep<f64>]| {
            Portable.respond(&form.law, links, out);
        };
        let it = self.ask(form, |_, x| x, call);
        [it.f, it.trial].concat()
    }
}

/// Share of a number by which it is moved for a difference.
const MOVED: f64 = 1e-6;

/// Where a law is smooth between the two sides of a difference, the derivative is what the difference says.
fn check(name: &str, link: &dyn Link, amplitudes: &[f64], frequency: f64) {
    let n = amplitudes.len();
    let form = link.lanes(&vec![true; n]).expect("a form for lanes");
    let mut history = vec![0.0; form.law.history];
    link.at_rest(&mut history);
    let (mut d0, mut v0) = (vec![0.0; n], vec![0.0; n]);
    let (mut compared, mut bent) = (0, 0);
    let steps = 60;
    for step in 1..=steps {
        let dt = 1.7 / frequency / f64::from(steps);
        let t = f64::from(step) * dt;
        let w = |i: usize| std::f64::consts::TAU * frequency * (1.0 + 0.3 * i as f64);
        // The first coordinate is mostly pressed.
        let lean = |i: usize| if i == 0 && n == 3 { -0.6 * amplitudes[0] } else { 0.0 };
        let d: Vec<f64> = (0..n).map(|i| lean(i) + amplitudes[i] * (w(i) * t).sin()).collect();
        let v: Vec<f64> = (0..n).map(|i| amplitudes[i] * w(i) * (w(i) * t).cos()).collect();
        let at = Kinematics::new([&d, &v], [&d0, &v0], dt);
        let question = Question::of(&form, &at, &history);

        let (p, h) = (form.law.parameters, form.law.history);
        let here = question.values(&form);
        for first in (0..question.0.len()).step_by(8) {
            let call = |links: &mut LaneLinks<'_, Directions>, out: &mut [LaneStep<Directions>]| {
                form.law.derivative(links, out);
            };
            let make = |i: usize, x: f64| {
                if (first..first + 8).contains(&i) {
                    Dual::variable(x, i - first)
                } else {
                    Dual::constant(x)
                }
            };
            let duals = question.ask(&form, make, call);
            let all = [&duals.f[..], &duals.trial[..]].concat();
            for i in first..(first + 8).min(question.0.len()) {
                let x = question.0[i];
                if x == 0.0 || !x.is_finite() {
                    continue;
                }
                let to = |by: f64| {
                    let mut moved = question.clone();
                    moved.0[i] = x * (1.0 + by);
                    moved.values(&form)
                };
                let [near, far] = [MOVED, 2.0 * MOVED].map(|h| [to(h), to(-h)]);
                for (j, dual) in all.iter().enumerate() {
                    let slope = |[a, b]: &[Vec<f64>; 2], h: f64| (a[j] - b[j]) / (2.0 * h);
                    let (one, two) = (slope(&near, MOVED), slope(&far, 2.0 * MOVED));
                    let given = dual.by[i - first] * x;
                    let size = here[j].abs().max(given.abs()).max(one.abs());
                    let kink = (near[0][j] - 2.0 * here[j] + near[1][j]).abs() / MOVED;
                    // Nearby the law goes on by another branch.
                    if (one - two).abs() > 1e-5 * size || kink > 1e-5 * size {
                        bent += 1;
                        continue;
                    }
                    compared += 1;
                    assert!(
                        (given - one).abs() <= 1e-5 * size,
                        "{name}: answer {j} by number {i} at {t} s: {given} for {one}"
                    );
                }
            }
            // The tangents are derivatives as well.
            for j in 0..2 * n {
                let i = p + h + j;
                if !(first..first + 8).contains(&i) || (j >= n && !form.rate) {
                    continue;
                }
                let own = if j < n { &duals.k } else { &duals.c };
                let most = own.iter().fold(0.0, |m: f64, x| m.max(x.x.abs()));
                for row in 0..n {
                    let (tangent, by) = (own[row * n + j % n].x, duals.f[row].by[i - first]);
                    let off = (tangent - by).abs();
                    assert!(
                        off <= 1e-7 * most,
                        "{name}: ∂f{row}/∂{j} at {t} s: {by} for {tangent}"
                    );
                }
            }
        }

        let (mut f, mut k, mut c) = (vec![0.0; n], vec![0.0; n * n], vec![0.0; n * n]);
        let (mut energy, mut trial) = (Energy::default(), history.clone());
        let mut out = Response::new(&mut f, &mut k, &mut c, &mut energy);
        link.respond(&at, &history, &mut trial, &mut out);
        (history, d0, v0) = (trial, d, v);
    }
    assert!(compared > 20 * bent, "{name}: {compared} compared, {bent} at a bend");
}

fn law<T: Described>(given: &[(&'static str, f64)], words: &[(&'static str, &str)]) -> T {
    let mut all = numbers(given);
    all.extend(words.iter().map(|(n, w)| match *w {
        "true" => (*n, Value::Flag(true)),
        word => (*n, Value::Text(word.into())),
    }));
    read(&all).expect("parameters of a law")
}

#[test]
fn bearings_of_rubber_know_their_derivatives() {
    let lead = [
        ("kr", 1.5e6),
        ("lead_diameter", 0.16),
        ("lead_height", 0.3),
        ("yield_displacement", 0.01),
        ("shim_thickness", 0.06),
        ("kv", 1.5e9),
    ];
    let hot: LeadRubber = law(&lead, &[("heating", "true")]);
    check("LeadRubber", &hot, &[1e-3, 0.1, 0.07], 0.5);
    let other = [&lead[..], &[("beta", 0.9), ("gamma", 0.1), ("eta", 1.5)]].concat();
    let other: LeadRubber = law(&other, &[("coupling", "Direction")]);
    check("LeadRubber by steps", &other, &[1e-3, 0.1, 0.07], 0.5);
    let rubber: RubberIsolator =
        law(&[("k2", 1e7), ("fy2", 1e5), ("ratio2", 0.1), ("k3", 8e6), ("kv", 2e9)], &[]);
    check("RubberIsolator", &rubber, &[1e-3, 0.1, 0.07], 0.5);
}

#[test]
fn springs_of_wen_know_their_derivatives() {
    for exponent in [1.0, 2.0, 3.5] {
        let given = [("k", 8e7), ("fy", 1.2e5), ("ratio", 0.08), ("exponent", exponent)];
        let wen: Wen = law(&given, &[]);
        check("Wen", &wen, &[0.004], 1.0);
    }
}

#[test]
fn sliding_bearings_know_their_derivatives() {
    let given = [("kn", 2e9), ("ks", 5e7), ("radius", 2.0)];
    let plain: FrictionPendulum = law(&[&given[..], &[("mu", 0.05)]].concat(), &[]);
    check("FrictionPendulum", &plain, &[1e-3, 0.1, 0.07], 0.5);
    let fast = [("mu_slow", 0.03), ("mu_fast", 0.06), ("rate", 20.0)];
    let more = [("damping", 1e5), ("cs", 1e4), ("stop", 0.11), ("stop_stiffness", 1e7)];
    let all = [&given[..], &fast, &more].concat();
    let words = [("friction_model", "Velocity"), ("surface", "Spherical"), ("rise", "true")];
    let rising: FrictionPendulum = law(&all, &words);
    check("FrictionPendulum that rises", &rising, &[1e-3, 0.1, 0.07], 0.5);
    let inclined: FrictionPendulum = law(
        &[&given[..], &fast, &[("area", 0.05), ("delta_mu", 0.02), ("pressure_rate", 2e-8)]]
            .concat(),
        &[
            ("friction_model", "VelocityPressure"),
            ("surface", "Spherical"),
            ("rise", "true"),
            ("inclined", "true"),
        ],
    );
    check("FrictionPendulum on a slope", &inclined, &[1e-3, 0.1, 0.07], 0.5);
    let both: TensionCompressionFriction =
        law(&[("kn", 2e9), ("kt", 1e9), ("ks", 5e7), ("mu", 0.1), ("radius", 2.0)], &[]);
    check("TensionCompressionFriction", &both, &[1e-3, 0.1, 0.07], 0.5);
}

#[test]
fn hinges_know_their_derivatives() {
    let given = [
        ("axial", 1e9),
        ("bending2", 5e7),
        ("bending3", 3e7),
        ("py", 2e6),
        ("mp2", 4e5),
        ("mp3", 3e5),
        ("ratio", 0.05),
    ];
    for [p, m2, m3] in [[1.7, 2.3, 1.4], [2.0; 3], [2.0, 1.5, 2.0]] {
        let exponents = [("exponent_p", p), ("exponent_m2", m2), ("exponent_m3", m3)];
        let hinge: PMMHinge = law(&[&given[..], &exponents].concat(), &[]);
        check("PMMHinge", &hinge, &[2e-3, 0.02, 0.02], 0.5);
    }
}

#[test]
fn dampers_and_stops_know_their_derivatives() {
    let damper = [("k", 3e6), ("c", 2e5)];
    for exponent in [0.35, 1.0, 1.7] {
        let given = [&damper[..], &[("exponent", exponent)]].concat();
        let maxwell: MaxwellDamper = law(&given, &[]);
        check("MaxwellDamper", &maxwell, &[0.05], 0.5);
        let dashpot: Dashpot = law(&[("c", 2e5), ("exponent", exponent)], &[]);
        check("Dashpot", &dashpot, &[0.05], 0.5);
    }
    let oil = [("k", 3e6), ("c", 1e6), ("cy", 1e5), ("fl", 1e5)];
    check("BilinearDamper", &law::<BilinearDamper>(&oil, &[]), &[0.08], 0.5);
    let stop = [("k", 1e7), ("damping", 1e5), ("opening", 0.02)];
    check("ImpactKelvin", &law::<ImpactKelvin>(&stop, &[]), &[0.05], 0.5);
    let hertz = [("k", 1e8), ("restitution", 0.6), ("opening", 0.02)];
    check("ImpactHertz", &law::<ImpactHertz>(&hertz, &[]), &[0.05], 0.5);
}
