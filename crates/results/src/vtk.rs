//! Deformed shapes for ParaView: `model.pvd` and `frames/*.vtu`, ASCII.

use crate::{FileError, Frame, Frames};
use std::collections::BTreeSet;
use std::fmt::Write;
use std::path::Path;
use trilith_element::Vector3;
use trilith_model::{Body, Model};

/// The folder of the frames.
pub(crate) const FRAMES: &str = "frames";

const LINE: u8 = 3;
const VERTEX: u8 = 1;

/// Writes `model.pvd` and the frames beside it; nothing where there are no frames.
pub(crate) fn write(dir: &Path, model: &Model, frames: &Frames) -> Result<bool, FileError> {
    let folder = dir.join(FRAMES);
    // Frames of a former run with more of them would be left among the new ones.
    if folder.is_dir() {
        for old in std::fs::read_dir(&folder).map_err(FileError::at(&folder))?.flatten() {
            let path = old.path();
            if path.file_name().and_then(|name| name.to_str()).is_some_and(is_frame) {
                std::fs::remove_file(&path).map_err(FileError::at(&path))?;
            }
        }
    }
    if frames.iter().next().is_none() {
        return Ok(false);
    }
    std::fs::create_dir_all(&folder).map_err(FileError::at(&folder))?;
    let mesh = mesh(model);
    let mut index = String::from(
        "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"0.1\" byte_order=\"LittleEndian\">\n<Collection>\n",
    );
    for (i, frame) in frames.iter().enumerate() {
        let name = frame_name(i);
        let path = folder.join(&name);
        std::fs::write(&path, text(&mesh, frame)).map_err(FileError::at(&path))?;
        line(
            &mut index,
            format_args!("<DataSet timestep=\"{}\" file=\"{FRAMES}/{name}\"/>", frame.t),
        );
    }
    index.push_str("</Collection>\n</VTKFile>\n");
    let path = dir.join("model.pvd");
    std::fs::write(&path, index).map_err(FileError::at(&path))?;
    Ok(true)
}

fn frame_name(i: usize) -> String {
    format!("{i:04}.vtu")
}

/// True of a name that a frame may have.
pub(crate) fn is_frame(name: &str) -> bool {
    let number = name.strip_suffix(".vtu").and_then(|digits| digits.parse().ok());
    number.is_some_and(|i| frame_name(i) == name)
}

/// Everything of a `.vtu` file that does not change in time: points and cells.
struct Mesh {
    nodes: usize,
    /// Points of outlines, behind the nodes: the node that each goes with, and its place from there, m.
    corners: Vec<(usize, Vector3)>,
    xml: String,
}

fn mesh(model: &Model) -> Mesh {
    let mut lines = lines(model);
    let nodes = model.nodes.len();
    let mut corners: Vec<(usize, Vector3)> = Vec::new();
    for e in &model.elements {
        let Some(outline) = e.outline(&model.nodes) else { continue };
        let first = nodes + corners.len();
        corners.extend(outline.points.iter().map(|(node, r)| (e.nodes[*node], *r)));
        let edges = outline.paths.iter().flat_map(|path| path.windows(2));
        lines.extend(edges.map(|two| (first + two[0], first + two[1])));
    }
    let mut xml = String::from("<Points>\n");
    array(&mut xml, "Float64", "points", 3, |s| {
        for n in &model.nodes {
            let [x, y, z] = n.position;
            line(s, format_args!("{x:?} {y:?} {z:?}"));
        }
        for (node, r) in &corners {
            let [x, y, z] = [0, 1, 2].map(|i| model.nodes[*node].position[i] + r[i]);
            line(s, format_args!("{x:?} {y:?} {z:?}"));
        }
    });
    xml.push_str("</Points>\n<Cells>\n");
    array(&mut xml, "Int64", "connectivity", 1, |s| {
        (0..nodes).for_each(|i| line(s, format_args!("{i}")));
        lines.iter().for_each(|(i, j)| line(s, format_args!("{i} {j}")));
    });
    array(&mut xml, "Int64", "offsets", 1, |s| {
        (1..=nodes).for_each(|i| line(s, format_args!("{i}")));
        (1..=lines.len()).for_each(|i| line(s, format_args!("{}", nodes + 2 * i)));
    });
    array(&mut xml, "UInt8", "types", 1, |s| {
        (0..nodes).for_each(|_| line(s, format_args!("{VERTEX}")));
        lines.iter().for_each(|_| line(s, format_args!("{LINE}")));
    });
    xml.push_str("</Cells>\n");
    let head = format!(
        "<Piece NumberOfPoints=\"{}\" NumberOfCells=\"{}\">\n{xml}",
        nodes + corners.len(),
        nodes + lines.len()
    );
    Mesh { nodes, corners, xml: head }
}

