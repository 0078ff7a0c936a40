//! Vectors, rotations and local axes as SAP2000 has them.

/// A vector of space.
pub type Vector = [f64; 3];

/// Local axes 1, 2, 3 as rows, in global directions.
pub type Axes = [Vector; 3];

/// Axes along X, Y and Z.
pub const GLOBAL: Axes = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];

/// Sine of the angle to Z below which a line counts as vertical, as SAP2000 has it.
const VERTICAL: f64 = 1e-3;

pub fn sub(a: Vector, b: Vector) -> Vector {
    [a[0] - b[0], a[1] - b[1], a[2] - b[2]]
}

/// a + s b.
pub fn along(a: Vector, s: f64, b: Vector) -> Vector {
    [a[0] + s * b[0], a[1] + s * b[1], a[2] + s * b[2]]
}

pub fn dot(a: Vector, b: Vector) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

pub fn cross(a: Vector, b: Vector) -> Vector {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

pub fn norm(a: Vector) -> f64 {
    dot(a, a).sqrt()
}

pub fn unit(a: Vector) -> Vector {
    let length = norm(a);
    a.map(|x| x / length)
}

/// Local components of a global vector.
pub fn to_local(axes: &Axes, v: Vector) -> Vector {
    axes.map(|axis| dot(axis, v))
}

/// Global components of a local vector.
pub fn to_global(axes: &Axes, v: Vector) -> Vector {
    let mut out = [0.0; 3];
    for (axis, x) in axes.iter().zip(v) {
        out = along(out, x, *axis);
    }
    out
}

/// Both halves of six components: translations and rotations.
pub fn six(axes: &Axes, v: [f64; 6], turn: fn(&Axes, Vector) -> Vector) -> [f64; 6] {
    let [a, b, c, d, e, f] = v;
    let ([x, y, z], [u, v, w]) = (turn(axes, [a, b, c]), turn(axes, [d, e, f]));
    [x, y, z, u, v, w]
}

/// Axes of a line: 1 along it, 1–2 upright with 2 upward, or 2 along X where it is vertical; turned about 1.
pub fn line_axes(from: Vector, to: Vector, degrees: f64) -> Axes {
    let one = unit(sub(to, from));
    let upright = one[0].hypot(one[1]) < VERTICAL;
    let reference = if upright { [1.0, 0.0, 0.0] } else { [0.0, 0.0, 1.0] };
    let three = unit(cross(one, reference));
    let two = cross(three, one);
    turned([one, two, three], degrees)
}

/// Axes of a link without length: 1 upward, 2 along X; turned about 1.
pub fn point_axes(degrees: f64) -> Axes {
    turned([[0.0, 0.0, 1.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]], degrees)
}

fn turned([one, two, three]: Axes, degrees: f64) -> Axes {
    if degrees == 0.0 {
        return [one, two, three];
    }
    let (s, c) = exact(degrees);
    [one, along(two.map(|x| x * c), s, three), along(three.map(|x| x * c), -s, two)]
}

/// Sine and cosine, exact for right angles.
fn exact(degrees: f64) -> (f64, f64) {
    match degrees.rem_euclid(360.0) {
        0.0 => (0.0, 1.0),
        90.0 => (1.0, 0.0),
        180.0 => (0.0, -1.0),
        270.0 => (-1.0, 0.0),
        _ => degrees.to_radians().sin_cos(),
    }
}

/// Global axes turned by a about 3, then by b about the new 2, then by c about the new 1.
pub fn joint_axes(a: f64, b: f64, c: f64) -> Axes {
    let [one, two, three] = GLOBAL;
    let [three, one, two] = turned([three, one, two], a);
    let [two, three, one] = turned([two, three, one], b);
    turned([one, two, three], c)
}

/// True where all axes run along X, Y and Z, either way.
pub fn is_along_global(axes: &Axes) -> bool {
    axes.iter().flatten().all(|x| x.abs() < 1e-9 || (x.abs() - 1.0).abs() < 1e-9)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn close(a: Axes, b: Axes) {
        for (x, y) in a.iter().flatten().zip(b.iter().flatten()) {
            assert!((x - y).abs() < 1e-12, "{a:?} {b:?}");
        }
    }

    #[test]
    fn a_beam_has_2_upward_and_a_column_2_along_x() {
        let [x, y, z] = GLOBAL;
        close(line_axes([0.0; 3], [3.0, 0.0, 0.0], 0.0), [x, z, [0.0, -1.0, 0.0]]);
        close(line_axes([0.0; 3], [0.0, 0.0, 2.0], 0.0), [z, x, y]);
        close(line_axes([0.0; 3], [0.0, 0.0, 2.0], 90.0), [z, y, [-1.0, 0.0, 0.0]]);
    }

    #[test]
    fn joints_turn_about_3_then_2_then_1() {
        let [x, y, z] = GLOBAL;
        close(joint_axes(90.0, 0.0, 0.0), [y, [-1.0, 0.0, 0.0], z]);
        // About Y by −36.87°: local 1 points up.
        let turned = joint_axes(0.0, -36.86989764584401, 0.0);
        close(turned, [[0.8, 0.0, 0.6], y, [-0.6, 0.0, 0.8]]);
        close(joint_axes(0.0, 0.0, 90.0), [x, z, [0.0, -1.0, 0.0]]);
    }

    #[test]
    fn six_components_go_there_and_back() {
        let axes = joint_axes(20.0, 30.0, 40.0);
        let v = [1.0, 2.0, 3.0, 4.0, 5.0, 6.0];
        let back = six(&axes, six(&axes, v, to_local), to_global);
        assert!(v.iter().zip(back).all(|(a, b)| (a - b).abs() < 1e-12));
    }
}
