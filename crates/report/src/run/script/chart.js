// A diagram on a canvas: lines or stacked areas, zoom, pan, crosshair at the shared time.

const FONT = "12px system-ui, sans-serif";
const EDGE = { left: 64, right: 14, top: 26, bottom: 40 };

class Chart {
  /**
   * options: title, x and y (names of the axes), height, timed (x is the shared time), series: [{name, color, x, y,
   * low (areas: the lower edge), dash, times (loops: the time of every point)}]; log: x logarithmic, of curves that
   * are functions of it.
   */
  constructor(host, options) {
    Object.assign(this, options);
    this.host = host;
    this.hidden = new Set();
    this.box = null;
    this.canvas = make("canvas", { tabindex: "0", role: "img", "aria-label": `${this.title}, ${this.y} over ${this.x}` });
    this.tip = make("div", { class: "tip", hidden: true });
    host.append(this.canvas, this.tip);
    if (this.series.length > 1) host.append(this.legend());
    this.listen();
    clock.listeners.push(() => this.cursor());
    if (this.timed) span.listeners.push(() => this.draw());
    new ResizeObserver(() => this.draw()).observe(this.canvas.parentElement);
    this.draw();
  }

  legend() {
    const keys = this.series.map((s) => {
      const mark = make("i", { style: `background:${s.color}` });
      const key = make("button", { type: "button", "aria-pressed": "true" }, mark, s.name);
      key.addEventListener("click", () => {
        if (!this.hidden.delete(s)) this.hidden.add(s);
        key.setAttribute("aria-pressed", String(!this.hidden.has(s)));
        this.draw();
      });
      return key;
    });
    return make("div", { class: "legend" }, ...keys);
  }

  shown() { return this.series.filter((s) => !this.hidden.has(s)); }

  /** The ranges of both axes. */
  ranges() {
    const all = this.shown();
    const whole = () => extremes(...this.series.map((s) => s.x));
    if (!this.timed) {
      return this.box ?? { x: this.log ? whole() : roomy(whole()), y: roomy(extremes(...all.map((s) => s.y))) };
    }
    const x = span.range ?? whole();
    const parts = all.flatMap((s) => {
      const [from, to] = [before(s.x, x[0]), before(s.x, x[1]) + 2];
      return [s.y, s.low].filter(Boolean).map((y) => y.subarray(from, to));
    });
    return { x, y: roomy(extremes(...parts)) };
  }

  draw() {
    const width = this.canvas.parentElement.clientWidth;
    if (width < 50) return;
    const c = sharpen(this.canvas, width, this.height);
    this.size = [width, this.height];
    this.range = this.ranges();
    const { x, y } = this.range;
    const [w, h] = [width - EDGE.left - EDGE.right, this.height - EDGE.top - EDGE.bottom];
    // Where a value stands along the axis, and back.
    const [place, value] = this.log ? [Math.log10, (p) => 10 ** p] : [(v) => v, (p) => p];
    const [x0, x1] = x.map(place);
    this.toX = (v) => EDGE.left + ((place(v) - x0) / (x1 - x0)) * w;
    this.toY = (v) => EDGE.top + h - ((v - y[0]) / (y[1] - y[0])) * h;
    this.fromX = (p) => value(x0 + ((p - EDGE.left) / w) * (x1 - x0));
    this.fromY = (p) => y[0] + ((EDGE.top + h - p) / h) * (y[1] - y[0]);
    c.fillStyle = "#fff";
    c.fillRect(0, 0, width, this.height);
    this.grid(c, w, h);
    c.save();
    c.beginPath();
    c.rect(EDGE.left, EDGE.top, w, h);
    c.clip();
    for (const s of this.shown()) this.curve(c, s);
    c.restore();
    this.still = document.createElement("canvas");
    [this.still.width, this.still.height] = [this.canvas.width, this.canvas.height];
    this.still.getContext("2d").drawImage(this.canvas, 0, 0);
    this.cursor();
  }

