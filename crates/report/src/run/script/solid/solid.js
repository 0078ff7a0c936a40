// The model in three dimensions, drawn by a graphics processor (gl.js) or without one (plain.js): what there is to draw, in
// which order. Everything but displacements and colours is prepared once, for all stages of the page.

/** Where the marks of a sort begin in the tables of looks and values. */
const FIRST = (() => {
  const { lines, faces, links, nodes } = picture;
  const [face, link] = [lines.length, lines.length + faces.length];
  return { line: 0, face, link, node: link + links.length, all: link + links.length + nodes.length };
})();

/** The middle of the model: numbers count from there, so that they fit into 32 bits. */
const CENTRE = [0, 1, 2].map((i) => {
  const [low, high] = extremes(picture.points.map((p) => p[i]));
  return low <= high ? (low + high) / 2 : 0;
});

/** What a drawing has beside where nothing is said. */
const FREE = { factor: 1, bias: 0, shaded: 0, dash: 0, over: [-1, -1, -1] };

class Solid {
  constructor(pen) {
    this.pen = pen;
    this.rest = pen.table(POINTS, "vector");
    picture.points.forEach((p, i) => this.rest.data.set(p.map((x, k) => x - CENTRE[k]), 3 * i));
    this.rest.send();
    this.moved = pen.table(POINTS, "vector");
    this.looks = pen.table(FIRST.all, "look");
    this.values = pen.table(FIRST.all, "value");
    this.reach = Math.max(1e-9, ...[0, 1, 2].map((i) => {
      const [low, high] = extremes(picture.points.map((p) => p[i]));
      return high - low;
    }));
    this.members();
    this.faces();
    this.symbols();
    this.dots();
  }

  members() {
    const { pen } = this, by = picture.outlines.map(() => []), plain = { member: [], tie: [], edge: [] };
    picture.lines.forEach((l, i) => {
      plain[l.what].push([...l.ends, i]);
      if (l.outline != null) by[l.outline].push([...l.ends, i]);
    });
    this.prisms = picture.outlines.map((outline, k) => {
      // All faces go round the same way as seen from outside.
      const n = outline.length, cap = triangles(outline), faces = cap.flatMap((f) => [[...f].reverse(), f.map((i) => i + n)]);
      outline.forEach((_, i) => { const j = (i + 1) % n; faces.push([i, j, n + j, n + i]); });
      const ends = Int32Array.from({ length: 2 * n }, (_, i) => Number(i >= n));
      return pen.batch({ 0: [Float32Array.from([...outline, ...outline].flat()), 3, 0], 1: [ends, 1, 0], ...many(by[k]) }, faces);
    });
    // Contours of bodies are lines of their own.
    const contours = picture.faces.flatMap((f, i) => f.corners.map((p, k) => [p, f.corners[(k + 1) % f.corners.length], FIRST.face + i]));
    const ways = picture.links.flatMap((l, i) => (l.ends.length > 1 ? [[...l.ends.slice(0, 2), FIRST.link + i]] : []));
    this.lines = Object.fromEntries(Object.entries({ ...plain, contours, ways })
      .map(([what, all]) => [what, pen.batch({ 0: [Float32Array.from([0, -1, 1, -1, 0, 1, 1, 1]), 2, 0], ...many(all) })]));
  }

  faces() {
    const points = [], marks = [];
    for (const [corners, face] of SOLIDS) {
      for (const i of triangles(corners.map((p) => picture.points[p])).flat()) {
        points.push(corners[i]);
        marks.push(FIRST.face + face);
      }
    }
    this.solids = this.pen.batch({ 0: [Int32Array.from(points), 1, 0], 3: [Int32Array.from(marks), 1, 0] });
  }

  symbols() {
    const all = {}, upright = picture.plane === "XY" ? [0, 1, 0] : [0, 0, 1];
    // Between bodies they would be hidden: these are drawn over all.
    const bodies = new Set(picture.links.filter((l) => l.body).map((l) => l.ends[0]));
    const put = (kind, ends, mark, axis) => (all[ends.every((p) => bodies.has(p)) ? `${kind} over` : kind] ??= []).push([ends, mark, axis]);
    picture.links.forEach((l, i) => {
      const long = Math.hypot(...l.axis);
      if (!l.body) put(l.family, [l.ends[0], l.ends.at(-1)], FIRST.link + i, long > 0 ? l.axis.map((x) => x / long) : upright);
    });
    picture.nodes.forEach((n, i) => { if (n.fixed) put(held(n), [n.at, n.at], FIRST.node + i, upright); });
    this.marks = Object.entries(all).map(([kind, these]) => {
      const { corners, faces } = SHAPES_OF[kind.split(" ")[0]];
      const axes = Float32Array.from(these.flatMap((t) => t[2]));
      const mesh = { 0: [Float32Array.from(corners.flat()), 3, 0], 4: [axes, 3, 1] };
      const made = this.pen.batch({ ...mesh, ...many(these.map(([ends, mark]) => [...ends, mark])) }, faces);
      return { made, over: kind.endsWith(" over") };
    });
  }

  dots() {
    const points = Int32Array.from(picture.nodes, (n) => n.at), marks = Int32Array.from(picture.nodes, (_, i) => FIRST.node + i);
    this.nodes = this.pen.batch({ 0: [points, 1, 0], 3: [marks, 1, 0] });
    this.plane = this.pen.batch({ 0: [Float32Array.of(0, 0, 1, 0, 0, 1, 1, 1), 2, 0] });
    this.sides = [0, 1].map((i) => extremes(picture.points.map((p) => p[i])).map((x) => x - CENTRE[i]));
  }

