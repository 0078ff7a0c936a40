//! Modes of a structure, with and without its links.

use crate::failure::Failure;
use crate::model::{index, json};
use serde_json::json as object;
use std::sync::Arc;
use trilith::model::{Body, Model, file};
use trilith::solvers::LinkStiffness;
use trilith::{Analysis, Error};
use trilith_cli::told;

/// Modes as JSON and as the program tells them; of some six displacements of every node.
pub(crate) type ModeFacts = (String, String, Vec<(usize, Vec<f32>)>);

/// How links count.
pub(crate) struct Wanted<'a> {
    /// `open`, `engaged`, `tangent` or `secant`.
    pub links: &'a str,
    /// Amplitude of the cycles of secants, m.
    pub amplitude: Option<f64>,
    /// Links that are led through them; `*` stands for anything.
    pub of: Option<&'a [String]>,
}

/// Modes without links, in the basis of a case.
pub(crate) fn of_structure(model: &Arc<Model>, case: Option<&str>) -> Result<ModeFacts, Failure> {
    let case = case.map(|name| index(model, Some(name))).transpose()?;
    let report = Analysis::new(Arc::clone(model)).and_then(|a| a.modes(case));
    let report = report.map_err(|e| Failure::of(&e, model))?;
    let shapes = report.shapes.iter().map(|s| (s.mode, s.displacements.clone()));
    Ok((json(&report)?, told::modes(&report), shapes.collect()))
}

/// Modes with links as they are after a case, or `rest`; where none is named, as the last dynamic case begins with them.
pub(crate) fn linked(
    model: &Arc<Model>,
    wanted: &Wanted<'_>,
    after: Option<&str>,
    count: usize,
) -> Result<ModeFacts, Failure> {
    let failed = |e: Error| Failure::of(&e, model);
    let stiffness = wanted.stiffness(model)?;
    let analysis = Analysis::new(Arc::clone(model)).map_err(failed)?;
    let after = match after {
        Some("rest") if model.case("rest").is_none() => None,
        Some(name) => Some(index(model, Some(name))?),
        None => analysis.links_begin_after(None),
    };
    let linear = analysis.linearised(&stiffness, after).map_err(failed)?;
    let modes = linear.modes(count).map_err(|e| failed(e.into()))?;
    let shapes = (0..modes.omega2.len()).map(|j| (j, linear.at_nodes(modes.shapes.column(j))));
    // What falls has no frequency.
    let omega = modes.omega2.iter().map(|w| (*w >= 0.0).then(|| w.sqrt()));
    let facts = object!({
        "omega": omega.collect::<Vec<_>>(),
        "mass_participation": modes.mass_share,
        "damping": if linear.secants.is_empty() { Vec::new() } else { modes.damping.clone() },
        "static_participation": [],
        "adequacy": [],
        "static_shapes": 0,
    });
    Ok((json(&facts)?, told::linked_modes(&linear, &modes), shapes.collect()))
}

impl Wanted<'_> {
    fn stiffness(&self, model: &Model) -> Result<LinkStiffness, Failure> {
        match self.links {
            "open" => Ok(LinkStiffness::Open),
            "engaged" => Ok(LinkStiffness::Engaged),
            "tangent" => Ok(LinkStiffness::Tangent),
            "secant" => {
                let help = "such as `amplitude=0.2`, in m";
                let none = || Failure::argument("secants need the amplitude of cycles", Some(help));
                let displacement = self.amplitude.ok_or_else(none)?;
                if !(displacement > 0.0 && displacement.is_finite()) {
                    let message = format!("an amplitude of {displacement} m: must be above zero");
                    return Err(Failure::argument(&message, Some(help)));
                }
                Ok(LinkStiffness::Secant { displacement, of: self.elements(model)? })
            }
            other => {
                let names = ["open", "engaged", "tangent", "secant"];
                Err(Failure::unknown("way for links to count", other, "ways", names))
            }
        }
    }

    /// The links that are named.
    fn elements(&self, model: &Model) -> Result<Option<Vec<usize>>, Failure> {
        let Some(of) = self.of else { return Ok(None) };
        let links = || {
            let all = model.elements.iter().enumerate();
            all.filter(|(_, e)| matches!(e.body, Body::Link(..)))
        };
        let mut all = Vec::new();
        for name in of {
            let before = all.len();
            all.extend(links().filter(|(_, e)| file::fits(name, &e.name)).map(|(i, _)| i));
            if all.len() == before {
                let names: Vec<&str> = links().map(|(_, e)| e.name.as_str()).collect();
                return Err(Failure::unknown("link", name, "links", names));
            }
        }
        Ok(Some(all))
    }
}
