// The chart of all pages: takes the place of a still figure and draws the same, to be read, zoomed and switched.
// A figure has its drawing beside it as JSON (`script.drawing`); colours are those of the still figure, so one style
// sheet serves both, in light and in dark.

const EDGE = { top: 8, right: 14, bottom: 40 };
const SHAPES = {
  circle: "m-3.6 0a3.6 3.6 0 1 0 7.2 0a3.6 3.6 0 1 0 -7.2 0z", square: "m-3 -3h6v6h-6z", triangle: "m0 -4.2l3.9 7h-7.8z",
  diamond: "m0 -4.4l4.4 4.4l-4.4 4.4l-4.4 -4.4z", wedge: "m0 4.2l3.9 -7h-7.8z", cross: "m-3.5 -3.5l7 7m-7 0l7 -7",
};

/** What figures share by name: the part of their horizontal axis, and the place read; null: all, none. */
const groups = new Map();
function group(name) {
  if (name && groups.has(name)) return groups.get(name);
  const made = {
    charts: new Set(), range: null, at: null, listeners: [],
    zoom(range) { this.range = range; for (const chart of this.charts) chart.dirty(); },
    read(at) {
      if (at === this.at) return;
      this.at = at;
      for (const chart of this.charts) chart.cursor();
      for (const tell of this.listeners) tell(at);
    },
  };
  if (name) groups.set(name, made);
  return made;
}

/** All charts of the page. */
const allCharts = new Set();

/** Vertical scales that figures share by name, and whether they do now. */
const scales = new Map();
function scale(name) {
  if (!scales.has(name)) scales.set(name, { charts: new Set(), on: true });
  return scales.get(name);
}

/** Numbers of a drawing; NaN where there is none. Loops: a page that computes reads them all again for every run. */
function unpack(packed) {
  const all = Array.isArray(packed) ? packed : packed.n, out = new Float64Array(all.length);
  if (all === packed) for (let i = 0; i < all.length; i++) out[i] = all[i] ?? NaN;
  else {
    const { from, step } = packed;
    let at = 0;
    for (let i = 0; i < all.length; i++) {
      if (all[i] === null) { out[i] = NaN; continue; }
      at += all[i];
      out[i] = from + at * step;
    }
  }
  return out;
}

class Chart {
  constructor(host, drawing) {
    this.host = host;
    allCharts.add(this);
    Chart.of.set(host, this);
    this.read(drawing);
    this.group = group(drawing.shared);
    this.box = null;
    this.pinned = false;
    // What lies over the curves, and who puts it in its place whenever these are drawn.
    this.over = [];
    this.drawn = null;
    this.area = svg("svg", { role: "img", tabindex: "0" });
    this.title = make("div", { class: "title" });
    this.call();
    this.tip = make("div", { class: "tip", hidden: true });
    this.back = make("button", { type: "button", class: "reset", hidden: true }, "reset zoom");
    this.back.addEventListener("click", () => this.reset());
    this.view = make("div", { class: "view" }, this.area, this.back, this.tip);
    this.keys = this.legend();
    const live = make("div", { class: "chart" }, this.title, this.view, this.keys);
    this.stale = true;
    this.seen = false;
    this.group.charts.add(this);
    if (drawing.scale) scale(drawing.scale).charts.add(this);
    host.prepend(live);
    handle(this);
    this.watches = [
      new ResizeObserver(() => this.dirty()),
      new IntersectionObserver(([e]) => { this.seen = e.isIntersecting; if (this.seen && this.stale) this.draw(); }, { rootMargin: "400px" }),
    ];
    for (const watch of this.watches) watch.observe(this.view);
  }

  /** Its figure goes. */
  leave() {
    for (const watch of this.watches) watch.disconnect();
    for (const set of [allCharts, this.group.charts, ...[...scales.values()].map((s) => s.charts)]) set.delete(this);
    Chart.of.delete(this.host);
  }

  /** Curves of a drawing; those that were hidden stay so. */
  read(drawing) {
    const off = new Set(this.series?.filter((s) => !s.on).map((s) => s.name));
    this.drawing = drawing;
    this.all = null;
    this.series = drawing.series.map((s) => {
      const [x, y] = [unpack(s.px), unpack(s.py)];
      return { ...s, x, y, times: s.times && unpack(s.times), rising: !s.area && !s.mark && rises(x), on: !off.has(s.name) };
    });
  }

  /** Its name, seen and heard. */
  call() {
    const { title, x, y } = this.drawing;
    this.title.textContent = title;
    this.area.setAttribute("aria-label", `${title}: ${y.label} over ${x.label}`);
  }

