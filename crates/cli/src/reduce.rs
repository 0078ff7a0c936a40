//! `trilith reduce`: a superelement in place of a part of a model.

use crate::args::{ReduceArguments, Written};
use crate::text::{number, percent, table};
use crate::{Answer, Failure, diagnostics, names, output, place, read};
use trilith::element::Dof;
use trilith::model::visible_line;
use trilith::reduce::{FILES, FixedModes, MatrixForm, ReduceError, Reduced, Request};
use trilith::results::Writer;
use trilith::{Analysis, Model, Registry};

/// Nodes that are listed by name.
const LISTED: usize = 12;
/// Modes that are shown one by one.
const SHOWN: usize = 12;

pub(crate) fn reduce(registry: &Registry, args: &ReduceArguments) -> Result<Answer, Failure> {
    let model = read(registry, &args.model)?;
    let analysis = Analysis::new(&model).map_err(|e| Failure::of(&e, &model))?;
    let reduced = analysis.reduce(&request(args)).map_err(|e| failure(&e, &model))?;
    let form = match args.format {
        Written::Npz => MatrixForm::Npz,
        Written::Mtx => MatrixForm::Market,
        Written::Dmig => MatrixForm::Dmig,
        Written::Op4 => MatrixForm::Op4,
    };
    let files = reduced.files(form).map_err(|e| Failure::unwritable(&args.out, &e))?;
    let writer = Writer {
        name: "reduce",
        own: &FILES,
        writes: files.iter().map(|(name, _)| name.clone()).collect(),
        inputs: model.inputs(),
    };
    let written = place::write(place::open(&args.out, writer)?, &files)?;
    // What is told below is told of the files.
    let path = args.out.join(FILES[0]);
    let small = trilith::read(&path, registry, &[]).map_err(|e| Failure::diagnostics(&e))?;
    let of_small = Analysis::new(&small).map_err(|e| Failure::of(&e, &small))?;
    for doubt in &of_small.system().inner.doubts {
        output::tell(&diagnostics::warning(doubt));
    }
    let mut text = sheet(&reduced, &model);
    text += &modes(&reduced);
    text += &masses(&model, &analysis, &small, &of_small);
    if args.compare > 0 {
        let [whole, few] = [
            analysis.frequencies(args.compare).map_err(|e| Failure::of(&e, &model))?,
            of_small.frequencies(args.compare).map_err(|e| Failure::of(&e, &small))?,
        ];
        text += &frequencies(&whole, &few);
    }
    text += "\n";
    for path in written {
        text += &format!("{path}\n");
    }
    Ok(text.into())
}

fn request(args: &ReduceArguments) -> Request {
    let modes = match (args.modes, args.up_to) {
        (_, Some(frequency)) => FixedModes::UpTo(frequency),
        (modes, None) => modes.unwrap_or(FixedModes::All),
    };
    Request {
        keep: (!args.keep.is_empty()).then(|| names::flat(&args.keep)),
        recover: names::flat(&args.recover),
        recover_all: args.recover_all,
        ..Request::new(names::flat(&args.part), modes)
    }
}

fn failure(error: &ReduceError, model: &Model) -> Failure {
    match error {
        ReduceError::Model(e) => Failure::of(e, model),
        // Where the model has the offender.
        ReduceError::NotLinear { element, .. }
        | ReduceError::OnGround { element }
        | ReduceError::Inertance { element }
        | ReduceError::AxialForce { element } => {
            let found = model.elements.iter().find(|e| e.name == *element);
            let text = match found {
                Some(e) => diagnostics::at(&error.to_string(), &model.places.find(&e.span)),
                None => diagnostics::plain(&error.to_string(), None),
            };
            Failure { text, status: 2 }
        }
        _ => Failure::input(&error.to_string(), error.help()),
    }
}

