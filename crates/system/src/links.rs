//! The links of a system: maps B, flat deformations and history, evaluation of all laws.
//!
//! Flat arrays hold the coordinates of link after link, `n` for each, also those that the reduced
//! structure cannot deform (their row of B is empty). `active` lists the others; the link equations are
//! solved on the active ones.

use serde::{Deserialize, Serialize};
use std::ops::Range;
use std::sync::Arc;
use trilith_element::{Coordinates, Dof, Energy, Kinematics, Link, Response};
use trilith_model::{Body, Model};

use crate::batch::{Pack, packs};
use crate::blame::{answered, blaming};
use crate::dampers::Damper;
use crate::leaning::{Leaning, TILTS};
use crate::link_rows::{all_rows, tilt_row};
use crate::{Reduction, SystemError};

/// One link in the flat arrays.
#[derive(Clone, Debug)]
pub struct LinkInstance {
    /// Index of the element in the model.
    pub element: usize,
    /// Its coordinates in the flat arrays.
    pub range: Range<usize>,
    /// Its blocks (n² values) in the flat tangents.
    pub block: Range<usize>,
    /// Its variables in the history arrays.
    pub history: Range<usize>,
    /// How many of them, at the end, are tilts that the model's law does not know.
    pub tilts: usize,
    /// The law that runs in place of the model's, where the assembly had to complete it.
    pub settled: Option<Arc<dyn Link>>,
}

/// Tangents of all links: blocks of n² values, row by row.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Tangents {
    /// ∂f/∂d.
    pub k: Vec<f64>,
    /// ∂f/∂ḋ.
    pub c: Vec<f64>,
}

/// All links of a system.
#[derive(Clone, Debug, Default)]
pub struct LinkSet {
    /// The links in model order.
    pub links: Vec<LinkInstance>,
    /// Flat indices of the coordinates that the structure can deform.
    pub active: Vec<usize>,
    /// Row of B for each flat coordinate, over the free DOFs.
    pub rows: Vec<Vec<(usize, f64)>>,
    /// Row of B for each flat coordinate, over the prescribed DOFs.
    pub support_rows: Vec<Vec<(usize, f64)>>,
    /// True for coordinates that are rotations.
    pub rotational: Vec<bool>,
    /// True where some are.
    pub turns: bool,
    /// Effective stiffness of each flat coordinate: what the user has set, and where links alone hold a direction
    /// without mass, what the assembly has given them; else 0.
    pub effective: Vec<f64>,
    /// Length of the history arrays.
    pub history_len: usize,
    /// Length of the flat tangents.
    pub block_len: usize,
    /// Place of the own stiffness of each active coordinate in the flat tangents.
    pub diagonal: Vec<usize>,
}

/// DOFs that the links act on: translations always, rotations where a law deforms them.
pub(crate) fn mark_used(model: &Model, used: &mut [bool]) {
    for e in &model.elements {
        let Body::Link(law, options) = &e.body else { continue };
        for axis in &e.frame.0[1..] {
            tilt_row(e, options, axis).into_iter().for_each(|(full, _)| used[full] = true);
        }
        match law.coordinates() {
            Coordinates::Local(axes) => {
                for axis in axes {
                    let a = axis.index();
                    for (k, x) in e.frame.0[a % 3].iter().enumerate() {
                        if x.abs() > 1e-12 {
                            for n in &e.nodes {
                                used[6 * n + k + 3 * (a / 3)] = true;
                            }
                        }
                    }
                }
            }
            Coordinates::Nodal { .. } => {
                for n in &e.nodes {
                    used[6 * n..6 * n + 6].fill(true);
                }
            }
        }
    }
}

/// The laws of all links with their places in the flat arrays.
#[derive(Clone, Debug)]
pub struct Laws<'a> {
    all: Vec<(&'a dyn Link, &'a LinkInstance)>,
    /// True for each that looks at rates.
    rated: Vec<bool>,
    /// What the others get for rates: no numbers, so that one that looks at them all the same is found out.
    none: Vec<f64>,
}

impl<'a> Laws<'a> {
    fn new(all: Vec<(&'a dyn Link, &'a LinkInstance)>) -> Self {
        let rated = all.iter().map(|(law, _)| law.uses_rates()).collect();
        let longest = all.iter().map(|(_, link)| link.range.len()).max().unwrap_or(0);
        Self { all, rated, none: vec![f64::NAN; longest] }
    }

