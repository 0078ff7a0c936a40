//! Sections of ETABS, their keywords, and what becomes of them.

use crate::report::Fate;

/// Sections that are read, by the beginning of their names, with their keywords.
pub const READ: &[(&str, &[&str])] = &[
    ("PROGRAM INFORMATION", &["PROGRAM"]),
    ("CONTROLS", &["UNITS", "TITLE1", "TITLE2", "PREFERENCE", "RLLF"]),
    ("STORIES", &["STORY", "TOWER"]),
    ("DIAPHRAGM NAMES", &["DIAPHRAGM"]),
    ("MATERIAL PROPERTIES", &["MATERIAL", "MATERIALSSCURVE"]),
    ("FRAME SECTIONS", &["FRAMESECTION"]),
    ("AUTO SELECT SECTION LISTS", &["AUTOSECTION"]),
    ("NONPRISMATIC SECTIONS", &["NONPRISMATICSECTION"]),
    ("LINK PROPERTIES", &["LINKPROP", "LINKPROPFORCEDISPL"]),
    ("POINT SPRING PROPERTIES", &["POINTSPRING"]),
    ("POINT COORDINATES", &["POINT"]),
    ("LINE CONNECTIVITIES", &["LINE"]),
    ("LINK CONNECTIVITIES", &["LINK"]),
    ("AREA CONNECTIVITIES", &["AREA"]),
    ("POINT ASSIGNS", &["POINTASSIGN"]),
    ("LINE ASSIGNS", &["LINEASSIGN"]),
    ("LINK ASSIGNS", &["LINKASSIGN"]),
    ("AREA ASSIGNS", &["AREAASSIGN"]),
    ("LOAD PATTERNS", &["LOADPATTERN", "SEISMIC", "WIND", "NOTIONALLOAD", "LIVE"]),
    ("STATIC LOADS", &["LOADPATTERN", "LOADCASE"]),
    ("POINT OBJECT LOADS", &["POINTLOAD"]),
    ("POINT LOADS", &["POINTLOAD"]),
    ("FRAME OBJECT LOADS", &["LINELOAD"]),
    ("LINE OBJECT LOADS", &["LINELOAD"]),
    ("LINE LOADS", &["LINELOAD"]),
    (
        "ANALYSIS OPTIONS",
        &["ACTIVEDOF", "PDELTA", "MODELHINGESINLINKS", "AUTOMESHOPTIONS", "HINGEDAMPINGOPTION"],
    ),
    ("MASS SOURCE", &["MASSSOURCE", "MASSSOURCELOAD"]),
    ("FUNCTIONS", &["FUNCTION"]),
    ("LOAD CASES", &["LOADCASE"]),
    ("LOAD COMBINATIONS", &["COMBO"]),
    ("PROJECT INFORMATION", &["PROJECTINFO"]),
];

const DESIGN: &str = "design only";
const SHOWN: &str = "how it is shown and printed";
const UNUSED: &str = "a definition that only objects bring to life, and those are named";

