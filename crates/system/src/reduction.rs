//! Elimination of supports and constraints: every DOF as a combination of free and prescribed ones.
//!
//! `u_full = T [u_free; u_prescribed]`, exactly. Equations are eliminated one after the other with
//! substitution, so chains, shared nodes and redundant equations resolve; a constraint on a fixed DOF
//! passes the support on to the DOFs it is tied to. No mass is lost, because M is reduced with the same T. Nodes that
//! follow the rows of a superelement are eliminated likewise.

use crate::blame::answered;
use crate::finite_turns::{refuse_lever, turning_nodes};
use crate::inner::sparse;
use crate::sums::Sums;
use crate::{InnerRows, SystemError};
use std::collections::BTreeMap;
use trilith_model::{Body, Model};

/// The map from all DOFs (six a node, in node order) to free and prescribed ones.
#[derive(Clone, Debug)]
pub struct Reduction {
    /// What each DOF is.
    sums: Sums,
    /// Full index (6·node + direction) of each free DOF.
    pub free: Vec<usize>,
    /// Full index of each prescribed DOF.
    pub prescribed: Vec<usize>,
}

/// One constraint equation on full indices: Σ coefficient · u = 0.
struct Row {
    element: usize,
    dependent: usize,
    terms: Vec<(usize, f64)>,
}

impl Reduction {
    /// Eliminates. `used[i]` tells which full DOFs elements or links act on; the DOFs that used ones
    /// depend on are marked too.
    pub(crate) fn new(
        model: &Model,
        inner: &InnerRows,
        used: &mut [bool],
    ) -> Result<Self, SystemError> {
        let mut rows = constraint_rows(model)?;
        rows.extend(recovered_rows(model, inner));
        refuse_cycles(model, &rows)?;
        spread_use(&rows, used);
        let count = used.len();
        let mut prescribed_at = vec![false; count];
        for case in &model.cases {
            if let trilith_model::Analysis::Dynamic(d) = &case.analysis {
                for s in &d.supports {
                    prescribed_at[6 * s.node + s.dof.index()] = true;
                }
            }
        }
        let fixed = fixed_dofs(model, inner, count);
        let turning = turning_nodes(model)?;
        for row in rows.iter().filter(|_| !turning.is_empty()) {
            let dofs = row.terms.iter().filter(|(_, c)| *c != 0.0).map(|(full, _)| *full);
            let dofs = dofs.chain([row.dependent]);
            refuse_lever(model, &turning, row.element, dofs, |full| fixed[full])?;
        }
        let dependent = eliminated(model, &rows, &fixed, Leading::Always(&prescribed_at))?;
        Ok(Self::number(count, used, &fixed, &prescribed_at, &dependent))
    }

    /// Eliminates by what the elements that are flagged say, as if the model had no others and no supports. Directions that
    /// are `kept` lead the others, and are counted as prescribed ones are; one follows others where all that an equation
    /// ties are kept.
    pub(crate) fn of_part(
        model: &Model,
        inner: &InnerRows,
        flags: &[bool],
        kept: impl Fn(usize) -> bool,
        used: &mut [bool],
    ) -> Result<Self, SystemError> {
        let mut rows = constraint_rows(model)?;
        rows.extend(recovered_rows(model, inner));
        rows.retain(|row| flags[row.element]);
        spread_use(&rows, used);
        let mut fixed = vec![false; used.len()];
        fix_out_of_plane(model, inner, &mut fixed);
        let kept: Vec<bool> =
            (0..used.len()).map(|full| used[full] && !fixed[full] && kept(full)).collect();
        fixed.iter_mut().zip(&kept).for_each(|(fixed, kept)| *fixed |= kept);
        let dependent = eliminated(model, &rows, &fixed, Leading::Rather(&kept))?;
        Ok(Self::number(used.len(), used, &fixed, &kept, &dependent))
    }

    fn number(
        count: usize,
        used: &[bool],
        fixed: &[bool],
        prescribed_at: &[bool],
        dependent: &BTreeMap<usize, Vec<(usize, f64)>>,
    ) -> Self {
        let free: Vec<usize> =
            (0..count).filter(|i| used[*i] && !fixed[*i] && !dependent.contains_key(i)).collect();
        let leads = |i: &usize| prescribed_at[*i] && !dependent.contains_key(i);
        let prescribed: Vec<usize> = (0..count).filter(leads).collect();
        let mut place = vec![usize::MAX; count];
        for (new, old) in free.iter().chain(&prescribed).enumerate() {
            place[*old] = new;
        }
        let mut sums = Sums::with_capacity(count);
        for i in 0..count {
            if dependent.contains_key(&i) {
                let sum = substitute(vec![(i, 1.0)], dependent);
                let kept = sum.into_iter().filter(|(j, c)| place[*j] != usize::MAX && *c != 0.0);
                sums.push(kept.map(|(j, c)| (place[j], c)));
            } else {
                sums.push((place[i] != usize::MAX).then_some((place[i], 1.0)));
            }
        }
        Self { sums, free, prescribed }
    }

