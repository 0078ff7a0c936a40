//! Links led through deformations.

mod common;

use common::trilith;

#[test]
fn an_exercise_prints_its_energies_and_writes_the_loop() {
    let folder = tempfile::tempdir().unwrap();
    let args = ["exercise", "Dashpot", "--set", "c=10 kN*s/m", "--amplitude", "20 mm"];
    let (status, out, err) = trilith(folder.path(), &args);
    assert_eq!(status, 0, "{out}{err}");
    // π c ω a² of a cycle at 1 Hz.
    for part in ["c: \"10 kN*s/m\"", "3 growing cycles", "U1", "78.957", "viscous", "balance error"]
    {
        assert!(out.contains(part), "{part} in\n{out}");
    }
    let files = folder.path().join("out/exercise_Dashpot");
    let svg = std::fs::read_to_string(files.join("loop.svg")).unwrap();
    assert!(svg.starts_with("<svg ") && svg.contains("force [kN]"), "{svg}");
    let csv = std::fs::read_to_string(files.join("path.csv")).unwrap();
    assert!(
        csv.starts_with("t [s],d U1 [m],v U1 [m/s],f U1 [N],work [J],stored [J],"),
        "{csv:.200}"
    );
}

#[test]
fn a_restitution_in_an_exercise_gets_a_mass_and_says_so() {
    let folder = tempfile::tempdir().unwrap();
    let exercise = |set: &[&str]| {
        let args = [&["exercise", "NLink", "--no-files", "--set", "restitution=0.5"], set].concat();
        trilith(folder.path(), &args)
    };
    let (status, out, err) = exercise(&[]);
    assert_eq!(status, 0, "{err}");
    assert!(out.contains("a mass of 1 t"), "{out}");
    let (status, out, _) = exercise(&["--set", "impact_mass=2 t"]);
    assert!(status == 0 && !out.contains("note"), "{out}");
    assert!(!folder.path().join("out").exists());
}

#[test]
fn an_exercise_that_cannot_be_says_what_would_be_right() {
    let folder = tempfile::tempdir().unwrap();
    for (args, parts) in [
        (&["Dahspot"][..], &["there is no kind `Dahspot`", "`Dashpot`"][..]),
        (&["Beam"], &["linear element: only links"]),
        (&["Gap", "--set", "k=5 m"], &["E0111", "must be a value in N/m", "^^^"]),
        (&["Gap", "--set", "opning=3 mm"], &["no field `opning`", "did you mean `opening`?"]),
        (&["Gap", "--set", "k=none"], &["no `k`, which Gap needs"]),
        (&["NLink", "--amplitude", "1 mm,2 mm"], &["2 of 3 values", "U1, U2, U3", "by name"]),
        (&["NLink", "--amplitude", "U4=1 mm"], &["no coordinate `U4`", "did you mean"]),
        (&["Gap", "--mean", "3 s"], &["`--mean` of U1", "must be in m"]),
        (&["Gap", "--cycles", "0"], &["--cycles"]),
        (&["Gap", "--frequency", "0 Hz"], &["--frequency"]),
    ] {
        let all = [&["exercise", "--no-files"], args].concat();
        let (status, out, err) = trilith(folder.path(), &all);
        assert_eq!((status, out.as_str()), (2, ""), "{args:?}: {err}");
        for part in parts {
            assert!(err.contains(part), "{args:?}: {part} in\n{err}");
        }
    }
}
