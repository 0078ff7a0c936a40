// Another run of the same model in the place of this one, without a new start: figures take other points, texts and tables
// are replaced where they differ, the model moves otherwise. Zoom, time and what is open or hidden stay.

/** What is told that there are other deformed shapes. */
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

/** The same of the whole page, whose sections may come and go; of a draft, of those on the screen. */
function changesOfAll(a, b, out, draft) {
  const seen = (section) => {
    const { top, bottom } = section.getBoundingClientRect();
    return bottom > 0 && top < innerHeight;
  };
  const heads = (e) => [...e.children].filter((c) => c.localName !== "section");
  const old = heads(a), now = heads(b), sections = new Map([...a.children].filter((c) => c.localName === "section").map((s) => [s.id, s]));
  if (old.length !== now.length || !old.every((e, i) => e.nodeName === now[i].nodeName && changes(e, now[i], out))) return null;
  let last = old.at(-1);
  for (const section of b.querySelectorAll("section")) {
    const there = sections.get(section.id), before = last;
    if (!there && section.querySelector(FIXED)) return null;
    if (there && (!draft || seen(there)) && !changes(there, section, out)) return null;
    sections.delete(section.id);
    last = there ?? section;
    if (!there) out.push(() => { before.after(section); begin(section); });
  }
  for (const gone of sections.values()) {
    if (gone.querySelector(FIXED)) return null;
    out.push(() => { refill(gone, document.createElement("section")); gone.remove(); });
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

/** The model of the page, which stays: as a text, to be compared. */
let known = null;

/** Takes what `run_update` made; false where the model is another, or the page has other stages: nothing is changed then.
 *  A draft is followed by its run: what is not on the screen waits for that. */
window.renew = (text, draft = false) => {
  const next = new DOMParser().parseFromString(text, "text/html");
  const of = (page, id) => page.getElementById(id);
  const fresh = JSON.parse(of(next, "data").textContent), all = [];
  const model = ({ picture, modes, frames }) => JSON.stringify([picture, modes.length, frames.t.length > 1]);
  known ??= model(JSON.parse(of(document, "data").textContent));
  if (model(fresh) !== known) return false;
  if (!changesOfAll(document.querySelector("main"), next.querySelector("main"), all, draft)) return false;
  if (!changes(of(document, "made"), of(next, "made"), all)) return false;
  document.title = next.title;
  for (const change of all) change();
  // Pictures on paper would be those of before: the charts are printed as they are.
  for (const still of document.querySelectorAll("figure > .chart ~ svg, .still")) still.remove();
  Object.assign(data, { frames: fresh.frames, modes: fresh.modes, tints: fresh.tints });
  for (const id of ["data", "shapes"]) of(document, id).textContent = of(next, id).textContent;
  drawings = null;
  for (const tell of renewals) tell(of(next, "player")?.dataset.scale);
  return true;
};
