//! Many structures side by side, and what came of them.

use super::generate::generate;
use super::judge::{
    NO_ERROR, Pair, Skip, Verdict, WORK, class, judge, judge_and_compare, reference,
    reference_of_a_part,
};
use super::shrink::shrink;
use super::spec::Spec;
use super::text::text;
use std::collections::BTreeMap;
use std::path::Path;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::time::{Duration, Instant};
use trilith::SolverKind;

/// What to do.
#[derive(Clone, Debug)]
pub struct Campaign {
    /// First seed.
    pub seed: u64,
    /// Structures.
    pub count: usize,
    /// Solvers.
    pub solvers: Vec<SolverKind>,
    /// Multiplications that the oracle may make for a pass over a structure; where these are too few, the first part
    /// of its time is compared.
    pub work: f64,
    /// No structure is begun after this.
    pub budget: Duration,
    /// Every run is said on the error output as it ends.
    pub aloud: bool,
}

/// What came of one structure under one solver.
#[derive(Clone, Debug)]
pub struct Found {
    /// Seed.
    pub seed: u64,
    /// Family of the structure.
    pub family: &'static str,
    /// Duration and output step of what was compared, s.
    pub time: [f64; 2],
    /// Solver.
    pub solver: SolverKind,
    /// Verdict.
    pub verdict: Verdict,
    /// Errors of the outputs and what the run says of them.
    pub pairs: Vec<Pair>,
}

/// What came of all.
#[derive(Clone, Debug, Default)]
pub struct Result {
    /// Structures that were begun.
    pub structures: usize,
    /// Runs that were judged.
    pub runs: Vec<Found>,
    /// Structures without a comparison.
    pub skipped: Vec<(u64, Skip)>,
    /// CPU-like time of the oracle and of the program, s.
    pub seconds: [f64; 2],
}

impl Campaign {
    /// Runs it on all processors.
    #[must_use]
    pub fn run(&self) -> Result {
        let next = AtomicUsize::new(0);
        let begun = Instant::now();
        let workers = std::thread::available_parallelism().map_or(1, std::num::NonZero::get);
        let work = || {
            let mut own = Result::default();
            loop {
                let i = next.fetch_add(1, Ordering::Relaxed);
                if i >= self.count || begun.elapsed() > self.budget {
                    return own;
                }
                self.one(self.seed + i as u64, &mut own);
            }
        };
        let mut all = Result::default();
        std::thread::scope(|scope| {
            let threads: Vec<_> = (0..workers).map(|_| scope.spawn(work)).collect();
            for thread in threads {
                let own = thread.join().unwrap_or_default();
                all.structures += own.structures;
                all.runs.extend(own.runs);
                all.skipped.extend(own.skipped);
                all.seconds = [0, 1].map(|i| all.seconds[i] + own.seconds[i]);
            }
        });
        let place = |solver| SolverKind::ALL.iter().position(|other| *other == solver);
        all.runs.sort_by_key(|f| (f.seed, place(f.solver)));
        all.skipped.sort_by_key(|s| s.0);
        all
    }

    fn one(&self, seed: u64, own: &mut Result) {
        own.structures += 1;
        let mut spec = generate(seed);
        let clock = Instant::now();
        let truth = reference_of_a_part(&mut spec, self.work);
        let took = clock.elapsed().as_secs_f64();
        own.seconds[0] += took;
        if self.aloud {
            eprintln!("{seed} {} oracle {took:.2} s", spec.family);
        }
        let truth = match truth {
            Ok(truth) => truth,
            Err(skip) => return own.skipped.push((seed, skip)),
        };
        let clock = Instant::now();
        for solver in &self.solvers {
            let before = clock.elapsed().as_secs_f64();
            let (verdict, pairs) = judge_and_compare(&spec, &truth, *solver);
            if self.aloud {
                let took = clock.elapsed().as_secs_f64() - before;
                let (name, said) = (solver.name(), say(&spec, &verdict));
                eprintln!("{seed} {} {name} {took:.2} s: {said}", spec.family);
            }
            let (family, time) = (spec.family, [spec.duration, spec.dt]);
            own.runs.push(Found { seed, family, time, solver: *solver, verdict, pairs });
        }
        own.seconds[1] += clock.elapsed().as_secs_f64();
    }
}

impl Result {
    /// Runs that are wrong and say nothing.
    #[must_use]
    pub fn failures(&self) -> Vec<&Found> {
        let bad = |f: &&Found| matches!(f.verdict, Verdict::Failed(..) | Verdict::Panicked(_));
        self.runs.iter().filter(bad).collect()
    }

    /// Structures for which the oracle had no answer.
    #[must_use]
    pub fn without_oracle(&self) -> usize {
        self.skipped.iter().filter(|(_, s)| !matches!(s, Skip::IllPosed)).count()
    }

