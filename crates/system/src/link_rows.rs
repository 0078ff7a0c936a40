//! Rows of B of a link over the full DOFs.

use trilith_element::{Coordinates, Vector3, cross, norm, sub};
use trilith_model::{Body, Element, LinkOptions, Model};

/// The row of the tilt of a link about a local axis: the rotations of its nodes by their shares of P-Δ.
pub(crate) fn tilt_row(e: &Element, options: &LinkOptions, axis: &Vector3) -> Vec<(usize, f64)> {
    let Some([first, second]) = options.p_delta_at else { return Vec::new() };
    // The ground, which does not tilt, is the first end of a link with one node.
    let shares = if e.nodes.len() == 1 { vec![second] } else { vec![first, second] };
    let turned = |(n, share): (&usize, f64)| {
        let along = axis.iter().enumerate().filter(|(_, x)| x.abs() > 1e-12);
        let at = 6 * n + 3;
        along.map(move |(k, x)| (at + k, share * x)).filter(|(_, c)| *c != 0.0)
    };
    e.nodes.iter().zip(shares).flat_map(turned).collect()
}

/// Rows of B of an element over full DOFs, those of its tilts under P-Δ behind the others; none where it is no link.
pub(crate) fn all_rows(model: &Model, element: usize) -> Vec<Vec<(usize, f64)>> {
    let e = &model.elements[element];
    let Body::Link(law, options) = &e.body else { return Vec::new() };
    let mut rows = full_rows(model, element, &law.coordinates(), options.shear_at);
    if options.p_delta_at.is_some() {
        rows.extend(e.frame.0[1..].iter().map(|axis| tilt_row(e, options, axis)));
    }
    rows
}

/// Rows of B over full DOFs. A link between nodes apart stands between rigid arms of both to the place of its
/// shear, so that its forces are in equilibrium along whatever axes it has. Rotations that the structure neither
/// uses nor prescribes are held: the reduction expands them to nothing.
pub(crate) fn full_rows(
    model: &Model,
    element: usize,
    coordinates: &Coordinates,
    shear_at: f64,
) -> Vec<Vec<(usize, f64)>> {
    let e = &model.elements[element];
    let axes = match coordinates {
        Coordinates::Nodal { .. } => {
            return e
                .nodes
                .iter()
                .flat_map(|n| (0..6).map(move |k| vec![(6 * n + k, 1.0)]))
                .collect();
        }
        Coordinates::Local(axes) => axes,
    };
    let frame = &e.frame.0;
    let (j, i) = match e.nodes[..] {
        [i, j] => (j, Some(i)),
        _ => (e.nodes[0], None),
    };
    // From both nodes to the place of the link, which is on the line between them.
    let arms = i.map_or([[0.0; 3]; 2], |i| {
        let line = sub(model.nodes[j].position, model.nodes[i].position);
        let length = norm(line);
        let share = if length > 0.0 { shear_at / length } else { 0.0 };
        [line.map(|x| (1.0 - share) * x), line.map(|x| -share * x)]
    });
    axes.iter()
        .map(|axis| {
            let a = axis.index();
            let mut terms = Vec::new();
            let mut add = |node: usize, axis: Vector3, offset: usize, c: f64| {
                terms.extend(
                    axis.iter()
                        .enumerate()
                        .filter(|(_, x)| x.abs() > 1e-12)
                        .map(|(k, x)| (6 * node + offset + k, c * x)),
                );
            };
            let (offset, along) = (3 * (a / 3), frame[a % 3]);
            add(j, along, offset, 1.0);
            if let Some(i) = i {
                add(i, along, offset, -1.0);
                if a < 3 {
                    // e · (θ × r) = θ · (r × e).
                    add(j, cross(arms[1], along), 3, 1.0);
                    add(i, cross(arms[0], along), 3, -1.0);
                }
            }
            terms.retain(|(_, c)| *c != 0.0);
            terms
        })
        .collect()
}
