//! Every format gives the motion that its file was made from, and bad files say what is wrong and where.
//!
//! The files are made up by a formula, see `files/README.md`.

use std::path::{Path, PathBuf};
use trilith_record::{Component, Direction, Format, ReadOptions, Record, parse, read, select};

fn path(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/files").join(name)
}

fn all(name: &str) -> Vec<Record> {
    read(path(name), &ReadOptions::default()).unwrap_or_else(|e| panic!("{e}"))
}

/// The formula of the files, m/s².
fn made(i: usize, k: f64) -> f64 {
    let i = i as f64;
    2.0 * k * (0.7 * i + 0.2 * (k - 1.0)).sin() * (-0.05 * i).exp()
}

fn check(r: &Record, k: f64, count: usize, digit: f64) {
    assert_eq!(r.acceleration.len(), count);
    assert_eq!(r.dt, 0.01);
    for (i, a) in r.acceleration.iter().enumerate() {
        assert!((a - made(i, k)).abs() <= digit, "{i}: {a} {}", made(i, k));
    }
}

#[test]
fn peer_files_of_both_layouts() {
    for (name, component) in [("peer.at2", "090"), ("older.at2", "UP")] {
        let records = all(name);
        let [r] = records.as_slice() else { panic!("one component") };
        check(r, 1.0, 30, 1e-6);
        assert_eq!((r.format, r.component.as_str()), (Some(Format::At2), component));
        assert_eq!(
            (r.station.as_str(), r.event.as_str()),
            ("MADE-UP STATION", "NOWHERE EQ 01/02/03")
        );
    }
    assert_eq!(all("peer.at2")[0].direction, Direction::Azimuth(90.0));
    assert_eq!(all("older.at2")[0].direction, Direction::Vertical);
}

#[test]
fn knet_counts_lose_their_offset() {
    let records = all("knet.NS");
    let r = &records[0];
    let mean = (0..100).map(|i| made(i, 1.0)).sum::<f64>() / 100.0;
    assert_eq!((r.acceleration.len(), r.dt, r.direction), (100, 0.01, Direction::Azimuth(0.0)));
    for (i, a) in r.acceleration.iter().enumerate() {
        assert!((a - (made(i, 1.0) - mean)).abs() < 2e-5, "{i}");
    }
    assert_eq!((r.component.as_str(), r.station.as_str()), ("N-S", "MADEUP"));
}

#[test]
fn esm_files() {
    let records = all("esm.asc");
    check(&records[0], 1.0, 30, 1e-8);
    assert_eq!((records[0].component.as_str(), records[0].station.as_str()), ("HNE", "XX.MADE"));
    assert_eq!(records[0].direction, Direction::Azimuth(90.0));
}

#[test]
fn cosmos_files_with_two_channels() {
    let records = all("cosmos.v2");
    assert_eq!(records.len(), 2);
    check(&records[0], 1.0, 30, 1e-7);
    check(&records[1], 1.5, 30, 1e-7);
    assert_eq!(records[0].direction, Direction::Azimuth(90.0));
    assert_eq!(records[1].component, "360 deg");
    let one = select(records, Some(&Component::Name("360".into())), "x").unwrap();
    assert_eq!(one.direction, Direction::Azimuth(360.0));
}

#[test]
fn csmip_files_of_both_volumes() {
    for (name, factors) in [("csmip.v2", &[1.0, 1.5, 0.5][..]), ("csmip.v1", &[1.0, 0.5])] {
        let records = all(name);
        assert_eq!(records.len(), factors.len(), "{name}");
        let digit = if name == "csmip.v1" { 1e-5 } else { 1e-7 };
        for (r, k) in records.iter().zip(factors) {
            check(r, *k, 30, digit);
        }
        assert_eq!(records[0].station, "Nowhere");
        assert_eq!(records[0].direction, Direction::Azimuth(360.0));
        assert_eq!(records[factors.len() - 1].direction, Direction::Vertical);
    }
}

#[test]
fn columns_with_commas_with_blanks_and_alone() {
    let records = all("columns.csv");
    check(&records[0], 1.0, 30, 1e-6);
    check(&records[1], 0.5, 30, 1e-6);
    assert_eq!((records[0].component.as_str(), records[1].component.as_str()), ("north", "up"));
    check(&all("blanks.txt")[0], 1.0, 30, 1e-8);
    check(&all("one_column.txt")[0], 1.0, 30, 1e-8);
}

#[test]
fn values_in_rows_need_step_and_unit() {
    let rows: String = (0..6)
        .map(|row| {
            (0..5).map(|c| format!("{:9.5}", made(5 * row + c, 1.0))).collect::<String>() + "\n"
        })
        .collect();
    let options = ReadOptions { dt: Some(0.01), unit: Some(1.0), ..ReadOptions::default() };
    check(&parse(rows.as_bytes(), "rows.txt", &options).unwrap()[0], 1.0, 30, 1e-5);
}

/// What is told of a text, with its place.
fn told(text: &str, name: &str) -> String {
    told_with(text, name, &ReadOptions::default())
}

