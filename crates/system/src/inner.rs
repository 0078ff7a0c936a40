//! Elements with sparse matrices: where their rows stand, and how inner rows move with a rigid body.
//!
//! ```text
//!   full DOFs   6 · node + direction, and behind those of all nodes one for each inner row
//!   r_i = −K_ii⁻¹ K_it r_t           t: rows tied to nodes, whose rigid motions their places tell
//! ```
//!
//! A row that has a direction, though no node, moves by one unit when all moves along it, however the stiffness is held:
//! ground motion moves the ground that a matrix may stand on as well. All else follows the tied rows.

use crate::SystemError;
use trilith_element::{Dof, Recovered, SparseMatrices, SparseMatrix, SparseRow, Vector3, cross};
use trilith_linalg::threads::beside;
use trilith_linalg::{Ldlt, Sparse, Triplets};
use trilith_model::{Body, Element, Model, Span};

/// A share of ‖K‖ ‖r‖ below which K r is rounding: files may have as few as seven digits.
const ROUNDING: f64 = 1e-6;
/// A pivot of a matrix scaled to unit diagonal below this is negative, and no rounding.
const NEGATIVE: f64 = -1e-8;
/// An energy of a motion of unit size that is no less negative than this is rounding, in a matrix scaled to unit diagonal.
const SHIFT: f64 = 1e-6;
/// What a pivot that is none is replaced by: [`Ldlt::with_rigid_zeros`].
const LOOSE: f64 = 1e29;

/// Motions of a rigid body: along X, Y and Z, and about them through the origin.
type Rigid = [f64; 6];

/// An equation that is no direction of a node.
#[derive(Clone, Copy, Debug)]
struct Inner {
    element: usize,
    row: usize,
    dof: Option<Dof>,
    rigid: Rigid,
}

/// The rows of all elements with sparse matrices.
#[derive(Clone, Debug, Default)]
pub struct InnerRows {
    /// Directions of nodes; full indices from here on are inner rows.
    first: usize,
    all: Vec<Inner>,
    /// Full index of each row of an element, by elements.
    places: Vec<(usize, Vec<usize>)>,
    /// What is allowed in such an element and hardly meant, in sentences.
    pub doubts: Vec<String>,
}

/// The matrices of an element that has sparse ones.
pub(crate) fn sparse(e: &Element) -> Option<&SparseMatrices> {
    match &e.body {
        Body::Linear(law) => law.sparse(),
        _ => None,
    }
}

impl InnerRows {
    /// Their places; how they move is not known yet.
    pub(crate) fn new(model: &Model) -> Result<Self, SystemError> {
        let mut rows = Self { first: 6 * model.nodes.len(), ..Self::default() };
        for (element, e) in model.elements.iter().enumerate() {
            let Some(own) = sparse(e) else { continue };
            fits(own, e.nodes.len()).map_err(|reason| refused(e, reason))?;
            rows.add(element, &e.nodes, own);
        }
        Ok(rows)
    }

