// Runs follow what is changed: at once as a draft with coarser steps, then as the file says, and with the errors of the steps
// when nothing has changed for a while.
"use strict";
let timer, patience;
/** Whether runs make a page of their own: what is changed has another model as its effect, such as another width. */
let anew = false;
/** Changes so far, and the one whose run is there, be it that it has no draft. */
let count = 0, exact = 0;
/** Milliseconds without a change before a draft is followed by its run, and that by its errors; after which a run makes way for
 *  another value, and a draft is called long. */
const STILL = 150, QUIET = 700, WAY = 50, PATIENCE = 1500;

const seconds = (ms) => (ms < 1000 ? `${Math.round(ms)} ms` : `${(ms / 1000).toFixed(1)} s`);
const SAY = {
  draft: (ms) => `Draft in ${ms}, with coarser steps; the run follows.`,
  plain: (ms) => `Run in ${ms}; its errors follow.`,
  errors: (ms) => `Run with its errors in ${ms}.`,
};

const shown = (asked, update, change, of) => (answer) => {
  clearTimeout(patience);
  const care = answer.care ?? asked;
  if (care !== "draft") {
    exact = change;
    if (change === count) engine.drop("plain");
  }
  if (answer.told) {
    tell(answer.told);
    say("The results are those of before.");
    return;
  }
  if (!update) frames.show(answer.page);
  else if (!frames.renew(answer.page)) { anew = true; run(asked === "draft" ? "plain" : asked); return; }
  tell("");
  peaks(answer.peaks);
  say(SAY[care](seconds(answer.ms)));
  Object.assign(document.body.dataset, { engine: answer.ms, made: update ? "renewed" : "made anew", [care === "draft" ? "drafted" : "shown"]: `${of} ${care}` });
};
function run(care) {
  const update = frames.there() && !anew;
  const { path, text, set, case: of, solver } = state;
  const words = JSON.stringify([set, of, solver, text.length]);
  // A draft is followed by its run: what is not on the screen waits for that.
  const sections = update && care === "draft" ? frames.seen() : null;
  engine.ask(care, { ask: "run", path, text, set, case: of, solver, care, update, sections }, shown(care, update, count, words));
}
function changed() {
  count++;
  clearTimeout(timer);
  // What takes long makes way for a new value.
  const goes = engine.goes(), most = { draft: PATIENCE, plain: WAY, errors: 0 }[goes?.kind] ?? Infinity;
  if (goes && goes.ms >= most) engine.stop();
  engine.drop("plain", "errors");
  run(frames.there() && !anew ? "draft" : "plain");
  command();
  clearTimeout(patience);
  patience = setTimeout(() => say("A long run goes on …"), PATIENCE);
  const errors = () => { anew = false; run("errors"); };
  timer = setTimeout(() => {
    if (exact !== count) run("plain");
    timer = setTimeout(errors, QUIET - STILL);
  }, STILL);
}
const look = () => engine.ask("look", { ask: "look", path: state.path, text: state.text, set: {} }, looked);

by("case").addEventListener("change", () => { state.case = by("case").value; changed(); });
by("solver").addEventListener("change", () => { state.solver = by("solver").value || null; changed(); });
by("back").addEventListener("click", () => {
  Object.assign(state, { text: data.text, set: {}, case: data.case, solver: data.solver });
  Object.assign(data.files, original);
  by("values").dataset.of = "";
  edit();
  engine.files();
  look();
  changed();
});
const tabs = [...document.querySelectorAll("[role=tab]")];
tabs.forEach((tab, i) => {
  tab.addEventListener("click", () => {
    for (const other of tabs) {
      other.setAttribute("aria-selected", other === tab);
      other.tabIndex = other === tab ? 0 : -1;
      by(other.getAttribute("aria-controls")).hidden = other !== tab;
    }
  });
  tab.addEventListener("keydown", ({ key }) => {
    const step = { ArrowLeft: -1, ArrowRight: 1 }[key];
    if (!step) return;
    const next = tabs.at((i + step) % tabs.length);
    next.focus();
    next.click();
  });
});
document.addEventListener("asked", ({ detail }) => { settle(detail); changed(); });

// The model and the files of its sections can be written in.
const original = { ...data.files };
const files = [data.path, ...Object.keys(data.files).filter((path) => path.endsWith(".ron"))];
options("which", files, data.path);
by("which").parentElement.hidden = files.length < 2;
const which = () => by("which").value;
const edit = () => { by("text").value = which() === data.path ? state.text : data.files[which()]; };
by("which").addEventListener("change", edit);
let typing;
by("text").addEventListener("input", () => {
  clearTimeout(typing);
  typing = setTimeout(() => {
    if (which() === data.path) state.text = by("text").value;
    else { data.files[which()] = by("text").value; engine.files(); }
    look();
    changed();
  }, 250);
});
by("save").addEventListener("click", () => {
  const link = document.createElement("a");
  link.href = URL.createObjectURL(new Blob([by("text").value], { type: "text/plain" }));
  link.download = which().split("/").at(-1);
  link.click();
  URL.revokeObjectURL(link.href);
});
edit();
look();
changed();
