// Axes: ends, ticks, numbers; as the still figures have them.

/** An axis has so many ticks at least, where it does not count. */
const TICKS = 3;

/** Ends of an axis for a range of values; exact: without room. */
function ends(axis, [low, high], exact = false) {
  if (axis.range) return axis.range;
  if (axis.log) {
    if (!(low > 0)) low = Math.min(high / 10, 1);
    if (!(high > 0) || !Number.isFinite(low)) return [0.1, 1];
    const room = (Math.max(high / low, 1.26)) ** (exact ? 0 : 0.04);
    return high > low || !exact ? [low / room, high * room] : [low / 1.2, high * 1.2];
  }
  if (!(low <= high)) return [0, 1];
  const size = Math.max(Math.abs(low), Math.abs(high));
  let room = exact ? 0 : 0.06 * (high - low);
  if (high - low < 1e-3 * size) room = 0.1 * size;
  if (size === 0) room = 0.5;
  return [low - room, high + room];
}

/** Ends at which a unit is as long on both axes. */
function square(x, y, w, h) {
  const unit = Math.max((x[1] - x[0]) / w, (y[1] - y[0]) / h);
  const about = ([a, b], px) => [(a + b - unit * px) / 2, (a + b + unit * px) / 2];
  return { x: about(x, w), y: about(y, h) };
}

/** From values to pixels and back. */
function placer(axis, [from, to], start, length) {
  if (!axis.log) {
    return { to: (v) => start + ((v - from) / (to - from)) * length, from: (p) => from + ((p - start) / length) * (to - from) };
  }
  const [a, b] = [Math.log10(from), Math.log10(to)];
  return {
    to: (v) => (v > 0 ? start + ((Math.log10(v) - a) / (b - a)) * length : NaN),
    from: (p) => 10 ** (a + ((p - start) / length) * (b - a)),
  };
}

/** Values of ticks and their texts: about so many as there is room for. */
function ticks(axis, range, room) {
  return axis.log ? decades(range, room) : even(axis.whole, range, room);
}

function even(whole, [low, high], room) {
  const raw = (high - low) / Math.max(room, TICKS);
  if (!(raw > 0)) return [];
  const decade = 10 ** Math.floor(Math.log10(raw));
  let steps = [0.05, 0.1, 0.2, 0.5, 1, 2, 5, 10].map((k) => k * decade);
  const first = steps.findIndex((s) => s >= raw * 0.999);
  steps = steps.slice(0, first < 0 ? steps.length : first + 1).reverse();
  let values = [];
  for (let step of steps) {
    if (whole) step = Math.max(Math.round(step), 1);
    values = [];
    for (let i = Math.ceil(low / step - 1e-9); i * step <= high + 1e-9 * step && values.length < 200; i++) values.push(i * step);
    if (values.length >= TICKS || whole) {
      const decimals = Math.max(0, -Math.floor(Math.log10(step) + 1e-9));
      return values.map((v) => [v, text(v, high - low, decimals)]);
    }
  }
  return values.map((v) => [v, number(v)]);
}

/** A number beside an even axis: with the decimals of its step, in one power of a thousand where these are many. */
function text(x, span, decimals) {
  if (Math.abs(x) < 1e-9 * span) return "0";
  if (decimals <= 4 && Math.max(Math.abs(x), span) < 1e6) return x.toFixed(decimals).replace("-", "−");
  const power = 3 * Math.floor(Math.log10(span) / 3);
  const digits = Math.min(Math.max(decimals + power, 0), 17);
  return `${(x / 10 ** power).toFixed(digits)}e${power}`.replaceAll("-", "−");
}

function decades([low, high], room) {
  const of = (within) => {
    const found = [];
    for (let power = Math.floor(Math.log10(low)); power <= Math.log10(high); power++) {
      for (const k of within) found.push(Number(`${k}e${power}`));
    }
    return found.filter((v) => v >= low * (1 - 1e-9) && v <= high * (1 + 1e-9));
  };
  const whole = of([1]), every = Math.max(Math.ceil(whole.length / Math.max(room, TICKS)), 1);
  let found = whole.filter((_, i) => i % every === 0);
  for (const finer of [[1, 2, 5], [1, 1.5, 2, 3, 4, 5, 6, 8]]) if (found.length < TICKS) found = of(finer);
  if (found.length < TICKS) return even(false, [low, high], room).filter(([v]) => v > 0);
  return found.map((v) => [v, number(v)]);
}
