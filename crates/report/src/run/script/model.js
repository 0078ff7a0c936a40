// The model as all stages have it: its marks, what can be hidden, colours, ways of looking.

const FONT = "12px system-ui, sans-serif";
const data = JSON.parse(document.getElementById("data").textContent);
const picture = data.picture;
const POINTS = picture.points.length;
/** Lines and symbols of large models are drawn thinner and smaller. */
const DENSE = picture.lines.length > 800;

/** `beam 1 (Beam)`: the kind. */
const kindOf = (name) => /\(([^()]*)\)$/.exec(name)?.[1] ?? "";
for (const mark of [...picture.lines, ...picture.faces]) mark.kind = kindOf(mark.name);

/** Groups of the model that have something to show, each with its marks. */
const GROUPS = picture.groups.map((g) => {
  const of = (all, these) => these.map((i) => all[i]);
  const marks = [...of(picture.lines, g.lines), ...of(picture.faces, g.faces), ...of(picture.links, g.links), ...of(picture.nodes, g.nodes)];
  return { name: g.name, marks };
}).filter((g) => g.marks.length > 0);
for (const group of GROUPS) for (const mark of group.marks) (mark.groups ??= []).push(group);

/** What can be hidden: kinds of members, bodies and links, as often as they are. */
const KINDS = (() => {
  const count = new Map();
  // The faces of a body and its link are one thing.
  const seen = new Set();
  for (const m of [...picture.lines, ...picture.faces, ...picture.links]) {
    const name = kindOf(m.name) === m.kind ? m.name : `${m.name} (${m.kind})`;
    if (seen.has(name)) continue;
    seen.add(name);
    if (m.kind) count.set(m.kind, (count.get(m.kind) ?? 0) + 1);
  }
  return count;
})();

/** Colours in light and dark, read once a drawing. The palette is of even steps in lightness as well, from little to much. */
const SHADES = {
  light: { paper: "#ffffff", ink: "#333333", link: "#d55e00", tie: "#999999", ghost: "#c9c9c9", ground: "#e9e9e9", edge: "#777777", found: "#aa003c",
    solid: "#a9cde6", member: "#3b8fc4", contour: "#1f5f8b", support: "#6b7178", palette: ["#d8e219", "#7ad151", "#22a884", "#2a788e", "#414487", "#440154"] },
  dark: { paper: "#16191d", ink: "#d5dadf", link: "#f2863a", tie: "#7c858e", ghost: "#454d55", ground: "#252a30", edge: "#98a0a8", found: "#ff7aa2",
    solid: "#33658c", member: "#4aa5e6", contour: "#86bce8", support: "#98a0a8", palette: ["#46327e", "#365c8d", "#277f8e", "#1fa187", "#8fd744", "#fde725"] },
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

/** A name beside a point where it covers no other: right or left, above or below. */
function write(c, taken, text, x, y) {
  const w = c.measureText(text).width;
  for (const [dx, dy] of [[5, -5], [-5 - w, -5], [5, 15], [-5 - w, 15]]) {
    const box = [x + dx, y + dy - 11, x + dx + w, y + dy];
    if (taken.some((b) => b[2] >= box[0] && box[2] >= b[0] && b[3] >= box[1] && box[3] >= b[1])) continue;
    taken.push(box);
    // Over members it is read by what is left free around it.
    c.lineWidth = 3;
    c.lineJoin = "round";
    c.strokeStyle = `${(darkness.matches ? SHADES.dark : SHADES.light).paper}b3`;
    c.strokeText(text, x + dx, y + dy);
    c.fillText(text, x + dx, y + dy);
    return;
  }
}

const middleOf = (points) => [0, 1].map((i) => points.reduce((sum, p) => sum + p[i], 0) / points.length);

/** A canvas as sharp as the screen; returns its context in CSS pixels. */
function sharpen(canvas, width, height) {
  const ratio = window.devicePixelRatio || 1;
  const [wide, high] = [Math.round(width * ratio), Math.round(height * ratio)];
  // A new size empties it, which takes its time.
  if (canvas.width !== wide) canvas.width = wide;
  if (canvas.height !== high) canvas.height = high;
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
