use super::*;

const OWN: [&str; 3] = ["summary", "peaks", "frames"];

/// A writer that replaces what it has made of some names, and will write some.
fn run(own: &'static [&'static str], writes: &[&str]) -> Writer {
    let writes = writes.iter().map(|name| (*name).to_owned()).collect();
    Writer { name: "run", own, writes, inputs: Vec::new() }
}

fn write(folder: &Folder, name: &str, text: &str) {
    let path = folder.path().join(name);
    fs::create_dir_all(path.parent().unwrap()).unwrap();
    fs::write(path, text).unwrap();
}

fn put(dir: &Path, name: &str) {
    fs::create_dir_all(dir.join(name).parent().unwrap()).unwrap();
    fs::write(dir.join(name), "mine").unwrap();
}

fn read(dir: &Path, name: &str) -> String {
    fs::read_to_string(dir.join(name)).unwrap_or_default()
}

/// Holds that something is in the way, by its name.
fn in_the_way<T: std::fmt::Debug>(done: Result<T, FolderError>, dir: &Path, name: &str) {
    match done {
        Err(FolderError::InTheWay { path, .. }) => assert_eq!(path, dir.join(name)),
        other => panic!("{name}: {other:?}"),
    }
}

#[test]
fn results_are_seen_together_and_replace_those_before() {
    let at = tempfile::tempdir().unwrap();
    let dir = at.path().join("a/b");
    let writer = run(&OWN, &["summary", "peaks"]);
    let folder = Folder::open(&dir, writer.clone()).unwrap();
    write(&folder, "peaks", "1");
    write(&folder, "summary", "1");
    write(&folder, "frames/0", "1");
    assert!(!dir.join("peaks").exists());
    assert_eq!(folder.published(&folder.path().join("peaks")), dir.join("peaks"));
    folder.publish().unwrap();
    put(&dir, "notes");
    assert_eq!(read(&dir, "frames/0"), "1");

    // One that ends early changes nothing.
    let folder = Folder::open(&dir, writer.clone()).unwrap();
    write(&folder, "peaks", "2");
    drop(folder);
    assert_eq!(read(&dir, "peaks"), "1");

    let folder = Folder::open(&dir, writer).unwrap();
    write(&folder, "summary", "3");
    folder.publish().unwrap();
    assert!(!dir.join("peaks").exists() && !dir.join("frames").exists());
    assert_eq!((&*read(&dir, "summary"), &*read(&dir, "notes")), ("3", "mine"));
}

#[test]
fn what_nobody_of_the_name_has_made_stays() {
    let at = tempfile::tempdir().unwrap();
    let dir = at.path();
    let open = |writes: &[&str]| Folder::open(dir, run(&OWN, writes));
    put(dir, "peaks");
    in_the_way(open(&["summary", "peaks"]), dir, "peaks");
    // A name that is known at the end only.
    let folder = open(&["summary"]).unwrap();
    write(&folder, "peaks", "1");
    in_the_way(folder.publish(), dir, "peaks");
    // Not in the way of what is written, and beside the frames.
    put(dir, "frames/photo");
    for _ in 0..2 {
        let folder = open(&["summary", "frames"]).unwrap();
        write(&folder, "summary", "1");
        write(&folder, "frames/0000.vtu", "1");
        folder.publish().unwrap();
    }
    let folder = open(&["summary"]).unwrap();
    write(&folder, "summary", "2");
    folder.publish().unwrap();
    assert!(!dir.join("frames/0000.vtu").exists());
    assert_eq!(read(dir, "peaks") + &read(dir, "frames/photo"), "minemine");
    // What was taken out is nobody's.
    put(dir, "frames/0000.vtu");
    in_the_way(open(&["frames"]), dir, "frames/0000.vtu");
    // And what another has made is the other's.
    let other = Writer { name: "record", ..run(&[], &["summary"]) };
    in_the_way(Folder::open(dir, other), dir, "summary");
}

#[test]
fn a_folder_where_a_file_goes_and_the_other_way_round_are_in_the_way() {
    let at = tempfile::tempdir().unwrap();
    let dir = at.path();
    put(dir, "peaks/mine");
    in_the_way(Folder::open(dir, run(&OWN, &["peaks"])), dir, "peaks");
    put(dir, "frames");
    in_the_way(Folder::open(dir, run(&OWN, &["frames"])), dir, "frames");
    let folder = Folder::open(dir, run(&OWN, &[])).unwrap();
    write(&folder, "frames/0000.vtu", "1");
    in_the_way(folder.publish(), dir, "frames");
    assert_eq!(read(dir, "peaks/mine") + &read(dir, "frames"), "minemine");
}

/// A list that somebody made up leads to nothing outside.
#[test]
fn a_list_is_of_its_folder_alone() {
    let at = tempfile::tempdir().unwrap();
    let dir = at.path().join("a");
    put(at.path(), "mine");
    put(&dir, "frames/mine");
    fs::write(dir.join(".trilith.files"), "run frames/../../mine\nrun /etc\n\nrun\n").unwrap();
    let folder = Folder::open(&dir, run(&OWN, &["summary"])).unwrap();
    write(&folder, "summary", "1");
    folder.publish().unwrap();
    assert_eq!(read(at.path(), "mine"), "mine");
    assert_eq!(read(&dir, ".trilith.files"), "run summary\n");
}

#[test]
fn a_folder_of_a_run_is_known_by_its_summary() {
    let at = tempfile::tempdir().unwrap();
    let dir = at.path();
    let names = ["summary.json", "peaks.csv", "frames"];
    for name in ["summary.json", "peaks.csv", "frames/0000.vtu", "frames/photo"] {
        put(dir, name);
    }
    let open = || Folder::open(dir, run(&OF_RUN, &names));
    in_the_way(open(), dir, "summary.json");
    fs::write(dir.join("summary.json"), r#"{"run_sha256": "0"}"#).unwrap();
    let folder = open().unwrap();
    write(&folder, "summary.json", "1");
    folder.publish().unwrap();
    assert!(!dir.join("peaks.csv").exists() && !dir.join("frames/0000.vtu").exists());
    assert_eq!(read(dir, "frames/photo"), "mine");
}

#[test]
fn a_folder_has_one_writer() {
    let at = tempfile::tempdir().unwrap();
    let open = || Folder::open(at.path(), Writer::default());
    let first = open().unwrap();
    assert!(matches!(open(), Err(FolderError::Taken(_))));
    drop(first);
    assert!(open().is_ok());
}

#[test]
fn an_input_is_told_before_anything_is_written() {
    let at = tempfile::tempdir().unwrap();
    let file = at.path().join("peaks.csv");
    fs::write(&file, "t,a").unwrap();
    let not = Folder::open(&file, Writer::default());
    assert!(matches!(not, Err(FolderError::NotAFolder(_))));
    let writer = Writer { inputs: vec![at.path().join("./peaks.csv")], ..run(&OF_RUN, &[]) };
    assert!(matches!(Folder::open(at.path(), writer.clone()), Err(FolderError::Input(_))));
    // A name that is known at the end only.
    let folder = Folder::open(at.path(), Writer { own: &[], ..writer }).unwrap();
    write(&folder, "peaks.csv", "");
    assert!(matches!(folder.publish(), Err(FolderError::Input(_))));
    assert_eq!(fs::read_to_string(&file).unwrap(), "t,a");
}
