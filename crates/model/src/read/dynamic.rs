//! Dynamic cases.

use super::cases::Surroundings;
use super::context::{Context, Fields};
use super::groups::several;
use super::{loads, solution};
use crate::schema;
use crate::tree::{Kind, Node};
use crate::{
    AfterEnd, BaseMotion, DynamicCase, ForceHistory, Initial, Interpolation, MOST_OUTPUT_STEPS,
    SupportMotion, output_steps,
};
use std::collections::HashSet;
use trilith_element::dimension::{ACCELERATION, FREQUENCY, LENGTH, NONE, VELOCITY};
use trilith_element::{Dimension, Dof};

struct Reading<'c, 'n> {
    c: &'c Context<'c>,
    about: &'c Surroundings<'c, 'n>,
    duration: Option<f64>,
}

pub(super) fn dynamic(
    c: &Context<'_>,
    fields: &Fields<'_>,
    about: &Surroundings<'_, '_>,
) -> Option<DynamicCase> {
    let (duration, dt) = (fields.number(c, "duration"), fields.number(c, "dt"));
    if let (Some(duration), Some(dt), Some(node)) = (duration, dt, fields.get("dt"))
        && dt > duration * (1.0 + 1e-9)
    {
        let message = format!("`dt` = {dt} s is longer than the case: must be ≤ {duration} s");
        c.report(c.diagnostic("E0112", message, node.span.clone()));
    }
    if let (Some(duration), Some(dt), Some(node)) = (duration, dt, fields.get("dt")) {
        check_steps(c, duration, dt, node);
    }
    let r = Reading { c, about, duration };
    let constant =
        fields.get("constant").map_or(Some(Vec::new()), |n| loads::list(c, n, about.loads));
    let base = r.list(fields, "base", Reading::base);
    let forces = r.list(fields, "forces", Reading::force);
    let supports = r.list(fields, "supports", Reading::support);
    let initial = r.list(fields, "initial", Reading::initial);
    let solution = solution::solution(c, fields);
    Some(DynamicCase {
        duration: duration?,
        dt: dt?,
        constant: constant?,
        base: base?,
        forces: forces?,
        supports: supports?,
        initial: initial?,
        solution: solution?,
    })
}

/// Refuses more output steps than can be kept.
fn check_steps(c: &Context<'_>, duration: f64, dt: f64, node: &Node) {
    let steps = output_steps(duration, dt);
    if steps <= MOST_OUTPUT_STEPS as f64 {
        return;
    }
    let message = format!(
        "`dt` = {dt} s makes {steps:.3e} output steps of a case of {duration} s: at most {MOST_OUTPUT_STEPS} are kept"
    );
    let least = duration / MOST_OUTPUT_STEPS as f64;
    let help = format!(
        "`dt` must be at least {least} s, or `duration` shorter; `dt` is the step of the results, the solver takes shorter ones where it needs them"
    );
    c.report(c.diagnostic("E0112", message, node.span.clone()).label("too short").help(help));
}

impl Reading<'_, '_> {
    fn list<T, L: IntoIterator<Item = T>>(
        &self,
        fields: &Fields<'_>,
        key: &str,
        one: fn(&Self, &Node) -> Option<L>,
    ) -> Option<Vec<T>> {
        let Some(node) = fields.get(key) else { return Some(Vec::new()) };
        let all: Vec<_> = node.items().into_iter().map(|n| one(self, n)).collect();
        let all: Vec<L> = all.into_iter().collect::<Option<_>>()?;
        Some(all.into_iter().flatten().collect())
    }

    fn base(&self, node: &Node) -> Option<[BaseMotion; 1]> {
        let c = self.c;
        let fields = c.block(node, "a base motion", schema::BASE_MOTION.blocks[0])?;
        let direction = fields.choice(c, "direction", "direction");
        let (function, factor) = self.function(&fields, ACCELERATION)?;
        Some([BaseMotion { direction: Dof::ALL[direction? % 3], function, factor }])
    }

    fn force(&self, node: &Node) -> Option<[ForceHistory; 1]> {
        let c = self.c;
        let fields = c.block(node, "a force history", schema::FORCE_HISTORY.blocks[0])?;
        let pattern = fields.required(c, "load").and_then(|n| self.about.loads.refer(c, n));
        let (function, factor) = self.function(&fields, NONE)?;
        Some([ForceHistory { pattern: pattern?, function, factor }])
    }

