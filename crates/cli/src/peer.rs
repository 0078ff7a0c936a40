//! `trilith compare --peer`: a case here and in another program.

use crate::args::CompareArguments;
use crate::compare::{NOTHING, difference};
use crate::export::{scripted, warned};
use crate::interrupt::{Ear, INTERRUPTED};
use crate::text::{number, percent, row, table};
use crate::{Answer, Failure, diagnostics, output, solver};
use serde_json::{Value, json};
use std::f64::consts::TAU;
use std::time::Duration;
use trilith::compare::{Compared, Comparison, Variant};
use trilith::model::visible_line;
use trilith::results::Peak;
use trilith::solvers::LinkStiffness;
use trilith::{Analysis, Model, SolverKind};
use trilith_exchange::opensees::export::Export;
use trilith_exchange::opensees::peer::{Peer, PeerError, PeerRun, STEM};

/// What the other program is called in tables.
const NAME: &str = "OpenSees";
/// Its steps in an output step, where nothing else is said.
const SUBSTEPS: usize = 10;

pub(crate) fn compare(
    model: &mut Model,
    case: usize,
    args: &CompareArguments,
) -> Result<Answer, Failure> {
    // What may be missing is looked for before anything runs.
    let made = scripted(model, case, &args.peer.script, SUBSTEPS, STEM)?;
    let limit = Duration::try_from_secs_f64(args.peer.time_limit).unwrap_or(Duration::MAX);
    let peer = Peer::find(args.peer.python.as_deref(), limit).map_err(|e| {
        let help = "`pip install openseespy` gives it to an interpreter, which `--python FILE` or TRILITH_OPENSEES names";
        Failure::input(&e.to_string(), Some(help))
    })?;
    let solvers = match &args.solvers[..] {
        [] => vec![SolverKind::Hht],
        given => given.iter().map(|n| solver(model, case, n)).collect::<Result<_, _>>()?,
    };
    let variants: Vec<Variant> =
        solvers.into_iter().map(|s| Variant { dt: args.dt, ..Variant::new(s) }).collect();
    let ear = Ear::open("the comparison ends");
    let result = Comparison::new(model, case, |_| {}).until(ear.flag()).run(&variants, false);
    let ours = result.map_err(|e| Failure::of(&e, model))?;
    let interrupted = || Ok(Answer { text: String::new(), status: INTERRUPTED });
    if ours.len() < variants.len() {
        return interrupted();
    }
    let theirs = match peer.run(&made.script, Some(ear.flag())) {
        Ok(theirs) => theirs,
        Err(PeerError::Interrupted) => return interrupted(),
        Err(e) => {
            let text = diagnostics::plain(&e.to_string(), help(&e));
            return Err(Failure { text, status: 1 });
        }
    };
    let mut status = 0;
    for c in &ours {
        if !c.outcome.good {
            let message = format!("{}: {}", c.variant, c.outcome.summary.message);
            output::tell(&diagnostics::plain(&message, None));
            status = 1;
        }
    }
    warned(&made);
    let periods = periods(model, case, theirs.periods.len());
    let both = Both { ours: &ours, theirs: &theirs, periods };
    let text = if args.peer.json {
        let text = serde_json::to_string_pretty(&both.json(model, case, &made));
        text.map_err(|e| Failure::input(&e.to_string(), None))? + "\n"
    } else {
        let [title, name] = [&model.title, &model.cases[case].name].map(|t| visible_line(t));
        format!("model  {title}\ncase   {name}\n{}", both.text())
    };
    Ok(Answer { text, status })
}

fn help(error: &PeerError) -> Option<&'static str> {
    match error {
        PeerError::Failed { .. } => Some(
            "`--substeps N` takes shorter steps there; `trilith export` writes the script, to be looked at",
        ),
        PeerError::TooLong(_) => {
            Some("`--time-limit S` gives it more time, `--substeps N` fewer steps")
        }
        _ => None,
    }
}

/// Periods with links by their tangents at the end of the case before, as the script finds them.
fn periods(model: &Model, case: usize, count: usize) -> Vec<f64> {
    let found = || {
        let analysis = Analysis::new(model).ok()?;
        let linear = analysis.linearised(&LinkStiffness::Tangent, model.cases[case].after).ok()?;
        let modes = linear.modes(count.max(1)).ok()?;
        let moving = modes.omega2.iter().filter(|w| **w > 0.0);
        Some(moving.map(|w| TAU / w.sqrt()).collect::<Vec<_>>())
    };
    let mut all = found().unwrap_or_default();
    all.truncate(count);
    all
}

struct Both<'r> {
    ours: &'r [Compared],
    theirs: &'r PeerRun,
    periods: Vec<f64>,
}