fn told_with(text: &str, name: &str, options: &ReadOptions) -> String {
    let error = parse(text.as_bytes(), name, options).expect_err(name);
    format!("{error}; {}", error.help().unwrap_or_default())
}

fn file(name: &str) -> String {
    std::fs::read_to_string(path(name)).unwrap()
}

/// Without its last lines.
fn cut(name: &str, lines: usize) -> String {
    let text = file(name);
    let all: Vec<&str> = text.lines().collect();
    all[..all.len() - lines].join("\n") + "\n"
}

#[test]
fn cut_files_tell_how_much_there_is() {
    assert!(
        told(&cut("peer.at2", 2), "a.at2")
            .starts_with("a.at2:8: the file ends after 20 of 30 values")
    );
    assert!(
        told(&cut("esm.asc", 10), "a.asc")
            .starts_with("a.asc:36: the file ends after 20 of 30 values")
    );
    let text = told(&cut("csmip.v2", 4), "a.v2");
    assert!(text.contains("no line `/&"), "{text}");
    let text = told(&cut("csmip.v2", 12), "a.v2");
    assert!(text.starts_with("a.v2:171: the file ends after 24 of 30 values"), "{text}");
    assert!(told(&cut("cosmos.v2", 3), "a.v2").contains("the file ends after 16 of 30 values"));
    assert!(
        told(&cut("knet.NS", 8), "a.NS")
            .starts_with("a.NS:22: the file ends after 40 of 100 values")
    );
}

#[test]
fn files_that_are_too_long_tell_so() {
    let more = file("peer.at2") + "  1.0E-3  2.0E-3\n";
    assert!(told(&more, "a.at2").starts_with("a.at2:4: the header states 30 values, there are 32"));
    let more = file("esm.asc") + "0.1\n";
    assert!(told(&more, "a.asc").contains("the header states 30 values, there are 31"));
}

#[test]
fn numbers_that_are_none_have_their_line() {
    let text = file("peer.at2").replacen(" 0.0000000E+00", "           NaN", 1);
    assert!(told(&text, "a.at2").starts_with("a.at2:5:13: `NaN` is no finite number"));
    let text = file("esm.asc").replace("\n0.000000\n", "\n******\n");
    assert!(told(&text, "a.asc").contains("`******` is no finite number"));
    let text = file("columns.csv").replace("0.05,", "0.05,x");
    assert!(told(&text, "a.csv").starts_with("a.csv:8:6: `x"));
}

#[test]
fn headers_without_step_or_unit_are_refused() {
    let text = file("peer.at2").replace(", DT=   .0100 SEC,", "");
    assert!(told(&text, "a.at2").starts_with("a.at2:4: the time step is stated nowhere"));
    let text = file("peer.at2").replace("NPTS=     30, DT=   .0100 SEC,", "");
    assert!(told(&text, "a.at2").contains("a.at2 has no line `NPTS="));
    let text = file("peer.at2").replace(" IN UNITS OF G", "");
    assert!(
        told(&text, "a.at2")
            .contains("the unit of the acceleration is stated nowhere; give the unit")
    );
    let text = file("peer.at2").replace("UNITS OF G", "UNITS OF FURLONGS");
    assert!(told(&text, "a.at2").starts_with("a.at2:3: `FURLONGS` is no unit of acceleration"));
    let text = file("columns.csv").replace(" [g]", "");
    assert!(told(&text, "a.csv").contains("the unit of the acceleration is stated nowhere"));
    let text = file("one_column.txt").replace("# dt: 10 ms\n", "");
    assert!(told(&text, "a.txt").contains("the time step is stated nowhere; give the time step"));
    let text = file("peer.at2").replace("ACCELERATION TIME SERIES", "VELOCITY TIME SERIES");
    assert!(told(&text, "a.vt2").contains("the values are velocities, not an acceleration"));
    let text = file("knet.NS").replace("1000(gal)/1000000", "none");
    assert!(told(&text, "a.NS").starts_with("a.NS:14: `none` is no scale such as"));
}

#[test]
fn what_file_and_user_say_must_agree() {
    let unit = ReadOptions { unit: Some(1.0), ..ReadOptions::default() };
    assert!(
        told_with(&file("peer.at2"), "a.at2", &unit)
            .contains("1 unit = 9.80665 m/s², 1 m/s² was given")
    );
    let same = ReadOptions { unit: Some(9.80665), dt: Some(0.01), ..ReadOptions::default() };
    assert!(parse(file("peer.at2").as_bytes(), "a.at2", &same).is_ok());
    let dt = ReadOptions { dt: Some(0.02), ..ReadOptions::default() };
    assert!(
        told_with(&file("peer.at2"), "a.at2", &dt)
            .contains("a time step of 0.01 s, 0.02 s was given")
    );
}

