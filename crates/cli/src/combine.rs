//! `trilith combine`: combinations of cases.

use crate::args::CombineArguments;
use crate::interrupt::{Ear, INTERRUPTED};
use crate::progress::Progress;
use crate::text::{names_help, number, table};
use crate::{Answer, Failure, browser, combine_page, diagnostics, names, output, place, read};
use std::path::Path;
use trilith::combine::{Combinations, CombineError, Combined, combine_until};
use trilith::model::{CombineCases, visible_line};
use trilith::results::{Folder, Writer};
use trilith::{Error, Model, Registry};

const TABLE: &str = "combinations.csv";
const PAGE: &str = "combinations.html";

pub(crate) fn combine(registry: &Registry, args: &CombineArguments) -> Result<Answer, Failure> {
    let model = read(registry, &args.model)?;
    // Looked at before the runs: nothing that was computed is lost for want of a place.
    let folder = args.out.as_ref().map(|dir| open(dir, &model)).transpose()?;
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
    let mut files = String::new();
    if let Some(folder) = folder {
        let table = combine_page::table(&found).into_bytes();
        let page = combine_page::page(&model, &found).into_bytes();
        for path in place::write(folder, &[(TABLE.into(), table), (PAGE.into(), page)])? {
            files += &format!("file: {path}\n");
            if path.ends_with(PAGE) {
                browser::show(args.open, Path::new(&path));
            }
        }
    }
    if args.json {
        let text = serde_json::to_string_pretty(&found).unwrap_or_default();
        return Ok((text + "\n").into());
    }
    Ok((page(&model, &found) + &files).into())
}

/// Takes the folder of the table and the page.
fn open(dir: &Path, model: &Model) -> Result<Folder, Failure> {
    let inputs = model.inputs();
    let writes = vec![TABLE.into(), PAGE.into()];
    place::open(dir, Writer { name: "combine", own: &[TABLE, PAGE], writes, inputs })
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
        if let Some(text) = one.warning() {
            out += &format!("  warning: {text}\n");
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
pub(crate) fn formula(one: &Combined) -> String {
    let term = |(name, factor): &(String, f64)| match factor {
        1.0 => format!("\"{name}\""),
        factor => format!("{factor} \"{name}\""),
    };
    let terms: Vec<_> = one.terms.iter().map(term).collect();
    format!("{} of {}", one.how.name(), terms.join(", "))
}

/// The outputs of a combination.
fn outputs(one: &Combined) -> String {
    let (rows, left) = rows(one);
    table(&rows, left)
}

/// The same as rows, the first of which is the head, and the columns of words: one column of values where all have one, as
/// those of static cases.
pub(crate) fn rows(one: &Combined) -> (Vec<Vec<String>>, &'static [usize]) {
    let is_envelope = one.how == CombineCases::Envelope;
    let single = !is_envelope && one.outputs.iter().all(|o| o.max == o.min);
    let (head, left): (&[&str], &'static [usize]) = match (is_envelope, single) {
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
    (rows, left)
}