    /// Counts a direction as free that nothing acts on, where every other is fixed or prescribed: solvers step at least
    /// one equation. No DOF follows it.
    pub(crate) fn add_idle(&mut self) {
        self.free.push(0);
        // Prescribed ones are counted behind the free ones.
        self.sums.terms.iter_mut().for_each(|(i, _)| *i += 1);
    }

    /// Number of free DOFs.
    #[must_use]
    pub fn order(&self) -> usize {
        self.free.len()
    }

    /// A full DOF as (index, factor) of free DOFs and, from [`order`](Self::order) on, prescribed ones.
    #[must_use]
    pub fn expand(&self, full: usize) -> &[(usize, f64)] {
        self.sums.get(full)
    }
}

/// Directions that lead others.
#[derive(Clone, Copy)]
enum Leading<'a> {
    /// They follow nothing.
    Always(&'a [bool]),
    /// They follow where an equation ties no others.
    Rather(&'a [bool]),
}

/// What follows what: each equation makes one direction follow the others in it, the one that it names where that is
/// free to.
fn eliminated(
    model: &Model,
    rows: &[Row],
    fixed: &[bool],
    leading: Leading<'_>,
) -> Result<BTreeMap<usize, Vec<(usize, f64)>>, SystemError> {
    let (Leading::Always(leads) | Leading::Rather(leads)) = leading;
    let mut dependent: BTreeMap<usize, Vec<(usize, f64)>> = BTreeMap::new();
    for row in rows {
        let own = [(row.dependent, 1.0)];
        let sum = collected(own.into_iter().chain(row.terms.iter().map(|(i, c)| (*i, -c))));
        let sum = substitute(sum, &dependent);
        let left: Vec<(usize, f64)> =
            sum.into_iter().filter(|(i, c)| c.abs() > 1e-12 && (!fixed[*i] || leads[*i])).collect();
        if left.is_empty() {
            continue;
        }
        let one_of = |may: &dyn Fn(usize) -> bool| {
            let candidates = || left.iter().filter(|(i, _)| may(*i));
            let named = candidates().find(|(i, _)| *i == row.dependent);
            named.or_else(|| candidates().max_by(|a, b| a.1.abs().total_cmp(&b.1.abs())))
        };
        let pivot = one_of(&|i| !leads[i]).or_else(|| match leading {
            Leading::Always(_) => None,
            Leading::Rather(_) => one_of(&|_| true),
        });
        let Some(&(p, c)) = pivot else {
            let e = &model.elements[row.element];
            return Err(SystemError::Overdetermined {
                element: e.name.clone(),
                span: e.span.clone(),
            });
        };
        let rest = left.iter().filter(|(i, _)| *i != p).map(|(i, x)| (*i, -x / c)).collect();
        dependent.insert(p, rest);
    }
    Ok(dependent)
}

fn constraint_rows(model: &Model) -> Result<Vec<Row>, SystemError> {
    let mut rows = Vec::new();
    for (element, e) in model.elements.iter().enumerate() {
        let Body::Constraint(constraint) = &e.body else { continue };
        let positions: Vec<_> = e.nodes.iter().map(|n| model.nodes[*n].position).collect();
        let refuse = |reason: String| SystemError::Element {
            element: e.name.clone(),
            reason,
            span: e.span.clone(),
        };
        let equations = answered(|| constraint.equations(&positions))
            .map_err(|said| refuse(format!("its equations panicked: {said}")))?
            .map_err(|x| refuse(x.to_string()))?;
        for equation in &equations {
            equation.check(e.nodes.len()).map_err(|fault| refuse(fault.to_string()))?;
        }
        let full = |(node, dof): (usize, trilith_element::Dof)| 6 * e.nodes[node] + dof.index();
        rows.extend(equations.iter().map(|q| Row {
            element,
            dependent: full(q.dependent),
            terms: q.terms.iter().map(|(at, c)| (full(*at), *c)).collect(),
        }));
    }
    Ok(rows)
}

/// Directions that follow the rows of an element with sparse matrices.
fn recovered_rows<'a>(model: &'a Model, inner: &'a InnerRows) -> impl Iterator<Item = Row> + 'a {
    model.elements.iter().enumerate().flat_map(move |(element, e)| {
        let own = sparse(e).zip(inner.places(element));
        own.into_iter().flat_map(move |(own, places)| {
            own.recovered.iter().map(move |led| Row {
                element,
                dependent: 6 * e.nodes[led.node] + led.dof.index(),
                terms: led
                    .terms
                    .iter()
                    .map(|(row, share)| (places[*row as usize], *share))
                    .collect(),
            })
        })
    })
}

/// Declared dependencies must not run in a circle; the elimination could resolve one, but it never
/// is what the author of the model meant.
fn refuse_cycles(model: &Model, rows: &[Row]) -> Result<(), SystemError> {
    let mut dependents: Vec<usize> = rows.iter().map(|row| row.dependent).collect();
    dependents.sort_unstable();
    let follows = |(i, c): &(usize, f64)| *c != 0.0 && dependents.binary_search(i).is_ok();
    if !rows.iter().flat_map(|row| &row.terms).any(follows) {
        return Ok(());
    }
    let mut follows: BTreeMap<usize, Vec<&Row>> = BTreeMap::new();
    for row in rows {
        follows.entry(row.dependent).or_default().push(row);
    }
    let mut done: BTreeMap<usize, bool> = BTreeMap::new();
    for start in follows.keys() {
        let mut path: Vec<(usize, usize)> = Vec::new();
        if let Some(elements) = circle(*start, &follows, &mut done, &mut path) {
            let span = model.elements[elements[0]].span.clone();
            let elements =
                elements.iter().map(|e| format!("\"{}\"", model.elements[*e].name)).collect();
            return Err(SystemError::Cycle { elements, span });
        }
    }
    Ok(())
}

/// Depth-first search; returns the elements of a circle through `at`.
fn circle(
    at: usize,
    follows: &BTreeMap<usize, Vec<&Row>>,
    done: &mut BTreeMap<usize, bool>,
    path: &mut Vec<(usize, usize)>,
) -> Option<Vec<usize>> {
    match done.get(&at) {
        Some(true) => return None,
        Some(false) => {
            let from = path.iter().position(|(i, _)| *i == at).unwrap_or(0);
            let mut elements: Vec<usize> = path[from..].iter().map(|(_, e)| *e).collect();
            elements.sort_unstable();
            elements.dedup();
            return Some(elements);
        }
        None => {}
    }
    done.insert(at, false);
    for row in follows.get(&at).into_iter().flatten() {
        for (next, _) in row.terms.iter().filter(|(_, c)| *c != 0.0) {
            path.push((at, row.element));
            let found = circle(*next, follows, done, path);
            path.pop();
            if found.is_some() {
                return found;
            }
        }
    }
    done.insert(at, true);
    None
}

fn spread_use(rows: &[Row], used: &mut [bool]) {
    loop {
        let mut grown = false;
        for row in rows.iter().filter(|r| used[r.dependent]).map(|r| &r.terms).collect::<Vec<_>>() {
            for (i, c) in row {
                if *c != 0.0 && !used[*i] {
                    used[*i] = true;
                    grown = true;
                }
            }
        }
        if !grown {
            return;
        }
    }
}

fn fixed_dofs(model: &Model, inner: &InnerRows, count: usize) -> Vec<bool> {
    let mut fixed = vec![false; count];
    for support in &model.supports {
        for (i, f) in support.fixed.iter().enumerate() {
            fixed[6 * support.node + i] |= f;
        }
    }
    fix_out_of_plane(model, inner, &mut fixed);
    fixed
}

fn fix_out_of_plane(model: &Model, inner: &InnerRows, fixed: &mut [bool]) {
    if let Some(plane) = model.plane {
        let stay = plane.dofs().map(|d| d.index());
        for (i, f) in fixed.iter_mut().enumerate() {
            // An inner row of no direction may be one of the plane.
            *f |= inner.dof(i).is_some_and(|dof| !stay.contains(&dof.index()));
        }
    }
}

/// Terms by rising DOF, those of one DOF added up in their order.
fn collected(terms: impl Iterator<Item = (usize, f64)>) -> Vec<(usize, f64)> {
    let mut all: Vec<(usize, f64)> = terms.collect();
    all.sort_by_key(|term| term.0);
    all.dedup_by(|next, sum| {
        let same = next.0 == sum.0;
        if same {
            sum.1 += next.1;
        }
        same
    });
    all
}

/// Replaces dependent DOFs until none is left. Stored expressions hold no DOF that was dependent when
/// they were stored, so this ends.
fn substitute(
    sum: Vec<(usize, f64)>,
    dependent: &BTreeMap<usize, Vec<(usize, f64)>>,
) -> Vec<(usize, f64)> {
    let (mut open, mut result) = (sum, Vec::new());
    while let Some((i, c)) = open.pop() {
        match dependent.get(&i) {
            Some(terms) => open.extend(terms.iter().map(|(j, x)| (*j, c * x))),
            None => result.push((i, c)),
        }
    }
    collected(result.into_iter())
}
