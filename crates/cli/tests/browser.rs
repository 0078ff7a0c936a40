//! The reports of the shipped models in a real browser: no error, nothing wider than the window, a page
//! for paper. Skipped with a message where no Chromium is on the PATH.

use assert_cmd::Command;
use std::path::{Path, PathBuf};

const NAMES: [&str; 4] = ["chromium", "chromium-browser", "google-chrome", "google-chrome-stable"];

/// Uses the page as a reader would, and leaves what it finds in the document.
const READER: &str = r#"<script>
addEventListener("load", () => {
  const root = document.documentElement, log = [];
  const box = (c) => c.getBoundingClientRect();
  const mouse = (c, type, x, y, more = {}) => {
    const r = box(c);
    const at = { clientX: r.left + x * r.width, clientY: r.top + y * r.height, pointerId: 1, bubbles: true, ...more };
    c.dispatchEvent(new PointerEvent(type, at));
  };
  HTMLCanvasElement.prototype.setPointerCapture = () => {};
  const copy = Object.assign(document.createElement("canvas"), { width: 200, height: 100 });
  const small = copy.getContext("2d", { willReadFrequently: true });
  const drawn = (c) => {
    small.clearRect(0, 0, 200, 100);
    small.drawImage(c, 0, 0, 200, 100);
    return small.getImageData(0, 0, 200, 100).data.some((x, i) => i % 4 === 0 && x > 0 && x < 220);
  };
  const seen = {};
  for (const c of document.querySelectorAll("canvas")) {
    if (!drawn(c)) log.push("empty " + c.getAttribute("aria-label"));
    // One of each sort is used.
    const sort = c.closest("section").id;
    if (seen[sort]) continue;
    seen[sort] = true;
    for (const x of [0.3, 0.6]) mouse(c, "pointermove", x, 0.5);
    mouse(c, "pointerdown", 0.3, 0.4);
    mouse(c, "pointermove", 0.5, 0.6);
    mouse(c, "pointerup", 0.5, 0.6);
    for (const key of ["ArrowRight", "ArrowLeft", "+", "-", "0", " ", " "]) c.dispatchEvent(new KeyboardEvent("keydown", { key }));
    mouse(c, "pointerleave", 0.5, 0.6);
    c.dispatchEvent(new MouseEvent("dblclick"));
    if (!drawn(c)) log.push("empty after use " + c.getAttribute("aria-label"));
  }
  for (const e of document.querySelectorAll("button")) { e.click(); e.click(); }
  for (const e of document.querySelectorAll("input, select")) { e.dispatchEvent(new Event("input")); e.dispatchEvent(new Event("change")); }
  if (root.scrollWidth > root.clientWidth) log.push("wider than the window: " + root.scrollWidth);
  root.dataset.reader = log.length ? log.join("; ") : "content";
});
</script>"#;

fn chromium() -> Option<PathBuf> {
    let path = std::env::var_os("PATH")?;
    std::env::split_paths(&path).flat_map(|d| NAMES.map(|n| d.join(n))).find(|p| p.is_file())
}

/// stdout and stderr of the browser on a page.
fn browse(browser: &Path, profile: &Path, page: &Path, args: &[&str]) -> (String, String) {
    let url = format!("file://{}", page.display());
    // A processor draws in the place of one for graphics: left to choose so itself, the browser complains of it.
    let drawn = ["--use-angle=swiftshader", "--enable-unsafe-swiftshader"];
    let fixed = ["--headless", "--no-sandbox", "--enable-logging=stderr", "--v=0"];
    let output = Command::new(browser)
        .args(fixed)
        .args(drawn)
        .arg(format!("--user-data-dir={}", profile.display()))
        .args(["--window-size=1280,2000", "--virtual-time-budget=1000"])
        .args(args)
        .arg(url)
        .timeout(std::time::Duration::from_secs(60))
        .output()
        .unwrap();
    let text = |b: &[u8]| String::from_utf8_lossy(b).into_owned();
    (text(&output.stdout), text(&output.stderr))
}

#[test]
fn the_report_of_every_model_opens_without_error_and_prints() {
    let Some(browser) = chromium() else {
        eprintln!("skipped: no Chromium on the PATH");
        return;
    };
    let folder = tempfile::tempdir().unwrap();
    let profile = folder.path().join("profile");
    let models = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../models");
    let entries = std::fs::read_dir(models).unwrap().map(|e| e.unwrap().path());
    let mut all: Vec<_> = entries.filter(|p| p.extension().is_some_and(|x| x == "ron")).collect();
    all.sort();
    for model in all {
        let name = model.file_stem().unwrap().to_string_lossy().into_owned();
        let out = folder.path().join(&name);
        let run = Command::new(env!("CARGO_BIN_EXE_trilith"))
            .args(["run".as_ref(), model.as_os_str(), "--out".as_ref(), out.as_os_str()])
            .output()
            .unwrap();
        assert!(run.status.success(), "{name}: {}", String::from_utf8_lossy(&run.stderr));
        let page = std::fs::read_to_string(out.join("report.html")).unwrap();
        let read = out.join("read.html");
        std::fs::write(&read, page.replace("</body>", &format!("{READER}</body>"))).unwrap();
        let (dom, log) = browse(&browser, &profile, &read, &["--dump-dom"]);
        let html = &dom[dom.find("<html").unwrap_or(0)..];
        let head = &html[..html.find('>').unwrap_or(0)];
        assert!(head.contains("data-ready=\"true\""), "{name}: {head}\n{log}");
        assert!(head.contains("data-reader=\"content\""), "{name}: {head}\n{log}");
        assert!(!head.contains("data-error"), "{name}: {head}");
        assert!(!log.contains("CONSOLE"), "{name}: {log}");
        let pdf = out.join("report.pdf");
        let print = format!("--print-to-pdf={}", pdf.display());
        let (_, log) = browse(&browser, &profile, &out.join("report.html"), &[&print]);
        let size = std::fs::metadata(&pdf).map_or(0, |m| m.len());
        assert!(size > 20_000, "{name}: {size} bytes on paper\n{log}");
    }
}
