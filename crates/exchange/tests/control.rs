//! Static cases under displacement control.

mod common;

use common::{close, file, import, last, model};
use trilith_exchange::{Options, sap2000};

#[test]
fn a_single_free_direction_goes_where_its_cases_lead_it() {
    let import = import(&file("pushed.s2k"), None);
    assert_eq!(import.report.losses(), 0, "{}", import.report.text());
    let names: Vec<&str> = import.draft.cases.iter().map(|(name, _)| name.as_str()).collect();
    assert_eq!(names, ["OUT", "BACK"]);
    let model = model(&import);
    let outputs = ["link 1 U1 deformation", "link 1 U1 force"];
    // Out to 6 mm on the second line, and back through twice the first one to nothing left.
    for (case, d, f) in [("OUT", 6e-3, 11e3), ("BACK", 0.0, -9.8e3)] {
        let got = last(&model, case, &outputs);
        assert!((got[0] - d).abs() < 1e-12, "{case}: {got:?}");
        close(got[1], f, 1e-9, case);
    }
}

#[test]
fn control_of_one_direction_among_others_is_lost_by_name() {
    let text = std::fs::read_to_string(file("pushed.s2k")).unwrap();
    for (from, to, losses) in [
        ("UY=No", "UY=Yes", 2),
        ("Case=OUT   Type=NonStatic", "Case=OUT   Type=LinStatic", 2),
        ("LinkType=\"MultiLinear Plastic\"", "LinkType=\"Damper - Exponential\"", 3),
    ] {
        let import =
            sap2000::import(text.replace(from, to).as_bytes(), &Options::default()).unwrap();
        assert_eq!(import.report.losses(), losses, "{to}\n{}", import.report.text());
    }
}
