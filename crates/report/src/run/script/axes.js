// Axes: ends, ticks, numbers.

/** A number with four digits for reading. */
function number(x) {
  if (x === 0) return "0";
  const size = Math.abs(x);
  const text = size >= 1e-3 && size < 1e6 ? x.toPrecision(4) : x.toExponential(3);
  return text.replace(/(\.\d*?)0+(?=$|e)/, "$1").replace(/\.(?=$|e)/, "").replace("e+", "e").replaceAll("-", "−");
}

/** Room around a range of values; a constant gets a tenth of itself. */
function roomy([low, high]) {
  const size = Math.max(Math.abs(low), Math.abs(high));
  let room = 0.06 * (high - low);
  if (high - low < 1e-3 * size) room = 0.1 * size;
  if (size === 0) room = 0.5;
  return [low - room, high + room];
}

/** About so many round numbers in a range, and how many decimals they need. */
function ticks([low, high], count) {
  const raw = (high - low) / count;
  const decade = 10 ** Math.floor(Math.log10(raw));
  const step = [1, 2, 5, 10].map((k) => k * decade).find((s) => s >= raw * 0.999);
  const decimals = Math.max(0, -Math.floor(Math.log10(step) + 1e-9));
  const found = [];
  for (let i = Math.ceil(low / step - 1e-9); i * step <= high + 1e-9 * step; i++) {
    found.push(i * step);
  }
  const write = (x) => {
    const big = Math.max(Math.abs(low), Math.abs(high));
    // Small numbers with many zeros have no room beside the axis; of close ones all digits are wanted.
    if (decimals > 5 || (decimals > 3 && big < 0.01) || big >= 1e6) return number(Math.abs(x) < 1e-9 * big ? 0 : x);
    return (Math.abs(x) < 1e-9 * big ? 0 : x).toFixed(decimals).replace("-", "−");
  };
  return { values: found, write };
}

/** Round numbers along a logarithmic axis of some pixels: 1, 2, 5 of every decade, or 1 where these crowd. */
function decades([low, high], width) {
  const span = Math.log10(high / low);
  // Zoomed in far, even steps are as good.
  if (span < 0.5) return ticks([low, high], Math.max(width / 70, 3));
  const within = width / span > 130 ? [1, 2, 5] : [1];
  const values = [];
  for (let power = Math.floor(Math.log10(low)); power <= Math.log10(high); power++) {
    for (const k of within) values.push(Number(`${k}e${power}`));
  }
  const inside = (v) => v >= low * (1 - 1e-9) && v <= high * (1 + 1e-9);
  return { values: values.filter(inside), write: number };
}