  grid(c, w, h) {
    const { x, y } = this.range;
    c.font = FONT;
    c.lineWidth = 1;
    const [alongX, alongY] = [
      this.log ? decades(x, w) : ticks(x, Math.max(w / 70, 3)), ticks(y, Math.max(h / 34, 2)),
    ];
    c.textBaseline = "top";
    c.textAlign = "center";
    for (const v of alongX.values) {
      const p = Math.round(this.toX(v)) + 0.5;
      stroke(c, [[p, EDGE.top], [p, EDGE.top + h]], v === 0 ? "#999" : "#e4e4e4");
      c.fillStyle = "#444";
      c.fillText(alongX.write(v), p, EDGE.top + h + 6);
    }
    c.textBaseline = "middle";
    c.textAlign = "right";
    for (const v of alongY.values) {
      const p = Math.round(this.toY(v)) + 0.5;
      stroke(c, [[EDGE.left, p], [EDGE.left + w, p]], v === 0 ? "#999" : "#e4e4e4");
      c.fillStyle = "#444";
      c.fillText(alongY.write(v), EDGE.left - 6, p);
    }
    c.textAlign = "center";
    c.fillText(this.x, EDGE.left + w / 2, this.height - 9);
    c.save();
    c.translate(11, EDGE.top + h / 2);
    c.rotate(-Math.PI / 2);
    c.fillText(this.y, 0, 0);
    c.restore();
    c.font = `600 13px system-ui, sans-serif`;
    c.fillStyle = "#222";
    c.fillText(this.title, EDGE.left + w / 2, 13);
  }

  curve(c, s) {
    c.beginPath();
    for (let i = 0; i < s.x.length; i++) c.lineTo(this.toX(s.x[i]), this.toY(s.y[i]));
    if (s.low) {
      for (let i = s.x.length - 1; i >= 0; i--) c.lineTo(this.toX(s.x[i]), this.toY(s.low[i]));
      c.globalAlpha = 0.85;
      c.fillStyle = s.color;
      c.fill();
      c.globalAlpha = 1;
      return;
    }
    c.strokeStyle = s.color;
    c.lineWidth = 1.6;
    c.lineJoin = "round";
    c.setLineDash(s.dash ?? []);
    c.stroke();
    c.setLineDash([]);
  }

  /** The moment of the clock over the still picture. */
  cursor() {
    if (!this.still) return;
    const c = this.canvas.getContext("2d");
    c.save();
    c.setTransform(1, 0, 0, 1, 0, 0);
    c.drawImage(this.still, 0, 0);
    c.restore();
    const t = clock.t;
    if (t === null) return;
    if (this.timed) {
      const p = this.toX(t);
      if (p < EDGE.left || p > this.size[0] - EDGE.right) return;
      stroke(c, [[p, EDGE.top], [p, this.height - EDGE.bottom]], "#b3151b");
      for (const s of this.shown().filter((s) => !s.low)) dot(c, p, this.toY(valueAt(s.x, s.y, t)), s.color);
    } else {
      for (const s of this.shown().filter((s) => s.times)) {
        dot(c, this.toX(valueAt(s.times, s.x, t)), this.toY(valueAt(s.times, s.y, t)), "#b3151b");
      }
    }
  }

  listen() {
    const canvas = this.canvas;
    let start = null;
    const at = (e) => {
      const r = canvas.getBoundingClientRect();
      return [e.clientX - r.left, e.clientY - r.top];
    };
    canvas.addEventListener("pointerdown", (e) => {
      start = at(e);
      canvas.setPointerCapture(e.pointerId);
    });
    canvas.addEventListener("pointermove", (e) => {
      const p = at(e);
      if (start && e.shiftKey) { this.pan(start, p); start = p; }
      else if (start) this.mark(start, p);
      else this.hover(p);
    });
    canvas.addEventListener("pointerup", (e) => {
      if (start && !e.shiftKey) this.zoomTo(start, at(e));
      start = null;
    });
    canvas.addEventListener("pointerleave", () => { this.tip.hidden = true; });
    canvas.addEventListener("dblclick", () => this.reset());
    canvas.addEventListener("wheel", (e) => {
      if (!e.ctrlKey && !e.metaKey) return;
      e.preventDefault();
      this.zoomBy(Math.exp(e.deltaY / 300), at(e));
    }, { passive: false });
    canvas.addEventListener("keydown", (e) => {
      const { x } = this.range;
      const middle = [this.size[0] / 2, this.size[1] / 2];
      const keys = {
        ArrowLeft: () => this.timed && clock.set(Math.max((clock.t ?? x[0]) - (x[1] - x[0]) / 200, x[0])),
        ArrowRight: () => this.timed && clock.set(Math.min((clock.t ?? x[0]) + (x[1] - x[0]) / 200, x[1])),
        "+": () => this.zoomBy(0.8, middle),
        "-": () => this.zoomBy(1.25, middle),
        0: () => this.reset(),
      };
      if (e.key in keys) { keys[e.key](); e.preventDefault(); }
    });
  }

