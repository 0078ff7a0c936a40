// A cursor over the runs of a study, for pages that compute: it is dragged, or put where one presses, or moved with arrows,
// and the page is told what the run there sets. Over two parameters it goes anywhere, elsewhere from run to run.

/** All cursors of the page. */
const cursors = [];

class Cursor {
  constructor(chart) {
    const [x, y] = chart.drawing.settings ?? [];
    Object.assign(this, { chart, free: x && y ? [x, y] : null, row: null, at: null });
    const dot = (r, more) => svg("circle", { r, ...more });
    this.cross = svg("path", { stroke: "#b3151b", fill: "none", "stroke-dasharray": "4 3", "pointer-events": "none" });
    this.knob = svg("g", { class: "ask", tabindex: "0", role: "slider", "aria-label": "run that is computed; arrows move it", "aria-valuenow": "0" },
      dot(22, { fill: "transparent" }), dot(8, { class: "ring", fill: "#ffffff", stroke: "#b3151b", "stroke-width": 2.5 }), dot(2, { fill: "#b3151b" }));
    chart.over = [this.cross, this.knob];
    // A picture has nothing in it that could be used.
    chart.area.setAttribute("role", "group");
    chart.drawn = () => this.put();
    cursors.push(this);
    this.listen();
  }

  listen() {
    const { chart, knob } = this, { area } = chart;
    const at = (e) => { const r = area.getBoundingClientRect(); return [e.clientX - r.left, e.clientY - r.top]; };
    let dragged = false, pressed = null;
    knob.addEventListener("pointerdown", (e) => { e.stopPropagation(); dragged = true; knob.setPointerCapture(e.pointerId); });
    knob.addEventListener("pointermove", (e) => { if (dragged) { e.stopPropagation(); this.go(at(e)); } });
    for (const end of ["pointerup", "pointercancel"]) knob.addEventListener(end, (e) => { e.stopPropagation(); dragged = false; });
    knob.addEventListener("dblclick", (e) => e.stopPropagation());
    knob.addEventListener("keydown", (e) => {
      const [dx, dy] = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1] }[e.key] ?? [0, 0];
      if (!dx && !dy) return;
      e.preventDefault();
      e.stopPropagation();
      const [px, py] = this.pixel();
      if (this.free) this.go([px + (e.shiftKey ? 20 : 4) * dx, py + (e.shiftKey ? 20 : 4) * dy]);
      else this.next(dx, dy);
    });
    area.addEventListener("pointerdown", (e) => { pressed = at(e); });
    area.addEventListener("pointerup", (e) => {
      const p = at(e);
      if (pressed && Math.hypot(p[0] - pressed[0], p[1] - pressed[1]) < 5) this.go(p);
      pressed = null;
    });
  }

  pixel() { return [this.chart.toX(this.at[0]), this.chart.toY(this.at[1])]; }

  put() {
    const { chart, at, cross, knob } = this;
    if (!at) return;
    const [x, y] = this.pixel(), { left, w, h } = chart.place, seen = chart.inside(x, y);
    for (const e of [cross, knob]) e.setAttribute("visibility", seen ? "visible" : "hidden");
    knob.setAttribute("transform", `translate(${x} ${y})`);
    cross.setAttribute("d", `M${left} ${y}h${w}M${x} ${EDGE.top}v${h}`);
    const words = [[chart.drawing.x.label, at[0]], [chart.drawing.y.label, at[1]]].map(([label, v]) => `${parted(label)[0]} ${number(v)}`);
    knob.setAttribute("aria-valuenow", String(at[0]));
    knob.setAttribute("aria-valuetext", words.join(", "));
  }

  /** All runs of the chart: [row, x, y]. */
  runs() {
    return this.chart.shown().flatMap((s) => (s.entries ? Array.from(s.entries, (row, i) => [row, s.x[i], s.y[i]]) : []));
  }

  /** To a pixel, or to the run that is closest to it. */
  go(p) {
    const { chart } = this, { left, w, h } = chart.place;
    let best = null;
    for (const [row, x, y] of this.runs()) {
      const d = Math.hypot(chart.toX(x) - p[0], chart.toY(y) - p[1]);
      if (d < (best?.d ?? Infinity)) best = { d, row, at: [x, y] };
    }
    if (!best) return;
    if (!this.free) { this.take(best.row, best.at); return; }
    const clamp = (v, low, high) => Math.min(Math.max(v, low), high);
    this.take(best.row, [chart.fromX(clamp(p[0], left, left + w)), chart.fromY(clamp(p[1], EDGE.top, EDGE.top + h))]);
  }

  /** To the closest run in a direction on the screen. */
  next(dx, dy) {
    const { chart } = this, [px, py] = this.pixel();
    let best = null;
    for (const [row, x, y] of this.runs()) {
      const [a, b] = [chart.toX(x) - px, chart.toY(y) - py], along = a * dx + b * dy, aside = Math.abs(a * dy - b * dx);
      if (row === this.row || along < 0.5) continue;
      const d = along + 3 * aside;
      if (d < (best?.d ?? Infinity)) best = { d, row, at: [x, y] };
    }
    if (best) this.take(best.row, best.at);
  }

  /** Asks for a run; cursors of other figures go to the one that is closest to it. */
  take(row, at) {
    if (this.row === row && this.at?.every((v, i) => v === at[i])) return;
    Object.assign(this, { row, at });
    this.put();
    for (const other of cursors) if (other !== this) other.follow(row);
    const set = Object.fromEntries(settings(row));
    this.free?.forEach(([name, unit], i) => { set[name] = `${Number(at[i].toPrecision(5))} ${unit}`.trim(); });
    document.dispatchEvent(new CustomEvent("asked", { detail: { set, row } }));
  }

  follow(row) {
    const there = this.runs().find((run) => run[0] === row);
    if (!there) return;
    Object.assign(this, { row, at: there.slice(1) });
    if (this.chart.place) this.put();
  }
}

// Once the charts are there: the first one asks for the run in its middle.
queueMicrotask(() => {
  if (!entries?.command) return;
  for (const chart of allCharts) if (chart.series.some((s) => s.entries)) new Cursor(chart);
  const first = cursors[0];
  if (!first) return;
  first.chart.draw();
  const { left, w, h } = first.chart.place;
  first.go([left + 0.5 * w, EDGE.top + 0.5 * h]);
});
