// Faces: of polygons, of bodies, and of the symbols of links and supports.

/** A polygon in space as triangles, each three of its corners, by cutting off ears; it may be bent inwards. */
function triangles(corners) {
  const n = corners.length, out = [];
  const normal = [0, 0, 0];
  for (let i = 0; i < n; i++) {
    const a = corners[i], b = corners[(i + 1) % n];
    for (let k = 0; k < 3; k++) normal[k] += a[(k + 1) % 3] * b[(k + 2) % 3] - a[(k + 2) % 3] * b[(k + 1) % 3];
  }
  const turn = (a, b, c) => [0, 1, 2].reduce((sum, k) => {
    const [i, j] = [(k + 1) % 3, (k + 2) % 3];
    return sum + normal[k] * ((b[i] - a[i]) * (c[j] - a[j]) - (b[j] - a[j]) * (c[i] - a[i]));
  }, 0);
  const left = [...corners.keys()];
  while (left.length > 3) {
    const ear = left.findIndex((_, i) => {
      const [p, q, r] = [left.at(i - 1), left[i], left[(i + 1) % left.length]];
      const [a, b, c] = [corners[p], corners[q], corners[r]];
      if (turn(a, b, c) <= 0) return false;
      return !left.some((s) => s !== p && s !== q && s !== r &&
        turn(a, b, corners[s]) >= 0 && turn(b, c, corners[s]) >= 0 && turn(c, a, corners[s]) >= 0);
    });
    // Of a polygon without an ear (a line, a knot) any corner will do.
    const i = Math.max(ear, 0);
    out.push([left.at(i - 1), left[i], left[(i + 1) % left.length]]);
    left.splice(i, 1);
  }
  out.push(left);
  return out;
}

/** All faces of bodies, [corners as points, index of a face of the picture]: those of the picture, and the sides between two
 * of the same body with as many corners, of which an edge joins the first ones. */
const SOLIDS = (() => {
  const joined = new Set(picture.lines.filter((l) => l.what === "edge").map((l) => l.ends.join()));
  const out = picture.faces.map((f, i) => [f.corners, i]);
  for (const [i, a] of picture.faces.entries()) {
    const b = picture.faces[i + 1];
    if (!b || b.name !== a.name || b.corners.length !== a.corners.length) continue;
    if (!joined.has(`${a.corners[0]},${b.corners[0]}`)) continue;
    a.corners.forEach((p, k) => {
      const next = (k + 1) % a.corners.length;
      out.push([[p, a.corners[next], b.corners[next], b.corners[k]], i]);
    });
  }
  return out;
})();

/** A piece of a cone along the first axis, with n sides: corners and faces, which go round as seen from outside. */
function frustum(n, r0, x0, r1, x1) {
  const ring = (r, x) => Array.from({ length: n }, (_, i) => {
    const a = (2 * Math.PI * (i + 0.5)) / n;
    return [x, r * Math.cos(a), r * Math.sin(a)];
  });
  const round = [...Array(n).keys()], sides = round.map((i) => { const j = (i + 1) % n; return [i, j, n + j, n + i]; });
  return { corners: [...ring(r0, x0), ...ring(r1, x1)], faces: [...sides, [...round].reverse(), round.map((i) => i + n)] };
}

function together(...parts) {
  const corners = [], faces = [];
  for (const part of parts) {
    faces.push(...part.faces.map((f) => f.map((i) => i + corners.length)));
    corners.push(...part.corners);
  }
  return { corners, faces };
}

/** A coil about the first axis. */
function coil() {
  const steps = 48, corners = [], faces = [];
  for (let i = 0; i <= steps; i++) {
    const a = (8 * Math.PI * i) / steps, x = -1 + (2 * i) / steps;
    for (const [dr, dx] of [[-0.09, -0.09], [-0.09, 0.09], [0.09, 0.09], [0.09, -0.09]]) {
      corners.push([x + dx, (0.6 + dr) * Math.cos(a), (0.6 + dr) * Math.sin(a)]);
    }
    if (i === steps) continue;
    for (let k = 0; k < 4; k++) {
      const a0 = 4 * i + k, b0 = 4 * i + ((k + 1) % 4);
      faces.push([a0, b0, b0 + 4, a0 + 4]);
    }
  }
  return { corners, faces };
}

/** Symbols along the axis of a link, from −1 to 1; those of supports hang below their node. */
const SHAPES_OF = {
  contact: together(frustum(4, 1.1, -0.55, 1.1, -0.2), frustum(4, 1.1, 0.2, 1.1, 0.55)),
  dashpot: together(frustum(12, 0.55, -1, 0.55, 0.3), frustum(8, 0.2, 0.3, 0.2, 1)),
  spring: coil(),
  hysteretic: together(frustum(14, 1, -0.8, 1, -0.4), frustum(14, 0.7, -0.4, 0.7, 0.4), frustum(14, 1, 0.4, 1, 0.8)),
  fixed: frustum(4, 1.3, -1.3, 1.3, 0),
  pinned: frustum(4, 1.2, -1.7, 0, 0),
  guided: together(frustum(4, 1, -1.2, 0, 0), frustum(4, 1.2, -1.75, 1.2, -1.45)),
};

/** How a node is held: everywhere, in all directions without rotations, in some. */
function held(node) {
  const names = node.fixed.split(" ");
  const count = (letter) => names.filter((n) => n.toLowerCase().startsWith(letter)).length;
  const [moves, turns] = picture.plane ? [2, 1] : [3, 3];
  if (count("u") < moves) return "guided";
  return count("r") < turns ? "pinned" : "fixed";
}