    /// Lines that count.
    #[must_use]
    pub fn summary(&self) -> String {
        let mut s = String::new();
        let mut line = |x: String| {
            s.push_str(&x);
            s.push('\n');
        };
        let mut messages: BTreeMap<(SolverKindName, &str, String), Vec<u64>> = BTreeMap::new();
        let mut counts: BTreeMap<SolverKindName, [usize; 7]> = BTreeMap::new();
        for f in &self.runs {
            let name = f.solver.name();
            let row = counts.entry(name).or_default();
            let (at, what, message) = match &f.verdict {
                Verdict::Passed(_) => (0, "", String::new()),
                Verdict::Refused(m) => (1, "refused", class(m)),
                Verdict::Warned(_, m) => (2, "warned", class(m)),
                Verdict::Failed(..) => (3, "failed", f.family.to_owned()),
                Verdict::Panicked(m) => (4, "panic", class(m)),
                Verdict::Small(..) => (5, "small", f.family.to_owned()),
                Verdict::Told(_) => (6, "told", f.family.to_owned()),
            };
            row[at] += 1;
            if !what.is_empty() {
                messages.entry((name, what, message)).or_default().push(f.seed);
            }
        }
        for ((solver, what, message), seeds) in &messages {
            let some: Vec<String> = seeds.iter().take(6).map(u64::to_string).collect();
            line(format!(
                "{solver:12} {what:8} {:5}  {message}  [{}]",
                seeds.len(),
                some.join(" ")
            ));
        }
        let mut reasons: BTreeMap<String, Vec<u64>> = BTreeMap::new();
        for (seed, skip) in &self.skipped {
            let reason = match skip {
                Skip::NoOracle(m) => format!("no oracle: {}", class(m)),
                Skip::TooMuchWork(_) => "too much work".into(),
                Skip::IllPosed => "ill-posed".into(),
            };
            reasons.entry(reason).or_default().push(*seed);
        }
        for (reason, seeds) in &reasons {
            let some: Vec<String> = seeds.iter().take(6).map(u64::to_string).collect();
            line(format!(
                "{:12} {:8} {:5}  {reason}  [{}]",
                "oracle",
                "skipped",
                seeds.len(),
                some.join(" ")
            ));
        }
        line(format!(
            "{} structures, {} not compared ({} without an oracle); oracle {:.1} s, program {:.1} s",
            self.structures,
            self.skipped.len(),
            self.without_oracle(),
            self.seconds[0],
            self.seconds[1]
        ));
        for (solver, [passed, refused, warned, failed, panicked, small, told]) in counts {
            line(format!(
                "{solver:12} {passed} passed, {refused} refused, {told} off as told, {warned} off with a warning, {small} off in what is small, {failed} failed, {panicked} broke off"
            ));
        }
        s
    }

    /// How often the estimates of the runs hold, and how far they are from the errors.
    #[must_use]
    pub fn certificates(&self) -> String {
        let mut s = String::new();
        for solver in SolverKind::ALL {
            let runs = self.runs.iter().filter(|f| f.solver == solver);
            let pairs: Vec<&Pair> =
                runs.flat_map(|f| &f.pairs).filter(|p| !p.estimate().is_nan()).collect();
            if pairs.is_empty() {
                continue;
            }
            let held = pairs.iter().filter(|p| p.holds()).count();
            let mut ratios: Vec<f64> =
                pairs.iter().map(|p| p.estimate().max(NO_ERROR) / p.off.max(NO_ERROR)).collect();
            ratios.sort_by(f64::total_cmp);
            s.push_str(&format!(
                "{:12} {} estimates, {:.2} % hold; estimate over error: median {:.1}\n",
                solver.name(),
                pairs.len(),
                100.0 * held as f64 / pairs.len() as f64,
                ratios[ratios.len() / 2]
            ));
        }
        s
    }

    /// Writes the model of every failure, and a smaller one where `trials` is not 0.
    ///
    /// # Errors
    /// What the file system says.
    pub fn write(&self, folder: &Path, trials: usize, limit: usize) -> std::io::Result<()> {
        std::fs::create_dir_all(folder)?;
        for f in self.failures().into_iter().take(limit) {
            let mut spec = generate(f.seed);
            [spec.duration, spec.dt] = f.time;
            let name = format!("{}-{}", f.seed, f.solver.name());
            let head = format!(
                "// seed {}, {}, {}: {}\n",
                f.seed,
                f.family,
                f.solver.name(),
                say(&spec, &f.verdict)
            );
            std::fs::write(folder.join(format!("{name}.ron")), head.clone() + &text(&spec))?;
            if trials > 0 {
                let small = shrink(&spec, f.solver, trials);
                let said = match reference(&small, WORK) {
                    Ok(truth) => say(&small, &judge(&small, &truth, f.solver)),
                    Err(_) => "?".into(),
                };
                let head = format!("{head}// shrunk: {said}\n");
                std::fs::write(folder.join(format!("{name}-small.ron")), head + &text(&small))?;
            }
        }
        Ok(())
    }
}

type SolverKindName = &'static str;

/// The verdict in words.
#[must_use]
pub fn say(spec: &Spec, verdict: &Verdict) -> String {
    match verdict {
        Verdict::Passed(e) => format!("passed, off by {:.3} %", 100.0 * e),
        Verdict::Refused(m) => format!("refused: {m}"),
        Verdict::Warned(e, m) => format!("off by {:.3} %, warned: {m}", 100.0 * e),
        Verdict::Told(e) => format!("off by {:.3} %, as it says", 100.0 * e),
        Verdict::Failed(o, e, t) => {
            let what = spec.outputs.get(*o).map_or("ended early".into(), |o| format!("{o:?}"));
            format!("o{o} {what} is off by {:.3} % of its size at t = {t:.6} s", 100.0 * e)
        }
        Verdict::Small(o, e, t) => {
            let what = spec.outputs.get(*o).map_or(String::new(), |o| format!("{o:?}"));
            format!("o{o} {what}, small, is off by {:.3} % of its size at t = {t:.6} s", 100.0 * e)
        }
        Verdict::Panicked(m) => format!("broke off: {m}"),
    }
}
