// Small helpers of all scripts of a page.

const root = document.documentElement;
root.classList.add("js");
window.addEventListener("error", (e) => { root.dataset.error = e.message; });

/** An element with attributes and children; texts stay texts. */
function make(name, attributes = {}, ...children) {
  const e = document.createElement(name);
  for (const [key, value] of Object.entries(attributes)) {
    if (key in e && typeof value !== "string") e[key] = value;
    else e.setAttribute(key, value);
  }
  e.append(...children);
  return e;
}

/** The same for SVG. */
function svg(name, attributes = {}, ...children) {
  const e = document.createElementNS("http://www.w3.org/2000/svg", name);
  for (const [key, value] of Object.entries(attributes)) e.setAttribute(key, value);
  e.append(...children);
  return e;
}

/** True for values that never fall; gaps do not count. */
function rises(values) {
  // Neither above nor equal: below, or no number.
  for (let i = 0, last = -Infinity; i < values.length; i++) {
    if (!(values[i] >= last)) return false;
    last = values[i];
  }
  return values.length > 1;
}

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
    if (Number.isFinite(x)) {
      if (x < low) low = x;
      if (x > high) high = x;
    }
  }
  return [low, high];
}

/** A number with four digits for reading. */
function number(x) {
  if (x === 0) return "0";
  if (!Number.isFinite(x)) return "–";
  const size = Math.abs(x);
  const text = size >= 1e-3 && size < 1e6 ? x.toPrecision(4) : x.toExponential(3);
  const plain = text.includes("e") && size < 1e6 && size >= 1e-3 ? String(Math.round(x)) : text;
  return plain.replace(/(\.\d*?)0+(?=$|e)/, "$1").replace(/\.(?=$|e)/, "").replace("e+", "e").replaceAll("-", "−");
}
