// How long a live page takes from a slider to the drawn result: moves it step by step and tells the median of the engine (model, march, page
// of the run), of what the page does with it, and of both until the next picture.
//
//     node crates/live/tests/speed.mjs PAGE.html PARAMETER

import { statSync } from "node:fs";
import { resolve } from "node:path";
import { pathToFileURL } from "node:url";
import { open, session } from "../../report/tests/chromium.mjs";

const [path, parameter] = process.argv.slice(2);
const browser = open();
if (!browser) process.exit(0);
let bad = 0;
try {
  const { on, value, until } = await session(browser, (what) => { bad++; console.log(what); });
  await on("Emulation.setDeviceMetricsOverride", { width: 1280, height: 900, deviceScaleFactor: 1, mobile: false });
  await on("Page.navigate", { url: pathToFileURL(resolve(path)).href });
  await until("the first run with its errors", "document.body?.dataset.shown?.includes('true]')");
  const all = await value(`(async () => {
    const slider = document.querySelector('input[aria-label="${parameter}, slider"]'), all = [];
    for (let i = 1; i <= 12; i++) {
      const before = document.body.dataset.shown, begin = performance.now();
      slider.value = -0.02 * i;
      slider.dispatchEvent(new Event("input"));
      while (document.body.dataset.shown === before) await new Promise((done) => setTimeout(done));
      const drawn = performance.now();
      await new Promise(requestAnimationFrame);
      all.push({ engine: Number(document.body.dataset.engine), there: drawn - begin, seen: performance.now() - begin, kind: document.body.dataset.made });
    }
    return all;
  })()`);
  const median = (of) => all.map(of).sort((a, b) => a - b)[all.length >> 1].toFixed(0);
  console.log(`${(statSync(path).size / 1e6).toFixed(2)} MB; ${parameter}: engine ${median((a) => a.engine)} ms, page ${median((a) => a.there - a.engine)} ms, drawn after ${median((a) => a.seen)} ms (${all.at(-1).kind})`);
} finally {
  await browser.close();
}
process.exit(bad ? 1 : 0);