  hover(p) {
    let text = `${number(this.fromX(p[0]))}, ${number(this.fromY(p[1]))}`;
    if (this.timed) {
      const [from, to] = extremes(this.series[0].x);
      const t = Math.min(Math.max(this.fromX(p[0]), from), to);
      clock.set(t);
      const values = this.shown().map((s) => {
        const value = valueAt(s.x, s.y, t) - (s.low ? valueAt(s.x, s.low, t) : 0);
        return (this.series.length > 1 ? `${s.name} ` : "") + number(value);
      });
      text = `${number(t)} s: ${values.join(" · ")}`;
    }
    if (this.log) {
      const [from, to] = extremes(...this.series.map((s) => s.x));
      const x = Math.min(Math.max(this.fromX(p[0]), from), to);
      const values = this.shown().map((s) =>
        (this.series.length > 1 ? `${s.name} ` : "") + number(valueAt(s.x, s.y, x)));
      text = `${number(x)} s: ${values.join(" · ")}`;
    }
    this.tip.textContent = text;
    this.tip.hidden = false;
    const left = Math.min(p[0] + 12, this.size[0] - this.tip.offsetWidth - 2);
    this.tip.style.left = `${Math.max(left, 0)}px`;
    this.tip.style.top = `${Math.max(p[1] - 26, 0)}px`;
  }

  /** The box that is being drawn. */
  mark(a, b) {
    this.cursor();
    const c = this.canvas.getContext("2d");
    c.fillStyle = "#0072b222";
    const [top, height] = this.timed
      ? [EDGE.top, this.height - EDGE.top - EDGE.bottom] : [a[1], b[1] - a[1]];
    c.fillRect(a[0], top, b[0] - a[0], height);
  }

  zoomTo(a, b) {
    if (Math.abs(a[0] - b[0]) < 5) { this.cursor(); return; }
    const x = [a, b].map((p) => this.fromX(p[0])).sort((p, q) => p - q);
    const y = [a, b].map((p) => this.fromY(p[1])).sort((p, q) => p - q);
    if (this.timed) this.setTime(x);
    else if (y[1] > y[0]) { this.box = { x, y }; this.draw(); }
  }

  zoomBy(factor, p) {
    const about = (range, v) => range.map((end) => v + factor * (end - v));
    const scaled = (range, v) => range.map((end) => v * (end / v) ** factor);
    const x = (this.log ? scaled : about)(this.range.x, this.fromX(p[0]));
    if (this.timed) this.setTime(x);
    else { this.box = { x, y: about(this.range.y, this.fromY(p[1])) }; this.draw(); }
  }

  pan(a, b) {
    const { x, y } = this.range;
    const dx = this.fromX(a[0]) - this.fromX(b[0]), dy = this.fromY(a[1]) - this.fromY(b[1]);
    if (this.timed) this.setTime([x[0] + dx, x[1] + dx]);
    else if (this.log) {
      const along = this.fromX(a[0]) / this.fromX(b[0]);
      this.box = { x: x.map((v) => v * along), y: y.map((v) => v + dy) };
      this.draw();
    } else { this.box = { x: x.map((v) => v + dx), y: y.map((v) => v + dy) }; this.draw(); }
  }

  /** A part of the time, no longer than all of it. */
  setTime([from, to]) {
    const [first, last] = extremes(this.series[0].x);
    if (to - from >= last - first) { span.set(null); return; }
    const shift = Math.max(first - from, 0) || Math.min(last - to, 0);
    span.set([from + shift, to + shift]);
  }

  reset() {
    this.box = null;
    if (this.timed) span.set(null); else this.draw();
  }
}

function stroke(c, points, color, width = 1) {
  c.beginPath();
  for (const [x, y] of points) c.lineTo(x, y);
  c.strokeStyle = color;
  c.lineWidth = width;
  c.stroke();
}

function dot(c, x, y, color) {
  c.beginPath();
  c.arc(x, y, 3.5, 0, 2 * Math.PI);
  c.fillStyle = color;
  c.fill();
}
