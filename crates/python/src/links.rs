//! Deformations and forces of links at the output times.

use trilith::element::{Coordinates, Dof};
use trilith::model::{Body, Element, Model};
use trilith::solvers::{Observer, Sample};

/// A link, and where its coordinates are in the flat lists.
#[derive(Clone, Debug)]
pub(crate) struct LinkPlace {
    pub name: String,
    pub kind: &'static str,
    /// Names of the coordinates.
    pub coordinates: Vec<String>,
    /// Which of them are rotations.
    pub rotations: Vec<bool>,
    /// The first of them.
    pub first: usize,
}

/// Keeps deformation and force of every link coordinate at the output times, in double precision.
#[derive(Debug, Default)]
pub(crate) struct LinkHistories {
    pub links: Vec<LinkPlace>,
    deformation: Vec<Vec<f64>>,
    force: Vec<Vec<f64>>,
}

impl LinkHistories {
    /// For all links of a model.
    pub fn new(model: &Model) -> Self {
        let (mut links, mut first) = (Vec::new(), 0);
        for element in &model.elements {
            let names = coordinates(model, element);
            if names.is_empty() {
                continue;
            }
            let n = names.len();
            let (coordinates, rotations) = names.into_iter().unzip();
            let (name, kind) = (element.name.clone(), element.kind);
            links.push(LinkPlace { name, kind, coordinates, rotations, first });
            first += n;
        }
        Self { links, deformation: vec![Vec::new(); first], force: vec![Vec::new(); first] }
    }

    pub fn deformation(&self, flat: usize) -> Option<&[f64]> {
        self.deformation.get(flat).map(Vec::as_slice)
    }

    pub fn force(&self, flat: usize) -> Option<&[f64]> {
        self.force.get(flat).map(Vec::as_slice)
    }
}

impl Observer for LinkHistories {
    /// A run whose basis was too small is made again.
    fn start(&mut self, _: usize) {
        self.deformation.iter_mut().chain(&mut self.force).for_each(Vec::clear);
    }

    fn sample(&mut self, sample: &Sample<'_>) {
        if sample.output_step.is_none() {
            return;
        }
        let rows = [(&mut self.deformation, sample.deformation), (&mut self.force, sample.force)];
        for (lists, values) in rows {
            for (i, list) in lists.iter_mut().enumerate() {
                list.push(values.get(i).copied().unwrap_or(f64::NAN));
            }
        }
    }

    fn wants_rates(&self) -> bool {
        false
    }
}

/// Names of the coordinates of a link, and whether each is a rotation; none for what is no link.
fn coordinates(model: &Model, element: &Element) -> Vec<(String, bool)> {
    let Body::Link(law, _) = &element.body else { return Vec::new() };
    match law.coordinates() {
        Coordinates::Local(axes) => {
            axes.iter().map(|axis| (axis.name().to_owned(), axis.index() > 2)).collect()
        }
        Coordinates::Nodal { nodes } => {
            let node = |i: usize| element.nodes.get(i).map(|n| model.nodes[*n].name.as_str());
            let six = |i: usize| Dof::ALL.map(|dof| (node(i).unwrap_or("ground"), dof));
            let all = (0..nodes).flat_map(six);
            all.map(|(node, dof)| (format!("{node}.{}", dof.name()), dof.is_rotation())).collect()
        }
    }
}
