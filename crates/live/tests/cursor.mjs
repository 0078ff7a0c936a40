// Drives the cursor of a chart over two parameters: drags it to places between the runs of the chart, by keys to the last bit, and
// reads the peaks of the runs that the page computes there. The network is off. Fails on whatever the console says.
//
//     node crates/live/tests/cursor.mjs PAGE.html EXPECTED.json [FOLDER]
//
// EXPECTED.json: [{"x", "y", "peaks": {"name": value}}, …]; pictures go into FOLDER.

import { mkdirSync, readFileSync, writeFileSync } from "node:fs";
import { join, resolve } from "node:path";
import { pathToFileURL } from "node:url";
import { open, pause, session } from "../../report/tests/chromium.mjs";

const [path, expected, out] = process.argv.slice(2);
const browser = open();
if (!browser) process.exit(0);
if (out) mkdirSync(out, { recursive: true });
/** Peaks by the page against those of the library at the same settings: pixels make settings of five digits, which the
 *  page is asked for; parts of a peak. */
const EQUAL = 1e-6;
let bad = 0;
const complain = (what) => { bad++; console.log(what); };

try {
  const { on, value, until } = await session(browser, complain);
  await on("Emulation.setDeviceMetricsOverride", { width: 1280, height: 900, deviceScaleFactor: 1, mobile: false });
  await on("Page.navigate", { url: pathToFileURL(resolve(path)).href });
  await until("the first run", "document.body?.dataset.shown");
  const shown = () => value("document.body.dataset.shown");
  /** Pixels of a place: the frame of the axes is the longest path of its colour. */
  const pixels = (x, y) => value(`(() => {
    const svg = document.querySelector("#charts .view > svg"), frame = svg.querySelector("path[stroke='#8c8c8c']").getBoundingClientRect();
    return [frame.left + ${x} * frame.width, frame.bottom - ${y} * frame.height];
  })()`);
  const mouse = (type, [x, y]) => on("Input.dispatchMouseEvent", { type, x, y, button: "left", clickCount: 1 });
  const ring = () => value("(() => { const r = document.querySelector('.ask .ring').getBoundingClientRect(); return [r.left + r.width / 2, r.top + r.height / 2]; })()");
  await value("document.querySelector('#charts').scrollIntoView({ block: 'center' })");
  for (const { x, y, peaks } of JSON.parse(readFileSync(expected, "utf8"))) {
    const from = await ring(), to = await pixels(x, y);
    await mouse("mousePressed", from);
    for (const share of [0.3, 0.7, 1]) await mouse("mouseMoved", from.map((a, i) => a + share * (to[i] - a)));
    await mouse("mouseReleased", to);
    const set = await value("state.set");
    for (const [name, wanted] of [["mu", x], ["ah", y]]) if (Math.abs(set[name] - wanted) > 0.01) complain(`dragged to ${name} = ${wanted}, and it asks for ${set[name]}`);
    if (set.duration !== "1 s") complain(`what all runs set is not set: ${JSON.stringify(set)}`);
    // To the place itself, which pixels do not meet.
    const before = await shown();
    await value(`document.dispatchEvent(new CustomEvent("asked", { detail: { set: { ...state.set, mu: "${x}", ah: "${y}" }, row: 0 } }))`);
    await until("its run", `document.body.dataset.shown !== ${JSON.stringify(before)} && document.body.dataset.shown.includes('"mu":"${x}","ah":"${y}"')`, "document.body.dataset.shown");
    const seen = await value("Object.fromEntries([...document.querySelectorAll('#peaks tbody tr')].map((r) => [r.cells[0].textContent, Number(r.dataset.value)]))");
    let apart = 0;
    for (const [name, p] of Object.entries(peaks)) {
      const off = Math.abs(seen[name] - p) / Math.abs(p);
      apart = Math.max(apart, off);
      if (!(off <= EQUAL)) complain(`${x}, ${y}: ${name} is ${seen[name]} here, ${p} by the library`);
    }
    const told = await value("document.querySelector('iframe.front').contentDocument.querySelector('.fact b').textContent");
    console.log(`μ = ${x}, A = ${y} g: leaves rest by ${told}; ${Object.keys(peaks).length} peaks, apart by ${apart.toExponential(1)} at most`);
    if (!out) continue;
    await pause(300);
    const { data } = await on("Page.captureScreenshot", { format: "png" });
    writeFileSync(join(out, `${x}-${y}.png`), Buffer.from(data, "base64"));
  }
  const name = await value("document.querySelector('.ask').getAttribute('aria-valuetext')");
  await value("document.querySelector('.ask').dispatchEvent(new KeyboardEvent('keydown', { key: 'ArrowLeft', bubbles: true }))");
  if ((await value("document.querySelector('.ask').getAttribute('aria-valuetext')")) === name) complain("arrows do not move it");
} catch (error) {
  complain(String(error));
} finally {
  await browser.close();
}
process.exit(bad ? 1 : 0);
