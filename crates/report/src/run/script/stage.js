// A place where the model is drawn in three dimensions, with names and axes.

/** All of them. */
const stages = new Set();

class Stage {
  /** moved(): displacements of the points, m, as they are to be drawn; largest: bound of their size. */
  constructor(canvas, height, moved, largest) {
    Object.assign(this, { canvas, height, moved, largest });
    this.view = picture.plane ?? "space";
    [this.azimuth, this.elevation] = [0.52, 0.35];
    [this.near, this.shift] = [1, [0, 0]];
    // What is hidden: kinds by name, groups; `looks` counts the changes.
    [this.hidden, this.away, this.looks] = [new Set(), new Set(), 0];
    this.wanted = "";
    this.names = false;
    this.ghost = !DENSE;
    // What it is coloured by, at which time; sections: members as solids.
    [this.tint, this.time, this.sections] = [null, () => 0, true];
    stages.add(this);
    // Told of as well when it begins.
    new ResizeObserver(() => { if (canvas.parentElement.clientWidth !== this.width) this.draw(); }).observe(canvas.parentElement);
    darkness.addEventListener("change", () => this.draw());
  }

  shown(mark) { return !this.hidden.has(mark.kind) && !mark.groups?.some((g) => this.away.has(g)); }

  /** Hides or shows a kind (by name) or a group; true where it is shown then. */
  toggle(what) {
    const set = typeof what === "string" ? this.hidden : this.away;
    if (!set.delete(what)) set.add(what);
    this.looks++;
    this.draw();
    return !set.has(what);
  }

  /** A way of looking, from where it begins. */
  look(view) {
    [this.view, this.near, this.shift, this.azimuth, this.elevation] = [view, 1, [0, 0], 0.52, 0.35];
    this.looked?.(view);
    this.draw();
  }

  /** The place on the sheet, how near to the eye. */
  flat(p) { const [right, up, eye] = this.directions; return [along(p, right), along(p, up), along(p, eye)]; }

  pixel([x, y, z]) {
    const { width, height, shift, k, middle } = this;
    return [width / 2 + shift[0] + k * (x - middle[0]), height / 2 + shift[1] - k * (y - middle[1]), z];
  }

  /** Pixels of all points with displacements, or without. */
  pixels(u) {
    return picture.points.map((p, i) => this.pixel(this.flat(u ? [p[0] + u[3 * i], p[1] + u[3 * i + 1], p[2] + u[3 * i + 2]] : p)));
  }

  /** Pixels of all points as they are drawn, once a drawing. */
  get at() { return (this.places ??= this.pixels(this.u)); }

  /** How the model at rest fits in. */
  fit() {
    this.directions = directions(this.view, this.azimuth, this.elevation);
    const [right, up] = this.directions, room = this.largest(), way = [...right, ...up].join();
    // A model that only moves is as large as it was.
    if (this.way !== way) {
      const [a, b, c, d, e, f] = [...right, ...up];
      let [x0, x1, y0, y1] = [Infinity, -Infinity, Infinity, -Infinity];
      for (const p of picture.points) {
        const x = a * p[0] + b * p[1] + c * p[2], y = d * p[0] + e * p[1] + f * p[2];
        if (x < x0) x0 = x;
        if (x > x1) x1 = x;
        if (y < y0) y0 = y;
        if (y > y1) y1 = y;
      }
      [this.way, this.sides] = [way, [x0, x1, y0, y1]];
    }
    const [x0, x1, y0, y1] = this.sides;
    this.k = this.near * Math.min((this.width - 60) / (x1 - x0 + 2 * room || 1), (this.height - 60) / (y1 - y0 + 1.4 * room || 1));
    this.middle = [(x0 + x1) / 2, (y0 + y1) / 2];
  }

  draw() {
    const width = this.canvas.parentElement.clientWidth;
    if (width < 50) return;
    const c = sharpen(this.canvas, width, this.height);
    this.shade = darkness.matches ? SHADES.dark : SHADES.light;
    this.width = width;
    [this.u, this.places] = [this.moved(), null];
    this.fit();
    c.fillStyle = this.shade.paper;
    c.fillRect(0, 0, width, this.height);
    if (this.view !== "space") this.ground(c, width);
    solid.draw(this, this.u, [this.canvas.width, this.canvas.height], c);
    this.marks(c);
    if (this.view === "space") this.triad(c);
    this.tint?.legend(c, this);
  }

  /** A line, where the model is seen from the side. */
  ground(c, width) {
    if (picture.ground === null || this.view === "XY") return;
    const y = this.pixel([0, picture.ground * this.directions[1][2]])[1];
    stroke(c, [[0, y], [width, y]], this.shade.edge);
    c.fillStyle = this.shade.ground;
    c.fillRect(0, y, width, 6);
  }

  /** Names, and what is looked for. */
  marks(c) {
    c.font = FONT;
    c.textAlign = "left";
    c.textBaseline = "alphabetic";
    const taken = [];
    c.fillStyle = this.shade.ink;
    if (this.names) for (const node of picture.nodes) if (this.shown(node)) write(c, taken, node.name, ...this.at[node.at]);
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
    // Into the middle with them.
    if (this.hits.length && this.width) {
      const [x, y] = middleOf(this.hits.map(([, ends]) => middleOf(ends.map((i) => this.at[i]))));
      this.shift = [this.shift[0] + this.width / 2 - x, this.shift[1] + this.height / 2 - y];
    }
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
    const [right, up] = this.directions;
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