/// Sections that change nothing, by their beginning or their end (`…*`, `*…`), and why.
const IGNORED: &[(&str, &str)] = &[
    ("GRIDS", "lines to draw on"),
    ("TOWERS", "names for parts of a building"),
    ("REBAR DEFINITIONS", DESIGN),
    ("CONCRETE SECTIONS", "reinforcement, for design"),
    ("TENDON SECTIONS", UNUSED),
    ("USER STEEL JOIST SECTIONS", UNUSED),
    ("BUCKLING RESTRAINED BRACE SECTIONS", UNUSED),
    ("SECTION DESIGNER SECTIONS", "the section itself stands in FRAME SECTIONS"),
    ("SLAB PROPERTIES", UNUSED),
    ("DECK PROPERTIES", UNUSED),
    ("WALL PROPERTIES", UNUSED),
    ("PANEL ZONE PROPERTIES", UNUSED),
    ("LINE SPRING PROPERTIES", UNUSED),
    ("AREA SPRING PROPERTIES", UNUSED),
    ("SOIL PROFILES", UNUSED),
    ("ISOLATED COLUMN FOOTINGS", UNUSED),
    ("NAMED FRAME MODIFIERS", "what is assigned stands with the lines"),
    ("NAMED SHELL MODIFIERS", "of areas, which are named"),
    ("NAMED FRAME RELEASES", "what is assigned stands with the lines"),
    ("PIER/SPANDREL NAMES", DESIGN),
    ("PIER SECTIONS", DESIGN),
    ("STRIP GEOMETRY", DESIGN),
    ("GROUPS", "groups select objects"),
    ("SHELL UNIFORM LOAD SETS", "of areas, which are named"),
    ("SECTION CUTS", SHOWN),
    ("GENERALIZED DISPLACEMENTS", SHOWN),
    ("DIMENSION LINES", SHOWN),
    ("DEVELOPED ELEVATIONS", SHOWN),
    ("ANALYSIS MODEL INFORMATION", "which parts are analysed"),
    ("WALKING VIBRATIONS", DESIGN),
    ("FLOOR VIBRATION EXCITATION SET", DESIGN),
    ("FRAME HINGE PROPERTIES", UNUSED),
    ("FRAME HINGE OVERWRITES", UNUSED),
    ("WALL PIER ACCEPTANCE CRITERIA", DESIGN),
    ("WALL SPANDREL ACCEPTANCE CRITERIA", DESIGN),
    ("PERFORMANCE CHECK*", DESIGN),
    ("NAMED *", SHOWN),
    ("TABLE SETS", SHOWN),
    ("DATABASE TABLE NAMED SETS", SHOWN),
    ("LOG", "comments"),
    ("*PREFERENCES", DESIGN),
    ("*OVERWRITES*", DESIGN),
];

/// Sections that carry the model and have no counterpart, and what goes with them.
const LOST: &[(&str, &str)] = &[
    ("TENDON*", "tendons are not read"),
    ("LINE CURVE DATA", "curved lines are taken straight"),
    ("AREA CURVE DATA", "areas are not read"),
    ("SHELL OBJECT LOADS", "loads of floors and walls are not read"),
    ("AREA OBJECT LOADS", "loads of floors and walls are not read"),
    ("AREA LOADS", "loads of floors and walls are not read"),
    ("FRAME HINGE ASSIGNMENTS", "frames stay elastic; a nonlinear link takes the place of a hinge"),
    ("AREA HINGE ASSIGNMENTS", "areas are not read"),
    ("AUTO CONSTRUCTION SEQUENCE CASE", "cases of stages have no counterpart"),
];

/// Keywords of sections that are read and change nothing, and why.
pub const IDLE: &[(&str, &str)] = &[
    ("PROGRAM", "the program"),
    ("PREFERENCE", "merging of points while drawing"),
    ("RLLF", DESIGN),
    ("TITLE1", SHOWN),
    ("TITLE2", SHOWN),
    ("TOWER", "names for parts of a building"),
    ("MATERIALSSCURVE", "strength, for hinges and design"),
    ("AUTOMESHOPTIONS", "of areas, which are named"),
    ("MODELHINGESINLINKS", "of hinges, which are named"),
    ("HINGEDAMPINGOPTION", "of hinges, which are named"),
    ("AREA", "of areas, which are named"),
    ("PROJECTINFO", "only the name of the model goes into its title"),
];

