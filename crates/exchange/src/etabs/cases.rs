//! Load cases, combinations, and the source of mass.

use super::words::{File, Thing};

const CASES: &str = "LOAD CASES";
/// The case of the geometric stiffness that all linear cases begin with.
const PRESET: &str = "P-Delta of all cases";

/// Reads what is said of the analysis as a whole; true where a case of P-Δ comes before all.
pub fn options(file: &File<'_>) -> bool {
    for thing in file.each("ANALYSIS OPTIONS", "ACTIVEDOF", 0) {
        let said = thing.at(0).map_or("", |t| t.text.as_str()).to_uppercase();
        let mut row = file.row("ACTIVE DEGREES OF FREEDOM", thing.span());
        for dof in ["UX", "UY", "UZ", "RX", "RY", "RZ"] {
            row = row.with(dof, said.split_whitespace().any(|word| word == dof));
        }
        row.put();
    }
    let all = file.each("ANALYSIS OPTIONS", "PDELTA", 0);
    let method = all.iter().find_map(|t| t.text("METHOD")).unwrap_or("NONE").to_uppercase();
    let loads: Vec<_> = all.iter().filter(|t| t.token("LOAD").is_some()).collect();
    all.iter().for_each(|t| _ = t.number("TOL"));
    if method == "NONITERATIVE" {
        let what = "P-Δ by the masses of storeys: a static case with P-Δ says the same by forces";
        file.lose("ANALYSIS OPTIONS: PDELTA", what, "");
    }
    if method != "ITERATIVE" || loads.is_empty() {
        return false;
    }
    let span = loads[0].span();
    let case = |table| file.row(table, span).with("Case", PRESET);
    case("LOAD CASE DEFINITIONS").with("Type", "NonStatic").put();
    case("CASE - STATIC 4 - NONLINEAR PARAMETERS").with("GeoNonLin", "P-Delta").put();
    for load in loads {
        let row = case("CASE - STATIC 1 - LOAD ASSIGNMENTS").with("LoadType", "Load pattern");
        let factor = load.number("FACTOR").unwrap_or(1.0);
        row.with("LoadName", load.need("LOAD")).with("LoadSF", factor).put();
    }
    true
}

/// Kinds as tables know them.
fn kind(said: &str) -> Option<&'static str> {
    let plain = said.to_lowercase();
    let nonlinear = plain.starts_with("nonlinear");
    Some(match plain.as_str() {
        s if s.ends_with("linear static") => {
            if nonlinear {
                "NonStatic"
            } else {
                "LinStatic"
            }
        }
        s if s.contains("modal history") => {
            if nonlinear {
                "NonModHist"
            } else {
                "LinModHist"
            }
        }
        s if s.contains("direct integration") => {
            if nonlinear {
                "NonDirHist"
            } else {
                "LinDirHist"
            }
        }
        s if s.starts_with("modal") => "LinModal",
        _ => return None,
    })
}

/// Reads cases; the names of linear ones, for combinations.
pub fn cases(file: &File<'_>, preset: bool) {
    let all = file.things(CASES, "LOADCASE", 1);
    for thing in &all {
        let name = thing.names[0];
        let said = thing.need("TYPE");
        let Some(kind) = kind(said) else {
            thing.idle();
            let what = format!("a case of type {said} has no counterpart");
            file.lose("LOAD CASES: TYPE", &what, name);
            continue;
        };
        let linear = kind.starts_with("Lin");
        let before = thing.text("INITCOND").filter(|c| !c.eq_ignore_ascii_case("preset"));
        if let Some(before) = before.filter(|b| all.iter().all(|c| c.names[0] != *b)) {
            let message = format!("there is no load case \"{before}\"");
            thing.wrong_at("INITCOND", &message, "they stand in the section LOAD CASES");
            continue;
        }
        let statics = kind.ends_with("Static") || kind.ends_with("Hist");
        let first = (preset && linear && statics).then_some(PRESET);
        file.row("LOAD CASE DEFINITIONS", thing.span())
            .with("Case", name)
            .with("Type", kind)
            .maybe("InitialCond", before.or(first))
            .put();
        thing.text("MODALCASE");
        match kind {
            "LinModal" => thing.idle(),
            "LinStatic" | "NonStatic" => statics_of(file, thing, name),
            _ => history(file, thing, name, kind),
        }
        if thing.text("MASSSOURCE").is_some_and(|m| !m.eq_ignore_ascii_case("previous")) {
            let what = "a mass source of its own: masses are those of the default one";
            file.otherwise("LOAD CASES: MASSSOURCE", what, name);
        }
        thing.text("EXCLUDEGROUP");
    }
}

