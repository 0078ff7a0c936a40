// Drives the page of a watched model: zooms, chooses a time, saves the model with another value, and finds what was chosen;
// saves it with a fault, and reads it on the page.
//
//     node crates/cli/tests/watch.mjs REPORT.html MODEL.ron

import { readFileSync, writeFileSync } from "node:fs";
import { resolve } from "node:path";
import { pathToFileURL } from "node:url";
import { open, session } from "../../report/tests/chromium.mjs";

const [page, model] = process.argv.slice(2);
const browser = open();
if (!browser) process.exit(0);
let bad = 0;
const complain = (what) => { bad++; console.log(what); };

try {
  const { on, value, until } = await session(browser, complain);
  const save = (from, to) => {
    const text = readFileSync(model, "utf8");
    if (!text.includes(from)) complain(`the model has no ${from}`);
    writeFileSync(model, text.replace(from, to));
  };
  /** Charts are drawn when they come near the screen. */
  const drawn = async () => {
    await value("document.querySelector('.chart').scrollIntoView()");
    await until("a chart", "document.querySelector('.chart .view > svg').childElementCount > 0");
  };
  const loaded = () => value("performance.timeOrigin");

  await on("Page.navigate", { url: `${pathToFileURL(resolve(page)).href}#watch` });
  await until("the page", "document.documentElement?.dataset.ready && document.documentElement?.dataset.watched");
  const first = await loaded();
  // A time by the slider of the player, a part of the time by the keys of a chart.
  await value("{ const s = document.querySelector('.scrub input'); s.value = 400; s.dispatchEvent(new Event('input')); }");
  await drawn();
  await value("document.querySelector('.chart .view > svg').dispatchEvent(new KeyboardEvent('keydown', { key: '+' }))");
  await until("the zoom", "!document.querySelector('.chart .reset').hidden");
  await value("window.scrollTo(0, 300)");
  const chosen = await value("document.querySelector('.scrub output').textContent");

  save('"mu": 0.6', '"mu": 0.3');
  const waited = await until("the page to follow", `performance.timeOrigin > ${first} && document.documentElement?.dataset.watched`);
  if ((await value("document.querySelector('.scrub output').textContent")) !== chosen) complain("the time was lost");
  if ((await value("scrollY")) !== 300) complain("the place on the page was lost");
  await drawn();
  if (await value("document.querySelector('.chart .reset').hidden")) complain("the zoom was lost");
  console.log(`followed after ${waited} ms`);

  const second = await loaded();
  save('"mu": 0.3', '"mu": "3 m"');
  await until("what is wrong", "!document.querySelector('.watched').hidden");
  const told = await value("document.querySelector('.watched').textContent");
  if (!told.includes("mu")) complain(`it says ${told}`);
  if ((await loaded()) !== second) complain("the page was loaded for a run that is none");
  save('"mu": "3 m"', '"mu": 0.2');
  await until("the page to follow again", `performance.timeOrigin > ${second} && document.querySelector('.watched')?.hidden`);
} catch (error) {
  complain(String(error));
} finally {
  await browser.close();
}
process.exit(bad ? 1 : 0);
