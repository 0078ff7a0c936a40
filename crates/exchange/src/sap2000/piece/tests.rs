use super::*;

fn piece(shear: f64) -> Piece {
    let section = Section {
        young: 2e8,
        shear: 8e7,
        area: 0.01,
        shear_areas: [shear; 2],
        moments: [1e-5, 1e-4],
        ..Section::default()
    };
    Piece {
        name: String::new(),
        nodes: [0, 1],
        at: [[0.0; 3], [4.0, 0.0, 0.0]],
        axes: crate::sap2000::geometry::line_axes([0.0; 3], [4.0, 0.0, 0.0], 0.0),
        section,
        start: 0.0,
        length: 4.0,
        rigid: [0.0; 2],
        released: [[false; 6]; 2],
        fixity: [[0.0; 6]; 2],
    }
}

/// Forces and moments about Y of both ends by 6 per length downward.
fn spread(p: &Piece) -> [f64; 4] {
    let mut loads = Loads::default();
    let down = [0.0, -6.0, 0.0, 0.0, 0.0, 0.0];
    p.spread(&mut loads, [0.0, 4.0], [down, down]);
    let [i, j] = p.at_nodes(&loads);
    [i[2], i[4], j[2], j[4]]
}

fn close(a: [f64; 4], b: [f64; 4]) {
    assert!(a.iter().zip(b).all(|(x, y)| (x - y).abs() < 1e-9), "{a:?} {b:?}");
}

#[test]
fn a_spread_load_goes_to_the_ends_as_books_have_it() {
    // w L/2 and w L²/12, with shear or without.
    close(spread(&piece(0.0)), [-12.0, 8.0, -12.0, -8.0]);
    close(spread(&piece(0.005)), [-12.0, 8.0, -12.0, -8.0]);
    // Hinged at the second end: 5/8 and 3/8 of it, w L²/8.
    let mut p = piece(0.0);
    p.released[1][5] = true;
    close(spread(&p), [-15.0, 12.0, -9.0, 0.0]);
    // A spring that is as good as rigid there.
    p.fixity[1][5] = 1e18;
    close(spread(&p), [-12.0, 8.0, -12.0, -8.0]);
    // Half a metre rigid at the first end: that stretch goes there, with its lever.
    let mut p = piece(0.0);
    p.rigid[0] = 0.5;
    let (q, m) = (6.0 * 3.5 / 2.0, 6.0 * 3.5 * 3.5 / 12.0);
    close(spread(&p), [-3.0 - q, 0.75 + m + 0.5 * q, -q, -m]);
    // Sideways, along −3, which is Y here: the same about Z.
    let (mut loads, aside) = (Loads::default(), [0.0, 0.0, -6.0, 0.0, 0.0, 0.0]);
    p.spread(&mut loads, [0.0, 4.0], [aside, aside]);
    let [i, j] = p.at_nodes(&loads);
    close([i[1], i[5], j[1], j[5]], [3.0 + q, 0.75 + m + 0.5 * q, q, -m]);
}

#[test]
fn displacements_of_the_ends_meet_the_stiffness_of_books() {
    let mut up = [[0.0; 6]; 2];
    up[1][2] = 1.0;
    let [i, j] = piece(0.0).forces(&up);
    let ei = 2e4;
    close([i[2], i[4], j[2], j[4]], [-12.0, 6.0 * 4.0, 12.0, 24.0].map(|x| x * ei / 64.0));
    // Φ of shear softens it by 1 + Φ.
    let phi = 12.0 * ei / (8e7 * 0.005 * 16.0);
    let [_, j] = piece(0.005).forces(&up);
    assert!((j[2] - 12.0 * ei / 64.0 / (1.0 + phi)).abs() < 1e-9);
}