    /// The laws in model order.
    pub fn iter(&self) -> impl Iterator<Item = (&'a dyn Link, &'a LinkInstance)> + '_ {
        self.all.iter().copied()
    }

    /// Evaluates all laws at (d, v) from the committed history. Writes forces, tangents, trial history, and
    /// the energies of each link.
    pub fn respond(
        &self,
        at: Kinematics<'_>,
        committed: &[f64],
        trial: &mut [f64],
        f: &mut [f64],
        tangents: &mut Tangents,
        energy: &mut [Energy],
    ) {
        for (i, energy) in energy.iter_mut().enumerate() {
            self.respond_one(i, at, committed, trial, f, tangents, energy);
        }
    }

    /// The same of one link.
    #[inline]
    fn respond_one(
        &self,
        i: usize,
        at: Kinematics<'_>,
        committed: &[f64],
        trial: &mut [f64],
        f: &mut [f64],
        tangents: &mut Tangents,
        energy: &mut Energy,
    ) {
        let (law, link) = self.all[i];
        let r = link.range.clone();
        let none = &self.none[..r.len()];
        let (v, v0) =
            if self.rated[i] { (&at.v[r.clone()], &at.v0[r.clone()]) } else { (none, none) };
        let (k, c) = (&mut tangents.k[link.block.clone()], &mut tangents.c[link.block.clone()]);
        let f = &mut f[r.clone()];
        [&mut *f, &mut *k, &mut *c].into_iter().for_each(|x| x.fill(0.0));
        *energy = Energy::default();
        let at = Kinematics::new([&at.d[r.clone()], v], [&at.d0[r], v0], at.dt);
        let (committed, trial) =
            (&committed[link.history.clone()], &mut trial[link.history.clone()]);
        blaming(link.element, || {
            law.respond(&at, committed, trial, &mut Response::new(f, k, c, energy));
        });
    }
}

/// Where the answers of all links go, flat. What is the same at all times in the tangents of a law is there before.
pub struct Answers<'a> {
    /// Trial history.
    pub history: &'a mut [f64],
    /// Forces.
    pub f: &'a mut [f64],
    /// Tangents.
    pub tangents: &'a mut Tangents,
    /// Energies of each link.
    pub energy: &'a mut [Energy],
}

/// The laws of all links as the iteration of a step asks them: links of one kind side by side where their law has
/// a form for that, and their history and energies once, at the end.
#[derive(Debug)]
pub struct StepLaws<'a> {
    laws: Laws<'a>,
    dampers: Vec<Damper>,
    packs: Vec<Box<dyn Pack>>,
    /// Indices of links that are asked one by one.
    alone: Vec<usize>,
}

impl<'a> StepLaws<'a> {
    /// Of these laws.
    #[must_use]
    pub fn new(laws: Laws<'a>) -> Self {
        let dampers: Vec<Damper> = laws
            .iter()
            .enumerate()
            .filter_map(|(i, (law, link))| Damper::of(i, law, link))
            .collect();
        let mut taken = vec![false; laws.all.len()];
        dampers.iter().for_each(|d| taken[d.link] = true);
        let rest = (0..laws.all.len()).filter(|i| !taken[*i]).collect();
        let (packs, alone) = packs(&laws.all, rest);
        Self { laws, dampers, packs, alone }
    }

    /// Takes up a step: of `at` the deformations and rates at the start, and the length.
    #[inline]
    pub fn start(&mut self, at: &Kinematics<'_>, committed: &[f64]) {
        self.packs.iter_mut().for_each(|pack| pack.start(at, committed));
    }

    /// Forces at (d, v) in the step taken up last; history and energies may wait for the [end](Self::end), and tangents
    /// as well unless this is the `last`: unless the step may well end here.
    pub fn respond(
        &mut self,
        at: &Kinematics<'_>,
        last: bool,
        committed: &[f64],
        to: &mut Answers<'_>,
    ) {
        self.dampers.iter().for_each(|damper| damper.force(at, to.f));
        for pack in &mut self.packs {
            blaming(pack.element(), || pack.respond(at, last, to));
        }
        for i in &self.alone {
            let Answers { history, f, tangents, energy } = to;
            self.laws.respond_one(*i, *at, committed, history, f, tangents, &mut energy[*i]);
        }
    }

    /// Tangents where the laws were asked last, if they still wait.
    pub fn tangents(&mut self, to: &mut Tangents) {
        self.packs.iter_mut().for_each(|pack| pack.tangents(to));
    }

