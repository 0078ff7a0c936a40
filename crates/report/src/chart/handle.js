// What a reader does with a chart: point, drag, pinch, keys. One finger up or down scrolls the page as elsewhere.

/** So many lines are told at one place. */
const LISTED = 14;

/** Rows of the page that points stand for. */
const entries = (() => {
  const script = document.getElementById("entries");
  return script ? JSON.parse(script.textContent) : null;
})();

/** A quantity of an axis without its unit, and the unit. */
function parted(label) {
  const found = /^(.*?)\s*\[([^\]]*)\]\s*$/.exec(label);
  return found ? [found[1], found[2]] : [label, ""];
}

function handle(chart) {
  const { area, tip } = chart;
  const pointers = new Map();
  let start = null, spread = null, moved = false;
  const at = (e) => {
    const r = area.getBoundingClientRect();
    return [e.clientX - r.left, e.clientY - r.top];
  };
  area.addEventListener("pointerdown", (e) => {
    if (e.button) return;
    pointers.set(e.pointerId, at(e));
    moved = false;
    if (pointers.size === 2) { start = null; spread = pinch(); return; }
    start = at(e);
    if (e.pointerType === "mouse") area.setPointerCapture(e.pointerId);
  });
  /** Distance and middle of two fingers. */
  const pinch = () => {
    const [a, b] = [...pointers.values()];
    return { size: Math.max(Math.hypot(a[0] - b[0], a[1] - b[1]), 20), middle: [(a[0] + b[0]) / 2, (a[1] + b[1]) / 2] };
  };
  area.addEventListener("pointermove", (e) => {
    const p = at(e);
    if (pointers.has(e.pointerId)) pointers.set(e.pointerId, p);
    if (pointers.size === 2 && spread) {
      const now = pinch();
      chart.pan(spread.middle, now.middle);
      chart.zoomBy(spread.size / now.size, now.middle);
      spread = now;
      return;
    }
    if (start && Math.hypot(p[0] - start[0], p[1] - start[1]) > 5) moved = true;
    if (start && moved && e.pointerType === "mouse") {
      if (e.shiftKey) { chart.pan(start, p); start = p; } else lasso(chart, start, p);
    } else if (!chart.pinned) point(chart, p, e.pointerType !== "mouse");
  });
  const end = (e) => {
    const p = at(e), here = start;
    pointers.delete(e.pointerId);
    start = null;
    spread = null;
    if (!here || e.type === "pointercancel") { chart.cursor(); return; }
    if (moved && e.pointerType === "mouse" && !e.shiftKey) {
      const { x, y } = boxed(chart, here, p);
      if (Math.abs(here[0] - p[0]) > 5) chart.zoom({ x: [x[0], x[1]].map(chart.fromX), y: [y[1], y[0]].map(chart.fromY) });
      else chart.cursor();
    } else if (!moved) {
      // A press puts the cursor of such a chart there: what is told would hide it.
      if (chart.over.length) { tip.hidden = true; return; }
      chart.pinned = false;
      chart.pinned = point(chart, p, true);
    }
  };
  area.addEventListener("pointerup", end);
  area.addEventListener("pointercancel", end);
  area.addEventListener("pointerleave", () => { if (!chart.pinned) tip.hidden = true; });
  area.addEventListener("dblclick", () => chart.reset());
  // The wheel scrolls the page; over a chart in use (focused), or with Ctrl, it zooms.
  area.addEventListener("wheel", (e) => {
    if (!e.ctrlKey && !e.metaKey && document.activeElement !== area) return;
    e.preventDefault();
    chart.zoomBy(Math.exp(e.deltaY / 300), at(e));
  }, { passive: false });
  area.addEventListener("keydown", (e) => {
    const { left, w, h } = chart.place, middle = [left + w / 2, EDGE.top + h / 2];
    const read = (by) => {
      if (!chart.drawing.shared) return;
      const [from, to] = chart.range.x, step = (to - from) / 200;
      chart.group.read(Math.min(Math.max((chart.group.at ?? from) + by * step, from), to));
    };
    const keys = {
      ArrowLeft: () => read(-1), ArrowRight: () => read(1), "+": () => chart.zoomBy(0.8, middle),
      "-": () => chart.zoomBy(1.25, middle), 0: () => chart.reset(), Escape: () => { chart.pinned = false; tip.hidden = true; },
    };
    if (e.key in keys) { keys[e.key](); e.preventDefault(); }
  });
}

