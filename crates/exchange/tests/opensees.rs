//! Scripts of OpenSees, imported and run, against OpenSees itself.
//!
//! Figures: OpenSees 3.7.1 on the same scripts, with the steps that stand in them.

mod common;

use common::{close, model};
use std::path::{Path, PathBuf};
use trilith::solvers::LinkStiffness;
use trilith::{Analysis, RunOptions};
use trilith_exchange::opensees::{self, Eigenvalues};
use trilith_exchange::{Import, Options};

/// Modes with links by their tangents, as the program answers.
struct Modes;

impl Eigenvalues for Modes {
    fn eigenvalues(
        &self,
        text: &str,
        after: Option<&str>,
        count: usize,
    ) -> Result<Vec<f64>, String> {
        let read = trilith::read_text(text, "model.ron", &trilith::registry(), &[]);
        let model = read.map_err(|e| format!("{e:?}\n{text}"))?;
        let after = after.and_then(|name| model.case(name));
        let analysis = Analysis::new(&model).map_err(|e| e.to_string())?;
        let linear =
            analysis.linearised(&LinkStiffness::Tangent, after).map_err(|e| e.to_string())?;
        Ok(linear.modes(count).map_err(|e| e.to_string())?.omega2)
    }
}

fn script(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/opensees").join(name)
}

fn imported(name: &str) -> Import {
    let path = script(name);
    let bytes = std::fs::read(&path).unwrap();
    let options = Options { folder: path.parent().map(Into::into), path, ..Options::default() };
    opensees::import(&bytes, &options, &Modes).unwrap_or_else(|e| panic!("{e}"))
}

/// Periods with links by their tangents, longest first.
fn periods(import: &Import, after: Option<&str>, count: usize) -> Vec<f64> {
    let model = model(import);
    let after = after.map(|name| model.case(name).unwrap());
    let analysis = Analysis::new(&model).unwrap();
    let linear = analysis.linearised(&LinkStiffness::Tangent, after).unwrap();
    let modes = linear.modes(count).unwrap();
    modes.omega2.iter().map(|w| std::f64::consts::TAU / w.sqrt()).collect()
}

/// Largest and smallest values of outputs of the last case.
fn peaks(import: &Import, outputs: &[&str]) -> Vec<[f64; 2]> {
    let model = model(import);
    let case = model.cases.len() - 1;
    let run =
        Analysis::new(&model).and_then(|a| a.run(RunOptions { case, ..RunOptions::default() }));
    let run = run.unwrap_or_else(|e| panic!("{e}"));
    let of = |o: &&str| run.peak(o).map(|p| [p.max, p.min]).unwrap_or_else(|e| panic!("{o}: {e}"));
    outputs.iter().map(of).collect()
}

/// All within a share of the largest of each, and periods within 1e-5.
fn figures(name: &str, expected: &[(&str, f64, f64)]) -> Import {
    let import = imported(name);
    assert_eq!(import.report.losses(), 0, "{}", import.report.text());
    let names: Vec<&str> = expected.iter().map(|e| e.0).collect();
    for (got, (output, max, min)) in peaks(&import, &names).into_iter().zip(expected) {
        let size = max.abs().max(min.abs());
        for (a, b) in got.into_iter().zip([max, min]) {
            // 0 where OpenSees' largest value is that before the first step.
            if *b != 0.0 {
                assert!((a - b).abs() <= 5e-3 * size, "{name} {output}: {a} is not {b}");
            }
        }
    }
    import
}

fn same_periods(import: &Import, after: Option<&str>, expected: &[f64]) {
    for (got, wanted) in periods(import, after, expected.len()).iter().zip(expected) {
        close(*got, *wanted, 1e-5, "period");
    }
}

