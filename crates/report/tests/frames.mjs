// How fast a model moves on its page: plays it, turns it, and tells frames a second, milliseconds of script and calls of WebGL
// a frame; once as the browser draws it and, where that is without a graphics processor, once as if there were one. Frames a second
// are then those of a processor in its place: what the page has in hand is script and calls. Fails where there are more of
// them than a limit.
//
//     node crates/report/tests/frames.mjs PAGE.html…
//
// SCRIPT: most milliseconds of script a frame beside a graphics processor (5); DRAWING: the same without one (25); CALLS: most
// calls that draw (60).

import { basename, dirname, join, resolve } from "node:path";
import { pathToFileURL } from "node:url";
import { open, pause, session } from "./chromium.mjs";

const { SCRIPT = 5, DRAWING = 25, CALLS = 60 } = process.env;
const browser = open();
if (!browser) process.exit(0);

/** Counts frames, and calls that draw. */
const COUNT = `{
  window.told = { draws: 0, frames: 0 };
  for (const name of ["drawArrays", "drawElements", "drawArraysInstanced", "drawElementsInstanced"]) {
    const call = WebGL2RenderingContext.prototype[name];
    WebGL2RenderingContext.prototype[name] = function (...args) { told.draws++; return call.apply(this, args); };
  }
  const ask = window.requestAnimationFrame;
  window.requestAnimationFrame = (then) => ask.call(window, (now) => {
    then(now);
    told.frames++;
  });
}`;
/** A browser that does not tell what draws. */
const SILENT = `{
  const get = WebGL2RenderingContext.prototype.getExtension;
  WebGL2RenderingContext.prototype.getExtension = function (name) { return name === "WEBGL_debug_renderer_info" ? null : get.call(this, name); };
}`;
const READY = `(async () => {
  const stage = document.getElementById("stage");
  stage.scrollIntoView({ block: "center" });
  await new Promise((done) => setTimeout(done, 1000));
  window.turn = () => {
    if (!window.turns) return;
    stage.dispatchEvent(new KeyboardEvent("keydown", { key: "ArrowLeft", shiftKey: true }));
    requestAnimationFrame(turn);
  };
  window.play = [...document.querySelectorAll("#player button")].find((b) => b.textContent === "Play");
  return Boolean(play);
})()`;
const DO = [
  ["plays", "play.click()", "play.click()"],
  ["turns", "{ window.turns = true; requestAnimationFrame(turn); }", "{ window.turns = false; }"],
];

/** Time in the functions of the page itself, and in the collector of what they leave behind, ms; waiting for what draws is no script. */
function scripts({ nodes, samples, timeDeltas }) {
  const of = new Map(nodes.map((n) => [n.id, n.callFrame]));
  let ms = 0;
  samples.forEach((id, i) => {
    const { functionName, url } = of.get(id);
    if (url.startsWith("file:") || functionName === "(garbage collector)") ms += timeDeltas[i] / 1000;
  });
  return ms;
}

let bad = 0;

/** One page in a new tab; returns what drew it. */
async function look(path, before) {
  const name = join(basename(dirname(resolve(path))), basename(path));
  const complain = (what) => { bad++; console.log(`${name}: ${what}`); };
  const { on, value, until } = await session(browser, complain);
  await on("Emulation.setDeviceMetricsOverride", { width: 1280, height: 900, deviceScaleFactor: 1, mobile: false });
  for (const source of before) await on("Page.addScriptToEvaluateOnNewDocument", { source });
  await on("Page.navigate", { url: pathToFileURL(resolve(path)).href });
  await until("the page", "document.readyState === 'complete'");
  const paint = await value("performance.getEntriesByName('first-contentful-paint')[0]?.startTime ?? performance.getEntriesByType('navigation')[0].domContentLoadedEventEnd");
  const drawn = await value("document.documentElement.dataset.solid"), most = Number(drawn === "webgl" ? SCRIPT : DRAWING);
  console.log(`${name}: first paint after ${Math.round(paint)} ms; drawn by ${drawn}`);
  if (!await value(READY)) { complain("nothing moves"); return drawn; }
  await on("Profiler.enable");
  await on("Profiler.setSamplingInterval", { interval: 200 });
  for (const [what, start, stop] of DO) {
    await value("Object.assign(told, { draws: 0, frames: 0 })");
    await on("Profiler.start");
    const since = Date.now();
    await value(start);
    await pause(6000);
    const { draws, frames } = await value("told");
    await value(stop);
    const { profile } = await on("Profiler.stop"), script = scripts(profile) / frames, fps = (1000 * frames) / (Date.now() - since);
    console.log(`${name} ${what}: ${fps.toFixed(1)} frames/s, ${script.toFixed(2)} ms of script a frame, ${(draws / frames).toFixed(0)} calls`);
    if (!(script <= most)) complain(`more than ${most} ms of script`);
    if (!(draws / frames <= CALLS)) complain(`more than ${CALLS} calls`);
  }
  return drawn;
}

try {
  for (const path of process.argv.slice(2)) if (await look(path, [COUNT]) === "plain") await look(path, [COUNT, SILENT]);
} finally {
  await browser.close();
}
process.exit(bad ? 1 : 0);