    /// The step ends where the laws were asked last, at the same place: what still waits.
    #[inline]
    pub fn end(&mut self, at: &Kinematics<'_>, to: &mut Answers<'_>) {
        self.dampers.iter().for_each(|damper| damper.energy(at, to.energy));
        for pack in &mut self.packs {
            blaming(pack.element(), || pack.commit(to));
        }
    }
}

impl LinkSet {
    pub(crate) fn new(model: &Model, reduction: &Reduction) -> Result<Self, SystemError> {
        let mut set = Self::default();
        for (element, e) in model.elements.iter().enumerate() {
            let Body::Link(law, options) = &e.body else { continue };
            let refuse = |reason: String| SystemError::Element {
                element: e.name.clone(),
                reason,
                span: e.span.clone(),
            };
            answered(|| law.check_engaged())
                .map_err(|said| refuse(format!("its engaged stiffness panicked: {said}")))?
                .map_err(|fault| refuse(fault.to_string()))?;
            let coordinates = law.coordinates();
            if let Coordinates::Nodal { nodes } = coordinates
                && nodes != e.nodes.len()
            {
                return Err(refuse(format!("needs {nodes} nodes, has {}", e.nodes.len())));
            }
            let start = set.rows.len();
            for terms in all_rows(model, element) {
                set.push_row(reduction, &terms);
            }
            let settled = match options.p_delta_at {
                Some(shares) => Some(Leaning::of(model, element, law, shares)?),
                None => None,
            };
            let n = set.rows.len() - start;
            match coordinates {
                Coordinates::Local(axes) => {
                    set.rotational.extend(axes.iter().map(|a| a.index() > 2));
                }
                Coordinates::Nodal { nodes } => {
                    set.rotational.extend((0..6 * nodes).map(|i| i % 6 > 2));
                }
            }
            set.rotational.resize(start + n, true);
            set.effective.extend(options.effective_stiffness.iter().flatten());
            set.effective.resize(start + n, 0.0);
            let fields = law.history().len();
            set.links.push(LinkInstance {
                element,
                range: start..start + n,
                block: set.block_len..set.block_len + n * n,
                history: set.history_len..set.history_len + fields,
                tilts: if settled.is_some() { TILTS.len() } else { 0 },
                settled,
            });
            set.block_len += n * n;
            set.history_len += fields;
        }
        let diagonal = |link: &LinkInstance| {
            let (start, n) = (link.block.start, link.range.len());
            (0..n).map(move |i| start + i * (n + 1))
        };
        set.turns = set.rotational.contains(&true);
        let flat = set.links.iter().flat_map(diagonal).enumerate();
        set.diagonal = flat.filter(|(i, _)| !set.rows[*i].is_empty()).map(|(_, at)| at).collect();
        set.active = (0..set.rows.len()).filter(|i| !set.rows[*i].is_empty()).collect();
        Ok(set)
    }

    fn push_row(&mut self, reduction: &Reduction, terms: &[(usize, f64)]) {
        let order = reduction.order();
        let mut sum = std::collections::BTreeMap::new();
        for (full, c) in terms {
            for (j, t) in reduction.expand(*full) {
                *sum.entry(*j).or_insert(0.0) += c * t;
            }
        }
        let scale = sum.values().fold(0.0f64, |a, x: &f64| a.max(x.abs()));
        let kept = sum.into_iter().filter(|(_, c)| c.abs() > 1e-13 * scale);
        let (free, support) = kept.partition::<Vec<_>, _>(|(j, _)| *j < order);
        self.rows.push(free);
        self.support_rows.push(support.into_iter().map(|(j, c)| (j - order, c)).collect());
    }

    /// What links exert against the displacement of a node's DOF, fixed or not: (flat index, share of its force).
    #[must_use]
    pub fn forces_on(&self, model: &Model, node: usize, dof: Dof) -> Vec<(usize, f64)> {
        let full = 6 * node + dof.index();
        let at = self.links.iter().filter(|l| model.elements[l.element].nodes.contains(&node));
        at.flat_map(|link| {
            let rows = all_rows(model, link.element).into_iter().zip(link.range.clone());
            rows.filter_map(|(row, flat)| {
                let share: f64 = row.iter().filter(|(i, _)| *i == full).map(|(_, c)| c).sum();
                (share != 0.0).then_some((flat, share))
            })
            .collect::<Vec<_>>()
        })
        .collect()
    }

    /// Number of flat coordinates.
    #[must_use]
    pub fn len(&self) -> usize {
        self.rows.len()
    }

