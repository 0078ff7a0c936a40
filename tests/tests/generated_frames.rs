//! The generated frames against the numbers that another program gives for the same definition.

use trilith::generate::Frame;
use trilith_linalg::lowest_modes;
use trilith_model::{Analysis, Model, SolverKind};
use trilith_system::System;
use trilith_tests::{output, parse, trace};

fn read(name: &str) -> (Frame, Model, System) {
    // The tolerance of the program: equal to nine digits is more than a preset asks for.
    let frame = Frame { link_tolerance: None, ..Frame::preset(name).unwrap() };
    let (model, system) = parse(&frame.to_ron(), &[]);
    (frame, model, system)
}

/// Size, masses and isolators of a frame; circular frequencies (rad/s) without and with the stiffness of the
/// bearings before they slip. An independent program in Python; `eigen` of OpenSees gives the same.
struct Expected {
    name: &'static str,
    order: usize,
    elements: usize,
    isolators: usize,
    mass: f64,
    corner: [f64; 3],
    damper: f64,
    sliding: [f64; 6],
    sticking: [f64; 6],
}

const EXPECTED: [Expected; 4] = [
    Expected {
        name: "P1e2",
        order: 96,
        elements: 28,
        isolators: 4,
        mass: 251_550.0,
        corner: [37_015.582_5, 246_770.55, 616_926_375.0],
        damper: 49_829.762_934_415_01,
        sliding: [1.97332231, 1.97332231, 1.97547296, 26.00082629, 26.00082629, 28.02736347],
        sticking: [14.84927505, 14.84927505, 16.6441219, 28.54396288, 40.4118766, 40.4118766],
    },
    Expected {
        name: "P1e3",
        order: 1_080,
        elements: 444,
        isolators: 30,
        mass: 5_809_462.5,
        corner: [42_743.120_343_75, 284_954.135_625, 712_385_339.062_5],
        damper: 1_150_801.586_767_537_3,
        sliding: [1.90018825, 1.94497132, 1.94605502, 8.22483754, 10.78324161, 12.70986488],
        sticking: [8.06367711, 8.19497454, 9.07603243, 10.65016797, 12.50805633, 14.15450765],
    },
    Expected {
        name: "P1e4s",
        order: 9_072,
        elements: 1_776,
        isolators: 30,
        mass: 5_809_462.5,
        corner: [42_743.120_343_75, 284_954.135_625, 712_385_339.062_5],
        damper: 1_150_801.586_767_537_3,
        sliding: [1.908108, 1.94496436, 1.94604707, 8.23503406, 10.85036817, 12.81623933],
        sticking: [8.06460041, 8.19554029, 9.10097177, 10.668085, 12.5839235, 14.29045015],
    },
    Expected {
        name: "P1e4",
        order: 10_140,
        elements: 4_641,
        isolators: 169,
        mass: 65_111_850.0,
        corner: [66_536.171_718_75, 443_574.478_125, 1_108_936_195.312_5],
        damper: 12_898_064.200_839_555,
        sliding: [1.84321433, 1.85098792, 1.85098792, 3.24906129, 4.49303957, 4.49303957],
        sticking: [4.45280951, 4.45280951, 4.7051206, 5.06098461, 5.85030051, 5.85030051],
    },
];

fn close(found: f64, expected: f64) {
    assert!((found / expected - 1.0).abs() < 1e-12, "{found} against {expected}");
}

#[test]
fn counts_masses_isolators_and_frequencies_are_those_of_the_definition() {
    for e in EXPECTED {
        let (frame, model, system) = read(e.name);
        let of = |kind: &str| model.elements.iter().filter(|x| x.kind == kind).count();
        assert_eq!((frame.nodes() * 6, frame.elements()), (e.order, e.elements), "{}", e.name);
        assert_eq!((system.order(), of("Beam")), (e.order, e.elements), "{}", e.name);
        assert_eq!((frame.isolators(), of("ElastomericBearing")), (e.isolators, e.isolators));
        assert_eq!(system.links.active.len(), 2 * e.isolators + 2);
        close(frame.mass(), e.mass);
        close(system.total_mass, e.mass);
        close(frame.damper(), e.damper);
        let value = |element: &str, parameter: &str| {
            let found = model.elements.iter().find(|x| x.name == element).unwrap();
            match found.values.0.iter().find(|(n, _)| n == parameter) {
                Some((_, trilith_element::Value::Number(x))) => *x,
                other => panic!("{other:?}"),
            }
        };
        let [fy, pendulum, vertical] = e.corner;
        close(value("bearing 0", "fy"), fy);
        close(value("bearing 0", "k"), 1e3 * fy);
        close(value("spring 0", "k2"), pendulum);
        close(value("spring 0", "k1"), vertical);
        close(value("damper y", "c"), e.damper);
        for (links, expected) in [(false, e.sliding), (true, e.sticking)] {
            let engaged = system.links.engaged(&model);
            let k = system.stiffness_with(
                &engaged.iter().map(|k| if links { *k } else { 0.0 }).collect::<Vec<_>>(),
            );
            let (found, _) = lowest_modes(&k, &system.mass, 6, 0.0).unwrap();
            for (found, expected) in found.iter().map(|w2| w2.sqrt()).zip(expected) {
                assert!((found - expected).abs() < 6e-9, "{}: {found} {expected}", e.name);
            }
        }
    }
}

