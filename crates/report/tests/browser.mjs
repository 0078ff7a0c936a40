// Opens pages in headless Chromium as readers do: wide and narrow, light, dark and printed. Fails on whatever the console
// says, on requests to anywhere, on pages wider than the screen, and on charts that did not come alive.
//
//     node crates/report/tests/browser.mjs [--out FOLDER] PAGE.html…
//
// --out: pictures of every page there. Where no Chromium is found (CHROMIUM names one) it says so and ends well.

import { mkdirSync, readFileSync, statSync, writeFileSync } from "node:fs";
import { basename, dirname, join, resolve } from "node:path";
import { pathToFileURL } from "node:url";
import { open, pause } from "./chromium.mjs";

const VIEWS = [
  { name: "1280-light", width: 1280, height: 900, scheme: "light" },
  { name: "1280-dark", width: 1280, height: 900, scheme: "dark" },
  { name: "390-light", width: 390, height: 844, scheme: "light", touch: true },
  { name: "390-dark", width: 390, height: 844, scheme: "dark", touch: true },
];
/** Pages may weigh so much without their histories, bytes. */
const HEAVIEST = Number(process.env.HEAVIEST ?? 3e6);
/** Pictures with WebGL and without may be so far apart: edges are smoothed in two ways. */
const APART = 4;
/** Pictures are so tall at most, px: of long pages there are several. */
const TALLEST = 2000;

const args = process.argv.slice(2);
const at = args.indexOf("--out");
const out = at < 0 ? null : args.splice(at, 2)[1];
const browser = open();
if (!browser) process.exit(0);
if (out) mkdirSync(out, { recursive: true });

const { send, listeners } = browser;

/** Scrolls through the page so that everything is drawn, and says what is amiss. */
const LOOK = `(async () => {
  const wait = (ms) => new Promise((done) => setTimeout(done, ms));
  for (let y = 0; y < document.body.scrollHeight; y += 700) {
    scrollTo(0, y);
    // Observers report with the next pictures.
    for (let i = 0; i < 3; i++) await new Promise(requestAnimationFrame);
  }
  scrollTo(0, 0);
  await wait(100);
  const said = [], root = document.documentElement;
  const drawings = document.querySelectorAll("script.drawing"), ready = root.dataset.ready === "true";
  if (drawings.length && !ready) said.push("the script did not come to its end");
  const dead = [...document.querySelectorAll(".chart")].filter((c) => c.offsetParent && !c.querySelector(".view > svg > path"));
  if (dead.length) said.push(dead.length + " charts are empty, the first: " + dead[0].textContent.slice(0, 60));
  if (root.scrollWidth > innerWidth + 1) {
    const wide = [...document.body.querySelectorAll("*")].find((e) => e.getBoundingClientRect().right > innerWidth + 1 && !e.closest(".wide, pre, svg"));
    said.push("wider than the screen: " + root.scrollWidth + " px, " + (wide ? wide.tagName + "." + wide.className : ""));
  }
  for (const chart of document.querySelectorAll(".chart")) {
    if (!chart.offsetParent) continue;
    const few = ["x", "y"].filter((axis) => {
      const n = chart.querySelectorAll('[data-tick="' + axis + '"]').length;
      return n > 0 && n < 3;
    });
    if (few.length) said.push("fewer than three ticks along " + few + ": " + chart.textContent.slice(0, 60));
  }
  return { said, height: document.body.scrollHeight };
})()`;
/** Points at, drags over and resets the first charts. */
const USE = `(async () => {
  const wait = (ms) => new Promise((done) => setTimeout(done, ms));
  const said = [];
  for (const view of [...document.querySelectorAll(".view")].slice(0, 6)) {
    view.scrollIntoView({ block: "center" });
    // It is drawn from now on, as observers report with the next pictures, however slow these are.
    for (let i = 0; i < 4; i++) await new Promise(requestAnimationFrame);
    await wait(80);
    const svg = view.querySelector("svg"), r = svg.getBoundingClientRect();
    const go = (type, x, y, more = {}) => svg.dispatchEvent(new PointerEvent(type, {
      clientX: r.left + x * r.width, clientY: r.top + y * r.height, pointerId: 1, pointerType: "mouse", bubbles: true, button: 0, ...more }));
    svg.setPointerCapture = () => {};
    let told = false;
    for (const x of [0.3, 0.5, 0.7]) for (const y of [0.2, 0.4, 0.6, 0.8]) { go("pointermove", x, y); told ||= !view.querySelector(".tip").hidden; }
    if (!told) said.push("tells nothing: " + view.parentElement.textContent.slice(0, 50));
    const before = svg.innerHTML;
    go("pointerdown", 0.4, 0.2); go("pointermove", 0.6, 0.5); go("pointerup", 0.6, 0.5);
    await wait(30);
    const reset = view.querySelector(".reset");
    if (reset.hidden || svg.innerHTML === before) said.push("does not zoom: " + view.parentElement.textContent.slice(0, 50));
    svg.dispatchEvent(new MouseEvent("dblclick"));
    await wait(30);
    svg.dispatchEvent(new PointerEvent("pointerleave"));
    if (!reset.hidden) said.push("does not reset: " + view.parentElement.textContent.slice(0, 50));
  }
  scrollTo(0, 0);
  return said;
})()`;