#[test]
fn uneven_and_falling_times_are_refused() {
    let text = file("columns.csv").replace("\n0.05,", "\n0.056,");
    let told_uneven = told(&text, "a.csv");
    assert!(
        told_uneven
            .starts_with("a.csv:8: time steps are uneven: 0.016 s to 0.056 s, 0.01 s before"),
        "{told_uneven}"
    );
    let text = file("columns.csv").replace("\n0.05,", "\n0.03,");
    assert!(told(&text, "a.csv").starts_with("a.csv:8: time must increase: 0.03 s follows 0.04 s"));
}

/// Times with few digits are even as far as their digits tell.
#[test]
fn rounded_times_are_even() {
    let text: String = (0..200).map(|i| format!("{:.3},1\n", f64::from(i) / 128.0)).collect();
    let options = ReadOptions { unit: Some(1.0), ..ReadOptions::default() };
    let r = parse(text.as_bytes(), "a.csv", &options).unwrap();
    assert!((r[0].dt - 1.0 / 128.0).abs() < 3e-6, "{}", r[0].dt);
}

#[test]
fn a_peak_that_the_data_do_not_have_is_told() {
    let text = file("csmip.v2").replacen(
        "Peak acceleration =",
        "Peak acceleration = 300.0 cm/sec/sec ",
        1,
    );
    assert!(
        told(&text, "a.v2")
            .starts_with("a.v2:18: the header states a peak of 3 m/s², the data have 1.")
    );
    let text = file("esm.asc").replace("UNITS: cm/s^2", "UNITS: m/s^2");
    assert!(told(&text, "a.asc").contains("the header states a peak of"));
}

#[test]
fn what_is_no_record_is_named() {
    assert!(told("", "a.at2").starts_with("a.at2 is empty"));
    assert!(told(" \n\n", "a.at2").starts_with("a.at2 is empty"));
    assert!(
        told("PK\u{3}\u{4}abc", "a.at2")
            .starts_with("a.at2 is a packed file (zip); unpack it first")
    );
    assert!(told("abc\0def", "a.at2").starts_with("a.at2 is a binary file, not a text"));
    assert!(
        told("some words\nand more\n", "a.txt")
            .contains("a.txt is in no format that is known here; the formats are AT2,")
    );
    assert!(told("0.1\n0.2\n", "a.at2").contains("a.at2 has no line `NPTS="));
    assert!(
        told_with(
            "# unit: g\n0.1\n",
            "a.txt",
            &ReadOptions { dt: Some(0.1), ..Default::default() }
        )
        .contains("at least two samples, this one has 1")
    );
    let gone = read("no/such/file.at2", &ReadOptions::default()).unwrap_err().to_string();
    assert!(gone.starts_with("no/such/file.at2 cannot be read: "), "{gone}");
}

#[test]
fn film_digitised_in_pairs_is_refused() {
    let text = file("csmip.v1");
    let data = text.find("    30 Accelerogram").unwrap();
    let text = text[..data].to_owned()
        + "   .000  -.006   .005   .007\n/&  ---  End of data for channel  1  ---\n";
    assert!(told(&text, "a.raw").contains("pairs of time and acceleration"));
}

#[test]
fn counts_without_a_scale_are_refused() {
    let text = file("cosmos.v2");
    let mut ints: String = format!("{:8}{:8}{:8}", 2, 1, 4);
    assert!(text.contains(&ints));
    let replaced = format!("{:8}{:8}{:8}", 0, 1, 50);
    ints = text.replace(&ints, &replaced);
    assert!(told(&ints, "a.v0").contains("the values are counts of the recorder; give the unit"));
}

#[test]
fn components_are_chosen_by_name_or_number() {
    let pick = |c: Option<Component>| select(all("csmip.v2"), c.as_ref(), "a.v2");
    assert_eq!(pick(Some(Component::Number(3))).unwrap().component, "Up");
    assert_eq!(pick(Some(Component::Name("up".into()))).unwrap().component, "Up");
    assert_eq!(pick(Some(Component::Name("90".into()))).unwrap().component, "90 Deg");
    let error = pick(None).unwrap_err();
    assert_eq!(error.to_string(), "a.v2 has 3 components");
    assert_eq!(
        error.help().unwrap(),
        "name one, or give its number: 1 `360 Deg`, 2 `90 Deg`, 3 `Up`"
    );
    assert!(pick(Some(Component::Name("Deg".into()))).is_err());
    assert!(pick(Some(Component::Number(0))).is_err());
}

/// A real record where `TRILITH_RECORDS` names its folder; it may not be shipped.
#[test]
fn the_peknold_version_of_el_centro() {
    let Some(folder) = std::env::var_os("TRILITH_RECORDS") else {
        eprintln!("record not available; TRILITH_RECORDS names the folder it is in");
        return;
    };
    let r = read(Path::new(&folder).join("elcentro_1940_ns.at2"), &ReadOptions::default());
    let r = &r.unwrap_or_else(|e| panic!("{e}"))[0];
    assert_eq!((r.acceleration.len(), r.dt), (1559, 0.02));
    let peak = trilith_record::measure::peak(&r.acceleration);
    assert!((peak / 9.80665 - 0.31882).abs() < 1e-9);
}
