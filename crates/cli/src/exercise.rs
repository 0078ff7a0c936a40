//! `trilith exercise`: what a link does on its own.

use crate::args::ExerciseArguments;
use crate::text::{exact, number, percent, row, significant, table};
use crate::{Answer, Failure, elements, place};
use std::path::Path;
use trilith::Registry;
use trilith::element::Stroke;
use trilith::element::conformance::Kit;
use trilith::element::dimension::{LENGTH, NONE};
use trilith::exercise::{Coordinate, ExerciseError, History, Motion, Record, Specimen};
use trilith::model::quantity;
use trilith::report::Figure;
use trilith::results::{Folder, Writer};

/// The path that the link was led along, and what it looks like.
const FILES: [&str; 2] = ["path.csv", "loop.svg"];

pub(crate) fn exercise(registry: &Registry, args: ExerciseArguments) -> Result<Answer, Failure> {
    let specimen = Specimen::new(registry, &args.kind, &args.set).map_err(|e| match e {
        ExerciseError::UnknownKind(kind) => elements::unknown(registry, &kind),
        other => refuse(&other),
    })?;
    let folder = open(&specimen, &args)?;
    let (record, mut text) = match &args.history {
        Some(path) => follow(&specimen, path)?,
        None => {
            let motion = motion(&specimen, &args)?;
            let record = specimen.exercise(&motion).map_err(|e| refuse(&e))?;
            let mut text = text(&specimen, &motion, &record);
            if args.speed {
                text += &speed(&specimen, &motion);
            }
            (record, text)
        }
    };
    if let Some(folder) = folder {
        for path in place::write(folder, &files(&record))? {
            text += &format!("{path}\n");
        }
    }
    Ok(text.into())
}

/// Takes the folder of the files, where there are to be any.
fn open(specimen: &Specimen, args: &ExerciseArguments) -> Result<Option<Folder>, Failure> {
    if args.no_files {
        return Ok(None);
    }
    let default = || Path::new("out").join(format!("exercise_{}", specimen.card.kind));
    let writer = Writer {
        name: "exercise",
        own: &FILES,
        writes: FILES.map(str::to_owned).to_vec(),
        inputs: args.history.iter().cloned().collect(),
    };
    place::open(&args.out.clone().unwrap_or_else(default), writer).map(Some)
}

/// Leads the link along a measured history.
fn follow(specimen: &Specimen, path: &Path) -> Result<(Record, String), Failure> {
    let bad = |why: String| {
        let help = "the first line names the columns, such as `t [s],U1 [mm]`; a line of numbers for each sample \
                    follows, with commas between them";
        Failure::input(&format!("{}: {why}", path.display()), Some(help))
    };
    let file = trilith::record::file::read_text(path)
        .map_err(|e| Failure::input(&format!("{} cannot be read: {e}", path.display()), None))?;
    let coordinates = specimen.coordinates();
    let history = History::parse(&file, &coordinates).map_err(|e| bad(e.to_string()))?;
    let record = specimen.follow(&history).map_err(|e| refuse(&e))?;
    let mut text = about(specimen);
    let (first, last) = (history.time[0], history.time[history.time.len() - 1]);
    text += &format!(
        "\nled along {}: {} samples from {} s to {} s\n",
        path.display(),
        history.time.len(),
        number(first),
        number(last)
    );
    if !history.unused.is_empty() {
        text += &format!("  not used: {}\n", history.unused.join(", "));
    }
    let heads = ["", "unit", "from", "to", "force min", "force max", "unit"];
    let mut rows = vec![row(heads)];
    for (i, c) in record.coordinates.iter().enumerate() {
        let [(from, to), (low, high)] = record.extremes(i);
        let (length, force) = units(c);
        let [from, to, low, high] = [from, to, low, high].map(number);
        rows.push(row([&c.name, length, &from, &to, &low, &high, force]));
    }
    text += &table(&rows, &[0, 6]);
    text += &energies(&record);
    Ok((record, text))
}

fn refuse(error: &ExerciseError) -> Failure {
    match error {
        ExerciseError::Parameters(all) => Failure::diagnostics(all),
        ExerciseError::NotALink { .. } => {
            Failure::input(&error.to_string(), Some("`trilith elements` lists the links"))
        }
        ExerciseError::NoStrokes { .. } => {
            let help = "give `--amplitude` and `--mean` for each of them";
            Failure::input(&error.to_string(), Some(help))
        }
        _ => Failure::input(&error.to_string(), None),
    }
}

/// The motion of the card with what the arguments change.
fn motion(specimen: &Specimen, args: &ExerciseArguments) -> Result<Motion, Failure> {
    let coordinates = specimen.coordinates();
    let mut motion = match specimen.motion() {
        Ok(motion) => motion,
        // Without a fitting exercise on the card the arguments have to give it.
        Err(_) if args.amplitude.is_some() => Motion {
            frequency: specimen.card.exercise.frequency,
            strokes: vec![Stroke::about(0.0, 0.0); coordinates.len()],
            cycles: 1,
        },
        Err(e) => return Err(refuse(&e)),
    };
    if let Some(text) = &args.amplitude {
        let mut values = motion.strokes.iter().map(|s| s.amplitude).collect::<Vec<_>>();
        set("--amplitude", text, &coordinates, &mut values)?;
        motion.strokes.iter_mut().zip(values).for_each(|(s, x)| s.amplitude = x);
    }
    if let Some(text) = &args.mean {
        let mut values = motion.strokes.iter().map(|s| s.mean).collect::<Vec<_>>();
        set("--mean", text, &coordinates, &mut values)?;
        motion.strokes.iter_mut().zip(values).for_each(|(s, x)| s.mean = x);
    }
    motion.frequency = args.frequency.unwrap_or(motion.frequency);
    motion.cycles = args.cycles.into();
    Ok(motion)
}

