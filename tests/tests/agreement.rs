//! FNA and direct integration on the same files.

use trilith_model::{Analysis, Model, SolverKind, StepControl};
use trilith_solvers::Status;
use trilith_system::System;
use trilith_tests::{output, parse, set_step, shipped, shipped_text, trace};

/// Peaks of every output of two solvers, compared to the larger peak of the output.
fn assert_peaks_agree(model: &Model, system: &System, solvers: [SolverKind; 2], tolerance: f64) {
    let [(a, ra), (b, rb)] = solvers.map(|s| trace(model, system, s));
    assert_eq!((ra.status, rb.status), (Status::Converged, Status::Converged));
    for (i, output) in model.outputs.iter().enumerate() {
        let scale = a.peak(i).max(b.peak(i));
        for (x, y) in [(a.max[i], b.max[i]), (a.min[i], b.min[i])] {
            assert!(
                (x - y).abs() <= tolerance * scale,
                "{}: {x:.6e} against {y:.6e}, {:.3} % of the peak",
                output.name,
                100.0 * (x - y).abs() / scale
            );
        }
    }
}

#[test]
fn fna_and_hht_agree_on_every_peak_of_the_isolated_frame() {
    let (model, system) = shipped("isolated_frame.ron", &[]);
    assert_peaks_agree(&model, &system, [SolverKind::Fna, SolverKind::Hht], 0.005);
}

#[test]
fn fna_and_hht_agree_on_every_peak_of_the_pounding_frames() {
    let (model, system) = shipped("pounding_frames.ron", &[]);
    assert_peaks_agree(&model, &system, [SolverKind::Fna, SolverKind::Hht], 0.005);
}

#[test]
fn the_textbook_integrator_gives_what_the_link_kernel_gives() {
    let (mut model, system) = shipped("pounding_frames.ron", &[("duration", "4".into())]);
    set_step(&mut model, StepControl::Fixed { substeps: 2 });
    assert_peaks_agree(&model, &system, [SolverKind::Hht, SolverKind::FullNewton], 1e-6);
}

/// Two linear frames: a gap that nothing closes. A step takes one factorisation, whatever damps it, where a tangent without
/// modal damping would leave the damping ratio of what was missing to another.
#[test]
fn the_textbook_integrator_corrects_for_modal_damping_at_once() {
    let set = [("gap", "1 m".to_owned()), ("duration", "1 s".to_owned())];
    let (mut model, system) = shipped("pounding_frames.ron", &set);
    set_step(&mut model, StepControl::Fixed { substeps: 1 });
    let (_, result) = trace(&model, &system, SolverKind::FullNewton);
    assert_eq!(result.work.substeps, 500);
    assert_eq!(result.work.factorizations, 500, "{:?}", result.work);
}

#[test]
fn hht_on_a_complete_basis_is_hht_on_all_degrees_of_freedom() {
    let (mut model, system) = shipped("pounding_frames.ron", &[("duration", "4".into())]);
    set_step(&mut model, StepControl::Fixed { substeps: 2 });
    assert_peaks_agree(&model, &system, [SolverKind::Hht, SolverKind::RitzHht], 1e-6);
}

/// Observed order of the difference between FNA and HHT as fixed steps are halved.
fn orders(model: &mut Model, system: &System, substeps: [usize; 3], name: &str) -> [f64; 2] {
    let i = output(model, name);
    let difference = substeps.map(|n| {
        set_step(model, StepControl::Fixed { substeps: n });
        let (a, _) = trace(model, system, SolverKind::Fna);
        let (b, _) = trace(model, system, SolverKind::Hht);
        a.difference(&b, i)
    });
    eprintln!("{name}: differences {difference:?}");
    [(difference[0] / difference[1]).log2(), (difference[1] / difference[2]).log2()]
}

#[test]
fn the_difference_of_fna_and_hht_falls_at_second_order_in_elastic_pounding() {
    let set = [("c_contact", "1 N*s/m".to_owned()), ("duration", "4".to_owned())];
    let (mut model, system) = shipped("pounding_frames.ron", &set);
    let observed = orders(&mut model, &system, [4, 8, 16], "roof_left");
    assert!(observed.iter().all(|o| *o > 1.7), "observed orders {observed:?}");
}

#[test]
fn the_difference_of_fna_and_hht_falls_at_second_order_on_friction_pendulums() {
    let (mut model, system) = shipped("isolated_frame.ron", &[("duration", "4".to_owned())]);
    let observed = orders(&mut model, &system, [2, 4, 8], "base_x");
    assert!(observed.iter().all(|o| *o > 1.7), "observed orders {observed:?}");
}