#[test]
fn a_portal_carries_its_weight_and_is_shaken() {
    let import = figures(
        "portal.tcl",
        &[
            ("3 Ux", 0.0636015156, -0.0612665985),
            ("3 Uy", 0.0, -1.6119449845e-4),
            ("3 Rz", 3.2808297237e-3, -4.5523968263e-3),
            ("4 Ux", 0.0636002505, -0.0612678636),
        ],
    );
    same_periods(
        &import,
        Some("static 1"),
        &[0.548586823443, 0.0198691765316, 0.0198619686057, 0.0121649018391],
    );
}

#[test]
fn storeys_of_springs_take_a_record_in_a_loop_of_steps() {
    let import = figures("shear.tcl", &[("4 Ux", 0.0350658045, -0.0321971918)]);
    same_periods(&import, None, &[0.491479923674, 0.179332128548, 0.117573860252, 0.0941557883987]);
    // 4000 steps of their own are one case, and 400 samples a file.
    assert_eq!(import.draft.cases.len(), 1);
    assert_eq!(import.files.len(), 1);
}

#[test]
fn a_column_in_space_with_an_offset_bends_as_there() {
    let import = figures(
        "cantilever.tcl",
        &[
            ("3 Ux", 2.142923479788e-3, 2.142923479788e-3),
            ("3 Uy", 0.013240560991, 0.013240560991),
            ("3 Uz", -4.192606267146e-6, -4.192606267146e-6),
            ("3 Rx", -3.952625370787e-3, -3.952625370787e-3),
            ("3 Ry", 6.020649309748e-4, 6.020649309748e-4),
            ("3 Rz", 2.112206067682e-4, 2.112206067682e-4),
        ],
    );
    same_periods(
        &import,
        None,
        &[0.490861056354, 0.283073919786, 0.0478386875277, 0.0403287076485],
    );
}

#[test]
fn bars_yield_and_work_in_compression_alone() {
    figures(
        "truss.tcl",
        &[("4 Ux", 6.2357819e-3, -0.0251051552), ("4 Uy", 2.1517515e-3, -1.2274688e-3)],
    );
}

#[test]
fn an_oscillator_meets_a_stop_and_a_cable() {
    figures(
        "gap.tcl",
        &[("2 Ux", 0.0367766513, -0.0232703163), ("2 Ux velocity", 0.785141247, -0.7905352197)],
    );
}

#[test]
fn two_buildings_pound() {
    figures(
        "pounding.tcl",
        &[("11 Ux", 0.0841261183, -0.1759723889), ("12 Ux", 0.0771680789, -0.0453065928)],
    );
}

#[test]
fn a_block_slides_on_flat_sliders() {
    let import =
        figures("sliders.tcl", &[("5 Ux", 0.0, -0.1601397905), ("5 Uy", -4.905e-4, -4.905e-4)]);
    same_periods(&import, Some("static 1"), &[0.0993458826580, 0.0444288293816]);
}

#[test]
fn a_mass_swings_on_a_friction_pendulum() {
    // Slopes of 1:15: there the shear has a share in the force that presses, of the order of their squares.
    figures(
        "pendulum.tcl",
        &[("2 Ux", 0.1375209193, -0.1234464737), ("2 Uy", 0.0461070408, -0.0410853601)],
    );
}

#[test]
fn a_mass_moves_on_rubber_of_both_kinds() {
    figures(
        "rubber.tcl",
        &[("2 Ux", 0.2837747213, -0.2484627856), ("2 Uy", 0.0372880614, -0.0394583189)],
    );
}

#[test]
fn floors_that_are_rigid_turn_about_their_centres() {
    let import = figures(
        "diaphragm.tcl",
        &[
            ("19 Ux", 0.0347623219, -0.0248687876),
            ("29 Ux", 0.0717665416, -0.0520058832),
            ("29 Uy", 6.318663993e-3, -5.7143215943e-3),
            ("29 Rz", 1.4030069296e-3, -1.2219009693e-3),
            ("1 Ux reaction", 81521.229053, -114205.251065),
        ],
    );
    let expected = [0.547567820470, 0.527354768678, 0.285295132832, 0.163788883310, 0.161351008234];
    same_periods(&import, None, &expected);
}
