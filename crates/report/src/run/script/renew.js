// Another run of the same model in the place of this one, without a new start: figures take other points, texts and tables
// are replaced where they differ, the model moves otherwise. Zoom, time and what is open or hidden stay.

/** What is told that there are other deformed shapes, `frames` or `modes`. */
const renewals = [];

/** Elements that the page makes for itself, beside what it came with. */
const OWN = ".chart, .controls, .stage, .still, .watched";
const parts = (e) => [...e.childNodes].filter((n) => (n.nodeType === 1 ? !n.matches(OWN) && !(n.localName === "svg" && n.parentNode.localName === "figure") : n.nodeType === 3));

/** What only a new page makes: stages, sliders, fields. */
const FIXED = "canvas, input[type=search], input[type=range]";

/** Puts the parts of another element in the place of those of one. */
function refill(a, b) {
  for (const figure of a.querySelectorAll("figure")) Chart.of.get(figure)?.leave();
  a.replaceChildren(...b.childNodes);
  begin(a);
}

/** What one element has to become: a list of changes, or null where only a new page will do. */
function changes(a, b, out) {
  if (a.nodeType === 3) {
    if (a.data !== b.data) out.push(() => { a.data = b.data; });
    return out;
  }
  if (a.matches("script.drawing")) {
    if (a.textContent !== b.textContent) out.push(() => { a.textContent = b.textContent; Chart.of.get(a.parentElement)?.renew(JSON.parse(b.textContent)); });
    return out;
  }
  if (a.matches("canvas, input")) return out;
  const name = b.getAttribute("class") ?? "";
  if (name !== (a.getAttribute("class") ?? "")) out.push(() => a.setAttribute("class", name));
  const [old, now] = [parts(a), parts(b)];
  if (old.length === now.length && old.every((n, i) => n.nodeName === now[i].nodeName)) {
    return old.every((n, i) => changes(n, now[i], out)) ? out : null;
  }
  if (a.querySelector(FIXED) || b.querySelector(FIXED)) return null;
  out.push(() => refill(a, b));
  return out;
}

/** The same of the whole page, whose sections may come and go; or of some sections and of what stands before them. */
function changesOfAll(a, b, out, all) {
  const heads = (e) => [...e.children].filter((c) => c.localName !== "section" && (all || c.localName !== "nav"));
  const old = heads(a), now = heads(b), sections = new Map([...a.children].filter((c) => c.localName === "section").map((s) => [s.id, s]));
  if (old.length !== now.length || !old.every((e, i) => e.nodeName === now[i].nodeName && changes(e, now[i], out))) return null;
  let last = old.at(-1);
  for (const section of b.querySelectorAll("section")) {
    const there = sections.get(section.id), before = last;
    if (!there && section.querySelector(FIXED)) return null;
    if (there && !changes(there, section, out)) return null;
    sections.delete(section.id);
    last = there ?? section;
    if (!there) out.push(() => { before.after(section); begin(section); watch.observe(section); });
  }
  if (all) for (const gone of sections.values()) {
    if (gone.querySelector(FIXED)) return null;
    out.push(() => { refill(gone, document.createElement("section")); gone.remove(); watch.unobserve(gone); seen.delete(gone.id); });
  }
  return out;
}

/** Does a thing that can wait when the page has nothing else to do; of those that wait the last. */
let waiting = 0;
function later(work) {
  const [begin, end] = window.requestIdleCallback ? [window.requestIdleCallback, window.cancelIdleCallback] : [(w) => setTimeout(w, 100), clearTimeout];
  end.call(window, waiting);
  waiting = begin.call(window, work);
}

/** Sections on the screen, by their ids. */
const seen = new Set();
const watch = new IntersectionObserver((all) => {
  for (const { target, isIntersecting } of all) seen[isIntersecting ? "add" : "delete"](target.id);
});
for (const section of document.querySelectorAll("main > section")) watch.observe(section);
window.onScreen = () => [...seen];

/** Takes what `run_update` made; false where the model is another, or the page has other stages: nothing is changed then. */
window.renew = (text) => {
  const next = new DOMParser().parseFromString(text, "text/html");
  const of = (page, id) => page.getElementById(id);
  const [old, now] = [document, next].map((page) => page.querySelector("main"));
  if (old.dataset.model !== now.dataset.model) return false;
  const fresh = JSON.parse(of(next, "data").textContent), changed = [];
  const moves = (frames) => frames.t.length > 1;
  if (fresh.modes && fresh.modes.length !== data.modes.length) return false;
  if (fresh.frames && moves(fresh.frames) !== moves(data.frames)) return false;
  // Of all sections, or of some.
  const made = of(next, "made");
  if (!changesOfAll(old, now, changed, Boolean(made))) return false;
  if (made && !changes(of(document, "made"), made, changed)) return false;
  document.title = next.title;
  for (const change of changed) change();
  // Pictures on paper would be those of before: the charts are printed as they are.
  for (const still of document.querySelectorAll("figure > .chart ~ svg, .still")) still.remove();
  Object.assign(data, fresh);
  for (const id of made ? ["data", "shapes"] : fresh.frames ? ["shapes"] : []) of(document, id).textContent = of(next, id).textContent;
  drawings = null;
  for (const tell of renewals) tell(fresh, of(next, "player")?.dataset.scale);
  return true;
};
