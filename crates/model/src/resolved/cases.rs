//! Cases of a resolved model.

use super::BlockText;
use crate::named::Named;
use crate::schema;
use crate::{
    Analysis, BasisKind, Combination, CombinationTerm, DynamicCase, Load, Model, Solution,
    SolverKind, StepControl,
};
use trilith_element::dimension::{ACCELERATION, LENGTH, NONE};
use trilith_element::{Dimension, Dof};

pub(super) fn case(model: &Model, c: &crate::Case) -> String {
    let begin = |block| {
        let text = BlockText::new(block);
        match c.after {
            Some(i) => text.named("after", &model.cases[i].name),
            None => text,
        }
    };
    match &c.analysis {
        Analysis::Static(s) => {
            begin(&schema::STATIC).list("loads", loads(model, &s.loads)).count("steps", s.steps)
        }
        Analysis::Dynamic(d) => dynamic(model, d, begin(&schema::DYNAMIC)),
    }
    .end()
}

fn loads<'a>(model: &'a Model, all: &'a [Load]) -> impl Iterator<Item = String> + 'a {
    all.iter().map(|load| {
        match load {
            Load::Gravity { factor } => BlockText::new(&schema::GRAVITY).number("factor", *factor),
            Load::Pattern { pattern, factor } => {
                let text = BlockText::new(&schema::LOAD);
                text.named("load", &model.patterns[*pattern].name).number("factor", *factor)
            }
        }
        .end()
    })
}

fn dynamic(model: &Model, d: &DynamicCase, text: BlockText) -> BlockText {
    // What function and factor must give together decides the unit of the factor.
    let history = |text: BlockText, key, function: usize, by: f64, wanted: Dimension| {
        let f = &model.functions[function];
        let unit = f.dimension.map_or(NONE, |own| wanted / own);
        text.named(key, &f.name).quantity("factor", by, unit).end()
    };
    let block = |group: &schema::Group| BlockText::new(group.blocks[0]);
    let place = |text: BlockText, node: usize, dof: Dof| {
        text.named("node", &model.nodes[node].name).choice("dof", dof.name())
    };
    let base = d.base.iter().map(|b| {
        let text = block(&schema::BASE_MOTION);
        let direction = schema::BASE_DIRECTIONS[b.direction.index() % 3];
        let text = text.choice("direction", direction);
        history(text, "function", b.function, b.factor, ACCELERATION)
    });
    let forces = d.forces.iter().map(|f| {
        let text = block(&schema::FORCE_HISTORY).named("load", &model.patterns[f.pattern].name);
        history(text, "function", f.function, f.factor, NONE)
    });
    let supports = d.supports.iter().map(|s| {
        let wanted = if s.dof.is_rotation() { NONE } else { LENGTH };
        let text = place(block(&schema::SUPPORT_MOTION), s.node, s.dof);
        history(text, "displacement", s.function, s.factor, wanted)
    });
    let initial = d.initial.iter().map(|i| {
        let mut text = place(block(&schema::INITIAL), i.node, i.dof);
        for (key, x) in [("displacement", i.displacement), ("velocity", i.velocity)] {
            if let Some(x) = x {
                text = text.value(key, format!("{x:?}"));
            }
        }
        text.end()
    });
    let text = text.number("duration", d.duration).number("dt", d.dt);
    let text = text.list("constant", loads(model, &d.constant)).list("base", base);
    let text = text.list("forces", forces).list("supports", supports).list("initial", initial);
    solution(model, &d.solution, text)
}

fn solution(model: &Model, s: &Solution, text: BlockText) -> BlockText {
    let solver = SolverKind::ALL.iter().position(|kind| *kind == s.solver);
    let text = match (s.solver, solver) {
        (SolverKind::Custom { at, .. }, _) if at < model.solvers.len() => {
            let own = &model.solvers[at];
            let kind = BlockText::of_kind(own.card.kind).values(&own.values);
            text.value("solver", kind.end())
        }
        (SolverKind::Custom { name, .. }, _) => text.value("solver", name.into()),
        (_, at) => text.choice("solver", schema::SOLVERS[at.unwrap_or(0)]),
    };
    let step = match s.step {
        StepControl::Adaptive { tolerance } => {
            BlockText::new(&schema::ADAPTIVE).number("tolerance", tolerance)
        }
        StepControl::Fixed { substeps } => {
            BlockText::new(&schema::FIXED).count("substeps", substeps)
        }
    };
    let basis = BlockText::new(schema::BASES.blocks[s.basis.kind.index()]);
    let basis = match s.basis.kind {
        BasisKind::Complete => basis,
        BasisKind::Ritz | BasisKind::Eigen => s.basis.write(basis),
    };
    let text = s.write(text.value("step", step.end()));
    text.value("basis", basis.end()).number("alpha", s.alpha)
}

pub(super) fn combination(model: &Model, it: &Combination) -> String {
    let term = |(term, factor): &(CombinationTerm, f64)| {
        let name = match *term {
            CombinationTerm::Case(i) => &model.cases[i].name,
            CombinationTerm::Combination(i) => &model.combinations[i].name,
        };
        format!("{}: {factor:?}", super::text(name))
    };
    let terms: Vec<_> = it.terms.iter().map(term).collect();
    let block = schema::COMBINATIONS.blocks[it.how as usize];
    BlockText::new(block).value("cases", format!("{{ {} }}", terms.join(", "))).end()
}