    /// Finds how they move with a rigid body, and whether matrices can be a stiffness and a mass, while another thread does
    /// something else.
    pub(crate) fn follow<T: Send>(
        &mut self,
        model: &Model,
        meanwhile: impl FnOnce() -> T + Send,
    ) -> Result<T, SystemError> {
        let (mut meanwhile, mut done) = (Some(meanwhile), None);
        for (element, _) in &self.places {
            let e = &model.elements[*element];
            let Some(own) = sparse(e) else { continue };
            let (mut rigid, mut of_mass) = (vec![[0.0; 6]; own.rows.len()], Ok(None));
            let (other, mut of_other) = (meanwhile.take(), None);
            // Stiffness and mass are factorised.
            let jobs: Vec<Box<dyn FnOnce() + Send + '_>> = vec![
                Box::new(|| of_mass = own.mass.as_deref().map(negative).transpose()),
                Box::new(|| of_other = other.map(|work| work())),
            ];
            let loose = beside(|| follow(model, e, own, &mut rigid), jobs, |job| job());
            done = done.or(of_other);
            let loose = loose?.map_err(|reason| refused(e, reason))?;
            if let Some(row) = of_mass?.flatten() {
                return Err(refused(e, indefinite("mass", own.mass.as_deref(), row)));
            }
            self.doubts.extend(held(e, own, &rigid));
            self.doubts.extend((!loose.is_empty()).then(|| not_held(e, own, &loose)));
            let of_element = self.all.iter_mut().filter(|inner| inner.element == *element);
            of_element.for_each(|inner| inner.rigid = rigid[inner.row]);
        }
        let done = done.or_else(|| meanwhile.map(|work| work()));
        Ok(done
            .unwrap_or_else(|| unreachable!("it is done beside the first element or without any")))
    }

    fn add(&mut self, element: usize, nodes: &[usize], own: &SparseMatrices) {
        let mut places = Vec::with_capacity(own.rows.len());
        for (row, what) in own.rows.iter().enumerate() {
            places.push(match *what {
                SparseRow::Node(node, dof) => 6 * nodes[node] + dof.index(),
                SparseRow::Inner(dof) => {
                    self.all.push(Inner { element, row, dof, rigid: [0.0; 6] });
                    self.first + self.all.len() - 1
                }
            });
        }
        self.places.push((element, places));
    }

    /// Number of inner rows.
    #[must_use]
    pub fn len(&self) -> usize {
        self.all.len()
    }

    /// True where every equation is a direction of a node.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.all.is_empty()
    }

    /// Full index of each row of an element with sparse matrices; none for others.
    pub(crate) fn places(&self, element: usize) -> Option<&[usize]> {
        let found = self.places.binary_search_by_key(&element, |p| p.0).ok()?;
        Some(&self.places[found].1)
    }

    fn get(&self, full: usize) -> Option<&Inner> {
        full.checked_sub(self.first).and_then(|i| self.all.get(i))
    }

    /// The direction of a full DOF, where it has one.
    #[must_use]
    pub fn dof(&self, full: usize) -> Option<Dof> {
        self.get(full).map_or_else(|| Some(Dof::ALL[full % 6]), |inner| inner.dof)
    }

    /// The node of a full DOF; none of an inner row.
    #[must_use]
    pub fn node(&self, full: usize) -> Option<usize> {
        (full < self.first).then_some(full / 6)
    }

    /// By how much a full DOF moves when everything moves by one unit along X, Y or Z (0, 1, 2).
    #[must_use]
    pub fn shift(&self, full: usize, axis: usize) -> f64 {
        self.get(full)
            .map_or_else(|| f64::from(u8::from(full % 6 == axis)), |inner| inner.rigid[axis])
    }

    /// By how much it moves when everything turns by one unit about an axis through a point.
    #[must_use]
    pub fn turn(&self, model: &Model, full: usize, axis: usize, about: Vector3) -> f64 {
        let unit = unit(axis);
        match self.get(full) {
            None => {
                let node = model.nodes[full / 6].position;
                let arm = [0, 1, 2].map(|i| node[i] - about[i]);
                if full % 6 > 2 { unit[full % 3] } else { cross(unit, arm)[full % 3] }
            }
            Some(inner) => {
                let moved = cross(unit, about);
                let shifted: f64 = (0..3).map(|i| moved[i] * inner.rigid[i]).sum();
                inner.rigid[3 + axis] - shifted
            }
        }
    }

    /// Whose direction a full DOF is, and which, for what is said of it.
    #[must_use]
    pub fn name(&self, model: &Model, full: usize) -> (String, &'static str) {
        match self.get(full) {
            None => (model.nodes[full / 6].name.clone(), Dof::ALL[full % 6].name()),
            Some(inner) => {
                let element = &model.elements[inner.element].name;
                let dof = inner.dof.map_or("of its matrices", Dof::name);
                let own = sparse(&model.elements[inner.element]);
                let row = own.map_or_else(String::new, |own| own.stiffness.row_name(inner.row));
                (format!("row {row} of {element}"), dof)
            }
        }
    }

    /// Where the file defines what it belongs to.
    #[must_use]
    pub fn span(&self, model: &Model, full: usize) -> Span {
        match self.get(full) {
            None => model.nodes[full / 6].span.clone(),
            Some(inner) => model.elements[inner.element].span.clone(),
        }
    }
}

fn refused(e: &Element, reason: String) -> SystemError {
    SystemError::Element { element: e.name.clone(), reason, span: e.span.clone() }
}

fn unit(axis: usize) -> Vector3 {
    std::array::from_fn(|i| f64::from(u8::from(i == axis)))
}

