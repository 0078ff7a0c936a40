// The model: parallel projection of points, lines, faces and symbols; it turns, moves, comes closer and tells names.

const FONT = "12px system-ui, sans-serif";
const data = JSON.parse(document.getElementById("data").textContent);
const picture = data.picture;
const POINTS = picture.points.length;
/** Lines and symbols of large models are drawn thinner and smaller. */
const DENSE = picture.lines.length > 800;

/** `beam 1 (Beam)`: the kind. */
const kindOf = (name) => /\(([^()]*)\)$/.exec(name)?.[1] ?? "";
for (const mark of [...picture.lines, ...picture.faces]) mark.kind = kindOf(mark.name);

/** What can be hidden: kinds of members, bodies and links, as often as they are. */
const KINDS = (() => {
  const count = new Map();
  // The faces of a body are one thing.
  const seen = new Set();
  for (const m of [...picture.lines, ...picture.faces, ...picture.links]) {
    if (seen.has(m.name)) continue;
    seen.add(m.name);
    if (m.kind) count.set(m.kind, (count.get(m.kind) ?? 0) + 1);
  }
  return count;
})();

/** Colours in light and dark, read once a drawing. */
const SHADES = {
  light: { paper: "#ffffff", ink: "#333333", blue: "#0072b2", face: "#0072b21f", link: "#d55e00", tie: "#999999", ghost: "#c9c9c9", ground: "#e9e9e9", edge: "#777777", found: "#aa003c" },
  dark: { paper: "#16191d", ink: "#d5dadf", blue: "#4aa5e6", face: "#4aa5e62e", link: "#f2863a", tie: "#7c858e", ghost: "#454d55", ground: "#252a30", edge: "#98a0a8", found: "#ff7aa2" },
};
const darkness = window.matchMedia("(prefers-color-scheme: dark)");

/** Directions on the sheet to the right, up, and towards the eye, for a way of looking. */
function directions(view, azimuth, elevation) {
  const flat = {
    XZ: [[1, 0, 0], [0, 0, 1], [0, -1, 0]], YZ: [[0, 1, 0], [0, 0, 1], [1, 0, 0]], XY: [[1, 0, 0], [0, 1, 0], [0, 0, 1]],
  };
  if (view in flat) return flat[view];
  const [sa, ca, se, ce] = [Math.sin(azimuth), Math.cos(azimuth), Math.sin(elevation), Math.cos(elevation)];
  return [[ca, -sa, 0], [sa * se, ca * se, ce], [-sa * ce, -ca * ce, se]];
}

const along = (p, d) => p[0] * d[0] + p[1] * d[1] + p[2] * d[2];

class Stage {
  /** moved(): displacements of the points, m, as they are to be drawn; largest: bound of their size. */
  constructor(canvas, height, moved, largest) {
    Object.assign(this, { canvas, height, moved, largest });
    this.view = picture.plane ?? "space";
    [this.azimuth, this.elevation] = [0.52, 0.35];
    [this.near, this.shift] = [1, [0, 0]];
    this.hidden = new Set();
    this.wanted = "";
    this.names = false;
    this.ghost = !DENSE;
    new ResizeObserver(() => this.draw()).observe(canvas.parentElement);
    darkness.addEventListener("change", () => this.draw());
  }

  shown(mark) { return !this.hidden.has(mark.kind); }

  /** Points with displacements on the sheet, and how near they are to the eye. */
  project(u) {
    const [right, up, eye] = directions(this.view, this.azimuth, this.elevation);
    return picture.points.map((p, i) => {
      const q = u ? [p[0] + u[3 * i], p[1] + u[3 * i + 1], p[2] + u[3 * i + 2]] : p;
      return [along(q, right), along(q, up), along(q, eye)];
    });
  }

