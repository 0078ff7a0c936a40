// The model: parallel projection of points, lines, faces and symbols; it turns, moves and tells names.

const picture = data.picture;
const POINTS = picture.points.length;
/** Lines and symbols of large models are drawn thinner and smaller. */
const DENSE = picture.lines.length > 800;
/** Ends of the lines of each sort. */
const LINES = ["member", "tie", "edge"]
  .map((what) => [what, picture.lines.filter((l) => l.what === what).map((l) => l.ends)])
  .filter(([, ends]) => ends.length);

/** Directions on the sheet to the right and up for a way of looking. */
function directions(view, azimuth, elevation) {
  const flat = { XZ: [[1, 0, 0], [0, 0, 1]], YZ: [[0, 1, 0], [0, 0, 1]], XY: [[1, 0, 0], [0, 1, 0]] };
  if (view in flat) return flat[view];
  const [sa, ca, se, ce] = [Math.sin(azimuth), Math.cos(azimuth), Math.sin(elevation), Math.cos(elevation)];
  return [[ca, -sa, 0], [sa * se, ca * se, ce]];
}

class Stage {
  /** moved(): displacements of the points, m, as they are to be drawn; largest: bound of their size. */
  constructor(canvas, height, moved, largest) {
    Object.assign(this, { canvas, height, moved, largest });
    this.view = picture.plane ?? "space";
    [this.azimuth, this.elevation] = [0.52, 0.35];
    this.names = false;
    this.ghost = !DENSE;
    new ResizeObserver(() => this.draw()).observe(canvas.parentElement);
    if (!picture.plane) this.turn();
  }

  turn() {
    let last = null;
    this.canvas.addEventListener("pointerdown", (e) => {
      last = [e.clientX, e.clientY];
      this.canvas.setPointerCapture(e.pointerId);
    });
    this.canvas.addEventListener("pointermove", (e) => {
      if (!last || this.view !== "space") return;
      this.azimuth -= (e.clientX - last[0]) / 150;
      this.elevation = Math.min(Math.max(this.elevation + (e.clientY - last[1]) / 150, -1.57), 1.57);
      last = [e.clientX, e.clientY];
      this.draw();
    });
    this.canvas.addEventListener("pointerup", () => { last = null; });
  }

  /** From points and displacements to pixels. */
  project(u) {
    const [right, up] = directions(this.view, this.azimuth, this.elevation);
    const along = (p, d) => p[0] * d[0] + p[1] * d[1] + p[2] * d[2];
    return picture.points.map((p, i) => {
      const q = u ? [p[0] + u[3 * i], p[1] + u[3 * i + 1], p[2] + u[3 * i + 2]] : p;
      return [along(q, right), along(q, up)];
    });
  }

  draw() {
    const width = this.canvas.parentElement.clientWidth;
    if (width < 50) return;
    const c = sharpen(this.canvas, width, this.height);
    const rest = this.project(null), now = this.project(this.moved());
    const room = this.largest();
    const [x0, x1] = extremes(rest.map((p) => p[0])), [y0, y1] = extremes(rest.map((p) => p[1]));
    const k = Math.min((width - 60) / (x1 - x0 + 2 * room), (this.height - 60) / (y1 - y0 + 1.4 * room));
    const middle = [(x0 + x1) / 2, (y0 + y1) / 2];
    const pixel = ([x, y]) => [width / 2 + k * (x - middle[0]), this.height / 2 - k * (y - middle[1])];
    c.fillStyle = "#fff";
    c.fillRect(0, 0, width, this.height);
    this.ground(c, pixel, width);
    this.at = now.map(pixel);
    if (this.ghost) this.shape(c, rest.map(pixel), true);
    this.shape(c, this.at, false);
    this.marks(c);
  }

  ground(c, pixel, width) {
    if (picture.ground === null || this.view === "XY") return;
    const z = picture.ground;
    const [right, up] = directions(this.view, this.azimuth, this.elevation);
    if (this.view !== "space") {
      const y = pixel([0, z * up[2]])[1];
      stroke(c, [[0, y], [width, y]], "#777");
      c.fillStyle = "#ddd";
      c.fillRect(0, y, width, 6);
      return;
    }
    const [xs, ys] = [0, 1].map((i) => {
      const [low, high] = extremes(picture.points.map((p) => p[i]));
      const room = 0.1 * (high - low) + 0.05 + this.largest();
      return [low - room, high + room];
    });
    const flat = (x, y) => pixel([x * right[0] + y * right[1], x * up[0] + y * up[1] + z * up[2]]);
    c.beginPath();
    for (const [x, y] of [[xs[0], ys[0]], [xs[1], ys[0]], [xs[1], ys[1]], [xs[0], ys[1]]]) c.lineTo(...flat(x, y));
    c.closePath();
    c.fillStyle = "#f1f1f1";
    c.fill();
    c.strokeStyle = "#ccc";
    c.stroke();
  }