/// One value for each coordinate in their order, or `NAME=VALUE` for some.
fn set(
    option: &str,
    text: &str,
    coordinates: &[Coordinate],
    values: &mut [f64],
) -> Result<(), Failure> {
    let names: Vec<_> = coordinates.iter().map(|c| c.name.as_str()).collect();
    let items: Vec<&str> = text.split(',').map(str::trim).collect();
    let named = items.iter().all(|item| item.contains('='));
    if !named && items.len() != coordinates.len() {
        let message = format!(
            "`{option}` has {} of {} values: the law has the coordinates {}",
            items.len(),
            coordinates.len(),
            names.join(", ")
        );
        let help = format!("give one for each, or by name, such as `{option} {}=…`", names[0]);
        return Err(Failure::input(&message, Some(&help)));
    }
    for (position, item) in items.iter().enumerate() {
        let (at, value) = match item.split_once('=') {
            None => (position, *item),
            Some((name, value)) => {
                let at = names.iter().position(|n| *n == name.trim()).ok_or_else(|| {
                    let message = format!("`{option}`: there is no coordinate `{}`", name.trim());
                    let help =
                        crate::text::names_help(name.trim(), "coordinates", names.iter().copied());
                    Failure::input(&message, Some(&help))
                })?;
                (at, value)
            }
        };
        let dimension = if coordinates[at].rotation { NONE } else { LENGTH };
        values[at] = quantity(value, dimension)
            .map_err(|why| Failure::input(&format!("`{option}` of {}: {why}", names[at]), None))?;
    }
    Ok(())
}

fn text(specimen: &Specimen, motion: &Motion, record: &Record) -> String {
    let mut out = about(specimen);
    out += &format!(
        "\nimposed: {} Hz, {}\n",
        exact(motion.frequency),
        if motion.cycles == 1 {
            "1 cycle".into()
        } else {
            format!("{} growing cycles", motion.cycles)
        }
    );
    let mut rows = vec![row(["", "unit", "mean", "amplitude", "force min", "force max", "unit"])];
    for (i, (c, s)) in record.coordinates.iter().zip(&motion.strokes).enumerate() {
        let [_, (low, high)] = record.extremes(i);
        let (length, force) = units(c);
        let [mean, amplitude, low, high] = [s.mean, s.amplitude, low, high].map(number);
        rows.push(row([&c.name, length, &mean, &amplitude, &low, &high, force]));
    }
    out += &table(&rows, &[0, 6]);
    out += "\nlast cycle\n";
    let mut rows =
        vec![row(["", "loop area [J]", "effective stiffness", "", "equivalent damping"])];
    for (i, c) in record.coordinates.iter().enumerate().filter(|(i, _)| record.moves(*i)) {
        let cycle = record.last_cycle(i);
        let stiffness = cycle.stiffness.map_or("–".into(), number);
        let damping = cycle.damping.map_or("–".into(), percent);
        let unit = if c.rotation { "N·m/rad" } else { "N/m" };
        rows.push(row([&c.name, &number(cycle.area), &stiffness, unit, &damping]));
    }
    out += &table(&rows, &[0, 3]);
    out + &energies(record)
}

/// An analysis in lanes that takes more than this share of the time of one alone gains little.
const SLOW: f64 = 0.7;

/// How long answers take on this machine.
fn speed(specimen: &Specimen, motion: &Motion) -> String {
    let size = |s: &Stroke| if s.amplitude == 0.0 { s.mean } else { s.amplitude }.abs();
    let amplitudes: Vec<f64> = motion.strokes.iter().map(size).collect();
    let kit = Kit::new(&amplitudes, motion.frequency);
    let Some(speed) = kit.lane_speed(specimen.law.as_ref()) else {
        return "\nspeed: it has no form for lanes: a study asks it for one analysis after the other\n"
            .into();
    };
    let [alone, lane] = [speed.alone, speed.in_lanes].map(|s| significant(1e9 * s, 2));
    let share = significant(speed.share(), 2);
    let slow = match speed.share() > SLOW {
        true => "; that gains little: is a function of its form not inlined?",
        false => "",
    };
    format!(
        "\nspeed: an answer takes {alone} ns alone, and {lane} ns for each analysis of {} in lanes, {share} of it{slow}\n",
        speed.width
    )
}

/// The link, and what was assumed.
fn about(specimen: &Specimen) -> String {
    let mut out =
        format!("{}: {}\n  {}\n", specimen.card.kind, specimen.card.summary, specimen.line);
    for note in &specimen.notes {
        out += &format!("  note: {note}\n");
    }
    out
}

/// What became of the work, as a table with a line behind it.
fn energies(record: &Record) -> String {
    let [work, stored, hysteretic, viscous] = record.totals();
    let rows = [
        row(["work done on the link", &number(work)]),
        row(["stored", &number(stored)]),
        row(["hysteretic", &number(hysteretic)]),
        row(["viscous", &number(viscous)]),
        row(["balance error", &format!("{} %", significant(100.0 * record.energy_error(), 2))]),
    ];
    format!("\nenergy [J]\n{}\n", table(&rows, &[0]))
}

fn units(c: &Coordinate) -> (&'static str, &'static str) {
    if c.rotation { ("rad", "N·m") } else { ("m", "N") }
}

/// Names and contents.
fn files(record: &Record) -> Vec<(String, String)> {
    let figures = record.figures();
    let sheet = (!figures.is_empty()).then(|| Figure::sheet(&figures));
    let all = FILES.into_iter().zip([Some(record.csv()), sheet]);
    all.filter_map(|(name, content)| Some((name.to_owned(), content?))).collect()
}
