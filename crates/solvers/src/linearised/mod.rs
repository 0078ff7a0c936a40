//! The structure with its links made linear: modes at a state of the links, and what a response spectrum makes of them.
//!
//! ```text
//! K_l = K + Bᵀ k B          k: tangents of the laws in a state, or secants of a cycle
//! ```
//!
//! For comparison with a first design by a code, and for the periods that an engineer expects: those of a march come out
//! of the laws themselves. May use `run` and what that uses.

mod modes;
mod secant;
mod spectrum;

pub use modes::LinearModes;
pub use secant::Secant;
pub use spectrum::{CombineDirections, CombineModes, OutputMaximum, SpectrumRequest};

use crate::basis::at_nodes;
use crate::error::SolveError;
use crate::run::end_at;
use crate::step::{Culprit, LinksBefore, State};
use trilith_element::{Energy, Kinematics};
use trilith_linalg::{Sparse, Triplets};
use trilith_model::Model;
use trilith_system::{LinkSet, System, catch};

/// A block whose halves differ by more than this share of its largest entry is not symmetric.
const UNSYMMETRIC: f64 = 1e-9;

/// How stiff links count.
#[derive(Clone, Debug, PartialEq)]
pub enum LinkStiffness {
    /// Not at all.
    Open,
    /// As stiff as they are when engaged: closed, sticking, elastic.
    Engaged,
    /// By their tangents.
    Tangent,
    /// By the secants of cycles of this amplitude (m) along their shear axes U2 and U3, or along U1 where a link has none
    /// of these; by their tangents otherwise.
    Secant {
        /// Amplitude, m.
        displacement: f64,
        /// Indices of the elements; `None`: all links with shear axes.
        of: Option<Vec<usize>>,
    },
}

/// A structure with linear links.
#[derive(Clone, Debug)]
pub struct Linearised<'a> {
    model: &'a Model,
    system: &'a System,
    /// State of the links, from which cycles start.
    start: LinksBefore,
    /// Stiffness of the links: symmetric blocks, flat, N/m, N or N·m.
    blocks: Vec<f64>,
    /// What cycles of links gave.
    pub secants: Vec<Secant>,
    /// Elements whose tangents are not symmetric (friction that slips): the symmetric part counts.
    pub unsymmetric: Vec<usize>,
}

/// Makes the links of a structure linear, at rest or at the end of a case (`after`, an index).
///
/// # Errors
/// [`SolveError`] where that case does not come to its end, or a law gives no finite stiffness.
pub fn linearised<'a>(
    model: &'a Model,
    system: &'a System,
    stiffness: &LinkStiffness,
    after: Option<usize>,
) -> Result<Linearised<'a>, SolveError> {
    catch(|| make(model, system, stiffness, after)).unwrap_or_else(|panicked| {
        let when = "where the structure is linearised".into();
        Err(Culprit::from(panicked).error(model, system, when))
    })
}

fn make<'a>(
    model: &'a Model,
    system: &'a System,
    stiffness: &LinkStiffness,
    after: Option<usize>,
) -> Result<Linearised<'a>, SolveError> {
    let links = &system.links;
    let start = match after {
        Some(case) => LinksBefore::of(&end_at(model, system, case)?.state),
        None => LinksBefore::rest(model, links),
    };
    let blocks = match stiffness {
        LinkStiffness::Open => vec![0.0; links.block_len],
        LinkStiffness::Engaged => engaged(model, links),
        LinkStiffness::Tangent | LinkStiffness::Secant { .. } => tangents(model, links, &start),
    };
    let mut it =
        Linearised { model, system, start, blocks, secants: Vec::new(), unsymmetric: Vec::new() };
    it.make_symmetric();
    if let LinkStiffness::Secant { displacement, of } = stiffness {
        it.take_secants(*displacement, of.as_deref())?;
    }
    if let Some(link) =
        links.links.iter().find(|link| it.blocks[link.block.clone()].iter().any(|k| !k.is_finite()))
    {
        let name = model.elements[link.element].name.clone();
        return Err(SolveError::NoStiffness {
            link: name,
            span: model.elements[link.element].span.clone(),
        });
    }
    Ok(it)
}

