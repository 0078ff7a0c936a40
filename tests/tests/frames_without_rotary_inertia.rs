//! Rotations of nodes that have mass but no rotary inertia: FNA keeps of its vectors only what moves with a mass, and
//! all else must follow as if it had been kept.

use trilith::generate::Frame;
use trilith_model::SolverKind;
use trilith_tests::{output, parse, trace};

#[test]
fn rotations_and_moments_follow_the_masses() {
    let frame = Frame { vectors: Some(200), duration: 4.0, ..Frame::preset("P1e3").unwrap() };
    let outputs = r#"outputs: {
        "turn": Displacement(node: "0 0 5", dof: Ry),
        "moment": ElementForce(element: "z 0 0 4", end: 0, dof: Ry),
        "drift": Displacement(terms: [(node: "0 0 5", dof: Ux), (node: "0 0 4", dof: Ux, factor: -1),
            (node: "0 0 5", dof: Ry, factor: "1 m")]),
"#;
    let (model, system) = parse(&frame.to_ron().replace("outputs: {\n", outputs), &[]);
    let (fna, result) = trace(&model, &system, SolverKind::Fna);

    // The rotation among the outputs is that of the motion of all nodes.
    let node = model.nodes.iter().position(|n| n.name == "0 0 5").unwrap();
    let &[(place, factor)] = system.reduction.expand(6 * node + 4) else { panic!() };
    let u = &result.end.displacement;
    let turn = output(&model, "turn");
    assert!(
        (fna.last[turn] / (factor * u[place]) - 1.0).abs() < 1e-12,
        "{} {}",
        fna.last[turn],
        u[place]
    );

    // No forces are left where there is neither mass nor link.
    let mut linked = vec![false; system.order()];
    system.links.rows.iter().flatten().for_each(|(i, _)| linked[*i] = true);
    let (force, mass) = (system.stiffness.mul(u), system.mass.diagonal());
    let sums = system.stiffness.row_sums();
    let largest = u.iter().zip(&sums).map(|(u, k)| (u * k).abs()).fold(0.0, f64::max);
    let free: Vec<usize> = (0..system.order()).filter(|i| mass[*i] == 0.0 && !linked[*i]).collect();
    assert!(free.len() >= system.order() / 3, "{}", free.len());
    assert!(free.iter().all(|i| force[*i].abs() < 1e-12 * largest));

    // Direct integration has all of them among its unknowns.
    let (hht, _) = trace(&model, &system, SolverKind::Hht);
    for (name, limit) in [("turn", 0.006), ("moment", 0.04), ("drift", 0.006)] {
        let i = output(&model, name);
        assert!(hht.peak(i) > 0.0);
        let difference = fna.difference(&hht, i);
        assert!(difference < limit, "{name}: {difference}");
    }
}
