//! `trilith check`.

mod sheet;

use crate::args::CheckArguments;
use crate::{Answer, Failure, diagnostics, long, read};
use trilith::model::{Analysis as Kind, resolved};
use trilith::{Analysis, Registry};

pub(crate) fn check(registry: &Registry, args: &CheckArguments) -> Result<Answer, Failure> {
    let model = read(registry, &args.model)?;
    let analysis = Analysis::new(&model).map_err(|e| Failure::of(&e, &model))?;
    let is_static = |k: &Kind| matches!(k, Kind::Static(_));
    for with_mass in [false, true] {
        if model.cases.iter().any(|c| is_static(&c.analysis) != with_mass) {
            let checked = analysis.system().check_supported(&model, with_mass);
            checked.map_err(|e| Failure::of(&e.into(), &model))?;
        }
    }
    for warning in trilith::solvers::warnings(&model).map_err(|e| Failure::of(&e.into(), &model))? {
        crate::output::tell(&warning);
    }
    for doubt in &analysis.system().inner.doubts {
        crate::output::tell(&diagnostics::warning(doubt));
    }
    for case in &model.cases {
        if let Some(warning) = long::warning(&model, case, None) {
            crate::output::tell(&warning);
        }
    }
    if args.resolved {
        return Ok(resolved(&model).into());
    }
    let survey = analysis.survey().map_err(|e| Failure::of(&e, &model))?;
    Ok(sheet::text(&model, &survey).into())
}
