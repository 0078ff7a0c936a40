//! Pages with names that would like to be something else.

use serde_json::json;
use trilith_report::{
    Answer, Block, Entries, Entry, FaceMark, Figure, Frames, GroupMark, History, LineKind,
    LineMark, LinkMark, NodeMark, Orbit, Page, Profile, ProfileCurve, RunData, Section, Stroke,
    Tint, Tinted,
};

/// Texts that must stay texts.
pub const HOSTILE: [&str; 6] = [
    "</script><script>window.stolen = 1</script>",
    "<img src=x onerror='window.stolen = 2'>",
    "javascript:window.stolen=3",
    "=HYPERLINK(\"http://x.example\")",
    "\"><svg onload=window.stolen=4>",
    "<!--<script>&lt;\u{2028}",
];

/// A page of figures and tables, all of whose texts are hostile.
pub fn page() -> String {
    let wave =
        |k: f64| (0..200).map(move |i| (0.01 * f64::from(i), (k * 0.05 * f64::from(i)).sin()));
    let entry = |text: &&str| Entry {
        cells: vec![(*text).to_owned(), "0.5".into()],
        place: vec!["runs".into(), (*text).to_owned()],
        set: vec![("a".into(), (*text).to_owned())],
    };
    let entries = Entries {
        name: HOSTILE[1].into(),
        command: format!("trilith run {}", HOSTILE[2]),
        common: vec![(HOSTILE[5].into(), HOSTILE[0].into())],
        head: vec![(HOSTILE[0].into(), HOSTILE[4].into()), ("b".into(), "m".into())],
        rows: HOSTILE.iter().map(entry).collect(),
    };
    let mut page = Page::new(HOSTILE[0]).lead(Block::text(HOSTILE[1])).entries(entries);
    for (i, text) in HOSTILE.iter().enumerate() {
        let label = format!("{text} [{}]", HOSTILE[4]);
        let points = Figure::new(*text, label.clone(), label.clone())
            .series(*text, Stroke::Rings, (0..6).map(|i| (f64::from(i), f64::from(i % 3))))
            .standing_for(0..6)
            .caption(*text);
        let line = Figure::new(*text, label.clone(), label)
            .line(*text, wave(1.0))
            .line(HOSTILE[2], wave(2.0))
            .timed()
            .scaled(*text)
            .peaks();
        let head = vec![(*text).to_owned()];
        let section = Section::new(format!("s{i}"), *text)
            .group(*text)
            .block(vec![points, line])
            .block(Block::code(*text))
            .block(Block::note(*text))
            .block(Block::Scales((*text).to_owned()))
            .block(Block::Table { head: head.clone(), rows: vec![head] });
        page = page.section(section);
    }
    page.html()
}