/// Matrices of one size, and rows of nodes that are there.
fn fits(own: &SparseMatrices, nodes: usize) -> Result<(), String> {
    let size = own.rows.len();
    let all = [Some(&own.stiffness), own.mass.as_ref(), own.damping.as_ref()];
    for a in all.into_iter().flatten() {
        let most = a.entries.iter().map(|e| e.0.max(e.1) as usize + 1).max().unwrap_or(0);
        if a.size != size || most > size {
            return Err(format!("{} has {} rows, and {size} are listed", a.name, a.size.max(most)));
        }
    }
    let mut led: Vec<(usize, Dof)> = own.recovered.iter().map(|r| (r.node, r.dof)).collect();
    led.sort_unstable();
    let of_rows = |r: &&Recovered| own.rows.contains(&SparseRow::Node(r.node, r.dof));
    let beyond = |r: &Recovered| r.node >= nodes || r.terms.iter().any(|t| t.0 as usize >= size);
    if own.recovered.iter().any(beyond) {
        return Err("what follows its rows names a row or a node that it has not".into());
    }
    if led.windows(2).any(|two| two[0] == two[1]) || own.recovered.iter().find(of_rows).is_some() {
        return Err("a direction of a node follows its rows twice, or is one of them".into());
    }
    let strange = |row: &&SparseRow| matches!(row, SparseRow::Node(node, _) if *node >= nodes);
    match own.rows.iter().find(strange) {
        Some(SparseRow::Node(node, _)) => {
            Err(format!("it lists a row of its node {}, and it has {nodes}", node + 1))
        }
        _ => Ok(()),
    }
}

/// Rigid motions of the rows of an element; the rows that its nodes do not hold. The inner error says why the stiffness
/// is none.
fn follow(
    model: &Model,
    e: &Element,
    own: &SparseMatrices,
    rigid: &mut [Rigid],
) -> Result<Result<Vec<usize>, String>, SystemError> {
    let (mut inner, mut without) = (Vec::new(), Vec::new());
    for (row, what) in own.rows.iter().enumerate() {
        match *what {
            SparseRow::Node(node, dof) => {
                let place = model.nodes[e.nodes[node]].position;
                rigid[row] = std::array::from_fn(|motion| {
                    let axis = unit(motion % 3);
                    match (motion > 2, dof.is_rotation()) {
                        (false, true) => 0.0,
                        (true, false) => cross(axis, place)[dof.index()],
                        (false, false) | (true, true) => axis[dof.index() % 3],
                    }
                });
            }
            SparseRow::Inner(dof) => {
                inner.push(row);
                match dof {
                    Some(dof) if !dof.is_rotation() => rigid[row][dof.index()] = 1.0,
                    Some(_) => {}
                    None => without.push(row),
                }
            }
        }
    }
    if inner.is_empty() {
        return Ok(Ok(Vec::new()));
    }
    let k = &own.stiffness;
    // What has no direction moves as its neighbours do, and turns follow from the places of the nodes.
    let together = without.len() == inner.len();
    if !together && !without.is_empty() {
        condense(k, &without, 0..3, rigid)?;
    }
    let motions = if together { 0..6 } else { 3..6 };
    let found = condense(k, &inner, motions, rigid)?;
    Ok(match found.negative {
        Some(row) => Err(indefinite("stiffness", Some(k), row)),
        None => Ok(found.loose),
    })
}

struct Condensed {
    /// Rows that the others do not hold, one for each mechanism.
    loose: Vec<usize>,
    /// A row whose pivot is negative.
    negative: Option<usize>,
}

