//! `trilith generate`: models from a few numbers.

use crate::args::{FrameArguments, GenerateArguments, Generated};
use crate::text::shown;
use crate::{Answer, Failure};
use trilith::generate::{Frame, Section};

pub(crate) fn generate(args: GenerateArguments) -> Result<Answer, Failure> {
    let Generated::Frame(args) = args.what;
    let frame = frame(&args);
    frame.check().map_err(|e| Failure::input(&e.to_string(), None))?;
    let text = frame.to_ron();
    let Some(path) = args.out else { return Ok(text.into()) };
    if let Some(folder) = path.parent() {
        std::fs::create_dir_all(folder).map_err(|e| Failure::unwritable(folder, &e))?;
    }
    std::fs::write(&path, text).map_err(|e| Failure::unwritable(&path, &e))?;
    let told = format!(
        "{} nodes, {} beams, {} isolators\n{}\n",
        frame.nodes(),
        frame.elements(),
        frame.isolators(),
        shown(&path)
    );
    Ok(told.into())
}

/// The preset, or the plain frame, with what the arguments change.
fn frame(args: &FrameArguments) -> Frame {
    let plain = args.preset.as_deref().and_then(Frame::preset).unwrap_or_default();
    let section = |given: Option<[f64; 2]>, plain: Section| {
        given.map_or(plain, |[width, depth]| Section { width, depth })
    };
    Frame {
        bays: args.bays.unwrap_or(plain.bays),
        storeys: args.storeys.unwrap_or(plain.storeys),
        cuts: args.cuts.unwrap_or(plain.cuts),
        bay: args.bay.unwrap_or(plain.bay),
        storey: args.storey.unwrap_or(plain.storey),
        young: args.young.unwrap_or(plain.young),
        column: section(args.column, plain.column),
        beam: section(args.beam, plain.beam),
        base_beam: section(args.base_beam, plain.base_beam),
        mu: args.mu.unwrap_or(plain.mu),
        radius: args.radius.unwrap_or(plain.radius),
        slip: args.uy.unwrap_or(plain.slip),
        damper_ratio: args.damper_ratio.unwrap_or(plain.damper_ratio),
        peak: args.peak.unwrap_or(plain.peak),
        dt: args.dt.unwrap_or(plain.dt),
        duration: args.duration.unwrap_or(plain.duration),
        vectors: args.vectors.or(plain.vectors),
        ..plain
    }
}