/// The page of a run of a model with such names.
pub fn run() -> String {
    let name = |i: usize| HOSTILE[i % HOSTILE.len()].to_owned();
    let numbers = |n: Vec<i32>| serde_json::from_value(json!({ "step": 0.01, "n": n })).unwrap();
    let shown = || serde_json::from_value(json!({ "unit": name(4), "factor": 1.0 })).unwrap();
    let history = |i: usize| History {
        name: name(i),
        kind: name(1),
        shown: shown(),
        t: numbers((0..50).collect()),
        y: numbers((0..50).map(|k| (k * k) % 23 - 11).collect()),
    };
    let mut data = RunData {
        file: name(0),
        parameters: vec![(name(0), name(1))],
        overrides: vec![(name(2), name(3))],
        settings: vec![(name(1), name(0))],
        outputs: (0..6).map(name).collect(),
        histories: (0..6).map(history).collect(),
        notes: vec![name(0), name(1)],
        answers: vec![Answer { words: name(0), text: name(1), note: name(4), ..Answer::default() }],
        ..RunData::default()
    };
    body(&mut data, &name);
    data.picture.nodes = (0..2).map(|at| NodeMark { name: name(at), at, fixed: name(1) }).collect();
    let family = serde_json::from_value(json!("contact")).unwrap();
    data.picture.links = vec![LinkMark {
        name: name(0),
        kind: name(1),
        family,
        ends: vec![0, 1],
        axis: [0.0, 0.0, 1.0],
        body: false,
    }];
    data.orbits = vec![Orbit {
        names: [name(0), name(1)],
        shown: shown(),
        t: numbers((0..9).collect()),
        x: numbers((0..9).collect()),
        y: numbers((0..9).map(|k| k * k).collect()),
    }];
    let curve = ProfileCurve {
        direction: name(0),
        from: vec![0.0, 3.0],
        to: vec![3.0, 6.0],
        value: vec![0.1, 0.2],
        ..ProfileCurve::default()
    };
    data.profiles = vec![Profile { quantity: name(1), shown: shown(), curves: vec![curve] }];
    let output = json!({ "unit": name(4), "max": 0.11, "t_max": 0.2, "min": -0.11, "t_min": 0.1, "final": 0.0 });
    let outputs: serde_json::Map<String, serde_json::Value> =
        (0..6).map(|i| (name(i), output.clone())).collect();
    let summary = json!({
        "model": { "title": name(0), "sha256": name(1) }, "case": name(0), "solver": name(1), "status": name(2),
        "message": name(0), "warnings": [name(0), name(1)], "outputs": outputs, "version": name(0), "build": name(1),
        "link_energy": { (HOSTILE[0]): { "hysteretic": 1.0, "viscous": 0.5 } },
    });
    let made = json!({
        "date": name(0), "command": ["trilith", "run", name(0), name(2)],
        "files": [{ "what": name(1), "file": name(0), "sha256": name(4) }],
    });
    trilith_report::run_page(&summary, &data, &made)
}

/// A member with a section, a tie, a box that stands on the ground, all of them moving, under such names.
fn body(data: &mut RunData, name: &dyn Fn(usize) -> String) {
    let corner =
        |i: usize| [2.0 + [0.0, 1.0, 1.0, 0.0][i % 4], [0.0, 0.0, 1.0, 1.0][i % 4], (i / 4) as f64];
    let picture = &mut data.picture;
    picture.points = vec![[0.0; 3], [1.0, 0.0, 1.0]];
    picture.points.extend((0..8).map(corner));
    picture.ground = Some(0.0);
    let named = |i: usize| format!("{} ({})", name(i), name(i + 1));
    let line = |i: usize, what: LineKind, ends: [usize; 2], outline: Option<usize>| LineMark {
        name: named(i),
        what,
        ends,
        outline,
    };
    picture.lines = vec![
        line(0, LineKind::Member, [0, 1], Some(0)),
        line(1, LineKind::Tie, [1, 2], None),
        line(2, LineKind::Edge, [2, 6], None),
    ];
    let face = |corners: [usize; 4]| FaceMark { name: named(2), corners: corners.to_vec() };
    picture.faces = vec![face([2, 3, 4, 5]), face([6, 7, 8, 9])];
    picture.outlines =
        vec![vec![[0.0, -0.1, -0.1], [0.0, 0.1, -0.1], [0.0, 0.1, 0.1], [0.0, -0.1, 0.1]]];
    picture.groups = vec![GroupMark { name: name(4), lines: vec![0], ..GroupMark::default() }];
    let tinted = Tinted { figure: name(0), nodes: vec![0], lines: vec![0], links: vec![0] };
    data.tints = vec![Tint { quantity: name(1), of: vec![tinted] }];
    let points = data.picture.points.len() as i32;
    let u: Vec<i32> = (0..9 * points).map(|k| (k / (3 * points)) * (10 + k % 7)).collect();
    let u = serde_json::from_value(json!({ "step": 0.01, "n": u })).unwrap();
    data.frames = Frames { t: vec![0.0, 0.2, 0.4], u };
}
