// Looks with axe-core for what keeps readers from a page: contrast, names, roles, order of heads, keyboard. Every page is
// looked at wide and narrow, light and dark, with everything unfolded and a word of a figure on screen; pages within a
// page as well. Fails on serious and critical faults, tells the lesser ones.
//
//     node crates/report/tests/axe.mjs --axe FOLDER/node_modules/axe-core/axe.min.js PAGE.html…
//
// axe-core is no part of this project: `npm install axe-core` in some FOLDER elsewhere. It has a licence of its own (MPL-2.0).

import { readFileSync } from "node:fs";
import { basename, dirname, join, resolve } from "node:path";
import { pathToFileURL } from "node:url";
import { open, pause, session } from "./chromium.mjs";

const args = process.argv.slice(2);
const at = args.indexOf("--axe");
const axe = at < 0 ? null : readFileSync(args.splice(at, 2)[1], "utf8");
if (!axe || !args.length) {
  console.log("node crates/report/tests/axe.mjs --axe axe.min.js PAGE.html…");
  process.exit(2);
}
const VIEWS = [[1280, "light"], [1280, "dark"], [390, "light"], [390, "dark"]];
const browser = open();
if (!browser) process.exit(0);

/** Unfolds, passes every part so that it is drawn, and points at the first figure. */
const USE = `(async () => {
  const pages = [document, ...[...document.querySelectorAll("iframe")].map((f) => f.contentDocument).filter(Boolean)];
  for (const page of pages) {
    for (const fold of page.querySelectorAll("details")) fold.open = true;
    const high = page.body.scrollHeight;
    for (let y = 0; y < Math.min(high, 60000); y += 900) { page.defaultView.scrollTo(0, y); for (let i = 0; i < 3; i++) await new Promise(requestAnimationFrame); }
    page.defaultView.scrollTo(0, 0);
    const area = page.querySelector(".view > svg"), r = area?.getBoundingClientRect();
    if (r) for (const y of [0.3, 0.5, 0.7]) area.dispatchEvent(new PointerEvent("pointermove", { clientX: r.left + r.width / 2, clientY: r.top + y * r.height, pointerId: 1, pointerType: "mouse" }));
  }
})()`;
/** What axe finds in a page, [impact, rule, what it says, how often, the first place]. */
const RUN = `(async () => {
  const out = [];
  const look = async (of, where) => {
    const found = await of.axe.run(of.document, { resultTypes: ["violations"], iframes: false });
    for (const v of found.violations) {
      const { html, any, all, none } = v.nodes[0], check = [...any, ...all, ...none][0];
      out.push([v.impact, v.id, v.help, v.nodes.length, where + html.slice(0, 160), check?.message ?? ""]);
    }
  };
  await look(window, "");
  for (const frame of document.querySelectorAll("iframe")) {
    if (!frame.contentDocument) continue;
    if (!frame.contentWindow.axe) frame.contentWindow.eval(AXE);
    await look(frame.contentWindow, "in the page within: ");
  }
  return out;
})()`;

let bad = 0;
try {
  for (const path of args) {
    const name = join(basename(dirname(resolve(path))), basename(path));
    const { on, value, until } = await session(browser, (what) => { bad++; console.log(`${name}: ${what}`); });
    const told = new Map();
    for (const [width, scheme] of VIEWS) {
      await on("Emulation.setDeviceMetricsOverride", { width, height: 900, deviceScaleFactor: 1, mobile: width < 500 });
      await on("Emulation.setEmulatedMedia", { media: "screen", features: [{ name: "prefers-color-scheme", value: scheme }] });
      await on("Page.navigate", { url: pathToFileURL(resolve(path)).href });
      await until("the page", "document.readyState === 'complete'");
      // A page with an engine has something to show after its first run.
      if (await value("Boolean(document.getElementById('engine'))")) await until("its first run with its errors", "document.body.dataset.shown?.endsWith(' errors')");
      await pause(100);
      await value(`window.AXE = ${JSON.stringify(axe)}; eval(AXE); 0`);
      await value(USE);
      for (const [impact, rule, help, count, place, message] of await value(RUN)) {
        const key = `${rule} ${message}`;
        if (!told.has(key)) told.set(key, { impact, rule, help, count, place, message, view: `${width} ${scheme}` });
      }
    }
    const all = [...told.values()];
    const grave = all.filter((f) => f.impact === "serious" || f.impact === "critical");
    bad += grave.length;
    for (const { impact, rule, help, count, place, message, view } of all) console.log(`${name} ${view}: ${impact}: ${rule}: ${help}; ${count} places, the first ${place.replace(/\s+/g, " ")}\n    ${message}`);
    console.log(`${name}: ${grave.length} grave faults, ${all.length - grave.length} lesser ones`);
  }
} finally {
  await browser.close();
}
process.exit(bad ? 1 : 0);
