//! Figures of the guide, drawn from runs of its examples.

use std::error::Error;
use std::path::Path;
use std::sync::atomic::AtomicBool;
use trilith::report::{Figure, MODEL, Stroke, named_figures};
use trilith::{Run, read_text};
use trilith_guide::{Exhibit, exhibits, pages};
use trilith_study::{How, Study, execute};

/// Deformed shapes that a run keeps, of which the largest is drawn.
const FRAMES: usize = 200;

/// Draws all.
pub(crate) fn draw(folder: &Path) -> Result<(), Box<dyn Error>> {
    let to = folder.join("figures");
    std::fs::create_dir_all(&to)?;
    let save =
        |name: &str, figure: Figure| std::fs::write(to.join(name), figure.sized(560, 300).svg());
    save("block.svg", block()?)?;
    save("wall.svg", wall()?)?;
    save("isolated.svg", isolated()?)?;
    let to = to.join("gallery");
    std::fs::create_dir_all(&to)?;
    for exhibit in exhibits()? {
        eprintln!("{}", exhibit.path);
        let svg = if exhibit.is_study() { study(&exhibit)? } else { still(&exhibit)? };
        std::fs::write(to.join(format!("{}.svg", exhibit.name())), svg)?;
    }
    Ok(())
}

/// A model where its last case has moved it most.
fn still(exhibit: &Exhibit) -> Result<String, Box<dyn Error>> {
    let model = trilith::read(exhibit.file(), &trilith::registry(), &[]).map_err(|e| told(&e))?;
    let analysis = trilith::Analysis::new(&model)?.with_frames(FRAMES);
    let case = model.cases.len() - 1;
    let run = analysis.run(trilith::RunOptions { case, ..trilith::RunOptions::default() })?;
    let drawings = named_figures(&run.report(&analysis, &[], &[]), MODEL);
    let (_, drawing) = drawings.first().ok_or("a model without a place")?;
    Ok(drawing.svg().to_owned())
}

/// The first figure of a study.
fn study(exhibit: &Exhibit) -> Result<String, Box<dyn Error>> {
    let registry = trilith::registry();
    let study = Study::read(exhibit.file(), &registry, &[]).map_err(|e| told(&e))?;
    let folder = std::env::temp_dir().join(format!("trilith-gallery-{}", std::process::id()));
    let how = How::threads(2);
    let done = execute(&study, &registry, &folder, how, &|_| {}, &AtomicBool::new(false));
    std::fs::remove_dir_all(&folder)?;
    let figures = trilith_study::figures(&study, &done?.records.rows());
    let (_, figure) = figures.into_iter().next().ok_or("a study without figures")?;
    Ok(figure.sized(560, 340).svg())
}

fn told<E: ToString>(errors: &[E]) -> String {
    errors.iter().map(ToString::to_string).collect::<Vec<_>>().join("\n")
}

/// Runs the last case of a model.
fn run(text: &str, set: &[(&str, &str)]) -> Result<Run, Box<dyn Error>> {
    let set: Vec<_> = set.iter().map(|(n, v)| ((*n).to_owned(), (*v).to_owned())).collect();
    let model = read_text(text, "model.ron", &trilith::registry(), &set).map_err(|e| told(&e))?;
    let case = model.cases.last().ok_or("a model without cases")?;
    Ok(trilith::run(&model, &case.name)?)
}

/// The text of a model that a page shows.
fn shown(file: &str) -> Result<String, Box<dyn Error>> {
    let all = pages()?;
    let mut fences = all.iter().flat_map(|p| &p.fences);
    let found = fences.find(|f| f.attribute("file") == Some(file));
    Ok(found.ok_or_else(|| format!("no page shows {file}"))?.text.clone())
}

/// Every `each`-th sample of an output over time, in mm.
fn history(run: &Run, output: &str, each: usize) -> Result<Vec<(f64, f64)>, Box<dyn Error>> {
    let values = run.history(output)?;
    let all = run.time().iter().zip(values).step_by(each);
    Ok(all.map(|(t, x)| (*t, 1e3 * x)).collect())
}

fn block() -> Result<Figure, Box<dyn Error>> {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../models/rigid_block.ron");
    let run = run(&std::fs::read_to_string(path)?, &[("duration", "1 s")])?;
    let mut figure = Figure::new("Block under one cycle of 1.5 g", "time [s]", "displacement [mm]");
    for name in ["slide", "uplift_left", "uplift_right"] {
        figure = figure.series(name, Stroke::Line, history(&run, name, 4)?);
    }
    Ok(figure)
}

fn wall() -> Result<Figure, Box<dyn Error>> {
    let text = shown("wall.ron")?;
    let (with, without) = (run(&text, &[])?, run(&text, &[("gap", "1 m")])?);
    Ok(Figure::new("Frame beside a wall", "time [s]", "sway [mm]")
        .series("with wall", Stroke::Line, history(&with, "sway", 3)?)
        .series("without", Stroke::Dashes, history(&without, "sway", 3)?))
}

fn isolated() -> Result<Figure, Box<dyn Error>> {
    let run = run(&shown("isolated.ron")?, &[])?;
    let mut figure = Figure::new("Isolators", "deformation [mm]", "shear [kN]");
    for name in ["pendulum", "rubber"] {
        let shear = run.history(&format!("{name} shear"))?;
        let points = run.history(name)?.iter().zip(shear).take(1200).step_by(3);
        let points: Vec<_> = points.map(|(d, f)| (1e3 * d, 1e-3 * f)).collect();
        figure = figure.series(name, Stroke::Line, points);
    }
    Ok(figure)
}
