//! What a link does on its own.

use crate::column::Column;
use crate::failure::Failure;
use crate::laws::{Law, Laws};
use crate::work;
use pyo3::prelude::*;
use trilith::Registry;
use trilith::element::Stroke;
use trilith::element::dimension::{LENGTH, NONE};
use trilith::exercise::{Coordinate, ExerciseError, History, Motion, Record, Specimen};
use trilith::model::{file::names_help, quantity};

/// A coordinate: name, whether it is a rotation, deformation, rate, force, area of the last cycle, its stiffness and
/// equivalent damping.
type CoordinateFacts =
    (String, bool, Column, Column, Column, Option<(f64, Option<f64>, Option<f64>)>);

/// The line of a model file, notes, times, coordinates; work, stored, hysteretic and viscous energy; history variables
/// with their units; share of the energy that is unaccounted for; figures as SVG.
type Facts = (
    String,
    Vec<String>,
    Column,
    Vec<CoordinateFacts>,
    [Column; 4],
    Vec<(String, String, Column)>,
    f64,
    Vec<String>,
);

/// Times, and deformations of some coordinates.
type Path = (Vec<f64>, Vec<(String, Vec<f64>)>);

/// Leads a link through cycles, or along a history.
#[pyfunction]
#[pyo3(signature = (kind, set, amplitude, mean, frequency, cycles, history, laws))]
pub(crate) fn exercise(
    py: Python<'_>,
    kind: String,
    set: Vec<(String, String)>,
    amplitude: Vec<(String, String)>,
    mean: Vec<(String, String)>,
    frequency: Option<f64>,
    cycles: usize,
    history: Option<Path>,
    laws: Vec<Py<Law>>,
) -> PyResult<Facts> {
    work::run(py, move |_| {
        let registry = Laws::new(&laws)?.registry();
        let specimen = specimen(&registry, &kind, &set)?;
        let (record, cycling) = match history {
            Some((times, columns)) => (follow(&specimen, &times, &columns)?, false),
            None => {
                let motion = motion(&specimen, &amplitude, &mean, frequency, cycles)?;
                (specimen.exercise(&motion).map_err(|e| refuse(&e))?, true)
            }
        };
        Ok(facts(&specimen, record, cycling))
    })
}

/// A link to be exercised.
pub(crate) fn specimen(
    registry: &Registry,
    kind: &str,
    set: &[(String, String)],
) -> Result<Specimen, Failure> {
    Specimen::new(registry, kind, set).map_err(|e| match e {
        ExerciseError::UnknownKind(kind) => {
            Failure::unknown("kind", &kind, "kinds", registry.cards().map(|c| c.kind))
        }
        other => refuse(&other),
    })
}

pub(crate) fn refuse(error: &ExerciseError) -> Failure {
    match error {
        ExerciseError::Parameters(all) => Failure::diagnostics(all),
        ExerciseError::NotALink { .. } => {
            Failure::argument(&error.to_string(), Some("trilith.elements() lists the links"))
        }
        ExerciseError::NoStrokes { .. } => {
            let help = "give `amplitude` and `mean` for each of them";
            Failure::argument(&error.to_string(), Some(help))
        }
        _ => Failure::argument(&error.to_string(), None),
    }
}

/// The motion of the card with what is changed.
pub(crate) fn motion(
    specimen: &Specimen,
    amplitude: &[(String, String)],
    mean: &[(String, String)],
    frequency: Option<f64>,
    cycles: usize,
) -> Result<Motion, Failure> {
    let coordinates = specimen.coordinates();
    let mut motion = match specimen.motion() {
        Ok(motion) => motion,
        // Without a fitting exercise on the card the arguments have to give it.
        Err(_) if !amplitude.is_empty() => Motion {
            frequency: specimen.card.exercise.frequency,
            strokes: vec![Stroke::about(0.0, 0.0); coordinates.len()],
            cycles: 1,
        },
        Err(e) => return Err(refuse(&e)),
    };
    for (name, text) in amplitude {
        let (at, x) = value("amplitude", name, text, &coordinates)?;
        motion.strokes[at].amplitude = x;
    }
    for (name, text) in mean {
        let (at, x) = value("mean", name, text, &coordinates)?;
        motion.strokes[at].mean = x;
    }
    motion.frequency = frequency.unwrap_or(motion.frequency);
    motion.cycles = cycles;
    Ok(motion)
}

fn place(name: &str, coordinates: &[Coordinate]) -> Result<usize, Failure> {
    let names = coordinates.iter().map(|c| c.name.as_str());
    coordinates.iter().position(|c| c.name == name).ok_or_else(|| {
        let help = names_help(name, "coordinates", names);
        Failure::argument(&format!("there is no coordinate \"{name}\""), Some(&help))
    })
}

fn value(
    what: &str,
    name: &str,
    text: &str,
    coordinates: &[Coordinate],
) -> Result<(usize, f64), Failure> {
    let at = place(name, coordinates)?;
    let dimension = if coordinates[at].rotation { NONE } else { LENGTH };
    let x = quantity(text, dimension)
        .map_err(|why| Failure::argument(&format!("`{what}` of {name}: {why}"), None))?;
    Ok((at, x))
}

/// Leads the link along a history, which is read as the file of one would be.
fn follow(
    specimen: &Specimen,
    times: &[f64],
    columns: &[(String, Vec<f64>)],
) -> Result<Record, Failure> {
    let coordinates = specimen.coordinates();
    let mut text = String::from("t");
    for (name, values) in columns {
        place(name, &coordinates)?;
        if values.len() != times.len() {
            let (n, m) = (values.len(), times.len());
            let message = format!("the path of {name} has {n} values for {m} times");
            return Err(Failure::argument(&message, None));
        }
        text += &format!(",{name}");
    }
    text.push('\n');
    for (i, t) in times.iter().enumerate() {
        text += &format!("{t:?}");
        columns.iter().for_each(|(_, values)| text += &format!(",{:?}", values[i]));
        text.push('\n');
    }
    let history = History::parse(&text, &coordinates)
        .map_err(|e| Failure::argument(&format!("the path: {e}"), None))?;
    specimen.follow(&history).map_err(|e| refuse(&e))
}

fn facts(specimen: &Specimen, record: Record, cycling: bool) -> Facts {
    let figures = record.figures().iter().map(trilith::report::Figure::svg).collect();
    let error = record.energy_error();
    let last: Vec<_> = (0..record.coordinates.len())
        .map(|i| {
            let cycle = (cycling && record.moves(i)).then(|| record.last_cycle(i));
            cycle.map(|c| (c.area, c.stiffness, c.damping))
        })
        .collect();
    let Record {
        coordinates, time, deformation, rate, force, work, energy, fields, history, ..
    } = record;
    let lists = deformation.into_iter().zip(rate).zip(force).zip(last);
    let coordinates = coordinates.into_iter().zip(lists).map(|(c, (((d, v), f), last))| {
        (c.name, c.rotation, Column::new(d), Column::new(v), Column::new(f), last)
    });
    let [stored, hysteretic, viscous] = energy;
    let fields = fields.iter().map(|f| (f.name.to_string(), f.unit.to_string()));
    (
        specimen.line.clone(),
        specimen.notes.clone(),
        Column::new(time),
        coordinates.collect(),
        [work, stored, hysteretic, viscous].map(Column::new),
        fields
            .zip(history)
            .map(|((name, unit), values)| (name, unit, Column::new(values)))
            .collect(),
        error,
        figures,
    )
}