/// What became of what.
fn sheet(reduced: &Reduced<'_>, model: &Model) -> String {
    let count = |n: usize, one: &str| format!("{n} {one}{}", if n == 1 { "" } else { "s" });
    let range = match (reduced.frequencies.first(), reduced.frequencies.last()) {
        (Some(first), Some(last)) => {
            format!(", {} to {} Hz with the nodes held", number(*first), number(*last))
        }
        _ => String::new(),
    };
    let listed = |names: &[String]| {
        let mut all: Vec<String> =
            names.iter().take(LISTED).map(|n| visible_line(n).into()).collect();
        if names.len() > LISTED {
            all.push(format!("… ({} in all)", names.len()));
        }
        all.join(", ")
    };
    let mut text = format!(
        "{}\n\nreduced    {} with {} to {}: {} of {} that are kept, and {} of {}{range}\nkept       {}\n",
        visible_line(&model.title),
        count(reduced.elements, "element"),
        count(reduced.equations, "direction"),
        count(reduced.rows + reduced.frequencies.len(), "row"),
        reduced.rows,
        count(reduced.kept.len(), "node"),
        count(reduced.frequencies.len(), "mode"),
        reduced.available,
        listed(&reduced.kept),
    );
    if !reduced.recovered.is_empty() {
        text += &format!("follow     {}\n", listed(&reduced.recovered));
    }
    text
}

/// The fixed-interface modes, and how much of the mass they hold.
fn modes(reduced: &Reduced<'_>) -> String {
    let share = |m: f64, axis: usize| match reduced.inner_mass[axis] {
        all if all > 0.0 => percent(m / all),
        _ => "–".into(),
    };
    let mut rows = vec![["mode", "Hz", "mass X", "mass Y", "mass Z"].map(str::to_owned).to_vec()];
    let mut sums = [0.0; 3];
    for (i, (f, mass)) in reduced.frequencies.iter().zip(&reduced.effective_mass).enumerate() {
        sums.iter_mut().zip(mass).for_each(|(sum, m)| *sum += m);
        if i < SHOWN {
            let shares = (0..3).map(|axis| share(mass[axis], axis));
            let cells = [(i + 1).to_string(), number(*f)];
            rows.push(cells.into_iter().chain(shares).collect());
        }
    }
    let told = |name: &str, of: [f64; 3]| {
        let shares = (0..3).map(|axis| share(of[axis], axis));
        [name.to_owned(), String::new()].into_iter().chain(shares).collect::<Vec<_>>()
    };
    rows.push(told("all", sums));
    rows.push(told("lost", [0, 1, 2].map(|axis| (reduced.inner_mass[axis] - sums[axis]).max(0.0))));
    format!("\nmodes with the nodes held, and their effective mass\n{}", table(&rows, &[0]))
}

/// What rigid motions feel of both models.
fn masses(
    model: &Model,
    analysis: &Analysis<&Model>,
    small: &Model,
    of_small: &Analysis<&Model>,
) -> String {
    let [whole, few] = [analysis.system().mass_sum(model), of_small.system().mass_sum(small)];
    let mut text = String::from("\n");
    let told = |x: f64| if x == 0.0 { "0".into() } else { format!("{x:.1e}") };
    for (axis, name) in ["X", "Y", "Z"].into_iter().enumerate() {
        // What moves out of the plane is held, and the matrices do not have it.
        let within = model.plane.is_none_or(|plane| plane.dofs().contains(&Dof::ALL[axis]));
        if whole.mass[axis] > 0.0 && within {
            text += &format!(
                "mass       {} kg along {name}, off by {}\n",
                number(whole.mass[axis]),
                told((few.mass[axis] / whole.mass[axis] - 1.0).abs())
            );
        }
    }
    let apart = (0..3).map(|i| (few.centre[i] - whole.centre[i]).powi(2)).sum::<f64>().sqrt();
    text + &format!("centre     of gravity off by {} m\n", told(apart))
}

/// Frequencies of both models, links engaged.
fn frequencies(whole: &[f64], few: &[f64]) -> String {
    let head = ["", "whole Hz", "reduced Hz", "error"].map(str::to_owned).to_vec();
    let mut rows = vec![head];
    for (i, f) in whole.iter().enumerate() {
        let (other, error) = match few.get(i) {
            None => ("–".into(), "none".into()),
            Some(x) if *f == 0.0 => (number(*x), if *x == 0.0 { "0".into() } else { "–".into() }),
            Some(x) => (number(*x), format!("{:.1e}", (x / f - 1.0).abs())),
        };
        rows.push(vec![(i + 1).to_string(), number(*f), other, error]);
    }
    format!("\nfrequencies, links as stiff as they are when engaged\n{}", table(&rows, &[0]))
}