  /** The same figure with other curves. */
  renew(drawing) {
    if (drawing.scale !== this.drawing.scale) {
      if (this.drawing.scale) scale(this.drawing.scale).charts.delete(this);
      if (drawing.scale) scale(drawing.scale).charts.add(this);
    }
    const names = () => JSON.stringify(this.series.map((s) => [s.name, s.color, s.dash, s.mark]));
    const before = names();
    this.read(drawing);
    this.call();
    if (names() !== before) { const keys = this.legend(); this.keys.replaceWith(keys); this.keys = keys; }
    this.tip.hidden = true;
    this.pinned = false;
    this.dirty();
  }

  dirty() { this.stale = true; if (this.seen) this.draw(); }

  legend() {
    const keys = this.series.filter((s) => s.name).map((s) => {
      const key = make("button", { type: "button", "aria-pressed": String(s.on), title: "show or hide; with Shift: this one alone" }, sample(s), s.name);
      key.addEventListener("click", (e) => {
        const alone = e.shiftKey;
        for (const [other, button] of keys.pairs) {
          if (alone) other.on = other === s; else if (other === s) other.on = !other.on;
          button.setAttribute("aria-pressed", String(other.on));
        }
        // Bounds without a name go with the series of their colour.
        for (const other of this.series) if (!other.name) other.on = this.series.some((o) => o.name && o.on && o.color === other.color) || !this.series.some((o) => o.name && o.color === other.color);
        this.dirty();
      });
      return key;
    });
    keys.pairs = this.series.filter((s) => s.name).map((s, i) => [s, keys[i]]);
    return make("div", { class: "legend", hidden: !keys.length }, ...keys);
  }

  shown() { return this.series.filter((s) => s.on); }

  /** Ends of the horizontal axis of all data. */
  whole() { return this.all ??= ends(this.drawing.x, extremes(...this.series.map((s) => s.x)), Boolean(this.drawing.shared)); }

  /** Smallest and largest value of what is shown over a part of the horizontal axis. */
  reach([from, to]) {
    let [low, high] = [Infinity, -Infinity];
    for (const s of this.shown()) {
      // Of lines also what lies just outside: it is seen on the way in.
      const [i, j] = s.rising ? [before(s.x, from), Math.min(before(s.x, to) + 2, s.x.length)] : [0, s.x.length];
      for (let k = i; k < j; k++) {
        if (this.drawing.y.log && !(s.y[k] > 0)) continue;
        if (s.y[k] < low) low = s.y[k];
        if (s.y[k] > high) high = s.y[k];
      }
    }
    for (const [i, x, y] of this.drawing.peaks ?? []) {
      if (this.series[i].on && x >= from && x <= to) [low, high] = [Math.min(low, y), Math.max(high, y)];
    }
    return [low, high];
  }

  /** The ranges of both axes. */
  ranges(w, h) {
    const { x, y } = this.drawing;
    if (this.box && !this.drawing.shared) return this.box;
    const along = this.group.range ?? this.whole();
    if (y.range && !this.group.range) return { x: along, y: y.range };
    const common = this.drawing.scale && scale(this.drawing.scale).on ? [...scale(this.drawing.scale).charts] : [this];
    const up = ends(y, extremes(common.flatMap((c) => c.reach(along))));
    if (!y.log && common.some((c) => c.drawing.peaks)) {
      // Values stand above what they mark: there are 20 pixels for them, however low the figure is.
      const room = Math.max(0.06, (20 / h - 0.054) / (1 - 40 / h)) * (up[1] - up[0]);
      [up[0], up[1]] = [up[0] - room, up[1] + room];
    }
    return this.drawing.equal ? square(along, up, w, h) : { x: along, y: up };
  }

  draw() {
    const width = this.view.clientWidth;
    if (width < 60) return;
    this.stale = false;
    const [dw, dh] = this.drawing.size;
    const height = Math.round(Math.min(Math.max((width * dh) / dw, 210), dh * 1.1, 560));
    const h = height - EDGE.top - EDGE.bottom;
    let range = this.ranges(width - 70, h);
    const axisY = () => ticks(this.drawing.y, range.y, Math.floor(h / 34));
    const left = 26 + 7.6 * Math.max(2, ...axisY().map((t) => t[1].length));
    const w = width - left - EDGE.right;
    if (this.drawing.equal) range = this.ranges(w, h);
    Object.assign(this, { range, place: { left, w, h, width, height } });
    const [px, py] = [placer(this.drawing.x, range.x, left, w), placer(this.drawing.y, range.y, EDGE.top + h, -h)];
    Object.assign(this, { toX: px.to, fromX: px.from, toY: py.to, fromY: py.from });
    const id = (this.clip ??= `clip${(Chart.count = (Chart.count ?? 0) + 1)}`);
    // A mark on the frame is whole, as on the still figure.
    const plot = this.shown().map((s) => svg("g", s.mark ? {} : { "clip-path": `url(#${id})` }, ...this.curve(s)));
    this.marker = svg("g", { "pointer-events": "none" });
    this.area.setAttribute("viewBox", `0 0 ${width} ${height}`);
    this.area.setAttribute("height", height);
    this.area.replaceChildren(
      svg("clipPath", { id }, svg("rect", { x: left, y: EDGE.top - 1, width: w, height: h + 2 })),
      svg("rect", { width, height, fill: "#ffffff" }), ...this.axes(axisY()), ...plot, ...this.peaks(), this.marker, ...this.over);
    this.back.hidden = !(this.box || this.group.range);
    this.cursor();
    this.drawn?.();
  }

