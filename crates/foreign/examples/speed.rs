//! What an answer of a law costs: written in Rust, as built-in ones are, and the same in C, called.
//!
//!     cargo run --release -p trilith-foreign --example speed
//!
//! The law is `tests/yielding.c`; a C compiler is needed. Times are nanoseconds for an answer, the least of several rounds.

use std::borrow::Cow;
use std::hint::black_box;
use std::path::Path;
use std::process::Command;
use std::time::Instant;
use trilith_element::{
    Axis, Coordinates, Energy, Field, History, Kinematics, Link, Response, history,
};
use trilith_foreign::Library;
use trilith_model::{Body, Registry, read_text};

history! {
    /// What the law remembers.
    struct Slip {
        /// Plastic deformation.
        slip: "m",
    }
}

/// The law of `tests/yielding.c`.
#[derive(Debug)]
struct Yielding {
    k: f64,
    fy: f64,
    c: f64,
    torn: f64,
}

impl Link for Yielding {
    fn coordinates(&self) -> Coordinates {
        Coordinates::Local(vec![Axis::U1])
    }
    fn history(&self) -> Cow<'static, [Field]> {
        Cow::Borrowed(Slip::FIELDS)
    }
    fn engaged_stiffness(&self, k: &mut [f64]) {
        k[0] = self.k;
    }
    fn respond(&self, at: &Kinematics<'_>, was: &[f64], trial: &mut [f64], out: &mut Response<'_>) {
        let Slip { slip: before } = Slip::load(was);
        let d = at.d[0];
        if d > self.torn {
            out.f[0] = f64::NAN;
            return;
        }
        let elastic = self.k * (d - before);
        let q = elastic.clamp(-self.fy, self.fy);
        let slip = d - q / self.k;
        out.f[0] = q + self.c * at.v[0];
        out.k[0] = if q == elastic { self.k } else { 0.0 };
        out.c[0] = self.c;
        out.energy.stored = q * q / (2.0 * self.k);
        out.energy.hysteretic = q * (slip - before);
        out.energy.viscous = at.viscous_work(0, self.c * at.v0[0], self.c * at.v[0]);
        Slip { slip }.store(trial);
    }
}

const ANSWERS: usize = 20_000;
const ROUNDS: usize = 500;

/// Nanoseconds for an answer.
fn time(law: &dyn Link) -> f64 {
    let mut least = f64::INFINITY;
    for _ in 0..ROUNDS {
        let (mut history, mut trial) = ([0.0], [0.0]);
        let (mut f, mut k, mut c, mut energy) = ([0.0], [0.0], [0.0], Energy::default());
        let start = Instant::now();
        for i in 0..ANSWERS {
            let d = [0.02 * f64::from((i % 400) as u32) / 200.0 - 0.02];
            let at = Kinematics::new([&d, &[0.1]], [&[0.0], &[0.1]], 0.01);
            let out = &mut Response::new(&mut f, &mut k, &mut c, &mut energy);
            law.respond(black_box(&at), &history, &mut trial, out);
            history = black_box(trial);
        }
        least = least.min(start.elapsed().as_secs_f64() / ANSWERS as f64);
    }
    1e9 * least
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let here = Path::new(env!("CARGO_MANIFEST_DIR"));
    let library = std::env::temp_dir().join(format!("libyielding{}.so", std::process::id()));
    let done = Command::new("cc")
        .args(["-shared", "-fPIC", "-O2", "-I"])
        .arg(here.join("include"))
        .arg(here.join("tests/yielding.c"))
        .arg("-o")
        .arg(&library)
        .arg("-lm")
        .status()?;
    assert!(done.success(), "cc");
    let mut registry = Registry::new();
    for kind in Library::open(&library)? {
        kind.register(&mut registry);
    }
    std::fs::remove_file(&library)?;
    let text = r#"(nodes: { "a": (0, 0, 0) }, cases: { "rest": Static(loads: []) },
        elements: { "link": Yielding(node: "a", k: "100 kN/m", fy: "0.5 kN", c: "200 N*s/m") })"#;
    let mut model = read_text(text, "speed.ron", &registry, &[])
        .map_err(|all| all.iter().map(ToString::to_string).collect::<String>())?;
    let Some(Body::Link(called, _)) = model.elements.pop().map(|e| e.body) else {
        return Err("no link".into());
    };
    let own = time(&Yielding { k: 1e5, fy: 500.0, c: 200.0, torn: 1.0 });
    let c = time(&*called);
    println!("in Rust {own:.1} ns, in C {c:.1} ns: {:.2} times as long", c / own);
    Ok(())
}