    /// True for a linear model.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.links.is_empty()
    }

    /// The law of a link.
    #[must_use]
    pub fn law<'a>(&self, model: &'a Model, link: &'a LinkInstance) -> Option<&'a dyn Link> {
        self.shared_law(model, link).map(Arc::as_ref)
    }

    /// The law of a link, to be held beyond its model.
    #[must_use]
    pub fn shared_law<'a>(
        &self,
        model: &'a Model,
        link: &'a LinkInstance,
    ) -> Option<&'a Arc<dyn Link>> {
        match (&link.settled, &model.elements[link.element].body) {
            (Some(law), _) | (None, Body::Link(law, _)) => Some(law),
            _ => None,
        }
    }

    /// `d = B u + B_s u_s`; `u` on the free, `us` on the prescribed DOFs.
    pub fn deform(&self, u: &[f64], us: &[f64], d: &mut [f64]) {
        for (i, x) in d.iter_mut().enumerate() {
            *x = self.rows[i].iter().map(|(j, c)| c * u[*j]).sum::<f64>()
                + self.support_rows[i].iter().map(|(j, c)| c * us[*j]).sum::<f64>();
        }
    }

    /// `p += s · Bᵀ f`.
    pub fn spread(&self, s: f64, f: &[f64], p: &mut [f64]) {
        for (row, x) in self.rows.iter().zip(f).filter(|(_, x)| **x != 0.0) {
            for (j, c) in row {
                p[*j] += s * c * x;
            }
        }
    }

    /// The laws that run, looked up once.
    #[must_use]
    pub fn laws<'a>(&'a self, model: &'a Model) -> Laws<'a> {
        Laws::new(
            self.links.iter().filter_map(|l| self.law(model, l).map(|law| (law, l))).collect(),
        )
    }

    /// History before anything has happened.
    #[must_use]
    pub fn at_rest(&self, model: &Model) -> Vec<f64> {
        let mut history = vec![0.0; self.history_len];
        for link in &self.links {
            if let Some(law) = self.law(model, link) {
                law.at_rest(&mut history[link.history.clone()]);
            }
        }
        history
    }

    /// Diagonal of the engaged stiffness of every flat coordinate.
    #[must_use]
    pub fn engaged(&self, model: &Model) -> Vec<f64> {
        let mut diagonal = vec![0.0; self.len()];
        for link in &self.links {
            let n = link.range.len();
            let mut k = vec![0.0; n * n];
            if let Some(law) = self.law(model, link) {
                law.engaged_stiffness(&mut k);
            }
            for i in 0..n {
                diagonal[link.range.start + i] = k[i * n + i];
            }
        }
        diagonal
    }

    /// Link coordinates of laws that hold by their rate alone, as a dashpot does; flat.
    #[must_use]
    pub fn viscous(&self, model: &Model) -> Vec<bool> {
        let engaged = self.engaged(model);
        let mut viscous = vec![false; self.len()];
        for (_, link) in self.laws(model).iter().filter(|(law, _)| law.damps()) {
            let own = link.range.start..link.range.end - link.tilts;
            own.for_each(|flat| viscous[flat] = engaged[flat] == 0.0);
        }
        viscous
    }

    /// Empty tangents of the right length.
    #[must_use]
    pub fn tangents(&self) -> Tangents {
        Tangents { k: vec![0.0; self.block_len], c: vec![0.0; self.block_len] }
    }

    /// Stiffness of the active coordinates as they are, N/m or N·m.
    pub fn stiffness<'a>(&'a self, tangents: &'a Tangents) -> impl Iterator<Item = f64> + 'a {
        self.diagonal.iter().map(|at| tangents.k[*at])
    }

    /// Name of a flat coordinate, such as `"foot" U1`; `the structure` where there is none of that number.
    #[must_use]
    pub fn name(&self, model: &Model, flat: usize) -> String {
        let Some(link) = self.links.iter().find(|l| l.range.contains(&flat)) else {
            return "the structure".into();
        };
        let axis = self.coordinate(model, link, flat - link.range.start);
        format!("\"{}\" {axis}", model.elements[link.element].name)
    }

    /// Name of a coordinate of a link, counted from its first, such as `U1`.
    #[must_use]
    pub fn coordinate(&self, model: &Model, link: &LinkInstance, local: usize) -> String {
        match self.law(model, link).map(Link::coordinates) {
            Some(Coordinates::Local(axes)) => axes[local].name().to_owned(),
            _ => format!("node {} {}", local / 6 + 1, Dof::ALL[local % 6].name()),
        }
    }
}
