//! `trilith combine`: combinations of cases.

use crate::args::CombineArguments;
use crate::interrupt::{Ear, INTERRUPTED};
use crate::progress::Progress;
use crate::text::{names_help, number, table};
use crate::{Answer, Failure, diagnostics, names, output, read};
use trilith::combine::{Combinations, CombineError, Combined, combine_until};
use trilith::model::{CombineCases, visible_line};
use trilith::{Error, Model, Registry};

pub(crate) fn combine(registry: &Registry, args: &CombineArguments) -> Result<Answer, Failure> {
    let model = read(registry, &args.model)?;
    let mut bar = Progress::new(&model.title);
    let ear = Ear::open("the run ends at the next output step, and nothing is combined");
    let mut show = |_: &str, share| bar.show(share);
    let names = names::flat(&args.of);
    let found = combine_until(&model, &names, &mut show, Some(ear.flag()));
    let found = found.map_err(|e| failure(&e, &model))?;
    for case in &found.cases {
        for warning in &case.warnings {
            output::tell(&diagnostics::warning(&format!("case \"{}\": {warning}", case.name)));
        }
    }
    if args.json {
        let text = serde_json::to_string_pretty(&found).unwrap_or_default();
        return Ok((text + "\n").into());
    }
    Ok(page(&model, &found).into())
}

fn failure(error: &CombineError, model: &Model) -> Failure {
    match error {
        CombineError::None => Failure::input(
            &error.to_string(),
            Some(
                "give it some, such as `combinations: { \"design\": Envelope(cases: [\"quake 1\", \"quake 2\"]) }`",
            ),
        ),
        CombineError::Unknown { name, .. } => {
            let all = model.combinations.iter().map(|c| c.name.as_str());
            let help = names_help(name, "combinations", all);
            Failure::input(&format!("there is no combination \"{name}\""), Some(&help))
        }
        CombineError::Run(Error::Interrupted) => {
            Failure { text: diagnostics::plain(&error.to_string(), None), status: INTERRUPTED }
        }
        CombineError::Run(e) => Failure::of(e, model),
        // A case without a good end.
        _ => Failure { text: diagnostics::plain(&error.to_string(), None), status: 1 },
    }
}

/// What the program prints.
pub(crate) fn page(model: &Model, found: &Combinations) -> String {
    let mut out = format!("{}\n", visible_line(&model.title));
    for one in &found.combinations {
        out += &format!("\n{}: {}\n", visible_line(&one.name), visible_line(&formula(one)));
        out += &outputs(one);
        if let Some([earlier, later]) = &one.twice {
            let [earlier, later] = [earlier, later].map(|name| visible_line(name));
            out += &format!(
                "  warning: it adds \"{earlier}\" and \"{later}\", which continues it: what \"{earlier}\" does is in both\n"
            );
        }
    }
    let cases: Vec<_> = found
        .cases
        .iter()
        .map(|c| format!("\"{}\" ({})", visible_line(&c.name), c.solver))
        .collect();
    out += &format!("\ncases: {}\n", cases.join(", "));
    out
}

/// How a combination is made, in a line.
fn formula(one: &Combined) -> String {
    let term = |(name, factor): &(String, f64)| match factor {
        1.0 => format!("\"{name}\""),
        factor => format!("{factor} \"{name}\""),
    };
    let terms: Vec<_> = one.terms.iter().map(term).collect();
    format!("{} of {}", one.how.name(), terms.join(", "))
}

/// The outputs of a combination: one column where all have one value, as those of static cases.
fn outputs(one: &Combined) -> String {
    let is_envelope = one.how == CombineCases::Envelope;
    let single = !is_envelope && one.outputs.iter().all(|o| o.max == o.min);
    let (head, left): (&[&str], &[usize]) = match (is_envelope, single) {
        (true, _) => (&["output", "unit", "max", "from", "min", "from"], &[0, 1, 3, 5]),
        (false, true) => (&["output", "unit", "value"], &[0, 1]),
        (false, false) => (&["output", "unit", "max", "min"], &[0, 1]),
    };
    let mut rows = vec![head.iter().map(|cell| (*cell).to_owned()).collect()];
    for o in &one.outputs {
        let mut cells = vec![o.output.clone(), o.unit.clone(), number(o.max)];
        if is_envelope {
            let from = |name: &Option<String>| name.clone().unwrap_or_default();
            cells.extend([from(&o.max_from), number(o.min), from(&o.min_from)]);
        } else if !single {
            cells.push(number(o.min));
        }
        rows.push(cells);
    }
    table(&rows, left)
}