/// Fields that change nothing, by the keyword of their line, and why.
pub const FIELDS: &[(&str, &[&str], &str)] = &[
    (
        "STORY",
        &[
            "MASTERSTORY",
            "SIMILARTO",
            "SPLICEHEIGHT",
            "SPLICEABOVE",
            "TOWER",
            "COLOR",
            "ABOVEGRADE",
        ],
        SHOWN,
    ),
    ("MATERIAL", &["*"], "strength and design; what counts are stiffness and density"),
    ("FRAMESECTION", &["*"], "a beam takes areas, moments and their factors"),
    ("NONPRISMATICSECTION", &["*"], SHOWN),
    ("LINKPROP", &["STIFF*"], "which stiffness linear cases and damping take"),
    ("LINKPROP", &["FLD*", "FIXEDLENGTHDAMPER", "EXTENDER*"], "the law is that of its type"),
    ("LINKPROP", &["ACCEPT*"], DESIGN),
    (
        "POINTSPRING",
        &["STIFFNESSOPTION", "NONLINEARSPECOPTION"],
        "stiffnesses and links are read as they stand",
    ),
    ("POINTASSIGN", &["PANELZONE"], "panel zones are named"),
    (
        "LINEASSIGN",
        &[
            "MAXSTASPC",
            "MINNUMSTA",
            "PIER",
            "SPANDREL",
            "DESIGN*",
            "NODESIGN",
            "COMPOSITE",
            "JOIST",
            "SELFWEIGHTOPTION",
            "FLOORMESH",
            "COLSPLICE*",
            "REBARRATIOUSER",
            "NPCLEARLENGTH",
            "NPSTARTRD",
            "LENGTHOFFI",
            "LENGTHOFFJ",
            "TRANSFORMSTIFF",
            "CONSIDERFLOORCRACKING",
        ],
        "stations, design, and faces that forces are shown at",
    ),
    ("DIAPHRAGM", &["*"], SHOWN),
    ("LOADPATTERN", &["*"], DESIGN),
    (
        "LOADCASE",
        &[
            "MAX*",
            "MIN*",
            "ITERCONVTOL",
            "USE*",
            "LINESEARCH*",
            "EVENTLUMPTOL",
            "SOLUTIONSCHEME",
            "RESULTSSAVED*",
            "POSITIVEONLY",
            "STOPANALYSIS*",
            "FORCECONVTOL",
            "ENERGYCONVTOL",
            "CONVFACT",
            "EIGEN*",
            "STATICPERIOD",
            "TARGETPAR",
            "STATICCORR",
            "TIMEDEPMATPROP",
            "ALLOWAUTOFREQSHIFT",
        ],
        "settings of its solver; this one has its own error control",
    ),
    ("LOADCASE", &["NOTES", "DESIGN*", "HYPERSTATIC*"], DESIGN),
    (
        "LOADCASE",
        &["MONITOREDDISPL", "JOINT", "DOF", "GENDISPL", "DISPLTYPE", "DISPLMAG", "ADDITIONAL*"],
        "what is watched; cases under displacement control are named",
    ),
    ("LOADCASE", &["MODALDAMPTYPE", "SPECIFYBYRATIO", "MODEFORRATIO"], "factors follow from them"),
    ("MASSSOURCE", &["*"], SHOWN),
    ("COMBO", &["*"], DESIGN),
    ("PDELTA", &["METHOD", "TOL"], "settings of its solver"),
    ("AUTOSECTION", &["*"], DESIGN),
    ("FUNCTION", &["STEPS", "MAXTIME", "NUMBERCHAR", "HISTTYPE"], "the file or the points say it"),
];

/// True where a pattern with stars at its ends fits.
pub fn matches(pattern: &str, name: &str) -> bool {
    match (pattern.strip_prefix('*'), pattern.strip_suffix('*')) {
        (Some(rest), _) => match rest.strip_suffix('*') {
            Some(middle) => name.contains(middle),
            None => name.ends_with(rest),
        },
        (None, Some(front)) => name.starts_with(front),
        (None, None) => name == pattern,
    }
}

/// What becomes of a section; for one that is read, its keywords.
pub fn fate(name: &str) -> (Fate, &'static [&'static str]) {
    if let Some((_, keywords)) =
        READ.iter().find(|(n, _)| name == *n || *n == "STORIES" && name.starts_with("STORIES"))
    {
        return (Fate::Read, keywords);
    }
    let find = |all: &'static [(&str, &'static str)]| {
        all.iter().find(|(pattern, _)| matches(pattern, name)).map(|(_, what)| *what)
    };
    let fate = match (find(IGNORED), find(LOST)) {
        (Some(why), _) => Fate::Ignored(why.into()),
        (None, Some(what)) => Fate::Lost(what.into()),
        (None, None) => Fate::Lost("an unknown section".into()),
    };
    (fate, &[])
}
