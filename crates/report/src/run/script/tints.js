// What the model can be coloured by at the time of the clock: what its deformed shapes tell, and what figures of the page tell
// of single nodes, members and links. Sizes, without sign: little to much.

/** Drawings of histories and loops by their titles, read when they are wanted. */
let drawings = null;
function drawn(title) {
  if (!drawings) {
    const all = document.querySelectorAll("#histories script.drawing, #loops script.drawing");
    drawings = new Map([...all].map((s) => JSON.parse(s.textContent)).map((d) => [d.title, d]));
  }
  return drawings.get(title);
}

/** Its values over time: a history has the time along, a loop beside. */
function series(title) {
  const drawing = drawn(title), s = drawing?.series.find((one) => one.py);
  if (!s) return null;
  return { label: drawing.y.label, t: unpack(s.times ?? s.px), y: unpack(s.py) };
}

class Tint {
  /** most: the largest size; how: 1 by the displacements of points, 2 by values of marks. */
  constructor(quantity, unit, most, how, fill, nodes = false) {
    Object.assign(this, { quantity, unit, how, nodes });
    [this.largest, this.most, this.write] = [most, most, fill];
  }

  /** Writes values of marks from 0 to 1, −1 where none is known; returns how the shaders read them. */
  fill(values, t) {
    if (this.how === 2) {
      values.fill(-1);
      this.write(values, t);
    }
    return this.how;
  }

  legend(c, stage) {
    const wide = 130, x = stage.width - wide - 14, y = 26;
    c.font = FONT;
    c.textBaseline = "alphabetic";
    c.fillStyle = `${stage.shade.paper}cc`;
    c.fillRect(x - 8, 6, wide + 16, 48);
    c.fillStyle = stage.shade.ink;
    c.textAlign = "right";
    c.fillText(this.quantity, x + wide, y - 6, stage.width - 30);
    const bar = c.createLinearGradient(x, 0, x + wide, 0);
    stage.shade.palette.forEach((color, i, all) => bar.addColorStop(i / (all.length - 1), color));
    c.fillStyle = bar;
    c.fillRect(x, y, wide, 9);
    c.fillStyle = stage.shade.ink;
    c.textAlign = "left";
    c.fillText("0", x, y + 23);
    c.textAlign = "right";
    c.fillText(`${number(this.largest)}${this.unit && ` ${this.unit}`}`, x + wide, y + 23);
  }
}

/** A length in the unit that is easy to read. */
const length = (m) => (m >= 1 ? [m, "m"] : m >= 0.01 ? [100 * m, "cm"] : [1000 * m, "mm"]);

/** Names of what there is, and how it is made when it is chosen; most(): size of the largest displacement. */
function tints(most) {
  const all = new Map();
  if (most() > 0) {
    all.set("displacement", () => new Tint("displacement", length(most())[1], length(most())[0], 1));
    if (picture.plane !== "XY" && picture.lines.some(upright)) all.set("drift of columns", drifts);
  }
  for (const tint of data.tints) {
    if (!all.has(tint.quantity)) all.set(tint.quantity, () => told(tint));
  }
  return all;
}

/** True for a member that rises more than it runs. */
function upright(l) {
  const [p, q] = l.ends.map((i) => picture.points[i]);
  return l.what === "member" && Math.abs(q[2] - p[2]) > Math.hypot(q[0] - p[0], q[1] - p[1]);
}

/** What the ends of columns move against each other sideways, over their height. */
function drifts() {
  const drift = (l, u) => {
    const [a, b] = l.ends;
    return Math.hypot(u[3 * b] - u[3 * a], u[3 * b + 1] - u[3 * a + 1]) / Math.abs(picture.points[b][2] - picture.points[a][2]);
  };
  const columns = picture.lines.map((l, i) => [l, FIRST.line + i]).filter(([l]) => upright(l));
  let most = 0;
  for (const t of frames.t) {
    const u = displaced(t, 1);
    for (const [l] of columns) most = Math.max(most, drift(l, u));
  }
  return new Tint("drift of columns", "%", 100 * most, 2, (values, t) => {
    const u = displaced(t, 1);
    for (const [l, i] of columns) values[i] = most > 0 ? drift(l, u) / most : 0;
  });
}

/** What figures tell. */
function told({ quantity, of }) {
  const known = of.map((one) => [series(one.figure), one]).filter(([s]) => s);
  const most = known.reduce((m, [s]) => s.y.reduce((a, y) => (Math.abs(y) > a ? Math.abs(y) : a), m), 0);
  const unit = /\[([^\]]*)\]$/.exec(known[0]?.[0].label ?? "")?.[1] ?? "";
  const write = (values, t) => {
    for (const [s, one] of known) {
      const x = most > 0 ? Math.abs(valueAt(s.t, s.y, t)) / most : 0;
      for (const [first, these] of [[FIRST.node, one.nodes], [FIRST.line, one.lines], [FIRST.link, one.links]]) {
        for (const i of these) {
          values[first + i] = x;
          // A body is the face of its link.
          if (first === FIRST.link && picture.links[i].body) for (const f of facesOf(picture.links[i])) values[FIRST.face + f] = x;
        }
      }
    }
  };
  return new Tint(quantity, unit, most, 2, write, known.some(([, one]) => one.nodes.length > 0));
}

/** Indices of the faces of a body. */
function facesOf(link) {
  link.faces ??= picture.faces.flatMap((f, i) => (f.name === `${link.name} (${link.kind})` ? [i] : []));
  return link.faces;
}
