//! Pages in a real browser, where there is one: no word on the console, no request, charts that answer.

mod common;

use std::path::Path;
use std::process::Command;

#[test]
fn pages_come_alive_and_stay_quiet() {
    let here = Path::new(env!("CARGO_MANIFEST_DIR"));
    if Command::new("node").arg("--version").output().is_err() {
        println!("not run: no Node.js found");
        return;
    }
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("pages");
    std::fs::create_dir_all(&folder).unwrap();
    let write = |name: &str, page: String| {
        let path = folder.join(name);
        std::fs::write(&path, page).unwrap();
        path
    };
    // A browser says what a test of texts cannot: whether any name was obeyed.
    let told = "<script>if (window.stolen) console.log('a name was obeyed: ' + window.stolen)</script></body>";
    let [page, run] = [common::page(), common::run()].map(|p| p.replace("</body>", told));
    let pages = [write("names.html", page), write("run.html", run)];
    let done =
        Command::new("node").arg(here.join("tests/browser.mjs")).args(&pages).output().unwrap();
    let text = String::from_utf8_lossy(&done.stdout);
    print!("{text}");
    assert!(done.status.success(), "{text}{}", String::from_utf8_lossy(&done.stderr));
}