  /** Colours of all marks; what is hidden has none. Beside those of values all is grey. */
  dress(stage) {
    const { shade } = stage, { data } = this.looks, grey = stage.tint?.how === 2;
    const paint = (first, marks, color) => marks.forEach((m, i) => {
      data.set(stage.shown(m) ? [...rgb(grey ? shade.tie : color(m)), 255] : [0, 0, 0, 0], 4 * (first + i));
    });
    paint(FIRST.line, picture.lines, (l) => (l.what === "tie" ? shade.tie : l.what === "edge" ? shade.contour : shade.member));
    paint(FIRST.face, picture.faces, () => shade.solid);
    paint(FIRST.link, picture.links, () => shade.link);
    paint(FIRST.node, picture.nodes, (n) => (n.fixed ? shade.support : shade.ink));
    this.looks.send();
  }

  /** Draws a stage with displacements, in so many pixels, over what its context shows. */
  draw(stage, u, size, c) {
    const { pen } = this, { shade, k } = stage;
    this.moved.data.set(u);
    this.moved.send();
    const dress = [shade.paper, stage.looks, stage.tint?.how].join();
    if (this.dressed !== dress || this.of !== stage) { this.dress(stage); [this.dressed, this.of] = [dress, stage]; }
    const tint = stage.tint?.fill(this.values.data, stage.time()) ?? 0;
    if (tint === 2) this.values.send();
    const [right, up, eye] = stage.directions, ratio = size[0] / stage.width;
    const about = along(CENTRE, right), above = along(CENTRE, up), room = stage.largest();
    const { rest, moved, looks, values } = this;
    pen.begin(size, {
      right, up, eye, pixel: 1 / k, size, tint, most: stage.tint?.most || 1,
      middle: [stage.middle[0] - about, stage.middle[1] - above],
      scale: [(2 * k) / stage.width, (2 * k) / stage.height],
      shift: [(2 * stage.shift[0]) / stage.width, (-2 * stage.shift[1]) / stage.height],
      deep: [0, 1 / (2 * this.reach + 2 * room + 60 / k)], palette: stage.tint ? shade.palette.flatMap(unit) : null,
    }, { rest, moved, looks, values }, stage);
    const small = DENSE || stage.height < 300;
    if (picture.ground !== null && stage.view === "space" && eye[2] > 0) {
      const [[x0, x1], [y0, y1]] = this.sides, more = 0.1 * this.reach + 0.05 + room, z = picture.ground - CENTRE[2];
      pen.use("GROUND", { bias: -2, over: unit(shade.ground), low: [x0 - more, y0 - more, z], high: [x1 + more, y1 + more, z] }, this.plane);
    }
    if (stage.ghost) for (const what of ["member", "edge", "contours"]) this.line(what, { factor: 0, width: ratio, tint: 3 }, shade.ghost);
    this.line("tie", { width: ratio, dash: 4 * ratio });
    const solid = stage.sections && picture.outlines.length > 0;
    if (solid) for (const prism of this.prisms) if (prism.instances) pen.use("MEMBER", { shaded: 1 }, prism);
    this.line("member", { width: ratio * (solid || DENSE ? 1 : 2.4), bias: solid ? -1 : 0 });
    if (this.solids.vertices) pen.use("FACE", { shaded: 1, bias: -1 }, this.solids);
    this.line("contours", { width: 1.2 * ratio, bias: 1, tint: 3 }, shade.contour);
    this.line("edge", { width: ratio, bias: 1, tint: 3 });
    this.line("ways", { width: 1.4 * ratio, dash: 5 * ratio });
    for (const { made, over } of this.marks) pen.use("SYMBOL", { shaded: 1, large: small ? 5 : 9, bias: small ? 5 : 9 }, made, over);
    const nodes = stage.tint?.nodes;
    if (nodes || picture.nodes.length <= 300) pen.use("DOT", { large: ratio * (nodes ? 8 : 3.5), bias: 12 }, this.nodes);
    pen.lay(c, stage.width, stage.height);
  }

  line(what, set, color) {
    if (this.lines[what].instances) this.pen.use("LINE", { ...set, ...(color && { over: unit(color) }) }, this.lines[what]);
  }
}

/** Instances of [point, point, mark]. */
const many = (all) => ({
  2: [Int32Array.from(all.flatMap(([a, b]) => [a, b])), 2, 1], 3: [Int32Array.from(all, (t) => t[2]), 1, 1],
});

/** `#rrggbb` as three numbers to 255. */
const rgb = (hex) => [1, 3, 5].map((i) => parseInt(hex.slice(i, i + 2), 16));

/** The same to 1. */
const unit = (hex) => rgb(hex).map((x) => x / 255);

/** The one that draws for all stages; null where there is nothing to draw. */
let solid = null;
(() => {
  if (POINTS === 0) return;
  const begin = (pen) => {
    solid = new Solid(pen);
    root.dataset.solid = pen instanceof Graphics ? "webgl" : "plain";
  };
  const again = () => { for (const stage of stages) stage.draw(); };
  const graphics = new Graphics();
  begin(graphics.broken ? new Plain() : graphics);
  graphics.canvas.addEventListener("webglcontextlost", (e) => { e.preventDefault(); begin(new Plain()); again(); });
  graphics.canvas.addEventListener("webglcontextrestored", () => {
    const anew = new Graphics(graphics.canvas);
    if (!anew.broken) { begin(anew); again(); }
  });
})();