#[test]
fn damping_and_motion_are_those_of_the_definition() {
    let (_, model, _) = read("P1e2");
    let trilith_model::Damping::Rayleigh { mass, stiffness } = model.damping else { panic!() };
    close(mass, 0.073_202_158_918_597_13);
    close(stiffness, 0.000_618_077_448_900_564_5);
    let Analysis::Dynamic(case) = &model.cases[0].analysis else { panic!() };
    for (base, peak) in case.base.iter().zip([3.924, 2.943]) {
        let table = model.functions[base.function].function.table().unwrap();
        assert_eq!((table.values().len(), table.end()), (4001, 20.0));
        close(table.peak(), peak);
    }
}

/// OpenSeesPy 3.7.1, Newmark average acceleration with steps of 5 ms and Newton iterations: largest displacement
/// of an isolator in the plane, along X, along Y; largest displacement of the roof against the base along X
/// and along Y. The first 4 000 steps; the load starts from zero, so no acceleration has to be known there.
#[test]
fn newmark_gives_the_peaks_of_opensees_to_nine_digits() {
    let expected = [
        (
            "P1e2",
            [
                0.185_296_844_132_982_59,
                0.149_006_506_030_936_6,
                0.117_599_175_920_098_22,
                0.009_501_030_953_279_033,
                0.007_219_474_769_942_696,
            ],
        ),
        (
            "P1e3",
            [
                0.170_595_285_092_761_3,
                0.147_606_651_167_698_06,
                0.104_184_713_913_347_08,
                0.027_018_571_127_468_09,
                0.022_670_386_160_267_34,
            ],
        ),
    ];
    for (name, expected) in expected {
        let (frame, model, system) = read(name);
        let (trace, result) = trace(&model, &system, SolverKind::Hht);
        assert_eq!((result.work.steps, result.work.substeps), (4000, 4000));
        let mut found = [0.0_f64; 5];
        for values in &trace.history {
            let at = |name: &str| values[output(&model, name)];
            let (x, y) = (at("roof_x").abs(), at("roof_y").abs());
            found[3] = found[3].max(x);
            found[4] = found[4].max(y);
            // Outputs of the isolators follow each other.
            let first = output(&model, "iso 0 x");
            for pair in values[first..first + 2 * frame.isolators()].chunks(2) {
                found[0] = found[0].max(pair[0].hypot(pair[1]));
                found[1] = found[1].max(pair[0].abs());
                found[2] = found[2].max(pair[1].abs());
            }
        }
        for (found, expected) in found.iter().zip(expected) {
            assert!((found / expected - 1.0).abs() < 1e-9, "{name}: {found} {expected}");
        }
    }
}

#[test]
fn what_is_no_frame_is_refused_and_any_frame_is_a_model() {
    let plain = Frame::default();
    for wrong in [
        Frame { bays: [0, 2], ..plain.clone() },
        Frame { cuts: 0, ..plain.clone() },
        Frame { vectors: Some(0), ..plain.clone() },
        Frame { mu: 0.0, ..plain.clone() },
        Frame { dt: f64::NAN, ..plain.clone() },
        Frame { bays: [100_000, 100_000], ..plain.clone() },
        Frame { duration: 1e18, ..plain.clone() },
        Frame { dt: 1e-12, ..plain.clone() },
        Frame { duration: f64::MAX, dt: f64::MIN_POSITIVE, ..plain.clone() },
        Frame { dt: 1000.0, ..plain.clone() },
        Frame { vectors: Some(usize::MAX), ..plain.clone() },
        Frame { bay: 1e200, ..plain.clone() },
        Frame { bay: 1e-200, ..plain.clone() },
        Frame { storey: 1e10, ..plain.clone() },
        Frame { density: 1e300, ..plain.clone() },
        Frame { radius: 1e-300, ..plain.clone() },
        Frame { slip: 1e-300, ..plain.clone() },
    ] {
        assert!(wrong.check().is_err(), "{wrong:?}");
    }
    for bays in [[1, 1], [1, 2], [3, 1], [2, 3]] {
        let frame = Frame { bays, cuts: 2, duration: 0.1, ..plain.clone() };
        assert_eq!(frame.check(), Ok(()));
        let (model, system) = parse(&frame.to_ron(), &[("mu", "0.08".into())]);
        assert_eq!(model.nodes.len(), frame.nodes());
        close(system.total_mass, frame.mass());
    }
}
