// The deformed shapes in time: play, scrub, speed, scale, ways of looking.

/** The moment that figures and model show. */
const clock = group("time");

/** Displacements of all points at all times, as multiples of a step: two bytes each, the low one first. */
function shapes() {
  const text = atob(document.getElementById("shapes").textContent), out = new Int16Array(text.length >> 1);
  for (let i = 0; i < out.length; i++) out[i] = text.charCodeAt(2 * i) | (text.charCodeAt(2 * i + 1) << 8);
  return out;
}

const frames = {};
function reframe() { Object.assign(frames, { t: data.frames.t, u: { step: data.frames.u.step, n: shapes() } }); }
reframe();

/** Displacements of all points at a time, times a factor; into numbers that are there, or into new ones. */
function displaced(t, factor, out = new Float64Array(3 * POINTS)) {
  const i = before(frames.t, t), j = Math.min(i + 1, frames.t.length - 1);
  const gap = frames.t[j] - frames.t[i];
  const share = gap > 0 ? Math.min(Math.max((t - frames.t[i]) / gap, 0), 1) : 0;
  const step = frames.u.step * factor, n = frames.u.n, size = 3 * POINTS;
  const [a, b, from, to] = [step * (1 - share), step * share, i * size, j * size];
  for (let k = 0; k < size; k++) out[k] = a * n[from + k] + b * n[to + k];
  return out;
}

/** Size of the largest displacement. */
function farthest() {
  const { n, step } = frames.u;
  let most = 0;
  for (let i = 0; i + 2 < n.length; i += 3) most = Math.max(most, Math.hypot(n[i], n[i + 1], n[i + 2]));
  return most * step;
}

function player(canvas, controls, tip) {
  const moves = frames.t.length > 1, still = new Float64Array(3 * POINTS), moved = new Float64Array(3 * POINTS);
  let end = frames.t.at(-1) ?? 0, most = farthest(), wanted = Number(controls.dataset.scale) || 1;
  let factor = wanted, playing = false, speed = 1, last = 0;
  const stage = new Stage(canvas, 440,
    () => (frames.t.length ? displaced(clock.at ?? 0, factor, moved) : still),
    () => factor * most);
  const select = (label, values, chosen, write, change) => {
    const box = make("select", {}, ...values.map((v) => make("option", { value: String(v), selected: v === chosen }, write(v))));
    box.addEventListener("change", () => change(box.value));
    return make("label", {}, `${label} `, box);
  };
  const tick = (label, on, change) => {
    const box = make("input", { type: "checkbox", checked: on });
    box.addEventListener("change", () => { change(box.checked); stage.draw(); });
    return make("label", {}, box, ` ${label}`);
  };
  stage.scaled = () => { if (stage.tint?.how === 1) stage.tint.most = factor * most; };
  const warning = make("output", { class: "care" });
  let films = null;
  /** Bodies that pass through each other at this scale do not in truth. */
  const say = () => {
    const where = passes(factor);
    warning.textContent = where ? `At × ${factor} ${where.pair} pass through each other, first at ${number(where.t)} s; × 1 is to scale.` : "";
  };
  if (moves) {
    const button = make("button", { type: "button" }, "Play");
    const scrub = make("input", { type: "range", min: "0", max: "1000", value: "0", "aria-label": "time" });
    const read = make("output", {}, "0 s");
    const advance = (now) => {
      if (!playing) return;
      const t = (clock.at ?? 0) + speed * Math.min((now - last) / 1000, 0.2);
      last = now;
      if (t > end && films?.goes()) { clock.read(end); films.over(); return; }
      clock.read(t > end ? 0 : t);
      requestAnimationFrame(advance);
    };
    const toggle = () => {
      playing = !playing;
      button.textContent = playing ? "Pause" : "Play";
      last = performance.now();
      if (playing) requestAnimationFrame(advance);
    };
    button.addEventListener("click", toggle);
    films = film(canvas, () => { clock.read(0); if (!playing) toggle(); }, () => { if (playing) toggle(); });
    canvas.addEventListener("keydown", (e) => {
      const step = { ArrowLeft: -0.005, ArrowRight: 0.005 }[e.key];
      if (e.shiftKey || e.ctrlKey) return;
      if (e.key === " ") toggle();
      else if (step) clock.read(Math.min(Math.max((clock.at ?? 0) + step * end, 0), end));
      else return;
      e.preventDefault();
    });
    scrub.addEventListener("input", () => clock.read((end * scrub.value) / 1000));
    clock.listeners.push((t) => {
      scrub.value = String(Math.round((1000 * t) / end));
      read.textContent = `${t.toFixed(3)} s`;
      stage.draw();
    });
    speed = end < 3 ? 0.25 : end > 60 ? 5 : 1;
    const factors = () => [...new Set([1, 2, 5, 10, 20, 50, 100, 200, 500, 1000, wanted])].sort((a, b) => a - b);
    const scale = select("displacements", factors(), wanted, (v) => `× ${v}`, (v) => { factor = Number(v); say(); stage.scaled(); stage.draw(); });
    controls.append(button, make("span", { class: "scrub" }, scrub, read),
      select("speed", [0.05, 0.1, 0.25, 0.5, 1, 2, 5, 10], speed, (v) => `× ${v}`, (v) => { speed = Number(v); }),
      scale, warning);
    say();
    renewals.push((fresh, next) => {
      if (!fresh.frames) return;
      reframe();
      [end, most] = [frames.t.at(-1), farthest()];
      // Who has chosen a scale keeps it.
      if (factor === wanted) factor = Number(next) || 1;
      wanted = factor;
      const box = scale.querySelector("select");
      box.replaceChildren(...factors().map((v) => make("option", { value: String(v), selected: v === factor }, `× ${v}`)));
      if ((clock.at ?? 0) > end) clock.read(end);
      // Not on the way of what is seen.
      later(say);
      stage.retint?.();
      requestAnimationFrame(() => stage.draw());
    });
  }
  controls.append(...views(stage));
  controls.append(...colours(stage, select, () => (moves ? most : 0)));
  stage.names = picture.nodes.length <= 40;
  controls.append(tick("names", stage.names, (on) => { stage.names = on; }));
  if (moves) controls.append(tick("at rest", stage.ghost, (on) => { stage.ghost = on; }));
  if (picture.outlines.length) controls.append(tick("sections", stage.sections, (on) => { stage.sections = on; }));
  turn(stage, tip);
  finder(stage, document.getElementById("finder"), films?.button);
  stage.draw();
}