/// The lines of a case with a key, each alone.
fn with<'a>(thing: &Thing<'a>, key: &str) -> Vec<Thing<'a>> {
    thing.lines.iter().map(|line| thing.line(line)).filter(|t| t.token(key).is_some()).collect()
}

fn statics_of(file: &File<'_>, thing: &Thing<'_>, name: &str) {
    for load in with(thing, "LOADPAT") {
        file.row("CASE - STATIC 1 - LOAD ASSIGNMENTS", load.span())
            .with("Case", name)
            .with("LoadType", "Load pattern")
            .with("LoadName", load.need("LOADPAT"))
            .with("LoadSF", load.number("SF").unwrap_or(1.0))
            .put();
    }
    for key in ["ACCEL", "MODE"] {
        for load in with(thing, key) {
            load.idle();
            file.lose("LOAD CASES", "a load other than a pattern", name);
        }
    }
    let control = thing.text("LOADCONTROL").filter(|c| !c.eq_ignore_ascii_case("full"));
    if let Some(control) = control {
        file.row("CASE - STATIC 2 - NONLINEAR LOAD APPLICATION", thing.span())
            .with("Case", name)
            .with("LoadApp", control)
            .with("DisplType", thing.text("DISPLTYPE").unwrap_or("Monitored"))
            .with("TargetDispl", thing.or_zero("DISPLMAG"))
            .put();
    }
    geometry(file, thing, name, "CASE - STATIC 4 - NONLINEAR PARAMETERS");
}

fn geometry(file: &File<'_>, thing: &Thing<'_>, name: &str, table: &'static str) {
    if let Some(kind) = thing.text("NLGEOMTYPE").filter(|k| !k.eq_ignore_ascii_case("none")) {
        let kind = if kind.eq_ignore_ascii_case("pdelta") { "P-Delta" } else { kind };
        file.row(table, thing.span()).with("Case", name).with("GeoNonLin", kind).put();
    }
}

fn history(file: &File<'_>, thing: &Thing<'_>, name: &str, kind: &str) {
    let modal = kind.ends_with("ModHist");
    let tables = if modal {
        ["CASE - MODAL HISTORY 1 - GENERAL", "CASE - MODAL HISTORY 2 - LOAD ASSIGNMENTS"]
    } else {
        ["CASE - DIRECT HISTORY 1 - GENERAL", "CASE - DIRECT HISTORY 2 - LOAD ASSIGNMENTS"]
    };
    let motion = thing.text("MOTIONTYPE").unwrap_or("Transient");
    let mut general = file
        .row(tables[0], thing.span())
        .with("Case", name)
        .with("OutSteps", thing.need_number("NUMBEROUTPUTSTEPS"))
        .with("StepSize", thing.need_number("OUTPUTSTEPSIZE"))
        .with("HistoryType", motion);
    for load in thing.lines.iter().map(|line| thing.line(line)) {
        let row = file.row(tables[1], load.span()).with("Case", name);
        let row = if let Some(accel) = load.text("ACCEL") {
            let row = row.with("LoadType", "Accel").with("LoadName", &format!("Accel {accel}"));
            row.with("TransAccSF", load.number("SF").unwrap_or(1.0))
        } else if let Some(pattern) = load.text("LOADPAT") {
            let row = row.with("LoadType", "Load pattern").with("LoadName", pattern);
            row.with("LoadSF", load.number("SF").unwrap_or(1.0))
        } else {
            continue;
        };
        row.with("Function", load.need("FUNC"))
            .maybe("TimeFactor", load.number("TIMEFACT"))
            .maybe("ArrivalTime", load.number("ARRIVALTIME"))
            .maybe("Angle", load.number("ANG"))
            .maybe("CoordSys", load.text("CSYS").map(|c| if c == "Global" { "GLOBAL" } else { c }))
            .put();
    }
    general = damping(file, thing, name, modal, general);
    general.put();
    if !modal {
        integration(file, thing, name);
        geometry(file, thing, name, "CASE - DIRECT HISTORY 5 - NONLINEAR PARAMETERS");
    }
}