/** Two corners as ends of both axes, px; of charts over a shared axis the whole height. */
function boxed(chart, a, b) {
  const { left, w, h } = chart.place;
  const clamp = (v, low, high) => Math.min(Math.max(v, low), high);
  const sorted = (p, q) => (p < q ? [p, q] : [q, p]);
  const tall = chart.drawing.shared || Math.abs(a[1] - b[1]) < 8;
  return {
    x: sorted(...[a[0], b[0]].map((x) => clamp(x, left, left + w))),
    y: tall ? [EDGE.top, EDGE.top + h] : sorted(...[a[1], b[1]].map((y) => clamp(y, EDGE.top, EDGE.top + h))),
  };
}

function lasso(chart, a, b) {
  const { x, y } = boxed(chart, a, b);
  chart.marker.replaceChildren(svg("rect", {
    x: x[0], y: y[0], width: x[1] - x[0], height: y[1] - y[0], fill: "#0072b2", "fill-opacity": 0.15, stroke: "#0072b2",
  }));
}

/** Tells what is at a pixel; true where it stays until the next click. */
function point(chart, p, press) {
  // It is not drawn yet.
  if (!chart.place) return false;
  const near = nearest(chart, p, press ? 26 : 14);
  // What is pressed stays, with all there is to do with it.
  const kept = Boolean(press && near?.s.entries);
  chart.tip.classList.toggle("kept", kept);
  if (near) {
    tell(chart, near.p, mark(chart, near));
    return kept;
  }
  const lines = chart.shown().filter((s) => (s.rising || s.area) && s.x.length);
  const inside = chart.inside(...p);
  chart.cursor();
  if (!inside) { chart.tip.hidden = true; return false; }
  if (!lines.length) {
    // Beside a path the place itself.
    const row = (label, v) => { const [name, unit] = parted(label); return [null, name, number(v), unit]; };
    tell(chart, p, [table([row(chart.drawing.x.label, chart.fromX(p[0])), row(chart.drawing.y.label, chart.fromY(p[1]))])]);
    return false;
  }
  const [from, to] = extremes(...lines.map((s) => s.x));
  const x = Math.min(Math.max(chart.fromX(p[0]), from), to);
  if (chart.drawing.shared) chart.group.read(x);
  const [name, unit] = parted(chart.drawing.x.label), [, up] = parted(chart.drawing.y.label);
  const there = lines.filter((s) => s.area || (x >= s.x[0] && x <= s.x.at(-1)));
  const rows = there.slice(0, LISTED).map((s) => [s, s.name ?? "", number(height(s, x)), up]);
  if (!chart.drawing.shared) {
    chart.marker.replaceChildren(svg("path", { d: `M${chart.toX(x)} ${EDGE.top}v${chart.place.h}`, stroke: "#8c8c8c" }),
      ...lines.filter((s) => s.rising).flatMap((s) => chart.dot(chart.toX(x), chart.toY(valueAt(s.x, s.y, x)), s.color)));
  }
  tell(chart, p, [head(`${name} ${number(x)} ${unit}`), table(rows)]);
  return false;
}

/** The value of a line at a place; of an area between its edges, whose lower one runs back. */
function height(s, x) {
  if (!s.area) return valueAt(s.x, s.y, x);
  const n = s.x.length >> 1;
  const back = (values) => values.slice(n).reverse();
  return valueAt(s.x.slice(0, n), s.y.slice(0, n), x) - valueAt(back(s.x), back(s.y), x);
}

