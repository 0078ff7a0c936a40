// A page that follows its model: `report.html#watch` beside the script that `trilith watch` writes after every run.

/** Milliseconds between looks. */
const PATIENCE = 250;
const kept = `trilith ${location.pathname}`;

/** What a reader has chosen, to be found again. */
function keep() {
  const shared = [...groups].map(([name, { range, at }]) => ({ name, range, at }));
  const own = [...allCharts].filter((c) => c.box).map((c) => ({ title: c.drawing.title, box: c.box }));
  sessionStorage.setItem(kept, JSON.stringify({ shared, own, scroll: window.scrollY }));
}

function found() {
  const text = sessionStorage.getItem(kept);
  if (!text) return;
  sessionStorage.removeItem(kept);
  const { shared, own, scroll } = JSON.parse(text);
  for (const { name, range, at } of shared) {
    if (!groups.has(name)) continue;
    group(name).zoom(range);
    if (at !== null) group(name).read(at);
  }
  for (const { title, box } of own) {
    for (const chart of allCharts) if (chart.drawing.title === title) { chart.box = box; chart.dirty(); }
  }
  window.scrollTo(0, scroll);
}

/** Reads the script of the watch again and again: when the last run ended, ms since 1970, and what was wrong with it. */
function follow() {
  const folder = location.pathname.split("/").at(-2);
  const failure = make("pre", { class: "watched", role: "alert", hidden: true });
  document.body.prepend(failure);
  window.trilithWatch = (ended, wrong) => {
    failure.hidden = !wrong;
    failure.textContent = wrong ?? "";
    root.dataset.watched = String(ended);
    if (wrong || ended <= performance.timeOrigin) return;
    keep();
    location.reload();
  };
  const look = () => {
    const script = make("script", { src: `../${folder}.watch.js?${Date.now()}` });
    const again = () => { script.remove(); setTimeout(look, PATIENCE); };
    script.addEventListener("load", again);
    script.addEventListener("error", again);
    document.head.append(script);
  };
  look();
}

// From a folder alone: a page of the network loads nothing.
if (location.protocol === "file:" && (location.hash === "#watch" || sessionStorage.getItem(kept))) {
  window.addEventListener("load", () => { found(); follow(); });
}