/// Damping in modes, and that in proportion to mass and stiffness.
fn damping<'f>(
    file: &'f File<'_>,
    thing: &Thing<'_>,
    name: &str,
    modal: bool,
    mut general: super::words::Maker<'f>,
) -> super::words::Maker<'f> {
    let kind = thing.text("MODALDAMPTYPE").unwrap_or("None");
    if modal {
        general = general.maybe("ConstDamp", thing.number("CONSTDAMP"));
        for (key, ours) in
            [("INTERPOLATEDPERIOD", "Period"), ("INTERPOLATEDFREQUENCY", "Frequency")]
        {
            for one in with(thing, key) {
                file.row("CASE - MODAL HISTORY 3 - INTERPOLATED DAMPING", one.span())
                    .with("Case", name)
                    .with(ours, one.need_number(key))
                    .with("Damping", one.need_number("INTERPOLATEDDAMPING"))
                    .put();
            }
        }
        for one in with(thing, "MODALOVERRIDEMODE") {
            file.row("CASE - MODAL HISTORY 5 - DAMPING OVERRIDES", one.span())
                .with("Case", name)
                .with("Mode", one.need_number("MODALOVERRIDEMODE"))
                .with("Damping", one.need_number("MODALOVERRIDEDAMPING"))
                .put();
        }
    } else if !kind.eq_ignore_ascii_case("none") {
        let named = ["CONSTDAMP", "CONSIDERMAXMODALFREQ", "MAXCONSIDEREDMODALFREQ"];
        named.iter().for_each(|key| _ = thing.token(key));
        general = general.with("MDampType", kind);
    }
    let (front, table) = if modal {
        ("Proportional", "CASE - MODAL HISTORY 4 - PROPORTIONAL DAMPING")
    } else {
        ("", "CASE - DIRECT HISTORY 3 - VISCOUS PROPORTIONAL DAMPING")
    };
    let said =
        if modal { Some(kind).filter(|k| k.starts_with(front)) } else { thing.text("PRODAMPTYPE") };
    let Some(said) = said.filter(|s| !s.eq_ignore_ascii_case("none")) else { return general };
    let factors = match said.strip_prefix(front).unwrap_or(said) {
        "Direct" => Some([thing.or_zero("MASSCOEFF"), thing.or_zero("STIFFCOEFF")]),
        way @ ("Period" | "Frequency") => {
            let [a, b] = ["T1", "T2"].map(|key| thing.need_number(key));
            let ratios = ["DAMP1", "DAMP2"].map(|key| thing.need_number(key));
            let w = [a, b].map(|x| {
                let hertz = if way == "Period" { 1.0 / x } else { x };
                std::f64::consts::TAU * hertz
            });
            through(w, ratios)
        }
        _ => None,
    };
    match factors {
        Some([mass, stiffness]) => {
            let row = file.row(table, thing.span()).with("Case", name);
            row.with("MassCoeff", mass).with("StiffCoeff", stiffness).put();
        }
        None => {
            let what = format!("damping {said} that is not read");
            file.lose("LOAD CASES: PRODAMPTYPE", &what, name);
        }
    }
    general
}

