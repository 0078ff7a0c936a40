//! One substep, differentiated by every parameter.

use super::bends::{Bend, Bends};
use super::influence::Influence;
use super::input::{InputMoves, Moved};
use super::laws::{LawMoves, Made};
use super::moving::MovingBasis;
use crate::error::SolveError;
use crate::kernel::{Jacobian, Layout, Wanted};
use crate::run::Prepared;
use crate::step::{Forces, Propagator, State};
use crate::structure::{Followers, acceleration};
use trilith_model::{Model, Side, SolverKind};
use trilith_system::{LinkSet, LoadSet};

/// The derivatives of the state, which go with a run.
pub(super) struct Moves<'a> {
    links: &'a LinkSet,
    propagator: Box<dyn Propagator + 'a>,
    alpha: f64,
    layout: Layout<'a>,
    followers: Followers,
    laws: LawMoves<'a>,
    influences: &'a [Influence<'a>],
    /// The bases that move with their parameters.
    moving: Vec<Option<MovingBasis<'a>>>,
    loads_of_run: &'a LoadSet,
    /// Of the energy put in, where somebody wants it.
    input: Option<InputMoves<'a>>,
    bends: Bends,
    model: &'a Model,
    /// Output step, s, and values of the parameters.
    output: f64,
    values: Vec<f64>,
    /// The state at the start of the substep, and its time, s.
    from: State,
    t: f64,
    /// Derivatives of it, and place for those at the end.
    now: Vec<State>,
    next: Vec<State>,
    /// Pseudo-loads at the start.
    loads: Vec<Vec<f64>>,
    /// True where amplitudes or states have jumped since.
    stale: bool,
    work: Work,
}

/// What a substep needs beside.
struct Work {
    ends: Vec<Vec<f64>>,
    /// What bases that move have in the motion at the end; empty for others.
    moved: Vec<Vec<f64>>,
    d: Vec<f64>,
    v: Vec<f64>,
    own: Vec<f64>,
}