/// Solves K r = 0 in some rows for some motions; the motions of all other rows are known.
fn condense(
    k: &SparseMatrix,
    rows: &[usize],
    motions: std::ops::Range<usize>,
    rigid: &mut [Rigid],
) -> Result<Condensed, SystemError> {
    let diagonal = k.diagonal();
    // A row without stiffness follows nothing.
    let rows: Vec<usize> = rows.iter().copied().filter(|i| diagonal[*i] > 0.0).collect();
    let mut place = vec![usize::MAX; k.size];
    rows.iter().enumerate().for_each(|(new, old)| place[*old] = new);
    let scale: Vec<f64> = rows.iter().map(|i| diagonal[*i].sqrt().recip()).collect();
    let n = rows.len();
    let mut block = Triplets::new(n, n);
    for (i, j, v) in &k.entries {
        let (a, b) = (place[*i as usize], place[*j as usize]);
        if a != usize::MAX && b != usize::MAX {
            block.add(a, b, v * scale[a] * scale[b]);
        }
    }
    let mut factor = Ldlt::with_rigid_zeros(&block.build())?;
    let (mut loose, mut negative) = (Vec::new(), None);
    factor.pivots(|equation, d| {
        if d >= LOOSE {
            loose.push(rows[equation]);
        } else if d < NEGATIVE {
            negative = negative.or(Some(rows[equation]));
        }
    });
    // Once more with what the first solution leaves.
    for _ in 0..2 {
        let mut x = Vec::with_capacity(n * motions.len());
        for motion in motions.clone() {
            let r: Vec<f64> = rigid.iter().map(|r| r[motion]).collect();
            let mut force = vec![0.0; k.size];
            k.mul_add(&r, &mut force);
            x.extend(rows.iter().zip(&scale).map(|(i, s)| -force[*i] * s));
        }
        factor.solve(&mut x);
        for (motion, x) in motions.clone().zip(x.chunks(n.max(1))) {
            for ((i, s), x) in rows.iter().zip(&scale).zip(x) {
                rigid[*i][motion] += s * x;
            }
        }
    }
    loose.sort_unstable();
    Ok(Condensed { loose, negative })
}

/// A row at which a matrix turns out not to be positive semi-definite: with [`SHIFT`] on its diagonal it has a negative
/// pivot. Without that, masses by fewer points than they have rows leave pivots of rounding, and what is divided by such
/// a pivot may be anything.
fn negative(a: &SparseMatrix) -> Result<Option<usize>, SystemError> {
    if a.entries.iter().all(|(i, j, _)| i == j) {
        return Ok(None);
    }
    let diagonal = a.diagonal();
    let scale: Vec<f64> =
        diagonal.iter().map(|d| if *d > 0.0 { d.sqrt().recip() } else { 0.0 }).collect();
    let mut t = Triplets::new(a.size, a.size);
    for (i, j, v) in &a.entries {
        t.add(*i as usize, *j as usize, v * scale[*i as usize] * scale[*j as usize]);
    }
    (0..a.size).for_each(|i| t.add(i, i, SHIFT));
    let scaled: Sparse = t.build();
    let mut found = None;
    Ldlt::with_rigid_zeros(&scaled)?.pivots(|equation, d| {
        if d < 0.0 {
            found = found.or(Some(equation));
        }
    });
    Ok(found)
}

fn indefinite(what: &str, a: Option<&SparseMatrix>, row: usize) -> String {
    let file = a.map_or("", |a| &a.name);
    format!(
        "its {what} ({file}) is not positive semi-definite: a motion of row {} and of others has a negative energy",
        a.map_or_else(String::new, |a| a.row_name(row))
    )
}

fn not_held(e: &Element, own: &SparseMatrices, loose: &[usize]) -> String {
    let name = |row: &usize| own.stiffness.row_name(*row);
    let rows: Vec<String> = loose.iter().take(4).map(name).collect();
    let more = if loose.len() > 4 { ", …" } else { "" };
    format!(
        "check the model: the nodes of \"{}\" do not hold all of it (its rows {}{more} among others can move while they \
         stand still): tie more rows to nodes, or its masses move with the ground as they will",
        e.name,
        rows.join(", ")
    )
}

/// What to say of an element that resists when all of it moves as a rigid body.
fn held(e: &Element, own: &SparseMatrices, rigid: &[Rigid]) -> Option<String> {
    let names = ["along X", "along Y", "along Z", "about X", "about Y", "about Z"];
    let mut resisted = Vec::new();
    for (motion, name) in names.into_iter().enumerate() {
        let size = own.rows.len();
        let (mut force, mut most) = (vec![0.0; size], vec![0.0; size]);
        for (i, j, v) in &own.stiffness.entries {
            let term = v * rigid[*j as usize][motion];
            force[*i as usize] += term;
            most[*i as usize] += term.abs();
        }
        let norm = |x: &[f64]| x.iter().map(|a| a * a).sum::<f64>().sqrt();
        if norm(&force) > ROUNDING * norm(&most) {
            resisted.push(name);
        }
    }
    (!resisted.is_empty()).then(|| {
        format!(
            "check the model: \"{}\" resists a motion as a rigid body {}: its stiffness stands on a ground of its own, or \
             rows are tied to other directions or places than theirs; where it does, that ground moves as the base does",
            e.name,
            resisted.join(", ")
        )
    })
}