  axes(alongY) {
    const { left, w, h, width, height } = this.place, bottom = EDGE.top + h, text = { fill: "#3c3c3c" };
    const out = [];
    let grid = "";
    for (const [x, label] of ticks(this.drawing.x, this.range.x, Math.floor(w / 70))) {
      const p = this.toX(x).toFixed(1);
      grid += `M${p} ${EDGE.top}v${h}`;
      out.push(svg("text", { ...text, x: p, y: bottom + 15, "text-anchor": "middle", "data-tick": this.drawing.x.whole ? "" : "x" }, label));
    }
    for (const [y, label] of alongY) {
      const p = this.toY(y);
      grid += `M${left} ${p.toFixed(1)}h${w}`;
      out.push(svg("text", { ...text, x: left - 6, y: p + 4, "text-anchor": "end", "data-tick": this.drawing.y.whole ? "" : "y" }, label));
    }
    // About the middle of its axis a label has this room on both sides, up to the edge of the sheet.
    const fit = (label, room) => (label.length * 6.6 > room ? { textLength: room, lengthAdjust: "spacingAndGlyphs" } : {});
    return [
      svg("path", { d: grid, stroke: "#e1e1e1", fill: "none" }), ...out,
      svg("text", { ...text, x: left + w / 2, y: height - 6, "text-anchor": "middle", ...fit(this.drawing.x.label, width - 8) }, this.drawing.x.label),
      svg("text", { ...text, transform: `translate(12 ${EDGE.top + h / 2}) rotate(-90)`, "text-anchor": "middle", ...fit(this.drawing.y.label, h + 2 * EDGE.top - 4) }, this.drawing.y.label),
      svg("path", { d: `M${left} ${EDGE.top}v${h}h${w}`, stroke: "#8c8c8c", fill: "none" }),
    ];
  }

  /** The elements of a series. */
  curve(s) {
    if (s.mark) {
      let d = "";
      for (let i = 0; i < s.x.length; i++) {
        const [x, y] = [this.toX(s.x[i]), this.toY(s.y[i])];
        if (this.inside(x, y)) d += `M${x.toFixed(1)} ${y.toFixed(1)}${SHAPES[s.mark]}`;
      }
      return [svg("path", { d, ...ink(s) })];
    }
    const d = this.line(s);
    return [svg("path", { d: s.area ? `${d}Z` : d, ...ink(s) })];
  }

  inside(x, y, room = 0.5) {
    const { left, w, h } = this.place;
    return x >= left - room && x <= left + w + room && y >= EDGE.top - room && y <= EDGE.top + h + room;
  }

  /** The path of a line: of many points in one column of pixels the first, the last and the extremes. */
  line(s) {
    const { left, w } = this.place;
    const [from, to] = s.rising ? [before(s.x, this.fromX(left)), Math.min(before(s.x, this.fromX(left + w)) + 2, s.x.length)] : [0, s.x.length];
    const close = s.rising && to - from > 3 * w;
    let d = "", pen = "M", column = null;
    const go = (x, y) => { d += `${pen}${x.toFixed(1)} ${Math.min(Math.max(y, -1e4), 1e4).toFixed(1)}`; pen = "L"; };
    const leave = () => { if (column) for (const y of [column.low, column.high, column.last]) go(column.x, y); column = null; };
    for (let i = from; i < to; i++) {
      const [x, y] = [this.toX(s.x[i]), this.toY(s.y[i])];
      if (!Number.isFinite(x) || !Number.isFinite(y)) { leave(); pen = "M"; continue; }
      if (!close) { go(Math.min(Math.max(x, -1e4), 1e4), y); continue; }
      if (column && Math.round(x) === column.x) {
        column.low = Math.min(column.low, y); column.high = Math.max(column.high, y); column.last = y;
      } else { leave(); go(x, y); column = { x: Math.round(x), low: y, high: y, last: y }; }
    }
    leave();
    return d;
  }