impl<'a> Moves<'a> {
    pub(super) fn new(
        prepared: &'a Prepared<'a>,
        influences: &'a [Influence<'a>],
        moving: Vec<Option<MovingBasis<'a>>>,
        mut propagator: Box<dyn Propagator + 'a>,
        state: &State,
    ) -> Result<Self, SolveError> {
        let links = &prepared.system.links;
        let laws = links.laws(prepared.model);
        let effective = links.active.iter().map(|i| links.effective[*i]).collect();
        let layout = Layout::new(links, &laws, effective);
        let followers = match prepared.kind == SolverKind::Fna {
            true => {
                propagator.set_rates(&layout.rate_dependent, &layout.damped)?;
                Followers::default()
            }
            // Which way they go is decided by the run: see `complete_moves`.
            false => Followers::new(propagator.space(), &layout.damped)?,
        };
        propagator.follow_work(false);
        let now: Vec<State> = influences.iter().map(|i| i.start.clone()).collect();
        let n = propagator.space().order();
        Ok(Self {
            links,
            alpha: match prepared.kind {
                SolverKind::Fna => 0.0,
                _ => prepared.analysis.solution.alpha,
            },
            layout,
            followers,
            laws: LawMoves::new(prepared.model, links, influences, state),
            influences,
            moving,
            input: None,
            loads_of_run: &prepared.loads,
            bends: Bends::default(),
            model: prepared.model,
            output: prepared.dt,
            values: influences.iter().map(|i| i.around.of.value).collect(),
            from: state.clone(),
            t: 0.0,
            next: now.clone(),
            loads: vec![vec![0.0; n]; now.len()],
            stale: true,
            work: Work {
                ends: vec![vec![0.0; n]; now.len()],
                moved: vec![Vec::new(); now.len()],
                d: vec![0.0; links.active.len()],
                v: Vec::new(),
                own: vec![0.0; links.active.len()],
            },
            now,
            propagator,
        })
    }

    /// Derivatives of the state by every parameter.
    pub(super) fn now(&self) -> &[State] {
        &self.now
    }

    /// Derivatives of the heat of every link so far, by each parameter.
    pub(super) fn heat(&self) -> &[Vec<f64>] {
        self.laws.heat()
    }

    /// From the start on, derives the energy that loads and supports put in.
    pub(super) fn follow_input(&mut self) {
        let start = (&self.from, &self.now[..]);
        let flat = self.links.len();
        self.propagator.follow_work(true);
        self.moving.iter_mut().flatten().for_each(MovingBasis::follow_work);
        let input =
            InputMoves::new(self.loads_of_run, self.influences, flat, &*self.propagator, start);
        self.input = Some(input);
    }

    /// Derivatives of the energy that loads and supports have put in until this state, where it is followed.
    pub(super) fn input(&self, state: &State) -> Option<Vec<f64>> {
        let input = self.input.as_ref()?;
        Some(input.until(&*self.propagator, state, &self.now))
    }

    /// Links whose laws have bent where substeps ended.
    pub(super) fn bends(&self) -> Vec<Bend> {
        self.bends.told(self.model, self.links)
    }

    /// The time of the state that they are of, s.
    pub(super) fn time(&self) -> f64 {
        self.t
    }

    /// The loads have jumped: to a state in which accelerations follow. `change`: that of the amplitudes.
    pub(super) fn jump(&mut self, t: f64, change: &[f64], state: &State) -> Result<(), SolveError> {
        let space = self.propagator.space();
        let n = space.order();
        let force = space.force(change);
        let by = self.propagator.acceleration(&force)?;
        let flat = self.links.len();
        let all = self.influences.iter().zip(&mut self.moving);
        for ((influence, moving), now) in all.zip(&mut self.now) {
            if let Some(moving) = moving {
                accelerate(&moving.jump(t)?, &state.motion[2 * n..], &mut now.motion[2 * n..]);
                continue;
            }
            let mut force = vec![0.0; n];
            if let Some(loads) = &influence.loads {
                let side = |side| loads.at(influence.step, t, side, flat);
                let ([before, ..], [behind, ..]) = (side(Side::Before), side(Side::After));
                force
                    .iter_mut()
                    .zip(behind.iter().zip(&before))
                    .for_each(|(p, (a, b))| *p += a - b);
            }
            if let Some(structure) = &influence.structure {
                let by: Vec<f64> = by.iter().map(|a| acceleration(*a)).collect();
                structure.mass.mul_add(-1.0, &by, &mut force);
            }
            let more = self.propagator.acceleration(&force)?;
            accelerate(&more, &state.motion[2 * n..], &mut now.motion[2 * n..]);
        }
        self.from.clone_from(state);
        self.stale = true;
        Ok(())
    }

    /// Pseudo-loads in a state, where amplitudes are those of this side.
    fn loads_at(
        influence: &Influence<'_>,
        links: &LinkSet,
        t: f64,
        side: Side,
        state: &State,
        p: &mut [f64],
    ) -> [Vec<f64>; 2] {
        let mut support = [Vec::new(), Vec::new()];
        p.fill(0.0);
        if let Some(loads) = &influence.loads {
            let [own, d, v] = loads.at(influence.step, t, side, links.len());
            // A basis that moves has its loads in its steps.
            if influence.turns.is_none() {
                p.copy_from_slice(&own);
            }
            support = [d, v];
        }
        if let Some(structure) = &influence.structure {
            let n = p.len();
            let force = |a: usize| state.f[links.active[a]];
            structure.resist(&state.motion[..n], &state.motion[n..2 * n], force, p);
        }
        support
    }

    /// A substep of this length was accepted.
    pub(super) fn step(&mut self, to: &State, t: f64, dt: f64) -> Result<(), SolveError> {
        let Self {
            links,
            propagator,
            alpha,
            layout,
            followers,
            laws,
            influences,
            moving,
            input,
            from,
            work,
            ..
        } = self;
        let key = propagator.choose(dt, &mut links.stiffness(&from.tangents), &from.stiffest);
        propagator.prepare(&key)?;
        let n = propagator.space().order();
        // Loads, and what is known of the deformations at the end.
        for (j, influence) in influences.iter().enumerate() {
            if self.stale {
                Self::loads_at(influence, links, self.t, Side::After, from, &mut self.loads[j]);
            }
            let end = &mut work.ends[j];
            let [d, v] = Self::loads_at(influence, links, t, Side::Before, to, end);
            let next = &mut self.next[j];
            for (own, support) in [(&mut next.d, d), (&mut next.v, v)] {
                if support.is_empty() { own.fill(0.0) } else { own.copy_from_slice(&support) }
            }
            if let Some(rows) = &influence.rows {
                for (row, flat) in rows.iter().zip(&links.active) {
                    next.d[*flat] += row.iter().map(|(i, c)| c * to.motion[*i]).sum::<f64>();
                    next.v[*flat] += row.iter().map(|(i, c)| c * to.motion[n + i]).sum::<f64>();
                }
            }
        }
        let made = Made { from, to, dt };
        laws.along(made, &self.now, &mut self.next, false);
        let factor = Jacobian::new(layout, propagator.compliance(), &to.tangents);
        work.v.resize(layout.rate_dependent.len(), 0.0);
        for (j, influence) in influences.iter().enumerate() {
            let (now, next) = (&self.now[j], &mut self.next[j]);
            let mut end = work.ends[j].clone();
            if let Some(structure) = &influence.structure {
                let a: Vec<f64> = to.motion[2 * n..].iter().map(|a| acceleration(*a)).collect();
                structure.mass.mul_add(-1.0 / (1.0 + *alpha), &a, &mut end);
            }
            let loads = [&self.loads[j][..], &end[..]];
            let forces = Forces { loads, pseudo0: &now.pseudo, pseudo1: &now.pseudo };
            let wanted =
                Wanted { d: &mut work.d, v: &mut work.v, rate_dependent: &layout.rate_dependent };
            next.motion.resize(3 * n, 0.0);
            propagator.predict(&now.motion, &forces, &mut next.motion, wanted);
            if let Some(moving) = &mut moving[j] {
                work.moved[j] = moving.step([from, to], [self.t, t], &key)?;
                let moved = &work.moved[j];
                let map = &propagator.space().links;
                map.deform(&moved[..n], &mut work.own);
                work.d.iter_mut().zip(&work.own).for_each(|(d, x)| *d += x);
                map.deform(&moved[n..2 * n], &mut work.own);
                let rated = layout.rate_dependent.iter().zip(&mut work.v);
                rated.for_each(|(a, v)| *v += work.own[*a]);
            }
            // f̃ at the end.
            let mut rates = vec![0.0; now.pseudo.len()];
            layout.rate_dependent.iter().zip(&work.v).for_each(|(a, v)| rates[*a] = *v);
            let mut x: Vec<f64> = (links.active.iter().enumerate())
                .map(|(a, flat)| {
                    next.f[*flat] - now.pseudo[a]
                        + layout.linear(a, &to.tangents, [&work.d, &rates])
                })
                .collect();
            factor.solve(&mut x);
            x.iter_mut().zip(&now.pseudo).for_each(|(x, f)| *x += f);
            next.pseudo.clone_from(&x);
            let forces = Forces { loads, pseudo0: &now.pseudo, pseudo1: &next.pseudo };
            propagator.correct(&now.motion, &forces, &mut next.motion);
            next.motion.iter_mut().zip(&work.moved[j]).for_each(|(x, by)| *x += by);
            followers.complete_moves([&from.motion, &to.motion], &now.motion, &mut next.motion, dt);
            let map = &propagator.space().links;
            for (order, own) in [(0, &mut next.d), (1, &mut next.v)] {
                map.deform(&next.motion[order * n..(order + 1) * n], &mut work.own);
                links.active.iter().zip(&work.own).for_each(|(flat, x)| own[*flat] += x);
            }
        }
        laws.along(made, &self.now, &mut self.next, true);
        if let Some(input) = input {
            let of_run = input.loads([self.t, t], propagator.space());
            for (j, (now, next)) in self.now.iter().zip(&self.next).enumerate() {
                let basis = moving[j].as_ref().map(|m| (&*work.moved[j], m.work()));
                let moved = Moved { states: [&*from, to], by: [now, next], basis };
                input.enter(j, &mut **propagator, &of_run, &moved);
            }
        }
        laws.see(to);
        if Bends::matters(dt, self.output) {
            let ends = [&self.now[..], &self.next[..]];
            self.bends.look(self.model, links, (made, t), ends, &self.values);
        }
        std::mem::swap(&mut self.now, &mut self.next);
        std::mem::swap(&mut self.loads, &mut self.work.ends);
        from.clone_from(to);
        self.t = t;
        self.stale = false;
        Ok(())
    }
}

/// Derivatives of accelerations that follow a jump of loads by `more`; `of`: the accelerations behind it.
fn accelerate(more: &[f64], of: &[f64], to: &mut [f64]) {
    for ((to, more), now) in to.iter_mut().zip(more).zip(of) {
        *to = if *now == crate::structure::JUMPED { 0.0 } else { *to + acceleration(*more) };
    }
}
