//! Deformed shapes for ParaView: `model.pvd` and `frames/*.vtu`.
//!
//! Arrays are in base64, little endian, behind their number of bytes: numbers as text took longer than the march of a large
//! model. \[Kitware, VTK XML file formats, "inline" data\]

use crate::{FileError, Frame, Frames};
use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use std::collections::BTreeSet;
use std::fmt::Write;
use std::path::Path;
use trilith_element::Vector3;
use trilith_model::{Body, Model};

/// The folder of the frames.
pub(crate) const FRAMES: &str = "frames";

const LINE: u8 = 3;
const VERTEX: u8 = 1;

/// Takes out the frames of a former run: where there were more of them, they would be left among the new ones.
pub(crate) fn clear(dir: &Path) -> Result<(), FileError> {
    let folder = dir.join(FRAMES);
    if !folder.is_dir() {
        return Ok(());
    }
    for old in std::fs::read_dir(&folder).map_err(FileError::at(&folder))?.flatten() {
        let path = old.path();
        if path.file_name().and_then(|name| name.to_str()).is_some_and(is_frame) {
            std::fs::remove_file(&path).map_err(FileError::at(&path))?;
        }
    }
    Ok(())
}

/// Writes `model.pvd` and the frames beside it.
pub(crate) fn write(path: &Path, model: &Model, frames: &Frames) -> Result<(), FileError> {
    let folder = path.with_file_name(FRAMES);
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
    std::fs::write(path, index).map_err(FileError::at(path))
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
    let own = model.nodes.iter().map(|n| n.position);
    let of_corner = |(node, r): &(usize, Vector3)| {
        let at = model.nodes[*node].position;
        [0, 1, 2].map(|i| at[i] + r[i])
    };
    let points = own.chain(corners.iter().map(of_corner)).flatten();
    array(&mut xml, "Float64", "points", 3, points.flat_map(f64::to_le_bytes));
    xml.push_str("</Points>\n<Cells>\n");
    let connected = (0..nodes).chain(lines.iter().flat_map(|(i, j)| [*i, *j]));
    array(&mut xml, "Int32", "connectivity", 1, connected.flat_map(integer));
    let ends = (1..=nodes).chain((1..=lines.len()).map(|i| nodes + 2 * i));
    array(&mut xml, "Int32", "offsets", 1, ends.flat_map(integer));
    let types = [VERTEX].repeat(nodes).into_iter().chain([LINE].repeat(lines.len()));
    array(&mut xml, "UInt8", "types", 1, types);
    xml.push_str("</Cells>\n");
    let head = format!(
        "<Piece NumberOfPoints=\"{}\" NumberOfCells=\"{}\">\n{xml}",
        nodes + corners.len(),
        nodes + lines.len()
    );
    Mesh { corners, xml: head }
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
        "<?xml version=\"1.0\"?>\n<VTKFile type=\"UnstructuredGrid\" version=\"1.0\" byte_order=\"LittleEndian\" header_type=\"UInt64\">\n<UnstructuredGrid>\n",
    );
    xml.push_str(&mesh.xml);
    xml.push_str("<PointData Vectors=\"displacement\">\n");
    for (name, start) in [("displacement", 0), ("rotation", 3)] {
        let own = frame.displacements.chunks_exact(6).map(|node| first(&node[start..]));
        let of_corner = |(node, r): &(usize, Vector3)| {
            let u = &frame.displacements[6 * node..];
            let turn = first(&u[3..]);
            if start == 0 { carried(first(u), turn, *r) } else { turn }
        };
        let all = own.chain(mesh.corners.iter().map(of_corner)).flatten();
        array(&mut xml, "Float32", name, 3, all.flat_map(f32::to_le_bytes));
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
    [u[0], u[1], u[2]]
}

/// A number of a point or of an end, of which there are fewer than 2³¹.
fn integer(i: usize) -> [u8; 4] {
    (i as i32).to_le_bytes()
}

fn array(xml: &mut String, kind: &str, name: &str, width: usize, values: impl Iterator<Item = u8>) {
    line(
        xml,
        format_args!(
            "<DataArray type=\"{kind}\" Name=\"{name}\" NumberOfComponents=\"{width}\" format=\"binary\">"
        ),
    );
    let mut bytes = vec![0; size_of::<u64>()];
    bytes.extend(values);
    let (length, values) = bytes.split_at_mut(size_of::<u64>());
    length.copy_from_slice(&(values.len() as u64).to_le_bytes());
    STANDARD.encode_string(&bytes, xml);
    xml.push_str("\n</DataArray>\n");
}

fn line(s: &mut String, text: std::fmt::Arguments<'_>) {
    // Writing to a String cannot fail.
    let _ = writeln!(s, "{text}");
}
