//! `cargo bench -p trilith-bench`: what a law answers in, small systems, projections, and a step of the smallest frame.

use criterion::{Criterion, criterion_group, criterion_main};
use std::hint::black_box;
use std::time::{Duration, Instant};
use trilith::element::{Energy, Kinematics, Link, Response};
use trilith::model::Body;
use trilith::{Analysis, RunOptions, SolverKind};
use trilith_bench::{Gauge, Subject, Task, find};
use trilith_linalg::threads::alone;
use trilith_linalg::{Columns, Dense, DenseLu, solve_few};

/// A link led around a circle that slides all the time.
fn law(c: &mut Criterion, name: &str, link: &dyn Link) {
    let n = link.coordinates().len();
    let mut committed = vec![0.0; link.history().len()];
    let mut trial = committed.clone();
    let (mut f, mut k, mut damping) = (vec![0.0; n], vec![0.0; n * n], vec![0.0; n * n]);
    let at = |i: usize| {
        let mut d = vec![0.0; n];
        let phase = 0.01 * i as f64;
        // Pressed together, where there is a normal direction.
        d[0] = -1e-3;
        (d[n - 2], d[n - 1]) = (0.05 * phase.cos(), 0.05 * phase.sin());
        d
    };
    let path: Vec<Vec<f64>> = (0..629).map(at).collect();
    let v = vec![0.0; n];
    let mut i = 0;
    c.bench_function(name, |b| {
        b.iter(|| {
            let (d0, d) = (&path[i % 629], &path[(i + 1) % 629]);
            i += 1;
            k.fill(0.0);
            damping.fill(0.0);
            let mut energy = Energy::default();
            let mut out = Response::new(&mut f, &mut k, &mut damping, &mut energy);
            let at = Kinematics::new([black_box(d), &v], [d0, &v], 1e-3);
            link.respond(&at, &committed, &mut trial, &mut out);
            std::mem::swap(&mut committed, &mut trial);
            energy.hysteretic
        });
    });
}

const LINKS: &str = r#"(
    nodes: { "a": (0, 0, 0) },
    elements: {
        "ElastomericBearing, sliding": ElastomericBearing(node: "a", k: "10 MN/m", fy: "100 kN", ratio: 0.1),
        "NLink, sliding": NLink(node: "a", kn: "5e8 N/m", ks: "5e8 N/m", mu: 0.5, damping: "1e6 N*s/m"),
    },
    cases: { "rest": Static(loads: [Gravity]) },
)"#;

fn laws(c: &mut Criterion) {
    let model = trilith::read_text(LINKS, "links.ron", &trilith::registry(), &[]);
    let model = model.unwrap_or_else(|e| panic!("{e:?}"));
    for e in &model.elements {
        if let Body::Link(link, _) = &e.body {
            law(c, &e.name, link.as_ref());
        }
    }
}

/// Time of `steps` steps: the marches of whole runs are put together.
fn step(c: &mut Criterion, name: &str, solver: SolverKind) {
    const STEPS: usize = 1600;
    let Some(size) = find("P1e2") else { return };
    let task = Task { solver, vectors: None, steps: STEPS, substeps: 1, offset: 4.0 };
    let Ok(subject) = Subject::new(&size.frame().to_ron(), task) else { return };
    let Ok(analysis) = Analysis::new(&subject.model) else { return };
    let march = || {
        let (mut made, mut start, mut spent) = (0, Instant::now(), Duration::ZERO);
        let mut progress = |_share: f64| {
            made += 1;
            match made {
                1 => start = Instant::now(),
                STEPS => spent = start.elapsed(),
                _ => {}
            }
        };
        let options = RunOptions {
            case: subject.case,
            solver: Some(solver),
            progress: Some(&mut progress),
            ..RunOptions::default()
        };
        let mut gauge = Gauge::default();
        let run =
            trilith::solvers::run(&subject.model, analysis.system(), options, &mut [&mut gauge]);
        black_box(run.is_ok());
        spent.as_secs_f64() / (STEPS - 1) as f64
    };
    c.bench_function(name, |b| {
        b.iter_custom(|steps| {
            let runs = steps.div_ceil(STEPS as u64).max(1);
            let mean = (0..runs).map(|_| march()).sum::<f64>() / runs as f64;
            Duration::from_secs_f64(mean * steps as f64)
        });
    });
}

fn steps(c: &mut Criterion) {
    step(c, "FNA step of P1e2", SolverKind::Fna);
    step(c, "HHT step of P1e2", SolverKind::Hht);
}

/// A system of few unknowns, eliminated at once and by the library.
fn systems(c: &mut Criterion) {
    for n in [3, 6, 16] {
        let mut seed = 1_u64;
        let mut next = || {
            seed = seed
                .wrapping_mul(6_364_136_223_846_793_005)
                .wrapping_add(1_442_695_040_888_963_407);
            (seed >> 11) as f64 / (1_u64 << 52) as f64 - 1.0
        };
        let mut numbers = || Dense::from_columns(n, n, (0..n * n).map(|_| next()).collect());
        let (a, b) = (numbers(), numbers());
        c.bench_function(&format!("{n} unknowns, solve_few"), |bench| {
            bench.iter(|| {
                let (mut a, mut b) = (black_box(&a).clone(), b.clone());
                solve_few(&mut a, &mut b);
                b
            });
        });
        c.bench_function(&format!("{n} unknowns, faer"), |bench| {
            bench.iter(|| {
                let mut b = b.clone();
                DenseLu::new(black_box(&a)).solve_columns(&mut b);
                b
            });
        });
    }
}

/// What vectors have in common with a hundred columns of 40 000 rows, taken out of them and by products of matrices.
fn projections(c: &mut Criterion) {
    let (rows, count) = (40_000, 100);
    let number = |i: usize| ((i * 7919) % 1009) as f64 / 1009.0 - 0.5;
    let values: Vec<f64> = (0..rows * count).map(|i| 1e-3 * number(i)).collect();
    let mut columns = Columns::with_capacity(rows, count);
    values.chunks(rows).for_each(|column| columns.push(column));
    let whole = Dense::from_columns(rows, count, values);
    for vectors in [1, 4, 16] {
        let y: Vec<Vec<f64>> =
            (0..vectors).map(|v| (0..rows).map(|i| number(3 * i + v)).collect()).collect();
        c.bench_function(&format!("projection of {vectors}, take_out"), |bench| {
            let mut x = y.clone();
            bench.iter(|| alone(|| columns.take_out(0, black_box(&mut x), &y)));
        });
        let all = Dense::from_columns(rows, vectors, y.concat());
        c.bench_function(&format!("projection of {vectors}, faer"), |bench| {
            bench.iter(|| whole.times(&whole.transpose_times(black_box(&all))));
        });
    }
}

criterion_group!(all, laws, systems, projections, steps);
criterion_main!(all);