#[test]
fn the_energy_of_every_shipped_model_closes_to_a_thousandth_under_both_solvers() {
    let mut files: Vec<String> = std::fs::read_dir(trilith_tests::root().join("models"))
        .unwrap()
        .map(|f| f.unwrap().file_name().into_string().unwrap())
        .filter(|f| f.ends_with(".ron"))
        .collect();
    files.sort();
    assert!(files.len() >= 6, "{files:?}");
    for file in files {
        let (model, system) = shipped(&file, &[]);
        for solver in [SolverKind::Fna, SolverKind::Hht] {
            let (_, result) = trace(&model, &system, solver);
            assert_eq!(result.status, Status::Converged, "{file} {}", solver.name());
            let error = result.energy.error_relative;
            assert!(error < 1e-3, "{file} {}: energy error {error:.2e}", solver.name());
        }
    }
}

/// With a complete basis the dummies are only algebra: a thousandfold either way of the automatic share
/// (1e-3 of the contact stiffness) changes nothing beyond the tolerance of the step control.
#[test]
fn fna_does_not_depend_on_the_dummy_stiffness() {
    let text = shipped_text("rigid_block.ron");
    let with = |dummy: f64| {
        let text =
            text.replace("NLink(node:", &format!("NLink(effective_stiffness: {dummy:e}, node:"));
        assert!(text.contains("effective_stiffness"));
        let set = [("mu", "0.6".to_owned()), ("ah", "1.5".into()), ("cycles", "0.5".into())];
        let (model, system) = parse(&text, &set);
        let (t, r) = trace(&model, &system, SolverKind::Fna);
        assert_eq!(r.status, Status::Converged);
        t
    };
    let plain = with(0.0);
    for dummy in [5e2, 5e5, 5e8] {
        let t = with(dummy);
        for (i, scale) in [(0, plain.peak(0)), (1, plain.peak(1)), (2, plain.peak(2))] {
            assert!((t.max[i] - plain.max[i]).abs() < 0.005 * scale, "output {i}, dummy {dummy}");
            assert!((t.min[i] - plain.min[i]).abs() < 0.005 * scale, "output {i}, dummy {dummy}");
        }
    }
}

/// Dummies beside modal damping couple the modes; the damping still acts on the structure alone.
#[test]
fn dummies_do_not_damp_the_sliding_of_the_isolated_frame() {
    let text = shipped_text("isolated_frame.ron");
    let (mut plain, plain_system) = parse(&text, &[("duration", "4".to_owned())]);
    let (mut model, mut system) = parse(&text, &[("duration", "4".to_owned())]);
    for m in [&mut plain, &mut model] {
        set_step(m, StepControl::Fixed { substeps: 2 });
        if let Some(Analysis::Dynamic(d)) = m.cases.last_mut().map(|c| &mut c.analysis) {
            d.solution.energy_limit = 1.0;
        }
    }
    system.links.effective = system.links.engaged(&model).iter().map(|k| 0.01 * k).collect();
    let (a, _) = trace(&plain, &plain_system, SolverKind::Fna);
    let (b, _) = trace(&model, &system, SolverKind::Fna);
    let i = output(&plain, "base_x");
    assert!(b.difference(&a, i) < 0.01, "difference {}", b.difference(&a, i));
}

/// Truncated bases come nearer to the complete one as they grow; isolator displacements come first.
#[test]
fn a_ritz_basis_converges_to_the_complete_one() {
    let run = |vectors: usize| {
        let (mut model, system) = shipped("isolated_frame.ron", &[("duration", "4".to_owned())]);
        if let Some(Analysis::Dynamic(d)) = model.cases.last_mut().map(|c| &mut c.analysis) {
            d.solution.basis.vectors = Some(vectors);
        }
        let (t, r) = trace(&model, &system, SolverKind::Fna);
        let basis = r.basis.expect("a basis");
        eprintln!("{vectors} vectors: {} kept, worst {:?}", basis.vectors, basis.adequacy.first());
        (t, output(&model, "base_x"), output(&model, "drift1_x"), r.warnings)
    };
    let (whole, base, drift, _) = run(84);
    // The structure has 36 modes.
    let differences: Vec<[f64; 2]> = [12, 24, 36]
        .iter()
        .map(|n| {
            let (t, ..) = run(*n);
            [t.difference(&whole, base), t.difference(&whole, drift)]
        })
        .collect();
    eprintln!("{differences:?}");
    assert!(differences.windows(2).all(|w| w[1][0] < w[0][0]), "{differences:?}");
    assert!(differences[1][0] < 0.01 && differences[2][1] < 0.05, "{differences:?}");
    let (_, _, _, warnings) = run(12);
    assert!(warnings.iter().any(|w| w.contains("flexibility")), "{warnings:?}");
}
