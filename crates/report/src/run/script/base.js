// Data of the page, the time that all figures share, small helpers.

const root = document.documentElement;
window.addEventListener("error", (e) => { root.dataset.error = e.message; });

const data = JSON.parse(document.getElementById("data").textContent);

/** Whole multiples of a step as numbers. */
const unpack = (numbers, factor = 1) =>
  Float64Array.from(numbers.n, (n) => n * numbers.step * factor);

/** An element with attributes and children. */
function make(name, attributes = {}, ...children) {
  const e = document.createElement(name);
  for (const [key, value] of Object.entries(attributes)) {
    if (key in e && typeof value !== "string") e[key] = value;
    else e.setAttribute(key, value);
  }
  e.append(...children);
  return e;
}

/** The moment that figures and model show; null: none. */
const clock = {
  t: null,
  listeners: [],
  set(t) {
    if (t === this.t) return;
    this.t = t;
    for (const show of this.listeners) show(t);
  },
};

/** The part of the time that figures show, the same for all; null: all. */
const span = {
  range: null,
  listeners: [],
  set(range) {
    this.range = range;
    for (const show of this.listeners) show();
  },
};

/** Index of the last value not above x, in rising values; 0 at least. */
function before(values, x) {
  let low = 0, high = values.length - 1;
  while (low < high) {
    const middle = (low + high + 1) >> 1;
    if (values[middle] <= x) low = middle; else high = middle - 1;
  }
  return low;
}

/** Value at x, linear between points. */
function valueAt(xs, ys, x) {
  const i = before(xs, x);
  if (i + 1 >= xs.length || xs[i + 1] === xs[i]) return ys[i];
  const share = Math.min(Math.max((x - xs[i]) / (xs[i + 1] - xs[i]), 0), 1);
  return ys[i] + share * (ys[i + 1] - ys[i]);
}

/** Smallest and largest finite value. */
function extremes(...lists) {
  let low = Infinity, high = -Infinity;
  for (const list of lists) for (const x of list) {
    if (x < low) low = x;
    if (x > high) high = x;
  }
  return low <= high ? [low, high] : [0, 1];
}

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