    /// Of a node, or of each of several.
    fn support(&self, item: &Node) -> Option<Vec<SupportMotion>> {
        let c = self.c;
        let fields = c.block(item, "a support motion", schema::SUPPORT_MOTION.blocks[0])?;
        let (nodes, dof) = self.place(&fields);
        let (nodes, dof) = (nodes?, dof?);
        let wanted = if dof.is_rotation() { NONE } else { LENGTH };
        let (function, factor) = self.history(&fields, "displacement", wanted)?;
        let at = fields.get("displacement").map_or(item.span.clone(), |n| n.span.clone());
        let read = self.about.functions_read[function].as_ref();
        let linear = read.and_then(|f| f.function.table());
        if linear.is_some_and(|t| t.interpolation() == Interpolation::Linear) {
            let name = self.about.functions.name(function);
            let message = format!(
                "`{name}` is a linear table: as a displacement its acceleration is a row of spikes"
            );
            let d = c.diagnostic("E0118", message, at);
            c.report(d.help(format!("write `interpolation: Cubic` in function `{name}`")));
            return None;
        }
        let supports = self.about.supports.iter().flatten();
        let fixed: HashSet<usize> =
            supports.filter(|s| s.fixed[dof.index()]).map(|s| s.node).collect();
        if let Some(node) = nodes.iter().find(|node| !fixed.contains(node)) {
            let name = self.about.nodes.name(*node);
            let message = format!("{} of node `{name}` is not fixed by a support", dof.name());
            let d = c.diagnostic("E0116", message, item.span.clone());
            let help = format!("add {} to `\"{name}\"` in `supports`", dof.name());
            c.report(d.help(help));
            return None;
        }
        let one = |node| SupportMotion { node, dof, function, factor };
        Some(nodes.into_iter().map(one).collect())
    }

    /// Of a node, or of each of several.
    fn initial(&self, item: &Node) -> Option<Vec<Initial>> {
        let c = self.c;
        let fields = c.block(item, "an initial value", schema::INITIAL.blocks[0])?;
        let (nodes, dof) = self.place(&fields);
        let dof = dof?;
        let (length, speed) =
            if dof.is_rotation() { (NONE, FREQUENCY) } else { (LENGTH, VELOCITY) };
        let one = |key, d| fields.get(key).map_or(Some(None), |n| c.number(n, d).map(Some));
        let (displacement, velocity) = (one("displacement", length), one("velocity", speed));
        let (displacement, velocity) = (displacement?, velocity?);
        if displacement.is_none() && velocity.is_none() {
            let d = c.diagnostic("E0104", "this initial value sets nothing", item.span.clone());
            c.report(d.help("give `displacement`, `velocity` or both"));
            return None;
        }
        let one = |node| Initial { node, dof, displacement, velocity };
        Some(nodes?.into_iter().map(one).collect())
    }

    fn place(&self, fields: &Fields<'_>) -> (Option<Vec<usize>>, Option<Dof>) {
        let c = self.c;
        let all = fields.required(c, "node").and_then(|n| several(c, n, self.about.nodes));
        let nodes = all.map(|all| all.into_iter().map(|(node, _)| node).collect());
        (nodes, fields.required(c, "dof").and_then(|n| c.dof(n)))
    }

    fn function(&self, fields: &Fields<'_>, wanted: Dimension) -> Option<(usize, f64)> {
        self.history(fields, "function", wanted)
    }

    /// The function that a field names and its factor, together of the wanted dimension.
    fn history(&self, fields: &Fields<'_>, key: &str, wanted: Dimension) -> Option<(usize, f64)> {
        let c = self.c;
        let node = fields.required(c, key)?;
        let index = self.about.functions.refer(c, node);
        let factor = fields
            .get("factor")
            .map_or(Some(crate::expression::Quantity::bare(1.0)), |n| c.quantity(n));
        let (index, factor) = (index?, factor?);
        let function = self.about.functions_read[index].as_ref()?;
        self.check_length(node, &function.function, &function.name);
        let (own, factor_dimension) = (function.dimension, factor.dimension);
        let found = own.unwrap_or(NONE) * factor_dimension;
        if own.is_none() && !factor.measured {
            // Plain numbers are in the file's units of what is wanted.
            return Some((index, factor.value * c.units_at(node).scale(wanted)));
        }
        if found.matches(wanted) {
            return Some((index, factor.value));
        }
        let name = |d: Dimension| if d.is_none() { "a pure number".into() } else { d.unit() };
        let message = format!(
            "function `{}` with its factor gives {}: must give {}",
            function.name,
            name(found),
            name(wanted)
        );
        let unit = if wanted.is_none() { "no unit".to_owned() } else { format!("`{wanted}`") };
        let d = c.diagnostic("E0111", message, node.span.clone());
        c.report(d.help(format!("its amplitude (or its table's `unit`) must be in {unit}")));
        None
    }

    fn check_length(&self, node: &Node, function: &crate::TimeFunction, name: &str) {
        let (Some(duration), Some(table)) = (self.duration, function.table()) else { return };
        let end = table.end();
        if table.after_end() != AfterEnd::Error || end >= duration * (1.0 - 1e-9) {
            return;
        }
        let message = format!("function `{name}` ends at {end} s, the case at {duration} s");
        let help = format!(
            "shorten `duration` to {end} s, or write `after_end: Zero` or `after_end: Hold` in the table"
        );
        let quoted = matches!(node.kind, Kind::Text(_) | Kind::Name(_));
        let label = if quoted { "too short" } else { "" };
        let d = self.c.diagnostic("E0118", message, node.span.clone());
        self.c.report(d.label(label).help(help));
    }
}