  draw() {
    const width = this.canvas.parentElement.clientWidth;
    if (width < 50) return;
    const c = sharpen(this.canvas, width, this.height);
    this.shade = darkness.matches ? SHADES.dark : SHADES.light;
    const rest = this.project(null), now = this.project(this.moved());
    const room = this.largest();
    const [x0, x1] = extremes(rest.map((p) => p[0])), [y0, y1] = extremes(rest.map((p) => p[1]));
    const k = this.near * Math.min((width - 60) / (x1 - x0 + 2 * room || 1), (this.height - 60) / (y1 - y0 + 1.4 * room || 1));
    const middle = [(x0 + x1) / 2, (y0 + y1) / 2];
    const pixel = ([x, y, z]) => [width / 2 + this.shift[0] + k * (x - middle[0]), this.height / 2 + this.shift[1] - k * (y - middle[1]), z];
    c.fillStyle = this.shade.paper;
    c.fillRect(0, 0, width, this.height);
    this.ground(c, pixel, width);
    this.at = now.map(pixel);
    if (this.ghost) this.shape(c, rest.map(pixel), true);
    this.shape(c, this.at, false);
    this.marks(c);
    if (this.view === "space") this.triad(c);
  }

  ground(c, pixel, width) {
    if (picture.ground === null || this.view === "XY") return;
    const z = picture.ground;
    const [right, up] = directions(this.view, this.azimuth, this.elevation);
    if (this.view !== "space") {
      const y = pixel([0, z * up[2]])[1];
      stroke(c, [[0, y], [width, y]], this.shade.edge);
      c.fillStyle = this.shade.ground;
      c.fillRect(0, y, width, 6);
      return;
    }
    const [xs, ys] = [0, 1].map((i) => {
      const [low, high] = extremes(picture.points.map((p) => p[i]));
      const room = 0.1 * (high - low) + 0.05 + this.largest();
      return [low - room, high + room];
    });
    const flat = (x, y) => pixel([x * right[0] + y * right[1], x * up[0] + y * up[1] + z * up[2]]);
    trace(c, [[xs[0], ys[0]], [xs[1], ys[0]], [xs[1], ys[1]], [xs[0], ys[1]]].map((p) => flat(...p)));
    c.closePath();
    c.fillStyle = this.shade.ground;
    c.fill();
  }

  shape(c, at, ghost) {
    const { shade } = this;
    // What is behind comes first.
    const depth = (face) => face.corners.reduce((sum, i) => sum + at[i][2], 0) / face.corners.length;
    const faces = picture.faces.filter((f) => this.shown(f)).map((f) => [depth(f), f]).sort((a, b) => a[0] - b[0]);
    for (const [, face] of faces) {
      trace(c, face.corners.map((i) => at[i]));
      c.closePath();
      if (!ghost) { c.fillStyle = shade.face; c.fill(); }
      c.lineWidth = ghost ? 1 : 1.5;
      c.strokeStyle = ghost ? shade.ghost : shade.blue;
      c.stroke();
    }
    // One path for all lines of a sort: thousands of single ones would not move smoothly.
    for (const what of ["member", "tie", "edge"]) {
      c.beginPath();
      for (const line of picture.lines) {
        if (line.what !== what || !this.shown(line)) continue;
        c.moveTo(at[line.ends[0]][0], at[line.ends[0]][1]);
        c.lineTo(at[line.ends[1]][0], at[line.ends[1]][1]);
      }
      c.setLineDash(what === "tie" ? [3, 3] : []);
      c.strokeStyle = ghost ? shade.ghost : what === "tie" ? shade.tie : shade.blue;
      c.lineWidth = ghost ? 1 : DENSE ? 0.6 : what === "member" ? 2 : 1;
      c.stroke();
    }
    c.setLineDash([]);
  }

  /** Symbols of links, supports, nodes, names, and what is looked for. */
  marks(c) {
    const { shade } = this;
    for (const link of picture.links) {
      if (link.body || !this.shown(link)) continue;
      const ends = link.ends.map((i) => this.at[i]);
      if (ends.length > 1) { c.setLineDash([5, 2]); stroke(c, ends, shade.link); c.setLineDash([]); }
      c.save();
      c.translate(...middleOf(ends));
      if (DENSE || this.height < 300) c.scale(0.55, 0.55);
      c.fillStyle = `${shade.paper}b3`;
      c.strokeStyle = shade.link;
      c.lineWidth = 1.6;
      c.fill(SYMBOLS[link.family]);
      c.stroke(SYMBOLS[link.family]);
      c.restore();
    }
    c.font = FONT;
    c.textAlign = "left";
    c.textBaseline = "alphabetic";
    const taken = [], small = picture.nodes.length > 300;
    for (const node of picture.nodes) {
      const [x, y] = this.at[node.at];
      if (node.fixed) stroke(c, [[x, y], [x - 6, y + 10], [x + 6, y + 10], [x, y]], shade.ink);
      c.fillStyle = shade.ink;
      if (!small) c.fillRect(x - 1.5, y - 1.5, 3, 3);
      if (this.names) write(c, taken, node.name, x, y);
    }
    this.found(c, taken);
  }