  /** Largest values, marked. */
  peaks() {
    const { left, w, h } = this.place;
    return (this.drawing.peaks ?? []).filter(([i]) => this.series[i].on).flatMap(([, x, y]) => {
      const [px, py] = [this.toX(x), this.toY(y)];
      if (!this.inside(px, py)) return [];
      const up = y >= 0;
      let text = up ? py - 8 : py + 17;
      if (text < EDGE.top + 10) text = py + 17; else if (text > EDGE.top + h - 3) text = py - 8;
      const anchor = px > left + 0.75 * w ? "end" : px < left + 0.25 * w ? "start" : "middle";
      return [
        svg("path", { d: `M${px} ${py}l-4 ${up ? -5 : 5}h8Z`, fill: "#1e1e1e" }),
        svg("text", { x: px, y: text, "text-anchor": anchor, fill: "#3c3c3c", "paint-order": "stroke", stroke: "#ffffff", "stroke-width": 3, "font-size": 11 }, number(y)),
      ];
    });
  }

  /** The place read in all figures that share it: a line with dots, or the moment on a path. */
  cursor() {
    if (this.stale || !this.marker) return;
    const at = this.group.at, out = [];
    if (at !== null && this.drawing.shared) {
      const x = this.toX(at);
      if (this.inside(x, EDGE.top + 1)) {
        out.push(svg("path", { d: `M${x} ${EDGE.top}v${this.place.h}`, stroke: "#b3151b" }));
        for (const s of this.shown()) if (s.rising) out.push(...this.dot(x, this.toY(valueAt(s.x, s.y, at)), s.color));
      }
    }
    const moment = groups.get("time")?.at ?? null;
    if (moment !== null) for (const s of this.shown()) {
      if (s.times) out.push(...this.dot(this.toX(valueAt(s.times, s.x, moment)), this.toY(valueAt(s.times, s.y, moment)), "#b3151b"));
    }
    this.marker.replaceChildren(...out);
  }

  dot(cx, cy, fill) { return this.inside(cx, cy) ? [svg("circle", { cx, cy, r: 3.5, fill, stroke: "#ffffff" })] : []; }

  zoom(box) {
    const [from, to] = box.x, whole = this.whole();
    if (!(to > from)) return;
    if (!this.drawing.shared) { this.box = box; this.dirty(); return; }
    // A part of the axis, no longer than all of it.
    if (to - from >= whole[1] - whole[0]) { this.group.zoom(null); return; }
    const shift = Math.max(whole[0] - from, 0) || Math.min(whole[1] - to, 0);
    this.group.zoom([from + shift, to + shift]);
  }

  /** Closer by a factor below 1 about a pixel, on both axes or as many as there are to zoom. */
  zoomBy(factor, [px, py]) {
    const about = (axis, range, v) => (axis.log ? range.map((e) => v * (e / v) ** factor) : range.map((e) => v + factor * (e - v)));
    this.zoom({ x: about(this.drawing.x, this.range.x, this.fromX(px)), y: about(this.drawing.y, this.range.y, this.fromY(py)) });
  }

  /** What was at one pixel comes to another. */
  pan([ax, ay], [bx, by]) {
    const move = (axis, range, a, b) => (axis.log ? range.map((e) => (e * a) / b) : range.map((e) => e + a - b));
    this.zoom({
      x: move(this.drawing.x, this.range.x, this.fromX(ax), this.fromX(bx)),
      y: move(this.drawing.y, this.range.y, this.fromY(ay), this.fromY(by)),
    });
  }

  reset() { this.box = null; if (this.drawing.shared) this.group.zoom(null); else this.dirty(); }
}

/** Charts by the figure that they stand in. */
Chart.of = new Map();

/** How a series is inked. */
function ink(s) {
  if (s.area) return { fill: s.color, "fill-opacity": 0.85, stroke: "#ffffff", "stroke-width": 0.7 };
  if (s.filled) return { fill: s.color };
  const dash = s.dash ? { "stroke-dasharray": s.dash } : {};
  return { fill: "none", stroke: s.color, "stroke-width": s.width ?? 1.7, "stroke-linejoin": "round", ...dash };
}

/** A piece of a series for the legend. */
function sample(s) {
  const d = s.mark ? `M14 6${SHAPES[s.mark]}` : s.area ? "M4 0h20v12h-20Z" : "M0 6h28";
  return svg("svg", { width: 28, height: 12, viewBox: "0 0 28 12", "aria-hidden": "true" }, svg("path", { d, ...ink(s) }));
}
