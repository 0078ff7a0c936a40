//! What other crates offer beside elements, constraints and links: functions of time, outputs, solvers.

use super::context::{Context, Fields};
use super::names::{NODE, Names};
use super::values::{Given, default, values};
use crate::registry::Reader;
use crate::{CustomSolver, SolverKind, Span};
use std::sync::Arc;
use trilith_element::{Card, Read, ReadSolver, Values};

/// Made from its fields as its card says, with the parameters it was made from; `at` is where the file names it.
pub(super) fn made<T: ?Sized>(
    c: &Context<'_>,
    fields: &Fields<'_>,
    (what, at): (&str, &Span),
    card: &Card,
    read: &Read<T>,
) -> Option<(Arc<Values>, Box<T>)> {
    let given = Given { own: fields.entries(), shared: &[], made: Default::default() };
    let values = values(c, card, &given, what, at, &Names::new(NODE, "nodes", &[]))?;
    match read(&values) {
        Ok(it) => Some((Arc::new(values), it)),
        Err(error) => {
            let place = error.parameter().and_then(|name| given.get(name));
            let place = place.map_or(at, |node| &node.span).clone();
            c.report(c.diagnostic("E0114", format!("{what}: {error}"), place));
            None
        }
    }
}

/// A solver that a case names, kept among those of the model.
pub(super) fn solver(
    c: &Context<'_>,
    fields: &Fields<'_>,
    at: &Span,
    card: &'static Card,
    read: &ReadSolver,
) -> Option<SolverKind> {
    let what = format!("solver `{}`", card.kind);
    let (values, integrator) = made(c, fields, (&what, at), card, read)?;
    let solver = CustomSolver { card, values, integrator: Arc::from(integrator) };
    let mut all = c.solvers.borrow_mut();
    let kind = solver.kind(all.len());
    all.push(solver);
    Some(kind)
}

/// The solvers that cases name, and behind them those of the registry that need no parameter: a run may be told to take
/// them.
pub(super) fn solvers(c: &Context<'_>) -> Vec<CustomSolver> {
    let mut all = c.solvers.take();
    for card in c.registry.solvers() {
        if !all.iter().any(|solver| solver.card.kind == card.kind) {
            all.extend(plain(c, card));
        }
    }
    all
}

/// A solver with the defaults of its card; none where it has no default for some parameter.
fn plain(c: &Context<'_>, card: &'static Card) -> Option<CustomSolver> {
    let (_, Reader::Solver(read)) = c.registry.find(card.kind)? else { return None };
    let mut values = Vec::new();
    for p in card.parameters {
        values.extend(default(p).ok()?.map(|value| (p.name.to_owned(), value)));
    }
    let values = Values(values);
    let integrator = Arc::from(read(&values).ok()?);
    Some(CustomSolver { card, values: Arc::new(values), integrator })
}