/// a and b of C = a M + b K with two ratios at two circular frequencies: ζ = (a/ω + b ω)/2.
fn through([w1, w2]: [f64; 2], [z1, z2]: [f64; 2]) -> Option<[f64; 2]> {
    let d = w2 * w2 - w1 * w1;
    let a = 2.0 * w1 * w2 * (z1 * w2 - z2 * w1) / d;
    let b = 2.0 * (z2 * w2 - z1 * w1) / d;
    (a.is_finite() && b.is_finite()).then_some([a, b])
}

fn integration(file: &File<'_>, thing: &Thing<'_>, name: &str) {
    let method = thing.text("TIMEINTTYPE");
    if method.is_none() && thing.token("ALPHA").is_none() {
        return;
    }
    file.row("CASE - DIRECT HISTORY 4 - INTEGRATION PARAMETERS", thing.span())
        .with("Case", name)
        .maybe("IntMethod", method)
        .maybe("Alpha", thing.number("ALPHA"))
        .maybe("Gamma", thing.number("GAMMA"))
        .maybe("Beta", thing.number("BETA"))
        .put();
}

/// Reads combinations.
pub fn combinations(file: &File<'_>) {
    for thing in file.things("LOAD COMBINATIONS", "COMBO", 1) {
        let name = thing.names[0];
        let sort = thing.text("TYPE").unwrap_or("Linear Add");
        thing.text("DESIGN");
        thing.text("COMBOTYPE");
        let nested = with(&thing, "LOADCOMBO");
        if !nested.is_empty() || !sort.eq_ignore_ascii_case("linear add") {
            thing.idle();
            let what = "a combination that is no sum of linear static cases";
            file.lose("LOAD COMBINATIONS", what, name);
            continue;
        }
        for part in with(&thing, "LOADCASE") {
            let case = part.need("LOADCASE");
            let linear = file.each(CASES, "LOADCASE", 1).iter().any(|c| {
                c.names[0] == case && c.text("TYPE").is_some_and(|t| kind(t) == Some("LinStatic"))
            });
            file.row("COMBINATION DEFINITIONS", part.span())
                .with("ComboName", name)
                .with("ComboType", "Linear Add")
                .with("CaseType", if linear { "Linear Static" } else { "Other" })
                .with("CaseName", case)
                .with("ScaleFactor", part.number("SF").unwrap_or(1.0))
                .put();
        }
    }
}

/// Reads what mass is made of.
pub fn mass(file: &File<'_>) {
    const SECTION: &str = "MASS SOURCE";
    for thing in file.things(SECTION, "MASSSOURCE", 1) {
        let name = thing.names[0];
        let yes = |key: &str, plain: bool| thing.says(key).unwrap_or(plain);
        if yes("LUMPATSTORIES", false) {
            let what = "masses are at their joints, not moved to the levels of storeys";
            file.otherwise("MASS SOURCE: LUMPATSTORIES", what, name);
        }
        if !yes("INCLUDELATERALMASS", true) {
            file.lose("MASS SOURCE: INCLUDELATERALMASS", "a source without lateral mass", name);
        }
        if yes("INCLUDEMOVE", false) {
            file.lose("MASS SOURCE: INCLUDEMOVE", "masses that are moved in plan", name);
        }
        ["MOVERATIOX", "MOVERATIOY"].iter().for_each(|key| _ = thing.token(key));
        let row = |last: bool| {
            file.row(SECTION, thing.span())
                .with("MassSource", name)
                .with("Elements", yes("INCLUDEELEMENTS", false))
                .with("Masses", yes("INCLUDEADDEDMASS", false))
                .with("Loads", yes("INCLUDELOADS", false))
                .with("VerticalMass", yes("INCLUDEVERTICALMASS", true))
                .maybe("IsDefault", last.then(|| yes("ISDEFAULT", false)))
        };
        let loads = file.each(SECTION, "MASSSOURCELOAD", 2);
        let own: Vec<_> = loads.iter().filter(|l| l.names[0] == name).collect();
        if own.is_empty() {
            row(true).put();
        }
        for load in own {
            let times = load.number_at(2).unwrap_or(1.0);
            row(true).with("LoadPat", load.names[1]).with("Multiplier", times).put();
        }
    }
}
