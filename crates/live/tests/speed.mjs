// How long a live page takes from a slider to the drawn result, the draft and the run: moves it step by step and tells the median of the
// engine (model, march, page of the run), of what the page does with it, and of both until the next picture.
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
  await until("the first run with its errors", "document.body?.dataset.shown?.endsWith(' errors')");
  const all = await value(`(async () => {
    const slider = document.querySelector('input[aria-label="${parameter}, slider"]'), all = [], { dataset } = document.body;
    const told = (name, begin) => {
      const changed = new Promise((done) => {
        const watch = new MutationObserver(() => { watch.disconnect(); done(); });
        watch.observe(document.body, { attributeFilter: ["data-" + name] });
      });
      return async () => {
        await changed;
        const there = performance.now() - begin, engine = Number(dataset.engine);
        await new Promise(requestAnimationFrame);
        all.push({ name, engine, there, seen: performance.now() - begin, kind: dataset.made });
      };
    };
    for (let i = 1; i <= 80; i++) {
      // From a page at rest: what was shown last is drawn.
      await new Promise(requestIdleCallback);
      const begin = performance.now(), [draft, run] = [told("drafted", begin), told("shown", begin)];
      slider.value = (i % 2 ? -0.02 : 0.02) * (i % 40 + 1);
      slider.dispatchEvent(new Event("input"));
      await draft();
      // The run comes when the slider has stood still for a while.
      if (i % 4 === 0) await run();
    }
    return all;
  })()`);
  const size = `${(statSync(path).size / 1e6).toFixed(2)} MB`;
  for (const [name, words] of [["drafted", "draft"], ["shown", "run, with the wait before it"]]) {
    const these = all.filter((a) => a.name === name);
    const median = (of) => these.map(of).sort((a, b) => a - b)[these.length >> 1].toFixed(0);
    console.log(`${size}; ${parameter}, ${words}: engine ${median((a) => a.engine)} ms, page and waiting ${median((a) => a.there - a.engine)} ms, drawn after ${median((a) => a.seen)} ms (${these.at(-1).kind})`);
  }
} finally {
  await browser.close();
}
process.exit(bad ? 1 : 0);
