//! A smaller structure that fails alike.

use super::judge::{Verdict, WORK, judge, reference};
use super::spec::{Basis, Damping, Kind, Spec};
use trilith::SolverKind;

/// Whether a description still fails.
fn fails(spec: &Spec, solver: SolverKind) -> bool {
    let Ok(found) = reference(spec, WORK) else { return false };
    matches!(
        judge(spec, &found, solver),
        Verdict::Failed(..) | Verdict::Panicked(_) | Verdict::Warned(..)
    )
}

/// All descriptions that lack something.
fn smaller(spec: &Spec) -> Vec<Spec> {
    let mut all = Vec::new();
    let mut add = |change: &dyn Fn(&mut Spec)| {
        let mut it = spec.clone();
        change(&mut it);
        all.push(it);
    };
    if spec.moved.len() + spec.base.len() + spec.forces.len() + spec.initial.len() > 1 {
        (0..spec.moved.len()).for_each(|i| {
            add(&|s| {
                s.moved.remove(i);
            })
        });
        (0..spec.base.len()).for_each(|i| {
            add(&|s| {
                s.base.remove(i);
            })
        });
        (0..spec.forces.len()).for_each(|i| {
            add(&|s| {
                s.forces.remove(i);
            })
        });
        (0..spec.initial.len()).for_each(|i| {
            add(&|s| {
                s.initial.remove(i);
            })
        });
    }
    if !matches!(spec.damping, Damping::None) {
        add(&|s| s.damping = Damping::None);
    }
    if spec.gravity {
        add(&|s| s.gravity = false);
    }
    if spec.tolerance.is_some() {
        add(&|s| s.tolerance = None);
    }
    if !matches!(spec.basis, Basis::Ritz) {
        add(&|s| s.basis = Basis::Ritz);
    }
    if spec.outputs.len() > 1 {
        (0..spec.outputs.len()).for_each(|i| {
            add(&|s| {
                s.outputs.remove(i);
            })
        });
    }
    for i in 0..spec.members.len() {
        let named = spec.outputs.iter().any(|o| {
            use super::spec::Output::{End, LinkDeformation, LinkForce};
            matches!(o, LinkForce(e, _) | LinkDeformation(e, _) | End(e, ..) if *e == i)
        });
        if !named {
            add(&|s| remove(s, i));
        }
    }
    // The last node with everything on it.
    for n in (0..spec.nodes.len()).rev() {
        let used = spec.outputs.iter().any(|o| {
            use super::spec::Output::{Acceleration, Displacement, Drift, Velocity};
            matches!(o, Displacement(m, _) | Velocity(m, _) | Acceleration(m, _) if *m == n)
                || matches!(o, Drift(a, b, _) if *a == n || *b == n)
        });
        let held = spec.members.iter().any(|m| {
            m.nodes.contains(&n)
                && (m.nodes.len() > 1 && matches!(m.kind, Kind::Diaphragm | Kind::RigidBody))
        });
        let loaded = spec.forces.iter().any(|f| f.node == n)
            || spec.initial.iter().any(|x| x.0 == n)
            || spec.moved.iter().any(|x| x.0 == n);
        if !used && !held && !loaded && spec.nodes.len() > 1 {
            add(&|s| {
                let gone: Vec<usize> =
                    (0..s.members.len()).filter(|i| s.members[*i].nodes.contains(&n)).collect();
                gone.into_iter().rev().for_each(|i| remove(s, i));
            });
        }
        if !spec.fixed[n].iter().all(|x| *x) && !loaded {
            add(&|s| s.fixed[n] = [true; 6]);
        }
    }
    if spec.duration > 2.0 * spec.dt {
        add(&|s| {
            let steps = (s.duration / s.dt).round();
            s.duration = s.dt * (steps / 2.0).ceil();
        });
    }
    all
}

/// Takes a member out; outputs count on.
fn remove(spec: &mut Spec, i: usize) {
    use super::spec::Output::{End, LinkDeformation, LinkForce};
    spec.members.remove(i);
    spec.outputs
        .retain(|o| !matches!(o, LinkForce(e, _) | LinkDeformation(e, _) | End(e, ..) if *e == i));
    for o in &mut spec.outputs {
        if let LinkForce(e, _) | LinkDeformation(e, _) | End(e, ..) = o
            && *e > i
        {
            *e -= 1;
        }
    }
}

/// The smallest that was found within so many trials.
#[must_use]
pub fn shrink(spec: &Spec, solver: SolverKind, trials: usize) -> Spec {
    let mut best = spec.clone();
    let mut left = trials;
    'again: loop {
        for it in smaller(&best) {
            if left == 0 {
                return best;
            }
            left -= 1;
            if !it.outputs.is_empty() && fails(&it, solver) {
                best = it;
                continue 'again;
            }
        }
        return best;
    }
}
