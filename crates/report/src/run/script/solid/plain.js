// How the model is drawn where there is no graphics processor: the same drawings as those of WebGL, pixel by pixel.

/** Pixels of the sheet along one of CSS: edges are smooth by their mean. A large model has one while it moves, and all of them
 *  when it has been at rest for so long, ms. */
const [FINE, REST] = [2, 150];

class Plain {
  constructor() {
    this.sheet = new Sheet();
    this.canvas = document.createElement("canvas");
  }

  table(count, what) {
    const [array, each] = { vector: [Float32Array, 3], look: [Uint8Array, 4], value: [Float64Array, 1] }[what];
    return { data: new array(each * count), send() {} };
  }

  batch(attributes, faces = []) {
    const [mesh, side, ends, marks, axes] = [0, 1, 2, 3, 4].map((place) => attributes[place]?.[0]), firsts = [];
    let n = 0;
    for (const face of faces) { firsts.push(n); n += face.length; }
    return {
      mesh, side, ends, marks, axes, faces: Int32Array.from(faces.flat()), firsts,
      instances: ends ? marks.length : 0, vertices: mesh.length / attributes[0][1],
    };
  }

  /** stage: who is drawn. */
  begin(size, common, tables, stage) {
    clearTimeout(stage.refining);
    const moves = DENSE && !stage.rests, ratio = size[0] / stage.width;
    if (moves) stage.refining = setTimeout(() => { stage.rests = true; stage.draw(); }, REST);
    stage.canvas.dataset.fine = String(!moves);
    stage.rests = false;
    // Pixels of the sheet along one of the screen.
    this.fine = moves ? 1 / Math.max(1, ratio) : Math.max(1, FINE / ratio);
    const { right, up, eye, middle, scale, shift, palette } = common;
    const [wide, high] = size.map((n) => Math.round(this.fine * n));
    Object.assign(this, { common, tables, places: new Map() });
    // Right, down and towards the eye in pixels.
    const [sx, sy] = [(scale[0] * wide) / 2, (scale[1] * high) / 2];
    this.way = [right.map((x) => sx * x), up.map((x) => -sy * x), eye.map((x) => sx * x)];
    this.from = [((1 + shift[0] - scale[0] * middle[0]) * wide) / 2, ((1 - shift[1] + scale[1] * middle[1]) * high) / 2, 0];
    this.looks = new Uint32Array(tables.looks.data.buffer);
    this.sheet.begin(wide, high);
    if (palette) this.sheet.palette(palette);
  }

  /** Points on the sheet, with displacements or without: three numbers each, and how far they move. */
  placed(factor) {
    const known = this.places.get(factor);
    if (known) return known;
    const { way: [a, b, c], from, tables, common } = this, { data: rest } = tables.rest, { data: moved } = tables.moved;
    const at = new Float64Array(rest.length), sizes = new Float64Array(rest.length / 3);
    for (let i = 0, n = 0; i < rest.length; i += 3, n++) {
      const [u, v, w] = [moved[i], moved[i + 1], moved[i + 2]];
      const [x, y, z] = [rest[i] + factor * u, rest[i + 1] + factor * v, rest[i + 2] + factor * w];
      at[i] = a[0] * x + a[1] * y + a[2] * z + from[0];
      at[i + 1] = b[0] * x + b[1] * y + b[2] * z + from[1];
      at[i + 2] = c[0] * x + c[1] * y + c[2] * z + from[2];
      sizes[n] = Math.min(1, Math.sqrt(u * u + v * v + w * w) / common.most);
    }
    const places = { at, sizes };
    this.places.set(factor, places);
    return places;
  }

  /** One sort of drawing with what all share and what it has beside; over: in front of all that is there. */
  use(name, set, batch, over = false) {
    const all = { ...FREE, ...this.common, ...set };
    const places = this.placed(all.factor);
    const { sheet, looks, tables } = this, toward = all.bias * all.pixel * Math.hypot(...this.way[2]);
    Object.assign(sheet, { over, toward, width: this.fine * (all.width ?? 1), dash: this.fine * all.dash });
    // By points, by marks, or by neither: where the value of one stands.
    const values = all.tint === 1 ? places.sizes : all.tint === 2 ? tables.values.data : NONE;
    const which = all.tint === 1 ? (point) => point : all.tint === 2 ? (_, mark) => mark : () => 0;
    const color = all.over[0] < 0 ? (mark) => looks[mark] : ((same) => (mark) => (looks[mark] ? same : 0))(packed(all.over));
    DRAW[name](sheet, batch, { ...all, at: places.at, values, which, color, way: this.way, from: this.from, fine: this.fine });
  }

  lay(c, width, height) {
    const { canvas, sheet } = this;
    if (canvas.width !== sheet.wide) canvas.width = sheet.wide;
    if (canvas.height !== sheet.high) canvas.height = sheet.high;
    canvas.getContext("2d").putImageData(sheet.image(), 0, 0);
    c.drawImage(canvas, 0, 0, width, height);
  }
}

/** Faces of a mesh whose corners are placed, with a value each. */
function mesh(sheet, { faces, firsts }, at, values, color, facing) {
  for (let i = 0; i < firsts.length; i++) {
    const first = firsts[i], next = i + 1 < firsts.length ? firsts[i + 1] : faces.length;
    sheet.face(at, values, faces, first, next - first, color, facing, true);
  }
}