  shape(c, at, ghost) {
    for (const face of picture.faces) {
      c.beginPath();
      for (const i of face.corners) c.lineTo(...at[i]);
      c.closePath();
      if (!ghost) { c.fillStyle = "#0072b21f"; c.fill(); }
      c.lineWidth = ghost ? 1 : 1.5;
      c.strokeStyle = ghost ? "#c4c4c4" : "#0072b2";
      c.stroke();
    }
    // One path for all lines of a sort: thousands of single ones would not move smoothly.
    for (const [what, ends] of LINES) {
      c.beginPath();
      for (const [a, b] of ends) {
        c.moveTo(...at[a]);
        c.lineTo(...at[b]);
      }
      c.setLineDash(what === "tie" ? [3, 3] : []);
      c.strokeStyle = ghost ? "#d4d4d4" : what === "tie" ? "#999" : "#0072b2";
      c.lineWidth = ghost ? 1 : DENSE ? 0.6 : what === "member" ? 2 : 1;
      c.stroke();
    }
    c.setLineDash([]);
  }

  /** Symbols of links, supports, nodes, names. */
  marks(c) {
    for (const link of picture.links.filter((l) => !l.body)) {
      const ends = link.ends.map((i) => this.at[i]);
      if (ends.length > 1) { c.setLineDash([5, 2]); stroke(c, ends, "#d55e00"); c.setLineDash([]); }
      const [x, y] = [0, 1].map((i) => ends.reduce((sum, p) => sum + p[i], 0) / ends.length);
      c.save();
      c.translate(x, y);
      if (DENSE || this.height < 300) c.scale(0.55, 0.55);
      c.fillStyle = "#ffffffb3";
      c.strokeStyle = "#d55e00";
      c.lineWidth = 1.6;
      c.fill(SYMBOLS[link.family]);
      c.stroke(SYMBOLS[link.family]);
      c.restore();
    }
    c.font = FONT;
    c.textAlign = "left";
    c.textBaseline = "alphabetic";
    const taken = [];
    const small = picture.nodes.length > 300;
    for (const node of picture.nodes) {
      const [x, y] = this.at[node.at];
      if (node.fixed) stroke(c, [[x, y], [x - 6, y + 10], [x + 6, y + 10], [x, y]], "#333");
      c.fillStyle = "#333";
      if (!small) c.fillRect(x - 1.5, y - 1.5, 3, 3);
      if (this.names) write(c, taken, node.name, x, y);
    }
  }

  /** What is near a pixel, in words. */
  near(p) {
    let best = { d: 12, text: "" };
    const offer = (q, text) => {
      const d = Math.hypot(q[0] - p[0], q[1] - p[1]);
      if (d < best.d) best = { d, text };
    };
    const middle = (ends) => [0, 1].map((i) => ends.reduce((s, e) => s + this.at[e][i], 0) / ends.length);
    for (const l of picture.lines) offer(middle(l.ends), l.name);
    for (const f of picture.faces) offer(middle(f.corners), f.name);
    for (const l of picture.links) offer(middle(l.ends), `${l.name} (${l.kind})`);
    for (const n of picture.nodes) {
      const links = picture.links.filter((l) => l.ends.includes(n.at)).map((l) => `; ${l.name} (${l.kind})`);
      const held = n.fixed ? `, fixed: ${n.fixed}` : "";
      offer(this.at[n.at], `node ${n.name}${held}${links.slice(0, 3).join("")}`);
    }
    return best.text;
  }
}

/** A name beside a point where it covers no other: right or left, above or below. */
function write(c, taken, text, x, y) {
  const w = c.measureText(text).width;
  for (const [dx, dy] of [[5, -5], [-5 - w, -5], [5, 15], [-5 - w, 15]]) {
    const box = [x + dx, y + dy - 11, x + dx + w, y + dy];
    if (taken.some((b) => b[2] >= box[0] && box[2] >= b[0] && b[3] >= box[1] && box[3] >= b[1])) continue;
    taken.push(box);
    c.fillText(text, x + dx, y + dy);
    return;
  }
}

/** Symbols as the key beneath the model draws them. */
const SYMBOLS = Object.fromEntries(
  [...document.querySelectorAll(".key path[data-family]")].map((p) => [p.dataset.family, new Path2D(p.getAttribute("d"))]),
);