impl Both<'_> {
    fn at(&self, name: &str) -> Option<usize> {
        self.theirs.names.iter().position(|n| n == name)
    }

    fn peak(&self, name: &str) -> Option<Peak> {
        let [max, t_max, min, t_min, last] = self.theirs.peaks[self.at(name)?];
        Some(Peak { max, t_max, min, t_min, last })
    }

    /// Root mean square of the difference from the first run here, as share of that run's; none without both.
    fn rms(&self, index: usize, name: &str) -> Option<f64> {
        let (a, b) =
            (self.ours[0].outcome.histories.get(index)?, &self.theirs.histories[self.at(name)?]);
        if a.len() != b.len() {
            return None;
        }
        let squares = a.iter().zip(b).map(|(a, b)| (a - b).powi(2)).sum::<f64>();
        let size = a.iter().map(|a| a * a).sum::<f64>();
        (size > NOTHING * NOTHING * a.len() as f64).then(|| (squares / size).sqrt())
    }

    fn text(&self) -> String {
        let first = &self.ours[0];
        let mut head = row(["output", "unit"]);
        for (i, c) in self.ours.iter().enumerate() {
            head.push(format!("{} max", c.variant));
            head.extend((i > 0).then(|| "diff".to_owned()));
            head.push(format!("{} min", c.variant));
            head.extend((i > 0).then(|| "diff".to_owned()));
        }
        head.extend([
            format!("{NAME} max"),
            "diff".into(),
            format!("{NAME} min"),
            "diff".into(),
            "rms of difference".into(),
        ]);
        let mut rows = vec![head];
        let of_first = &first.outcome.summary.outputs;
        for (index, (name, own)) in of_first.0.iter().enumerate() {
            let mut cells = row([name, &own.unit]);
            let theirs = self.peak(name);
            let all =
                self.ours.iter().map(|c| c.outcome.summary.outputs.get(name).and_then(|o| o.peak));
            for (i, peak) in all.chain([theirs]).enumerate() {
                for value in [|p: &Peak| p.max, |p: &Peak| p.min] {
                    cells.push(peak.as_ref().map_or("–".into(), |p| number(value(p))));
                    if i > 0 {
                        cells.push(difference(own.peak.as_ref(), peak.as_ref(), value));
                    }
                }
            }
            cells.push(self.rms(index, name).map_or("–".into(), percent));
            rows.push(cells);
        }
        let mut out = format!(
            "\npeaks; differences relative to {}\n{}",
            first.variant,
            table(&rows, &[0, 1])
        );
        if !self.theirs.periods.is_empty() {
            let mut rows = vec![row(["mode", "period [s]", NAME, "diff"])];
            for (i, theirs) in self.theirs.periods.iter().enumerate() {
                let ours = self.periods.get(i);
                let apart = ours.map_or("–".into(), |o| format!("{:+.1e}", theirs / o - 1.0));
                let ours = ours.map_or("–".into(), |o| crate::text::significant(*o, 7));
                let theirs = crate::text::significant(*theirs, 7);
                rows.push(row([&(i + 1).to_string(), &ours, &theirs, &apart]));
            }
            out += &format!("\nperiods, links by their tangents\n{}", table(&rows, &[]));
        }
        out += "\n";
        for c in self.ours {
            let work = crate::report::work(&c.outcome.summary.work);
            out += &format!("{} ({}): {work}\n", c.variant, c.outcome.summary.status);
        }
        out += &format!(
            "{NAME}: {} s with its start\n",
            crate::text::significant(self.theirs.seconds, 3)
        );
        out
    }

    fn json(&self, model: &Model, case: usize, made: &Export) -> Value {
        let extremes = |p: Option<Peak>| {
            p.map(|p| json!({"max": p.max, "t_max": p.t_max, "min": p.min, "t_min": p.t_min, "final": p.last}))
        };
        let mut outputs = serde_json::Map::new();
        for (index, (name, own)) in self.ours[0].outcome.summary.outputs.0.iter().enumerate() {
            let by: serde_json::Map<String, Value> = self
                .ours
                .iter()
                .map(|c| {
                    let peak = c.outcome.summary.outputs.get(name).and_then(|o| o.peak);
                    (c.variant.to_string(), json!(extremes(peak)))
                })
                .collect();
            let theirs = self.peak(name);
            let share = |value: fn(&Peak) -> f64| {
                let (a, b) = (own.peak.as_ref()?, theirs.as_ref()?);
                (a.magnitude() > NOTHING).then(|| (value(b) - value(a)) / a.magnitude())
            };
            outputs.insert(
                name.clone(),
                json!({
                    "unit": own.unit, "trilith": by, "opensees": extremes(theirs),
                    "difference": {"max": share(|p| p.max), "min": share(|p| p.min), "rms": self.rms(index, name)},
                }),
            );
        }
        let lines = |all: &[trilith_exchange::opensees::export::Loss]| {
            all.iter().map(trilith_exchange::opensees::export::Loss::line).collect::<Vec<_>>()
        };
        json!({
            "model": model.title, "case": model.cases[case].name, "peer": "opensees",
            "outputs": outputs,
            "periods": {"trilith": self.periods, "opensees": self.theirs.periods},
            "left_out": lines(&made.losses.left_out), "near": lines(&made.losses.near), "notes": lines(&made.losses.notes),
            "seconds": self.theirs.seconds,
        })
    }
}