/** Turns, searches, hides, moves, colours and saves the model. */
const MODEL = (drawn) => `(async () => {
  const stage = document.getElementById("stage"), said = [], root = document.documentElement;
  if (!stage) return said;
  const wait = () => new Promise(requestAnimationFrame);
  // A large one is drawn finely when it has come to rest.
  const seen = async () => { do await wait(); while (stage.dataset.fine === "false"); return stage.toDataURL(); };
  if (!${drawn}.includes(root.dataset.solid)) said.push("the model is drawn by " + root.dataset.solid);
  stage.scrollIntoView({ block: "center" });
  const data = JSON.parse(document.getElementById("data").textContent);
  const player = document.getElementById("player"), finder = document.getElementById("finder");
  player.querySelector('[data-view="space"]')?.click();
  const first = await seen();
  const r = stage.getBoundingClientRect();
  stage.setPointerCapture = () => {};
  const go = (type, x, y) => stage.dispatchEvent(new PointerEvent(type, { clientX: r.left + x * r.width, clientY: r.top + y * r.height,
    pointerId: 1, pointerType: "touch", bubbles: true, buttons: 1 }));
  const changed = async (from, what) => { const now = await seen(); if (now === from) said.push(what + " leaves the model as it was"); return now; };
  const same = async (as, what) => { if (await seen() !== as) said.push(what + " does not lead back"); };
  go("pointerdown", 0.5, 0.5); go("pointermove", 0.6, 0.6); go("pointerup", 0.6, 0.6);
  await changed(first, "one finger");
  stage.dispatchEvent(new MouseEvent("dblclick"));
  await same(first, "a double click");
  stage.dispatchEvent(new KeyboardEvent("keydown", { key: "ArrowUp", shiftKey: true }));
  await changed(first, "Shift with an arrow");
  stage.dispatchEvent(new KeyboardEvent("keydown", { key: "0" }));
  const type = (text) => { const box = finder.querySelector("input"); box.value = text; box.dispatchEvent(new Event("input")); };
  const wanted = data.picture.nodes.at(-1).name;
  type(wanted);
  if (!/^[1-9]/.test(finder.querySelector("output").textContent)) said.push("does not find " + wanted);
  await changed(first, "a search");
  type("no such name anywhere");
  if (finder.querySelector("output").textContent !== "0 found") said.push("finds what there is not");
  type("");
  stage.dispatchEvent(new MouseEvent("dblclick"));
  await same(first, "the end of a search");
  const keys = [...finder.querySelectorAll("[aria-pressed]")];
  for (const key of keys) key.click();
  if (keys.length) await changed(first, "hiding everything");
  for (const key of keys) key.click();
  if (keys.length) await same(first, "showing everything");
  const scrub = player.querySelector("input[type=range]");
  if (scrub) {
    const step = async (to) => { scrub.value = to; scrub.dispatchEvent(new Event("input")); return seen(); };
    // What moves for a short while may be at rest twice.
    const [early, middle, late] = [await step("60"), await step("300"), await step("800")];
    if (early === late && middle === late) said.push("the clock does not move the model");
    const colours = [...player.querySelectorAll("label")].find((l) => l.textContent.startsWith("colours"))?.querySelector("select");
    let last = late;
    for (let i = 1; i < Math.min(colours?.options.length ?? 0, 4); i++) {
      colours.selectedIndex = i;
      colours.dispatchEvent(new Event("change"));
      last = await changed(last, "a colour");
    }
    if (colours) { colours.selectedIndex = 0; colours.dispatchEvent(new Event("change")); await same(late, "no colour"); }
    await step("0");
  }
  let saved = "";
  const click = HTMLAnchorElement.prototype.click;
  HTMLAnchorElement.prototype.click = function () { saved = this.download + " " + this.href; };
  finder.querySelector("button:not([aria-pressed])").click();
  if (!saved.startsWith("model.png data:image/png;base64,iVBORw0KGgo")) said.push("saves no picture: " + saved.slice(0, 60));
  const film = [...finder.querySelectorAll("button")].find((b) => b.textContent === "save video");
  if (!film && scrub) said.push("saves no video");
  if (film) {
    let bytes = 0;
    const make = URL.createObjectURL;
    URL.createObjectURL = (blob) => { bytes = blob.size; return make.call(URL, blob); };
    film.click();
    for (let i = 0; i < 20; i++) await wait();
    film.click();
    for (let i = 0; i < 200 && !bytes; i++) await new Promise((done) => setTimeout(done, 25));
    if (bytes < 1000 || !/^model\\.(mp4|webm) blob:/.test(saved)) said.push("saves no video: " + bytes + " bytes, " + saved.slice(0, 60));
    URL.createObjectURL = make;
    if (film.textContent !== "save video") said.push("goes on with the video");
  }
  HTMLAnchorElement.prototype.click = click;
  return said;
})()`;
/** Without WebGL the page draws the model itself. */
const NO_WEBGL = `{
  const get = HTMLCanvasElement.prototype.getContext;
  HTMLCanvasElement.prototype.getContext = function (kind, ...rest) { return kind === "webgl2" ? null : get.call(this, kind, ...rest); };
}`;
/** Its pictures at rest, and in the middle of its motion in each colouring: red, green and blue of squares of four by four pixels. */
const SHOWN = `(async () => {
  const stage = document.getElementById("stage"), player = document.getElementById("player"), small = document.createElement("canvas"), out = [];
  if (!stage) return out;
  const c = small.getContext("2d", { willReadFrequently: true });
  const take = async () => {
    do await new Promise(requestAnimationFrame); while (stage.dataset.fine === "false");
    [small.width, small.height] = [stage.width >> 2, stage.height >> 2];
    c.drawImage(stage, 0, 0, small.width, small.height);
    out.push([...c.getImageData(0, 0, small.width, small.height).data].filter((_, i) => i % 4 < 3));
  };
  player.querySelector('[data-view="space"]')?.click();
  await take();
  const scrub = player.querySelector("input[type=range]");
  const move = (to) => { scrub.value = to; scrub.dispatchEvent(new Event("input")); };
  const colours = [...player.querySelectorAll("label")].find((l) => l.textContent.startsWith("colours"))?.querySelector("select");
  if (!scrub || !colours) return out;
  move(500);
  for (let i = colours.options.length - 1; i >= 0; i--) {
    colours.selectedIndex = i;
    colours.dispatchEvent(new Event("change"));
    await take();
  }
  move(0);
  return out;
})()`;