/** The mark, or the point of a path, that is closest within some pixels. */
function nearest(chart, [px, py], room) {
  let best = null;
  for (const s of chart.shown()) {
    if (s.area || s.rising) continue;
    for (let i = 0; i < s.x.length; i++) {
      const [x, y] = [chart.toX(s.x[i]), chart.toY(s.y[i])];
      const d = Math.hypot(x - px, y - py);
      if (d < (best?.d ?? room) && chart.inside(x, y, 4)) best = { d, s, i, p: [x, y] };
    }
  }
  return best;
}

/** What is told of a point. */
function mark(chart, { s, i, p }) {
  const rows = [[chart.drawing.x.label, s.x[i]], [chart.drawing.y.label, s.y[i]]].map(([label, v]) => {
    const [name, unit] = parted(label);
    return [null, name, number(v), unit];
  });
  chart.marker.replaceChildren(svg("circle", { cx: p[0], cy: p[1], r: 7, fill: "none", stroke: "#b3151b", "stroke-width": 1.6 }));
  if (s.times) {
    rows.push([null, "time", number(s.times[i]), "s"]);
    group("time").read(s.times[i]);
  }
  const out = [s.name ? head(s.name, s) : "", table(rows)];
  if (s.entries && entries) out.push(...entry(s.entries[i]));
  return out;
}

/** The row of the page that a point stands for: its cells, its link, or the command that makes it. */
function entry(row) {
  const { name, head: heads, count, cells, links, command } = entries;
  if (!(row < count)) return [];
  const shown = heads.map(([what, unit], k) => [null, what, textOf(cells[k], row), unit]).filter((r) => r[2] !== "");
  const out = [head(`${name} ${row + 1}`), table(shown)];
  // Links are relative to the page; nothing else is followed.
  if (links?.[row] && !/^[a-z][a-z0-9+.-]*:/i.test(links[row])) out.push(make("a", { href: links[row] }, "open its folder"));
  if (command) {
    const sets = settings(row).map(([n, v]) => ` --set ${quoted(`${n}=${v}`)}`);
    const text = command + sets.join(""), copy = make("button", { type: "button" }, "copy");
    copy.addEventListener("click", () => navigator.clipboard?.writeText(text).then(() => { copy.textContent = "copied"; }, () => {}));
    out.push(make("code", {}, text), copy);
  }
  return out;
}

/** What a row sets: pairs of name and value. */
const settings = (row) => [...(entries.common ?? []), ...(entries.names?.map((n, i) => [n, textOf((entries.values ?? entries.cells)[i], row)]) ?? entries.sets?.[row] ?? [])];

/** What a row has in a column, which tells each of its texts once. */
const textOf = ({ of, at }, row) => of[at ? at[row] : of.length > 1 ? row : 0];

/** A word of a command line as a shell takes it. */
const quoted = (word) => (/^[\p{L}\p{N}\-_=./,:+%@]+$/u.test(word) ? word : `'${word.replaceAll("'", "'\\''")}'`);

const head = (words, s) => make("b", {}, ...(s ? [sample(s)] : []), words);

/** Rows of a tip: sample, name, value, unit. */
function table(rows) {
  return make("table", {}, ...rows.map(([s, name, value, unit]) =>
    make("tr", {}, make("td", {}, ...(s ? [sample(s)] : []), name), make("td", { class: "num" }, `${value} ${unit}`.trim()))));
}

function tell(chart, p, parts) {
  const { tip } = chart, { width, height } = chart.place;
  tip.replaceChildren(...parts);
  tip.hidden = false;
  const left = p[0] + 14 + tip.offsetWidth > width ? p[0] - 14 - tip.offsetWidth : p[0] + 14;
  tip.style.left = `${Math.max(Math.min(left, width - tip.offsetWidth), 0)}px`;
  tip.style.top = `${Math.max(Math.min(p[1] - 20, height - tip.offsetHeight - 4), 0)}px`;
}
