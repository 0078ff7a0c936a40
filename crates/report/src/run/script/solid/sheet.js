// Lines and faces in an array of pixels, the nearest in front: what a graphics processor would do.

/** Colours of values in so many steps, in so many steps of light. */
const [STEPS, LIGHTS] = [256, 32];

class Sheet {
  constructor() {
    [this.wide, this.high, this.room] = [0, 0, 0];
    // In front of all that is there; so much nearer than they are, pixels; and of lines: so wide, pieces so long, pixels.
    [this.over, this.toward, this.width, this.dash] = [false, 0, 1, 0];
    this.ends = [new Float64Array(0), new Float64Array(0)];
    this.shades = new Uint32Array(STEPS * LIGHTS);
  }

  /** Empties it, in another size as well. */
  begin(wide, high) {
    Object.assign(this, { wide, high });
    if (high > this.ends[0].length) this.ends = [new Float64Array(high), new Float64Array(high)];
    const count = wide * high;
    if (count > this.room) {
      this.room = count;
      this.bytes = new Uint8ClampedArray(4 * count);
      [this.colors, this.depths] = [new Uint32Array(this.bytes.buffer), new Float32Array(count)];
    }
    this.colors.fill(0, 0, count);
    this.depths.fill(-Infinity, 0, count);
  }

  /** The colours of values: six, three numbers to 1 each. */
  palette(colors) {
    if (this.of === colors.join()) return;
    this.of = colors.join();
    for (let i = 0; i < STEPS; i++) {
      const x = (5 * i) / (STEPS - 1), from = Math.min(Math.floor(x), 4);
      const color = [0, 1, 2].map((k) => colors[3 * from + k] + (x - from) * (colors[3 * from + 3 + k] - colors[3 * from + k]));
      for (let j = 0; j < LIGHTS; j++) this.shades[j * STEPS + i] = packed(color, light(j));
    }
  }

  image() { return new ImageData(this.bytes.subarray(0, 4 * this.wide * this.high), this.wide, this.high); }

  /** Between two of the places [pixels to the right and down, depth towards the eye]; values: where they have one from 0 to 1, it
   *  is the colour. Numbers stand in arrays: as arguments they would be put into the heap, each of them. */
  line(at, p, q, values, v, w, color) {
    const { wide, high, colors, depths, shades, over, width, dash } = this, ax = at[3 * p], ay = at[3 * p + 1], bx = at[3 * q], by = at[3 * q + 1];
    const az = at[3 * p + 2] + this.toward, bz = at[3 * q + 2] + this.toward, av = values[v], bv = values[w], valued = av >= 0;
    if ((ax < -width && bx < -width) || (ay < -width && by < -width) || (ax > wide + width && bx > wide + width) || (ay > high + width && by > high + width)) return;
    const dx = bx - ax, dy = by - ay, steep = Math.abs(dy) > Math.abs(dx), far = steep ? dy : dx, size = Math.abs(far);
    if (!(size > 0)) return;
    // Pixel by pixel along the longer side, as far as the sheet reaches.
    const way = far > 0 ? 1 : -1, start = steep ? ay : ax, last = (steep ? high : wide) - 1;
    const from = Math.max(0, Math.ceil((way > 0 ? -start : start - last) - 1)), to = Math.min(Math.ceil(size), (way > 0 ? last - start : start) + 1);
    const long = Math.hypot(dx, dy) / size, thick = Math.max(1, Math.round(width * long)), side = thick / 2;
    const limit = steep ? wide : high, step = steep ? 1 : wide, row = steep ? wide : 1;
    const across = steep ? ax : ay, slope = (steep ? dx : dy) / size, rise = (bz - az) / size, more = (bv - av) / size;
    for (let i = from; i <= to; i++) {
      if (dash > 0 && (i * long) % (2 * dash) > dash) continue;
      const major = Math.floor(start + way * i);
      if (major < 0 || major > last) continue;
      const first = Math.round(across + slope * i - side), z = az + rise * i, end = Math.min(first + thick, limit);
      const paint = valued ? shades[BRIGHT + shadeOf(av + more * i)] : color;
      for (let j = Math.max(first, 0); j < end; j++) {
        const here = major * row + j * step;
        if (over || z >= depths[here]) { depths[here] = z; colors[here] = paint; }
      }
    }
  }