/** Buttons for ways of looking: how it begins, along the axes, and of a plane model in space. */
function views(stage) {
  const first = picture.plane ?? "space";
  const words = picture.plane ? { [first]: "home", space: "space" } : { space: "home", XY: "plan X–Y", XZ: "elevation X–Z", YZ: "elevation Y–Z" };
  const keys = Object.entries(words).map(([view, text]) => {
    const key = make("button", { type: "button", "data-view": view, "aria-pressed": String(view === first) }, text);
    key.addEventListener("click", () => stage.look(view));
    return key;
  });
  stage.looked = (view) => { for (const key of keys) key.setAttribute("aria-pressed", String(key.dataset.view === view)); };
  return keys.length > 1 ? keys : [];
}

/** What the model is coloured by. */
function colours(stage, select, most) {
  let all = tints(most);
  if (!all.size) return [];
  stage.time = () => clock.at ?? 0;
  const take = (v) => {
    stage.tint = all.get(v)?.() ?? null;
    // Points are measured as they are drawn.
    stage.scaled?.();
    stage.draw();
  };
  const plain = "one each", box = select("colours", [plain, ...all.keys()], plain, (v) => v, take);
  stage.retint = () => {
    const list = box.querySelector("select"), chosen = list.value;
    all = tints(most);
    list.replaceChildren(...[plain, ...all.keys()].map((v) => make("option", { value: v, selected: v === chosen }, v)));
    if (chosen !== plain) take(list.value);
  };
  return [box];
}

/** Whole multiples of a step as numbers. */
function multiples({ n, step }) {
  const out = new Float64Array(n.length);
  for (let i = 0; i < out.length; i++) out[i] = n[i] * step;
  return out;
}

/** A mode shape that swings while the pointer is over it. */
function mode(canvas) {
  let shape, most;
  const take = () => {
    shape = multiples(data.modes[canvas.dataset.mode].u);
    most = 0;
    for (let i = 0; i < shape.length; i += 3) most = Math.max(most, Math.hypot(shape[i], shape[i + 1], shape[i + 2]));
  };
  take();
  const sides = [0, 1, 2].map((i) => extremes(picture.points.map((p) => p[i]))).map(([a, b]) => b - a);
  const size = 0.12 * Math.max(...sides);
  let phase = Math.PI / 2, swinging = false;
  const stage = new Stage(canvas, 220, () => shape.map((u) => (u * size * Math.sin(phase)) / (most || 1)), () => size);
  const swing = () => {
    if (!swinging) { phase = Math.PI / 2; stage.draw(); return; }
    phase += 0.08;
    stage.draw();
    requestAnimationFrame(swing);
  };
  canvas.addEventListener("pointerenter", () => { swinging = true; requestAnimationFrame(swing); });
  canvas.addEventListener("pointerleave", () => { swinging = false; });
  // Of another run when it comes to be seen.
  let seen = false, stale = false;
  const renewed = () => {
    if (!seen || !stale) return;
    stale = false;
    take();
    stage.draw();
  };
  new IntersectionObserver(([e]) => { seen = e.isIntersecting; renewed(); }, { rootMargin: "400px" }).observe(canvas);
  renewals.push((fresh) => { if (fresh.modes) stale = true; renewed(); });
  stage.draw();
}