/** How far two pictures are apart where one of them shows something: the mean, of 255. */
function apart(a, b) {
  if (a.length !== b.length) return 255;
  const paper = [a[0], a[1], a[2]];
  let [sum, count] = [0, 0];
  a.forEach((x, i) => {
    if (x === paper[i % 3] && b[i] === paper[i % 3]) return;
    sum += Math.abs(x - b[i]);
    count++;
  });
  return count ? sum / count : 255;
}

/** Bytes of curves and of the motion, which are as long as a run. */
function histories(html) {
  const all = html.match(/<script type="application\/json" class="drawing">.*?<\/script>|<script type="text\/plain" id="shapes">.*?<\/script>/gs) ?? [];
  return all.reduce((sum, text) => sum + Buffer.byteLength(text), 0);
}

let bad = 0;
const told = new Set();
const complain = (page, view, what) => {
  bad++;
  const line = `${page} ${view}: ${what}`;
  if (!told.has(line)) console.log(line);
  told.add(line);
};

async function look(path) {
  const name = join(basename(dirname(resolve(path))), basename(path)).replace(/[^\w.-]+/g, "_").replace(/\.html$/, "");
  const weight = statSync(path).size, bare = weight - histories(readFileSync(path, "utf8"));
  if (bare > HEAVIEST) complain(name, "", `weighs ${(bare / 1e6).toFixed(2)} MB without its histories`);
  const { targetId } = await send("Target.createTarget", { url: "about:blank" });
  const { sessionId } = await send("Target.attachToTarget", { targetId, flatten: true });
  const on = (method, params) => send(method, params, sessionId);
  let view = "", paint = null, shown = [];
  const hear = ({ method, params, sessionId: of }) => {
    if (of !== sessionId) return;
    if (method === "Runtime.consoleAPICalled") complain(name, view, `console: ${params.args.map((a) => a.value ?? a.description).join(" ")}`);
    if (method === "Runtime.exceptionThrown") complain(name, view, `exception: ${params.exceptionDetails.exception?.description ?? params.exceptionDetails.text}`);
    if (method === "Log.entryAdded") complain(name, view, `log: ${params.entry.text}`);
    if (method === "Network.requestWillBeSent" && !/^(file|data):/.test(params.request.url)) complain(name, view, `asks for ${params.request.url}`);
  };
  listeners.add(hear);
  for (const domain of ["Page", "Runtime", "Log", "Network"]) await on(`${domain}.enable`);
  const value = async (expression) => {
    const { result, exceptionDetails } = await on("Runtime.evaluate", { expression, awaitPromise: true, returnByValue: true });
    if (exceptionDetails) complain(name, view, `exception: ${exceptionDetails.exception?.description ?? exceptionDetails.text}`);
    return result.value;
  };
  for (const { name: of, width, height, scheme, touch } of VIEWS) {
    view = of;
    await on("Emulation.setDeviceMetricsOverride", { width, height, deviceScaleFactor: 1, mobile: Boolean(touch) });
    await on("Emulation.setEmulatedMedia", { media: "screen", features: [{ name: "prefers-color-scheme", value: scheme }] });
    await on("Page.navigate", { url: pathToFileURL(resolve(path)).href });
    for (let i = 0; i < 200; i++) {
      if (await value("document.readyState") === "complete") break;
      await pause(25);
    }
    const seen = await value(LOOK);
    paint ??= await value("performance.getEntriesByName('first-contentful-paint')[0]?.startTime") ?? null;
    for (const what of seen?.said ?? []) complain(name, view, what);
    if (view === "1280-light") {
      shown = await value(SHOWN);
      for (const what of [...await value(USE), ...await value(MODEL('["webgl", "plain"]'))]) complain(name, view, what);
    }
    if (!out) continue;
    for (let y = 0, i = 1; y < seen.height; y += TALLEST, i++) {
      const clip = { x: 0, y, width, height: Math.min(seen.height - y, TALLEST), scale: 1 };
      const { data } = await on("Page.captureScreenshot", { format: "png", captureBeyondViewport: true, clip });
      writeFileSync(join(out, `${name}-${view}-${String(i).padStart(2, "0")}.png`), Buffer.from(data, "base64"));
    }
  }
  view = "without WebGL";
  await on("Emulation.setDeviceMetricsOverride", { width: 1280, height: 900, deviceScaleFactor: 1, mobile: false });
  await on("Emulation.setEmulatedMedia", { media: "screen", features: [{ name: "prefers-color-scheme", value: "light" }] });
  const { identifier } = await on("Page.addScriptToEvaluateOnNewDocument", { source: NO_WEBGL });
  await on("Page.navigate", { url: pathToFileURL(resolve(path)).href });
  for (let i = 0; i < 200; i++) {
    if (await value("document.readyState") === "complete") break;
    await pause(25);
  }
  await value("new Promise(requestAnimationFrame)");
  if (shown.length) {
    const now = await value(SHOWN), off = Math.max(...shown.map((picture, i) => apart(picture, now[i] ?? [])));
    if (!(off <= APART)) complain(name, view, `the model is drawn otherwise, by ${off.toFixed(1)} of 255`);
    for (const what of await value(MODEL('["plain"]'))) complain(name, view, what);
  }
  await on("Page.removeScriptToEvaluateOnNewDocument", { identifier });
  view = "print";
  await on("Emulation.setEmulatedMedia", { media: "", features: [] });
  const { data } = await on("Page.printToPDF", { preferCSSPageSize: true, printBackground: true });
  if (out) writeFileSync(join(out, `${name}.pdf`), Buffer.from(data, "base64"));
  listeners.delete(hear);
  await send("Target.closeTarget", { targetId });
  // How long it takes hangs on the machine and on what else it does: it is told, no fault.
  console.log(`${name}: ${(weight / 1e6).toFixed(2)} MB, ${(bare / 1e6).toFixed(2)} MB without histories, first paint after ${paint === null ? "–" : Math.round(paint)} ms`);
}

try {
  for (const path of args) await look(path);
} finally {
  await browser.close();
}
console.log(bad ? `${bad} faults in ${args.length} pages` : `${args.length} pages, no fault`);
process.exit(bad ? 1 : 0);