  /** Within `count` of the corners, from one of them on, that go round a flat face without a bend inwards. shaded: by the light on
   *  it; facing: 1 or −1 where only that side is seen, 0 for both. */
  face(at, values, corners, first, count, color, facing, shaded) {
    const { wide, high, colors, depths, shades, over, ends: [lefts, rights] } = this;
    const a = corners[first], b = corners[first + 1], c = corners[first + 2], ax = at[3 * a], ay = at[3 * a + 1], az = at[3 * a + 2] + this.toward;
    const ux = at[3 * b] - ax, uy = at[3 * b + 1] - ay, vx = at[3 * c] - ax, vy = at[3 * c + 1] - ay, nz = ux * vy - uy * vx;
    if (nz === 0 || nz * facing < 0) return;
    // Where rows begin and end: sides that go down lie right of those that go up where it goes round with the clock.
    let top = high, bottom = 0;
    for (let i = 0; i < count; i++) {
      const p = corners[first + i], q = corners[first + (i + 1 < count ? i + 1 : 0)], py = at[3 * p + 1], qy = at[3 * q + 1];
      const down = qy > py, from = Math.max(0, Math.ceil((down ? py : qy) - 0.5)), to = Math.min(high, Math.ceil((down ? qy : py) - 0.5));
      if (from >= to) continue;
      const side = down === nz > 0 ? rights : lefts, slope = (at[3 * q] - at[3 * p]) / (qy - py);
      let x = at[3 * p] + (from + 0.5 - py) * slope - 0.5;
      for (let y = from; y < to; y++, x += slope) side[y] = x;
      if (from < top) top = from;
      if (to > bottom) bottom = to;
    }
    if (top >= bottom) return;
    // Depth and value are planes over the sheet.
    const uz = at[3 * b + 2] + this.toward - az, vz = at[3 * c + 2] + this.toward - az, nx = uy * vz - uz * vy, ny = uz * vx - ux * vz;
    const zx = -nx / nz, zy = -ny / nz;
    let level = LIGHTS - 1;
    if (shaded) {
      // Down is up on the sheet.
      const bright = Math.abs(-0.34 * nx - 0.82 * ny + 0.46 * nz) / Math.sqrt(nx * nx + ny * ny + nz * nz);
      level = Math.min(LIGHTS - 1, (bright * (LIGHTS - 1) + 0.5) | 0);
    }
    const av = values[a], valued = av >= 0, paint = shaded && !valued ? dimmed(color, level) : color, base = level * STEPS;
    const pu = values[b] - av, pv = values[c] - av, gx = (pu * vy - pv * uy) / nz, gy = (ux * pv - vx * pu) / nz;
    for (let y = top; y < bottom; y++) {
      const from = Math.max(0, Math.ceil(lefts[y])), to = Math.min(wide, Math.ceil(rights[y])), row = y * wide;
      let z = az + zx * (from + 0.5 - ax) + zy * (y + 0.5 - ay);
      if (valued) {
        let value = av + gx * (from + 0.5 - ax) + gy * (y + 0.5 - ay);
        for (let i = row + from; i < row + to; i++, z += zx, value += gx) {
          if (over || z >= depths[i]) { depths[i] = z; colors[i] = shades[base + shadeOf(value)]; }
        }
      } else {
        for (let i = row + from; i < row + to; i++, z += zx) if (over || z >= depths[i]) { depths[i] = z; colors[i] = paint; }
      }
    }
  }
}

/** Where the colour of a value from 0 to 1 stands. */
const shadeOf = (value) => (value <= 0 ? 0 : value >= 1 ? STEPS - 1 : (value * (STEPS - 1) + 0.5) | 0);

/** Where colours in full light begin. */
const BRIGHT = (LIGHTS - 1) * STEPS;

/** How bright a face is at a step of light. */
const light = (level) => 0.52 + 0.5 * (level / (LIGHTS - 1));

/** Three numbers to 1 as one pixel, red in the lowest byte, as all machines of today have it. */
function packed(color, by = 1) {
  const [r, g, b] = color.map((x) => Math.min(255, Math.round(255 * x * by)));
  return ((255 << 24) | (b << 16) | (g << 8) | r) >>> 0;
}

/** A pixel in less light. */
function dimmed(color, level) {
  const by = light(level);
  const r = Math.min(255, (color & 255) * by), g = Math.min(255, ((color >> 8) & 255) * by), b = Math.min(255, ((color >> 16) & 255) * by);
  return ((255 << 24) | (b << 16) | (g << 8) | r) >>> 0;
}