/** Vectors on the sheet, three numbers each; scale: of their length. */
function turned(vectors, way, scale = 1) {
  const out = new Float64Array(vectors.length);
  for (let i = 0; i < vectors.length; i += 3) {
    for (let k = 0; k < 3; k++) out[i + k] = scale * (way[k][0] * vectors[i] + way[k][1] * vectors[i + 1] + way[k][2] * vectors[i + 2]);
  }
  return out;
}

/** No value. */
const NONE = Float64Array.of(-1);

/** A triangle. */
const THREE = Int32Array.of(0, 1, 2);

/** What the programs of shaders.js do. */
const DRAW = {
  MEMBER(sheet, batch, { at, way, color, values, which }) {
    const { mesh: corners, side, ends, marks, instances } = batch, offsets = turned(corners, way), here = new Float64Array(corners.length), own = new Float64Array(side.length);
    const out = normalOf(offsets, side.length / 2);
    for (let i = 0; i < instances; i++) {
      const mark = marks[i], paint = color(mark);
      if (!paint) continue;
      const first = ends[2 * i], last = ends[2 * i + 1];
      for (let v = 0, k = 0; v < side.length; v++, k += 3) {
        const point = side[v] ? last : first;
        here[k] = at[3 * point] + offsets[k];
        here[k + 1] = at[3 * point + 1] + offsets[k + 1];
        here[k + 2] = at[3 * point + 2] + offsets[k + 2];
        own[v] = values[which(point, mark)];
      }
      // The outline turns about the member one way or the other.
      let along = 0;
      for (let k = 0; k < 3; k++) along += out[k] * (at[3 * last + k] - at[3 * first + k]);
      mesh(sheet, batch, here, own, paint, along > 0 ? 1 : along < 0 ? -1 : 0);
    }
  },

  LINE(sheet, { ends, marks, instances }, { at, color, values, which }) {
    for (let i = 0; i < instances; i++) {
      const mark = marks[i], paint = color(mark), p = ends[2 * i], q = ends[2 * i + 1];
      if (paint) sheet.line(at, p, q, values, which(p, mark), which(q, mark), paint);
    }
  },

  FACE(sheet, { mesh: points, marks }, { at, color, values, which }) {
    const here = new Float64Array(9), own = new Float64Array(3);
    for (let i = 0; i < points.length; i += 3) {
      const paint = color(marks[i]);
      if (!paint) continue;
      for (let v = 0; v < 3; v++) {
        for (let k = 0; k < 3; k++) here[3 * v + k] = at[3 * points[i + v] + k];
        own[v] = values[which(points[i + v], marks[i])];
      }
      sheet.face(here, own, THREE, 0, 3, paint, 0, true);
    }
  },

  SYMBOL(sheet, batch, { at, way, color, values, which, large, pixel }) {
    const { mesh: corners, axes, ends, marks, instances } = batch;
    const here = new Float64Array(corners.length), own = new Float64Array(corners.length / 3), offsets = new Float64Array(corners.length);
    let of = "";
    for (let i = 0; i < instances; i++) {
      const paint = color(marks[i]);
      if (!paint) continue;
      const axis = axes.subarray(3 * i, 3 * i + 3), p = 3 * ends[2 * i], q = 3 * ends[2 * i + 1];
      // Those beside each other mostly stand the same way.
      if (of !== axis.join()) {
        of = axis.join();
        const across = cross(Math.abs(axis[2]) < 0.9 ? [0, 0, 1] : [1, 0, 0], axis), long = Math.hypot(...across);
        const second = across.map((x) => x / long), frame = turned(Float64Array.from([...axis, ...second, ...cross(axis, second)]), way, large * pixel);
        for (let v = 0; v < corners.length; v += 3) {
          for (let k = 0; k < 3; k++) offsets[v + k] = corners[v] * frame[k] + corners[v + 1] * frame[3 + k] + corners[v + 2] * frame[6 + k];
        }
      }
      for (let v = 0; v < corners.length; v += 3) for (let k = 0; k < 3; k++) here[v + k] = 0.5 * (at[p + k] + at[q + k]) + offsets[v + k];
      mesh(sheet, batch, here, own.fill(values[which(ends[2 * i], marks[i])]), paint, -1);
    }
  },

  DOT(sheet, { mesh: points, marks }, { at, color, values, which, large, fine }) {
    const half = (fine * large) / 2, here = new Float64Array(6);
    sheet.width = 2 * half;
    for (let i = 0; i < points.length; i++) {
      const paint = color(marks[i]), p = 3 * points[i], v = which(points[i], marks[i]);
      if (!paint) continue;
      here.set([at[p] - half, at[p + 1], at[p + 2], at[p] + half, at[p + 1], at[p + 2]]);
      sheet.line(here, 0, 1, values, v, v, paint);
    }
  },

  GROUND(sheet, _, { way, from, low, high, over }) {
    const at = turned(Float64Array.from([0, 1, 2, 3].flatMap((i) => [i & 1 ? high[0] : low[0], i & 2 ? high[1] : low[1], low[2]])), way);
    at.forEach((_, i) => { at[i] += from[i % 3]; });
    sheet.face(at, new Float64Array(4).fill(-1), Int32Array.of(0, 1, 3, 2), 0, 4, packed(over), 0, false);
  },
};

/** Across the first n of placed corners, as they go round. */
function normalOf(at, n) {
  const out = [0, 0, 0];
  for (let i = 0; i < n; i++) {
    const j = (i + 1) % n;
    for (let k = 0; k < 3; k++) out[k] += at[3 * i + ((k + 1) % 3)] * at[3 * j + ((k + 2) % 3)] - at[3 * i + ((k + 2) % 3)] * at[3 * j + ((k + 1) % 3)];
  }
  return out;
}