/// Pairs of nodes to be drawn as a line: two-node members, and what leads and follows in constraints; not of those that
/// say what they look like.
fn lines(model: &Model) -> BTreeSet<(usize, usize)> {
    let mut lines = BTreeSet::new();
    for e in model.elements.iter().filter(|e| e.outline(&model.nodes).is_none()) {
        match &e.body {
            Body::Constraint(constraint) => {
                let positions: Vec<_> = e.nodes.iter().map(|n| model.nodes[*n].position).collect();
                for equation in constraint.equations(&positions).unwrap_or_default() {
                    let follower = e.nodes[equation.dependent.0];
                    lines.extend(equation.terms.iter().map(|((n, _), _)| (e.nodes[*n], follower)));
                }
            }
            _ => {
                if let [i, j] = e.nodes[..] {
                    lines.insert((i, j));
                }
            }
        }
    }
    lines.retain(|(i, j)| i != j);
    lines
}

fn text(mesh: &Mesh, frame: &Frame) -> String {
    let mut xml = String::from(
        "<?xml version=\"1.0\"?>\n<VTKFile type=\"UnstructuredGrid\" version=\"0.1\" byte_order=\"LittleEndian\">\n<UnstructuredGrid>\n",
    );
    xml.push_str(&mesh.xml);
    xml.push_str("<PointData Vectors=\"displacement\">\n");
    for (name, start) in [("displacement", 0), ("rotation", 3)] {
        array(&mut xml, "Float32", name, 3, |s| {
            for node in 0..mesh.nodes {
                if let Some([x, y, z]) = frame.displacements.get(6 * node + start..).map(first) {
                    line(s, format_args!("{x:?} {y:?} {z:?}"));
                }
            }
            for (node, r) in &mesh.corners {
                let of = |start: usize| frame.displacements.get(6 * node + start..).map(first);
                let (Some(u), Some(turn)) = (of(0), of(3)) else { continue };
                let [x, y, z] = if start == 0 { carried(u, turn, *r) } else { turn };
                line(s, format_args!("{x:?} {y:?} {z:?}"));
            }
        });
    }
    xml.push_str("</PointData>\n</Piece>\n</UnstructuredGrid>\n</VTKFile>\n");
    xml
}

/// Displacement of a point at a distance from a node that moves and turns: u + θ × r.
fn carried(u: [f32; 3], turn: [f32; 3], r: Vector3) -> [f32; 3] {
    let [x, y, z] = r.map(|x| x as f32);
    [
        u[0] + turn[1] * z - turn[2] * y,
        u[1] + turn[2] * x - turn[0] * z,
        u[2] + turn[0] * y - turn[1] * x,
    ]
}

fn first(u: &[f32]) -> [f32; 3] {
    [0, 1, 2].map(|i| u.get(i).copied().unwrap_or(f32::NAN))
}

fn array(xml: &mut String, kind: &str, name: &str, width: usize, fill: impl FnOnce(&mut String)) {
    line(
        xml,
        format_args!(
            "<DataArray type=\"{kind}\" Name=\"{name}\" NumberOfComponents=\"{width}\" format=\"ascii\">"
        ),
    );
    fill(xml);
    xml.push_str("</DataArray>\n");
}

fn line(s: &mut String, text: std::fmt::Arguments<'_>) {
    // Writing to a String cannot fail.
    let _ = writeln!(s, "{text}");
}