  /** Everything whose name has the wanted text, with its name while there is room. */
  search(wanted) {
    this.wanted = wanted.trim().toLowerCase();
    const has = (name) => this.wanted && name.toLowerCase().includes(this.wanted);
    const of = (all, ends) => all.filter((m) => has(m.name)).map((m) => [m.name, ends(m)]);
    this.hits = [
      ...of(picture.nodes, (n) => [n.at]), ...of(picture.lines, (l) => l.ends),
      ...of(picture.faces, (f) => f.corners), ...of(picture.links, (l) => l.ends),
    ];
    this.draw();
    return new Set(this.hits.map((h) => h[0])).size;
  }

  found(c, taken) {
    if (!this.wanted) return;
    const said = new Set();
    for (const [name, ends] of this.hits) {
      const at = ends.map((i) => this.at[i]);
      stroke(c, at.length > 2 ? [...at, at[0]] : at, this.shade.found, 3);
      const [x, y] = middleOf(at);
      c.fillStyle = this.shade.found;
      c.beginPath();
      c.arc(x, y, 4, 0, 2 * Math.PI);
      c.fill();
      if (said.size < 30 && !said.has(name)) write(c, taken, name, x, y);
      said.add(name);
    }
  }

  triad(c) {
    const [right, up] = directions(this.view, this.azimuth, this.elevation);
    const [x, y] = [34, this.height - 34];
    c.font = FONT;
    c.textAlign = "center";
    c.textBaseline = "middle";
    for (const [i, name] of ["X", "Y", "Z"].entries()) {
      const [dx, dy] = [24 * right[i], -24 * up[i]];
      stroke(c, [[x, y], [x + dx, y + dy]], this.shade.ink, 1.4);
      c.fillStyle = this.shade.ink;
      c.fillText(name, x + 1.35 * dx, y + 1.35 * dy);
    }
  }

  /** What is near a pixel, in words. */
  nearest(p) {
    let best = { d: 12, text: "" };
    const offer = (q, text) => {
      const d = Math.hypot(q[0] - p[0], q[1] - p[1]);
      if (d < best.d) best = { d, text };
    };
    const middle = (ends) => middleOf(ends.map((i) => this.at[i]));
    for (const l of picture.lines) if (this.shown(l)) offer(middle(l.ends), l.name);
    for (const f of picture.faces) if (this.shown(f)) offer(middle(f.corners), f.name);
    for (const l of picture.links) if (this.shown(l)) offer(middle(l.ends), `${l.name} (${l.kind})`);
    for (const n of picture.nodes) {
      if (Math.hypot(this.at[n.at][0] - p[0], this.at[n.at][1] - p[1]) >= best.d) continue;
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

const middleOf = (points) => [0, 1].map((i) => points.reduce((sum, p) => sum + p[i], 0) / points.length);

/** Symbols as the key beneath the model draws them. */
const SYMBOLS = Object.fromEntries(
  [...document.querySelectorAll(".key path[data-family]")].map((p) => [p.dataset.family, new Path2D(p.getAttribute("d"))]),
);

/** A canvas as sharp as the screen; returns its context in CSS pixels. */
function sharpen(canvas, width, height) {
  const ratio = window.devicePixelRatio || 1;
  canvas.width = Math.round(width * ratio);
  canvas.height = Math.round(height * ratio);
  canvas.style.height = `${height}px`;
  const context = canvas.getContext("2d");
  context.setTransform(ratio, 0, 0, ratio, 0, 0);
  return context;
}

function trace(c, points) {
  c.beginPath();
  for (const [x, y] of points) c.lineTo(x, y);
}

function stroke(c, points, color, width = 1) {
  trace(c, points);
  c.strokeStyle = color;
  c.lineWidth = width;
  c.stroke();
}
