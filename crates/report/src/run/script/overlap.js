// Whether bodies pass through each other, or through the ground, where displacements are drawn larger than they are.

/** Bodies shrink by this share first: those that touch do not pass through each other. */
const PLAY = 0.02;

/** Points and faces of the bodies that move by themselves. */
const BODIES = (() => {
  const all = new Map();
  for (const [corners, face] of SOLIDS) {
    const { name } = picture.faces[face];
    if (!all.has(name)) all.set(name, { name: name.replace(/ \([^()]*\)$/, ""), faces: [], points: new Set() });
    all.get(name).faces.push(corners);
    for (const p of corners) all.get(name).points.add(p);
  }
  return [...all.values()];
})();

/** Its corners with displacements, a little smaller, and the directions that may part it from others. */
function placed(body, u) {
  const at = new Map([...body.points].map((p) => [p, picture.points[p].map((x, k) => x + u[3 * p + k])]));
  const middle = [0, 1, 2].map((k) => [...at.values()].reduce((sum, p) => sum + p[k], 0) / at.size);
  const corners = [...at.values()].map((p) => p.map((x, k) => middle[k] + (1 - PLAY) * (x - middle[k])));
  const ways = body.faces.flatMap((face) => {
    const p = face.map((i) => at.get(i));
    if (picture.plane) {
      const out = directions(picture.plane)[2];
      return p.map((a, i) => cross(p[(i + 1) % p.length].map((x, k) => x - a[k]), out));
    }
    const [a, b, c] = [p[0], p[1], p.at(-1)];
    return [cross(b.map((x, k) => x - a[k]), c.map((x, k) => x - a[k]))];
  });
  return { corners, ways, middle };
}

const cross = (a, b) => [0, 1, 2].map((k) => a[(k + 1) % 3] * b[(k + 2) % 3] - a[(k + 2) % 3] * b[(k + 1) % 3]);

/** No direction parts them: convex bodies without one lie in each other, or nearly so at their edges. */
function overlap(a, b) {
  const between = a.middle.map((x, k) => b.middle[k] - x);
  return ![...a.ways, ...b.ways, between].some((way) => {
    const [a0, a1] = extremes(a.corners.map((p) => along(p, way))), [b0, b1] = extremes(b.corners.map((p) => along(p, way)));
    return a1 < b0 || b1 < a0;
  });
}

/** Pairs of bodies that lie in each other at a time and a scale, and bodies in the ground, by name. */
function passing(t, factor) {
  const u = displaced(t, factor), all = BODIES.map((b) => placed(b, u)), out = new Set();
  all.forEach((a, i) => {
    for (let j = i + 1; j < all.length; j++) if (overlap(a, all[j])) out.add(`${BODIES[i].name} and ${BODIES[j].name}`);
    if (picture.ground === null) return;
    const [low, high] = extremes(a.corners.map((p) => p[2]));
    if (low < picture.ground - PLAY * (high - low)) out.add(`${BODIES[i].name} and the ground`);
  });
  return out;
}

/** The same over all times, at most so many of them: where and when first; null: nowhere that is not so to scale as well. */
function passes(factor) {
  if (!BODIES.length || factor <= 1) return null;
  const stride = Math.ceil((frames.t.length * BODIES.length) / 600);
  for (let i = 0; i < frames.t.length; i += stride) {
    const t = frames.t[i], now = passing(t, factor);
    if (!now.size) continue;
    const scaled = passing(t, 1), more = [...now].find((pair) => !scaled.has(pair));
    if (more) return { pair: more, t };
  }
  return null;
}
