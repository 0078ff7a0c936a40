// Drives a live page as a reader does: reads its peaks, moves a slider, writes a wrong unit into the file and puts it right.
// The network is off. Fails on whatever the console says.
//
//     node crates/live/tests/live.mjs PAGE.html EXPECTED.json [FOLDER]
//
// EXPECTED.json: {"parameter", "slider", "peaks": {"name": value}, "moved": {…}, "wrong": ["text", "other text"]}; pictures go into FOLDER.

import { mkdirSync, readFileSync, writeFileSync } from "node:fs";
import { join, resolve } from "node:path";
import { pathToFileURL } from "node:url";
import { open, pause, session } from "../../report/tests/chromium.mjs";

const [path, expected, out] = process.argv.slice(2);
const wanted = JSON.parse(readFileSync(expected, "utf8"));
const browser = open();
if (!browser) process.exit(0);
if (out) mkdirSync(out, { recursive: true });
/** Peaks of the page and of the program are equal to so many parts: their libraries differ in last bits, whose growth the steps' tolerance holds. */
const EQUAL = 1e-6;
/** A draft is as near as this; the largest of its peaks are much nearer. */
const DRAFT = 0.05;
let bad = 0;
const complain = (what) => { bad++; console.log(what); };

try {
  const { on, value, until: wait } = await session(browser, complain);
  const size = (width, height, scheme) => Promise.all([
    on("Emulation.setDeviceMetricsOverride", { width, height, deviceScaleFactor: 1, mobile: width < 500 }),
    on("Emulation.setEmulatedMedia", { media: "screen", features: [{ name: "prefers-color-scheme", value: scheme }] }),
  ]);
  const picture = async (name) => {
    if (!out) return;
    await pause(300);
    const { data } = await on("Page.captureScreenshot", { format: "png" });
    writeFileSync(join(out, `${name}.png`), Buffer.from(data, "base64"));
  };
  const until = (what, expression) =>
    wait(what, expression, "document.querySelector('#state').textContent + document.querySelector('#told').textContent");
  const state = () => value("document.getElementById('state').textContent");
  const compare = async (of, all, equal = EQUAL) => {
    const seen = await value("Object.fromEntries([...document.querySelectorAll('#peaks tbody tr')].map((r) => [r.cells[0].textContent, Number(r.dataset.value)]))");
    let apart = 0;
    for (const [name, x] of Object.entries(all)) {
      const off = Math.abs(seen[name] - x) / Math.abs(x);
      apart = Math.max(apart, off);
      if (!(off <= equal)) complain(`${of}: ${name} is ${seen[name]} here, ${x} by the program`);
    }
    console.log(`${of}: ${Object.keys(all).length} peaks, apart by ${apart.toExponential(1)} at most; ${await state()}`);
  };

  await size(1280, 900, "light");
  await on("Page.navigate", { url: pathToFileURL(resolve(path)).href });
  await until("the first run", "document.body?.dataset.shown");
  await until("its errors", "document.body.dataset.shown.endsWith(' errors')");
  await compare("as the file says", wanted.peaks);
  await picture("1280-light");

  const slider = `document.querySelector('input[aria-label="${wanted.parameter}, slider"]')`;
  const before = await value("document.body?.dataset.shown");
  await value(`{ const s = ${slider}; s.value = ${wanted.slider}; s.dispatchEvent(new Event("input")); }`);
  await until("its draft", `document.body.dataset.drafted?.includes('"${wanted.parameter}"')`);
  await compare(`${wanted.parameter} moved, a draft`, wanted.moved, DRAFT);
  await until("the run of the slider", `document.body.dataset.shown !== ${JSON.stringify(before)}`);
  await compare(`${wanted.parameter} moved`, wanted.moved);
  const commanded = await value("document.getElementById('command').textContent");
  if (!commanded.includes(`--set ${wanted.parameter}=`)) complain(`the command does not say it: ${commanded}`);
  await until("its errors", "document.body.dataset.shown.endsWith(' errors')");

  const [right, wrong] = wanted.wrong;
  const write = (from, to) => value(`{ const t = document.getElementById("text"); t.value = t.value.replace(${JSON.stringify(from)}, ${JSON.stringify(to)}); t.dispatchEvent(new Event("input")); }`);
  await value("document.querySelector('[aria-controls=file]').click()");
  await write(right, wrong);
  await until("a caret", "!document.getElementById('told').hidden && document.getElementById('told').textContent.includes('^^^')");
  console.log((await value("document.getElementById('told').textContent")).trim());
  await picture("1280-wrong");
  await write(wrong, right);
  await until("the caret to go", "document.getElementById('told').hidden");
  await value("document.querySelector('[aria-controls=values]').click()");
  await value("document.getElementById('back').click()");
  await until("the values of the file", "document.body.dataset.shown.startsWith('[{},')");
  await compare("back", wanted.peaks);
  for (const [width, height, scheme] of [[1280, 900, "dark"], [390, 844, "light"]]) {
    await size(width, height, scheme);
    await picture(`${width}-${scheme}`);
    if (await value("document.documentElement.scrollWidth > innerWidth + 1")) complain(`${width} px: wider than the screen`);
  }
} catch (error) {
  complain(String(error));
} finally {
  await browser.close();
}
process.exit(bad ? 1 : 0);