/// Stiffness of links that are engaged.
fn engaged(model: &Model, links: &LinkSet) -> Vec<f64> {
    let mut blocks = vec![0.0; links.block_len];
    for (law, link) in links.laws(model).iter() {
        law.engaged_stiffness(&mut blocks[link.block.clone()]);
    }
    blocks
}

/// Tangents of the laws in a state, nothing moving.
fn tangents(model: &Model, links: &LinkSet, at: &LinksBefore) -> Vec<f64> {
    let still = vec![0.0; links.len()];
    let (mut f, mut tangents) = (still.clone(), links.tangents());
    let mut history = at.history.clone();
    let mut energy = vec![Energy::default(); links.links.len()];
    let question = Kinematics::still(&at.d, &still);
    links.laws(model).respond(
        question,
        &at.history,
        &mut history,
        &mut f,
        &mut tangents,
        &mut energy,
    );
    tangents.k
}

impl Linearised<'_> {
    /// Keeps the symmetric part of every block, and takes note of those that are not.
    fn make_symmetric(&mut self) {
        for link in &self.system.links.links {
            let n = link.range.len();
            let block = &mut self.blocks[link.block.clone()];
            let largest = block.iter().fold(0.0f64, |m, k| m.max(k.abs()));
            let mut is_symmetric = true;
            for i in 0..n {
                for j in 0..i {
                    let (a, b) = (block[i * n + j], block[j * n + i]);
                    is_symmetric &= (a - b).abs() <= UNSYMMETRIC * largest;
                    let mean = 0.5 * (a + b);
                    (block[i * n + j], block[j * n + i]) = (mean, mean);
                }
            }
            if !is_symmetric {
                self.unsymmetric.push(link.element);
            }
        }
    }

    /// True where the links are stiff anywhere.
    #[must_use]
    pub fn has_stiff_links(&self) -> bool {
        self.blocks.iter().any(|k| *k != 0.0)
    }

    /// What a shape on the free DOFs, such as a [mode's](LinearModes::shapes), looks like: six displacements of every
    /// node, node after node.
    #[must_use]
    pub fn at_nodes(&self, shape: &[f64]) -> Vec<f32> {
        at_nodes(self.model, self.system, shape)
    }

    /// K with the links, on the free DOFs.
    fn stiffness(&self) -> Sparse {
        let links = &self.system.links;
        let mut sum = Triplets::new(self.system.order(), self.system.order());
        for link in &links.links {
            let n = link.range.len();
            for (at, k) in link.block.clone().zip(&self.blocks[link.block.clone()]) {
                let local = at - link.block.start;
                let (p, q) = (link.range.start + local / n, link.range.start + local % n);
                if *k == 0.0 {
                    continue;
                }
                for (i, a) in &links.rows[p] {
                    for (j, b) in &links.rows[q] {
                        sum.add(*i, *j, a * k * b);
                    }
                }
            }
        }
        Sparse::combine(&[(1.0, &self.system.stiffness), (1.0, &sum.build())])
    }

    /// Deformations and forces of the links, flat, under displacements of the free DOFs; no support moves.
    fn links_under(&self, u: &[f64]) -> (Vec<f64>, Vec<f64>) {
        let links = &self.system.links;
        let still = vec![0.0; self.system.reduction.prescribed.len()];
        let (mut d, mut f) = (vec![0.0; links.len()], vec![0.0; links.len()]);
        links.deform(u, &still, &mut d);
        for link in &links.links {
            let n = link.range.len();
            let block = &self.blocks[link.block.clone()];
            for (i, row) in block.chunks(n.max(1)).enumerate() {
                let own = &d[link.range.clone()];
                f[link.range.start + i] = row.iter().zip(own).map(|(k, d)| k * d).sum();
            }
        }
        (d, f)
    }

    /// A state of displacements (free DOFs) with accelerations −ω² u, as a mode has at its largest.
    fn state(&self, u: &[f64], omega2: f64) -> State {
        let (d, f) = self.links_under(u);
        let mut motion = u.to_vec();
        motion.extend(std::iter::repeat_n(0.0, u.len()));
        motion.extend(u.iter().map(|u| -omega2 * u));
        let v = vec![0.0; d.len()];
        State { motion, d, v, f, history: self.start.history.clone(), ..State::default() }
    }
}
