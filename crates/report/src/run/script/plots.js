// Which diagrams there are.

/** Colours of curves, in order of use. */
const PALETTE = ["#0072b2", "#d55e00", "#009e73", "#cc79a7", "#56b4e9", "#e69f00"];

/** A quantity and its unit, where it has one. */
const labelled = (what, shown) => (shown.unit ? `${what} [${shown.unit}]` : what);

const plots = {
  /** An output over time. */
  history(host, i) {
    const h = data.histories[i];
    new Chart(host, {
      title: h.name, x: "time [s]", y: labelled(h.name, h.shown), height: 240, timed: true,
      series: [{ name: h.name, color: "#0072b2", x: unpack(h.t), y: unpack(h.y, h.shown.factor) }],
    });
  },

  /** An acceleration of the base. */
  ground(host, i) {
    const h = data.ground[i].history;
    new Chart(host, {
      title: h.name, x: "time [s]", y: labelled(h.name, h.shown), height: 240, timed: true,
      series: [{ name: h.name, color: "#0072b2", x: unpack(h.t), y: unpack(h.y, h.shown.factor) }],
    });
  },

  /** Response spectra: `spectra ground 0`, `spectra floor 1`. */
  spectra(host, where, i) {
    const chart = data[`${where}_spectra`][i];
    new Chart(host, {
      title: chart.title, x: "period [s]", y: `${chart.quantity} [${chart.shown.unit}]`, height: where === "ground" ? 240 : 340,
      timed: false, log: true,
      series: chart.curves.map((c, k) => ({
        name: c.name, color: PALETTE[k % PALETTE.length], x: unpack(c.period), y: unpack(c.y, chart.shown.factor),
      })),
    });
  },

  /** Energies as curves, or stacked. */
  energy(host, form) {
    const unit = data.energies[0].shown.unit;
    const line = (name, words, color, dash) => {
      const h = data.energies.find((e) => e.name === name);
      return { name: words, color, dash, x: unpack(h.t), y: unpack(h.y, h.shown.factor) };
    };
    const kinds = JSON.parse(host.dataset.kinds).map(([name, words, color]) => line(name, words, color));
    const input = line("input", "input", "#1e1e1e");
    const options = { x: "time [s]", y: `energy [${unit}]`, height: 380, timed: true };
    if (form === "curves") {
      const error = line("error", "unaccounted for", "#aa003c", [5, 3]);
      new Chart(host, { ...options, title: "Energies over time", series: [input, ...kinds, error] });
    } else {
      // Folders of earlier runs have no sum.
      const known = data.energies.some((e) => e.name === "supply");
      const supply = known ? line("supply", "start + input", "#1e1e1e") : input;
      new Chart(host, { ...options, title: "Where the energy is", series: [...stacked(kinds), supply] });
    }
  },

  /** A hysteresis loop. */
  loop(host, i) {
    const l = data.loops[i];
    const [d, f] = l.shown;
    new Chart(host, {
      title: `${l.link} ${l.coordinate}`, x: `deformation [${d.unit}]`, y: `force [${f.unit}]`, height: 300, timed: false,
      series: [{
        name: l.link, color: "#0072b2", times: unpack(l.t), x: unpack(l.d, d.factor), y: unpack(l.f, f.factor),
      }],
    });
  },
};

/** Curves on top of each other at common times; what is negative goes downwards. */
function stacked(kinds) {
  const count = 1200;
  const end = extremes(...kinds.map((k) => k.x))[1];
  const x = Float64Array.from({ length: count + 1 }, (_, i) => (end * i) / count);
  const [up, down] = [new Float64Array(count + 1), new Float64Array(count + 1)];
  return kinds.map((k) => {
    const [low, y] = [new Float64Array(count + 1), new Float64Array(count + 1)];
    x.forEach((t, i) => {
      const value = valueAt(k.x, k.y, t);
      const base = value >= 0 ? up : down;
      low[i] = base[i];
      base[i] += value;
      y[i] = base[i];
    });
    return { name: k.name, color: k.color, x, y, low };
  });
}
